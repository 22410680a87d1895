import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Clock } from '../src/clock.js';

test('alarms fire in the order of their times, and of equal times in the order in which they were set', () => {
  const clock = new Clock();
  const fired = [];
  const set = (name, delay) => clock.createAlarm(() => fired.push([name, clock.nanos])).schedule(delay);
  set('late', 300);
  set('first', 100);
  set('second', 100);
  clock.advanceTo(300);
  clock.fire();
  assert.deepEqual(fired, [['first', 100], ['second', 100], ['late', 300]]);
});

test('an alarm that sets itself again keeps its period', () => {
  const clock = new Clock();
  const times = [];
  const alarm = clock.createAlarm(() => {
    times.push(clock.nanos);
    alarm.schedule(10);
  });
  alarm.schedule(10);
  clock.advanceTo(35);
  clock.fire();
  assert.deepEqual(times, [10, 20, 30]);
});

test('a cancelled alarm does not fire', () => {
  const clock = new Clock();
  const alarm = clock.createAlarm(() => assert.fail('it fired'));
  alarm.schedule(10);
  alarm.cancel();
  clock.advanceTo(20);
  clock.fire();
  assert.equal(clock.nextAlarm, Infinity);
});

test('a reset drops the alarms of the chip and keeps those of the bench', () => {
  const clock = new Clock();
  let fired = 0;
  clock.createAlarm(() => assert.fail('it fired')).schedule(5);
  clock.createAlarm(() => fired++, { lasting: true }).schedule(7);
  clock.dropAlarms();
  clock.advanceTo(10);
  clock.fire();
  assert.equal(fired, 1);
});

test('cycles that are no whole nanoseconds add up without an error', () => {
  const clock = new Clock(6_500_000);
  for (let i = 0; i < 6_500_000 / 4; i++) {
    clock.slice = 4;
    clock.commit();
  }
  assert.equal(clock.nanos, 1e9);
});

test('a new frequency counts from the next slice on', () => {
  const clock = new Clock(100_000_000);
  clock.slice = 10;
  clock.setFrequency(50_000_000);
  clock.commit();
  assert.equal(clock.nanos, 100);
  clock.slice = 10;
  assert.equal(clock.nanos, 300);
});

test('the core is to stop at the first instruction that begins at or after an alarm', () => {
  const clock = new Clock(125_000_000);
  clock.createAlarm(() => {}).schedule(81);
  clock.begin(1e6);
  assert.equal(clock.limit, 11);
  clock.createAlarm(() => {}).schedule(16);
  assert.equal(clock.limit, 2);
});
