/**
 * A W25Q16JV: the 2 MB SPI NOR flash of a Raspberry Pi Pico. Clocked byte by byte by the SSI, or told
 * what to do by the boot ROM's services. Its memory is the array which the chip reads in place.
 *
 * NOR memory: erasing sets all bits of a sector, programming only clears bits, both take their time,
 * and power that fails meanwhile leaves something in between.
 */
import { FLASH_PAGE, FLASH_SECTOR, FLASH_SIZE } from './map.js';
import { Random } from './random.js';

/** Typical times of the data sheet, in milliseconds (section 9.6); at most 400 and 3. */
const ERASE_MS = 45;
const PROGRAM_MS = 0.4;
/** How much longer the larger erases take than that of a sector. */
const ERASE_FACTORS = new Map([
  [4096, 1],
  [32768, 120 / 45],
  [65536, 150 / 45],
]);
const WRITE_STATUS_NS = 10e6;
const ERASE_COMMANDS = new Map([
  [0x20, 4096],
  [0x52, 32768],
  [0xd8, 65536],
]);
const WRITE_ENABLED = 2;
const QUAD_ENABLED = 2;
/** Bytes behind the erased part of a torn sector in which some bits have flipped already. */
const TORN_EDGE = 64;
const MAX_VIOLATIONS = 1000;

/**
 * @typedef {object} Operation
 * @property {number} number counted from 1 since the flash was made
 * @property {'erase' | 'program'} kind
 * @property {number} address first byte, from the start of the flash
 * @property {number} length in bytes
 * @property {number} startNs when it began
 * @property {number} endNs when it will have finished, if the power stays
 */

export class W25q {
  /** What is stored. */
  bytes;
  erases = 0;
  programs = 0;
  /** How often each sector has been erased, by the number of the sector. */
  wear = new Uint32Array(FLASH_SIZE / FLASH_SECTOR);
  /**
   * Attempts to set bits by programming, which NOR memory cannot do.
   * @type {{address: number, stored: number, wanted: number, timeNs: number}[]}
   */
  violations = [];
  /**
   * Asked before each erase and program; `false` means that power fails first.
   * @type {(operation: Operation) => boolean}
   */
  onOperation = () => true;

  jedec = [0xef, 0x40, 0x15];
  uniqueId = [0xe6, 0x60, 0x58, 0x38, 0x83, 0x4b, 0x2f, 0x31];
  #clock;
  #random;
  #eraseNs;
  #programNs;
  #status1 = 0;
  #status2 = QUAD_ENABLED; // set in the factory of the board, kept without power
  #busyUntil = 0;
  /** @type {(Operation & {before: Uint8Array, data?: Uint8Array}) | null} */
  #running = null;
  #operations = 0;
  #command = [];
  #selected = false;

  /**
   * @param {{nanos: number}} clock
   * @param {object} [options]
   * @param {number} [options.seed] decides what a power cut leaves behind
   * @param {number} [options.eraseMs] how long erasing a sector takes
   * @param {number} [options.programMs] how long programming a page takes
   */
  constructor(clock, { seed = 1, eraseMs = ERASE_MS, programMs = PROGRAM_MS } = {}) {
    this.#clock = clock;
    this.#eraseNs = Math.round(eraseMs * 1e6);
    this.#programNs = Math.round(programMs * 1e6);
    this.#random = new Random(seed);
    this.bytes = new Uint8Array(FLASH_SIZE).fill(0xff);
  }

  get busy() {
    return this.#clock.nanos < this.#busyUntil;
  }

  /** When the present operation ends, in nanoseconds; in the past when there is none. */
  get busyUntil() {
    return this.#busyUntil;
  }

