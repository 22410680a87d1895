// Random programs run in the image as they do on x86.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Application } from './support/application.js';
import { inLockstep } from './support/lockstep.js';

/** A scan that does not settle costs as much as a hundred others. */
const SCANS = { scan: 1000, stable: 400 };

const applications = Application.random();

test('there are some that search for stability, and some that do not', () => {
  const kinds = new Set(applications.map(({ symbols }) => symbols.evolution));
  assert.deepEqual([...kinds].sort(), ['scan', 'stable']);
});

for (const [index, application] of applications.entries()) {
  test(`the random program ${application.name} runs in the image as on x86`, () => {
    const scans = SCANS[application.symbols.evolution];
    const { trace, log } = inLockstep(application, { seed: 31 + index, scans });
    assert.deepEqual(log.filter((text) => /overrun|late scan|retain store/.test(text)), []);
    const situations = new Set(trace.map((row) => row.slice(1, 1 + application.symbols.graphs.length).join()));
    assert.ok(situations.size > 3, `${situations.size} situations`);
    assert.ok(log.filter((text) => / T\d+: /.test(text)).length > scans / 20, 'transitions fire');
  });
}
