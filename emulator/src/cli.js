/**
 * The command line: boots an image and prints what it does, in the order in which it happens.
 */
import { existsSync, statSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { UsageError } from './fault.js';
import { FLASH_SIZE } from './map.js';
import { Pico } from './pico.js';

const HELP = `Boots a firmware image on an emulated Raspberry Pi Pico and prints what it does.

Usage: node emulator/bin/pico.mjs [OPTIONS] ELF

Options:
  --for MS               how long to run, in simulated milliseconds [default: 1000]
  --set PIN=LEVEL@MS     wire 0, 1 or z (nothing) to a GPIO at a time; give it as often as needed;
                         without @MS it holds from the start
  --analog CH=VALUE      what ADC channel 0 to 4 reads, 0 to 4095
  --flash FILE           keep the flash in this file: loaded before, if it is there, and saved after
  --cut MS               cut the power at this time for 100 ms; give it as often as needed
  --pins LIST            print the edges of these GPIOs only, such as 2,3,25; or none
  --seed N               of memory at power-up and of flash torn by a cut [default: 1]
  --help                 print this

Each line has the simulated time in seconds since power first came, then one of
  boot CAUSE             the firmware starts: power-on, run-pin, watchdog, watchdog-forced, core-reset
  pin N = LEVEL          what the chip drives from now on; z: its driver is off
  LEVEL TEXT             a line of the defmt log
  uart N: TEXT           a line sent on a serial port
  fault, halted, warning what silicon would not have liked, with the address of the instruction

Exit status: 0 when the time is over, 1 when the firmware faulted or stopped, 2 for wrong usage.

Examples:
  node emulator/bin/pico.mjs target/thumbv6m-none-eabi/release/plc
  node emulator/bin/pico.mjs plc.elf --for 5000 --set 2=1 --set 2=0@1500 --set 2=1@1600
  node emulator/bin/pico.mjs plc.elf --flash pico.bin --cut 300 --pins none
`;

const OPTIONS = {
  for: { type: 'string', default: '1000' },
  set: { type: 'string', multiple: true, default: [] },
  analog: { type: 'string', multiple: true, default: [] },
  flash: { type: 'string' },
  cut: { type: 'string', multiple: true, default: [] },
  pins: { type: 'string' },
  seed: { type: 'string', default: '1' },
  help: { type: 'boolean', short: 'h', default: false },
};

/** Printed together: simulated milliseconds. */
const SLICE_MS = 500;
const EXIT = { done: 0, stopped: 1, usage: 2 };

/**
 * @param {string[]} args without node and script
 * @param {NodeJS.WritableStream} out
 * @param {NodeJS.WritableStream} err
 * @returns {Promise<number>} the exit status
 */
export async function main(args, out, err) {
  let closed = false;
  out.on('error', () => (closed = true)); // such as a pager that was left
  try {
    const request = parse(args);
    if (request.help) {
      out.write(HELP);
      return EXIT.done;
    }
    return await run(request, (text) => out.write(text), () => closed);
  } catch (error) {
    if (!(error instanceof UsageError) && !error.syscall) throw error; // files have their say, too
    err.write(`error: ${error.message}\n`);
    return EXIT.usage;
  }
}

/** @throws {UsageError} with a hint where to read on */
function parse(args) {
  let parsed;
  try {
    parsed = parseArgs({ args, options: OPTIONS, allowPositionals: true });
  } catch (error) {
    throw new UsageError(`${error.message.split('. ')[0].toLowerCase()}; see --help`);
  }
  const { values, positionals } = parsed;
  if (values.help) return { help: true };
  if (positionals.length !== 1) {
    const what = positionals.length ? 'more than one image was named' : 'no image was named';
    throw new UsageError(`${what}; see --help`);
  }
  return {
    elf: positionals[0],
    forMs: number('--for', values.for),
    sets: values.set.map(parseSet),
    analog: values.analog.map(parseAnalog),
    flash: values.flash,
    cuts: values.cut.map((text) => number('--cut', text)),
    pins: values.pins === undefined ? true : parsePins(values.pins),
    seed: number('--seed', values.seed),
  };
}

function parseSet(text) {
  const match = /^(\d+)=([01z])(?:@(\d+(?:\.\d+)?))?$/.exec(text);
  if (!match) throw new UsageError(`--set ${text} is not PIN=LEVEL@MS, such as 2=1@500; see --help`);
  const level = match[2] === 'z' ? null : Number(match[2]);
  return { pin: Number(match[1]), level, atMs: Number(match[3] ?? 0) };
}

function parseAnalog(text) {
  const match = /^([0-4])=(\d+)$/.exec(text);
  if (!match) throw new UsageError(`--analog ${text} is not CHANNEL=VALUE, such as 0=2048; see --help`);
  return { channel: Number(match[1]), value: Number(match[2]) };
}

function parsePins(text) {
  if (text === 'none') return false;
  if (!/^\d+(,\d+)*$/.test(text)) throw new UsageError(`--pins ${text} is not a list such as 2,3,25`);
  return text.split(',').map(Number);
}

function number(option, text) {
  if (!/^\d+(\.\d+)?$/.test(text)) throw new UsageError(`${option} ${text} is not a number; see --help`);
  return Number(text);
}

async function run(request, write, closed) {
  const { elf, forMs, sets, analog, flash, cuts, pins, seed } = request;
  if (flash && existsSync(flash) && statSync(flash).size > FLASH_SIZE) {
    throw new UsageError(`${flash} is larger than the flash of a Pico`);
  }
  const early = sets.filter(({ atMs }) => atMs === 0);
  const pico = new Pico(elf, {
    flash: flash && existsSync(flash) ? flash : undefined,
    inputs: Object.fromEntries(early.map(({ pin, level }) => [pin, level])),
    recordEdges: pins,
    seed,
  });
  analog.forEach(({ channel, value }) => pico.setAnalog(channel, value));
  for (const { pin, level, atMs } of sets.filter((set) => !early.includes(set))) {
    pico.level(pin); // complains now about a pin that is not there
    pico.at(atMs, () => pico.setInput(pin, level));
  }
  cuts.forEach((atMs) => pico.cutPower({ atMs }));

  const happenings = new Happenings(pico);
  while (pico.timeMs < forMs && !closed()) {
    pico.runTo(Math.min(forMs, pico.timeMs + SLICE_MS));
    write(happenings.take());
    await new Promise(setImmediate); // lets the output flow
  }
  write(happenings.takeUnfinished());
  if (flash) pico.saveFlash(flash);
  return pico.faults.length || pico.halted ? EXIT.stopped : EXIT.done;
}

/** What has happened since it was last asked, as text. */
class Happenings {
  #pico;
  #lines = [];
  #seen = { boots: 0, faults: 0, warnings: 0, powerCuts: 0 };
  #halted = null;
  #serial = ['', ''];

  constructor(pico) {
    this.#pico = pico;
    pico.uart.forEach((uart, n) => (uart.onByte = (byte, timeNs) => this.#byte(n, byte, timeNs)));
  }

  take() {
    const pico = this.#pico;
    pico.takeEdges().forEach(({ pin, level, timeNs }) => this.#add(timeNs, `pin ${pin} = ${level ?? 'z'}`));
    pico.takeLog().forEach(({ level, text, timeNs }) => this.#add(timeNs, `${level} ${text}`.trim()));
    pico.uart.forEach((uart) => uart.take());
    this.#news('boots', ({ cause }) => `boot ${cause}`);
    this.#news('powerCuts', ({ torn }) => (torn ? `power cut during a flash ${torn.kind}` : 'power cut'));
    this.#news('warnings', ({ source, text }) => `warning: ${source}: ${text}`);
    this.#news('faults', ({ kind, pc, lr }) => `fault: ${kind}, pc ${hex(pc)}, lr ${hex(lr)}`);
    if (pico.halted && pico.halted !== this.#halted) {
      this.#add(pico.halted.timeNs, `halted: ${pico.halted.reason}, pc ${hex(pico.halted.pc)}`);
    }
    this.#halted = pico.halted;
    const text = this.#lines.sort((a, b) => a.timeNs - b.timeNs).map(({ line }) => line);
    this.#lines = [];
    return text.join('');
  }

  takeUnfinished() {
    this.#serial.forEach((text, n) => text && this.#add(this.#pico.timeNs, `uart ${n}: ${text}`));
    this.#serial = ['', ''];
    return this.take();
  }

  #news(list, describe) {
    const all = this.#pico[list];
    all.slice(this.#seen[list]).forEach((item) => this.#add(item.timeNs, describe(item)));
    this.#seen[list] = all.length;
  }

  #byte(n, byte, timeNs) {
    if (byte !== 0x0a) {
      this.#serial[n] += String.fromCharCode(byte);
      return;
    }
    this.#add(timeNs, `uart ${n}: ${this.#serial[n].trimEnd()}`);
    this.#serial[n] = '';
  }

  #add(timeNs, text) {
    const time = (timeNs / 1e9).toFixed(6).padStart(12);
    this.#lines.push({ timeNs, line: `${time}  ${text.replaceAll('\n', `\n${' '.repeat(14)}`)}\n` });
  }
}

function hex(value) {
  return `0x${value.toString(16).padStart(8, '0')}`;
}
