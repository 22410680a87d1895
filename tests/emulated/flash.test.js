/**
 * What `script/flash` brings onto a Pico's drive, decoded again and compared with the image.
 */
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { readElf } from '../../emulator/src/elf.js';

const TOP = fileURLToPath(new URL('../..', import.meta.url));
const IMAGE = process.env.PLC_IMAGE ?? join(process.env.CARGO_TARGET_DIR ?? 'target', 'thumbv6m-none-eabi/release/plc');

const FLASH = 0x1000_0000;
const FLASH_END = FLASH + 2 * 1024 * 1024;
const BLOCK = 512;
const PAGE = 256;
const SECTOR = 4096;
const RP2040 = 0xe48b_ff56;

/** Runs the script as a person does, from the top. */
function flash(...args) {
  const { status, stdout, stderr } = spawnSync('script/flash', args, { cwd: TOP, encoding: 'utf8' });
  return { status, stdout, stderr };
}

/** The blocks of a UF2 file: https://github.com/microsoft/uf2, "File format". */
function blocksOf(bytes) {
  assert.equal(bytes.length % BLOCK, 0);
  return Array.from({ length: bytes.length / BLOCK }, (_, index) => {
    const block = bytes.subarray(index * BLOCK, (index + 1) * BLOCK);
    const word = (at) => block.readUInt32LE(at);
    assert.deepEqual([word(0), word(4), word(BLOCK - 4)], [0x0a32_4655, 0x9e5d_5157, 0x0ab1_6f30], 'magic numbers');
    return {
      flags: word(8),
      address: word(12),
      size: word(16),
      number: word(20),
      count: word(24),
      family: word(28),
      data: block.subarray(32, 32 + word(16)),
    };
  });
}

let blocks;
let elf;

before(() => {
  const drive = mkdtempSync(join(tmpdir(), 'pico-'));
  try {
    const { status, stderr } = flash('--drive', drive);
    assert.equal(status, 0, stderr);
    blocks = blocksOf(readFileSync(join(drive, 'plc.uf2')));
  } finally {
    rmSync(drive, { recursive: true });
  }
  elf = readElf(resolve(TOP, IMAGE));
});

test('every block is for the RP2040, and they are counted', () => {
  assert.ok(blocks.length > 0);
  for (const [index, block] of blocks.entries()) {
    assert.equal(block.flags, 0x2000, 'only the family is given');
    assert.equal(block.family, RP2040);
    assert.equal(block.size, PAGE);
    assert.equal(block.address % PAGE, 0);
    assert.equal(block.number, index);
    assert.equal(block.count, blocks.length);
  }
});

test('decoded again it is what the image loads into flash, byte for byte, and nothing else', () => {
  const decoded = new Map(blocks.map((block) => [block.address, Buffer.from(block.data)]));
  assert.equal(decoded.size, blocks.length, 'no page twice');
  const expected = new Map([...decoded.keys()].map((address) => [address, Buffer.alloc(PAGE)]));
  const segments = elf.segments.filter(({ address }) => address >= FLASH && address < FLASH_END);
  for (const { address, bytes } of segments) {
    bytes.forEach((byte, at) => {
      const page = expected.get((address + at) - ((address + at) % PAGE));
      assert.ok(page, `no block for ${(address + at).toString(16)}`);
      page[(address + at) % PAGE] = byte;
    });
  }
  assert.deepEqual(decoded, expected);
});

test('the boot ROM finds whole sectors, up to the last one', () => {
  const addresses = blocks.map((block) => block.address);
  assert.equal(addresses[0], FLASH);
  const last = addresses.at(-1);
  const sectors = new Set(addresses.map((address) => address - (address % SECTOR)));
  for (const sector of sectors) {
    for (let page = sector; page < Math.min(sector + SECTOR, last); page += PAGE) {
      assert.ok(addresses.includes(page), page.toString(16));
    }
  }
});

test('the retain area is not touched', () => {
  const { address: length } = elf.symbols.get('RETAIN_LENGTH');
  assert.ok(length >= 4 * SECTOR);
  for (const { address } of blocks) assert.ok(address + PAGE <= FLASH_END - length, address.toString(16));
});

test('--help teaches and succeeds', () => {
  const { status, stdout } = flash('--help');
  assert.equal(status, 0);
  for (const word of ['Usage:', '--probe', '--drive DIRECTORY', 'BOOTSEL', 'PLC=']) assert.ok(stdout.includes(word), word);
});

test('an unknown argument and a drive that is not there are refused before anything is built', () => {
  for (const [args, message] of [
    [['--usb'], /unknown argument --usb/],
    [['--drive'], /--drive needs a directory/],
    [['--drive', '/nowhere'], /--drive needs a directory, not `\/nowhere`/],
  ]) {
    const { status, stderr } = flash(...args);
    assert.equal(status, 2, stderr);
    assert.match(stderr, message);
    assert.doesNotMatch(stderr, /building/);
  }
});
