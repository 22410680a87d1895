// Retained variables and parameters of every type in the flash of the emulated board: over a loss of power, over one in
// the middle of a write, and from one program to another.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Application } from './support/application.js';
import { Bench } from './support/bench.js';
import { randomNumbers } from './support/random.js';
import { stimulus } from './support/stimulus.js';

const values = Application.named('values');
const rounds = Application.named('rounds');

/** Of the program `values`, each type twice. `batch` may be 1 to 20, `pieces` 0 to 999. */
const SET = { pieces: 321, longest: 98_765, marked: 1, balance: -2_000_000_000, delay: 1500, batch: 17, inverted: 0, pause: 4 };
const DECLARED = { pieces: 5, longest: 100, marked: 0, balance: -1000, delay: 150, batch: 3, inverted: 1, pause: 1 };
const OFF_MS = 20;
/** Long enough for a record to be written. */
const WRITTEN_MS = 50;

const retained = (bench, names = Object.keys(SET)) => Object.fromEntries(names.map((name) => [name, bench.value(name)]));
const give = (bench, some) => Object.entries(some).forEach(([name, value]) => bench.give(name, value));

/** Starts a board with all inputs False and runs scan 0. */
function started(application, options) {
  const bench = new Bench(application, options);
  bench.connect(application.inputs.map(() => 0));
  bench.pico.powerOn();
  bench.scan();
  return bench;
}

/** The next start, up to the end of its scan 0; what it said. */
function startedAgain(bench) {
  bench.pico.takeLog();
  bench.pico.powerCycle({ offMs: OFF_MS });
  bench.scan();
  return bench.pico.takeLog().map(({ text }) => text);
}

/** A board on which the program `values` has kept `SET`, and other values where `some` says so. */
function keeping(some = {}) {
  const bench = started(values);
  assert.deepEqual(retained(bench), DECLARED, 'nothing is stored yet');
  give(bench, { ...SET, ...some });
  bench.pico.runFor(WRITTEN_MS);
  return bench;
}

test('numbers, times, Booleans and parameters survive power, again and again', () => {
  const bench = keeping();
  for (let cycle = 0; cycle < 5; cycle++) {
    const said = startedAgain(bench);
    assert.match(said[0], /reset: power-on, restored: 8 of 8 retained values/);
    assert.deepEqual(retained(bench), SET);
    bench.pico.runFor(WRITTEN_MS);
  }
  assert.deepEqual(bench.pico.faults, []);
});

test('what is not retained is not kept', () => {
  const bench = keeping();
  give(bench, { rises: 1234, sum: 55, t: 77 });
  startedAgain(bench);
  assert.deepEqual(retained(bench, ['rises', 'sum', 't']), { rises: 0, sum: 0, t: 20 });
});

test('a stored value that its range cannot hold is dropped alone, and the declared one holds', () => {
  const bench = keeping({ batch: 50, pieces: 5000 });
  const said = startedAgain(bench);
  assert.match(said.find((text) => text.includes('restored')), /restored: 6 of 8/);
  for (const line of ['batch = 50 does not fit', 'pieces = 5000 does not fit']) {
    assert.ok(said.some((text) => text.includes(line)), line);
  }
  assert.deepEqual(retained(bench), { ...SET, batch: DECLARED.batch, pieces: DECLARED.pieces });
});

