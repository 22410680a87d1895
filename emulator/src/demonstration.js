/**
 * The demonstration of an application on the emulated Pico: after each scan of the image, the plants, which the soft
 * PLC's `--plant-server` plays, see the levels at its output pins and set those at its inputs.
 */
import { spawn } from 'node:child_process';
import { createInterface } from 'node:readline';
import { UsageError } from './fault.js';
import { Pico } from './pico.js';

/** How long power stays away in a power cycle, in ms. */
const POWER_OFF_MS = 1000;
/** How often what has happened is shown, in simulated ms. */
const SHOWN_EVERY_MS = 500;
/** Channel 0 of the ADC is at this pin. */
const FIRST_ANALOGUE_PIN = 26;
/** So many periods without a scan end the demonstration: the longest watchdog and a start are shorter. */
const PATIENCE_MS = 20_000;

/**
 * @param {string} elf the image
 * @param {string} plc the soft PLC, built from the same sources
 * @param {(text: string) => void} write
 * @returns {Promise<boolean>} whether everything was as the demonstration claims
 */
export async function demonstrate(elf, plc, write) {
  const plants = new Plants(plc);
  try {
    const site = await plants.greeting();
    const pico = new Pico(elf, { powered: false, recordEdges: false });
    return await new Demonstration(pico, plants, site, write).run();
  } finally {
    plants.close();
  }
}

class Demonstration {
  #shown = [];
  #shownAtMs = 0;
  #inputs = [];
  #outputs = [];

  constructor(pico, plants, site, write) {
    Object.assign(this, { pico, plants, site, write });
    this.#outputs = site.outputs.map(({ activeLow }) => (activeLow ? 1 : 0));
  }

  async run() {
    const { pico } = this;
    // The start-up code stores there too: a zero, before scan 0.
    const end = pico.onStore('PLC_SCANS', () => (this.scanned = pico.read32('PLC_SCANS') > 0));
    let answer;
    do {
      answer = await this.#ask('power', this.#levels());
      if (answer.kind === 'inputs') {
        this.#connect(answer);
        pico.powerOn();
        answer = await this.#scans();
        pico.powerOff();
      }
      this.#show();
      pico.runFor(POWER_OFF_MS);
    } while (answer.kind === 'power-cycle');
    end();
    if (answer.text !== 'held') this.write(`error: the demonstration ${answer.text}\n`);
    return answer.text === 'held';
  }

  /** Scan by scan until something else is asked for. */
  async #scans() {
    const { pico, site } = this;
    for (;;) {
      this.scanned = false;
      if (!pico.runUntil(() => this.scanned, PATIENCE_MS)) return { kind: 'end', text: 'saw no scan' };
      const image = this.#words('PLC_STORAGE', site.words).map((word) => word.toString(16));
      const numbers = this.#words('PLC_STORAGE', site.numbers, site.words).map((word) => word | 0);
      const levels = this.#levels();
      this.#changed('outputs', site.outputs, this.#outputs, levels);
      this.#outputs = levels;
      const answer = await this.#ask('scan', levels, image.join(','), numbers.join(','));
      if (answer.kind !== 'inputs') return answer;
      this.#connect(answer);
      if (pico.timeMs - this.#shownAtMs >= SHOWN_EVERY_MS) this.#show();
    }
  }

