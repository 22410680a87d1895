// An emulated board with one of the applications on it, followed scan by scan.

import assert from 'node:assert/strict';

import { Pico } from '../../../emulator/src/index.js';

/** Channel 0 of the converter is at this pin. */
const FIRST_ANALOGUE_PIN = 26;
/** From power to scan 0 at most, and from one scan to the next. */
const LONGEST_WAIT_MS = 1000;

export class Bench {
  #application;
  #completed = false;

  /**
   * @param {import('./application.js').Application} application
   * @param {object} [options] of the board
   */
  constructor(application, options = {}) {
    this.#application = application;
    this.pico = new Pico(application.image, { powered: false, recordEdges: false, ...options });
    // The start-up code stores there too, before scan 0 does; it stores a zero.
    this.pico.onStore('PLC_SCANS', () => (this.#completed = this.scans > 0));
  }

  /** Scans completed since the board started. */
  get scans() {
    return this.pico.read32('PLC_SCANS');
  }

  /** Wires these levels and readings to the pins, in the order of the application's inputs. */
  connect(values) {
    this.#application.inputs.forEach(({ pin, activeLow, scale }, i) => {
      if (scale) this.pico.setAnalog(pin - FIRST_ANALOGUE_PIN, values[i]);
      else this.pico.setInput(pin, activeLow ? 1 - values[i] : values[i]);
    });
  }

  /** Runs to the end of the next scan. */
  scan() {
    this.#completed = false;
    assert.ok(this.pico.runUntil(() => this.#completed, LONGEST_WAIT_MS), `a scan comes after ${this.scans}`);
  }

  /** What the memory of the image holds, as a row of a trace. */
  row(timeMs) {
    const { graphs, columns, variables } = this.#application.symbols;
    const images = this.#images();
    const situation = ({ steps }) => steps.filter(({ bit }) => images.bit(bit)).map(({ id }) => id).join(' ');
    const named = columns.slice(1 + graphs.length).map((name) => images.value(variables[name]));
    return [timeMs, ...graphs.map(situation), ...named].join(',');
  }

  /** A variable or parameter by its qualified name. */
  value(name) {
    return this.#images().value(this.#application.symbols.variables[name]);
  }

  /** Gives a variable or parameter a value between two scans, as a debugger does. */
  give(name, value) {
    const { layout, variables } = this.#application.symbols;
    const { bit, number } = variables[name];
    const { address } = this.pico.symbol('PLC_STORAGE');
    if (bit === undefined) {
      this.pico.write32(address + 4 * (layout.words + number), value >>> 0);
      return;
    }
    const word = address + 4 * (bit >>> 5);
    const others = this.pico.read32(word) & ~(1 << (bit & 31));
    this.pico.write32(word, (others | (value << (bit & 31))) >>> 0);
  }

  #images() {
    const { words, numbers } = this.#application.symbols.layout;
    const bytes = this.pico.readBytes('PLC_STORAGE', 4 * (words + numbers));
    const image = new Uint32Array(bytes.buffer, bytes.byteOffset, words);
    const values = new Int32Array(bytes.buffer, bytes.byteOffset + 4 * words, numbers);
    const bit = (index) => (image[index >>> 5] >>> (index & 31)) & 1;
    return { bit, value: ({ bit: index, number }) => (index === undefined ? values[number] : bit(index)) };
  }
}
