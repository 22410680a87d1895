/**
 * An emulated Raspberry Pi Pico on a test bench: it boots the very ELF file that is flashed, inputs
 * are set and outputs recorded, power and the RUN pin are at hand.
 *
 * Time is simulated; nothing happens but in `runFor`, `runTo` and `runUntil`. Two runs with the same
 * image, seed and stimuli are equal to the last bit.
 */
import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';
import { Board } from './board.js';
import { readElf } from './elf.js';
import { UsageError } from './fault.js';
import { Log } from './log.js';
import { FLASH_SIZE, SRAM_BASE, SRAM_SIZE } from './map.js';
import { PowerCuts } from './powercut.js';
import { Rtt } from './rtt.js';
import { Uart } from './uart.js';

const NS_PER_MS = 1e6;
/** How often a predicate is asked while the core runs and nothing else happens, in milliseconds. */
const PREDICATE_STEP_MS = 0.1;
const DEFAULT_OFF_MS = 100;

export class Pico {
  /** Serial ports as seen from outside. @type {Uart[]} */
  uart;
  /** Every change of an output, oldest first; see `recordEdges`. @type {import('./pins.js').Edge[]} */
  edges = [];

  #board;
  #cuts;
  #log = new Log();
  #elf = null;
  #rtt = null;
  #onFrameOffset = () => this.#rtt.take(this.#board);
  #edgeListeners = new Set();
  #recorded;