test('another program keeps what fits and starts the rest at what it declares, whatever the other stored there', () => {
  const stored = keeping();
  const other = started(rounds, { flash: stored.pico.flashImage() });
  const said = other.pico.takeLog().map(({ text }) => text);
  // `delay` has another range there and `marked` another type; `rounds` is new.
  const kept = { pieces: SET.pieces, balance: SET.balance, delay: 90, marked: 77, rounds: 1 };
  assert.deepEqual(retained(other, Object.keys(kept)), kept);
  const fingerprint = values.symbols.fingerprint.toString(16).padStart(8, '0');
  assert.ok(said.some((text) => text.includes(`last written by another program, ${fingerprint}`)), said.join('\n'));
  assert.ok(said.some((text) => /restored: 2 of 5 retained values/.test(text)));
  assert.equal(said.filter((text) => /of unknown .* is dropped/.test(text)).length, 6);

  // As long as the other program changes nothing, nothing is lost.
  other.pico.runFor(WRITTEN_MS);
  const unchanged = started(values, { flash: other.pico.flashImage() });
  assert.deepEqual(retained(unchanged), SET);

  // A value of its own makes its record the newest, and what only the first one knew is gone.
  give(other, { delay: 300, pieces: 322 });
  // Something has to happen for the program to look at them.
  other.connect(rounds.inputs.map(({ name }) => (name === 'halt' ? 1 : 0)));
  other.scan();
  other.pico.runFor(WRITTEN_MS);
  assert.match(startedAgain(other)[0], /restored: 5 of 5/);
  const back = started(values, { flash: other.pico.flashImage() });
  assert.deepEqual(retained(back), { ...DECLARED, pieces: 322, balance: SET.balance });
});

test('power cut in the middle of a write leaves all the old values or all the new ones', () => {
  const outcomes = { old: 0, new: 0 };
  const torn = new Set();
  const moments = ['before', 'during', 'after'];
  for (const seed of [1, 2, 3]) {
    const random = randomNumbers(seed);
    const whole = (low, high) => low + Math.floor(random() * (high - low + 1));
    const bench = started(values, { seed });
    const { pico } = bench;
    for (let cut = 0; cut < 30; cut++) {
      const before = retained(bench);
      const after = {
        ...before,
        pieces: whole(0, 999),
        longest: whole(0, 120_000),
        marked: whole(0, 1),
        balance: whole(-(2 ** 31), 2 ** 31 - 1),
        batch: whole(1, 20),
        delay: whole(20, 2000),
        inverted: whole(0, 1),
      };
      const cuts = pico.powerCuts.length;
      pico.cutPower({ flashOperation: cut % 8 === 7 ? 2 : 1, moment: moments[whole(0, 2)], offMs: OFF_MS });
      give(bench, after);
      const happened = pico.runUntil(() => pico.powerCuts.length > cuts, WRITTEN_MS);
      pico.cancelCuts();
      if (!happened) startedAgain(bench);
      else bench.scan();
      const now = retained(bench);
      const isNew = now.balance === after.balance;
      assert.deepEqual(now, isNew ? after : before, `seed ${seed}, cut ${cut}`);
      if (!happened) {
        assert.ok(isNew, 'an undisturbed write is kept');
        continue;
      }
      outcomes[isNew ? 'new' : 'old']++;
      if (pico.powerCuts.at(-1).torn) torn.add(pico.powerCuts.at(-1).torn.kind);
    }
    assert.deepEqual(pico.faults, []);
  }
  assert.ok(outcomes.old > 10 && outcomes.new > 10 && torn.has('program'), JSON.stringify(outcomes));
});

test('what the program itself changes is restored as the last or the last but one scan that changed it left it', () => {
  const habits = { keep: { stays: 20, high: 0.9 } };
  const random = randomNumbers(7);
  const rows = stimulus(values, 3000, random, habits);
  const bench = started(values);
  const { pico } = bench;
  const states = [retained(bench)];
  let restored = 0;
  for (const row of rows) {
    const cuts = pico.powerCuts.length;
    if (random() < 0.05) pico.cutPower({ atMs: pico.timeMs + random() * 10, offMs: OFF_MS });
    bench.connect(row);
    bench.scan();
    const now = retained(bench);
    const same = (state) => Object.keys(SET).every((name) => state[name] === now[name]);
    if (pico.powerCuts.length > cuts) {
      restored++;
      assert.ok(states.slice(-2).some(same), JSON.stringify({ now, states: states.slice(-2) }));
      states.splice(0, Infinity, now);
    } else if (!same(states.at(-1))) states.push(now);
  }
  assert.ok(restored > 80, `${restored} starts`);
  assert.ok(bench.value('pieces') > DECLARED.pieces);
});
