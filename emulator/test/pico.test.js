import assert from 'node:assert/strict';
import { test } from 'node:test';
import { UsageError } from '../src/fault.js';
import { Pico } from '../src/pico.js';
import { boot2, elfFile, image, temporaryFile } from './support/image.js';
import { blink, Program } from './support/programs.js';

const CHIP_RESET = 0x4006_4008;
const WATCHDOG_REASON = 0x4005_8008;
const WATCHDOG_SCRATCH0 = 0x4005_800c;
const AIRCR = 0xe000_ed0c;
const SRAM = 0x2000_0000;
const FLASH = 0x1000_0000;
const MS = 1e6;

const idle = () => new Program().stop().bytes();

test('an image boots and keeps time to the nanosecond', (t) => {
  const pico = new Pico(image(t, blink()));
  pico.runFor(20);
  const edges = pico.edgesOf({ pin: 25 }).slice(1);
  assert.equal(edges.length, 19);
  const periods = edges.slice(1).map((edge, i) => edge.timeNs - edges[i].timeNs);
  // The program reads the timer before it sets the next alarm, so it is a few microseconds late at most.
  assert.ok(periods.every((period) => period === periods[0] && period >= MS && period < MS + 3000), `${periods}`);
});

test('runs are equal to the last bit, however time is cut into pieces', (t) => {
  const path = image(t, blink());
  const [whole, pieces, other] = [new Pico(path), new Pico(path), new Pico(path, { seed: 2 })];
  whole.runTo(10);
  for (let ms = 0; ms < 10; ms += 0.0373) pieces.runTo(ms);
  pieces.runTo(10);
  other.runTo(10);
  assert.equal(whole.digest(), pieces.digest());
  assert.notEqual(whole.digest(), other.digest(), 'memory at power-up depends on the seed');
});

test('runUntil stops at the very edge that its predicate waits for', (t) => {
  const pico = new Pico(image(t, blink()));
  assert.equal(pico.runUntil(() => pico.level(25) === 1, 10), true);
  assert.ok(pico.timeNs - pico.edges.at(-1).timeNs < 100);
  const edge = pico.runUntilEdge({ pin: 25, level: 0 }, 10);
  assert.equal(edge, pico.edges.at(-1));
  assert.equal(pico.runUntilEdge({ pin: 24 }, 2), null);
});

test('stimuli come at their times', (t) => {
  const pico = new Pico(image(t, idle()));
  const times = [];
  pico.at(1.5, () => times.push(pico.timeNs));
  pico.at(0.25, () => times.push(pico.timeNs));
  pico.runFor(2);
  assert.deepEqual(times, [0.25 * MS, 1.5 * MS]);
});

test('a store to a watched word is told once it is done', (t) => {
  const program = new Program().put(SRAM + 64, 5).put(SRAM + 64, 6).put(SRAM + 68, 7).stop();
  const pico = new Pico(image(t, program.bytes(), { counter: SRAM + 64 }));
  const seen = [];
  const end = pico.onStore('counter', () => seen.push(pico.read32('counter')));
  pico.runFor(1);
  assert.deepEqual(seen, [5, 6]);
  end();
  assert.throws(() => pico.onStore(FLASH, () => {}), UsageError);
  assert.throws(() => pico.symbol('missing'), /no symbol missing/);
});

test('a word of memory can be stored as by a debugger, and only there', (t) => {
  const pico = new Pico(image(t, idle(), { counter: SRAM + 64 }));
  const seen = [];
  pico.onStore('counter', () => seen.push(pico.read32('counter')));
  pico.write32('counter', 0xcafe_f00d);
  pico.runFor(1);
  assert.equal(pico.read32(SRAM + 64), 0xcafe_f00d);
  assert.deepEqual(seen, []);
  assert.throws(() => pico.write32(FLASH, 1), UsageError);
});

test('a leap brings firmware into a time far ahead', (t) => {
  const pico = new Pico(image(t, blink()));
  pico.runFor(5.5);
  pico.leap(50 * 24 * 3_600_000);
  pico.runFor(3);
  assert.equal(pico.timeMs, 8.5, 'the bench does not leap');
  const sinceLeap = pico.edgesOf({ pin: 25, fromNs: 5.5 * MS }).map(({ timeNs }) => timeNs - 5.5 * MS);
  assert.equal(sinceLeap.length, 3);
  assert.ok(sinceLeap[0] < 5000, `what was leapt over goes off at once, after ${sinceLeap[0]} ns`);
});

test('firmware can tell power, the RUN pin and the watchdog apart', (t) => {
  const report = new Program()
    .copy(CHIP_RESET, SRAM)
    .copy(WATCHDOG_REASON, SRAM + 4)
    .copy(WATCHDOG_SCRATCH0, SRAM + 8)
    .put(WATCHDOG_SCRATCH0, 0x1234)
    .tick()
    .watchdog(5000);
  const pico = new Pico(image(t, report.stop().bytes()));
  const words = () => [0, 4, 8].map((offset) => pico.read32(SRAM + offset));
  pico.runFor(1);
  assert.deepEqual(words(), [1 << 8, 0, 0]);
  pico.runFor(5);
  assert.deepEqual(words(), [1 << 8, 1, 0x1234], 'after the watchdog');
  pico.runPin();
  pico.runFor(1);
  assert.deepEqual(words(), [1 << 16, 0, 0], 'after the RUN pin');
  pico.powerCycle({ offMs: 10 });
  pico.runFor(1);
  assert.deepEqual(words(), [1 << 8, 0, 0], 'after power came back');
  assert.deepEqual(pico.boots.map(({ cause }) => cause), ['power-on', 'watchdog', 'run-pin', 'power-on']);
});