  /**
   * @param {string | null} elfPath the image; null to run what is in `flash`
   * @param {object} [options]
   * @param {Uint8Array | string} [options.flash] contents of the flash before the image is written, or
   *   the file that holds them; otherwise erased
   * @param {Record<number, 0 | 1 | null>} [options.inputs] what is wired to the pins when power comes
   * @param {number} [options.seed] of memory at power-up and of torn flash; default 1
   * @param {boolean} [options.strict] touching flash while it is not mapped is a crash, as on silicon;
   *   default true
   * @param {boolean | number[]} [options.recordEdges] keep edges of all pins (default), none, or these
   * @param {number} [options.timerStartUs] what the system timer counts from after each reset; 0 on
   *   silicon, more to see it roll over soon
   * @param {{eraseMs?: number, programMs?: number}} [options.flashTimes] how long erasing a sector and
   *   programming a page take; by default the typical 45 and 0.4, at most 400 and 3 by the data sheet
   * @param {boolean} [options.powered] whether power is on at once; default true
   */
  constructor(elfPath, options = {}) {
    const { flash, inputs = {}, seed = 1, strict = true, recordEdges = true } = options;
    const { timerStartUs = 0, flashTimes = {}, powered = true } = options;
    this.#recorded = Array.isArray(recordEdges) ? new Set(recordEdges) : recordEdges;
    this.#board = new Board(
      { seed, strict, timerStartUs, flashTimes },
      {
        onEdge: (edge) => this.#onEdge(edge),
        onUartByte: (n, byte) => this.uart[n].deliver(byte, this.timeNs),
        onBoot: () => this.#rtt?.restart(this.#board),
      },
    );
    this.#cuts = new PowerCuts(this.#board, seed);
    this.uart = [0, 1].map((n) => new Uart((byte) => this.#feed(n, byte)));
    if (flash) this.#board.flash.bytes.set(flashContents(flash));
    for (const [pin, level] of Object.entries(inputs)) this.setInput(Number(pin), level);
    if (elfPath) this.#load(elfPath);
    else if (!flash) throw new UsageError('neither an image nor the contents of the flash were given');
    if (powered) this.powerOn();
  }

  // ---- time ----------------------------------------------------------------------------------

  /** Simulated nanoseconds since the bench was set up; goes on while power is off. */
  get timeNs() {
    return this.#board.clock.nanos;
  }

  get timeMs() {
    return this.timeNs / NS_PER_MS;
  }

  /** Cycles in which the core was awake. */
  get cycles() {
    return this.#board.clock.cycles;
  }

  /** Lets `ms` of simulated time pass. */
  runFor(ms) {
    checkDuration(ms);
    this.#board.advance(this.timeNs + Math.round(ms * NS_PER_MS));
  }

  /** Lets time pass until `ms` of simulated time; at once if that is past. */
  runTo(ms) {
    checkDuration(ms);
    this.#board.advance(Math.round(ms * NS_PER_MS));
  }

  /**
   * Lets time pass until the predicate holds. It is asked after each edge, byte, log line and reset,
   * whenever the core falls asleep or wakes, and while it runs at least every 0.1 ms.
   * @param {() => boolean} predicate
   * @param {number} limitMs how long to wait at most
   * @returns {boolean} whether it held in time
   */
  runUntil(predicate, limitMs) {
    checkDuration(limitMs);
    const until = this.timeNs + Math.round(limitMs * NS_PER_MS);
    return this.#board.advance(until, predicate, PREDICATE_STEP_MS * NS_PER_MS);
  }

  /**
   * Lets time pass until the next edge that fits the filter.
   * @param {EdgeFilter} filter
   * @param {number} limitMs
   * @returns {import('./pins.js').Edge | null} the edge, or null if none came in time
   */
  runUntilEdge(filter, limitMs) {
    let found = null;
    const stop = this.onEdge((edge) => (found ??= fits(edge, filter) ? edge : null));
    this.runUntil(() => found !== null, limitMs);
    stop();
    return found;
  }

  /**
   * Lets time pass until a new log line matches.
   * @param {string | RegExp} pattern a part of the text, or an expression for it
   * @param {number} limitMs
   * @returns {import('./log.js').StampedLine | null}
   */
  runUntilLog(pattern, limitMs) {
    const matches = (line) =>
      typeof pattern === 'string' ? line.text.includes(pattern) : pattern.test(line.text);
    let seen = this.#log.lines.length;
    let count = this.#log.count;
    let found = null;
    this.runUntil(() => {
      if (this.#log.count === count) return false;
      count = this.#log.count;
      found = this.#log.lines.slice(seen).find(matches) ?? null;
      seen = this.#log.lines.length;
      return found !== null;
    }, limitMs);
    return found;
  }

  /** Calls back at `ms` of simulated time, between two instructions: the place for exact stimuli. */
  at(ms, callback) {
    checkDuration(ms);
    this.#board.at(Math.round(ms * NS_PER_MS), callback);
  }

  /**
   * Lets the system timer leap, as if the chip had stood still for so long: the firmware sees a time far ahead without
   * the bench having to wait for it. The watchdog and all else count on from where they are.
   * @param {number} ms a whole number of microseconds
   */
  leap(ms) {
    checkDuration(ms);
    this.#board.leapTimer(Math.round(ms * 1000));
  }

  // ---- pins ----------------------------------------------------------------------------------

  /** Wires a level to a pin: 0, 1, or null to let the pull resistors decide. */
  setInput(pin, level) {
    this.#board.pins.setInput(pin, level);
  }

  /** @returns {0 | 1} the level of a pin, whoever makes it */
  level(pin) {
    return this.#board.pins.level(pin);
  }

  /** @returns {boolean} whether the chip drives the pin */
  driven(pin) {
    return this.#board.pins.driven(pin);
  }

  /**
   * @typedef {object} EdgeFilter
   * @property {number | number[]} [pin]
   * @property {0 | 1 | null} [level]
   * @property {number} [fromNs] not before
   * @property {number} [toNs] before
   */

  /** @param {EdgeFilter} filter @returns the recorded edges that fit */
  edgesOf(filter) {
    return this.edges.filter((edge) => fits(edge, filter));
  }

  /** The recorded edges, which are then forgotten. */
  takeEdges() {
    const taken = this.edges;
    this.edges = [];
    return taken;
  }

  /** @param {(edge: import('./pins.js').Edge) => void} listener @returns {() => void} ends it */
  onEdge(listener) {
    this.#edgeListeners.add(listener);
    return () => this.#edgeListeners.delete(listener);
  }

  /**
   * What the ADC reads from now on, across resets and power cycles; 0 until it is set.
   * @param {number} channel 0 to 3 for GPIO 26 to 29, 4 for the temperature sensor
   * @param {number} value 0 to 4095
   */
  setAnalog(channel, value) {
    if (!(channel in this.#board.analog)) throw new UsageError(`there is no ADC channel ${channel}`);
    if (!(value >= 0 && value <= 4095)) throw new UsageError(`the ADC cannot read ${value}`);
    this.#board.analog[channel] = Math.round(value);
  }

  // ---- power, resets, faults -----------------------------------------------------------------

  get powered() {
    return this.#board.powered;
  }

  /** Each start of the firmware: why, and when. */
  get boots() {
    return this.#board.boots;
  }

  /** Each cut that was planned and has happened. */
  get powerCuts() {
    return this.#cuts.done;
  }

  /** Each fault of the core, with `pc` and `lr`. */
  get faults() {
    return this.#board.faults;
  }

  /** Why the core does not run any more, or null. Time goes on; the watchdog may still bite. */
  get halted() {
    return this.#board.halted;
  }

  /** What firmware did that silicon would not like, but that is no fault. */
  get warnings() {
    return this.#board.warnings;
  }

  powerOn() {
    this.#board.powerOn();
  }

  /** @returns the flash operation that was torn, or null */
  powerOff() {
    return this.#board.powerOff();
  }

  /** Off, `offMs` later on again: memory is lost, the flash stays. */
  powerCycle({ offMs = DEFAULT_OFF_MS } = {}) {
    this.powerOff();
    this.runFor(offMs);
    this.powerOn();
  }

  /** The RUN pin is pulled low and let go. */
  runPin() {
    this.#board.runPin();
  }

  /** Plans a failure of the power. @param {import('./powercut.js').CutPlan} plan */
  cutPower(plan) {
    this.#cuts.plan(plan);
  }

  /** Forgets the cuts that wait for a flash operation. */
  cancelCuts() {
    this.#cuts.cancel();
  }

  // ---- flash and memory ----------------------------------------------------------------------

  /** The flash chip: `bytes`, `erases`, `programs`, `wear`, `violations`. */
  get flash() {
    return this.#board.flash;
  }

  /** @returns {Uint8Array} a copy of the flash's contents */
  flashImage() {
    return this.flash.bytes.slice();
  }

  saveFlash(path) {
    writeFileSync(path, this.flash.bytes);
  }

  /** Flashes another image, as over USB: power goes, the sectors of the image are written, power comes. */
  program(elfPath) {
    this.powerOff();
    this.#load(elfPath);
    this.powerOn();
  }

  /** @returns {{address: number, size: number}} of a symbol of the image */
  symbol(name) {
    const symbol = this.#elf?.symbols.get(name);
    if (!symbol) throw new UsageError(`the image has no symbol ${name}`);
    return symbol;
  }

  /** A word of memory or flash, without side effects. @param {number | string} where address or symbol */
  read32(where) {
    return this.#board.read32(this.#address(where));
  }

  /** @param {number | string} where address or symbol @returns {Uint8Array} a copy */
  readBytes(where, length) {
    return this.#board.readBytes(this.#address(where), length);
  }

  /** Stores a word in SRAM as a debugger does, unseen by `onStore`. @param {number | string} where address or symbol */
  write32(where, value) {
    this.#board.write32(this.#inSram(where), value);
  }

  /**
   * Calls back after each store of the core or the DMA to a word of SRAM, without disturbing it.
   * @param {number | string} where address or symbol
   * @returns {() => void} ends it
   */
  onStore(where, callback) {
    const address = this.#inSram(where);
    this.#board.watch(address, callback);
    return () => this.#board.unwatch(address, callback);
  }

  // ---- log -----------------------------------------------------------------------------------

  /** The defmt log. @returns {readonly import('./log.js').StampedLine[]} */
  get log() {
    return this.#log.lines;
  }

  /** The log, which is then forgotten. */
  takeLog() {
    return this.#log.take();
  }

  /** A digest of everything that can be observed; equal runs have equal digests. */
  digest() {
    const hash = createHash('sha256');
    hash.update(JSON.stringify([this.timeNs, this.cycles, this.edges, this.boots, this.faults]));
    for (const uart of this.uart) hash.update(JSON.stringify(uart.received));
    if (this.powered) hash.update(this.#board.chip.sram);
    hash.update(this.flash.bytes);
    return hash.digest('hex');
  }

  // ---- inside --------------------------------------------------------------------------------

  #load(elfPath) {
    const elf = readElf(elfPath);
    if (!this.#board.flashSegments(elf.segments)) {
      throw new UsageError(`${elfPath} has nothing for the flash of a Pico`);
    }
    this.#elf = elf;
    if (this.#rtt) this.#board.unwatch(this.#rtt.watchAddress, this.#onFrameOffset);
    const control = elf.symbols.get('_SEGGER_RTT');
    this.#rtt = control ? new Rtt(control.address, (frame) => this.#onFrame(frame)) : null;
    if (this.#rtt) this.#board.watch(this.#rtt.watchAddress, this.#onFrameOffset);
  }

  #onFrame(frame) {
    this.#log.add(this.#elf.path, frame, this.timeNs, this.boots.length - 1);
    this.#board.clock.stop();
  }

  /** What is sent to a chip without power is lost. */
  #feed(uart, byte) {
    if (this.powered) this.#board.chip.uart[uart].feedByte(byte);
  }

  #onEdge(edge) {
    if (this.#recorded === true || (this.#recorded && this.#recorded.has(edge.pin))) this.edges.push(edge);
    for (const listener of this.#edgeListeners) listener(edge);
  }

  #address(where) {
    return typeof where === 'string' ? this.symbol(where).address : where;
  }

  #inSram(where) {
    const address = this.#address(where);
    if (address >= SRAM_BASE && address < SRAM_BASE + SRAM_SIZE) return address;
    throw new UsageError(`0x${address.toString(16)} is not in SRAM`);
  }
}

function fits(edge, { pin, level, fromNs = 0, toNs = Infinity }) {
  if (Array.isArray(pin) ? !pin.includes(edge.pin) : pin !== undefined && pin !== edge.pin) return false;
  if (level !== undefined && level !== edge.level) return false;
  return edge.timeNs >= fromNs && edge.timeNs < toNs;
}

function flashContents(flash) {
  const bytes = typeof flash === 'string' ? readFileSync(flash) : flash;
  if (bytes.length > FLASH_SIZE) throw new UsageError(`${bytes.length} bytes do not fit into the flash`);
  return bytes;
}

function checkDuration(ms) {
  if (!(ms >= 0 && Number.isFinite(ms))) throw new UsageError(`a time in milliseconds cannot be ${ms}`);
}
