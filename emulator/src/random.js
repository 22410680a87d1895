/**
 * Small deterministic random numbers (xorshift32), for the contents of memory at power-up, for the
 * bits of a torn flash page and for the ring oscillator's random bit.
 */
export class Random {
  #state;

  /** @param {number} seed any integer; equal seeds give equal sequences */
  constructor(seed) {
    // Spread near seeds apart; xorshift must not start at zero.
    this.#state = Math.imul((seed >>> 0) ^ 0x9e37_79b9, 0x85eb_ca6b) >>> 0 || 1;
  }

  /** @returns {number} an unsigned 32-bit integer */
  next() {
    let x = this.#state;
    x ^= x << 13;
    x ^= x >>> 17;
    x ^= x << 5;
    return (this.#state = x >>> 0);
  }

  /** @returns {number} at least 0, less than 1 */
  fraction() {
    return this.next() / 2 ** 32;
  }

  /** @param {Uint8Array} bytes overwritten with noise */
  fill(bytes) {
    const words = new Uint32Array(bytes.buffer, bytes.byteOffset, bytes.length >>> 2);
    for (let i = 0; i < words.length; i++) words[i] = this.next();
  }
}
