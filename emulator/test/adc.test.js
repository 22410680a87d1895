// The analogue-to-digital converter: 2 us after a conversion was started the channel's reading is there.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Pico } from '../src/index.js';
import { image } from './support/image.js';
import { Program } from './support/programs.js';

const ADC_CS = 0x4004_c000;
const ADC_RESULT = 0x4004_c004;
const EN = 1;
const START_ONCE = 1 << 2;
const READY = 1 << 8;
const RESULTS = 0x2000_0100;

/** Converts a channel, and keeps the status just behind the start, then status and result later. */
function convert(channel) {
  const program = new Program().tick().prepareSleep().put(ADC_CS, EN);
  program.put(ADC_CS, (channel << 12) | START_ONCE | EN).copy(ADC_CS, RESULTS);
  return program.sleep(5).copy(ADC_CS, RESULTS + 4).copy(ADC_RESULT, RESULTS + 8).stop().bytes();
}

test('each channel is converted to what was set, and is not ready before', (t) => {
  const readings = [4095, 1234, 0, 2048, 1];
  for (const channel of readings.keys()) {
    const pico = new Pico(image(t, convert(channel)), { powered: false });
    readings.forEach((reading, other) => pico.setAnalog(other, reading));
    pico.powerOn();
    pico.runFor(1);
    assert.equal(pico.read32(RESULTS) & READY, 0, `channel ${channel} is under way`);
    assert.equal(pico.read32(RESULTS + 4) & READY, READY);
    assert.equal(pico.read32(RESULTS + 8), readings[channel]);
    assert.deepEqual(pico.faults, []);
  }
});

test('a reading changes with the voltage, and outlives a reset as the voltage does', (t) => {
  const pico = new Pico(image(t, convert(1)));
  pico.setAnalog(1, 77);
  pico.runPin();
  pico.runFor(1);
  assert.equal(pico.read32(RESULTS + 8), 77);
  pico.setAnalog(1, 78);
  pico.powerCycle();
  pico.runFor(1);
  assert.equal(pico.read32(RESULTS + 8), 78);
});
