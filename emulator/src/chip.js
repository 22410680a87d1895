/**
 * The RP2040: `rp2040js` with our core, our clock, our address decoding, and our models in the places
 * of the parts which that package lacks. One instance lives from one reset to the next.
 */
import { BasePeripheral, RP2040 } from 'rp2040js';
import { Core } from './core.js';
import { Fault } from './fault.js';
import * as map from './map.js';
import { Pl011 } from './pl011.js';
import * as registers from './registers.js';
import { Ssi } from './ssi.js';
import { Timer } from './timer.js';
import { Watchdog } from './watchdog.js';

/** After reset: input enabled, 4 mA, Schmitt trigger, pull-down (datasheet, section 2.19.6.3). */
const PAD_RESET = 0x56;
const AIRCR = 0xd0c;
const SCR = 0xd10;
const NVIC_ICPR = 0x280;
const SYSRESETREQ = 0x05fa_0004;
const PSM_PROC0 = 1 << 15;
const PSM = 0x40010;

/**
 * What the chip tells its board.
 * @typedef {object} ChipEvents
 * @property {(fault: Fault) => void} onFault the core has faulted, PC is at the instruction
 * @property {(number: number) => void} onRomCall the boot ROM's `BKPT number` has been reached
 * @property {(word: number) => void} onWatchedStore a watched word of SRAM was stored to
 * @property {() => void} onCoreReset AIRCR.SYSRESETREQ
 * @property {(reason: number) => void} onWatchdog the watchdog resets the chip
 * @property {(source: string, text: string) => void} onWarning firmware did something doubtful
 */

export class Chip extends RP2040 {
  /**
   * @param {object} parts
   * @param {import('./clock.js').Clock} parts.clock
   * @param {import('./w25q.js').W25q} parts.flash
   * @param {import('./random.js').Random} parts.random
   * @param {Uint32Array} parts.rom the boot ROM
   * @param {Uint8Array} parts.watched one byte for each word of SRAM: nonzero if stores are reported
   * @param {{chipReset: number, watchdog: number, scratch: Uint32Array}} parts.reset what survived
   * @param {number} [parts.timerStartUs] what the system timer counts from
   * @param {boolean} [parts.strict] whether touching flash while it is not mapped is a crash
   * @param {ChipEvents} events
   */
  constructor({ clock, flash, random, rom, watched, reset, timerStartUs, strict = true }, events) {
    super(clock);
    this.strict = strict;
    this.events = events;
    this.watched = watched;
    this.flash = flash.bytes;
    this.flash16 = new Uint16Array(flash.bytes.buffer);
    this.flashView = new DataView(flash.bytes.buffer);
    this.bootrom.set(rom);
    this.bootrom16 = new Uint16Array(this.bootrom.buffer);
    const warn = (source, text) => events.onWarning(source, text);
    this.logger = { debug() {}, info() {}, warn, error: warn };
    for (const pin of [...this.gpio, ...this.qspi]) pin.padValue = PAD_RESET;

    this.core = new Core(this);
    this.core.reset();
    clock.setFrequency(this.clkSys);
    this.addClockListener((hertz) => clock.setFrequency(hertz));

    this.ssi = new Ssi(this, flash, (on) => this.#mapFlash(on));
    this.timer = new Timer(this, timerStartUs);
    this.watchdog = new Watchdog(this, {
      reason: reset.watchdog,
      scratch: reset.scratch,
      onReset: (reason) => this.#onWatchdog(reason),
      onTick: () => this.timer.start(),
    });
    this.uart = [
      new Pl011(this, 'UART0', map.IRQ.uart0, { tx: 20, rx: 21 }),
      new Pl011(this, 'UART1', map.IRQ.uart1, { tx: 22, rx: 23 }),
    ];
    Object.assign(this.peripherals, {
      [map.PERIPHERAL.xipCtrl]: registers.xipCtrl(this),
      [map.PERIPHERAL.ssi]: this.ssi,
      [map.PERIPHERAL.ioQspi]: registers.ioQspi(this, (mode) => this.ssi.forceChipSelect(mode)),
      [map.PERIPHERAL.uart0]: this.uart[0],
      [map.PERIPHERAL.uart1]: this.uart[1],
      [map.PERIPHERAL.timer]: this.timer,
      [map.PERIPHERAL.watchdog]: this.watchdog,
      [map.PERIPHERAL.rosc]: registers.rosc(this, random),
      [map.PERIPHERAL.vregAndChipReset]: registers.vregAndChipReset(this, reset.chipReset),
    });
  }

  /** Called by the package's constructor, which would otherwise touch 16 MB of flash. */
  reset() {
    this.pwm.reset();
  }

  /** AIRCR.SYSRESETREQ resets the core and nothing else (datasheet, section 2.4.2.9). */
  resetCore() {
    this.core = new Core(this, this.core.lines);
    this.core.reset();
  }

  onFault(fault) {
    this.events.onFault(fault);
  }

  onRomCall(number) {
    this.events.onRomCall(number);
  }

  /** @param {number} offset of the store from the start of SRAM */
  onWatchedStore(offset) {
    this.events.onWatchedStore(offset >> 2);
  }

  /** Code outside of SRAM and mapped flash. */
  fetchSlowly(pc) {
    if (pc < map.ROM_SIZE) return this.bootrom16[pc >> 1];
    if (pc >>> 28 === 1 && pc < map.FLASH_VIEWS_END) return this.#flashWord(pc) & 0xffff;
    throw new Fault('instruction fetch', pc);
  }

  readUint32(address) {
    if (address & 3) throw new Fault('unaligned read', address);
    switch (address >>> 28) {
      case 0:
        if (address < map.ROM_SIZE) return this.bootrom[address >> 2];
        break;
      case 1:
        if (address < map.FLASH_VIEWS_END) return this.#flashWord(address);
        return this.#peripheral(address).readUint32(address & 0xfff);
      case 2: {
        const offset = address - map.SRAM_BASE;
        if (offset < map.SRAM_SIZE) return this.sramView.getUint32(offset, true);
        break;
      }
      case 4:
        return this.#peripheral(address).readUint32(address & 0xfff);
      case 5: {
        const offset = address - map.USB_RAM_BASE;
        if (offset >= 0 && offset < map.USB_RAM_SIZE) return this.usbDPRAMView.getUint32(offset, true);
        return this.#peripheral(address).readUint32(address & 0xfff);
      }
      case 0xd:
        return this.sio.readUint32(address - map.SIO_BASE) >>> 0;
      case 0xe:
        if (address >>> 12 === map.PPB_PAGE >>> 12) return this.#readPpb(address & 0xfff);
    }
    throw new Fault('read of nothing', address);
  }

  readUint16(address) {
    if (address & 1) throw new Fault('unaligned read', address);
    return (this.readUint32((address & ~3) >>> 0) >>> (8 * (address & 2))) & 0xffff;
  }

  readUint8(address) {
    return (this.readUint32((address & ~3) >>> 0) >>> (8 * (address & 3))) & 0xff;
  }

  writeUint32(address, value) {
    if (address & 3) throw new Fault('unaligned write', address);
    switch (address >>> 28) {
      case 1:
        if (address < map.FLASH_VIEWS_END) return this.#writeToFlash(address);
        return this.#writePeripheral(address, value);
      case 2: {
        const offset = address - map.SRAM_BASE;
        if (offset >= map.SRAM_SIZE) break;
        this.sramView.setUint32(offset, value, true);
        if (this.watched[offset >> 2]) this.onWatchedStore(offset);
        return;
      }
      case 4:
        return this.#writePeripheral(address, value);
      case 5: {
        const offset = address - map.USB_RAM_BASE;
        if (offset < 0 || offset >= map.USB_RAM_SIZE) return this.#writePeripheral(address, value);
        this.usbDPRAMView.setUint32(offset, value, true);
        this.usbCtrl.DPRAMUpdated(offset, value);
        return;
      }
      case 0xd:
        return this.sio.writeUint32(address - map.SIO_BASE, value);
      case 0xe:
        if (address >>> 12 === map.PPB_PAGE >>> 12) return this.#writePpb(address & 0xfff, value);
    }
    throw new Fault('write to nothing', address);
  }

  writeUint16(address, value) {
    if (address & 1) throw new Fault('unaligned write', address);
    this.#writeNarrow(address, value & 0xffff, (value & 0xffff) * 0x1_0001, 2);
  }

  writeUint8(address, value) {
    this.#writeNarrow(address, value & 0xff, (value & 0xff) * 0x0101_0101, 1);
  }

  /** Memory takes bytes and halfwords; registers see them repeated over the whole word. */
  #writeNarrow(address, value, repeated, width) {
    const offset = address - map.SRAM_BASE;
    if (offset >= 0 && offset < map.SRAM_SIZE) {
      if (width === 1) this.sram[offset] = value;
      else this.sramView.setUint16(offset, value, true);
      if (this.watched[offset >> 2]) this.onWatchedStore(offset);
      return;
    }
    const usb = address - map.USB_RAM_BASE;
    if (usb >= 0 && usb < map.USB_RAM_SIZE) {
      const word = (address & ~3) >>> 0;
      const shift = 8 * (address & 3);
      const mask = (width === 1 ? 0xff : 0xffff) << shift;
      this.writeUint32(word, ((this.readUint32(word) & ~mask) | (value << shift)) >>> 0);
      return;
    }
    this.writeUint32((address & ~3) >>> 0, repeated >>> 0);
  }

