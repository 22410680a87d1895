// What of an image reaches the flash.

import { createHash } from 'node:crypto';

/** @param {import('../../../emulator/src/elf.js').Elf} elf */
export function digest({ segments }) {
  const hash = createHash('sha256');
  for (const { address, bytes } of segments) {
    hash.update(`${address.toString(16)} ${bytes.length}\n`);
    hash.update(bytes);
  }
  return hash.digest('hex');
}

/** Which of these texts occur in it. */
export function occurring({ segments }, texts) {
  const contents = segments.map(({ bytes }) => Buffer.from(bytes));
  return texts.filter((text) => contents.some((content) => content.includes(text)));
}
