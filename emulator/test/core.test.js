import assert from 'node:assert/strict';
import { test } from 'node:test';
import { RP2040 } from 'rp2040js';
import { Clock } from '../src/clock.js';
import { Core, EXCEPTION, SLEEP } from '../src/core.js';
import { Fault } from '../src/fault.js';
import { SRAM_BASE, SRAM_SIZE } from '../src/map.js';
import { Random } from '../src/random.js';

const CODE = 0x2000_0100;
const DATA = 0x2000_1000;
const VECTORS = 0x2000_0800;
const HANDLER = 0x2000_0400;
const PC = 15;
const FLAGS = { n: 8, z: 4, c: 2, v: 1 };

/** A core with nothing but SRAM around it. */
class Bench {
  clock = new Clock();
  sram = new Uint8Array(SRAM_SIZE);
  flash = new Uint8Array(4096);
  watched = new Uint8Array(SRAM_SIZE / 4);
  bootrom = new Uint32Array(4096);
  view = new DataView(this.sram.buffer);
  faults = [];
  core = new Core(this);

  constructor() {
    this.core.registers[13] = 0x2000_3000;
    this.core.registers[PC] = CODE;
    this.core.VTOR = VECTORS;
    for (let n = 0; n < 48; n++) this.put32(VECTORS + 4 * n, (HANDLER + 16 * n) | 1);
  }

  put32(address, value) {
    this.view.setUint32(address - SRAM_BASE, value, true);
  }

  get32(address) {
    return this.view.getUint32(address - SRAM_BASE, true);
  }

  code(...halfwords) {
    halfwords.forEach((half, i) => this.view.setUint16(CODE - SRAM_BASE + 2 * i, half, true));
    return this;
  }

  /** Executes instructions one by one; wakes and interrupts as a board does. */
  step(count = 1) {
    for (let i = 0; i < count; i++) {
      if (this.core.settle()) {
        this.clock.limit = this.clock.slice + 1;
        this.core.run();
      }
    }
    return this;
  }

  onFault(fault) {
    this.faults.push(fault.kind);
    if (!this.core.locked) this.core.hardFault();
  }

  // What the core asks of the chip outside of SRAM.
  fetchSlowly(pc) {
    throw new Fault('instruction fetch', pc);
  }
  readUint32(address) {
    throw new Fault(address & 3 ? 'unaligned read' : 'read of nothing', address);
  }
  writeUint32(address) {
    throw new Fault(address & 3 ? 'unaligned write' : 'write to nothing', address);
  }
}

const flagsOf = (core) => core.readApsr() >>> 28;

/** One instruction on two registers: the result and the flags. */
function compute(opcode, { r0 = 0, r1 = 0, flags = 0 }) {
  const bench = new Bench().code(opcode);
  bench.core.registers[0] = r0;
  bench.core.registers[1] = r1;
  bench.core.writeApsr(flags << 28);
  bench.step();
  return { r0: bench.core.registers[0] >>> 0, flags: flagsOf(bench.core) };
}

/** Data processing on which the core of `rp2040js` can be trusted. */
const TRUSTED = [
  [0x0000, 0x3fff], // shifts by constants, ADDS, SUBS, MOVS, CMP
  [0x4000, 0x407f], // ANDS, EORS
  [0x4200, 0x43ff], // TST, RSBS, CMP, CMN, ORRS, MULS, BICS, MVNS
  [0xa000, 0xafff], // ADR, ADD SP
  [0xb200, 0xb2ff], // extensions
  [0xba00, 0xba7f], // REV, REV16
  [0xd000, 0xddff], // conditional branches
  [0xe000, 0xe7ff], // B
];

