import assert from 'node:assert/strict';
import { test } from 'node:test';
import { INTERRUPT, Pl011 } from '../src/pl011.js';
import { FakeChip } from './support/fake-chip.js';

const DR = 0x00;
const FR = 0x18;
const IBRD = 0x24;
const FBRD = 0x28;
const LCR_H = 0x2c;
const CR = 0x30;
const IFLS = 0x34;
const IMSC = 0x38;
const RIS = 0x3c;
const MIS = 0x40;
const ICR = 0x44;
const DMACR = 0x48;
const FR_BUSY = 0x08;
const FR_RX_EMPTY = 0x10;
const FR_TX_FULL = 0x20;
const FR_RX_FULL = 0x40;
const FR_TX_EMPTY = 0x80;
const IRQ = 20;
/** One character at 115 200 baud, 8N1, with the divisors that drivers use. */
const CHARACTER_NS = Math.ceil((10 * 16e9 * (67 + 52 / 64)) / 125e6);
const BIT_NS = CHARACTER_NS / 10;

function setUp({ fifos = true } = {}) {
  const chip = new FakeChip();
  const uart = new Pl011(chip, 'UART0', IRQ, { tx: 20, rx: 21 });
  const sent = [];
  uart.onByte = (byte) => sent.push(byte);
  const write = (offset, value) => uart.writeUint32Atomic(offset, value, 0);
  write(IBRD, 67);
  write(FBRD, 52);
  write(LCR_H, 0x60 | (fifos ? 0x10 : 0));
  write(CR, 0x301);
  const raw = () => uart.readUint32(RIS);
  const flags = () => uart.readUint32(FR);
  return { chip, uart, sent, write, raw, flags };
}

test('a byte takes its time on the line', () => {
  const { chip, sent, write, flags } = setUp();
  write(DR, 0x41);
  assert.equal(flags() & FR_BUSY, FR_BUSY);
  chip.pass(CHARACTER_NS - 1);
  assert.deepEqual(sent, []);
  chip.pass(1);
  assert.deepEqual(sent, [0x41]);
  assert.equal(flags() & (FR_BUSY | FR_TX_EMPTY), FR_TX_EMPTY);
});

test('the baud rate follows the divisors', () => {
  assert.ok(Math.abs(setUp().uart.baud - 115_200) < 10);
});

test('the transmit FIFO holds 32 bytes behind the one on the line, and drops the rest', () => {
  const { chip, sent, write, flags } = setUp();
  for (let i = 0; i < 33; i++) write(DR, i);
  assert.equal(flags() & FR_TX_FULL, FR_TX_FULL);
  write(DR, 99);
  chip.pass(40 * CHARACTER_NS);
  assert.deepEqual(sent, Array.from({ length: 33 }, (_, i) => i));
});

test('without FIFOs there is room for one byte', () => {
  const { write, flags } = setUp({ fifos: false });
  write(DR, 1);
  assert.equal(flags() & FR_TX_FULL, 0);
  write(DR, 2);
  assert.equal(flags() & FR_TX_FULL, FR_TX_FULL);
});

test('the transmit interrupt comes when the FIFO sinks to its level, not before and not again', () => {
  const { chip, write, raw } = setUp();
  write(IFLS, 0x12 & ~7); // transmit at 1/8: four bytes
  write(IMSC, INTERRUPT.tx);
  for (let i = 0; i < 8; i++) write(DR, i);
  chip.pass(3 * CHARACTER_NS - 1);
  assert.equal(raw() & INTERRUPT.tx, 0);
  chip.pass(1);
  assert.equal(raw() & INTERRUPT.tx, INTERRUPT.tx);
  assert.ok(chip.interrupts.has(IRQ));
  write(ICR, INTERRUPT.tx);
  assert.ok(!chip.interrupts.has(IRQ));
  chip.pass(20 * CHARACTER_NS);
  assert.equal(raw() & INTERRUPT.tx, 0, 'clearing it raised it again');
});

test('the receive interrupt comes when the FIFO fills to its level, and goes when it is read', () => {
  const { chip, uart, write, raw } = setUp();
  write(IFLS, 0 << 3); // receive at 1/8: four bytes
  for (let i = 0; i < 4; i++) uart.feedByte(0x30 + i);
  chip.pass(3 * CHARACTER_NS);
  assert.equal(raw() & INTERRUPT.rx, 0);
  chip.pass(CHARACTER_NS);
  assert.equal(raw() & INTERRUPT.rx, INTERRUPT.rx);
  assert.equal(uart.readUint32(DR), 0x30);
  assert.equal(raw() & INTERRUPT.rx, 0);
});

test('a few bytes and then silence give the receive time-out after 32 bits', () => {
  const { chip, uart, write, raw } = setUp();
  write(IMSC, INTERRUPT.rxTimeout);
  uart.feedByte(1);
  chip.pass(CHARACTER_NS + 31 * BIT_NS);
  assert.equal(raw() & INTERRUPT.rxTimeout, 0);
  chip.pass(2 * BIT_NS);
  assert.equal(uart.readUint32(MIS), INTERRUPT.rxTimeout);
  assert.ok(chip.interrupts.has(IRQ));
  uart.readUint32(DR);
  assert.equal(raw() & INTERRUPT.rxTimeout, 0);
  assert.ok(!chip.interrupts.has(IRQ));
});

test('bytes that keep coming put the time-out off', () => {
  const { chip, uart, raw } = setUp();
  for (let i = 0; i < 6; i++) {
    uart.feedByte(i);
    chip.pass(CHARACTER_NS + 15 * BIT_NS);
    assert.equal(raw() & INTERRUPT.rxTimeout, 0);
  }
  chip.pass(17 * BIT_NS);
  assert.equal(raw() & INTERRUPT.rxTimeout, INTERRUPT.rxTimeout);
});

test('the byte after an overrun says so', () => {
  const { chip, uart, raw, flags } = setUp();
  for (let i = 0; i < 34; i++) uart.feedByte(i);
  chip.pass(34 * CHARACTER_NS);
  assert.equal(flags() & FR_RX_FULL, FR_RX_FULL);
  assert.equal(raw() & INTERRUPT.overrun, INTERRUPT.overrun);
  for (let i = 0; i < 32; i++) assert.equal(uart.readUint32(DR), i);
  assert.equal(flags() & FR_RX_EMPTY, FR_RX_EMPTY);
  uart.feedByte(7);
  chip.pass(CHARACTER_NS);
  assert.equal(uart.readUint32(DR), 0x800 | 7);
});

test('a receiver that is off hears nothing', () => {
  const { chip, uart, write, flags } = setUp();
  write(CR, 0x101);
  uart.feedByte(1);
  chip.pass(2 * CHARACTER_NS);
  assert.equal(flags() & FR_RX_EMPTY, FR_RX_EMPTY);
});

test('the DMA is asked for bytes while there is room, and offered those that are there', () => {
  const { chip, uart, write } = setUp();
  assert.equal(chip.requests.size, 0);
  write(DMACR, 3);
  assert.deepEqual([...chip.requests], [20]);
  for (let i = 0; i < 33; i++) write(DR, i);
  assert.deepEqual([...chip.requests], []);
  uart.feedByte(1);
  chip.pass(CHARACTER_NS);
  assert.ok(chip.requests.has(21));
  uart.readUint32(DR);
  assert.ok(!chip.requests.has(21));
});
