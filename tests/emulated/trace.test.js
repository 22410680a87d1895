// The same stimulus on x86 and on the pins of the emulated board gives the same trace, scan for scan.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { Pico } from '../../emulator/src/index.js';

const { PLC_IMAGE: image, PLC_HOST: host } = process.env;
const GRAPHS = fileURLToPath(new URL('../../graphs/line_switcher.grafcet', import.meta.url));
const grafcet = (...args) => execFileSync(join(host, 'grafcet'), args, { encoding: 'utf8', maxBuffer: 1 << 28 });

const PERIOD_MS = 10;
/**
 * The inputs with their pins, and how many scans after a change of its level, made just behind a scan, each is seen:
 * `plc.toml` filters the two of the console for 20 ms, the others for less than a period. `stays` is how often a
 * level is drawn anew, in scans, and `high` how often it is 1.
 */
const INPUTS = [
  { name: 'Onduty', pin: 2, seenAfter: 3, stays: 600, high: 0.8 },
  { name: 'Unlock', pin: 3, seenAfter: 3, stays: 60, high: 0.5 },
  { name: 'VL1', pin: 4, seenAfter: 1, stays: 180, high: 0.6 },
  { name: 'VL2', pin: 5, seenAfter: 1, stays: 180, high: 0.6 },
  { name: 'VT2', pin: 6, seenAfter: 1, stays: 300, high: 0.7 },
  { name: 'VT3', pin: 7, seenAfter: 1, stays: 300, high: 0.7 },
  { name: 'F_B2', pin: 8, seenAfter: 1, stays: 400, high: 0.2 },
  { name: 'Breaker_1', pin: 9, seenAfter: 1, stays: 70, high: 0.5 },
  { name: 'Breaker_2', pin: 10, seenAfter: 1, stays: 70, high: 0.5 },
];
/** Longer than a filter needs, so that each change is seen or none. */
const LEAST_STAY = 5;

/** Numbers from 0 to 1, the same for the same seed (mulberry32). */
function randomNumbers(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** For each scan, the levels that the pins take just behind it; those before scan 0 come first. */
function stimulus(scans, random) {
  const draw = ({ high }) => (random() < high ? 1 : 0);
  const since = INPUTS.map(() => 0);
  const levels = INPUTS.map(draw);
  const rows = [[...levels]];
  for (let scan = 1; scan <= scans; scan++) {
    INPUTS.forEach((input, i) => {
      if (++since[i] < LEAST_STAY || random() * input.stays > 1) return;
      since[i] = 0;
      levels[i] = draw(input);
    });
    rows.push([...levels]);
  }
  return rows;
}

/** The stimulus as the program sees it, in the CSV that `grafcet trace` reads. */
function asCsv(rows) {
  const lines = [['time_ms', ...INPUTS.map(({ name }) => name)]];
  for (let scan = 0; scan < rows.length - 1; scan++) {
    // The row behind scan k is rows[k + 1]; a change seen n scans later was made behind scan `scan - n`.
    const seen = INPUTS.map(({ seenAfter }, i) => rows[Math.max(0, scan - seenAfter + 1)][i]);
    lines.push([scan * PERIOD_MS, ...seen]);
  }
  return lines.map((line) => line.join(',')).join('\n') + '\n';
}

function traceOnX86(rows) {
  const folder = mkdtempSync(join(tmpdir(), 'plc-'));
  try {
    const file = join(folder, 'stimulus.csv');
    writeFileSync(file, asCsv(rows));
    return grafcet('trace', GRAPHS, '--stimulus', file).trimEnd().split('\n');
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** What the memory of the image holds after a scan, as a row of a trace. */
function rowReader(pico) {
  const { layout, graphs, variables, columns } = JSON.parse(grafcet('symbols', GRAPHS));
  const { address } = pico.symbol('PLC_STORAGE');
  return (timeMs) => {
    const bytes = pico.readBytes(address, 4 * (layout.words + layout.numbers));
    const words = new Uint32Array(bytes.buffer, bytes.byteOffset, layout.words);
    const numbers = new Int32Array(bytes.buffer, bytes.byteOffset + 4 * layout.words, layout.numbers);
    const isSet = (bit) => (words[bit >>> 5] >>> (bit & 31)) & 1;
    const situation = ({ steps }) => steps.filter(({ bit }) => isSet(bit)).map(({ id }) => id).join(' ');
    const value = ({ bit, number }) => (bit === undefined ? numbers[number] : isSet(bit));
    const named = columns.slice(1 + graphs.length).map((name) => value(variables[name]));
    return [timeMs, ...graphs.map(situation), ...named].join(',');
  };
}

function traceOnBoard(rows) {
  const pico = new Pico(image, { powered: false, recordEdges: false });
  const connect = (levels) => INPUTS.forEach(({ pin }, i) => pico.setInput(pin, levels[i]));
  const read = rowReader(pico);
  const trace = [JSON.parse(grafcet('symbols', GRAPHS)).columns.join(',')];
  let stored = false;
  pico.onStore('PLC_SCANS', () => (stored = true));
  connect(rows[0]);
  pico.powerOn();
  for (let scan = 0; scan < rows.length - 1; scan++) {
    // The start-up code also stores there, before scan 0 does.
    const completed = () => stored && pico.read32('PLC_SCANS') === scan + 1;
    assert.ok(pico.runUntil(completed, 1000), `scan ${scan} comes`);
    stored = false;
    trace.push(read(scan * PERIOD_MS));
    connect(rows[scan + 1]);
  }
  assert.deepEqual(pico.faults, []);
  return { trace, log: pico.takeLog().map(({ text }) => text) };
}

test('the trace of the board is the trace of x86, scan for scan', () => {
  const steps = new Set();
  for (const seed of [1, 2]) {
    const rows = stimulus(12_000, randomNumbers(seed));
    const onX86 = traceOnX86(rows);
    const { trace: onBoard, log } = traceOnBoard(rows);
    const differs = onX86.findIndex((row, i) => row !== onBoard[i]);
    assert.equal(onBoard[differs], onX86[differs], `seed ${seed}, row ${differs}`);
    assert.equal(onBoard.length, onX86.length);
    onX86.slice(1).forEach((row) => steps.add(row.split(',')[1]));
    assertLogTells(log, onX86);
  }
  assert.equal(steps.size, 11, 'every step has been active');
});

/** Each change of the situation has its line in the log, in order, and there is no further one. */
function assertLogTells(log, trace) {
  const situations = trace.slice(1).map((row) => row.split(',')[1]);
  const changes = situations.slice(1).flatMap((now, i) => (now === situations[i] ? [] : [`{${situations[i]}} -> {${now}}`]));
  const told = log.map((text) => /^LineSwitcher T\d+: (.*)$/.exec(text)?.[1]).filter(Boolean);
  assert.ok(changes.length > 50);
  assert.deepEqual(told, changes);
}
