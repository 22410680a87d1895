/**
 * The load and store instructions of ARMv6-M, which touch no flags.
 */

const SP = 13;
const LR = 14;

/**
 * LDR, LDRH, LDRB, LDRSH, LDRSB, STR, STRH, STRB in all their forms. The cost is left in `core.cost`.
 * @param {import('./core.js').Core} core
 * @param {number} op the halfword, 0x4800 to 0x9fff
 * @param {number} at its address
 */
export function transfer(core, op, at) {
  const r = core.registers;
  const low = op & 7;
  const base = r[(op >>> 3) & 7];
  switch (op >>> 11) {
    case 9: // LDR Rt, [PC, #imm]
      r[(op >>> 8) & 7] = core.load32(((at + 4) & ~3) + ((op & 0xff) << 2));
      return;
    case 10:
    case 11:
      transferIndexed(core, op, low, (base + r[(op >>> 6) & 7]) | 0);
      return;
    case 12: // STR Rt, [Rn, #imm]
      core.store32((base + ((op >>> 4) & 0x7c)) | 0, r[low]);
      return;
    case 13: // LDR
      r[low] = core.load32((base + ((op >>> 4) & 0x7c)) | 0);
      return;
    case 14: // STRB
      core.store8((base + ((op >>> 6) & 31)) | 0, r[low]);
      return;
    case 15: // LDRB
      r[low] = core.load8((base + ((op >>> 6) & 31)) | 0);
      return;
    case 16: // STRH
      core.store16((base + ((op >>> 5) & 0x3e)) | 0, r[low]);
      return;
    case 17: // LDRH
      r[low] = core.load16((base + ((op >>> 5) & 0x3e)) | 0);
      return;
    case 18: // STR Rt, [SP, #imm]
      core.store32((r[SP] + ((op & 0xff) << 2)) | 0, r[(op >>> 8) & 7]);
      return;
    default: // LDR Rt, [SP, #imm]
      r[(op >>> 8) & 7] = core.load32((r[SP] + ((op & 0xff) << 2)) | 0);
  }
}

/** Loads and stores at [Rn, Rm]. */
function transferIndexed(core, op, t, address) {
  const r = core.registers;
  switch ((op >>> 9) & 7) {
    case 0:
      core.store32(address, r[t]);
      return;
    case 1:
      core.store16(address, r[t]);
      return;
    case 2:
      core.store8(address, r[t]);
      return;
    case 3: // LDRSB
      r[t] = (core.load8(address) << 24) >> 24;
      return;
    case 4:
      r[t] = core.load32(address);
      return;
    case 5:
      r[t] = core.load16(address);
      return;
    case 6:
      r[t] = core.load8(address);
      return;
    default: // LDRSH
      r[t] = (core.load16(address) << 16) >> 16;
  }
}

/** PUSH and POP; a popped PC is left in `core.exitValue`. @returns {number} cycles */
export function transferStack(core, op) {
  const r = core.registers;
  const pop = (op & 0x800) !== 0;
  const extra = (op & 0x100) !== 0;
  const count = bitCount(op & 0xff) + (extra ? 1 : 0);
  const base = pop ? r[SP] : r[SP] - 4 * count;
  let address = base;
  for (let i = 0; i < 8; i++) {
    if (!(op & (1 << i))) continue;
    if (pop) r[i] = core.load32(address);
    else core.store32(address, r[i]);
    address += 4;
  }
  if (extra) {
    if (pop) core.exitValue = core.load32(address);
    else core.store32(address, r[LR]);
  }
  r[SP] = pop ? base + 4 * count : base;
  return count + (pop && extra ? 3 : 1);
}

/** STMIA and LDMIA. @returns {number} cycles */
export function transferMultiple(core, op) {
  const r = core.registers;
  const base = (op >>> 8) & 7;
  const load = (op & 0x800) !== 0;
  let address = r[base];
  for (let i = 0; i < 8; i++) {
    if (!(op & (1 << i))) continue;
    if (load) r[i] = core.load32(address);
    else core.store32(address, r[i]);
    address += 4;
  }
  if (!load || !(op & (1 << base))) r[base] = address;
  return 1 + bitCount(op & 0xff);
}

function bitCount(byte) {
  let count = 0;
  for (let rest = byte; rest; rest &= rest - 1) count++;
  return count;
}
