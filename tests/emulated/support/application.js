// An application as it was built: its program, its wires and its image.

import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const { PLC_IMAGE, PLC_IMAGES, PLC_RANDOM, PLC_HOST } = process.env;
const TOP = fileURLToPath(new URL('../../..', import.meta.url));
const grafcet = (...args) =>
  execFileSync(join(PLC_HOST, 'grafcet'), args, { cwd: TOP, encoding: 'utf8', maxBuffer: 1 << 28 });

/**
 * @typedef {object} Input
 * @property {string} name
 * @property {number} pin
 * @property {number} filterMs
 * @property {boolean} [activeLow] of a Boolean input
 * @property {{low: number, high: number}} [scale] of a numeric one: its values at both ends of the converter
 */

export class Application {
  /** The program that is flashed. */
  static flashed() {
    return new Application('plc.toml', PLC_IMAGE);
  }

  /** One of the programs in `tests/emulated/applications`. */
  static named(name) {
    return new Application(`tests/emulated/applications/${name}/plc.toml`, join(PLC_IMAGES, name));
  }

  /** One of the examples, of those that have an image. */
  static example(name) {
    return new Application(`graphs/examples/${name}/plc.toml`, join(PLC_IMAGES, name));
  }

  /** The random programs, which `reference/tests/differential/board.rs` writes. */
  static random() {
    const names = readdirSync(PLC_RANDOM).sort();
    return names.map((name) => new Application(join(PLC_RANDOM, name, 'plc.toml'), join(PLC_IMAGES, name)));
  }

  constructor(plc, image) {
    const path = resolve(TOP, plc);
    const wiring = readFileSync(path, 'utf8');
    /** Its directory's name. */
    this.name = basename(dirname(path));
    /** The ELF file. */
    this.image = image;
    /** The path of the program. */
    this.program = join(dirname(path), /^application = "(.*?)"/m.exec(wiring)[1]);
    /** What `grafcet symbols` says. */
    this.symbols = JSON.parse(grafcet('symbols', this.program));
    /** @type {Input[]} */
    this.inputs = wiredInputs(wiring, this.symbols.variables);
  }

  /** The trace on x86 of a stimulus, both in CSV; the rows, the header first. */
  traceOnX86(stimulus) {
    const folder = mkdtempSync(join(tmpdir(), 'plc-'));
    try {
      const file = join(folder, 'stimulus.csv');
      writeFileSync(file, stimulus);
      return grafcet('trace', this.program, '--stimulus', file).trimEnd().split('\n');
    } finally {
      rmSync(folder, { recursive: true });
    }
  }
}

/** A word without a scale is what the converter reads. */
const RAW = { low: 0, high: 4095 };

/** The inputs in the order of `plc.toml`, of which this reads what the applications here make use of. */
function wiredInputs(wiring, variables) {
  const names = new Map(Object.entries(variables).map(([name, { address }]) => [address, name]));
  const lines = wiring.matchAll(/^"(%I[^"]+)" = (.*)$/gm);
  const end = (key, value) => Number(new RegExp(`${key} = (-?\\d+)`).exec(value)?.[1] ?? RAW[key]);
  return Array.from(lines, ([, address, value]) => ({
    name: names.get(address),
    pin: Number(/"GP(\d+)"/.exec(value)[1]),
    filterMs: Number(/filter = "(\d+) ms"/.exec(value)?.[1] ?? 0),
    ...(address.startsWith('%IW')
      ? { scale: { low: end('low', value), high: end('high', value) } }
      : { activeLow: /active = "low"/.test(value) }),
  }));
}
