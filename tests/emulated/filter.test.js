// Bounce and noise at the pins of the very image: what is shorter than the filter is never seen, what is longer always.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Application } from './support/application.js';
import { Bench } from './support/bench.js';
import { randomNumbers } from './support/random.js';
import { waveform } from './support/waveform.js';

const SETTLED_MS = 100;
const PULSES = 200;

const application = Application.flashed();

/** What each scan saw of an input: when it ended, and the value. */
function follow(bench, names) {
  const seen = new Map(names.map((name) => [name, []]));
  bench.pico.onStore('PLC_SCANS', () => {
    for (const [name, values] of seen) values.push({ us: bench.pico.timeMs * 1000, value: bench.value(name) });
  });
  return seen;
}

/** How often the values leave `level` and come back to it, or stay away in the end. */
function departures(values, level) {
  return values.filter((value, i) => value !== level && (i === 0 || values[i - 1] === level)).length;
}

for (const seed of [1, 2]) {
  test(`random pulses, noise and bounce around the filter time are each seen as they should be, seed ${seed}`, () => {
    const bench = new Bench(application);
    const { pico } = bench;
    // One input of each filter time; the others rest.
    const inputs = [2, 5, 20].map((ms) => application.inputs.find(({ filterMs }) => filterMs === ms));
    application.inputs.forEach(({ pin }) => pico.setInput(pin, 0));
    pico.powerOn();
    const random = randomNumbers(seed);
    const periodMs = application.symbols.period_ms;
    const waves = inputs.map(({ filterMs }) =>
      waveform({ filterMs, periodMs, fromMs: SETTLED_MS, count: PULSES }, random),
    );
    waves.forEach(({ edges }, i) => {
      for (const { us, level } of edges) pico.at(us / 1000, () => pico.setInput(inputs[i].pin, level));
    });
    const seen = follow(bench, inputs.map(({ name }) => name));
    pico.runTo(Math.max(...waves.map(({ pulses }) => pulses.at(-1).toUs)) / 1000 + 1);

    waves.forEach(({ pulses }, i) => {
      const { name, filterMs } = inputs[i];
      for (const { kind, fromUs, toUs, before, after, times } of pulses) {
        const of = `${kind} at ${name}, filter ${filterMs} ms, from ${fromUs} us to ${toUs} us`;
        const values = seen.get(name).filter(({ us }) => us >= fromUs && us < toUs).map(({ value }) => value);
        assert.equal(departures(values, before), times, of);
        assert.equal(values.at(-1), after, of);
      }
      const kinds = new Set(pulses.map(({ kind }) => kind));
      assert.equal(kinds.size, 6);
    });
    assert.equal(pico.boots.length, 1);
    assert.deepEqual(pico.log.filter(({ text }) => /overrun|late scan/.test(text)), []);
  });
}
