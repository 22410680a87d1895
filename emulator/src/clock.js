/**
 * Simulated time in whole nanoseconds, kept exactly: while the core runs, time is the number of
 * cycles it has spent (with the fraction of a nanosecond carried along as an integer); while it
 * sleeps, time jumps from alarm to alarm.
 *
 * It offers what the peripherals of `rp2040js` ask of a clock (`nanos`, `micros`, `createAlarm`),
 * so that they take it in place of the package's own, which adds up floating-point nanoseconds.
 */

/** The core looks around at least this often, in cycles (8 ms at 125 MHz). */
const MAX_SLICE = 1 << 20;

class Alarm {
  scheduled = false;
  at = 0;
  next = null;
  #clock;

  constructor(clock, callback, lasting) {
    this.#clock = clock;
    this.callback = callback;
    this.lasting = lasting;
  }

  /** Fires in `delay` nanoseconds, rounded up to a whole one. Replaces what was scheduled. */
  schedule(delay) {
    this.scheduleAt(this.#clock.nanos + Math.max(0, Math.ceil(delay)));
  }

  /** Fires at an absolute time; a past one means as soon as possible. */
  scheduleAt(nanos) {
    if (this.scheduled) this.#clock.unlink(this);
    this.#clock.link(this, nanos);
  }

  cancel() {
    if (this.scheduled) this.#clock.unlink(this);
  }
}

export class Clock {
  /** Cycles the core has run since the last `commit`; the executor counts here. */
  slice = 0;
  /** The executor returns when `slice` reaches this. */
  limit = 0;

  #base = 0;
  /** Of a nanosecond, as a numerator over `#frequency`. */
  #fraction = 0;
  #frequency;
  #nextFrequency = 0;
  #first = null;
  /** The time of the alarm being fired, or -1. */
  #firingAt = -1;
  #cycles = 0;

  /** @param {number} [frequency] of the core, in hertz */
  constructor(frequency = 125_000_000) {
    this.#frequency = frequency;
  }

  /** Now, in nanoseconds since the bench was set up. */
  get nanos() {
    if (this.#firingAt >= 0) return this.#firingAt;
    if (this.slice === 0) return this.#base;
    return this.#base + Math.floor((this.#fraction + this.slice * 1e9) / this.#frequency);
  }

  get micros() {
    return this.nanos / 1000;
  }

  /** Cycles in which the core was awake, since the bench was set up. */
  get cycles() {
    return this.#cycles + this.slice;
  }

  /** When the next alarm is due, in nanoseconds; infinite when none is. */
  get nextAlarm() {
    return this.#first ? this.#first.at : Infinity;
  }

  /**
   * @param {() => void} callback
   * @param {{lasting?: boolean}} [options] `lasting`: survives `dropAlarms`, belongs to the bench
   */
  createAlarm(callback, { lasting = false } = {}) {
    return new Alarm(this, callback, lasting);
  }

  /** Takes effect after the instruction that changes the clock. */
  setFrequency(hertz) {
    this.#nextFrequency = hertz;
    this.stop();
  }

  /** Makes the executor return after the present instruction. */
  stop() {
    this.limit = 0;
  }

  /** Sets the executor's limit: up to `until` or the next alarm, whichever is first. */
  begin(until) {
    this.limit = this.#cyclesTo(Math.min(until, this.nextAlarm));
  }

  /** Turns the cycles of this slice into time. */
  commit() {
    if (this.slice > 0) {
      const total = this.#fraction + this.slice * 1e9;
      this.#base += Math.floor(total / this.#frequency);
      this.#fraction = total % this.#frequency;
      this.#cycles += this.slice;
      this.slice = 0;
    }
    if (this.#nextFrequency) {
      this.#frequency = this.#nextFrequency;
      this.#nextFrequency = 0;
      this.#fraction = 0;
    }
  }

  /** Sleeps until `nanos`; fires nothing by itself. */
  advanceTo(nanos) {
    if (nanos > this.#base) {
      this.#base = nanos;
      this.#fraction = 0;
    }
  }

  /** Fires every alarm that is due, each at its own time, in order. */
  fire() {
    while (this.#first && this.#first.at <= this.#base) {
      const alarm = this.#first;
      this.unlink(alarm);
      this.#firingAt = alarm.at;
      try {
        alarm.callback();
      } finally {
        this.#firingAt = -1;
      }
    }
  }

  /** Forgets the alarms of a chip that is no more. */
  dropAlarms() {
    for (let alarm = this.#first; alarm; alarm = alarm.next) {
      if (!alarm.lasting) this.unlink(alarm);
    }
  }

  link(alarm, nanos) {
    let before = null;
    let after = this.#first;
    while (after && after.at <= nanos) {
      before = after;
      after = after.next;
    }
    alarm.at = nanos;
    alarm.next = after;
    alarm.scheduled = true;
    if (before) before.next = alarm;
    else this.#first = alarm;
    this.limit = Math.min(this.limit, this.#cyclesTo(nanos));
  }

  unlink(alarm) {
    let before = null;
    for (let item = this.#first; item; item = item.next) {
      if (item === alarm) {
        if (before) before.next = alarm.next;
        else this.#first = alarm.next;
        break;
      }
      before = item;
    }
    alarm.scheduled = false;
  }

  #cyclesTo(nanos) {
    const span = Math.min(Math.max(0, nanos - this.#base), 1e7);
    const cycles = Math.ceil((span * this.#frequency - this.#fraction) / 1e9);
    return Math.min(Math.max(0, cycles), MAX_SLICE);
  }
}
