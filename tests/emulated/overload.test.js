// Scans that really take too long: a search for stability without end, in 2 ms. What the policy of `plc.toml` makes of it.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Application } from './support/application.js';
import { Bench } from './support/bench.js';
import { causes, untilStartedAgain } from './support/resets.js';

const [HEAVY, MOTOR, BRAKE, RECOVERED, CLOCK] = [2, 16, 17, 18, 19];
const PERIOD_MS = 2;
/** `overruns` in the `plc.toml` of `overload`. */
const LIMIT = 25;
/** From the end of a program to its next start. */
const STANDSTILL_MS = 1000;

/** The board with its program, at work and in time for so long. */
function atWork(name, ms = 300) {
  const bench = new Bench(Application.named(name), { recordEdges: true, inputs: { [HEAVY]: 0 } });
  bench.pico.powerOn();
  bench.pico.runFor(ms);
  assert.deepEqual(levels(bench.pico), { motor: 1, brake: 1 }, 'at work, the brake (active low) let go');
  return bench;
}

const levels = (pico) => ({ motor: pico.level(MOTOR), brake: pico.level(BRAKE) });
const SAFE = { motor: 0, brake: 0 };
const said = (pico, what) => pico.log.map(({ text }) => text).filter((text) => what.test(text));

/** When each scan has ended, in ms. */
function followScans({ pico }) {
  const ended = [];
  pico.onStore('PLC_SCANS', () => ended.push(pico.timeMs));
  return ended;
}

test('beyond the limit outputs are safe at once, stay so, and the program starts again and knows', () => {
  const bench = atWork('overload');
  const { pico } = bench;
  const ended = followScans(bench);
  pico.setInput(HEAVY, 1);
  const stopped = pico.runUntilEdge({ pin: MOTOR, level: 0 }, 2000);
  const stoppedMs = stopped.timeNs / 1e6;
  pico.runFor(1);
  assert.deepEqual(levels(pico), SAFE);
  const times = ended.filter((time) => time < stoppedMs);
  assert.equal(times.length, LIMIT, 'as many scans overran as the limit says');
  assert.ok(times.slice(1).every((time, i) => time - times[i] > 1.5 * PERIOD_MS));
  assert.ok(stoppedMs - times.at(-1) < 0.2, 'safe within 0.2 ms of the last of them');
  assert.equal(ended.at(-1), times.at(-1), 'no scan comes behind it');

  pico.setInput(HEAVY, 0);
  const from = pico.timeNs;
  const ms = untilStartedAgain(pico, 1500);
  assert.ok(Math.abs(ms + 1 - STANDSTILL_MS) < 2, `${ms} ms`);
  assert.deepEqual(pico.edgesOf({ pin: [MOTOR, BRAKE], level: 1, fromNs: from }), [], 'safe all the time');
  pico.runFor(50);
  assert.deepEqual(causes(pico), ['power-on', 'overload']);
  assert.deepEqual(said(pico, /^overload:/), [`overload: ${LIMIT} of the latest 100 scans overran: safe stop`]);
  assert.deepEqual(levels(pico), { motor: 1, brake: 1 }, 'at work again');
  assert.equal(pico.level(RECOVERED), 1);
  assert.equal(bench.value('loads'), 1, 'what had changed last has been stored');
});

test('an overload that lasts stops the program again and again, safe in between', () => {
  const { pico } = atWork('overload');
  pico.setInput(HEAVY, 1);
  for (let start = 1; start <= 3; start++) {
    untilStartedAgain(pico, 3000);
    pico.runFor(20);
  }
  assert.deepEqual(causes(pico), ['power-on', 'overload', 'overload', 'overload']);
});

test('fewer overruns than the limit are counted and change nothing', () => {
  const bench = atWork('overload');
  const { pico } = bench;
  const ended = followScans(bench);
  pico.setInput(HEAVY, 1);
  assert.ok(pico.runUntil(() => ended.length === LIMIT - 1, 1000));
  pico.setInput(HEAVY, 0);
  assert.ok(ended.slice(1).every((time, i) => time - ended[i] > 1.5 * PERIOD_MS));
  pico.runFor(1000);
  assert.equal(pico.boots.length, 1);
  assert.deepEqual(said(pico, /^overload:/), []);
  assert.deepEqual(levels(pico), { motor: 1, brake: 1 });
});

test('a controller that is to keep running says so once, scans on ticks, and its timers are right', () => {
  const bench = atWork('tolerant');
  const { pico } = bench;
  const ended = followScans(bench);
  pico.setInput(HEAVY, 1);
  pico.runFor(100);
  const from = pico.timeNs;
  pico.runFor(2500);
  assert.equal(pico.boots.length, 1, 'what is left over is enough for the retain store to live');
  assert.deepEqual(said(pico, /^overload:/), ['overload: 10 of the latest 100 scans overran: kept running']);
  assert.deepEqual(levels(pico), { motor: 1, brake: 1 });

  const scans = ended.filter((time) => time * 1e6 > from);
  const apart = scans.slice(1).map((time, i) => time - scans[i]);
  const longest = Math.max(...apart);
  assert.ok(Math.min(...apart) > 1.5 * PERIOD_MS, 'never a burst');
  for (const ms of apart) {
    const ticks = ms / PERIOD_MS;
    assert.ok(Math.abs(ticks - Math.round(ticks)) < 0.2, `a scan begins with a tick: ${ms} ms`);
  }
  const edges = pico.edgesOf({ pin: CLOCK, fromNs: from }).map(({ timeNs }) => timeNs / 1e6);
  assert.ok(edges.length > 20, `${edges.length} changes of the clock`);
  for (let i = 1; i < edges.length; i++) {
    const ms = edges[i] - edges[i - 1];
    assert.ok(ms > 49 && ms < 50 + longest + 1, `50 ms lasted ${ms} ms`);
  }

  pico.setInput(HEAVY, 0);
  pico.runFor(50);
  ended.length = 0;
  pico.runFor(100);
  assert.equal(ended.length, 100 / PERIOD_MS, 'in time again');
});
