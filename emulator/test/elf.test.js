import assert from 'node:assert/strict';
import { test } from 'node:test';
import { parseElf, readElf } from '../src/elf.js';
import { UsageError } from '../src/fault.js';
import { elfFile } from './support/image.js';

const SEGMENTS = [
  { address: 0x1000_0000, bytes: Uint8Array.of(1, 2, 3, 4) },
  { address: 0x1000_0100, bytes: Uint8Array.of(5, 6) },
];

function refuses(bytes, reason) {
  assert.throws(
    () => parseElf(bytes, 'some.elf'),
    (error) => error instanceof UsageError && error.message.startsWith('some.elf is not') && reason.test(error.message),
  );
}

test('segments come with their load addresses, symbols with their names', () => {
  const elf = parseElf(elfFile(SEGMENTS, { _SEGGER_RTT: 0x2000_1234, other: 8 }), 'some.elf');
  assert.deepEqual(
    elf.segments.map(({ address, bytes }) => [address, [...bytes]]),
    [[0x1000_0000, [1, 2, 3, 4]], [0x1000_0100, [5, 6]]],
  );
  assert.deepEqual(elf.symbols.get('_SEGGER_RTT'), { address: 0x2000_1234, size: 4 });
  assert.equal(elf.symbols.get('other').address, 8);
});

test('a missing file is told by its name', () => {
  assert.throws(() => readElf('/no/such/file'), { name: 'Error', message: 'cannot read /no/such/file: no such file' });
});

test('what is no ELF file is refused', () => {
  refuses(Buffer.alloc(0), /does not start like/);
  refuses(Buffer.from('UF2\n'.repeat(64)), /does not start like/);
});

test('an ELF file for another machine is refused', () => {
  const wide = elfFile(SEGMENTS);
  wide[4] = 2;
  refuses(wide, /32-bit/);
  const foreign = elfFile(SEGMENTS);
  foreign.writeUInt16LE(243, 18);
  refuses(foreign, /Arm/);
});

test('an ELF file that ends early is refused wherever it ends', () => {
  const whole = elfFile(SEGMENTS, { symbol: 1 });
  for (let length = 52; length < whole.length; length++) refuses(whole.subarray(0, length), /cut short/);
});

test('an ELF file with nothing to load is refused', () => {
  refuses(elfFile([]), /nothing to load/);
});
