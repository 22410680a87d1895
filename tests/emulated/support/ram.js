// The memory of an image that nothing should touch but the stack, and how deep the stack has been.

/** Neither code nor data looks like this. */
const PAINT = 0x5afe57ac;

export class RamWatch {
  #pico;
  #floor;
  #top;
  /** The deepest that the stack has been, in bytes, at each look. */
  depths = [];

  /** Paints the memory behind the variables of a board that has power and has executed nothing. */
  constructor(pico) {
    this.#pico = pico;
    this.#floor = pico.symbol('_stack_end').address;
    this.#top = pico.symbol('_stack_start').address;
    for (let address = this.#floor; address < this.#top; address += 4) pico.write32(address, PAINT);
  }

  /** Looks how far the paint is whole: nothing was written there since. */
  look() {
    let address = this.#floor;
    while (address < this.#top && this.#pico.read32(address) === PAINT) address += 4;
    this.depths.push(this.#top - address);
  }
}
