// The same stimulus on x86 and on the pins of the emulated board.

import assert from 'node:assert/strict';

import { Bench } from './bench.js';
import { randomNumbers } from './random.js';
import { asCsv, stimulus } from './stimulus.js';

/** Of the log, when the two differ. */
const LINES_SHOWN = 12;

/**
 * Drives both at random and compares the traces, row by row.
 * @param {import('./application.js').Application} application
 * @param {{seed: number, scans: number, habits?: object, board?: object}} run
 * @returns {{trace: string[][], log: string[]}} the rows on which they agree, and what the image said
 */
export function inLockstep(application, { seed, scans, habits, board }) {
  const rows = stimulus(application, scans, randomNumbers(seed), habits);
  const onX86 = application.traceOnX86(asCsv(application, rows));
  const bench = new Bench(application, board);
  const { columns, period_ms: periodMs } = application.symbols;
  assert.equal(columns.join(','), onX86[0]);
  bench.connect(rows[0]);
  bench.pico.powerOn();
  for (let scan = 0; scan < scans; scan++) {
    bench.scan();
    assert.equal(bench.scans, scan + 1, 'no scan is lost');
    const onBoard = bench.row(scan * periodMs);
    if (onBoard !== onX86[scan + 1]) {
      const said = bench.pico.takeLog().slice(-LINES_SHOWN).map(({ timeUs, text }) => `${timeUs} us: ${text}`);
      assert.fail([difference(columns, onX86[scan + 1], onBoard, { seed, scan }), ...said].join('\n'));
    }
    bench.connect(rows[scan + 1]);
  }
  assert.equal(onX86.length, scans + 1);
  assert.deepEqual(bench.pico.faults, []);
  return {
    trace: onX86.slice(1).map((row) => row.split(',')),
    log: bench.pico.takeLog().map(({ text }) => text),
  };
}

function difference(columns, onX86, onBoard, { seed, scan }) {
  const [expected, found] = [onX86, onBoard].map((row) => row.split(','));
  const cells = columns.flatMap((name, i) =>
    found[i] === expected[i] ? [] : [`${name} is \`${found[i]}\`, on x86 \`${expected[i]}\``],
  );
  return `seed ${seed}, scan ${scan}: ${cells.join('; ')}`;
}
