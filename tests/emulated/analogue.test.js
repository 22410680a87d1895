// Voltages at the pins of the emulated board reach the program as `plc.toml` scales them.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Application } from './support/application.js';
import { Bench } from './support/bench.js';
import { inLockstep } from './support/lockstep.js';

const FULL_SCALE = 4095;
/** From one reading to the next in the sweep: it hits both ends. */
const STEP = 15;

test('the tank fills and empties at random as on x86', () => {
  const tank = Application.example('mixing_tank');
  const { trace, log } = inLockstep(tank, { seed: 41, scans: 18_000, habits: { level: { stays: 200 } } });
  assert.deepEqual(log.filter((text) => /overrun|late scan|arithmetic fault/.test(text)), []);
  const steps = new Set(trace.map((row) => row[1]));
  assert.deepEqual([...steps].sort(), ['1', '2', '3', '4', '5']);
});

test('every voltage is read as its place on the scale', () => {
  const bench = new Bench(Application.example('mixing_tank'));
  for (let reading = 0; reading <= FULL_SCALE; reading += STEP) {
    bench.connect([0, reading]);
    if (reading === 0) bench.pico.powerOn();
    // The mean of 20 ms, that is of two scans; the first value is there in scan 0.
    bench.scan();
    if (reading > 0) bench.scan();
    assert.equal(bench.value('level'), Math.round((reading * 250) / FULL_SCALE), `reading ${reading}`);
  }
  assert.equal(bench.value('level'), 250);
  assert.deepEqual(bench.pico.faults, []);
});

test('a voltage that changes is read as the mean of the filter time', () => {
  const bench = new Bench(Application.example('mixing_tank'));
  bench.connect([0, FULL_SCALE]);
  bench.pico.powerOn();
  bench.scan();
  assert.equal(bench.value('level'), 250, 'scan 0 sees the voltage');
  bench.connect([0, 0]);
  bench.scan();
  assert.equal(bench.value('level'), 250, 'the first 20 ms are not over');
  bench.connect([0, FULL_SCALE]);
  bench.scan();
  assert.equal(bench.value('level'), 125, 'half of the 20 ms at either end');
  bench.connect([0, 0]);
  bench.scan();
  bench.scan();
  assert.equal(bench.value('level'), 0);
});
