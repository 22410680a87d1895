// Each task hangs, in each way there is: outputs are let go of or safe, and the next boot line names the task.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Application } from './support/application.js';
import { Bench } from './support/bench.js';
import { causes, untilStartedAgain } from './support/resets.js';

/** What `firmware/boards/pico/hang.rs` knows. */
const TASKS = { start: 1, scan: 2, 'retain store': 3 };
const MANNERS = { spins: 0x100, waits: 0x200, holds: 0x300 };

const [HEAVY, MOTOR, BRAKE, RECOVERED] = [2, 16, 17, 18];
/** The `plc.toml` names none. */
const WATCHDOG_MS = 1000;
/** The watchdog until scan 0. */
const START_MS = 8000;
const SECTOR = 4096;
/** As long as its clock goes, the program looks at its variables. */
const CLOCK_MS = 52;
/** How long the retain store may be silent. */
const SILENCE_MS = 2000;

function atWork(options = {}) {
  const bench = new Bench(Application.named('tolerant'), { recordEdges: true, inputs: { [HEAVY]: 0 }, ...options });
  bench.pico.powerOn();
  bench.pico.runFor(500);
  assert.equal(bench.pico.level(MOTOR), 1, 'at work');
  return bench;
}

const hang = (pico, task, manner) => pico.write32('PLC_HANG', TASKS[task] + MANNERS[manner]);

/** From now on, the pins are let go of or safe, and then the program is at work again and knows what happened. */
function assertEnded(bench, task, limitMs) {
  const { pico } = bench;
  const from = pico.timeNs;
  const ms = untilStartedAgain(pico, limitMs + 1000);
  assert.ok(ms <= limitMs, `${ms} ms`);
  assert.ok(!pico.driven(MOTOR) && !pico.driven(BRAKE), 'a reset lets go of every pin');
  const again = pico.timeNs;
  assert.ok(pico.runUntil(() => pico.level(RECOVERED) === 1, 100), 'the program knows');
  const driven = pico.edgesOf({ pin: MOTOR, fromNs: again + 1 });
  assert.deepEqual(driven.map(({ level }) => level), [0, 1], 'safe first, at work again behind scan 0');
  assert.deepEqual(causes(pico), ['power-on', `watchdog: ${task} hung`]);
  return { from, ms };
}

for (const manner of ['spins', 'waits']) {
  test(`a scan that ${manner} for ever is ended by the watchdog`, () => {
    const bench = atWork();
    hang(bench.pico, 'scan', manner);
    const { ms } = assertEnded(bench, 'scan', WATCHDOG_MS);
    assert.ok(ms > WATCHDOG_MS - 10);
  });

  test(`a retain store that ${manner} for ever is noticed by the scan, which makes the outputs safe`, () => {
    const bench = atWork();
    const { pico } = bench;
    hang(pico, 'retain store', manner);
    const { from } = assertEnded(bench, 'retain store', SILENCE_MS + 300);
    const [safe, released] = pico.edgesOf({ pin: MOTOR, fromNs: from });
    assert.equal(safe.level, 0);
    assert.equal(released.level, null);
    assert.ok(pico.log.some(({ text }) => text === 'retain store hung: safe stop'));
  });

  test(`a start that ${manner} for ever is ended by the watchdog, with safe outputs`, () => {
    const bench = new Bench(Application.named('tolerant'), { recordEdges: true, inputs: { [HEAVY]: 0 } });
    const { pico } = bench;
    pico.powerOn();
    assert.ok(pico.runUntil(() => pico.driven(BRAKE), 10));
    hang(pico, 'start', manner);
    const ms = untilStartedAgain(pico, START_MS + 1000);
    assert.ok(ms > START_MS - 100 && ms < START_MS + 100, `${ms} ms`);
    assert.deepEqual(pico.edgesOf({ pin: MOTOR, level: 1 }), []);
    pico.runFor(50);
    assert.deepEqual(causes(pico), ['watchdog: start hung']);
    assert.equal(pico.level(RECOVERED), 1);
  });
}

test('a flash that does not come back stops everything, and the retain store is named', () => {
  const bench = atWork();
  const { pico } = bench;
  hang(pico, 'retain store', 'holds');
  pico.runFor(500);
  assert.equal(pico.level(MOTOR), 1, 'nothing is to be stored');
  // `loads` changes.
  pico.setInput(HEAVY, 1);
  assertEnded(bench, 'retain store', WATCHDOG_MS + 100);
});

test('a flash at its slowest is no hung task, in operation and at the start', () => {
  const flashTimes = { eraseMs: 400, programMs: 3 };
  const bench = atWork({ flashTimes, recordEdges: false });
  const { pico } = bench;
  for (let loads = 1; pico.flash.erases === 0; loads++) {
    assert.ok(loads < 1000, 'a sector is erased some time');
    bench.give('loads', loads);
    pico.runFor(CLOCK_MS);
  }
  pico.runFor(flashTimes.eraseMs);
  assert.equal(pico.boots.length, 1);

  // What nobody needs lies in four sectors.
  pico.powerOff();
  pico.flash.bytes.fill(0, -4 * SECTOR);
  const erases = pico.flash.erases;
  pico.powerOn();
  assert.ok(pico.runUntil(() => pico.level(MOTOR) === 1, 20_000));
  assert.equal(pico.flash.erases - erases, 4);
  pico.runFor(3000);
  assert.equal(pico.boots.length, 2);
});

test('the largest area, erased at its slowest, takes longer than the watchdog waits and is no hang', () => {
  const application = Application.named('rounds');
  const { pico } = new Bench(application, { flashTimes: { eraseMs: 400, programMs: 3 } });
  pico.flash.bytes.fill(0, -64 * SECTOR);
  pico.powerOn();
  assert.ok(pico.runUntilLog('starts in', 60_000));
  // All but the one that is written to and the one before.
  assert.equal(pico.flash.erases, 62);
  assert.ok(pico.timeMs > 2 * START_MS);
  assert.equal(pico.boots.length, 1);
});
