// What happens at the pins of a board in a long run, and what both interpreters on x86 make of it.

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { basename, join } from 'node:path';

import { seenAfter } from './stimulus.js';

/**
 * Plays a program's operators, mishaps and plant, as `soak play` does.
 * @param {import('./application.js').Application} application
 * @param {{seed: number, scans: number}} run
 * @returns {AsyncGenerator<{levels: number[], row: string}>} for each scan, what is wired to the inputs just before it, in
 * the order of the application's inputs, and the row of the trace that it leaves
 */
export async function* playing(application, { seed, scans }) {
  const { inputs, program, symbols } = application;
  const name = basename(program, '.grafcet');
  // What an input without a filter sees in the very next scan is no delay.
  const delays = inputs.map((input) => [input.name, seenAfter(input, symbols.period_ms) - 1]);
  const options = delays.filter(([, scans]) => scans > 0).flatMap(([name, scans]) => ['--delay', `${name}=${scans}`]);
  const soak = join(process.env.PLC_HOST, 'soak');
  const child = spawn(soak, ['play', name, '--seed', seed, '--scans', scans, ...options], {
    stdio: ['ignore', 'pipe', 'inherit'],
  });
  const ended = once(child, 'close');
  try {
    let order = null;
    for await (const line of lines(child.stdout)) {
      const space = line.indexOf(' ');
      const [before, row] = [line.slice(0, space), line.slice(space + 1)];
      if (order === null) {
        const names = before.split(',');
        assert.equal(row, symbols.columns.join(','));
        order = inputs.map((input) => names.indexOf(input.name));
        continue;
      }
      yield { levels: order.map((place) => Number(before[place])), row };
    }
    const [code] = await ended;
    assert.equal(code, 0, `soak play ${name} --seed ${seed} ends well`);
  } finally {
    child.kill();
  }
}

async function* lines(stream) {
  let rest = '';
  for await (const chunk of stream.setEncoding('utf8')) {
    const parts = (rest + chunk).split('\n');
    rest = parts.pop();
    yield* parts;
  }
}
