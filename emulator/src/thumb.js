/**
 * The instructions of ARMv6-M (Armv6-M Architecture Reference Manual, chapter A6), executed in one
 * loop over local variables. Costs in cycles are those of the Cortex-M0+ with the single-cycle
 * multiplier (TRM, table 3-1).
 */
import { holds } from './condition.js';
import { Fault } from './fault.js';
import { ROM_SIZE } from './map.js';
import { transfer, transferMultiple, transferStack } from './transfer.js';

/** Why the loop was left for work that needs the whole core. */
export const EXIT = { none: 0, romCall: 1, exceptionReturn: 2, supervisorCall: 3 };

const SP = 13;
const LR = 14;
const PC = 15;
const BRANCH_TO_SELF = 0xe7fe;

/**
 * Executes until the clock's limit. A faulting instruction throws a `Fault` and leaves PC on itself.
 * @param {import('./core.js').Core} core
 */
export function execute(core) {
  const { registers: r, clock } = core;
  let pc = r[PC];
  let at = pc;
  let n = clock.slice;
  let limit = clock.limit;
  let { signOf, zeroOf, carry, overflow } = core;
  core.exit = EXIT.none;

  try {
    while (n < limit) {
      at = pc;
      const op = core.fetch(pc);
      pc += 2;
      switch (op >>> 11) {
        case 0: {
          // LSLS Rd, Rm, #imm; MOVS Rd, Rm when the amount is 0
          const amount = (op >>> 6) & 31;
          const value = r[(op >>> 3) & 7];
          if (amount) carry = (value >>> (32 - amount)) & 1;
          r[op & 7] = signOf = zeroOf = value << amount;
          n += 1;
          break;
        }
        case 1: {
          // LSRS Rd, Rm, #imm
          const amount = (op >>> 6) & 31;
          const value = r[(op >>> 3) & 7];
          carry = (value >>> (amount ? amount - 1 : 31)) & 1;
          r[op & 7] = signOf = zeroOf = amount ? value >>> amount | 0 : 0;
          n += 1;
          break;
        }
        case 2: {
          // ASRS Rd, Rm, #imm
          const amount = (op >>> 6) & 31;
          const value = r[(op >>> 3) & 7];
          carry = (value >> (amount ? amount - 1 : 31)) & 1;
          r[op & 7] = signOf = zeroOf = value >> (amount || 31);
          n += 1;
          break;
        }
        case 3: {
          // ADDS, SUBS Rd, Rn, Rm or #imm3
          const a = r[(op >>> 3) & 7];
          const b = op & 0x400 ? (op >>> 6) & 7 : r[(op >>> 6) & 7];
          let result;
          if (op & 0x200) {
            result = (a - b) | 0;
            carry = a >>> 0 >= b >>> 0 ? 1 : 0;
            overflow = ((a ^ b) & (a ^ result)) >>> 31;
          } else {
            result = (a + b) | 0;
            carry = result >>> 0 < a >>> 0 ? 1 : 0;
            overflow = ((a ^ result) & (b ^ result)) >>> 31;
          }
          r[op & 7] = signOf = zeroOf = result;
          n += 1;
          break;
        }
        case 4: // MOVS Rd, #imm8
          r[(op >>> 8) & 7] = signOf = zeroOf = op & 0xff;
          n += 1;
          break;
        case 5:
        case 7: {
          // CMP Rn, #imm8; SUBS Rdn, #imm8
          const a = r[(op >>> 8) & 7];
          const b = op & 0xff;
          const result = (a - b) | 0;
          carry = a >>> 0 >= b ? 1 : 0;
          overflow = ((a ^ b) & (a ^ result)) >>> 31;
          signOf = zeroOf = result;
          if (op & 0x1000) r[(op >>> 8) & 7] = result;
          n += 1;
          break;
        }
        case 6: {
          // ADDS Rdn, #imm8
          const a = r[(op >>> 8) & 7];
          const b = op & 0xff;
          const result = (a + b) | 0;
          carry = result >>> 0 < a >>> 0 ? 1 : 0;
          overflow = ((a ^ result) & (b ^ result)) >>> 31;
          r[(op >>> 8) & 7] = signOf = zeroOf = result;
          n += 1;
          break;
        }
        case 8:
          if (op < 0x4400) {
            const d = op & 7;
            const m = r[(op >>> 3) & 7];
            const a = r[d];
            let result = 0;
            switch ((op >>> 6) & 15) {
              case 0: // ANDS
                r[d] = result = a & m;
                break;
              case 1: // EORS
                r[d] = result = a ^ m;
                break;
              case 2: {
                // LSLS Rdn, Rm
                const amount = m & 0xff;
                if (amount) carry = amount <= 32 ? (a >>> (32 - amount)) & 1 : 0;
                r[d] = result = amount < 32 ? a << amount : 0;
                break;
              }
              case 3: {
                // LSRS Rdn, Rm
                const amount = m & 0xff;
                if (amount) carry = amount <= 32 ? (a >>> (amount - 1)) & 1 : 0;
                r[d] = result = amount < 32 ? a >>> amount | 0 : 0;
                break;
              }
              case 4: {
                // ASRS Rdn, Rm
                const amount = Math.min(m & 0xff, 32);
                if (amount) carry = (a >> (amount - 1)) & 1;
                r[d] = result = a >> Math.min(amount, 31);
                break;
              }
              case 5: {
                // ADCS
                const sum = (a >>> 0) + (m >>> 0) + carry;
                result = sum | 0;
                carry = sum > 0xffff_ffff ? 1 : 0;
                overflow = ((a ^ result) & (m ^ result)) >>> 31;
                r[d] = result;
                break;
              }
              case 6: {
                // SBCS
                const sum = (a >>> 0) + (~m >>> 0) + carry;
                result = sum | 0;
                carry = sum > 0xffff_ffff ? 1 : 0;
                overflow = ((a ^ m) & (a ^ result)) >>> 31;
                r[d] = result;
                break;
              }
              case 7: {
                // RORS
                const amount = m & 31;
                result = amount ? (a >>> amount) | (a << (32 - amount)) : a;
                if (m & 0xff) carry = result >>> 31;
                r[d] = result;
                break;
              }
              case 8: // TST
                result = a & m;
                break;
              case 9: // RSBS Rd, Rm, #0
                result = -m | 0;
                carry = m === 0 ? 1 : 0;
                overflow = (m & result) >>> 31;
                r[d] = result;
                break;
              case 10: // CMP Rn, Rm
                result = (a - m) | 0;
                carry = a >>> 0 >= m >>> 0 ? 1 : 0;
                overflow = ((a ^ m) & (a ^ result)) >>> 31;
                break;
              case 11: // CMN
                result = (a + m) | 0;
                carry = result >>> 0 < a >>> 0 ? 1 : 0;
                overflow = ((a ^ result) & (m ^ result)) >>> 31;
                break;
              case 12: // ORRS
                r[d] = result = a | m;
                break;
              case 13: // MULS
                r[d] = result = Math.imul(a, m);
                break;
              case 14: // BICS
                r[d] = result = a & ~m;
                break;
              default: // MVNS
                r[d] = result = ~m;
            }
            signOf = zeroOf = result;
            n += 1;
          } else {
            // High registers: ADD, CMP, MOV, BX and BLX
            const m = (op >>> 3) & 15;
            const d = ((op >>> 4) & 8) | (op & 7);
            const value = m === PC ? at + 4 : r[m];
            switch ((op >>> 8) & 3) {
              case 0:
              case 2: {
                const left = op & 0x200 ? 0 : d === PC ? at + 4 : r[d];
                const result = (left + value) | 0;
                if (d === PC) {
                  pc = result & ~1;
                  n += 1;
                } else r[d] = d === SP ? result & ~3 : result;
                break;
              }
              case 1: {
                const a = r[d];
                const result = (a - value) | 0;
                carry = a >>> 0 >= value >>> 0 ? 1 : 0;
                overflow = ((a ^ value) & (a ^ result)) >>> 31;
                signOf = zeroOf = result;
                break;
              }
              default:
                n += 1;
                if (op & 0x80) r[LR] = pc | 1;
                else if (value >>> 28 === 15 && core.IPSR) {
                  core.exit = EXIT.exceptionReturn;
                  core.exitValue = value;
                  limit = 0;
                  break;
                }
                if (!(value & 1)) throw new Fault('branch out of Thumb state', value);
                pc = value & ~1;
            }
            n += 1;
          }
          break;
        case 9:
        case 10:
        case 11:
        case 12:
        case 13:
        case 14:
        case 15:
        case 16:
        case 17:
        case 18:
        case 19:
          clock.slice = n;
          transfer(core, op, at);
          limit = clock.limit;
          n += core.cost;
          break;
        case 20: // ADR
          r[(op >>> 8) & 7] = ((at + 4) & ~3) + ((op & 0xff) << 2);
          n += 1;
          break;
        case 21: // ADD Rd, SP, #imm
          r[(op >>> 8) & 7] = r[SP] + ((op & 0xff) << 2);
          n += 1;
          break;
        case 22:
        case 23:
          if ((op & 0xf600) === 0xb400) {
            // PUSH, POP
            clock.slice = n;
            n += transferStack(core, op);
            limit = clock.limit;
            if ((op & 0x0900) === 0x0900) {
              const value = core.exitValue;
              if (value >>> 28 === 15 && core.IPSR) {
                core.exit = EXIT.exceptionReturn;
                limit = 0;
              } else if (value & 1) pc = value & ~1;
              else throw new Fault('branch out of Thumb state', value);
            }
            break;
          }
          switch ((op >>> 6) & 0x3f) {
            case 0x00:
            case 0x01: // ADD SP, #imm
              r[SP] += (op & 0x7f) << 2;
              break;
            case 0x02:
            case 0x03: // SUB SP, #imm
              r[SP] -= (op & 0x7f) << 2;
              break;
            case 0x08: // SXTH
              r[op & 7] = (r[(op >>> 3) & 7] << 16) >> 16;
              break;
            case 0x09: // SXTB
              r[op & 7] = (r[(op >>> 3) & 7] << 24) >> 24;
              break;
            case 0x0a: // UXTH
              r[op & 7] = r[(op >>> 3) & 7] & 0xffff;
              break;
            case 0x0b: // UXTB
              r[op & 7] = r[(op >>> 3) & 7] & 0xff;
              break;
            case 0x28: {
              // REV
              const m = r[(op >>> 3) & 7];
              r[op & 7] = (m << 24) | ((m & 0xff00) << 8) | ((m >>> 8) & 0xff00) | (m >>> 24);
              break;
            }
            case 0x29: {
              // REV16
              const m = r[(op >>> 3) & 7];
              r[op & 7] = ((m & 0x00ff_00ff) << 8) | ((m >>> 8) & 0x00ff_00ff);
              break;
            }
            case 0x2b: {
              // REVSH
              const m = r[(op >>> 3) & 7];
              r[op & 7] = ((m << 24) >> 16) | ((m >>> 8) & 0xff);
              break;
            }
            default:
              if (op >>> 8 === 0xbe && pc >>> 0 < ROM_SIZE) {
                core.exit = EXIT.romCall;
                core.exitValue = op & 0xff;
                limit = 0;
              } else if (core.hint(op)) limit = 0;
          }
          n += 1;
          break;
        case 24:
        case 25: // STMIA, LDMIA
          clock.slice = n;
          n += transferMultiple(core, op);
          limit = clock.limit;
          break;
        case 26:
        case 27: {
          const condition = (op >>> 8) & 15;
          if (condition === 14) throw new Fault('undefined instruction', at);
          if (condition === 15) {
            core.exit = EXIT.supervisorCall;
            limit = 0;
            n += 1;
            break;
          }
          if (holds(condition, signOf, zeroOf, carry, overflow)) {
            pc = at + 4 + ((op << 24) >> 23);
            n += 2;
          } else n += 1;
          break;
        }
        case 28: // B
          pc = at + 4 + ((op << 21) >> 20);
          n += 2;
          // `b .` does nothing until an interrupt comes: pass the time in one go, whole rounds of it.
          if (op === BRANCH_TO_SELF && n < limit) n += 2 * ((limit - n + 1) >> 1);
          break;
        case 30: {
          const second = core.fetch(pc);
          pc += 2;
          if ((second & 0xd000) === 0xd000) {
            // BL
            const s = (op << 21) >> 31;
            const i1 = ~((second >>> 13) ^ s) & 1;
            const i2 = ~((second >>> 11) ^ s) & 1;
            r[LR] = pc | 1;
            const offset = (s << 24) | (i1 << 23) | (i2 << 22) | ((op & 0x3ff) << 12);
            pc = (pc + (offset | ((second & 0x7ff) << 1))) | 0;
          } else {
            core.signOf = signOf;
            core.zeroOf = zeroOf;
            core.carry = carry;
            core.overflow = overflow;
            core.system(op, second);
            ({ signOf, zeroOf, carry, overflow } = core);
            limit = Math.min(limit, clock.limit);
          }
          n += 3;
          break;
        }
        default:
          throw new Fault('undefined instruction', at);
      }
    }
    at = pc;
  } finally {
    r[PC] = at;
    clock.slice = n;
    core.signOf = signOf;
    core.zeroOf = zeroOf;
    core.carry = carry;
    core.overflow = overflow;
  }
}
