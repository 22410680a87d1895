/** The emulated Raspberry Pi Pico: see `Pico`. */
export { UsageError } from './fault.js';
export { Pico } from './pico.js';
