/**
 * The debugger's end of SEGGER RTT: takes what firmware writes to up-channel 0 of `_SEGGER_RTT` in
 * the very moment of its write, so that the buffer never fills, and cuts it into defmt frames.
 */

const ID = 'SEGGER RTT';
/** Up-channel 0 behind the identifier and the two counts of channels. */
const UP = 24;
const BUFFER = UP + 4;
const SIZE = UP + 8;
const WRITE_OFFSET = UP + 12;
const READ_OFFSET = UP + 16;
/** No defmt frame is longer; what is, is not defmt. */
const MAX_FRAME = 16 * 1024;

export class Rtt {
  /** Address of the word which firmware stores to after each piece that it has written. */
  watchAddress;
  #address;
  #onFrame;
  #frame = [];

  /**
   * @param {number} address of `_SEGGER_RTT`
   * @param {(frame: Uint8Array) => void} onFrame told of each frame, without its closing zero
   */
  constructor(address, onFrame) {
    this.#address = address;
    this.#onFrame = onFrame;
    this.watchAddress = address + WRITE_OFFSET;
  }

  /** A new run of the firmware: nothing is in the buffer, an unfinished frame stays so. */
  restart(memory) {
    this.#frame = [];
    memory.write32(this.#address + WRITE_OFFSET, 0);
    memory.write32(this.#address + READ_OFFSET, 0);
  }

  /**
   * Firmware has moved its write offset.
   * @param {{read32: (address: number) => number, write32: (address: number, value: number) => void,
   *   readBytes: (address: number, length: number) => Uint8Array}} memory without side effects
   */
  take(memory) {
    if (!this.#isSetUp(memory)) return;
    const size = memory.read32(this.#address + SIZE);
    const buffer = memory.readBytes(memory.read32(this.#address + BUFFER), size);
    const end = memory.read32(this.#address + WRITE_OFFSET);
    let at = memory.read32(this.#address + READ_OFFSET);
    if (at >= size || end >= size) return;
    for (; at !== end; at = (at + 1) % size) this.#push(buffer[at]);
    memory.write32(this.#address + READ_OFFSET, end);
  }

  #isSetUp(memory) {
    const id = Buffer.from(memory.readBytes(this.#address, ID.length)).toString('latin1');
    return id === ID && memory.read32(this.#address + SIZE) > 0;
  }

  #push(byte) {
    if (byte !== 0) {
      if (this.#frame.length < MAX_FRAME) this.#frame.push(byte);
    } else if (this.#frame.length) {
      this.#onFrame(Uint8Array.from(this.#frame));
      this.#frame = [];
    }
  }
}
