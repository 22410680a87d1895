/**
 * Power that fails at a chosen moment: at a time, or around an operation of the flash.
 */
import { UsageError } from './fault.js';
import { Random } from './random.js';

/**
 * @typedef {object} CutPlan
 * @property {number} [atMs] the simulated time at which power fails
 * @property {number} [flashOperation] or: around the n-th erase or program from now, 1 for the next
 * @property {'erase' | 'program'} [kind] count only operations of this kind
 * @property {'before' | 'during' | 'after'} [moment] `before` it begins, `during` it (the default),
 *   or just `after` it has ended
 * @property {number} [fraction] for `during`: how far it has come, above 0 and below 1; otherwise random
 * @property {number} [offMs] how long power stays away; Infinity until `powerOn` is called; default 100
 *
 * @typedef {object} Cut
 * @property {number} timeNs
 * @property {(import('./w25q.js').Operation & {fraction: number}) | null} torn the operation that was
 *   torn, and how far it had come
 */

const MOMENTS = ['before', 'during', 'after'];
const KINDS = [undefined, 'erase', 'program'];
const DEFAULT_OFF_MS = 100;

export class PowerCuts {
  /** The cuts that have happened. @type {Cut[]} */
  done = [];
  #board;
  #random;
  /** @type {(CutPlan & {left: number})[]} */
  #waiting = [];

  /**
   * @param {import('./board.js').Board} board
   * @param {number} seed decides how far a torn operation has come
   */
  constructor(board, seed) {
    this.#board = board;
    this.#random = new Random(seed + 1);
    board.flash.onOperation = (operation) => this.#onOperation(operation);
  }

  /** @param {CutPlan} plan */
  plan(plan) {
    check(plan);
    if (plan.atMs !== undefined) this.#at(Math.round(plan.atMs * 1e6), plan);
    else this.#waiting.push({ moment: 'during', ...plan, left: plan.flashOperation });
  }

  /** Forgets the plans that wait for a flash operation. */
  cancel() {
    this.#waiting = [];
  }

  /** @returns {boolean} whether the operation may begin */
  #onOperation(operation) {
    let begins = true;
    for (const plan of this.#waiting) {
      if ((plan.kind && plan.kind !== operation.kind) || --plan.left > 0) continue;
      if (plan.moment === 'before') {
        begins = false;
        this.#cutSoon(plan);
      } else {
        const fraction = plan.moment === 'after' ? 1 : plan.fraction ?? 0.02 + 0.96 * this.#random.fraction();
        const span = operation.endNs - operation.startNs;
        this.#at(operation.startNs + Math.round(span * fraction), plan);
      }
    }
    this.#waiting = this.#waiting.filter((plan) => plan.left > 0);
    return begins;
  }

  #at(timeNs, plan) {
    this.#board.at(timeNs, () => this.#cutSoon(plan));
  }

  #cutSoon(plan) {
    this.#board.switchPowerSoon(() => this.#cut(plan));
  }

  #cut({ offMs = DEFAULT_OFF_MS }) {
    const board = this.#board;
    if (!board.powered) return;
    this.done.push({ timeNs: board.clock.nanos, torn: board.powerOff() });
    if (offMs === Infinity) return;
    board.at(board.clock.nanos + Math.round(offMs * 1e6), () => {
      board.switchPowerSoon(() => board.powerOn());
    });
  }
}

function check(plan) {
  const { atMs, flashOperation, kind, moment = 'during', fraction = 0.5, offMs = 0 } = plan;
  if ((atMs === undefined) === (flashOperation === undefined)) {
    throw new UsageError('a power cut needs either atMs or flashOperation');
  }
  if (atMs !== undefined && !(atMs >= 0)) throw new UsageError(`atMs must not be ${atMs}`);
  if (flashOperation !== undefined && !(Number.isInteger(flashOperation) && flashOperation > 0)) {
    throw new UsageError(`flashOperation counts from 1, it cannot be ${flashOperation}`);
  }
  if (!MOMENTS.includes(moment)) throw new UsageError(`moment must be one of ${MOMENTS.join(', ')}`);
  if (!KINDS.includes(kind)) throw new UsageError(`kind must be erase or program, not ${kind}`);
  if (!(fraction > 0 && fraction < 1)) throw new UsageError('fraction must be above 0 and below 1');
  if (!(offMs >= 0)) throw new UsageError(`offMs must not be ${offMs}`);
}
