// Prints the SHA-256 of what of an image reaches the flash: `node tests/image/digest.mjs ELF`.

import { readElf } from '../../emulator/src/elf.js';
import { digest } from './support/content.js';

console.log(digest(readElf(process.argv[2])));
