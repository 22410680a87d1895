import assert from 'node:assert/strict';
import { test } from 'node:test';
import { REASON_BITS, Watchdog } from '../src/watchdog.js';
import { FakeChip } from './support/fake-chip.js';

const CTRL = 0x00;
const LOAD = 0x04;
const REASON = 0x08;
const SCRATCH0 = 0x0c;
const TICK = 0x2c;
const ENABLE = 1 << 30;
const TICK_1MHZ = (1 << 9) | 12;
const US = 1000;

function setUp({ reason = REASON_BITS.none, scratch = new Uint32Array(8), ticking = true } = {}) {
  const chip = new FakeChip();
  const resets = [];
  let ticks = 0;
  const watchdog = new Watchdog(chip, {
    reason,
    scratch,
    onReset: (why) => resets.push([why, chip.clock.nanos]),
    onTick: () => ticks++,
  });
  const write = (offset, value) => watchdog.writeUint32Atomic(offset, value, 0);
  if (ticking) write(TICK, TICK_1MHZ);
  return { chip, watchdog, resets, write, ticks: () => ticks };
}

test('it counts down by two in each microsecond and then resets the chip', () => {
  const { chip, watchdog, resets, write } = setUp();
  write(LOAD, 2000);
  write(CTRL, ENABLE);
  chip.pass(400 * US);
  assert.equal(watchdog.readUint32(CTRL) & 0xff_ffff, 1200);
  chip.pass(600 * US - 1);
  assert.deepEqual(resets, []);
  chip.pass(1);
  assert.deepEqual(resets, [[REASON_BITS.timer, 1000 * US]]);
});

test('feeding it puts the reset off', () => {
  const { chip, resets, write } = setUp();
  write(LOAD, 2000);
  write(CTRL, ENABLE);
  for (let i = 0; i < 5; i++) {
    chip.pass(900 * US);
    write(LOAD, 2000);
  }
  chip.pass(999 * US);
  assert.deepEqual(resets, []);
});

test('after it has fired it is still, until it is loaded again', () => {
  const { chip, resets, write } = setUp();
  write(LOAD, 2);
  write(CTRL, ENABLE);
  chip.pass(1000 * US);
  assert.equal(resets.length, 1);
});

test('disabled, or without a tick, it does not count', () => {
  const disabled = setUp();
  disabled.write(LOAD, 2);
  disabled.chip.pass(1000 * US);
  assert.deepEqual(disabled.resets, []);

  const tickless = setUp({ ticking: false });
  tickless.write(LOAD, 2);
  tickless.write(CTRL, ENABLE);
  tickless.chip.pass(1000 * US);
  assert.deepEqual(tickless.resets, []);
  tickless.write(TICK, TICK_1MHZ);
  assert.equal(tickless.ticks(), 1);
  tickless.chip.pass(US);
  assert.deepEqual(tickless.resets, [[REASON_BITS.timer, 1001 * US]]);
});

test('firmware can force a reset', () => {
  const { resets, write } = setUp();
  write(CTRL, 2 ** 31);
  assert.deepEqual(resets, [[REASON_BITS.force, 0]]);
});

test('it tells what came through the reset', () => {
  const scratch = Uint32Array.from({ length: 8 }, (_, i) => 0xdead_0000 + i);
  const { watchdog, write } = setUp({ reason: REASON_BITS.timer, scratch });
  assert.equal(watchdog.readUint32(REASON), 1);
  assert.equal(watchdog.readUint32(SCRATCH0 + 12), 0xdead_0003);
  write(SCRATCH0 + 12, 42);
  assert.equal(watchdog.readUint32(SCRATCH0 + 12), 42);
  assert.equal(scratch[3], 0xdead_0003, 'it has words of its own');
});
