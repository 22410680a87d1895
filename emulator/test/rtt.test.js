import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Rtt } from '../src/rtt.js';

const CONTROL = 0x2000_0010;
const BUFFER = 0x2000_0100;
const SIZE = 16;

/** Memory with an RTT control block, and the firmware's end of it. */
function setUp({ id = 'SEGGER RTT' } = {}) {
  const bytes = new Uint8Array(1024);
  const view = new DataView(bytes.buffer);
  const memory = {
    read32: (address) => view.getUint32(address - 0x2000_0000, true),
    write32: (address, value) => view.setUint32(address - 0x2000_0000, value, true),
    readBytes: (address, length) => bytes.slice(address - 0x2000_0000, address - 0x2000_0000 + length),
  };
  bytes.set(Buffer.from(id), CONTROL - 0x2000_0000);
  memory.write32(CONTROL + 24 + 4, BUFFER);
  memory.write32(CONTROL + 24 + 8, SIZE);
  const frames = [];
  const rtt = new Rtt(CONTROL, (frame) => frames.push([...frame]));
  const write = (...data) => {
    let at = memory.read32(CONTROL + 24 + 12);
    for (const byte of data) {
      bytes[BUFFER - 0x2000_0000 + at] = byte;
      at = (at + 1) % SIZE;
    }
    memory.write32(rtt.watchAddress, at);
    rtt.take(memory);
  };
  return { memory, rtt, frames, write };
}

test('frames end with a zero, in however many pieces they come', () => {
  const { frames, write } = setUp();
  write(1, 2);
  assert.deepEqual(frames, []);
  write(3, 0, 4);
  write(0);
  assert.deepEqual(frames, [[1, 2, 3], [4]]);
});

test('empty frames are none', () => {
  const { frames, write } = setUp();
  write(0, 0, 5, 0, 0);
  assert.deepEqual(frames, [[5]]);
});

test('the buffer is emptied at once, so that it never fills, and wraps', () => {
  const { memory, frames, write } = setUp();
  for (let i = 1; i <= 20; i++) write(i, i, i, i, i, 0);
  assert.deepEqual(frames.at(-1), [20, 20, 20, 20, 20]);
  assert.equal(frames.length, 20);
  assert.equal(memory.read32(CONTROL + 24 + 16), memory.read32(CONTROL + 24 + 12));
});

test('a restart forgets the unfinished frame and what the last run left in memory', () => {
  const { memory, rtt, frames, write } = setUp();
  for (let i = 0; i < 4; i++) write(1, 2, 3, 4, 5); // more than the buffer holds
  rtt.restart(memory);
  write(9, 0);
  assert.deepEqual(frames, [[9]]);
});

test('memory that is no control block yet is left alone', () => {
  const { frames, write } = setUp({ id: 'garbage' });
  write(1, 0);
  assert.deepEqual(frames, []);
});
