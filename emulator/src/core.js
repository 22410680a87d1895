/**
 * The Cortex-M0+ of the RP2040: registers, exceptions, the interrupt controller's pending state and
 * sleep. `thumb.js` executes its instructions.
 *
 * It stands in for the core of `rp2040js`, keeps the members which that package's peripherals use,
 * and differs where firmware can tell: SEV sets the event register, an interrupt stays pending until
 * it is taken, PRIMASK holds in WFI, exceptions cost their cycles, and every faulty access, BKPT and
 * undefined instruction is a HardFault instead of a line in a log.
 */
import { Fault } from './fault.js';
import { Memory } from './memory.js';
import { EXIT, execute } from './thumb.js';

export const EXCEPTION = { nmi: 2, hardFault: 3, svCall: 11, pendSv: 14, sysTick: 15, irq0: 16 };

/** Cycles from the request to the handler's first instruction, and back (Cortex-M0+ TRM, 3.8). */
const ENTRY_CYCLES = 15;
const RETURN_CYCLES = 13;
const SP = 13;
/** Beyond the lowest configurable priority: no exception is active. */
const THREAD_PRIORITY = 4;

export const SLEEP = { none: 0, event: 1, interrupt: 2 };

export class Core extends Memory {
  /** R0 to R12, SP, LR, PC. */
  registers = new Int32Array(16);
  /** The stack pointer that is not in use (PSP while MSP is selected, and the other way round). */
  bankedSp = 0;
  usesPsp = false;
  /** Flags: N is the sign of `signOf`, Z is `zeroOf === 0`. */
  signOf = 0;
  zeroOf = 1;
  carry = 0;
  overflow = 0;
  primask = false;
  unprivileged = false;
  /** Number of the active exception, 0 in thread mode. */
  IPSR = 0;
  sleep = SLEEP.none;
  eventRegistered = false;
  /** Locked up or stopped for good; only a reset helps. */
  locked = false;
  /** Set by an instruction whose work is done outside the executor's loop. */
  exit = 0;
  exitValue = 0;

  // The interrupt controller, in the form which the package's PPB reads and writes.
  VTOR = 0;
  SHPR2 = 0;
  SHPR3 = 0;
  interruptNMIMask = 0;
  enabledInterrupts = 0;
  pendingInterrupts = 0;
  interruptPriorities = [0xffff_ffff, 0, 0, 0];
  pendingNMI = false;
  pendingPendSV = false;
  pendingSVCall = false;
  pendingSystick = false;
  /** Interrupt lines that are high now. */
  #lines = 0;
  /** External interrupts whose handlers have been entered and not left. */
  #active = 0;

  /**
   * @param {import('./chip.js').Chip} chip
   * @param {number} [lines] interrupt lines that are high already
   */
  constructor(chip, lines = 0) {
    super(chip);
    this.clock = chip.clock;
    this.#lines = this.pendingInterrupts = lines;
  }

  /** The interrupt lines that are high. */
  get lines() {
    return this.#lines;
  }

  /** Starts at the vector table of the boot ROM. The package calls it, too, before that is there. */
  reset() {
    this.registers[13] = this.chip.bootrom[0] & ~3;
    this.registers[15] = this.chip.bootrom[1] & ~1;
  }

  get PC() {
    return this.registers[15] >>> 0;
  }

  get LR() {
    return this.registers[14] >>> 0;
  }

  /** The package's divider adds its latency here; firmware waits for it by itself, so it is dropped. */
  get cycles() {
    return this.clock.cycles;
  }
  set cycles(_) {}

  /** The package sets it whenever an interrupt's state may have changed. */
  get interruptsUpdated() {
    return true;
  }
  set interruptsUpdated(_) {
    this.clock.stop();
  }

  /** Runs until the clock's limit, a fault, sleep or anything else that needs the board. */
  run() {
    try {
      execute(this);
      if (this.exit === EXIT.romCall) this.chip.onRomCall(this.exitValue);
      else if (this.exit === EXIT.exceptionReturn) this.exceptionReturn(this.exitValue);
      else if (this.exit === EXIT.supervisorCall) this.#supervisorCall();
    } catch (fault) {
      if (!(fault instanceof Fault)) throw fault;
      this.chip.onFault(fault);
    }
  }

  // ---- instructions that are rare ----------------------------------------------------

  /** CPS, NOP, YIELD, WFE, WFI, SEV, BKPT. @returns {boolean} whether the executor must stop */
  hint(op) {
    switch (op) {
      case 0xb662: // CPSIE i
        this.primask = false;
        return this.mayPreempt();
      case 0xb672: // CPSID i
        this.primask = true;
        return false;
      case 0xbf20: // WFE
        if (!this.eventRegistered) {
          this.sleep = SLEEP.event;
          return true;
        }
        this.eventRegistered = false;
        return false;
      case 0xbf30: // WFI
        this.sleep = SLEEP.interrupt;
        return true;
      case 0xbf40: // SEV
        this.eventRegistered = true;
        return false;
    }
    if (op >>> 8 === 0xbf && !(op & 15)) return false;
    throw new Fault(op >>> 8 === 0xbe ? 'breakpoint without a debugger' : 'undefined instruction');
  }

