import assert from 'node:assert/strict';
import { test } from 'node:test';
import { UsageError } from '../src/fault.js';
import { Pico } from '../src/pico.js';
import { image } from './support/image.js';
import { Program } from './support/programs.js';

const SECTOR = 0x8000;
const SRAM = 0x2000_0000;
const MS = 1e6;

/** Erases a sector, programs a page of it with what is in memory, then raises pin 2. */
function writer(t) {
  return image(t, new Program().output(2).erase(SECTOR).program(SECTOR, SRAM).high(2).stop().bytes());
}

/** A board whose sector is full of zeros before it starts. */
function setUp(t, options) {
  const flash = new Uint8Array(2 * 1024 * 1024).fill(0xff);
  flash.fill(0, SECTOR, SECTOR + 4096);
  return new Pico(writer(t), { flash, ...options });
}

const sector = (pico) => pico.flash.bytes.subarray(SECTOR, SECTOR + 4096);
const erased = (bytes) => bytes.every((byte) => byte === 0xff);
const untouched = (bytes) => bytes.every((byte) => byte === 0);

test('without a cut the sector is erased and the page is programmed', (t) => {
  const pico = setUp(t);
  const done = pico.runUntilEdge({ pin: 2, level: 1 }, 100);
  assert.ok(done.timeNs >= 45.4 * MS && done.timeNs < 45.5 * MS);
  assert.deepEqual([pico.flash.erases, pico.flash.programs], [1, 1]);
  assert.deepEqual(sector(pico).slice(0, 256), pico.readBytes(SRAM, 256));
  assert.ok(erased(sector(pico).subarray(256)));
});

test('a cut before an operation leaves the flash untouched', (t) => {
  const pico = setUp(t);
  pico.cutPower({ flashOperation: 1, moment: 'before', offMs: Infinity });
  pico.runFor(100);
  assert.equal(pico.powered, false);
  assert.ok(untouched(sector(pico)));
  assert.equal(pico.powerCuts[0].torn, null);
  assert.ok(pico.powerCuts[0].timeNs < MS);
});

test('a cut during an erase leaves the sector torn where the plan says', (t) => {
  const pico = setUp(t);
  pico.cutPower({ flashOperation: 1, fraction: 0.5, offMs: Infinity });
  pico.runFor(100);
  const [{ torn, timeNs }] = pico.powerCuts;
  assert.deepEqual([torn.kind, torn.fraction, timeNs], ['erase', 0.5, torn.startNs + 22.5 * MS]);
  assert.ok(erased(sector(pico).subarray(0, 2048)));
  assert.ok(untouched(sector(pico).subarray(2048 + 64)));
  assert.equal(pico.level(2), 0);
});

test('a cut just after an erase leaves it whole, and the program does not begin', (t) => {
  const pico = setUp(t);
  pico.cutPower({ flashOperation: 1, moment: 'after', offMs: Infinity });
  pico.runFor(100);
  assert.ok(erased(sector(pico)));
  assert.deepEqual([pico.powerCuts[0].torn, pico.flash.programs], [null, 0]);
});

test('a cut can wait for an operation of one kind', (t) => {
  const pico = setUp(t);
  pico.cutPower({ flashOperation: 1, kind: 'program', fraction: 0.25, offMs: Infinity });
  pico.runFor(100);
  assert.deepEqual([pico.powerCuts[0].torn.kind, pico.flash.erases], ['program', 1]);
  assert.ok(erased(sector(pico).subarray(65)));
});

test('a cut at a time tears what the flash is doing then', (t) => {
  const pico = setUp(t);
  pico.cutPower({ atMs: 20 });
  pico.runTo(20);
  assert.equal(pico.powerCuts[0].torn.kind, 'erase');
  assert.equal(pico.powerCuts[0].timeNs, 20 * MS);
  assert.equal(pico.driven(2), false);
});

test('power comes back by itself, and the firmware starts anew', (t) => {
  const pico = setUp(t);
  pico.cutPower({ flashOperation: 2, offMs: 30 });
  pico.runFor(200);
  assert.deepEqual(pico.boots.map(({ cause }) => cause), ['power-on', 'power-on']);
  assert.equal(pico.boots[1].timeNs, pico.powerCuts[0].timeNs + 30 * MS);
  assert.equal(pico.level(2), 1, 'the second run reached its end');
});

test('equal seeds tear alike, others do not', (t) => {
  const torn = (seed) => {
    const pico = setUp(t, { seed });
    pico.cutPower({ flashOperation: 1, offMs: Infinity });
    pico.runFor(100);
    return [pico.powerCuts[0].torn.fraction, Buffer.from(sector(pico)).toString('hex')];
  };
  assert.deepEqual(torn(4), torn(4));
  assert.notDeepEqual(torn(4), torn(5));
});

test('a watchdog that fires during an erase tears nothing: the flash has power', (t) => {
  const program = new Program().output(2).tick().watchdog(10_000).erase(SECTOR).stop();
  const flash = new Uint8Array(2 * 1024 * 1024);
  const pico = new Pico(image(t, program.bytes()), { flash });
  pico.runUntil(() => pico.boots.length > 1, 20);
  assert.equal(pico.boots[1].cause, 'watchdog');
  assert.ok(erased(sector(pico)));
  const { timeNs } = pico.runUntilEdge({ pin: 2, level: 0 }, 100);
  assert.ok(timeNs >= 45 * MS, 'the boot ROM waits until the flash answers');
  assert.ok(timeNs < 45.01 * MS);
});

test('cuts that wait for the flash can be called off', (t) => {
  const pico = setUp(t);
  pico.cutPower({ flashOperation: 1 });
  pico.cancelCuts();
  pico.runFor(100);
  assert.deepEqual(pico.powerCuts, []);
});

test('a plan that makes no sense is refused', (t) => {
  const pico = setUp(t);
  for (const plan of [
    {},
    { atMs: 1, flashOperation: 1 },
    { flashOperation: 0 },
    { flashOperation: 1, moment: 'sometime' },
    { flashOperation: 1, kind: 'read' },
    { flashOperation: 1, fraction: 1 },
    { atMs: -1 },
    { atMs: 1, offMs: -1 },
  ]) {
    assert.throws(() => pico.cutPower(plan), UsageError, JSON.stringify(plan));
  }
});
