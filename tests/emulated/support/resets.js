// What is seen of a reset: its cause in the boot line, and which pins it lets go of.

import assert from 'node:assert/strict';

/** The cause that each boot line names, oldest first. */
export const causes = (pico) =>
  pico.log.map(({ text }) => /reset: ([a-z :-]+),/.exec(text)?.[1]).filter(Boolean);

/** Runs until the firmware starts again, and demands that it does in time. The answer is how long that took, in ms. */
export function untilStartedAgain(pico, limitMs) {
  const boots = pico.boots.length;
  const from = pico.timeMs;
  assert.ok(pico.runUntil(() => pico.boots.length > boots, limitMs), 'the board starts again');
  return pico.timeMs - from;
}
