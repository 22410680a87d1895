// An image shows nothing of the machine and of the day that built it. That two builds are the same, byte by byte, is
// shown by `script/reproduce`, which takes minutes.

import assert from 'node:assert/strict';
import { homedir, hostname } from 'node:os';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { digest, occurring } from './support/content.js';
import { images } from './support/images.js';

const { CARGO_HOME, CARGO_TARGET_DIR } = process.env;

/** This checkout, what is around it, and other places that a compiler comes by. */
const PLACES = [
  fileURLToPath(new URL('../..', import.meta.url)),
  `${homedir()}/`,
  CARGO_HOME,
  CARGO_TARGET_DIR,
  '/home/',
  '/Users/',
  ':\\Users\\',
].filter(Boolean);

/** Today, as compilers write it. */
function today() {
  const [, day, month, year] = new Date().toUTCString().split(' ');
  return [new Date().toISOString().slice(0, 10), `${month} ${day} ${year}`, `${day} ${month} ${year}`];
}

for (const { name, elf } of images()) {
  test(`${name} shows no place of the machine that built it, and no date`, () => {
    assert.deepEqual(occurring(elf, [...PLACES, ...today()]), []);
    // A short host name is found in any image.
    if (hostname().length >= 8) assert.deepEqual(occurring(elf, [hostname()]), []);
  });

  test(`a place in ${name} would be found, and would change what reaches the flash`, () => {
    const at = elf.segments.findIndex(({ bytes }) => bytes.length > 10_000);
    const bytes = Uint8Array.from(elf.segments[at].bytes);
    bytes.set(Buffer.from(PLACES[0]), 5_000);
    const marked = { ...elf, segments: elf.segments.with(at, { ...elf.segments[at], bytes }) };
    assert.deepEqual(occurring(marked, [PLACES[0]]), [PLACES[0]]);
    assert.notEqual(digest(marked), digest(elf));
  });
}