test('a reset of the core alone leaves the outputs as they are', (t) => {
  const program = new Program().output(9).high(9).put(AIRCR, 0x05fa_0004).stop();
  const pico = new Pico(image(t, program.bytes()));
  pico.runUntil(() => pico.boots.length > 1, 1);
  assert.equal(pico.boots[1].cause, 'core-reset');
  assert.equal(pico.driven(9), true);
  assert.equal(pico.level(9), 1);
});

test('memory outlives a warm reset and is noise after a cold one', (t) => {
  const pico = new Pico(image(t, new Program().put(SRAM, 0xcafe_f00d).stop().bytes()));
  pico.runFor(1);
  pico.runPin();
  assert.equal(pico.read32(SRAM), 0xcafe_f00d);
  const before = pico.readBytes(SRAM + 1024, 64);
  pico.powerCycle();
  assert.notEqual(pico.read32(SRAM), 0xcafe_f00d);
  assert.notDeepEqual(pico.readBytes(SRAM + 1024, 64), before);
});

test('a fault is recorded with its place, and the chip waits for the watchdog', (t) => {
  const program = new Program().tick().watchdog(2000).load(5, 0x3000_0000).ldr(0, 5).stop();
  const pico = new Pico(image(t, program.bytes()));
  pico.runFor(1);
  assert.equal(pico.faults[0].kind, 'read of nothing');
  assert.equal(pico.faults[0].address, 0x3000_0000);
  assert.equal(pico.faults[0].pc >>> 8, 0x2004_1f, 'in the program');
  assert.match(pico.halted.reason, /fault before the firmware had a vector table/);
  pico.runFor(2);
  assert.deepEqual(pico.boots.map(({ cause }) => cause), ['power-on', 'watchdog']);
});

test('reading flash while it is not mapped is a crash, unless strictness is off', (t) => {
  const path = image(t, new Program().load(5, FLASH + 256).ldr(0, 5).load(1, SRAM).str(0, 1).stop().bytes());
  const strict = new Pico(path);
  strict.runFor(1);
  assert.equal(strict.halted.reason, 'flash access while XIP is off');
  assert.equal(strict.faults.length, 1);
  const lenient = new Pico(path, { strict: false });
  lenient.runFor(1);
  assert.equal(lenient.halted, null);
  assert.equal(lenient.read32(SRAM), 0xffff_ffff);
});

test('flash without a valid bootloader does not boot', (t) => {
  const pico = new Pico(null, { flash: new Uint8Array(4096) });
  pico.runFor(10);
  assert.match(pico.halted.reason, /no valid second-stage bootloader/);
  const broken = boot2(idle());
  broken[3] ^= 1;
  const path = temporaryFile(t, 'broken.elf', elfFile([{ address: FLASH, bytes: broken }]));
  const other = new Pico(path);
  other.runFor(1);
  assert.ok(other.halted);
});

test('flashing an image erases the sectors it touches and leaves the others', (t) => {
  const flash = new Uint8Array(2 * 1024 * 1024).fill(0x11);
  const pico = new Pico(image(t, idle()), { flash });
  assert.equal(pico.flash.bytes[256], 0xff);
  assert.equal(pico.flash.bytes[4095], 0xff);
  assert.equal(pico.flash.bytes[4096], 0x11);
  pico.program(image(t, new Program().put(SRAM, 7).stop().bytes()));
  pico.runFor(1);
  assert.equal(pico.read32(SRAM), 7);
  assert.equal(pico.flash.bytes[4096], 0x11);
});

test('the flash can be kept in a file', (t) => {
  const file = temporaryFile(t, 'flash.bin');
  const first = new Pico(image(t, new Program().put(SRAM, 0).program(0x8000, SRAM).stop().bytes()));
  first.runFor(2);
  first.saveFlash(file);
  const second = new Pico(null, { flash: file });
  assert.deepEqual(second.flashImage(), first.flashImage());
  second.runFor(2);
  assert.equal(second.halted, null);
});

test('a board that has had no power yet does nothing and holds nothing', (t) => {
  const pico = new Pico(image(t, blink()), { powered: false });
  pico.uart[0].send('lost');
  pico.runFor(10);
  assert.deepEqual([pico.boots, pico.edges], [[], []]);
  assert.throws(() => pico.read32(SRAM), /power has never been on/);
  pico.powerOn();
  pico.runFor(10);
  assert.equal(pico.boots[0].timeNs, 10 * MS);
  assert.equal(pico.level(25), 1);
});

test('what is nonsense is refused with a sentence', (t) => {
  assert.throws(() => new Pico(null), /neither an image nor/);
  assert.throws(() => new Pico(null, { flash: new Uint8Array(3 * 1024 * 1024) }), /do not fit/);
  const path = temporaryFile(t, 'ram.elf', elfFile([{ address: SRAM, bytes: Uint8Array.of(1) }]));
  assert.throws(() => new Pico(path), /nothing for the flash/);
  const pico = new Pico(image(t, idle()));
  assert.throws(() => pico.runFor(-1), /cannot be -1/);
  assert.throws(() => pico.setAnalog(5, 0), UsageError);
  assert.throws(() => pico.setAnalog(0, 5000), UsageError);
});