test('data processing and branches agree with the core of rp2040js', () => {
  const random = new Random(2026);
  const words = [0, 1, 2, 31, 32, 0x7f, 0xff, 0x7fff_ffff, 0x8000_0000, 0xffff_ffff];
  const word = () => (random.next() & 1 ? random.next() : words[random.next() % words.length]);
  const other = new RP2040();
  other.logger = { debug() {}, info() {}, warn() {}, error() {} };
  const bench = new Bench();
  for (const [first, last] of TRUSTED) {
    for (let opcode = first; opcode <= last; opcode++) {
      const flags = random.next() >>> 28;
      bench.code(opcode).core.registers[PC] = CODE;
      bench.core.writeApsr(flags << 28);
      other.sram.set(bench.sram.subarray(0, 0x200));
      other.core.PC = CODE;
      other.core.APSR = (flags << 28) >>> 0;
      for (let r = 0; r < 14; r++) {
        bench.core.registers[r] = other.core.registers[r] = r === 13 ? 0x2000_3000 : word();
      }
      bench.step();
      other.core.executeInstruction();
      const ours = [...bench.core.registers].map((value) => value >>> 0);
      const message = `opcode 0x${opcode.toString(16)} with flags ${flags}`;
      assert.deepEqual(ours.slice(0, 14), [...other.core.registers].slice(0, 14), message);
      assert.equal(ours[PC], other.core.PC, message);
      assert.equal(flagsOf(bench.core), other.core.APSR >>> 28, message);
    }
  }
});

test('adding and subtracting with carry set the overflow flag by the true sum', () => {
  const { c, v, n } = FLAGS;
  const adcs = 0x4148;
  const sbcs = 0x4188;
  assert.deepEqual(compute(adcs, { r0: 0x7fff_ffff, r1: 0x7fff_ffff, flags: c }), { r0: 0xffff_ffff, flags: n | v });
  assert.deepEqual(compute(adcs, { r0: 5, r1: 0xffff_ffff, flags: c }), { r0: 5, flags: c });
  assert.deepEqual(compute(sbcs, { r0: 0, r1: 0x7fff_ffff, flags: 0 }), { r0: 0x8000_0000, flags: n });
  assert.deepEqual(compute(sbcs, { r0: 0, r1: 0xffff_ffff, flags: 0 }), { r0: 0, flags: FLAGS.z });
});

test('shifting by a register keeps the carry for 0 and knows amounts beyond 31', () => {
  const { c, n, z } = FLAGS;
  const [lsls, lsrs, asrs, rors] = [0x4088, 0x40c8, 0x4108, 0x41c8];
  for (const shift of [lsls, lsrs, asrs, rors]) {
    assert.deepEqual(compute(shift, { r0: 0x8000_0001, r1: 0, flags: c }), { r0: 0x8000_0001, flags: n | c });
    assert.deepEqual(compute(shift, { r0: 0x8000_0001, r1: 0x100, flags: 0 }), { r0: 0x8000_0001, flags: n });
  }
  assert.deepEqual(compute(lsls, { r0: 1, r1: 32 }), { r0: 0, flags: z | c });
  assert.deepEqual(compute(lsls, { r0: 1, r1: 33, flags: c }), { r0: 0, flags: z });
  assert.deepEqual(compute(lsrs, { r0: 0x8000_0000, r1: 32 }), { r0: 0, flags: z | c });
  assert.deepEqual(compute(asrs, { r0: 0x8000_0000, r1: 200 }), { r0: 0xffff_ffff, flags: n | c });
  assert.deepEqual(compute(rors, { r0: 0x8000_0000, r1: 32 }), { r0: 0x8000_0000, flags: n | c });
});

/** One load of R0 from [R1, R2]. */
function load(opcode, stored, offset = 0) {
  const bench = new Bench().code(opcode);
  bench.put32(DATA, stored);
  bench.core.registers[1] = DATA;
  bench.core.registers[2] = offset;
  bench.step();
  assert.equal(bench.clock.slice, 2);
  return bench.core.registers[0];
}