  /** The 32-bit instructions but for BL: MSR, MRS, barriers. */
  system(op, second) {
    if (op >>> 4 === 0xf38 && second >>> 8 === 0x88) {
      this.#writeSpecial(second & 0xff, this.registers[op & 15]);
    } else if (op === 0xf3ef && second >>> 12 === 8) {
      this.registers[(second >>> 8) & 15] = this.#readSpecial(second & 0xff);
    } else if (op !== 0xf3bf || (second & 0xff00) !== 0x8f00) {
      throw new Fault('undefined instruction');
    }
  }

  #readSpecial(number) {
    switch (number) {
      case 8:
        return this.usesPsp ? this.bankedSp : this.registers[SP];
      case 9:
        return this.usesPsp ? this.registers[SP] : this.bankedSp;
      case 16:
        return this.primask ? 1 : 0;
      case 20:
        return (this.usesPsp ? 2 : 0) | (this.unprivileged ? 1 : 0);
      default: // parts of xPSR: bit 0 selects IPSR, bit 2 leaves the flags out; EPSR reads as 0
        return number > 7 ? 0 : (number & 4 ? 0 : this.readApsr()) | (number & 1 ? this.IPSR : 0);
    }
  }

  #writeSpecial(number, value) {
    switch (number) {
      case 8:
      case 9:
        if ((number === 9) === this.usesPsp) this.registers[SP] = value & ~3;
        else this.bankedSp = value & ~3;
        break;
      case 16:
        this.primask = (value & 1) !== 0;
        if (this.mayPreempt()) this.clock.stop();
        break;
      case 20:
        this.unprivileged = (value & 1) !== 0;
        if (!this.IPSR) this.selectStack((value & 2) !== 0);
        break;
      default:
        if (number < 4) this.writeApsr(value);
    }
  }

  #supervisorCall() {
    const barrier = this.primask ? Math.min(this.priorityOf(this.IPSR), 0) : this.priorityOf(this.IPSR);
    if (this.priorityOf(EXCEPTION.svCall) < barrier) {
      this.enter(EXCEPTION.svCall);
    } else {
      this.registers[15] -= 2;
      throw new Fault('supervisor call that cannot be taken');
    }
  }


  // ---- interrupts and exceptions -------------------------------------------------------------

  /** A peripheral's interrupt line. Pending is latched by its rise and taken back by nothing but entry. */
  setInterrupt(irq, level) {
    const bit = 1 << irq;
    if (!level) {
      this.#lines &= ~bit;
    } else if (!(this.#lines & bit)) {
      this.#lines |= bit;
      this.pendingInterrupts |= bit;
      this.clock.stop();
    }
  }

  /** NVIC_ICPR: a line that is still high is pending again at once. */
  clearPending(mask) {
    this.pendingInterrupts &= ~mask | (this.#lines & ~this.#active);
  }

  /** Number of the most urgent pending exception, 0 when there is none (ICSR.VECTPENDING). */
  get vectPending() {
    return this.#mostUrgent().exception;
  }

  /** Something is pending that may interrupt now; asked when PRIMASK opens. */
  mayPreempt() {
    return (
      (this.pendingInterrupts & this.enabledInterrupts) !== 0 ||
      this.pendingPendSV ||
      this.pendingSystick ||
      this.pendingNMI
    );
  }

  /**
   * Between two slices: wakes the core if it is time, and enters the handler of what is most urgent.
   * @returns {boolean} whether the core is awake
   */
  settle() {
    if (this.locked) return false;
    const active = this.priorityOf(this.IPSR);
    const { exception, priority } = this.#mostUrgent();
    const barrier = this.primask ? Math.min(active, 0) : active;
    if (exception && priority < barrier) {
      this.sleep = SLEEP.none;
      this.#acknowledge(exception);
      this.enter(exception);
    } else if (this.sleep === SLEEP.interrupt) {
      // PRIMASK keeps the handler from running, not the core from waking.
      if (exception && priority < active) this.sleep = SLEEP.none;
    } else if (this.sleep === SLEEP.event && this.eventRegistered) {
      this.eventRegistered = false;
      this.sleep = SLEEP.none;
    }
    return this.sleep === SLEEP.none && !this.locked;
  }

  /** HardFault at the instruction that `registers[15]` points to; a second one locks the core up. */
  hardFault() {
    if (this.priorityOf(this.IPSR) < 0) this.locked = true;
    else this.enter(EXCEPTION.hardFault);
  }

  /** Pushes the frame and goes to the handler. */
  enter(exception) {
    const r = this.registers;
    const frame = (r[13] - 32) & ~7;
    const xpsr = (this.readXpsr() & ~(1 << 9)) | (r[13] & 4 ? 1 << 9 : 0);
    try {
      [r[0], r[1], r[2], r[3], r[12], r[14], r[15], xpsr].forEach((word, i) =>
        this.store32(frame + 4 * i, word),
      );
      r[13] = frame;
      r[14] = this.IPSR ? 0xffff_fff1 : this.usesPsp ? 0xffff_fffd : 0xffff_fff9;
      this.selectStack(false);
      this.IPSR = exception;
      this.eventRegistered = true;
      r[15] = this.load32(this.VTOR + 4 * exception) & ~1;
      this.clock.slice += ENTRY_CYCLES;
    } catch (fault) {
      if (!(fault instanceof Fault)) throw fault;
      this.locked = true;
      this.chip.onFault(fault);
    }
  }

  /** BX or POP with an EXC_RETURN value. */
  exceptionReturn(value) {
    const finished = this.IPSR;
    if (finished >= EXCEPTION.irq0) {
      const bit = 1 << (finished - EXCEPTION.irq0);
      this.#active &= ~bit;
      this.pendingInterrupts |= this.#lines & bit;
    }
    const r = this.registers;
    this.selectStack((value & 0xf) === 0xd);
    const frame = r[13];
    const word = (i) => this.load32(frame + 4 * i);
    r[0] = word(0);
    r[1] = word(1);
    r[2] = word(2);
    r[3] = word(3);
    r[12] = word(4);
    r[14] = word(5);
    r[15] = word(6) & ~1;
    const xpsr = word(7);
    r[13] = (frame + 32) | (xpsr & (1 << 9) ? 4 : 0);
    this.writeApsr(xpsr);
    this.IPSR = (value & 0xf) === 1 ? xpsr & 0x3f : 0;
    this.eventRegistered = true;
    this.clock.slice += RETURN_CYCLES;
  }

  /** @returns {number} -2 (NMI) to 3, or `THREAD_PRIORITY`; lower is more urgent */
  priorityOf(exception) {
    switch (exception) {
      case 0:
        return THREAD_PRIORITY;
      case EXCEPTION.nmi:
        return -2;
      case EXCEPTION.hardFault:
        return -1;
      case EXCEPTION.svCall:
        return this.SHPR2 >>> 30;
      case EXCEPTION.pendSv:
        return (this.SHPR3 >> 22) & 3;
      case EXCEPTION.sysTick:
        return this.SHPR3 >>> 30;
      default: {
        const bit = 1 << (exception - EXCEPTION.irq0);
        return this.interruptPriorities.findIndex((mask) => mask & bit);
      }
    }
  }

  selectStack(psp) {
    if (psp === this.usesPsp) return;
    [this.registers[13], this.bankedSp] = [this.bankedSp, this.registers[13]];
    this.usesPsp = psp;
  }

  readXpsr() {
    return this.readApsr() | (1 << 24) | this.IPSR;
  }

  readApsr() {
    const n = this.signOf < 0 ? 8 : 0;
    const z = this.zeroOf === 0 ? 4 : 0;
    return ((n | z | (this.carry << 1) | this.overflow) << 28) | 0;
  }

  writeApsr(value) {
    this.signOf = value & 0x8000_0000;
    this.zeroOf = value & 0x4000_0000 ? 0 : 1;
    this.carry = (value >>> 29) & 1;
    this.overflow = (value >>> 28) & 1;
  }

  #mostUrgent() {
    if (this.pendingNMI) return { exception: EXCEPTION.nmi, priority: -2 };
    let best = { exception: 0, priority: THREAD_PRIORITY };
    const consider = (exception) => {
      const priority = this.priorityOf(exception);
      if (priority < best.priority) best = { exception, priority };
    };
    if (this.pendingSVCall) consider(EXCEPTION.svCall);
    if (this.pendingPendSV) consider(EXCEPTION.pendSv);
    if (this.pendingSystick) consider(EXCEPTION.sysTick);
    const ready = this.pendingInterrupts & this.enabledInterrupts;
    for (let rest = ready; rest; rest &= rest - 1) {
      consider(EXCEPTION.irq0 + 31 - Math.clz32(rest & -rest));
    }
    return best;
  }

  #acknowledge(exception) {
    if (exception >= EXCEPTION.irq0) {
      const bit = 1 << (exception - EXCEPTION.irq0);
      this.pendingInterrupts &= ~bit;
      this.#active |= bit;
    } else if (exception === EXCEPTION.nmi) this.pendingNMI = false;
    else if (exception === EXCEPTION.svCall) this.pendingSVCall = false;
    else if (exception === EXCEPTION.pendSv) this.pendingPendSV = false;
    else this.pendingSystick = false;
  }
}
