import assert from 'node:assert/strict';
import { test } from 'node:test';
import { buildBootRom, crc32, ROM_FUNCTIONS } from '../src/bootrom.js';

const rom = new DataView(buildBootRom().buffer);
const half = (address) => rom.getUint16(address, true);

/** As firmware does it: the table's address at 0x14, pairs of code and address, 0 at the end. */
function lookUp(code) {
  const wanted = code.charCodeAt(0) | (code.charCodeAt(1) << 8);
  for (let entry = half(0x14); half(entry); entry += 4) if (half(entry) === wanted) return half(entry + 2);
  return 0;
}

test('the ROM is 16 kB and carries the mark and version that firmware checks', () => {
  assert.equal(rom.byteLength, 16 * 1024);
  assert.deepEqual([0x10, 0x11, 0x12, 0x13].map((at) => rom.getUint8(at)), [0x4d, 0x75, 1, 2]);
});

test('each function is found in the table: a breakpoint of its own, then a return', () => {
  const numbers = Object.keys(ROM_FUNCTIONS).map((code) => {
    const address = lookUp(code);
    assert.equal(address & 1, 1, `${code} is no Thumb address`);
    assert.equal(half(address - 1) & 0xff00, 0xbe00);
    assert.equal(half(address + 1), 0x4770);
    return half(address - 1) & 0xff;
  });
  assert.equal(new Set(numbers).size, numbers.length);
  for (const code of ['IF', 'EX', 'RE', 'RP', 'FC']) assert.notEqual(lookUp(code), 0, code);
});

test('a function that is not there is not found', () => {
  assert.equal(lookUp('??'), 0);
  assert.equal(half(half(0x16)), 0, 'the data table is empty');
});

test('the vector table leads into the ROM', () => {
  assert.equal(rom.getUint32(0, true), 0x2004_1f00);
  for (const vector of [4, 8, 12]) {
    const address = rom.getUint32(vector, true);
    assert.equal(address & 1, 1);
    assert.equal(half(address - 1) & 0xff00, 0xbe00);
  }
});

test('the checksum is CRC-32/MPEG-2', () => {
  assert.equal(crc32(Buffer.from('123456789')), 0x0376_e6e7);
});
