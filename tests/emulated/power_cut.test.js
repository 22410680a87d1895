// Power is cut while `Locked` is written to flash, and the image comes back as if it had been cut before or after.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';

import { Pico } from '../../emulator/src/index.js';

const { PLC_IMAGE: image, PLC_HOST: host } = process.env;

/**
 * On duty, line 1 dead, and breaker 1 does not obey: the switcher locks itself TD + TA = 3 s after it starts, or
 * after it has been unlocked.
 */
const INPUTS = { 2: 1, 3: 0, 4: 0, 5: 1, 6: 0, 7: 0, 8: 0, 9: 1, 10: 0 };
const UNLOCK = 3;
const OFF_MS = 20;
const FLASH_SIZE = 2 * 1024 * 1024;
const SECTOR = 4096;

/** What a start may say. Anything else, such as a formatted half, is looked at by the test that expects it. */
const ORDERLY = /reset: power-on|starts in|T24: \{1\} -> \{11\}|T1: |T3: |T23: /;

class Switcher {
  constructor(seed, flash) {
    this.pico = new Pico(image, { inputs: INPUTS, seed, flash, recordEdges: false });
    this.locked = false;
    this.pico.runFor(50);
  }

  /** Cuts the power at the plan's moment of the next change of `Locked`. Null when the change came through before. */
  changeAndCut(plan) {
    const { pico } = this;
    const cuts = pico.powerCuts.length;
    pico.takeLog();
    pico.cutPower({ ...plan, offMs: OFF_MS });
    if (this.locked) pico.setInput(UNLOCK, 1);
    // Unlocked, it would lock itself again after 3 s.
    const happened = pico.runUntil(() => pico.powerCuts.length > cuts, this.locked ? 1000 : 3500);
    pico.cancelCuts();
    pico.setInput(UNLOCK, 0);
    pico.runFor(OFF_MS + 60);
    const said = pico.takeLog().map(({ text }) => text);
    if (!happened) {
      this.locked = !this.locked;
      return null;
    }
    const start = said.findLastIndex((text) => text.includes('reset:'));
    const before = this.locked;
    this.locked = said.slice(start).some((text) => text.includes('T24'));
    return { torn: pico.powerCuts.at(-1).torn, changed: this.locked !== before, said: said.slice(start) };
  }

  /** Whether it is locked after a further, undisturbed loss of power. */
  lockedAfterPowerCycle() {
    const { pico } = this;
    pico.powerCycle({ offMs: OFF_MS });
    pico.runFor(60);
    return pico.takeLog().some(({ text }) => text.includes('T24'));
  }
}

test('a cut at any operation of the flash leaves the old state or the new one, for good', () => {
  const moments = ['during', 'after', 'during', 'before'];
  const seen = { kept: 0, changed: 0, program: 0, erase: 0 };
  for (const seed of [1, 2, 3]) {
    const switcher = new Switcher(seed);
    for (let cut = 0; cut < 40; cut++) {
      const plan = { flashOperation: 1 + (cut % 3), moment: moments[(cut + seed) % 4] };
      const result = switcher.changeAndCut(plan);
      if (!result) continue;
      seen[result.changed ? 'changed' : 'kept']++;
      if (result.torn) seen[result.torn.kind]++;
      assert.deepEqual(result.said.filter((text) => !ORDERLY.test(text)), [], JSON.stringify(plan));
      if (cut % 4 === 0) assert.equal(switcher.lockedAfterPowerCycle(), switcher.locked);
    }
    assert.deepEqual(switcher.pico.faults, []);
  }
  assert.ok(seen.kept > 10 && seen.changed > 10 && seen.program > 20, JSON.stringify(seen));
});

/**
 * A flash whose retain area the soft PLC has filled until the next record does not fit into its page any more: the
 * page is closed, the next one opened, and the old one erased.
 */
function fullFlash() {
  const folder = mkdtempSync(join(tmpdir(), 'plc-'));
  try {
    const file = join(folder, 'area');
    let area;
    let used = 0;
    for (let before = 0, record = 0; SECTOR - 1 - used >= record || record === 0; before = used) {
      execFileSync(join(host, 'plc'), ['--fast', '--retain', file]);
      area = readFileSync(file);
      used = area.subarray(0, SECTOR - 1).findLastIndex((byte) => byte !== 0xff) + 1;
      record = before ? used - before : 0;
    }
    const flash = new Uint8Array(FLASH_SIZE).fill(0xff);
    flash.set(area, FLASH_SIZE - area.length);
    return flash;
  } finally {
    rmSync(folder, { recursive: true });
  }
}

test('a cut anywhere while a full page is turned over leaves the old state or the new one', () => {
  const flash = fullFlash();
  const torn = { program: 0, erase: 0 };
  let changed = 0;
  for (const moment of ['before', 'during', 'after']) {
    for (let flashOperation = 1; flashOperation <= 8; flashOperation++) {
      const plan = { flashOperation, moment };
      const switcher = new Switcher(flashOperation, flash);
      const result = switcher.changeAndCut(plan);
      if (!result) continue;
      if (result.torn) torn[result.torn.kind]++;
      changed += result.changed;
      assert.equal(switcher.lockedAfterPowerCycle(), switcher.locked, JSON.stringify(plan));
      // The store goes on working, whatever it had to mend.
      assert.equal(switcher.changeAndCut({ flashOperation: 100 }), null);
      assert.equal(switcher.lockedAfterPowerCycle(), switcher.locked, JSON.stringify(plan));
    }
  }
  assert.ok(torn.erase > 0 && torn.program > 3 && changed > 0, JSON.stringify({ torn, changed }));
});

test('a cut just before the lock comes back free, a cut just behind its write comes back locked', () => {
  const before = new Switcher(4);
  assert.equal(before.changeAndCut({ flashOperation: 1, moment: 'before' })?.changed, false);
  const behind = new Switcher(4);
  const lastOfARecord = 3;
  assert.equal(behind.changeAndCut({ flashOperation: lastOfARecord, moment: 'after' })?.changed, true);
});
