// Who calls whom in an image: read from its instructions, as they will be executed.
//
// An edge is a branch to the start of another function, or the address of one that a function takes from its literals,
// directly or in a table (of a trait object, of a waker). Pointers that travel through RAM are not followed: what
// calls through a pointer is listed for the reader to judge.

/** A table of pointers has no length in the image. That of a waker has four words, that of a trait object at least. */
const TABLE_WORDS = 4;

/** What the standard library and defmt call when something must not go on, and nothing else is named so. */
export const PANICS =
  /panicking|panic_(?:fmt|const|already|nounwind|bounds|display|str)|unwrap_failed|expect_failed|slice_index_fail|len_mismatch_fail|begin_unwind|_defmt_panic|defmt.*unreachable|handle_alloc_error/;

export class Calls {
  #memory;
  #functions = new Map();
  #starts;

  /** @param {import('../../../emulator/src/elf.js').Elf} elf the image */
  constructor(elf) {
    this.#memory = new Memory(elf.segments, elf.symbols);
    for (const [name, { address, size }] of elf.symbols) {
      // Code is Thumb, so its addresses are odd; defmt keeps its strings as symbols with JSON for names.
      const start = address - 1;
      if (address % 2 === 0 || size < 2 || name.startsWith('{') || !this.#memory.holds(start, size)) continue;
      const known = this.#functions.get(start);
      this.#functions.set(start, { start, end: Math.max(start + size, known?.end ?? 0), name: plain(name) });
    }
    this.#starts = [...this.#functions.keys()].sort((a, b) => a - b);
  }

  /** The functions whose names match, by name. */
  named(pattern) {
    return [...this.#functions.values()].filter(({ name }) => pattern.test(name));
  }

  /** Which functions `of` calls or takes the address of, and whether it calls through a pointer. */
  from(of) {
    of.edges ??= this.#read(of);
    return of.edges;
  }

  /**
   * Everything that can be executed from these functions on. Panicking functions are not entered, and not those of
   * `except`.
   *
   * @returns {{functions: Set<string>, panics: string[], pointers: string[]}} names; who calls which panicking
   *   function; who calls through pointers
   */
  reach(roots, except = []) {
    const functions = new Set();
    const panics = new Set();
    const pointers = new Set();
    const open = [...roots];
    const seen = new Set([...open, ...except]);
    for (let of = open.pop(); of; of = open.pop()) {
      functions.add(of.name);
      const { to, indirect } = this.from(of);
      if (indirect) pointers.add(of.name);
      for (const next of to) {
        if (PANICS.test(next.name)) panics.add(`${of.name} -> ${next.name}`);
        else if (!seen.has(next)) {
          seen.add(next);
          open.push(next);
        }
      }
    }
    return { functions, panics: [...panics].sort(), pointers: [...pointers].sort() };
  }

  #read({ start, end, name }) {
    const to = new Set();
    let indirect = false;
    const literals = new Set();
    const take = (address) => {
      const taken = address % 2 === 1 && this.#functions.get(address - 1);
      if (taken) to.add(taken);
      return taken;
    };
    for (let at = start; at < end; at += 2) {
      if (literals.has(at & ~3)) continue;
      const half = this.#memory.half(at);
      let target;
      if (half >> 11 === 0b01001) {
        const literal = ((at + 4) & ~3) + (half & 0xff) * 4;
        literals.add(literal);
        const value = this.#memory.word(literal);
        if (value !== undefined && !take(value) && value % 4 === 0) {
          for (let i = 0; i < TABLE_WORDS; i++) take(this.#memory.word(value + i * 4) ?? 0);
        }
      } else if (half >> 11 === 0b11110 && (this.#memory.half(at + 2) & 0xd000) === 0xd000) {
        target = long(at, half, this.#memory.half(at + 2));
        at += 2;
        // Within a long function it is a jump.
        if ((target < start || target >= end) && !this.#functions.has(target)) {
          throw new Error(`${name} calls ${target.toString(16)}, which is no function`);
        }
      } else if (half >> 11 === 0b11100) {
        target = at + 4 + ((((half & 0x7ff) << 21) >> 21) * 2);
      } else if (half >> 12 === 0b1101 && ((half >> 8) & 15) < 14) {
        target = at + 4 + (((half & 0xff) << 24) >> 24) * 2;
      } else if ((half & 0xff87) === 0x4780 || ((half & 0xff87) === 0x4700 && half !== 0x4770)) {
        indirect = true;
      }
      if (target !== undefined && (target < start || target >= end)) {
        const into = this.#functions.get(target) ?? this.#around(target);
        if (into) to.add(into);
      }
    }
    return { to, indirect };
  }

  /** The function that an address lies in. */
  #around(address) {
    const start = this.#starts.findLast((start) => start <= address);
    const of = this.#functions.get(start);
    return of && address < of.end ? of : undefined;
  }
}

/** The image by the addresses at which it runs. */
class Memory {
  #segments;

  constructor(segments, symbols) {
    this.#segments = segments.map(({ address, bytes }) => ({ address, view: new DataView(bytes.buffer, bytes.byteOffset, bytes.length) }));
    // What is copied to RAM at start-up, code that programs the flash among it.
    const at = (name) => symbols.get(name)?.address;
    this.#alias(at('__sdata'), at('__edata'), at('__sidata'));
  }

  half(address) {
    return this.#at(address, 2, (view, offset) => view.getUint16(offset, true)) ?? 0;
  }

  word(address) {
    return this.#at(address, 4, (view, offset) => view.getUint32(offset, true));
  }

  /** Whether all these bytes are in the image, which what is zeroed at start-up is not. */
  holds(address, size) {
    return this.#at(address, size, () => true) ?? false;
  }

  #at(address, size, read) {
    const segment = this.#segments.find(({ address: start, view }) => address >= start && address + size <= start + view.byteLength);
    return segment && read(segment.view, address - segment.address);
  }

  #alias(start, end, load) {
    if (start === undefined || load === undefined || end <= start) return;
    const segment = this.#segments.find(({ address, view }) => load >= address && load < address + view.byteLength);
    if (!segment) return;
    const { view } = segment;
    const length = Math.min(end - start, view.byteLength - (load - segment.address));
    this.#segments.push({ address: start, view: new DataView(view.buffer, view.byteOffset + load - segment.address, length) });
  }
}

/** Where a `bl` goes. */
function long(at, first, second) {
  const sign = (first >> 10) & 1;
  const i1 = 1 - (((second >> 13) & 1) ^ sign);
  const i2 = 1 - (((second >> 11) & 1) ^ sign);
  const offset = (-sign << 24) | (i1 << 23) | (i2 << 22) | ((first & 0x3ff) << 12) | ((second & 0x7ff) << 1);
  return at + 4 + offset;
}

/** A Rust name without its hashes, readable enough: `core::panicking::panic`. */
function plain(name) {
  if (name.startsWith('_R')) return identifiers(name.replace(/Cs[0-9A-Za-z]+_(?=[0-9])/g, '')).join('::');
  if (!name.startsWith('_ZN')) return name;
  const parts = identifiers(name).filter((part) => !/^h[0-9a-f]{16}$/.test(part));
  return parts
    .map((part) => part.replace(/^_(?=\$)/, '').replace(/\$(\w+?)\$/g, (all, code) => SIGNS[code] ?? all))
    .join('::')
    .replaceAll('..', '::');
}

const SIGNS = { LT: '<', GT: '>', RF: '&', C: ',', u20: ' ', u7b: '{', u7d: '}', LP: '(', RP: ')' };

/** What a mangled name consists of: each identifier follows its length. */
function identifiers(name) {
  const found = [];
  const length = /[0-9]+/g;
  for (let match; (match = length.exec(name)); ) {
    const from = length.lastIndex;
    length.lastIndex = from + Number(match[0]);
    found.push(name.slice(from, length.lastIndex));
  }
  return found;
}
