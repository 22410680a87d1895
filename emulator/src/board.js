/**
 * The board: power, resets, the flash that outlives them, the wiring, and the passing of time.
 */
import { buildBootRom, serveRom } from './bootrom.js';
import { Chip } from './chip.js';
import { Clock } from './clock.js';
import { Fault, UsageError } from './fault.js';
import { FLASH_BASE, FLASH_SECTOR, SRAM_BASE, SRAM_SIZE } from './map.js';
import { Pins } from './pins.js';
import { Random } from './random.js';
import { CHIP_RESET } from './registers.js';
import { W25q } from './w25q.js';
import { REASON_BITS } from './watchdog.js';

const MAX_WARNINGS = 1000;

/**
 * @typedef {'power-on' | 'run-pin' | 'watchdog' | 'watchdog-forced' | 'core-reset'} BootCause
 * @typedef {{cause: BootCause, timeNs: number}} Boot
 *
 * @typedef {object} FaultRecord
 * @property {string} kind a phrase such as `undefined instruction`
 * @property {number} [address] that was accessed
 * @property {number} pc of the instruction
 * @property {number} lr
 * @property {number} timeNs
 *
 * @typedef {object} BoardEvents
 * @property {(edge: import('./pins.js').Edge) => void} onEdge
 * @property {(uart: number, byte: number) => void} onUartByte
 * @property {() => void} onBoot a boot has been recorded, the chip has run nothing yet
 */

export class Board {
  clock = new Clock();
  /** @type {W25q} */
  flash;
  /** @type {Chip} */
  chip;
  /** @type {Pins} */
  pins;
  powered = false;
  /** @type {Boot[]} */
  boots = [];
  /** @type {FaultRecord[]} */
  faults = [];
  /** What firmware did that silicon would not like. @type {{source: string, text: string, timeNs: number}[]} */
  warnings = [];
  /** Why the core runs no more until the next reset. @type {{reason: string, pc: number, timeNs: number} | null} */
  halted = null;
  /** Readings of the ADC, 0 to 4095: GPIO 26 to 29, then the temperature sensor. */
  analog = [0, 0, 0, 0, 0];

  #events;
  #random;
  #strict;
  #timerStartUs;
  #rom = buildBootRom();
  #watched = new Uint8Array(SRAM_SIZE / 4);
  #watchers = new Map();
  #chipReset = CHIP_RESET.por;
  #stallUntil = 0;
  /** A reset that takes effect between two instructions. @type {(() => void) | null} */
  #pendingReset = null;
  /** Power going or coming; it overrides every reset. @type {(() => void) | null} */
  #pendingPower = null;

  /**
   * @param {object} options
   * @param {number} options.seed of everything that is random on a real board
   * @param {boolean} options.strict whether touching flash while it is not mapped is a crash
   * @param {number} options.timerStartUs what the system timer counts from
   * @param {{eraseMs?: number, programMs?: number}} options.flashTimes
   * @param {BoardEvents} events
   */
  constructor({ seed, strict, timerStartUs, flashTimes }, events) {
    this.#events = events;
    this.#random = new Random(seed);
    this.#strict = strict;
    this.#timerStartUs = timerStartUs;
    this.flash = new W25q(this.clock, { ...flashTimes, seed });
    this.pins = new Pins(this.clock, (edge) => {
      this.clock.stop();
      events.onEdge(edge);
    });
  }

  // ---- flash contents ------------------------------------------------------------------------

  /** Writes an image as a flashing tool does: erases the sectors it touches, leaves all others. */
  flashSegments(segments) {
    const inFlash = segments.filter(({ address }) => address >>> 24 === FLASH_BASE >>> 24);
    const bytes = this.flash.bytes;
    for (const { address, bytes: data } of inFlash) {
      const first = (address - FLASH_BASE) & ~(FLASH_SECTOR - 1);
      bytes.fill(0xff, first, Math.ceil((address - FLASH_BASE + data.length) / FLASH_SECTOR) * FLASH_SECTOR);
    }
    for (const { address, bytes: data } of inFlash) bytes.set(data, address - FLASH_BASE);
    return inFlash.length > 0;
  }

