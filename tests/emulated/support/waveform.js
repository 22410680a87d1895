// Levels on a pin around the time of its filter, and what the program is to see of each.

/** A level that is longer than the filter by so much is seen. */
const MARGIN_US = 2000;
/** Behind a pulse the pin rests until its end has been seen, by a scan that may come a period later, and one more. */
const SCANS_TO_REST = 2;
/** The shortest level that is tried. */
const SHORTEST_US = 3;

/**
 * @typedef {object} Pulse
 * @property {string} kind
 * @property {number} fromUs
 * @property {number} toUs until when the program has seen of it what it is to see
 * @property {0 | 1} before what the program sees until then
 * @property {0 | 1} after what it sees at the end
 * @property {0 | 1} times how often the other level than `before` is seen
 */

/**
 * Pulses on a pin that is low at first, and the edges that they are made of.
 * @param {{filterMs: number, periodMs: number, fromMs: number, count: number}} wanted
 * @param {() => number} random
 * @returns {{edges: {us: number, level: 0 | 1}[], pulses: Pulse[]}}
 */
export function waveform({ filterMs, periodMs, fromMs, count }, random) {
  const filterUs = filterMs * 1000;
  const edges = [];
  const pulses = [];
  let us = fromMs * 1000;
  let level = 0;
  const between = (least, most) => Math.round(least + random() * (most - least));
  const hold = (duration) => {
    us += duration;
    level = 1 - level;
    edges.push({ us, level });
  };
  /** Shorter than the filter; one in four by nearly nothing. */
  const short = () => (random() < 0.25 ? filterUs - between(1, 20) : between(SHORTEST_US, filterUs - 1));
  /** Longer than the filter by the margin; one in four by nearly nothing. */
  const long = () => filterUs + MARGIN_US + (random() < 0.25 ? between(1, 20) : between(1, 3 * filterUs));
  /** A level that comes and goes, each time for less than the filter's time, and is gone in the end. */
  const noise = (most) => {
    for (let left = between(2, 12); left > 0; left--) {
      hold(Math.min(short(), most));
      hold(Math.min(short(), most));
    }
  };
  const kinds = {
    glitch: () => hold(short()),
    level: () => hold(long()),
    noise: () => {
      noise(Infinity);
      hold(short());
    },
    hum: () => {
      noise(filterUs / 8);
      hold(between(SHORTEST_US, filterUs / 8));
    },
    bounce: () => {
      noise(filterUs / 4);
      hold(long());
      noise(filterUs / 4);
    },
    step: () => noise(filterUs / 4),
  };
  const seen = { glitch: 0, noise: 0, hum: 0, level: 1, bounce: 1, step: 1 };
  for (let i = 0; i < count; i++) {
    const names = Object.keys(kinds);
    const kind = names[Math.floor(random() * names.length)];
    const before = level;
    const restUs = filterUs + MARGIN_US + SCANS_TO_REST * periodMs * 1000;
    hold(between(restUs, restUs + periodMs * 1000));
    const fromUs = us;
    kinds[kind]();
    const after = level;
    pulses.push({ kind, fromUs, toUs: us + restUs, before, after, times: seen[kind] });
  }
  return { edges, pulses };
}
