import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Timer } from '../src/timer.js';
import { FakeChip } from './support/fake-chip.js';

const TIMEHR = 0x08;
const TIMELR = 0x0c;
const ALARM0 = 0x10;
const ARMED = 0x20;
const TIMERAWL = 0x28;
const INTR = 0x34;
const INTE = 0x38;
const US = 1000;

function setUp(startUs) {
  const chip = new FakeChip();
  const timer = new Timer(chip, startUs);
  const write = (offset, value) => timer.writeUint32Atomic(offset, value, 0);
  return { chip, timer, write };
}

test('it counts microseconds from the first tick on', () => {
  const { chip, timer } = setUp();
  chip.pass(5500);
  assert.equal(timer.readUint32(TIMERAWL), 0);
  timer.start();
  chip.pass(2 * US - 1);
  assert.equal(timer.readUint32(TIMERAWL), 1);
  chip.pass(1);
  assert.equal(timer.readUint32(TIMERAWL), 2);
});

test('an alarm fires when the count reaches it, not a moment earlier', () => {
  const { chip, timer, write } = setUp();
  chip.pass(123);
  timer.start();
  write(INTE, 1);
  chip.pass(10_500);
  write(ALARM0, 20);
  assert.equal(timer.readUint32(ARMED), 1);
  chip.pass(9_499);
  assert.equal(timer.readUint32(INTR), 0);
  chip.pass(1);
  assert.equal(timer.readUint32(INTR), 1);
  assert.equal(timer.readUint32(TIMERAWL), 20);
  assert.ok(chip.interrupts.has(0));
  assert.equal(timer.readUint32(ARMED), 0);
  write(INTR, 1);
  assert.ok(!chip.interrupts.has(0));
});

test('an alarm that is disarmed does not fire', () => {
  const { chip, timer, write } = setUp();
  timer.start();
  write(ALARM0 + 4, 10);
  write(ARMED, 2);
  chip.pass(100 * US);
  assert.equal(timer.readUint32(INTR), 0);
});

test('an alarm in the past waits for the lower word to come round', () => {
  const { chip, timer, write } = setUp(100);
  timer.start();
  write(ALARM0, 99);
  chip.pass((2 ** 32 - 2) * US);
  assert.equal(timer.readUint32(INTR), 0);
  chip.pass(US);
  assert.equal(timer.readUint32(INTR), 1);
});

test('the lower word rolls over into the upper one, and reading the lower one latches it', () => {
  const { chip, timer, write } = setUp(2 ** 32 - 2);
  timer.start();
  write(ALARM0, 1);
  chip.pass(US);
  assert.equal(timer.readUint32(TIMELR), 0xffff_ffff);
  chip.pass(US);
  assert.equal(timer.readUint32(TIMEHR), 0, 'latched with the lower word');
  assert.equal(timer.readUint32(TIMELR), 0);
  assert.equal(timer.readUint32(TIMEHR), 1);
  assert.equal(timer.readUint32(INTR), 0);
  chip.pass(US);
  assert.equal(timer.readUint32(INTR), 1);
});

test('a leap sets off the alarms that it passes, and no other', () => {
  const { chip, timer, write } = setUp(2 ** 32 - 100);
  timer.start();
  write(INTE, 15);
  write(ALARM0, 50);
  write(ALARM0 + 4, 500);
  chip.pass(10 * US);
  timer.leap(400);
  chip.pass(0);
  assert.equal(timer.readUint32(INTR), 1);
  assert.equal(timer.readUint32(TIMERAWL), 310);
  chip.pass(190 * US - 1);
  assert.equal(timer.readUint32(INTR), 1);
  chip.pass(1);
  assert.equal(timer.readUint32(INTR), 3);
});

test('a leap of weeks keeps the fraction of a microsecond', () => {
  const { chip, timer } = setUp();
  timer.start();
  chip.pass(1_600);
  timer.leap(5_000 * 2 ** 32);
  chip.pass(400);
  assert.equal(timer.readUint32(TIMELR), 2);
  assert.equal(timer.readUint32(TIMEHR), 5_000);
});