  // ---- power and resets ----------------------------------------------------------------------

  powerOn() {
    if (this.powered) return;
    this.powered = true;
    this.#chipReset = CHIP_RESET.por;
    this.#boot('power-on', null);
  }

  /** @returns what the flash was doing, or null */
  powerOff() {
    if (!this.powered) return null;
    this.powered = false;
    this.#pendingReset = null;
    this.halted = null;
    this.clock.dropAlarms();
    const torn = this.flash.losePower();
    this.pins.release();
    return torn;
  }

  /** The RUN pin is pulled low and let go. */
  runPin() {
    if (!this.powered) return;
    this.#chipReset = CHIP_RESET.run;
    this.#boot('run-pin', this.chip.sram);
  }

  /** Power is about to go or to come: `action` is called as soon as the present instruction has ended. */
  switchPowerSoon(action) {
    this.#pendingPower = action;
    this.clock.stop();
  }

  // ---- time ----------------------------------------------------------------------------------

  /**
   * Lets time pass until `untilNs`, or until `done` says so; that is asked whenever something may have
   * happened, and every `stepNs` while the core runs.
   * @param {number} untilNs
   * @param {() => boolean} [done]
   * @param {number} [stepNs]
   * @returns {boolean} whether `done` said so
   */
  advance(untilNs, done = () => false, stepNs = Infinity) {
    const { clock } = this;
    for (;;) {
      this.#fireAlarms();
      this.#act();
      if (done()) return true;
      const now = clock.nanos;
      if (now >= untilNs) return false;
      const wakeAt = Math.min(untilNs, clock.nextAlarm);
      if (!this.powered) clock.advanceTo(wakeAt);
      else if (now < this.#stallUntil) clock.advanceTo(Math.min(this.#stallUntil, wakeAt));
      else if (!this.chip.core.settle()) clock.advanceTo(wakeAt);
      else {
        clock.begin(Math.min(untilNs, now + stepNs));
        this.chip.core.run();
        clock.commit();
      }
    }
  }

  /** Calls back at a time, in nanoseconds, whatever happens to the chip until then. */
  at(timeNs, callback) {
    this.clock.createAlarm(callback, { lasting: true }).scheduleAt(timeNs);
  }

  /** The system timer counts on from so many microseconds later. */
  leapTimer(us) {
    this.#needPower();
    this.chip.timer.leap(us);
  }

  // ---- memory without side effects -----------------------------------------------------------

  read32(address) {
    return new DataView(this.readBytes(address, 4).buffer).getUint32(0, true);
  }

  /** @returns {Uint8Array} a copy from SRAM or flash; fewer bytes where that ends */
  readBytes(address, length) {
    if (address >= SRAM_BASE) {
      this.#needPower();
      return this.chip.sram.slice(address - SRAM_BASE, address - SRAM_BASE + length);
    }
    return this.flash.bytes.slice(address - FLASH_BASE, address - FLASH_BASE + length);
  }

  /** Into SRAM, unseen by watchers. */
  write32(address, value) {
    this.#needPower();
    this.chip.sramView.setUint32(address - SRAM_BASE, value, true);
  }

  /** Calls back after each store to the word of SRAM at `address`. */
  watch(address, callback) {
    const word = (address - SRAM_BASE) >> 2;
    if (!this.#watchers.has(word)) this.#watchers.set(word, []);
    this.#watchers.get(word).push(callback);
    this.#watched[word] = 1;
  }

  unwatch(address, callback) {
    const word = (address - SRAM_BASE) >> 2;
    const rest = (this.#watchers.get(word) ?? []).filter((other) => other !== callback);
    this.#watchers.set(word, rest);
    this.#watched[word] = rest.length ? 1 : 0;
  }

  // ---- what the boot ROM's services ask for --------------------------------------------------

  stall(untilNs) {
    this.#stallUntil = untilNs;
    this.clock.stop();
  }

  halt(reason) {
    this.chip.core.locked = true;
    this.halted = { reason, pc: this.chip.core.PC, timeNs: this.clock.nanos };
    this.clock.stop();
  }

  // ---- inside --------------------------------------------------------------------------------

  /** @param {Uint8Array | null} sram what memory holds; null: the noise of a cold start */
  #boot(cause, sram) {
    const kept = cause.startsWith('watchdog') ? this.chip.watchdog.scratch : new Uint32Array(8);
    const watchdog =
      cause === 'watchdog' ? REASON_BITS.timer : cause === 'watchdog-forced' ? REASON_BITS.force : 0;
    this.clock.commit();
    this.clock.dropAlarms();
    this.pins.release();
    this.chip = new Chip(
      {
        clock: this.clock,
        flash: this.flash,
        random: this.#random,
        rom: this.#rom,
        watched: this.#watched,
        reset: { chipReset: this.#chipReset, watchdog, scratch: kept },
        timerStartUs: this.#timerStartUs,
        strict: this.#strict,
      },
      this.#chipEvents,
    );
    if (sram) this.chip.sram.set(sram);
    else this.#random.fill(this.chip.sram);
    this.chip.adc.channelValues = this.analog;
    this.chip.uart.forEach((uart, n) => (uart.onByte = (byte) => this.#onUartByte(n, byte)));
    this.pins.attach(this.chip);
    this.#started(cause);
  }

  #needPower() {
    if (!this.chip) throw new UsageError('power has never been on: memory holds nothing yet');
  }

  #resetSoon(action) {
    this.#pendingReset = action;
    this.clock.stop();
  }

  #act() {
    const action = this.#pendingPower ?? this.#pendingReset;
    if (!action) return;
    this.#pendingPower = this.#pendingReset = null;
    action();
  }

  #resetCore() {
    this.chip.resetCore();
    this.#started('core-reset');
  }

  #started(cause) {
    this.#stallUntil = 0;
    this.halted = null;
    this.boots.push({ cause, timeNs: this.clock.nanos });
    this.#events.onBoot();
  }

