// The demonstrations on the emulated board: the same lines as on x86, scan for scan.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { join } from 'node:path';
import { test } from 'node:test';

import { demonstrate } from '../../emulator/src/demonstration.js';

const { PLC_IMAGE, PLC_IMAGES, PLC_HOST } = process.env;

/** A board needs this long from power to scan 0, to read its retain area; twice in a demonstration with a power cycle. */
const START_MS = 14;

const LINE = /^ +(\d+)\.(\d{3})  (.*)$/;

function lines(text) {
  const found = text.split('\n').map((line) => LINE.exec(line)).filter(Boolean);
  return found.map(([, seconds, ms, what]) => ({ ms: Number(seconds) * 1000 + Number(ms), what }));
}

/** Plays it on both, and gives the lines. */
async function played(image, plc) {
  const onX86 = lines(execFileSync(plc, ['--fast'], { encoding: 'utf8' }));
  let written = '';
  assert.ok(await demonstrate(image, plc, (text) => (written += text)));
  const onBoard = lines(written);
  assert.deepEqual(onBoard.map(({ what }) => what), onX86.map(({ what }) => what));
  for (const [i, { ms, what }] of onBoard.entries()) {
    const later = ms - onX86[i].ms;
    assert.ok(later >= 0 && later <= START_MS, `${what}: ${later} ms later`);
  }
  return onBoard.map(({ what }) => what);
}

test('the emulated board plays the demonstration as the soft PLC does', async () => {
  const said = await played(PLC_IMAGE, join(PLC_HOST, 'plc'));
  assert.ok(said.length > 20);
});

test('the emulated board fills the mixing tank as the soft PLC does', async () => {
  const said = await played(join(PLC_IMAGES, 'mixing_tank'), join(PLC_HOST, 'plc-mixing_tank'));
  const levels = said.map((text) => /^ *inputs +level = (\d+)$/.exec(text)?.[1]).filter(Boolean);
  assert.deepEqual(levels.map(Number), [32, 64, 96, 128, 160, 192, 160, 128, 96, 64, 32, 0]);
  assert.equal(said.filter((text) => / T\d: /.test(text)).length, 5);
});
