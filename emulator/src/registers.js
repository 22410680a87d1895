/**
 * Register blocks of which firmware needs no more than that they answer: XIP_CTRL, IO_QSPI, ROSC,
 * VREG_AND_CHIP_RESET. Each register has a value after reset; it is kept as written, or computed.
 */
import { BasePeripheral } from 'rp2040js';

export class RegisterBlock extends BasePeripheral {
  #values;
  #onWrite;

  /**
   * @param {import('rp2040js').RP2040} chip
   * @param {string} name
   * @param {Record<number, number | (() => number)>} registers by offset: the value after reset, or
   *   what computes it on each read (such a register ignores writes)
   * @param {(offset: number, value: number) => void} [onWrite]
   */
  constructor(chip, name, registers, onWrite = () => {}) {
    super(chip, name);
    this.#values = new Map(Object.entries(registers).map(([key, value]) => [Number(key), value]));
    this.#onWrite = onWrite;
  }

  readUint32(offset) {
    const value = this.#values.get(offset);
    if (value === undefined) return super.readUint32(offset);
    return typeof value === 'function' ? value() : value;
  }

  writeUint32(offset, value) {
    const present = this.#values.get(offset);
    if (present === undefined) return super.writeUint32(offset, value);
    if (typeof present !== 'function') this.#values.set(offset, value >>> 0);
    this.#onWrite(offset, value >>> 0);
  }
}

/** The cache never holds anything back: always flushed, its stream always empty. */
export function xipCtrl(chip) {
  const stat = () => 0b011; // FLUSH_READY, FIFO_EMPTY
  return new RegisterBlock(chip, 'XIP_CTRL', {
    0x00: 0b011, // CTRL: EN, ERR_BADWRITE
    0x04: () => 0, // FLUSH
    0x08: stat,
    0x0c: 0, // CTR_HIT
    0x10: 0, // CTR_ACC
    0x14: 0, // STREAM_ADDR
    0x18: () => 0, // STREAM_CTR: no streaming
    0x1c: () => 0, // STREAM_FIFO
  });
}

const SS_CTRL = 0x0c;

/** The pins of the flash. @param {(mode: number) => void} onChipSelect told of SS's OUTOVER */
export function ioQspi(chip, onChipSelect) {
  const registers = {};
  for (let pin = 0; pin < 6; pin++) {
    registers[8 * pin] = () => 0; // STATUS
    registers[8 * pin + 4] = 0x1f; // CTRL
  }
  for (let offset = 0x30; offset <= 0x48; offset += 4) registers[offset] = 0; // interrupts
  return new RegisterBlock(chip, 'IO_QSPI', registers, (offset, value) => {
    if (offset === SS_CTRL) onChipSelect((value >>> 8) & 3);
  });
}

/** The ring oscillator: stable, and a source of (reproducible) random bits. */
export function rosc(chip, random) {
  return new RegisterBlock(chip, 'ROSC', {
    0x00: 0x00fa_baa0, // CTRL: enabled, low range
    0x04: 0, // FREQA
    0x08: 0, // FREQB
    0x0c: 0, // DORMANT
    0x10: 0xaa0, // DIV
    0x14: 0, // PHASE
    0x18: () => 0x8000_1000, // STATUS: STABLE, ENABLED
    0x1c: () => random.next() & 1, // RANDOMBIT
    0x20: () => 0, // COUNT
  });
}

/** CHIP_RESET: why the chip was last reset (datasheet, section 2.12.8). */
export const CHIP_RESET = { por: 1 << 8, run: 1 << 16, psmRestart: 1 << 20 };

/** @param {number} reason one of `CHIP_RESET` */
export function vregAndChipReset(chip, reason) {
  return new RegisterBlock(chip, 'VREG_AND_CHIP_RESET', {
    0x00: 0x10b1, // VREG: in regulation, 1.10 V, enabled
    0x04: 0x91, // BOD: enabled, 0.86 V
    0x08: () => reason,
  });
}