  /**
   * Erases to 0xff; needs no write enable here, that is a matter of the commands on the bus.
   * @param {number} address anywhere in what is to be erased
   * @param {number} [length] 4096, 32768 or 65536
   * @returns {Operation | null} null if the power failed first
   */
  erase(address, length = FLASH_SECTOR) {
    const start = (address % FLASH_SIZE) & ~(length - 1);
    const duration = Math.round(this.#eraseNs * ERASE_FACTORS.get(length));
    const operation = this.#begin('erase', start, length, duration);
    if (!operation) return null;
    this.bytes.fill(0xff, start, start + length);
    this.erases++;
    for (let at = start; at < start + length; at += FLASH_SECTOR) this.wear[at / FLASH_SECTOR]++;
    return operation;
  }

  /**
   * Programs up to a page; addresses wrap within the page, and of more bytes the last are kept.
   * @param {number} address of the first byte
   * @param {Uint8Array} data
   * @returns {Operation | null} null if the power failed first
   */
  program(address, data) {
    const kept = data.slice(-FLASH_PAGE);
    const start = inPage(address % FLASH_SIZE, data.length - kept.length);
    const operation = this.#begin('program', start, kept.length, this.#programNs, kept);
    if (!operation) return null;
    operation.data.forEach((wanted, i) => {
      const at = inPage(operation.address, i);
      const stored = this.bytes[at];
      // A byte of 0xff programs nothing: that is how drivers pad.
      if (wanted !== 0xff && wanted & ~stored && this.violations.length < MAX_VIOLATIONS) {
        this.violations.push({ address: at, stored, wanted, timeNs: operation.startNs });
      }
      this.bytes[at] = stored & wanted;
    });
    this.programs++;
    return operation;
  }

  /**
   * The power fails now: tears what is being done.
   * @returns {(Operation & {fraction: number}) | null} what was torn, and how far it had come
   */
  losePower() {
    const now = this.#clock.nanos;
    const torn = this.#running;
    this.#running = null;
    this.#busyUntil = 0;
    this.#status1 = 0;
    this.#selected = false;
    if (!torn || now >= torn.endNs) return null;
    const fraction = (now - torn.startNs) / (torn.endNs - torn.startNs);
    if (torn.kind === 'erase') this.#tearErase(torn, fraction);
    else this.#tearProgram(torn, fraction);
    const { number, kind, address, length, startNs, endNs } = torn;
    return { number, kind, address, length, startNs, endNs, fraction };
  }

  // ---- the SPI bus ---------------------------------------------------------------------------

  get selected() {
    return this.#selected;
  }

  select() {
    this.#selected = true;
    this.#command = [];
  }

  /** One byte in, one byte out. */
  transfer(byte) {
    const command = this.#command;
    const n = command.length;
    command.push(byte);
    const code = command[0];
    if (code === 0x05) return n ? this.#status1 | (this.busy ? 1 : 0) : 0xff;
    if (this.busy) return 0xff;
    switch (code) {
      case 0x35:
        return n ? this.#status2 : 0xff;
      case 0x9f:
        return n ? this.jedec[(n - 1) % 3] : 0xff;
      case 0x4b:
        return n > 4 ? this.uniqueId[(n - 5) % 8] : 0xff;
      case 0x03:
        return n > 3 ? this.bytes[(addressIn(command) + n - 4) % FLASH_SIZE] : 0xff;
      case 0x0b:
        return n > 4 ? this.bytes[(addressIn(command) + n - 5) % FLASH_SIZE] : 0xff;
    }
    return 0xff;
  }

  /** Chip select rises: a write command that is complete takes effect. */
  deselect() {
    if (!this.#selected) return;
    this.#selected = false;
    const command = this.#command;
    const code = command[0];
    if (this.busy) return;
    if (code === 0x06) this.#status1 |= WRITE_ENABLED;
    if (code === 0x04) this.#status1 &= ~WRITE_ENABLED;
    if (!(this.#status1 & WRITE_ENABLED)) return;
    if (ERASE_COMMANDS.has(code) && command.length === 4) {
      this.erase(addressIn(command), ERASE_COMMANDS.get(code));
    } else if (code === 0x02 && command.length > 4) {
      this.program(addressIn(command), Uint8Array.from(command.slice(4)));
    } else if ((code === 0x31 && command.length === 2) || (code === 0x01 && command.length === 3)) {
      this.#status2 = command[command.length - 1];
      this.#busyUntil = this.#clock.nanos + WRITE_STATUS_NS;
    } else {
      return;
    }
    this.#status1 &= ~WRITE_ENABLED;
  }

  // ---- inside --------------------------------------------------------------------------------

  #begin(kind, address, length, duration, data) {
    const startNs = this.#clock.nanos;
    const number = this.#operations + 1;
    const operation = { number, kind, address, length, startNs, endNs: startNs + duration };
    if (!this.onOperation(operation)) return null;
    this.#operations = number;
    this.#busyUntil = operation.endNs;
    const first = kind === 'erase' ? address : address & ~(FLASH_PAGE - 1);
    const before = this.bytes.slice(first, first + Math.max(length, FLASH_PAGE));
    this.#running = { ...operation, data, before };
    return this.#running;
  }

  /** A part is erased, the next bytes have lost some of their zeros, the rest is as it was. */
  #tearErase({ address, length, before }, fraction) {
    const erased = Math.floor(length * fraction);
    for (let i = erased; i < length; i++) {
      const flipped = i < erased + TORN_EDGE ? this.#random.next() & 0xff : 0;
      this.bytes[address + i] = before[i] | flipped;
    }
  }

  /** A part is written, the next byte has lost some of the ones that it was to lose, the rest none. */
  #tearProgram({ address, data, before }, fraction) {
    const written = Math.floor(data.length * fraction);
    this.bytes.set(before, address & ~(FLASH_PAGE - 1));
    for (let i = 0; i <= written && i < data.length; i++) {
      const spared = i === written ? this.#random.next() & 0xff : 0;
      this.bytes[inPage(address, i)] &= data[i] | spared;
    }
  }
}

function addressIn(command) {
  return (command[1] << 16) | (command[2] << 8) | command[3];
}

function inPage(address, offset) {
  return (address & ~(FLASH_PAGE - 1)) | ((address + offset) & (FLASH_PAGE - 1));
}
