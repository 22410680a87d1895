/**
 * The 64-bit microsecond timer and its four alarms (RP2040 datasheet, section 4.6), exact to the
 * nanosecond of the watchdog's first tick. An alarm fires when the lower word equals its target, so
 * one in the past fires only after the word has gone round, in 71 minutes.
 */
import { BasePeripheral } from 'rp2040js';
import { IRQ } from './map.js';

const TIMEHW = 0x00;
const TIMELW = 0x04;
const TIMEHR = 0x08;
const TIMELR = 0x0c;
const ALARM0 = 0x10;
const ALARM3 = 0x1c;
const ARMED = 0x20;
const TIMERAWH = 0x24;
const TIMERAWL = 0x28;
const DBGPAUSE = 0x2c;
const PAUSE = 0x30;
const INTR = 0x34;
const INTE = 0x38;
const INTF = 0x3c;
const INTS = 0x40;

export class Timer extends BasePeripheral {
  #clock;
  #running = false;
  /** Microseconds counted at `#since` nanoseconds. */
  #count;
  #since = 0;
  #latchedHigh = 0;
  #writtenLow = 0;
  #targets = [0, 0, 0, 0];
  #alarms;
  #raw = 0;
  #enabled = 0;
  #forced = 0;

  /**
   * @param {import('./chip.js').Chip} chip
   * @param {number} [startUs] what the timer counts from; silicon starts at 0
   */
  constructor(chip, startUs = 0) {
    super(chip, 'TIMER');
    this.#clock = chip.clock;
    this.#count = startUs;
    this.#alarms = [0, 1, 2, 3].map((n) => chip.clock.createAlarm(() => this.#onAlarm(n)));
  }

  /** The tick has begun. */
  start() {
    if (this.#running) return;
    this.#running = true;
    this.#since = this.#clock.nanos;
  }

  /** Microseconds now. */
  get micros() {
    if (!this.#running) return this.#count;
    return this.#count + Math.floor((this.#clock.nanos - this.#since) / 1000);
  }

  /**
   * Counts on from `us` microseconds later, as if nothing had run meanwhile: alarms that are leapt over go off now.
   * @param {number} us a whole number
   */
  leap(us) {
    const from = this.micros;
    this.#count += us;
    this.#alarms.forEach((alarm, n) => {
      if (!alarm.scheduled) return;
      const wait = (((this.#targets[n] - from) % 2 ** 32) + 2 ** 32) % 2 ** 32;
      if (wait <= us) alarm.scheduleAt(this.#clock.nanos);
      else this.#arm(n, this.#targets[n]);
    });
  }

  readUint32(offset) {
    if (offset >= ALARM0 && offset <= ALARM3) return this.#targets[(offset - ALARM0) >> 2];
    switch (offset) {
      case TIMEHW:
      case TIMELW:
        return 0;
      case TIMELR: {
        const now = this.micros;
        this.#latchedHigh = Math.floor(now / 2 ** 32);
        return now % 2 ** 32;
      }
      case TIMEHR:
        return this.#latchedHigh;
      case TIMERAWH:
        return Math.floor(this.micros / 2 ** 32);
      case TIMERAWL:
        return this.micros % 2 ** 32;
      case ARMED:
        return this.#alarms.reduce((bits, alarm, n) => bits | (alarm.scheduled ? 1 << n : 0), 0);
      case DBGPAUSE:
        return 6;
      case PAUSE:
        return 0; // pausing is not modelled: a write is a warning
      case INTR:
        return this.#raw;
      case INTE:
        return this.#enabled;
      case INTF:
        return this.#forced;
      case INTS:
        return (this.#raw & this.#enabled) | this.#forced;
    }
    return super.readUint32(offset);
  }

  writeUint32(offset, value) {
    if (offset >= ALARM0 && offset <= ALARM3) {
      this.#arm((offset - ALARM0) >> 2, value >>> 0);
      return;
    }
    switch (offset) {
      case TIMELW:
        this.#writtenLow = value >>> 0;
        return;
      case TIMEHW:
        this.#count = (value >>> 0) * 2 ** 32 + this.#writtenLow;
        this.#since = this.#clock.nanos;
        this.#rearm();
        return;
      case ARMED:
        this.#alarms.forEach((alarm, n) => this.rawWriteValue & (1 << n) && alarm.cancel());
        return;
      case DBGPAUSE:
        return;
      case INTR:
        this.#raw &= ~this.rawWriteValue;
        break;
      case INTE:
        this.#enabled = value & 15;
        break;
      case INTF:
        this.#forced = value & 15;
        break;
      default:
        super.writeUint32(offset, value);
        return;
    }
    this.#updateInterrupts();
  }

  #arm(n, target) {
    this.#targets[n] = target;
    if (!this.#running) return;
    const now = this.micros;
    const wait = (target - now) % 2 ** 32;
    const at = now + (wait < 0 ? wait + 2 ** 32 : wait);
    this.#alarms[n].scheduleAt(Math.max(this.#clock.nanos, this.#since + (at - this.#count) * 1000));
  }

  #rearm() {
    this.#alarms.forEach((alarm, n) => alarm.scheduled && this.#arm(n, this.#targets[n]));
  }

  #onAlarm(n) {
    this.#raw |= 1 << n;
    this.#updateInterrupts();
  }

  #updateInterrupts() {
    const status = (this.#raw & this.#enabled) | this.#forced;
    for (let n = 0; n < 4; n++) this.rp2040.setInterrupt(IRQ.timer0 + n, (status & (1 << n)) !== 0);
  }
}
