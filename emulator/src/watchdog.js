/**
 * The watchdog (RP2040 datasheet, section 4.7), with the erratum that firmware must reckon with: it
 * counts down by two in each microsecond (RP2040-E1). It also holds the tick that makes the system
 * timer count, eight scratch words, and the reason of the last reset.
 */
import { BasePeripheral } from 'rp2040js';

const CTRL = 0x00;
const LOAD = 0x04;
const REASON = 0x08;
const SCRATCH0 = 0x0c;
const SCRATCH7 = 0x28;
const TICK = 0x2c;

const TRIGGER = 2 ** 31;
const ENABLE = 1 << 30;
const PAUSE_BITS = 7 << 24;
const TIME_MASK = 0xff_ffff;
const TICK_RUNNING = 1 << 10;
const TICK_ENABLE = 1 << 9;
const TICK_CYCLES = 0x1ff;

/** One count: two to the microsecond. */
const COUNT_NS = 500;

/** WATCHDOG.REASON. */
export const REASON_BITS = { none: 0, timer: 1, force: 2 };

export class Watchdog extends BasePeripheral {
  scratch;
  #reason;
  #clock;
  #alarm;
  #onReset;
  #onTick;
  #control = PAUSE_BITS;
  #tick = TICK_ENABLE;
  /** Nanoseconds left to count at `#since`. */
  #left = 0;
  #since = 0;

  /**
   * @param {import('./chip.js').Chip} chip
   * @param {object} options
   * @param {number} options.reason what REASON shows, one of `REASON_BITS`
   * @param {Uint32Array} options.scratch the eight scratch words
   * @param {(reason: number) => void} options.onReset the watchdog has fired
   * @param {() => void} [options.onTick] the tick has started
   */
  constructor(chip, { reason, scratch, onReset, onTick = () => {} }) {
    super(chip, 'WATCHDOG');
    this.#reason = reason;
    this.scratch = scratch.slice();
    this.#onReset = onReset;
    this.#onTick = onTick;
    this.#clock = chip.clock;
    this.#alarm = chip.clock.createAlarm(() => {
      this.#settle();
      this.#onReset(REASON_BITS.timer);
    });
  }

  get ticking() {
    return (this.#tick & TICK_ENABLE) !== 0 && (this.#tick & TICK_CYCLES) !== 0;
  }

  readUint32(offset) {
    if (offset >= SCRATCH0 && offset <= SCRATCH7) return this.scratch[(offset - SCRATCH0) >> 2];
    switch (offset) {
      case CTRL:
        this.#settle();
        return (this.#control | Math.ceil(this.#left / COUNT_NS)) >>> 0;
      case LOAD:
        return 0;
      case REASON:
        return this.#reason;
      case TICK:
        return this.#tick | (this.ticking ? TICK_RUNNING : 0);
    }
    return super.readUint32(offset);
  }

  writeUint32(offset, value) {
    if (offset >= SCRATCH0 && offset <= SCRATCH7) {
      this.scratch[(offset - SCRATCH0) >> 2] = value;
      return;
    }
    this.#settle();
    switch (offset) {
      case CTRL:
        this.#control = value & (ENABLE | PAUSE_BITS);
        if (value >>> 0 >= TRIGGER) this.#onReset(REASON_BITS.force);
        break;
      case LOAD:
        this.#left = (value & TIME_MASK) * COUNT_NS;
        break;
      case REASON:
        break;
      case TICK:
        this.#tick = value & (TICK_ENABLE | TICK_CYCLES);
        if (this.ticking) this.#onTick();
        break;
      default:
        super.writeUint32(offset, value);
        return;
    }
    this.#arm();
  }

  get #counting() {
    return (this.#control & ENABLE) !== 0 && this.ticking;
  }

  /** Brings the time left up to now. */
  #settle() {
    const now = this.#clock.nanos;
    if (this.#counting) this.#left = Math.max(0, this.#left - (now - this.#since));
    this.#since = now;
  }

  #arm() {
    if (this.#counting) this.#alarm.schedule(this.#left);
    else this.#alarm.cancel();
  }
}
