/**
 * Something the processor answers with a HardFault. Thrown by whatever notices it, caught by the
 * executor, recorded by the board.
 */
export class Fault extends Error {
  /**
   * @param {string} kind what went wrong, a lower-case phrase such as `unaligned read`
   * @param {number} [address] the address that was accessed or jumped to
   * @param {{fatal?: boolean}} [options] `fatal`: on silicon the core would run on with garbage, so
   *   there is no handler worth entering; the core locks up at once
   */
  constructor(kind, address, { fatal = false } = {}) {
    super(address === undefined ? kind : `${kind} at 0x${(address >>> 0).toString(16)}`);
    this.kind = kind;
    this.address = address === undefined ? undefined : address >>> 0;
    this.fatal = fatal;
  }
}

/** A mistake of the person who uses the emulator: the message is all that they need to see. */
export class UsageError extends Error {}
