// The same stimulus on x86 and on the pins of the emulated board gives the same trace, scan for scan.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Application } from './support/application.js';
import { inLockstep } from './support/lockstep.js';

/** Often enough in command, with all of the substation's voltages coming and going. */
const HABITS = {
  Onduty: { stays: 600, high: 0.8 },
  Unlock: { stays: 60 },
  VL1: { stays: 180, high: 0.6 },
  VL2: { stays: 180, high: 0.6 },
  VT2: { stays: 300, high: 0.7 },
  VT3: { stays: 300, high: 0.7 },
  F_B2: { stays: 400, high: 0.2 },
  Breaker_1: { stays: 70 },
  Breaker_2: { stays: 70 },
};

test('the trace of the board is the trace of x86, scan for scan', () => {
  const switcher = Application.flashed();
  const steps = new Set();
  for (const seed of [1, 2]) {
    const { trace, log } = inLockstep(switcher, { seed, scans: 12_000, habits: HABITS });
    trace.forEach((row) => steps.add(row[1]));
    assertLogTells(log, trace);
  }
  assert.equal(steps.size, 11, 'every step has been active');
});

/** Each change of the situation has its line in the log, in order, and there is no further one. */
function assertLogTells(log, trace) {
  const situations = trace.map((row) => row[1]);
  const changes = situations.slice(1).flatMap((now, i) => (now === situations[i] ? [] : [`{${situations[i]}} -> {${now}}`]));
  const told = log.map((text) => /^LineSwitcher T\d+: (.*)$/.exec(text)?.[1]).filter(Boolean);
  assert.ok(changes.length > 50);
  assert.deepEqual(told, changes);
}