  #words(symbol, count, from = 0) {
    const bytes = this.pico.readBytes(this.pico.symbol(symbol).address + 4 * from, 4 * count);
    return [...new Uint32Array(bytes.buffer, bytes.byteOffset, count)];
  }

  /** The levels at the output pins; of one that is not driven, what a pull resistor makes of it: off. */
  #levels() {
    return this.site.outputs.map(({ pin, activeLow }) =>
      this.pico.powered && this.pico.driven(pin) ? this.pico.level(pin) : activeLow ? 1 : 0,
    );
  }

  #connect({ levels, readings }) {
    this.site.analogue.forEach((channel, i) => this.pico.setAnalog(channel, readings[i]));
    this.#changed('inputs ', this.site.inputs, this.#inputs, levels);
    this.site.inputs.forEach(({ pin }, i) => this.pico.setInput(pin, levels[i]));
    this.#inputs = levels;
  }

  #changed(kind, terminals, before, now) {
    const changes = terminals
      .map(({ name, activeLow }, i) => ({ name, before: before[i] ?? (activeLow ? 1 : 0), now: now[i], activeLow }))
      .filter((it) => it.before !== it.now)
      .map(({ name, now, activeLow }) => `${name} = ${activeLow ? 1 - now : now}`);
    if (changes.length) this.#add(this.pico.timeNs, `  ${kind}  ${changes.join(', ')}`);
  }

  async #ask(kind, levels, ...rest) {
    const request = [kind, levels.join('') || '-', ...rest].join(' ');
    const { inputs, analogue } = this.site;
    const answer = await this.plants.ask(request, (text) => this.#add(this.pico.timeNs, text));
    if (answer.kind !== 'inputs') return answer;
    if (answer.levels.length !== inputs.length || answer.readings.length !== analogue.length) {
      throw new UsageError(`the plants answered ${answer.levels.length} levels, ${answer.readings.length} readings`);
    }
    return answer;
  }

  #add(timeNs, text) {
    this.#shown.push({ timeNs, text });
  }

  #show() {
    this.pico.takeLog().forEach(({ timeNs, text }) => this.#add(timeNs, text));
    this.#shown.sort((a, b) => a.timeNs - b.timeNs);
    for (const { timeNs, text } of this.#shown) {
      this.write(`${(Math.floor(timeNs / 1e6) / 1000).toFixed(3).padStart(8)}  ${text}\n`);
    }
    this.#shown = [];
    this.#shownAtMs = this.pico.timeMs;
  }
}

/** The process that plays the plants. */
class Plants {
  #process;
  #lines;

  constructor(plc) {
    this.#process = spawn(plc, ['--plant-server'], { stdio: ['pipe', 'pipe', 'inherit'] });
    this.#process.stdin.on('error', () => {}); // that it has ended shows in its answers
    this.failed = new Promise((_, reject) => {
      this.#process.on('error', ({ message }) => reject(new UsageError(`cannot run ${plc}: ${message}`)));
    });
    this.failed.catch(() => {});
    this.#lines = createInterface({ input: this.#process.stdout })[Symbol.asyncIterator]();
  }

  async #line() {
    const { value, done } = await Promise.race([this.#lines.next(), this.failed]);
    if (done) throw new UsageError('the plants have stopped answering');
    return value;
  }

  /** What hangs on the controller. */
  async greeting() {
    const site = { words: 0, numbers: 0, inputs: [], analogue: [], outputs: [] };
    for (;;) {
      const [word, ...rest] = (await this.#line()).split(' ');
      if (word === 'ready') return site;
      if (word === 'memory') [site.words, site.numbers] = rest.map(Number);
      if (word === 'input') site.inputs.push(terminal(rest));
      if (word === 'analogue') site.analogue.push(pinNumber(rest[0]) - FIRST_ANALOGUE_PIN);
      if (word === 'output') site.outputs.push(terminal(rest));
    }
  }

  /**
   * @param {(text: string) => void} show lines for people
   * @returns {Promise<{kind: string, levels?: number[], readings?: number[], text?: string}>}
   */
  async ask(request, show) {
    this.#process.stdin.write(`${request}\n`);
    for (;;) {
      const line = await this.#line();
      const kind = line.split(' ', 1)[0];
      const text = line.slice(kind.length + 1);
      if (kind === 'inputs') {
        const [levels, readings] = text.split(' ');
        return { kind, levels: numbers(levels, ''), readings: numbers(readings, ',') };
      }
      if (kind === 'say') show(`-- ${text}`);
      else if (kind === 'moved') show(`  inputs   ${text}`);
      else return { kind, text };
    }
  }

  close() {
    this.#process.kill();
  }
}

function terminal([pin, active, name]) {
  return { pin: pinNumber(pin), activeLow: active === 'low', name };
}

function pinNumber(pin) {
  const number = /^GP(\d+)$/.exec(pin);
  if (!number) throw new UsageError(`the plants name a pin ${pin}, which a Pico does not have`);
  return Number(number[1]);
}

function numbers(text, separator) {
  return text === '-' ? [] : text.split(separator).map(Number);
}
