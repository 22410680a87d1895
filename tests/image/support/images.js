// The images that `script/inspect` built or was given.

import { readdirSync } from 'node:fs';
import { basename, join } from 'node:path';

import { readElf } from '../../../emulator/src/elf.js';

const { PLC_INSPECTED, PLC_BARE } = process.env;

/** Images for the Pico, the name of each with its ELF file. */
export function images() {
  return PLC_INSPECTED.split('\n').map((path) => ({ name: basename(path), elf: readElf(path) }));
}

/** Programs with the engine and nothing else, the same way; the one that panics is not among them. */
export function bareImages() {
  const names = readdirSync(PLC_BARE).filter((name) => name !== 'panicking');
  return names.sort().map((name) => ({ name, elf: bareImage(name) }));
}

export function bareImage(name) {
  return readElf(join(PLC_BARE, name));
}
