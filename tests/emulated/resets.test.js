// Why the image started, and that a fault leaves no output driven.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Pico } from '../../emulator/src/index.js';
import { causes, untilStartedAgain } from './support/resets.js';

const { PLC_IMAGE: image } = process.env;

/** The line switcher's substation at rest, off duty: all voltages there, breaker 1 closed. */
const INPUTS = { 2: 0, 3: 0, 4: 1, 5: 1, 6: 1, 7: 1, 8: 0, 9: 1, 10: 0 };
const OUTPUTS = [16, 17, 18, 19];
const FLASH_BASE = 0x1000_0000;
/** `System:recovered`, in the first word of the image. */
const RECOVERED = 1 << 2;

const boot = () => new Pico(image, { inputs: INPUTS });
const recovered = (pico) => (pico.read32('PLC_STORAGE') & RECOVERED) !== 0;

/** Replaces the first instruction of an interrupt, the scan's unless another is named, until the next start. */
function break_(pico, instruction, interrupt = 'SWI_IRQ_0') {
  const offset = (pico.symbol(interrupt).address & ~1) - FLASH_BASE;
  const kept = pico.flash.bytes.slice(offset, offset + 2);
  pico.flash.bytes.set(instruction, offset);
  untilStartedAgain(pico, 3000);
  pico.flash.bytes.set(kept, offset);
}

/** Runs until the switcher commands breaker 1 to open. */
function untilDriven(pico) {
  pico.setInput(2, 1);
  pico.runFor(100);
  pico.setInput(4, 0);
  assert.ok(pico.runUntil(() => pico.level(16) === 1, 4000), 'breaker 1 is commanded');
}

test('power-on and the run pin are told apart and are no recovery', () => {
  const pico = boot();
  pico.runFor(50);
  assert.equal(recovered(pico), false);
  pico.runPin();
  pico.runFor(50);
  assert.equal(recovered(pico), false);
  pico.powerCycle();
  pico.runFor(50);
  assert.deepEqual(causes(pico), ['power-on', 'run pin', 'power-on']);
});

test('a scan that hangs is ended by the watchdog, and the program knows', () => {
  const pico = boot();
  untilDriven(pico);
  break_(pico, [0xfe, 0xe7]); // B .
  assert.ok(OUTPUTS.every((pin) => !pico.driven(pin)), 'a reset lets go of every pin');
  pico.runFor(50);
  assert.deepEqual(causes(pico), ['power-on', 'watchdog: scan hung']);
  assert.equal(recovered(pico), true);
  assert.equal(pico.level(16), 0);
});

test('a timer that hangs keeps the scan from coming, and is ended by the watchdog', () => {
  const pico = boot();
  untilDriven(pico);
  break_(pico, [0xfe, 0xe7], 'TIMER_IRQ_0'); // B .
  assert.ok(OUTPUTS.every((pin) => !pico.driven(pin)));
  pico.runFor(50);
  assert.deepEqual(causes(pico), ['power-on', 'watchdog: scan hung']);
});

test('a fault of the processor lets go of the outputs at once and restarts the program', () => {
  const pico = boot();
  untilDriven(pico);
  const from = pico.timeNs;
  break_(pico, [0x00, 0xde]); // UDF #0
  const released = pico.edgesOf({ pin: 16, level: null, fromNs: from })[0];
  const fault = pico.faults[0];
  assert.equal(fault.kind, 'undefined instruction');
  assert.ok(released.timeNs - fault.timeNs < 100_000, 'within 0.1 ms');
  pico.runFor(50);
  assert.deepEqual(causes(pico), ['power-on', 'panic']);
  assert.ok(pico.log.some(({ level, text }) => level === 'ERROR' && text.startsWith('hard fault at')));
  assert.equal(recovered(pico), true);
});

test('outputs are driven from the start, and safe until scan 0 has ended', () => {
  const pico = boot();
  assert.ok(pico.runUntil(() => pico.driven(19), 10));
  assert.ok(pico.timeMs < 1, 'within a millisecond');
  assert.deepEqual(OUTPUTS.map((pin) => pico.level(pin)), [0, 0, 0, 0]);
});
