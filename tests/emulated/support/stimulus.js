// Random levels and voltages on the pins of a board, and what the program sees of them.

/** A filter takes a level that lasts so much longer than itself, by its own samples. */
const FILTER_MARGIN_MS = 2;
/** Longer, in scans, than the slowest filter of the applications here needs: each change is seen, or there is none. */
const LEAST_STAY = 5;

/** The highest reading of the converter. */
const FULL_SCALE = 4095;

/** How often a level is drawn anew, in scans, and how often it is then True. */
const USUAL = { stays: 12, high: 0.5 };

/**
 * Values for some scans.
 * @param {import('./application.js').Application} application
 * @param {number} scans
 * @param {() => number} random
 * @param {Record<string, {stays?: number, high?: number}>} habits of the inputs, by name
 * @returns {number[][]} for each scan, what the inputs are given just behind it: 0 or 1, or a reading of the converter;
 * what they have before scan 0 comes first
 */
export function stimulus({ inputs, symbols: { period_ms: periodMs } }, scans, random, habits = {}) {
  const habit = inputs.map(({ name }) => ({ ...USUAL, ...habits[name] }));
  const draw = ({ scale }, { high }) => (scale ? Math.floor(random() * (FULL_SCALE + 1)) : random() < high ? 1 : 0);
  const since = inputs.map(() => 0);
  const values = inputs.map((input, i) => draw(input, habit[i]));
  const rows = [[...values]];
  for (let scan = 0; scan < scans; scan++) {
    inputs.forEach((input, i) => {
      if (++since[i] < leastStay(input) || random() * habit[i].stays > 1) return;
      if (scan % meanOf(input, periodMs) !== 0) return;
      since[i] = 0;
      values[i] = draw(input, habit[i]);
    });
    rows.push([...values]);
  }
  return rows;
}

function leastStay({ filterMs, scale }) {
  return filterMs && !scale ? LEAST_STAY : 1;
}

/** Of how many scans a number is the mean. The first begins behind scan 0. */
function meanOf({ filterMs, scale }, periodMs) {
  return scale && filterMs ? filterMs / periodMs : 1;
}

/** How many scans after a change, made just behind a scan, an input is seen to have changed. */
export function seenAfter(input, periodMs) {
  if (input.scale) return meanOf(input, periodMs);
  return input.filterMs ? Math.ceil((input.filterMs + FILTER_MARGIN_MS) / periodMs) : 1;
}

/** What the program makes of what an input is given. */
function seenAs({ scale }, given) {
  return scale ? scale.low + Math.round((given * (scale.high - scale.low)) / FULL_SCALE) : given;
}

/** The stimulus as the program sees it, in the CSV that `grafcet trace` reads. */
export function asCsv({ inputs, symbols: { period_ms: periodMs } }, rows) {
  const lines = [['time_ms', ...inputs.map(({ name }) => name)]];
  for (let scan = 0; scan < rows.length - 1; scan++) {
    // The row behind scan k is rows[k + 1]; a change seen n scans later was made behind scan `scan - n`.
    const given = inputs.map((input, i) => rows[Math.max(0, scan - seenAfter(input, periodMs) + 1)][i]);
    const seen = inputs.map((input, i) => seenAs(input, given[i]));
    lines.push([scan * periodMs, ...seen]);
  }
  return lines.map((line) => line.join(',')).join('\n') + '\n';
}