  #peripheral(address) {
    const peripheral = this.peripherals[(address >>> 14) << 2];
    if (peripheral instanceof BasePeripheral) return peripheral;
    throw new Fault('access to nothing', address);
  }

  #writePeripheral(address, value) {
    this.#peripheral(address).writeUint32Atomic(address & 0xfff, value, (address >>> 12) & 3);
  }

  #flashWord(address) {
    if (!this.ssi.xip && this.strict) throw new Fault('flash access while XIP is off', address, { fatal: true });
    const offset = address & 0xff_ffff;
    return this.flashView.getUint32((offset & ~3) % this.flash.length, true) >>> (8 * (offset & 2));
  }

  /** Through the caching view a write only drops a cache line; through the others it is an error. */
  #writeToFlash(address) {
    if (address >= map.FLASH_BASE + 0x100_0000) throw new Fault('write to flash', address);
    this.events.onWarning('XIP', `write to flash at 0x${address.toString(16)} is ignored`);
  }

  #mapFlash(on) {
    this.core.flashSize = on || !this.strict ? this.flash.length : 0;
  }

  #readPpb(offset) {
    if (offset === SCR) return 0;
    if (offset === AIRCR) return 0xfa05_0000;
    return this.ppb.readUint32(offset) >>> 0;
  }

  #writePpb(offset, value) {
    if (offset === AIRCR) {
      if ((value & 0xffff_0004) >>> 0 === SYSRESETREQ) this.events.onCoreReset();
    } else if (offset === NVIC_ICPR) {
      this.core.clearPending(value);
    } else if (offset !== SCR) {
      this.ppb.writeUint32(offset, value);
    }
  }

  #onWatchdog(reason) {
    if (this.peripherals[PSM].wdsel & PSM_PROC0) this.events.onWatchdog(reason);
    else this.events.onWarning('WATCHDOG', 'fired, but PSM.WDSEL selects no processor to reset');
  }
}
