/**
 * Memory as the executor of `thumb.js` sees it: SRAM and readable flash at once, everything else by
 * way of the chip, which decodes the address, knows the peripherals and objects to what is not there.
 */
import { FLASH_BASE, SRAM_BASE, SRAM_SIZE } from './map.js';

export class Memory {
  /** What the last access cost, in cycles. */
  cost = 1;
  /** Flash that can be read in place: its size, or 0 while the SSI does not map it. */
  flashSize = 0;

  /** @param {import('./chip.js').Chip} chip */
  constructor(chip) {
    this.chip = chip;
    this.sram8 = chip.sram;
    this.sram16 = new Uint16Array(chip.sram.buffer);
    this.sram32 = new Int32Array(chip.sram.buffer);
    this.watched = chip.watched;
    this.flash8 = chip.flash;
    this.flash16 = new Uint16Array(chip.flash.buffer);
    this.flash32 = new Int32Array(chip.flash.buffer);
  }

  /** @param {number} pc even address of a halfword of code */
  fetch(pc) {
    const inFlash = (pc - FLASH_BASE) | 0;
    if (inFlash >>> 0 < this.flashSize) return this.flash16[inFlash >> 1];
    const inSram = (pc - SRAM_BASE) | 0;
    if (inSram >>> 0 < SRAM_SIZE) return this.sram16[inSram >> 1];
    return this.chip.fetchSlowly(pc >>> 0);
  }

  load32(address) {
    const inSram = (address - SRAM_BASE) | 0;
    if (inSram >>> 0 < SRAM_SIZE && (inSram & 3) === 0) {
      this.cost = 2;
      return this.sram32[inSram >> 2];
    }
    const inFlash = (address - FLASH_BASE) | 0;
    if (inFlash >>> 0 < this.flashSize && (inFlash & 3) === 0) {
      this.cost = 2;
      return this.flash32[inFlash >> 2];
    }
    this.cost = accessCost(address, false);
    return this.chip.readUint32(address >>> 0) | 0;
  }

  load16(address) {
    const inSram = (address - SRAM_BASE) | 0;
    if (inSram >>> 0 < SRAM_SIZE && (inSram & 1) === 0) {
      this.cost = 2;
      return this.sram16[inSram >> 1];
    }
    const inFlash = (address - FLASH_BASE) | 0;
    if (inFlash >>> 0 < this.flashSize && (inFlash & 1) === 0) {
      this.cost = 2;
      return this.flash16[inFlash >> 1];
    }
    this.cost = accessCost(address, false);
    return this.chip.readUint16(address >>> 0);
  }

  load8(address) {
    const inSram = (address - SRAM_BASE) | 0;
    if (inSram >>> 0 < SRAM_SIZE) {
      this.cost = 2;
      return this.sram8[inSram];
    }
    const inFlash = (address - FLASH_BASE) | 0;
    if (inFlash >>> 0 < this.flashSize) {
      this.cost = 2;
      return this.flash8[inFlash];
    }
    this.cost = accessCost(address, false);
    return this.chip.readUint8(address >>> 0);
  }

  store32(address, value) {
    const inSram = (address - SRAM_BASE) | 0;
    if (inSram >>> 0 < SRAM_SIZE && (inSram & 3) === 0) {
      this.cost = 2;
      this.sram32[inSram >> 2] = value;
      if (this.watched[inSram >> 2]) this.chip.onWatchedStore(inSram);
      return;
    }
    this.cost = accessCost(address, true);
    this.chip.writeUint32(address >>> 0, value >>> 0);
  }

  store16(address, value) {
    const inSram = (address - SRAM_BASE) | 0;
    if (inSram >>> 0 < SRAM_SIZE && (inSram & 1) === 0) {
      this.cost = 2;
      this.sram16[inSram >> 1] = value;
      if (this.watched[inSram >> 2]) this.chip.onWatchedStore(inSram);
      return;
    }
    this.cost = accessCost(address, true);
    this.chip.writeUint16(address >>> 0, value & 0xffff);
  }

  store8(address, value) {
    const inSram = (address - SRAM_BASE) | 0;
    if (inSram >>> 0 < SRAM_SIZE) {
      this.cost = 2;
      this.sram8[inSram] = value;
      if (this.watched[inSram >> 2]) this.chip.onWatchedStore(inSram);
      return;
    }
    this.cost = accessCost(address, true);
    this.chip.writeUint8(address >>> 0, value & 0xff);
  }
}

/** SIO answers in the same cycle, SRAM and flash in the next; a bridge leads to the slow peripherals. */
function accessCost(address, write) {
  const region = address >>> 28;
  if (region === 0xd) return 1;
  if (region === 4) return write ? 5 : 4;
  return 2;
}
