/** As much of a chip as a single model needs around it. */
import { Clock } from '../../src/clock.js';

export class FakeChip {
  clock = new Clock();
  clkPeri = 125e6;
  /** Interrupt lines that are high. @type {Set<number>} */
  interrupts = new Set();
  /** DMA requests that are set. @type {Set<number>} */
  requests = new Set();
  /** @type {string[]} */
  warnings = [];
  logger = { warn: (source, text) => this.warnings.push(`${source}: ${text}`) };
  dma = {
    setDREQ: (number) => this.requests.add(number),
    clearDREQ: (number) => this.requests.delete(number),
  };

  setInterrupt(irq, level) {
    if (level) this.interrupts.add(irq);
    else this.interrupts.delete(irq);
  }

  /** Lets nanoseconds pass, alarm by alarm. */
  pass(nanos) {
    const until = this.clock.nanos + nanos;
    while (this.clock.nextAlarm <= until) {
      this.clock.advanceTo(this.clock.nextAlarm);
      this.clock.fire();
    }
    this.clock.advanceTo(until);
  }
}
