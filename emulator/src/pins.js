/**
 * The pads of the chip and what is wired to them: which level each pin has, who drives it, and every
 * change of what the chip drives. Wiring outlives resets; the chip's drivers do not.
 */
import { UsageError } from './fault.js';
import { PIN_COUNT } from './map.js';

/** Of `irqStatus` in the package's pins: edges seen. */
const EDGE_BITS = 0b1100;

/**
 * @typedef {object} Edge
 * @property {number} pin GPIO number
 * @property {0 | 1 | null} level what the chip drives from now on; null: its driver is off
 * @property {number} timeNs
 */

export class Pins {
  #clock;
  #onEdge;
  /** @type {import('./chip.js').Chip | null} */
  #chip = null;
  /** What is wired to each pin: 0, 1, or null for nothing. */
  #inputs = new Array(PIN_COUNT).fill(null);
  #drives = new Array(PIN_COUNT).fill(null);
  #levels = new Array(PIN_COUNT).fill(0);

  /**
   * @param {{nanos: number}} clock
   * @param {(edge: Edge) => void} onEdge
   */
  constructor(clock, onEdge) {
    this.#clock = clock;
    this.#onEdge = onEdge;
  }

  /** A chip has come out of reset: all its drivers are off. */
  attach(chip) {
    this.#chip = chip;
    chip.gpio.forEach((gpio, pin) => {
      this.#levels[pin] = this.#levelOf(pin, gpio);
      gpio.setInputValue(this.#levels[pin] === 1);
      gpio.irqStatus &= ~EDGE_BITS;
      gpio.addListener(() => this.#update(pin));
    });
  }

  /** Reset, or no power: the drivers go off. */
  release() {
    this.#chip = null;
    for (let pin = 0; pin < PIN_COUNT; pin++) {
      this.#levels[pin] = this.#inputs[pin] ?? 0;
      this.#drive(pin, null);
    }
  }

  /**
   * Wires a level to a pin from outside.
   * @param {number} pin GPIO number
   * @param {0 | 1 | boolean | null} level null: nothing is connected, the pull resistors decide
   */
  setInput(pin, level) {
    checkPin(pin);
    if (level !== null && level !== 0 && level !== 1 && typeof level !== 'boolean') {
      throw new UsageError(`the level of pin ${pin} must be 0, 1 or null, not ${level}`);
    }
    this.#inputs[pin] = level === null ? null : Number(level);
    if (this.#chip) this.#update(pin);
    else this.#levels[pin] = this.#inputs[pin] ?? 0;
  }

  /** @returns {0 | 1} the level of the pin: what the chip drives, else what is wired, else the pull */
  level(pin) {
    checkPin(pin);
    return this.#levels[pin];
  }

  /** @returns {boolean} whether the chip's output driver is on */
  driven(pin) {
    checkPin(pin);
    return this.#drives[pin] !== null;
  }

  #update(pin) {
    const gpio = this.#chip.gpio[pin];
    const level = this.#levelOf(pin, gpio);
    this.#drive(pin, gpio.outputEnable ? level : null);
    if (level !== this.#levels[pin]) {
      this.#levels[pin] = level;
      gpio.setInputValue(level === 1);
    }
  }

  #levelOf(pin, gpio) {
    if (gpio.outputEnable) return gpio.outputValue ? 1 : 0;
    if (this.#inputs[pin] !== null) return this.#inputs[pin];
    if (gpio.pullupEnabled === gpio.pulldownEnabled) return this.#levels[pin]; // floats, or is kept
    return gpio.pullupEnabled ? 1 : 0;
  }

  #drive(pin, level) {
    if (level === this.#drives[pin]) return;
    this.#drives[pin] = level;
    this.#onEdge({ pin, level, timeNs: this.#clock.nanos });
  }
}

function checkPin(pin) {
  if (!Number.isInteger(pin) || pin < 0 || pin >= PIN_COUNT) {
    throw new UsageError(`there is no pin ${pin}: the GPIOs are 0 to ${PIN_COUNT - 1}`);
  }
}
