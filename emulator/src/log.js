/**
 * The firmware's defmt log: frames as they are written, lines when they are asked for.
 */
import { decodeFrames } from './defmt.js';

/** Undecoded frames are decoded by themselves before they fill memory. */
const MAX_PENDING = 100_000;

/**
 * @typedef {import('./defmt.js').LogLine & {timeNs: number, boot: number}} StampedLine
 *   with the simulated time at which the line was complete, and the index of its boot
 */

export class Log {
  /** How many frames have been written. */
  count = 0;
  #pending = [];
  /** @type {StampedLine[]} */
  #lines = [];

  /**
   * @param {string} elfPath the firmware that wrote it
   * @param {Uint8Array} frame
   * @param {number} timeNs
   * @param {number} boot
   */
  add(elfPath, frame, timeNs, boot) {
    this.count++;
    this.#pending.push({ elfPath, frame, timeNs, boot });
    if (this.#pending.length >= MAX_PENDING) this.#decode();
  }

  /** All lines that are kept. @returns {readonly StampedLine[]} */
  get lines() {
    this.#decode();
    return this.#lines;
  }

  /** All lines that are kept, which are then forgotten. */
  take() {
    const lines = this.lines;
    this.#lines = [];
    return lines;
  }

  #decode() {
    while (this.#pending.length) {
      const { elfPath } = this.#pending[0];
      const next = this.#pending.findIndex((entry) => entry.elfPath !== elfPath);
      const batch = this.#pending.slice(0, next < 0 ? undefined : next);
      const decoded = decodeFrames(elfPath, batch.map(({ frame }) => frame));
      this.#pending = this.#pending.slice(batch.length);
      decoded.forEach((line, i) => {
        const { timeNs, boot } = batch[i];
        if (line) this.#lines.push({ ...line, timeNs, boot });
      });
    }
  }
}
