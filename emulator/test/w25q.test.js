import assert from 'node:assert/strict';
import { test } from 'node:test';
import { W25q } from '../src/w25q.js';
import { FakeChip } from './support/fake-chip.js';

const MS = 1e6;

function setUp(seed) {
  const chip = new FakeChip();
  const flash = new W25q(chip.clock, { seed });
  /** One command on the bus. */
  const send = (...bytes) => {
    flash.select();
    const answers = bytes.map((byte) => flash.transfer(byte));
    flash.deselect();
    return answers;
  };
  const status = () => send(0x05, 0)[1];
  return { chip, flash, send, status };
}

test('a new flash is erased', () => {
  assert.ok(setUp().flash.bytes.every((byte) => byte === 0xff));
});

test('programming clears bits and never sets one', () => {
  const { flash, chip } = setUp();
  flash.program(0x1000, Uint8Array.of(0b1111_0000));
  chip.pass(MS);
  flash.program(0x1000, Uint8Array.of(0b1010_1010));
  assert.equal(flash.bytes[0x1000], 0b1010_0000);
});

test('an attempt to set a bit by programming is recorded, padding with 0xff is none', () => {
  const { flash } = setUp();
  flash.program(0x1000, Uint8Array.of(0x00, 0x00));
  assert.deepEqual(flash.violations, []);
  flash.program(0x1000, Uint8Array.of(0xff, 0x01));
  assert.deepEqual(flash.violations, [{ address: 0x1001, stored: 0, wanted: 1, timeNs: 0 }]);
});

test('erasing a sector takes 45 ms, sets its bits, counts its wear and leaves its neighbours', () => {
  const { flash, chip } = setUp();
  flash.bytes.fill(0);
  flash.erase(0x2345);
  assert.ok(flash.busy);
  chip.pass(45 * MS - 1);
  assert.ok(flash.busy);
  chip.pass(1);
  assert.ok(!flash.busy);
  assert.equal(flash.bytes[0x1fff], 0);
  assert.ok(flash.bytes.subarray(0x2000, 0x3000).every((byte) => byte === 0xff));
  assert.equal(flash.bytes[0x3000], 0);
  assert.deepEqual([flash.erases, flash.wear[1], flash.wear[2], flash.wear[3]], [1, 0, 1, 0]);
});

test('a flash can be as slow as its data sheet allows', () => {
  const { clock } = new FakeChip();
  const flash = new W25q(clock, { eraseMs: 400, programMs: 3 });
  assert.equal(flash.erase(0).endNs, 400 * MS);
  assert.equal(flash.program(0, Uint8Array.of(0)).endNs, 3 * MS);
});

test('programming takes 0.4 ms and wraps within its page', () => {
  const { flash, chip } = setUp();
  flash.program(0x10fe, Uint8Array.of(1, 2, 3));
  assert.deepEqual([flash.bytes[0x10fe], flash.bytes[0x10ff], flash.bytes[0x1000]], [1, 2, 3]);
  chip.pass(0.4 * MS);
  assert.ok(!flash.busy);
});

test('commands that write need write enable, which each of them uses up', () => {
  const { flash, chip, send, status } = setUp();
  send(0x02, 0, 0x10, 0, 0x55);
  assert.equal(flash.bytes[0x1000], 0xff);
  send(0x06);
  assert.equal(status(), 2);
  send(0x02, 0, 0x10, 0, 0x55);
  assert.equal(flash.bytes[0x1000], 0x55);
  assert.equal(status(), 1, 'busy, and no longer enabled');
  chip.pass(MS);
  send(0x20, 0, 0x10, 0);
  assert.equal(flash.bytes[0x1000], 0x55, 'erased without write enable');
  send(0x06);
  send(0x04);
  send(0x20, 0, 0x10, 0);
  assert.equal(flash.bytes[0x1000], 0x55, 'erased after write disable');
});

test('while busy it answers nothing but its status', () => {
  const { flash, send, status } = setUp();
  flash.bytes[0] = 0x12;
  assert.equal(send(0x03, 0, 0, 0, 0)[4], 0x12);
  flash.erase(0x1000);
  assert.equal(status() & 1, 1);
  assert.equal(send(0x03, 0, 0, 0, 0)[4], 0xff);
  send(0x06);
  assert.equal(status() & 2, 0);
});

test('it names itself', () => {
  const { flash, send } = setUp();
  assert.deepEqual(send(0x9f, 0, 0, 0).slice(1), [0xef, 0x40, 0x15]);
  assert.deepEqual(send(0x4b, 0, 0, 0, 0, ...new Array(8).fill(0)).slice(5), flash.uniqueId);
  assert.equal(send(0x35, 0)[1] & 2, 2, 'quad enable');
});

test('power that fails during an erase leaves a part erased, an edge in between, and the rest', () => {
  const { flash, chip } = setUp(5);
  flash.bytes.fill(0, 0x1000, 0x2000);
  flash.erase(0x1000);
  chip.pass(45 * MS * 0.25);
  const torn = flash.losePower();
  assert.equal(torn.fraction, 0.25);
  const sector = flash.bytes.subarray(0x1000, 0x2000);
  assert.ok(sector.subarray(0, 1024).every((byte) => byte === 0xff));
  const edge = sector.subarray(1024, 1024 + 64);
  assert.ok(edge.some((byte) => byte !== 0 && byte !== 0xff));
  assert.ok(sector.subarray(1024 + 64).every((byte) => byte === 0));
});

test('power that fails during a program leaves a prefix, one byte in between, and the rest', () => {
  const torn = (seed) => {
    const { flash, chip } = setUp(seed);
    flash.program(0x1000, new Uint8Array(100));
    chip.pass(0.2 * MS);
    assert.equal(flash.losePower().fraction, 0.5);
    return flash.bytes.slice(0x1000, 0x1100);
  };
  const page = torn(3);
  assert.ok(page.subarray(0, 50).every((byte) => byte === 0));
  assert.ok(page.subarray(51).every((byte) => byte === 0xff));
  assert.deepEqual(torn(3), page, 'the same seed tears alike');
  const between = new Set([1, 2, 3, 4, 5, 6].map((seed) => torn(seed)[50]));
  assert.ok(between.size > 1, 'seeds differ');
});

test('power that fails at the end of an operation tears nothing', () => {
  const { flash, chip } = setUp();
  flash.erase(0);
  chip.pass(45 * MS);
  assert.equal(flash.losePower(), null);
});

test('an operation that is refused leaves no trace', () => {
  const { flash } = setUp();
  flash.onOperation = ({ kind, number, length }) => {
    assert.deepEqual([kind, number, length], ['program', 1, 2]);
    return false;
  };
  assert.equal(flash.program(0, Uint8Array.of(0, 0)), null);
  assert.equal(flash.bytes[0], 0xff);
  assert.ok(!flash.busy);
});
