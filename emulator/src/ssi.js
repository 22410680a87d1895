/**
 * The SSI: the serial interface between the chip and its flash (RP2040 datasheet, section 4.10), as
 * far as the second-stage bootloader, flash drivers and the boot ROM use it: single-bit SPI in frames
 * of eight bits, and the switch to execute-in-place.
 */
import { BasePeripheral } from 'rp2040js';

const CTRLR0 = 0x00;
const CTRLR1 = 0x04;
const SSIENR = 0x08;
const SER = 0x10;
const TXFLR = 0x20;
const RXFLR = 0x24;
const SR = 0x28;
const IDR = 0x58;
const VERSION = 0x5c;
const DR0 = 0x60;
const DR_END = 0xec;

const TX_NOT_FULL = 2;
const TX_EMPTY = 4;
const RX_NOT_EMPTY = 8;
const TX_AND_RX = 0;
const EEPROM_READ = 3;
/** GPIO_QSPI_SS_CTRL.OUTOVER. */
export const CHIP_SELECT = { normal: 0, inverted: 1, low: 2, high: 3 };

export class Ssi extends BasePeripheral {
  #flash;
  #onXip;
  #registers = new Map([[SER, 1]]);
  #toSend = [];
  #received = [];
  #forced = false;

  /**
   * @param {import('rp2040js').RP2040} chip
   * @param {import('./w25q.js').W25q} flash
   * @param {(on: boolean) => void} onXip told when flash becomes readable in place, and when not
   */
  constructor(chip, flash, onXip) {
    super(chip, 'SSI');
    this.#flash = flash;
    this.#onXip = onXip;
  }

  /** Flash can be read in place: enabled, and in the mode that turns an address into a read. */
  get xip() {
    return (this.#get(SSIENR) & 1) !== 0 && this.#transferMode === EEPROM_READ;
  }

  /** What the boot ROM does before it speaks to the flash: serial mode, frames of eight bits. */
  enterSerialMode() {
    this.writeUint32(SSIENR, 0);
    this.writeUint32(CTRLR0, 7 << 16);
    this.writeUint32(CTRLR1, 0);
    this.writeUint32(SER, 1);
    this.writeUint32(SSIENR, 1);
  }

  /** What the boot ROM's enter-XIP does: slow single-bit reads in place (command 0x03). */
  enterXipMode() {
    this.writeUint32(SSIENR, 0);
    this.writeUint32(CTRLR0, (31 << 16) | (EEPROM_READ << 8));
    this.writeUint32(SSIENR, 1);
  }

  /** Software may take chip select into its own hands. @param {number} mode one of `CHIP_SELECT` */
  forceChipSelect(mode) {
    this.#drain();
    this.#forced = mode >= CHIP_SELECT.low;
    if (mode === CHIP_SELECT.low) {
      if (!this.#flash.selected) this.#flash.select();
    } else {
      this.#flash.deselect();
    }
  }

  readUint32(offset) {
    if (offset >= DR0 && offset <= DR_END) {
      this.#drain();
      return this.#received.shift() ?? 0;
    }
    switch (offset) {
      case TXFLR:
        return 0;
      case RXFLR:
        this.#drain();
        return this.#received.length;
      case SR:
        this.#drain();
        return TX_NOT_FULL | TX_EMPTY | (this.#received.length ? RX_NOT_EMPTY : 0);
      case IDR:
        return 0x5153_5049;
      case VERSION:
        return 0x3430_312a;
    }
    return this.#get(offset);
  }

  writeUint32(offset, value) {
    if (offset >= DR0 && offset <= DR_END) {
      if (!(this.#get(SSIENR) & 1)) return;
      if (this.#forced) this.#received.push(this.#flash.transfer(value & 0xff));
      else this.#toSend.push(value & 0xff);
      return;
    }
    if (offset === SSIENR) {
      this.#drain();
      if (!(value & 1)) this.#received = [];
    }
    this.#registers.set(offset, value >>> 0);
    if (offset === SSIENR) this.#onXip(this.xip);
  }

  get #transferMode() {
    return (this.#get(CTRLR0) >>> 8) & 3;
  }

  get #wide() {
    return ((this.#get(CTRLR0) >>> 21) & 3) !== 0;
  }

  #get(offset) {
    return this.#registers.get(offset) ?? 0;
  }

  /** The FIFO has run empty: all that was written goes out as one command, then chip select rises. */
  #drain() {
    if (this.#forced || !this.#toSend.length) return;
    const bytes = this.#toSend;
    this.#toSend = [];
    const frames = this.#transferMode === EEPROM_READ ? this.#get(CTRLR1) + 1 : 0;
    if (this.#wide) {
      // The bootloader's first quad read only switches the flash to continuous reads.
      for (let i = 0; i < frames; i++) this.#received.push(0xffff_ffff);
      return;
    }
    this.#flash.select();
    for (const byte of bytes) {
      const answer = this.#flash.transfer(byte);
      if (this.#transferMode === TX_AND_RX) this.#received.push(answer);
    }
    for (let i = 0; i < frames; i++) this.#received.push(this.#flash.transfer(0));
    this.#flash.deselect();
  }
}
