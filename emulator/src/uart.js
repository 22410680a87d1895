/** The far end of a serial port: what arrives there, and what is sent from there. */
export class Uart {
  /** Bytes the chip has sent, oldest first. @type {number[]} */
  received = [];
  /** @type {(byte: number, timeNs: number) => void} */
  onByte = () => {};
  #feed;

  /** @param {(byte: number) => void} feed puts a byte on the chip's receive line */
  constructor(feed) {
    this.#feed = feed;
  }

  /** Everything received, as text. */
  get text() {
    return Buffer.from(this.received).toString('latin1');
  }

  /** Bytes received, which are then forgotten. */
  take() {
    const taken = Uint8Array.from(this.received);
    this.received = [];
    return taken;
  }

  /** Sends bytes to the chip, one after the other at its baud rate. @param {string | Uint8Array} data */
  send(data) {
    for (const byte of Buffer.from(data)) this.#feed(byte);
  }

  /** The chip has sent a byte. */
  deliver(byte, timeNs) {
    this.received.push(byte);
    this.onByte(byte, timeNs);
  }
}
