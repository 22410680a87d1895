// Weeks of running: the timer's lower word rolls over after 71 minutes, the time of the engine passes 2^32 ms after
// seven weeks, and no timer, edge or scan is wrong for it.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Application } from './support/application.js';
import { Bench } from './support/bench.js';
import { inLockstep } from './support/lockstep.js';
import { randomNumbers } from './support/random.js';
import { stimulus } from './support/stimulus.js';

const values = Application.named('values');
const hierarchy = Application.named('hierarchy');
const PERIOD_MS = 10;
const DAY_MS = 24 * 3_600_000;
/** Where a counter of 32 bits would begin anew: microseconds of the timer, milliseconds of the engine. */
const ROLL_OVER = 2 ** 32;
const LATE = /late scan|overrun/;

const at = (name) => values.inputs.findIndex((input) => input.name === name);
const quiet = values.inputs.map(() => 0);
const withInput = (name) => quiet.map((level, i) => (i === at(name) ? 1 : level));

/** Starts a board with the program `values` and runs scan 0. */
function started(levels) {
  const bench = new Bench(values);
  bench.connect(levels);
  bench.pico.powerOn();
  bench.scan();
  return bench;
}

function scans(bench, count) {
  for (let scan = 0; scan < count; scan++) bench.scan();
}

/** Lets the board stand still for a whole number of periods. The next scan serves the last release of them. */
function leap(bench, ms) {
  assert.equal(ms % PERIOD_MS, 0);
  bench.pico.leap(ms);
}

const linesThat = (bench, pattern) => bench.pico.takeLog().map(({ text }) => text).filter((text) => pattern.test(text));

for (const [application, habits] of [
  [values, { 'бункер.полон': { stays: 90, high: 0.7 }, keep: { stays: 60 } }],
  [hierarchy, { halt: { stays: 80 }, auto: { stays: 60 }, single: { stays: 40 }, guard: { stays: 60, high: 0.7 } }],
]) {
  test(`the timer's lower word rolls over within a run of ${application.symbols.application}, and no row differs`, () => {
    const board = { timerStartUs: ROLL_OVER - 8_000_000 };
    const { log } = inLockstep(application, { seed: 21, scans: 1600, habits, board });
    assert.deepEqual(log.filter((text) => LATE.test(text)), []);
  });
}

test('wherever in a period the roll-over falls, every scan comes at its time', () => {
  // A prime step, so that it falls into scans, between them, and near a release.
  for (let offsetUs = 0; offsetUs < 2 * PERIOD_MS * 1000; offsetUs += 331) {
    const bench = new Bench(values, { timerStartUs: ROLL_OVER - 50_000 + offsetUs });
    bench.connect(quiet);
    bench.pico.powerOn();
    bench.scan();
    const first = bench.pico.timeNs;
    for (let scan = 1; scan <= 10; scan++) {
      bench.scan();
      const late = bench.pico.timeNs - first - scan * PERIOD_MS * 1e6;
      // Scan 0 takes longer than the others, so that these end earlier in their period.
      assert.ok(late <= 0 && late > -1e6, `roll-over ${offsetUs} us later, scan ${scan}: ${late} ns`);
    }
    assert.equal(bench.scans, 11);
    assert.deepEqual(linesThat(bench, LATE), []);
  }
});

test('a timer of twenty days has run out after twenty days, not a scan earlier, and stays so for a year', () => {
  const bench = started(quiet);
  scans(bench, 3);
  bench.connect(withInput('Störung'));
  bench.scan();
  bench.connect(quiet);
  scans(bench, 10);
  // One of these serves the release behind which the leap begins.
  leap(bench, 20 * DAY_MS - 20 * PERIOD_MS);
  scans(bench, 10);
  assert.equal(bench.value('worn'), 0, 'a period is missing');
  bench.scan();
  assert.equal(bench.value('worn'), 1);
  for (let elapsed = 20; elapsed < 365; elapsed += 24) {
    leap(bench, 24 * DAY_MS);
    // A leap is an overrun: one in ten scans would be an overload.
    for (let scan = 0; scan < 15; scan++) {
      bench.scan();
      assert.equal(bench.value('worn'), 1, `about day ${elapsed + 24}`);
    }
  }
});

test('while nothing happens at the pins nothing happens in the program, as 2^32 ms go by', () => {
  const bench = started(quiet);
  bench.connect(withInput('a'));
  scans(bench, 500);
  leap(bench, ROLL_OVER - (ROLL_OVER % PERIOD_MS) - 10_000);
  scans(bench, 2);
  const watched = ['rises', 'falls', 'both', 'any', 'pressed', 'held', 'late', 'mixed', 'twice', 'worn', 'seconds', 'PULSE', 'SLOW'];
  const state = () => Object.fromEntries(watched.map((name) => [name, bench.value(name)]));
  const before = state();
  assert.deepEqual([before.rises, before.late], [1, 1], 'the one edge of long ago');
  linesThat(bench, /./);
  for (let scan = 0; scan < 1000; scan++) {
    bench.scan();
    assert.deepEqual(state(), before, `scan ${scan}`);
  }
  assert.deepEqual(linesThat(bench, / T\d+: |overrun|late scan/), []);
});

test('across 2^32 ms the same happens as anywhere else, scan for scan', () => {
  const habits = { 'бункер.полон': { stays: 90, high: 0.7 }, keep: { stays: 60 } };
  const rows = stimulus(values, 2000, randomNumbers(22), habits);
  // The longest hold of the program is an hour: either leap is beyond all that runs, short of the twenty days.
  const here = started(quiet);
  const there = started(quiet);
  for (const bench of [here, there]) scans(bench, 499);
  leap(here, 2 * 3_600_000);
  leap(there, ROLL_OVER - (ROLL_OVER % PERIOD_MS) - 10_000 - 5_000);
  let alike = 0;
  for (const row of rows) {
    here.scan();
    there.scan();
    assert.equal(there.row(0), here.row(0), `row ${alike} behind the leap`);
    here.connect(row);
    there.connect(row);
    alike++;
  }
  assert.equal(here.scans, 500 + rows.length);
  assert.equal(there.scans, here.scans);
  for (const bench of [here, there]) {
    const said = linesThat(bench, LATE);
    assert.equal(said.length, 1, said.join('\n'));
    assert.match(said[0], /overrun: releases missed: \d+ \(1 overruns since start\)/);
  }
});
