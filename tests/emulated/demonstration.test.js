// The demonstration on the emulated board: the same lines as on x86, scan for scan.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { join } from 'node:path';
import { test } from 'node:test';

import { demonstrate } from '../../emulator/src/demonstration.js';

const { PLC_IMAGE: image, PLC_HOST: host } = process.env;
const plc = join(host, 'plc');

/** A board needs this long from power to scan 0, twice in the demonstration. */
const START_MS = 2;

const LINE = /^ +(\d+)\.(\d{3})  (.*)$/;

function lines(text) {
  const found = text.split('\n').map((line) => LINE.exec(line)).filter(Boolean);
  return found.map(([, seconds, ms, what]) => ({ ms: Number(seconds) * 1000 + Number(ms), what }));
}

test('the emulated board plays the demonstration as the soft PLC does', async () => {
  const onX86 = lines(execFileSync(plc, ['--fast'], { encoding: 'utf8' }));
  let written = '';
  assert.ok(await demonstrate(image, plc, (text) => (written += text)));
  const onBoard = lines(written);
  assert.ok(onX86.length > 20);
  assert.deepEqual(onBoard.map(({ what }) => what), onX86.map(({ what }) => what));
  for (const [i, { ms, what }] of onBoard.entries()) {
    const later = ms - onX86[i].ms;
    assert.ok(later >= 0 && later <= START_MS, `${what}: ${later} ms later`);
  }
});
