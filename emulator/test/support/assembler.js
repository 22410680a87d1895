/** Just enough of a Thumb assembler to write test programs of a few instructions. */

export class Assembler {
  #halfwords = [];
  #labels = new Map();
  #branches = [];
  #literals = [];

  label(name) {
    this.#labels.set(name, this.#halfwords.length);
    return this;
  }

  /** Raw halfwords. */
  emit(...halfwords) {
    this.#halfwords.push(...halfwords);
    return this;
  }

  movs(rd, imm8) {
    return this.emit(0x2000 | (rd << 8) | imm8);
  }

  /** Any 32-bit constant, by way of a literal pool behind the program. */
  load(rd, value) {
    this.#literals.push({ at: this.#halfwords.length, rd, value });
    return this.emit(0);
  }

  adds(rd, imm8) {
    return this.emit(0x3000 | (rd << 8) | imm8);
  }

  subs(rd, imm8) {
    return this.emit(0x3800 | (rd << 8) | imm8);
  }

  cmp(rn, imm8) {
    return this.emit(0x2800 | (rn << 8) | imm8);
  }

  ldr(rt, rn, offset = 0) {
    return this.emit(0x6800 | (offset << 4) | (rn << 3) | rt);
  }

  str(rt, rn, offset = 0) {
    return this.emit(0x6000 | (offset << 4) | (rn << 3) | rt);
  }

  blx(rm) {
    return this.emit(0x4780 | (rm << 3));
  }

  wfi() {
    return this.emit(0xbf30);
  }

  wfe() {
    return this.emit(0xbf20);
  }

  sev() {
    return this.emit(0xbf40);
  }

  b(label) {
    return this.#branch(0xe000, 11, label);
  }

  beq(label) {
    return this.#branch(0xd000, 8, label);
  }

  bne(label) {
    return this.#branch(0xd100, 8, label);
  }

  /** Stores a constant at an address; uses R6 and R7. */
  put(address, value) {
    return this.load(7, address).load(6, value).str(6, 7);
  }

  /** @returns {Uint8Array} the program and its literals; it must run at an address that is a multiple of 4 */
  bytes() {
    const halfwords = [...this.#halfwords];
    for (const { at, opcode, bits, label } of this.#branches) {
      if (!this.#labels.has(label)) throw new Error(`no label ${label}`);
      const offset = this.#labels.get(label) - at - 2;
      halfwords[at] = opcode | (offset & ((1 << bits) - 1));
    }
    if (halfwords.length % 2) halfwords.push(0xbf00);
    for (const { at, rd, value } of this.#literals) {
      const words = (halfwords.length - ((at + 2) & ~1)) / 2;
      halfwords[at] = 0x4800 | (rd << 8) | words;
      halfwords.push(value & 0xffff, value >>> 16);
    }
    return new Uint8Array(Uint16Array.from(halfwords).buffer);
  }

  #branch(opcode, bits, label) {
    this.#branches.push({ at: this.#halfwords.length, opcode, bits, label });
    return this.emit(0);
  }
}
