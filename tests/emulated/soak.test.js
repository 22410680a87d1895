// The line switcher and the drilling station for long: operators press, lines fail, drills jam and wires break at random,
// and in every scan the image does what both interpreters do on x86.
//
//   SOAK_HOURS=24 SOAK_SEED=7   for longer, and otherwise: script/soak --hours

import assert from 'node:assert/strict';
import { basename } from 'node:path';
import { test } from 'node:test';

import { Application } from './support/application.js';
import { Bench } from './support/bench.js';
import { playing } from './support/play.js';
import { RamWatch } from './support/ram.js';

const { SOAK_HOURS, SOAK_SEED } = process.env;
const HOUR_MS = 3_600_000;
const LONG_MS = Number(SOAK_HOURS ?? 0.1) * HOUR_MS;
const SEED = Number(SOAK_SEED ?? 1);
/** Every step is reached in an hour, and in the usual six minutes, too. */
const REACHES_EVERYTHING = LONG_MS >= HOUR_MS || !(SOAK_HOURS || SOAK_SEED);
/** A part of the run, after which memory is looked at, and progress shown. */
const PARTS = 20;
/**
 * Nothing runs while a sector is erased: with the real 45 ms scans would be missed in the course of a day, and x86 would
 * have nothing to compare with. What an erase costs has tests of its own.
 */
const BOARD = { flashTimes: { eraseMs: 1 } };
/**
 * No deeper may the stack be, in bytes; behind it all memory is as it was. It grows for hours by some words still, until
 * the timer has met the scan, and the scan the store, each where it is deepest.
 */
const DEEPEST = 3072;
/** What a scan may end later than the others: a page of flash is programmed, a line logged. */
const LATE_NS = 2e6;

for (const application of [Application.flashed(), Application.example('drilling_station')]) {
  const { program, symbols } = application;
  const name = basename(program, '.grafcet');
  test(`${name}: every scan comes at its time and does what it does on x86, and memory stays as it is`, async () => {
    const periodMs = symbols.period_ms;
    const scans = Math.round(LONG_MS / periodMs);
    const part = Math.ceil(scans / PARTS);
    const bench = new Bench(application, BOARD);
    const reached = new Set();
    let ram = null;
    let first = 0;
    let scan = 0;
    for await (const { levels, row } of playing(application, { seed: SEED, scans })) {
      bench.connect(levels);
      if (scan === 0) {
        bench.pico.powerOn();
        ram = new RamWatch(bench.pico);
      }
      bench.scan();
      first ||= bench.pico.timeNs;
      const told = `seed ${SEED}, scan ${scan}`;
      assert.equal(bench.scans, scan + 1, `${told}: a scan is lost`);
      const late = bench.pico.timeNs - first - scan * periodMs * 1e6;
      assert.ok(Math.abs(late) < LATE_NS, `${told}: it ends ${late} ns off its time`);
      const found = bench.row(scan * periodMs);
      if (found !== row) assert.fail(`${told}\non x86   ${row}\nin image ${found}\n${lastLines(bench)}`);
      for (const step of row.split(',', 2)[1].split(' ')) reached.add(step);
      scan++;
      if (scan % part === 0) {
        ram.look();
        bench.pico.takeLog();
        progress(name, scan / scans);
      }
    }
    assert.equal(scan, scans);
    assert.deepEqual(bench.pico.faults, []);
    assert.equal(bench.pico.boots.length, 1);
    const steps = symbols.graphs.flatMap((graph) => graph.steps.map(({ id }) => id));
    if (REACHES_EVERYTHING) assert.deepEqual(steps.filter((step) => !reached.has(step)), [], 'every step is reached');
    const depths = ram.depths.join(', ');
    assert.ok(ram.depths.at(-1) <= DEEPEST, `the stack, in bytes behind each part of the run: ${depths}`);
    note(`${name}: the stack, in bytes behind each part of the run: ${depths}`);
  });
}

const lastLines = (bench) => bench.pico.takeLog().slice(-12).map(({ timeUs, text }) => `${timeUs} us: ${text}`).join('\n');

const progress = (name, part) => note(`${name}: ${Math.round(100 * part)} % of ${LONG_MS / HOUR_MS} h`);

/** For who waits for a long run. */
function note(text) {
  if (SOAK_HOURS) process.stderr.write(`${text}\n`);
}
