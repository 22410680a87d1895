// Every construct of the language runs in the image as it does on x86: the programs in `applications` use all of them
// (`tests/constructs.rs` holds them to it), on pins that are driven at random.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Application } from './support/application.js';
import { inLockstep } from './support/lockstep.js';

const SCANS = 5_000;
/** Of which many take all of their hundred rounds. */
const SCANS_OF_ROUNDS = 2_500;

/**
 * What a run must have shown, besides the two traces being equal. A transition is seen in the log, by a change of the
 * situation. `unseen` are transitions that change nothing, self-loops, and steps that are only passed through;
 * `constant` are the columns that keep their value, as parameters do.
 */
function assertAlive({ symbols }, { trace, log }, { unseen, constant }) {
  const { graphs, columns } = symbols;
  const active = new Set(trace.flatMap((row) => graphs.flatMap(({ name }, i) => row[i + 1].split(' ').map((id) => `${name}:${id}`))));
  const steps = graphs.flatMap(({ name, steps }) => steps.map(({ id }) => `${name}:${id}`));
  assert.deepEqual(steps.filter((step) => !active.has(step) && !unseen.includes(step)), [], 'every step has been active');

  const fired = new Set(log.map((text) => /^(.+ T\d+): /.exec(text)?.[1]));
  const transitions = graphs.flatMap(({ name, transitions }) => transitions.map((number) => `${name} T${number}`));
  assert.deepEqual(transitions.filter((it) => !fired.has(it) && !unseen.includes(it)), [], 'every transition has fired');

  const still = columns.filter((_, i) => trace.every((row) => row[i] === trace[0][i]));
  assert.deepEqual(still, constant, 'all else changes');
}

function assertOnTime(log) {
  assert.deepEqual(log.filter((text) => /overrun|late scan|retain store/.test(text)), []);
}

test('forcing, enclosing, macro steps and templates run in the image', () => {
  const application = Application.named('hierarchy');
  const habits = { halt: { stays: 80 }, auto: { stays: 60 }, single: { stays: 40 }, guard: { stays: 60, high: 0.7 } };
  const run = inLockstep(application, { seed: 11, scans: SCANS, habits });
  assertOnTime(run.log);
  assertAlive(application, run, {
    unseen: ['Worker T5', 'Place1 T3', 'Place2 T3'],
    constant: ['Place1:hold', 'Place1:most', 'Place2:hold', 'Place2:most'],
  });
  for (const way of [/^Foreman forced: /, /^Worker forced: /, /^Inner enclosed: /, /^Hand enclosed: /]) {
    assert.ok(run.log.some((text) => way.test(text)), `${way}`);
  }
});

test('edges, timers, numbers and actions of every kind run in the image', () => {
  const application = Application.named('values');
  const habits = { 'бункер.полон': { stays: 90, high: 0.7 }, keep: { stays: 60 } };
  const run = inLockstep(application, { seed: 12, scans: SCANS, habits });
  assertOnTime(run.log);
  assertAlive(application, run, {
    unseen: [],
    constant: ['delay', 'batch', 'inverted', 'pause', 'worn', 'missed', 'recovered', 'restless'],
  });
});

test('the search for stability runs in the image', () => {
  const application = Application.named('rounds');
  const habits = { halt: { stays: 60 }, auto: { stays: 12 }, hunt: { stays: 40, high: 0.3 } };
  const run = inLockstep(application, { seed: 13, scans: SCANS_OF_ROUNDS, habits });
  assertOnTime(run.log);
  assertAlive(application, run, { unseen: ['Macros:S6'], constant: ['delay'] });
  assert.ok(run.log.some((text) => text.startsWith('unstable: ')));
});
