/**
 * A PL011 UART (ARM DDI 0183; RP2040 datasheet, section 4.2) with FIFOs, characters that take their
 * time on the line, interrupts by FIFO level, and the receive time-out. The package's own UART raises
 * its transmit interrupt again on every write to UARTICR, in which interrupt-driven drivers get stuck.
 */
import { BasePeripheral } from 'rp2040js';

const DR = 0x00;
const RSR = 0x04;
const FR = 0x18;
const IBRD = 0x24;
const FBRD = 0x28;
const LCR_H = 0x2c;
const CR = 0x30;
const IFLS = 0x34;
const IMSC = 0x38;
const RIS = 0x3c;
const MIS = 0x40;
const ICR = 0x44;
const DMACR = 0x48;
const ID_FIRST = 0xfe0;
const ID_BYTES = [0x11, 0x10, 0x34, 0x00, 0x0d, 0xf0, 0x05, 0xb1];

const FR_BUSY = 1 << 3;
const FR_RX_EMPTY = 1 << 4;
const FR_TX_FULL = 1 << 5;
const FR_RX_FULL = 1 << 6;
const FR_TX_EMPTY = 1 << 7;
const LCR_PARITY = 1 << 1;
const LCR_TWO_STOP = 1 << 3;
const LCR_FIFOS = 1 << 4;
const CR_ENABLE = 1;
const CR_TX = 1 << 8;
const CR_RX = 1 << 9;
const DATA_OVERRUN = 1 << 11;

export const INTERRUPT = { rx: 1 << 4, tx: 1 << 5, rxTimeout: 1 << 6, overrun: 1 << 10 };

const FIFO_DEPTH = 32;
/** UARTIFLS: eighths of the FIFO. */
const TRIGGER_EIGHTHS = [1, 2, 4, 6, 7];
const TIMEOUT_BITS = 32;

export class Pl011 extends BasePeripheral {
  /** Called with each byte that has left on the line. @type {(byte: number) => void} */
  onByte = () => {};

  #irq;
  #requests;
  #integerDivisor = 0;
  #fraction = 0;
  #lineControl = 0;
  #control = CR_TX | CR_RX;
  #triggers = 0x12;
  #mask = 0;
  #raw = 0;
  #dma = 0;
  #toSend = [];
  #received = [];
  /** Bytes on their way to us. */
  #incoming = [];
  #sending = -1;
  #overrun = false;
  #sendAlarm;
  #receiveAlarm;
  #timeoutAlarm;