test('loads fetch words, halfwords and bytes, with or without their sign', () => {
  const [ldr, ldrh, ldrb, ldrsb, ldrsh] = [0x5888, 0x5a88, 0x5c88, 0x5688, 0x5e88];
  assert.equal(load(ldr, 0x8001_80ff) >>> 0, 0x8001_80ff);
  assert.equal(load(ldrh, 0x8001_80ff, 2), 0x8001);
  assert.equal(load(ldrsh, 0x8001_80ff, 2), -0x7fff);
  assert.equal(load(ldrb, 0x8001_80ff, 1), 0x80);
  assert.equal(load(ldrsb, 0x8001_80ff, 1), -0x80);
});

test('stores change no more than their width', () => {
  for (const [opcode, left] of [[0x5088, 0x1234_5678], [0x5288, 0xffff_5678], [0x5488, 0xffff_ff78]]) {
    const bench = new Bench().code(opcode); // STR, STRH, STRB r0, [r1, r2]
    bench.put32(DATA, 0xffff_ffff);
    bench.core.registers[0] = 0x1234_5678;
    bench.core.registers[1] = DATA;
    bench.step();
    assert.equal(bench.get32(DATA), left);
  }
});

test('a pushed frame pops again, and costs a cycle for each register', () => {
  const bench = new Bench().code(0xb530, 0xbd30); // PUSH {r4, r5, lr}; POP {r4, r5, pc}
  bench.core.registers[4] = 4;
  bench.core.registers[5] = 5;
  bench.core.registers[14] = CODE | 0x41;
  bench.step();
  assert.equal(bench.clock.slice, 4);
  assert.deepEqual([0, 4, 8].map((i) => bench.get32(0x2000_3000 - 12 + i)), [4, 5, CODE | 0x41]);
  bench.step();
  assert.equal(bench.core.PC, CODE + 0x40);
  assert.equal(bench.clock.slice, 4 + 6);
});

test('a branch to itself passes the time up to the limit, in whole rounds', () => {
  const bench = new Bench().code(0xe7fe);
  bench.clock.limit = 1001;
  bench.core.run();
  assert.equal(bench.clock.slice, 1002);
  assert.equal(bench.core.PC, CODE);
});

test('an interrupt enters its handler and returns to where it was', () => {
  const bench = new Bench().code(0x2001, 0x2002);
  bench.view.setUint16(HANDLER - SRAM_BASE + 16 * 16, 0x4770, true); // BX LR
  bench.core.enabledInterrupts = 1;
  bench.core.writeApsr(0xa000_0000);
  bench.core.setInterrupt(0, true);
  bench.core.setInterrupt(0, false);
  bench.step();
  assert.equal(bench.core.IPSR, 0, 'BX LR has been executed');
  assert.equal(bench.clock.slice, 15 + 2 + 13, 'entry, BX, return');
  assert.equal(bench.core.PC, CODE);
  assert.equal(bench.core.registers[13], 0x2000_3000);
  assert.equal(flagsOf(bench.core), 0xa);
  bench.step(2);
  assert.equal(bench.core.registers[0], 2);
});

test('a line that stays high is served again and again, one that fell is served once', () => {
  const served = (falls) => {
    const bench = new Bench().code(0xe7fe);
    bench.view.setUint16(HANDLER - SRAM_BASE + 16 * 16, 0x3401, true); // ADDS r4, #1
    bench.view.setUint16(HANDLER - SRAM_BASE + 16 * 16 + 2, 0x4770, true); // BX LR
    bench.core.enabledInterrupts = 1;
    bench.core.setInterrupt(0, true);
    if (falls) bench.core.setInterrupt(0, false);
    bench.step(6);
    return bench.core.registers[4];
  };
  assert.equal(served(false), 3);
  assert.equal(served(true), 1);
});

