/** Images made for one test: programs that run in place of the second-stage bootloader. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { crc32 } from '../../src/bootrom.js';

const BOOT2_CODE_SIZE = 252;
const HEADER = 52;
const PROGRAM_HEADER = 32;
const SECTION_HEADER = 40;
const SYMBOL = 16;

/** A flash page that the boot ROM accepts, with a program of at most 252 bytes. */
export function boot2(program) {
  if (program.length > BOOT2_CODE_SIZE) throw new Error(`${program.length} bytes are too many`);
  const page = new Uint8Array(256);
  page.set(program);
  new DataView(page.buffer).setUint32(BOOT2_CODE_SIZE, crc32(page.subarray(0, BOOT2_CODE_SIZE)), true);
  return page;
}

/**
 * An ELF file as a linker would write it.
 * @param {{address: number, bytes: Uint8Array}[]} segments
 * @param {Record<string, number>} [symbols] addresses by name
 */
export function elfFile(segments, symbols = {}) {
  const names = ['', ...Object.keys(symbols)];
  const strings = Buffer.from(`${names.join('\0')}\0`, 'latin1');
  let end = HEADER + segments.length * PROGRAM_HEADER;
  const places = segments.map(({ bytes }) => (end += bytes.length) - bytes.length);
  const symbolsAt = end;
  const stringsAt = symbolsAt + names.length * SYMBOL;
  const sectionsAt = stringsAt + strings.length;
  const file = Buffer.alloc(sectionsAt + 3 * SECTION_HEADER);
  const put = (at, ...words) => words.forEach((word, i) => file.writeUInt32LE(word >>> 0, at + 4 * i));

  file.set([0x7f, 0x45, 0x4c, 0x46, 1, 1, 1]);
  put(16, 2 | (40 << 16), 1, 0, HEADER, sectionsAt, 0, HEADER | (PROGRAM_HEADER << 16));
  put(44, segments.length | (SECTION_HEADER << 16), 3);
  segments.forEach(({ address, bytes }, i) => {
    put(HEADER + i * PROGRAM_HEADER, 1, places[i], address, address, bytes.length, bytes.length);
    file.set(bytes, places[i]);
  });
  names.forEach((name, i) => {
    const nameAt = name ? strings.indexOf(`\0${name}\0`, 0, 'latin1') + 1 : 0;
    put(symbolsAt + i * SYMBOL, nameAt, symbols[name] ?? 0, 4);
  });
  file.set(strings, stringsAt);
  put(sectionsAt + SECTION_HEADER, 0, 2, 0, 0, symbolsAt, names.length * SYMBOL, 2);
  put(sectionsAt + 2 * SECTION_HEADER, 0, 3, 0, 0, stringsAt, strings.length);
  return file;
}

/** A file in a folder of its own, gone when the test is over. @returns {string} its path */
export function temporaryFile(test, name, contents) {
  const folder = mkdtempSync(join(tmpdir(), 'pico-'));
  test.after(() => rmSync(folder, { recursive: true }));
  const path = join(folder, name);
  if (contents) writeFileSync(path, contents);
  return path;
}

/** The path of an image that runs `program`. */
export function image(test, program, symbols) {
  const segments = [{ address: 0x1000_0000, bytes: boot2(program) }];
  return temporaryFile(test, 'test.elf', elfFile(segments, symbols));
}
