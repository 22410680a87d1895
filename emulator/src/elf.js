/**
 * Reads what the emulator needs of an ELF file for 32-bit Arm: what is to be flashed, and where the
 * symbols are.
 */
import { readFileSync } from 'node:fs';
import { UsageError } from './fault.js';

const HEADER_SIZE = 52;
const PROGRAM_HEADER_SIZE = 32;
const SECTION_HEADER_SIZE = 40;
const SYMBOL_SIZE = 16;
const MACHINE_ARM = 40;
const LOADABLE = 1;
const SYMBOL_TABLE = 2;

/**
 * @typedef {object} Elf
 * @property {string} path
 * @property {{address: number, bytes: Uint8Array}[]} segments by load address
 * @property {Map<string, {address: number, size: number}>} symbols
 */

/**
 * @param {string} path
 * @returns {Elf}
 * @throws {UsageError} if the file cannot be read or is not such an ELF file
 */
export function readElf(path) {
  let bytes;
  try {
    bytes = readFileSync(path);
  } catch (error) {
    throw new UsageError(`cannot read ${path}: ${error.code === 'ENOENT' ? 'no such file' : error.message}`);
  }
  return parseElf(bytes, path);
}

/**
 * @param {Uint8Array} bytes
 * @param {string} path for messages
 * @returns {Elf}
 */
export function parseElf(bytes, path) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  const bad = (reason) => new UsageError(`${path} is not a firmware image: ${reason}`);
  if (bytes.length < HEADER_SIZE || view.getUint32(0, false) !== 0x7f45_4c46) {
    throw bad('it does not start like an ELF file');
  }
  if (bytes[4] !== 1 || bytes[5] !== 1) throw bad('it is not a 32-bit little-endian ELF file');
  if (view.getUint16(18, true) !== MACHINE_ARM) throw bad('it is not for an Arm processor');
  try {
    const segments = readSegments(bytes, view);
    if (!segments.length) throw bad('it contains nothing to load');
    return { path, segments, symbols: readSymbols(bytes, view) };
  } catch (error) {
    if (error instanceof RangeError) throw bad('it is cut short');
    throw error;
  }
}

function readSegments(bytes, view) {
  const segments = [];
  for (const at of table(view, 28, 42, 44, PROGRAM_HEADER_SIZE)) {
    const size = view.getUint32(at + 16, true);
    if (view.getUint32(at, true) !== LOADABLE || size === 0) continue;
    const address = view.getUint32(at + 12, true);
    segments.push({ address, bytes: part(bytes, view.getUint32(at + 4, true), size) });
  }
  return segments;
}

function readSymbols(bytes, view) {
  const sections = [...table(view, 32, 46, 48, SECTION_HEADER_SIZE)].map((at) => ({
    type: view.getUint32(at + 4, true),
    offset: view.getUint32(at + 16, true),
    size: view.getUint32(at + 20, true),
    link: view.getUint32(at + 24, true),
  }));
  const symbols = new Map();
  for (const section of sections.filter(({ type }) => type === SYMBOL_TABLE)) {
    const strings = sections[section.link];
    if (!strings) throw new RangeError('no string table');
    const names = part(bytes, strings.offset, strings.size);
    const end = section.offset + section.size;
    for (let at = section.offset; at + SYMBOL_SIZE <= end; at += SYMBOL_SIZE) {
      const name = stringAt(names, view.getUint32(at, true));
      if (!name) continue;
      symbols.set(name, { address: view.getUint32(at + 4, true), size: view.getUint32(at + 8, true) });
    }
  }
  return symbols;
}

/** The offsets of a header table's entries, given where the ELF header keeps its place, size and count. */
function* table(view, placeAt, sizeAt, countAt, leastSize) {
  const place = view.getUint32(placeAt, true);
  const size = view.getUint16(sizeAt, true);
  const count = view.getUint16(countAt, true);
  if (count && size < leastSize) throw new RangeError('entries too small');
  if (count && place + count * size > view.byteLength) throw new RangeError('beyond the end');
  for (let i = 0; i < count; i++) yield place + i * size;
}

function part(bytes, offset, size) {
  if (offset + size > bytes.length) throw new RangeError('beyond the end');
  return bytes.subarray(offset, offset + size);
}

function stringAt(bytes, offset) {
  const end = bytes.indexOf(0, offset);
  return Buffer.from(bytes.subarray(offset, end < 0 ? bytes.length : end)).toString('latin1');
}
