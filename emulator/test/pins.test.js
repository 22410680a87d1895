import assert from 'node:assert/strict';
import { test } from 'node:test';
import { UsageError } from '../src/fault.js';
import { Pico } from '../src/pico.js';
import { image } from './support/image.js';
import { Program } from './support/programs.js';

const PAD_2 = 0x4001_c00c;
const PULL_UP = 0x4a;
const SIO_IN = 0xd000_0004;
const RESULT = 0x2000_0000;

test('an output is recorded when its driver comes on, changes, and goes off', (t) => {
  const pico = new Pico(image(t, new Program().output(7).high(7).stop().bytes()));
  assert.equal(pico.driven(7), false);
  pico.runFor(1);
  assert.equal(pico.driven(7), true);
  assert.equal(pico.level(7), 1);
  pico.powerOff();
  assert.deepEqual(pico.edges.map(({ pin, level }) => [pin, level]), [[7, 0], [7, 1], [7, null]]);
  assert.ok(pico.edges[0].timeNs < pico.edges[1].timeNs);
  assert.equal(pico.edges[2].timeNs, pico.timeNs);
});

test('firmware reads what is wired to a pin, and the pull where nothing is', (t) => {
  const path = image(t, new Program().put(PAD_2, PULL_UP).copy(SIO_IN, RESULT).stop().bytes());
  const result = (inputs) => {
    const pico = new Pico(path, { inputs });
    pico.runFor(1);
    return pico.read32(RESULT);
  };
  assert.equal(result({}), 1 << 2, 'pin 2 is pulled up, all others down');
  assert.equal(result({ 2: 0, 5: 1 }), 1 << 5);
});

test('a level that is wired to an output does not change it', (t) => {
  const pico = new Pico(image(t, new Program().output(3).stop().bytes()), { inputs: { 3: 1 } });
  assert.equal(pico.level(3), 1);
  pico.runFor(1);
  assert.equal(pico.level(3), 0);
  pico.setInput(3, 1);
  assert.equal(pico.level(3), 0);
});

test('wiring outlives a power cycle', (t) => {
  const pico = new Pico(image(t, new Program().stop().bytes()), { inputs: { 4: 1 } });
  pico.powerCycle();
  assert.equal(pico.level(4), 1);
  pico.setInput(4, null);
  assert.equal(pico.level(4), 0);
});

test('pins and levels that do not exist are refused', (t) => {
  const pico = new Pico(image(t, new Program().stop().bytes()));
  assert.throws(() => pico.setInput(30, 1), UsageError);
  assert.throws(() => pico.level(-1), UsageError);
  assert.throws(() => pico.setInput(1, 2), UsageError);
});
