// Nothing that a scan executes can panic: read from the instructions of the images.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Calls, PANICS } from './support/calls.js';
import { bareImage, bareImages, images } from './support/images.js';

/**
 * The panicking branches there are on the way of a scan, all of them in libraries and none of them for anything that a
 * program, an input or a time can be. A branch that is missing here fails the test, and one that is gone does too.
 */
const BRANCHES = [
  // The task is polled after its end. It has none.
  'embassy_executor::raw::TaskStorage<F>::poll -> core::panicking::panic_const::panic_const_async_fn_resumed',
  // The queue of timers is borrowed by two at a time. It is borrowed in critical sections only.
  'TIMER_IRQ_0 -> core::cell::panic_already_borrowed',
  '_embassy_time_schedule_wake -> core::cell::panic_already_borrowed',
  // A timer is awaited outside Embassy's executors.
  '__defmt_default_panic -> core::panicking::panic',
  // A log line is begun within a log line, or ended without a beginning.
  '_defmt_acquire -> core::panicking::panic_fmt',
  '_defmt_release -> core::panicking::panic_fmt',
];

/** Who calls through pointers on the way of a scan; where to is said here, and followed from there. */
const POINTERS = [
  // The functions of the channel to the probe: they are its own.
  '_defmt_acquire',
  '_defmt_release',
  // Formats of arguments: their addresses are taken where the line is logged.
  '_defmt_write',
  // Wakers.
  '_embassy_time_schedule_wake',
  'embassy_time_queue_utils::Queue::next_expiration',
  /^plc::scan::Controller<.*>::finish$/,
  /^plc::link::Link<_>::lease$/,
  // The scan task, by its executor, which mostly is a part of the interrupt.
  'embassy_executor::raw::Executor::poll',
  'SWI_IRQ_0',
];

/** The scan task, the interrupts that run it and the wakers that it calls through pointers. */
function roots(calls) {
  const tasks = calls.named(/TaskStorage<F>::poll$/);
  const scans = tasks.filter((task) => calls.reach([task], tasks).functions.has('grafcet_core::engine::Engine<P,M>::scan_apart'));
  assert.equal(scans.length, 1, `one task of ${tasks.length} scans`);
  const interrupts = calls.named(/^(SWI_IRQ_0|TIMER_IRQ_0)$/);
  assert.equal(interrupts.length, 2);
  const wakers = calls.named(/^embassy_executor::raw::waker::/);
  assert.equal(wakers.length, 3, 'a waker can be cloned, woken and dropped');
  return [...scans, ...interrupts, ...wakers];
}

/** The scan task where it is a function of its own: beside a large engine the compiler leaves it apart from its poll. */
const APART = /^plc::scan::Controller<.*>::run::\{\{closure\}\} /;

const branches = (calls) =>
  calls.reach(roots(calls)).panics.map((branch) => branch.replace(APART, 'embassy_executor::raw::TaskStorage<F>::poll ')).sort();

for (const { name, elf } of images()) {
  const calls = new Calls(elf);

  test(`a scan of ${name} reaches no panic but those of libraries that are listed`, () => {
    assert.deepEqual(branches(calls), [...BRANCHES].sort());
  });

  test(`a scan of ${name} calls through pointers only where it is known where to`, () => {
    const known = (of) => POINTERS.some((it) => (it instanceof RegExp ? it.test(of) : it === of));
    assert.deepEqual(calls.reach(roots(calls)).pointers.filter((of) => !known(of)), []);
  });

  test(`a scan of ${name} is followed from the pins to the log`, () => {
    const { functions } = calls.reach(roots(calls));
    for (const part of [/^plc::input::/, /^grafcet_core::.*scan_apart$/, /^plc::scan::.*finish$/, /^_defmt_acquire$/]) {
      assert.ok([...functions].some((of) => part.test(of)), `${part}`);
    }
  });

  test(`a panic that is put into a scan of ${name} is found`, () => {
    const [into] = calls.named(/Engine<P,M>::scan_apart$/);
    const [panic] = calls.named(/^core::panicking::panic_fmt$/);
    const patched = new Calls({ ...elf, segments: withCall(elf.segments, into.start, panic.start) });
    const found = branches(patched).filter((branch) => !BRANCHES.includes(branch));
    assert.deepEqual(found, ['grafcet_core::engine::Engine<P,M>::scan_apart -> core::panicking::panic_fmt']);
  });
}

for (const { name, elf } of bareImages()) {
  test(`the program ${name} and its engine contain no panic at all`, () => {
    const calls = new Calls(elf);
    assert.deepEqual(calls.named(PANICS), []);
    const { functions, panics, pointers } = calls.reach(calls.named(/^(scan_once|bench_init)$/));
    assert.ok(functions.has('bench_image::contract::work'));
    assert.deepEqual({ panics, pointers }, { panics: [], pointers: [] });
  });
}

test('a bounds check in a scan is found', () => {
  const calls = new Calls(bareImage('panicking'));
  const { panics } = calls.reach(calls.named(/^scan_once$/));
  assert.deepEqual(panics, ['scan_once -> core::panicking::panic_bounds_check']);
});

/** Segments in which the first two halfwords at an address are a call to another one. */
function withCall(segments, address, to) {
  const offset = to - (address + 4);
  const sign = offset < 0 ? 1 : 0;
  const j = (bit) => 1 - (((offset >> bit) & 1) ^ sign);
  const first = 0xf000 | (sign << 10) | ((offset >> 12) & 0x3ff);
  const second = 0xd000 | (j(23) << 13) | (j(22) << 11) | ((offset >> 1) & 0x7ff);
  return segments.map((segment) => {
    const at = address - segment.address;
    if (at < 0 || at >= segment.bytes.length) return segment;
    const bytes = Uint8Array.from(segment.bytes);
    const view = new DataView(bytes.buffer);
    view.setUint16(at, first, true);
    view.setUint16(at + 2, second, true);
    return { ...segment, bytes };
  });
}
