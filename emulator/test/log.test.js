import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Pico } from '../src/pico.js';
import { echoingDefmtPrint } from './support/defmt-print.js';
import { image } from './support/image.js';
import { Program } from './support/programs.js';

const CONTROL = 0x2000_0000;
const BUFFER = 0x2000_0100;
const UP = CONTROL + 24;
const WRITE_OFFSET = UP + 12;

const word = (text) => Buffer.from(text.padEnd(4, '\0')).readUInt32LE();

/** Sets up RTT as firmware does, logs `one`, a millisecond later `two`, and begins a third line. */
function talker(t) {
  const program = new Program().tick().prepareSleep();
  ['SEGG', 'ER R', 'TT'].forEach((part, i) => program.put(CONTROL + 4 * i, word(part)));
  program.put(UP + 4, BUFFER).put(UP + 8, 64).put(BUFFER, word('one')).put(WRITE_OFFSET, 4).sleep(1000);
  program.put(BUFFER + 4, word('two')).put(WRITE_OFFSET, 10).stop();
  return image(t, program.bytes(), { _SEGGER_RTT: CONTROL });
}

function setUp(t) {
  const before = process.env.DEFMT_PRINT;
  process.env.DEFMT_PRINT = echoingDefmtPrint(t);
  t.after(() => {
    if (before === undefined) delete process.env.DEFMT_PRINT;
    else process.env.DEFMT_PRINT = before;
  });
  return new Pico(talker(t));
}

test('log lines carry the simulated time at which they were complete, and their boot', (t) => {
  const pico = setUp(t);
  pico.runFor(5);
  pico.powerCycle({ offMs: 15 });
  pico.runFor(5);
  assert.deepEqual(
    pico.log.map(({ text, boot, timeNs }) => [text, boot, Math.floor(timeNs / 1e6)]),
    [['one', 0, 0], ['two', 0, 1], ['one', 1, 20], ['two', 1, 21]],
  );
  assert.deepEqual([pico.log[0].level, pico.log[0].timeUs, pico.log[0].module], ['INFO', 1_000_002, 'plc::scan']);
});

test('a warm reset does not bring back what was read before', (t) => {
  const pico = setUp(t);
  pico.runFor(5);
  pico.runPin();
  pico.runFor(5);
  assert.deepEqual(pico.log.map(({ text }) => text), ['one', 'two', 'one', 'two']);
});

test('a run can wait for a line', (t) => {
  const pico = setUp(t);
  const line = pico.runUntilLog('two', 10);
  assert.equal(line.text, 'two');
  assert.ok(pico.timeNs - line.timeNs < 1000);
  assert.equal(pico.runUntilLog(/two/, 3), null, 'only new lines count');
});

test('the log can be taken away in pieces', (t) => {
  const pico = setUp(t);
  pico.runFor(0.5);
  assert.deepEqual(pico.takeLog().map(({ text }) => text), ['one']);
  pico.runFor(5);
  assert.deepEqual(pico.takeLog().map(({ text }) => text), ['two']);
  assert.deepEqual(pico.log, []);
});