  #chipEvents = {
    onFault: (fault) => this.#onFault(fault),
    onRomCall: (number) => serveRom(this, number),
    onWatchedStore: (word) => this.#watchers.get(word).forEach((callback) => callback()),
    onCoreReset: () => this.#resetSoon(() => this.#resetCore()),
    onWatchdog: (reason) => {
      const cause = reason === REASON_BITS.timer ? 'watchdog' : 'watchdog-forced';
      this.#resetSoon(() => this.#boot(cause, this.chip.sram));
    },
    onWarning: (source, text) => {
      if (this.warnings.length < MAX_WARNINGS) {
        this.warnings.push({ source, text, timeNs: this.clock.nanos });
      }
    },
  };

  #onUartByte(uart, byte) {
    this.clock.stop();
    this.#events.onUartByte(uart, byte);
  }

  #onFault(fault) {
    const { core } = this.chip;
    const { kind, address } = fault;
    this.faults.push({ kind, address, pc: core.PC, lr: core.LR, timeNs: this.clock.nanos });
    if (fault.fatal) core.locked = true;
    else if (!core.locked) core.hardFault();
    if (core.locked && !this.halted) this.halt(fault.fatal ? kind : `locked up: ${kind}`);
  }

  /** A peripheral may fault by itself: the DMA reads what is not there. */
  #fireAlarms() {
    try {
      this.clock.fire();
    } catch (fault) {
      if (!(fault instanceof Fault)) throw fault;
      const { kind, address } = fault;
      this.faults.push({ kind: `${kind} by DMA`, address, pc: 0, lr: 0, timeNs: this.clock.nanos });
    }
  }
}