  /**
   * @param {import('./chip.js').Chip} chip
   * @param {string} name
   * @param {number} irq number of its interrupt
   * @param {{tx: number, rx: number}} requests numbers of its DMA requests
   */
  constructor(chip, name, irq, requests) {
    super(chip, name);
    this.#irq = irq;
    this.#requests = requests;
    this.#sendAlarm = chip.clock.createAlarm(() => this.#sent());
    this.#receiveAlarm = chip.clock.createAlarm(() => this.#arrived());
    this.#timeoutAlarm = chip.clock.createAlarm(() => {
      if (this.#received.length) this.#raise(INTERRUPT.rxTimeout);
    });
  }

  /** One bit on the line, in nanoseconds. */
  get bitNs() {
    const divisor = this.#integerDivisor + this.#fraction / 64 || 1;
    return (16e9 * divisor) / this.rp2040.clkPeri;
  }

  /** Bits per second. */
  get baud() {
    return 1e9 / this.bitNs;
  }

  /** A byte from outside begins to arrive, after those before it. */
  feedByte(byte) {
    this.#incoming.push(byte);
    if (this.#incoming.length === 1) this.#receiveAlarm.schedule(this.#characterNs);
  }

  /** The package tells of a changed peripheral clock; the divisors are read when they are used. */
  clkPeriChanged() {}

  readUint32(offset) {
    if (offset >= ID_FIRST) return ID_BYTES[(offset - ID_FIRST) >> 2];
    switch (offset) {
      case DR:
        return this.#read();
      case RSR:
        return this.#overrun ? 8 : 0;
      case FR:
        return this.#flags;
      case IBRD:
        return this.#integerDivisor;
      case FBRD:
        return this.#fraction;
      case LCR_H:
        return this.#lineControl;
      case CR:
        return this.#control;
      case IFLS:
        return this.#triggers;
      case IMSC:
        return this.#mask;
      case RIS:
        return this.#raw;
      case MIS:
        return this.#raw & this.#mask;
      case ICR:
        return 0;
      case DMACR:
        return this.#dma;
    }
    return super.readUint32(offset);
  }

  writeUint32(offset, value) {
    switch (offset) {
      case DR:
        this.#write(value & 0xff);
        break;
      case RSR:
        this.#overrun = false;
        break;
      case IBRD:
        this.#integerDivisor = value & 0xffff;
        break;
      case FBRD:
        this.#fraction = value & 0x3f;
        break;
      case LCR_H:
        this.#lineControl = value & 0xff;
        break;
      case CR:
        this.#control = value & 0xffff;
        this.#send();
        this.#request();
        break;
      case IFLS:
        this.#triggers = value & 0x3f;
        break;
      case IMSC:
        this.#mask = value & 0x7ff;
        this.#interrupt();
        break;
      case ICR:
        this.#raw &= ~this.rawWriteValue;
        this.#interrupt();
        break;
      case DMACR:
        this.#dma = value & 7;
        this.#request();
        break;
      default:
        super.writeUint32(offset, value);
    }
  }

  get #depth() {
    return this.#lineControl & LCR_FIFOS ? FIFO_DEPTH : 1;
  }

  /** Start, data, parity and stop bits, in nanoseconds. */
  get #characterNs() {
    const data = 5 + ((this.#lineControl >> 5) & 3);
    const parity = this.#lineControl & LCR_PARITY ? 1 : 0;
    const stop = this.#lineControl & LCR_TWO_STOP ? 2 : 1;
    return (1 + data + parity + stop) * this.bitNs;
  }

  get #flags() {
    const sending = this.#sending >= 0;
    return (
      (sending || this.#toSend.length ? FR_BUSY : 0) |
      (this.#received.length ? 0 : FR_RX_EMPTY) |
      (this.#toSend.length >= this.#depth ? FR_TX_FULL : 0) |
      (this.#received.length >= this.#depth ? FR_RX_FULL : 0) |
      (this.#toSend.length ? 0 : FR_TX_EMPTY)
    );
  }

  /** The transmit interrupt comes when the FIFO sinks to this. */
  get #sendTrigger() {
    return this.#depth === 1 ? 0 : trigger(this.#triggers & 7);
  }

  /** The receive interrupt comes when the FIFO fills to this. */
  get #receiveTrigger() {
    return this.#depth === 1 ? 1 : trigger((this.#triggers >> 3) & 7);
  }

  #write(byte) {
    if (this.#toSend.length < this.#depth) this.#toSend.push(byte);
    if (this.#toSend.length > this.#sendTrigger) this.#clear(INTERRUPT.tx);
    this.#send();
    this.#request();
  }

  /** Puts the next byte on the line, if the line is free. */
  #send() {
    const enabled = (this.#control & (CR_ENABLE | CR_TX)) === (CR_ENABLE | CR_TX);
    if (!enabled || this.#sending >= 0 || !this.#toSend.length) return;
    this.#sending = this.#toSend.shift();
    this.#sendAlarm.schedule(this.#characterNs);
    if (this.#toSend.length === this.#sendTrigger) this.#raise(INTERRUPT.tx);
  }

  #sent() {
    const byte = this.#sending;
    this.#sending = -1;
    this.onByte(byte);
    this.#send();
    this.#request();
  }

  #arrived() {
    const byte = this.#incoming.shift();
    if (this.#incoming.length) this.#receiveAlarm.schedule(this.#characterNs);
    if ((this.#control & (CR_ENABLE | CR_RX)) !== (CR_ENABLE | CR_RX)) return;
    if (this.#received.length >= this.#depth) {
      this.#overrun = true;
      this.#raise(INTERRUPT.overrun);
    } else {
      this.#received.push(this.#overrun ? byte | DATA_OVERRUN : byte);
      this.#overrun = false;
      if (this.#received.length >= this.#receiveTrigger) this.#raise(INTERRUPT.rx);
    }
    this.#timeoutAlarm.schedule(TIMEOUT_BITS * this.bitNs);
    this.#request();
  }

  #read() {
    const value = this.#received.shift() ?? 0;
    if (this.#received.length < this.#receiveTrigger) this.#clear(INTERRUPT.rx);
    if (!this.#received.length) this.#clear(INTERRUPT.rxTimeout);
    this.#request();
    return value;
  }

  #raise(interrupt) {
    this.#raw |= interrupt;
    this.#interrupt();
  }

  #clear(interrupt) {
    this.#raw &= ~interrupt;
    this.#interrupt();
  }

  #interrupt() {
    this.rp2040.setInterrupt(this.#irq, (this.#raw & this.#mask) !== 0);
  }

  /** The DMA may bring a byte while there is room, and take one while there is one. */
  #request() {
    const { dma } = this.rp2040;
    const enabled = (this.#control & CR_ENABLE) !== 0;
    const set = (number, wanted) => (wanted ? dma.setDREQ(number) : dma.clearDREQ(number));
    set(this.#requests.tx, enabled && (this.#dma & 2) !== 0 && this.#toSend.length < this.#depth);
    set(this.#requests.rx, enabled && (this.#dma & 1) !== 0 && this.#received.length > 0);
  }
}

function trigger(select) {
  return ((TRIGGER_EIGHTHS[select] ?? 4) * FIFO_DEPTH) / 8;
}
