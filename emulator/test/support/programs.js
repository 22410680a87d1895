/** Programs for the emulated chip, small enough for the place of the second-stage bootloader. */
import { buildBootRom } from '../../src/bootrom.js';
import { Assembler } from './assembler.js';

const PSM_WDSEL = 0x4001_0008;
const TIMER_ALARM0 = 0x4005_4010;
const TIMER_RAW_LOW = 0x4005_4028;
const TIMER_INTR = 0x4005_4034;
const TIMER_INTE = 0x4005_4038;
const WATCHDOG_CTRL = 0x4005_8000;
const WATCHDOG_LOAD = 0x4005_8004;
const WATCHDOG_TICK = 0x4005_802c;
const SIO_OUT_SET = 0xd000_0014;
const SIO_OUT_XOR = 0xd000_001c;
const SIO_OE_SET = 0xd000_0024;
const NVIC_ISER = 0xe000_e100;
const NVIC_ICPR = 0xe000_e280;

/** The address of a function of the boot ROM, as firmware would find it. */
export function romFunction(code) {
  const rom = new DataView(buildBootRom().buffer);
  const wanted = code.charCodeAt(0) | (code.charCodeAt(1) << 8);
  let entry = rom.getUint16(0x14, true);
  while (rom.getUint16(entry, true) !== wanted) entry += 4;
  return rom.getUint16(entry + 2, true);
}

export class Program extends Assembler {
  /** Copies a word from one address to another. */
  copy(from, to) {
    return this.load(0, from).ldr(1, 0).load(2, to).str(1, 2);
  }

  /** Makes a pin an output, low. */
  output(pin) {
    return this.put(0x4001_4004 + 8 * pin, 5).put(SIO_OE_SET, 1 << pin);
  }

  high(pin) {
    return this.put(SIO_OUT_SET, 1 << pin);
  }

  toggle(pin) {
    return this.put(SIO_OUT_XOR, 1 << pin);
  }

  /** Starts the microsecond tick. */
  tick() {
    return this.put(WATCHDOG_TICK, (1 << 9) | 12);
  }

  /** Lets the watchdog reset everything but the oscillators after a time. */
  watchdog(micros) {
    return this.put(PSM_WDSEL, 0x1fffc).put(WATCHDOG_LOAD, 2 * micros).put(WATCHDOG_CTRL, 1 << 30);
  }

  /** Sleeps for microseconds; interrupts stay masked, the timer only wakes the core. */
  prepareSleep() {
    return this.emit(0xb672).put(TIMER_INTE, 1).put(NVIC_ISER, 1);
  }

  sleep(micros) {
    return this.load(0, TIMER_RAW_LOW)
      .ldr(1, 0)
      .load(2, micros)
      .emit(0x1889) // ADDS r1, r1, r2
      .load(0, TIMER_ALARM0)
      .str(1, 0)
      .wfi()
      .put(TIMER_INTR, 1)
      .put(NVIC_ICPR, 1);
  }

  /** Erases a sector of the flash by way of the boot ROM. */
  erase(address) {
    return this.load(0, address).load(1, 4096).load(2, 65536).load(3, romFunction('RE')).blx(3);
  }

  /** Programs a page of the flash with the words at an address. */
  program(address, from) {
    return this.load(0, address).load(1, from).load(2, 256).load(3, romFunction('RP')).blx(3);
  }

  /** Sleeps for good. */
  stop() {
    return this.label('stop').wfi().b('stop');
  }
}

/** Toggles pin 25 every millisecond, asleep in between. */
export function blink() {
  const program = new Program().output(25).tick().prepareSleep();
  return program.label('again').sleep(1000).toggle(25).b('again').bytes();
}
