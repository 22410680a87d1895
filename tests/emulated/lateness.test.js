// How late scans are while a thousand changed values in a row are put into flash: with erases in the way, with those in
// stock, and with erases in quiet moments alone. `script/lateness` prints the table of docs/src/operation.md with it.

import assert from 'node:assert/strict';
import { after, test } from 'node:test';

import { Application } from './support/application.js';
import { Bench } from './support/bench.js';

const strokes = Application.named('strokes');
const [CARELESS, RESTING, DOWN] = [2, 3, 16];
const CHANGES = 1000;
const PERIOD_NS = strokes.symbols.period_ms * 1e6;
/** Typical of the flash, as the emulator has it, and at most by its data sheet. */
const TYPICAL = { eraseMs: 45, programMs: 0.4 };
const SLOWEST = { eraseMs: 400, programMs: 3 };
/** What a scan itself takes more when it fires and logs, and the code around the flash's own time. */
const SCAN_MS = 0.6;
/** How much earlier than the first ones a scan may end and be that of its release: one starts a microsecond sooner. */
const EARLY_NS = 5_000;
/** Upper ends of the rows of the table, in ms. */
const ENDS = [0.1, 0.5, 1, 2, 10, 20, 30, 40, 50, Infinity];

const columns = [];

after(() => {
  const names = columns.map(({ name }) => name);
  const lines = [['late by', ...names], ['---', ...names.map(() => '---')]];
  ENDS.forEach((end, row) => {
    const from = row ? ENDS[row - 1] : 0;
    const title = end === Infinity ? `more than ${from} ms` : `up to ${end} ms`;
    lines.push([title, ...columns.map(({ late }) => late.filter((ms) => (row === 0 || ms > from) && ms <= end).length)]);
  });
  lines.push(['the latest', ...columns.map(({ late }) => `${Math.max(...late).toFixed(2)} ms`)]);
  lines.push(['erases', ...columns.map(({ erases }) => erases)]);
  console.log(lines.map((line) => `| ${line.join(' | ')} |`).join('\n'));
});

/**
 * Lets the press make a thousand strokes, each of which is stored; with a name it becomes a column of the table. For each release of a scan, says by how many ms the
 * first scan behind it ends later than usual, and whether the press moved when it was due.
 */
function thousandChanges(name, flashTimes, inputs) {
  const bench = new Bench(strokes, { flashTimes, inputs });
  const { pico } = bench;
  const ends = [];
  const moves = [];
  pico.powerOn();
  bench.scan();
  pico.onStore('PLC_SCANS', () => {
    ends.push(pico.timeNs);
    moves.push(pico.level(DOWN) === 1);
  });
  const [programs, erases] = [pico.flash.programs, pico.flash.erases];
  const first = bench.value('strokes');
  assert.ok(pico.runUntil(() => bench.value('strokes') === first + CHANGES, 300_000));
  pico.runFor(5);
  assert.equal(pico.flash.programs - programs, CHANGES, 'each change is one program');
  assert.deepEqual(pico.faults, []);

  // The first scans end as far behind their releases as any that does not log.
  const phases = ends.slice(0, 3).map((end, scan) => end - scan * PERIOD_NS);
  const late = [];
  const moving = [];
  let due = Math.min(...phases);
  ends.forEach((end, scan) => {
    for (; due <= end + EARLY_NS; due += PERIOD_NS) {
      late.push((end - due) / 1e6);
      moving.push(moves[Math.max(0, scan - 1)]);
    }
  });
  const column = { name, late, moving, erases: pico.flash.erases - erases };
  if (name) columns.push(column);
  return { ...column, bench };
}

test('with erases in the way of a thousand changes scans are missed again and again', () => {
  const { late, erases } = thousandChanges('erased in between', TYPICAL, { [CARELESS]: 1, [RESTING]: 0 });
  assert.ok(erases > 25, `${erases} erases`);
  assert.ok(Math.max(...late) > TYPICAL.eraseMs - 10);
});

for (const [name, times] of [['in stock', TYPICAL], ['in stock, slowest flash', SLOWEST]]) {
  test(`a thousand changes in a row, ${name}: no scan is later than one page program`, () => {
    const { late, erases, bench } = thousandChanges(name, times, { [CARELESS]: 0, [RESTING]: 0 });
    assert.equal(erases, 0);
    assert.ok(Math.max(...late) < times.programMs + SCAN_MS, `${Math.max(...late)} ms`);
    assert.equal(bench.pico.log.filter(({ text }) => text.startsWith('overrun')).length, 0);
  });
}

test('after a long time without one, quiet moments erase all that is spent, and are no overload', () => {
  const { bench } = thousandChanges(null, TYPICAL, { [CARELESS]: 0, [RESTING]: 0 });
  const { pico } = bench;
  pico.setInput(RESTING, 1);
  pico.runFor(4000);
  // Half of the area was written to; of that the last two sectors are kept.
  assert.ok(pico.flash.erases >= 28, `${pico.flash.erases} erases`);
  assert.ok(pico.log.filter(({ text }) => text.startsWith('overrun')).length >= pico.flash.erases);
  assert.deepEqual(pico.log.filter(({ text }) => text.startsWith('overload')), []);
  assert.equal(pico.boots.length, 1);
});

test('with erases in quiet moments alone, no scan in a motion is later than one page program', () => {
  const column = thousandChanges('erased at rest', TYPICAL, { [CARELESS]: 0, [RESTING]: 1 });
  assert.ok(column.erases > 25, `${column.erases} erases`);
  const late = column.late.filter((_, release) => column.moving[release]);
  assert.ok(late.length > 5 * CHANGES, `${late.length} releases`);
  assert.ok(Math.max(...late) < TYPICAL.programMs + SCAN_MS, `${Math.max(...late)} ms`);
  columns.push({ name: 'of these in motion', late, erases: 0 });
});
