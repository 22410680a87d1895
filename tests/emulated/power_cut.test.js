// Power is cut while `Locked` is written to flash, and the image comes back as if it had been cut before or after.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Pico } from '../../emulator/src/index.js';

const { PLC_IMAGE: image } = process.env;

/**
 * On duty, line 1 dead, and breaker 1 does not obey: the switcher locks itself TD + TA = 3 s after it starts, or
 * after it has been unlocked.
 */
const INPUTS = { 2: 1, 3: 0, 4: 0, 5: 1, 6: 0, 7: 0, 8: 0, 9: 1, 10: 0 };
const UNLOCK = 3;
const OFF_MS = 20;
const FLASH_SIZE = 2 * 1024 * 1024;
const SECTOR = 4096;

/** What a start may say. */
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
  const seen = { kept: 0, changed: 0, program: 0 };
  for (const seed of [1, 2, 3]) {
    const switcher = new Switcher(seed);
    for (let cut = 0; cut < 60; cut++) {
      const plan = { flashOperation: 1, moment: moments[(cut + seed) % 4] };
      const result = switcher.changeAndCut(plan);
      assert.ok(result, 'a change is written');
      seen[result.changed ? 'changed' : 'kept']++;
      if (result.torn) seen[result.torn.kind]++;
      assert.deepEqual(result.said.filter((text) => !ORDERLY.test(text)), [], JSON.stringify(plan));
      if (cut % 4 === 0) assert.equal(switcher.lockedAfterPowerCycle(), switcher.locked);
    }
    assert.deepEqual(switcher.pico.faults, []);
    assert.equal(switcher.pico.flash.violations.length, 0);
  }
  assert.ok(seen.kept > 40 && seen.changed > 40 && seen.program > 60, JSON.stringify(seen));
});

/** A flash of a switcher that is locked, whose other sectors hold what nobody needs. */
function spentFlash() {
  const switcher = new Switcher(1);
  assert.equal(switcher.changeAndCut({ flashOperation: 100 }), null);
  assert.ok(switcher.locked);
  const flash = switcher.pico.flashImage();
  const { address: length } = switcher.pico.symbol('RETAIN_LENGTH');
  flash.fill(0, FLASH_SIZE - length + SECTOR);
  return { flash, sectors: length / SECTOR };
}

test('a cut at any erase of a start costs nothing, and the next start goes on', () => {
  const { flash, sectors } = spentFlash();
  let torn = 0;
  for (const moment of ['before', 'during', 'after']) {
    // The sector that holds the record stays, and so does the one before it.
    for (let flashOperation = 1; flashOperation <= sectors - 2; flashOperation++) {
      const plan = { flashOperation, moment, kind: 'erase', offMs: OFF_MS };
      const pico = new Pico(image, { inputs: INPUTS, seed: flashOperation, flash, recordEdges: false, powered: false });
      pico.cutPower(plan);
      pico.powerOn();
      assert.ok(pico.runUntil(() => pico.powerCuts.length > 0, 1000), JSON.stringify(plan));
      if (pico.powerCuts[0].torn) torn++;
      const erased = pico.flash.erases;
      assert.ok(pico.runUntilLog('T24: {1} -> {11}', 1000), `${JSON.stringify(plan)}: locked as before`);
      assert.ok(pico.flash.erases - erased <= sectors - 1 - flashOperation, 'what was erased is not erased again');
      assert.deepEqual(pico.faults, []);
    }
  }
  assert.equal(torn, sectors - 2);
});

test('a cut just before the lock comes back free, a cut just behind its write comes back locked', () => {
  const before = new Switcher(4);
  assert.equal(before.changeAndCut({ flashOperation: 1, moment: 'before' })?.changed, false);
  const behind = new Switcher(4);
  assert.equal(behind.changeAndCut({ flashOperation: 1, moment: 'after' })?.changed, true);
});