test('of two pending interrupts the more urgent runs, and the other does not preempt it', () => {
  const bench = new Bench().code(0xbf00);
  bench.core.enabledInterrupts = 0b11;
  bench.core.interruptPriorities = [0b10, ~0b11, 0, 0b01];
  bench.view.setUint16(HANDLER - SRAM_BASE + 16 * 17, 0xbf00, true);
  bench.core.setInterrupt(0, true);
  bench.core.setInterrupt(1, true);
  bench.step();
  assert.equal(bench.core.IPSR, EXCEPTION.irq0 + 1);
  bench.step();
  assert.equal(bench.core.IPSR, EXCEPTION.irq0 + 1);
});

test('PRIMASK keeps handlers from running, and WFI wakes nevertheless', () => {
  const bench = new Bench().code(0xb672, 0xbf30, 0x2007); // CPSID i; WFI; MOVS r0, #7
  bench.core.enabledInterrupts = 1;
  bench.step(3);
  assert.equal(bench.core.sleep, SLEEP.interrupt);
  bench.core.setInterrupt(0, true);
  bench.step();
  assert.deepEqual([bench.core.IPSR, bench.core.registers[0]], [0, 7]);
});

test('an event sent before WFE keeps the core awake', () => {
  const bench = new Bench().code(0xbf40, 0xbf20, 0x2007, 0xbf20, 0x2008); // SEV; WFE; MOVS; WFE; MOVS
  bench.step(3);
  assert.equal(bench.core.registers[0], 7);
  bench.step(2);
  assert.equal(bench.core.sleep, SLEEP.event);
  assert.equal(bench.core.registers[0], 7);
});

test('an interrupt wakes the core from WFE and runs', () => {
  const bench = new Bench().code(0xbf20);
  bench.view.setUint16(HANDLER - SRAM_BASE + 16 * 20, 0xbf00, true);
  bench.core.enabledInterrupts = 1 << 4;
  bench.step(2);
  assert.equal(bench.core.sleep, SLEEP.event);
  bench.core.setInterrupt(4, true);
  bench.step();
  assert.equal(bench.core.IPSR, EXCEPTION.irq0 + 4);
});

test('whatever the core cannot do is a HardFault that points to the instruction', () => {
  const cases = [
    [0xde00, 'undefined instruction'],
    [0xbe00, 'breakpoint without a debugger'],
    [0x6808, 'unaligned read'], // LDR r0, [r1] at an odd address
    [0x6810, 'read of nothing'], // LDR r0, [r2]
    [0x6010, 'write to nothing'], // STR r0, [r2]
    [0x4710, 'branch out of Thumb state'], // BX r2
    [0xe800, 'undefined instruction'],
  ];
  for (const [opcode, kind] of cases) {
    const bench = new Bench().code(0xbf00, opcode);
    bench.core.registers[1] = DATA + 1;
    bench.core.registers[2] = 0x3000_0000;
    bench.step(2);
    assert.deepEqual(bench.faults, [kind]);
    assert.equal(bench.core.IPSR, EXCEPTION.hardFault, kind);
    assert.equal(bench.get32(0x2000_3000 - 32 + 24), CODE + 2, kind);
  }
});

test('a fault in the HardFault handler locks the core up', () => {
  const bench = new Bench().code(0xde00);
  bench.view.setUint16(HANDLER - SRAM_BASE + 16 * 3, 0xde01, true);
  bench.step(2);
  assert.equal(bench.core.locked, true);
  assert.equal(bench.faults.length, 2);
});

test('a stack that points nowhere locks the core up', () => {
  const bench = new Bench().code(0xde00);
  bench.core.registers[13] = 0x3000_0000;
  bench.step();
  assert.equal(bench.core.locked, true);
});

test('a supervisor call returns behind itself', () => {
  const bench = new Bench().code(0xdf01, 0x2007);
  bench.view.setUint16(HANDLER - SRAM_BASE + 16 * 11, 0x4770, true);
  bench.step();
  assert.equal(bench.core.IPSR, EXCEPTION.svCall);
  bench.step(2);
  assert.deepEqual([bench.core.IPSR, bench.core.registers[0]], [0, 7]);
});
