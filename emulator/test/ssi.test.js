import assert from 'node:assert/strict';
import { test } from 'node:test';
import { CHIP_SELECT, Ssi } from '../src/ssi.js';
import { W25q } from '../src/w25q.js';
import { FakeChip } from './support/fake-chip.js';

const CTRLR0 = 0x00;
const CTRLR1 = 0x04;
const SSIENR = 0x08;
const RXFLR = 0x24;
const SR = 0x28;
const DR0 = 0x60;

function setUp() {
  const chip = new FakeChip();
  const flash = new W25q(chip.clock);
  const mapped = [];
  const ssi = new Ssi(chip, flash, (on) => mapped.push(on));
  return { flash, ssi, mapped };
}

test('in serial mode each byte out brings one in', () => {
  const { ssi } = setUp();
  ssi.enterSerialMode();
  for (const byte of [0x9f, 0, 0, 0]) ssi.writeUint32(DR0, byte);
  assert.equal(ssi.readUint32(RXFLR), 4);
  assert.equal(ssi.readUint32(SR) & 8, 8);
  assert.deepEqual([0, 0, 0, 0].map(() => ssi.readUint32(DR0)), [0xff, 0xef, 0x40, 0x15]);
  assert.equal(ssi.readUint32(SR) & 8, 0);
});

test('software can hold chip select over many bytes', () => {
  const { ssi, flash } = setUp();
  flash.bytes.set([0xaa, 0xbb]);
  ssi.enterSerialMode();
  ssi.forceChipSelect(CHIP_SELECT.low);
  const exchange = (byte) => {
    ssi.writeUint32(DR0, byte);
    return ssi.readUint32(DR0);
  };
  [0x03, 0, 0, 0].forEach(exchange);
  assert.deepEqual([exchange(0), exchange(0)], [0xaa, 0xbb]);
  ssi.forceChipSelect(CHIP_SELECT.high);
  assert.ok(!flash.selected);
});

test('in EEPROM mode the bytes after the command are counted by CTRLR1', () => {
  const { ssi } = setUp();
  ssi.writeUint32(CTRLR0, (7 << 16) | (3 << 8));
  ssi.writeUint32(CTRLR1, 2);
  ssi.writeUint32(SSIENR, 1);
  ssi.writeUint32(DR0, 0x9f);
  assert.deepEqual([0, 0, 0].map(() => ssi.readUint32(DR0)), [0xef, 0x40, 0x15]);
});

test('flash is mapped while the interface is enabled in EEPROM mode, and only then', () => {
  const { ssi, mapped } = setUp();
  assert.equal(ssi.xip, false);
  ssi.enterXipMode();
  assert.equal(ssi.xip, true);
  ssi.enterSerialMode();
  assert.equal(ssi.xip, false);
  assert.deepEqual([mapped.includes(true), mapped.at(-1)], [true, false]);
});

test('while disabled it takes no data, and disabling drops what was received', () => {
  const { ssi } = setUp();
  ssi.writeUint32(DR0, 0x9f);
  ssi.enterSerialMode();
  assert.equal(ssi.readUint32(RXFLR), 0);
  ssi.writeUint32(DR0, 0x05);
  assert.equal(ssi.readUint32(RXFLR), 1);
  ssi.writeUint32(SSIENR, 0);
  assert.equal(ssi.readUint32(RXFLR), 0);
});
