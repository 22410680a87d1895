// Random levels on the pins of a board, and what the program sees of them.

/** A filter takes a level that lasts so much longer than itself, by its own samples. */
const FILTER_MARGIN_MS = 2;
/** Longer, in scans, than the slowest filter of the applications here needs: each change is seen, or there is none. */
const LEAST_STAY = 5;

/** How often a level is drawn anew, in scans, and how often it is then True. */
const USUAL = { stays: 12, high: 0.5 };

/**
 * Values for some scans.
 * @param {import('./application.js').Application} application
 * @param {number} scans
 * @param {() => number} random
 * @param {Record<string, {stays?: number, high?: number}>} habits of the inputs, by name
 * @returns {(0 | 1)[][]} for each scan, the values that the inputs take just behind it; those before scan 0 come first
 */
export function stimulus({ inputs }, scans, random, habits = {}) {
  const habit = inputs.map(({ name }) => ({ ...USUAL, ...habits[name] }));
  const draw = ({ high }) => (random() < high ? 1 : 0);
  const since = inputs.map(() => 0);
  const values = habit.map(draw);
  const rows = [[...values]];
  for (let scan = 1; scan <= scans; scan++) {
    inputs.forEach(({ filterMs }, i) => {
      if (++since[i] < (filterMs ? LEAST_STAY : 1) || random() * habit[i].stays > 1) return;
      since[i] = 0;
      values[i] = draw(habit[i]);
    });
    rows.push([...values]);
  }
  return rows;
}

/** How many scans after a change of its level, made just behind a scan, an input is seen to have changed. */
function seenAfter({ filterMs }, periodMs) {
  return filterMs ? Math.ceil((filterMs + FILTER_MARGIN_MS) / periodMs) : 1;
}

/** The stimulus as the program sees it, in the CSV that `grafcet trace` reads. */
export function asCsv({ inputs, symbols: { period_ms: periodMs } }, rows) {
  const lines = [['time_ms', ...inputs.map(({ name }) => name)]];
  for (let scan = 0; scan < rows.length - 1; scan++) {
    // The row behind scan k is rows[k + 1]; a change seen n scans later was made behind scan `scan - n`.
    const seen = inputs.map((input, i) => rows[Math.max(0, scan - seenAfter(input, periodMs) + 1)][i]);
    lines.push([scan * periodMs, ...seen]);
  }
  return lines.map((line) => line.join(',')).join('\n') + '\n';
}
