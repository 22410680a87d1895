/**
 * The conditions of branches, EQ to LE (ARMv6-M Architecture Reference Manual, table A6-1). They come
 * in pairs of which the odd one is the opposite.
 * @param {number} condition 0 to 13
 * @param {number} signOf N is set if this is negative
 * @param {number} zeroOf Z is set if this is 0
 * @param {number} carry
 * @param {number} overflow
 */
export function holds(condition, signOf, zeroOf, carry, overflow) {
  let result;
  switch (condition >>> 1) {
    case 0: // EQ
      result = zeroOf === 0;
      break;
    case 1: // CS
      result = carry !== 0;
      break;
    case 2: // MI
      result = signOf < 0;
      break;
    case 3: // VS
      result = overflow !== 0;
      break;
    case 4: // HI
      result = carry !== 0 && zeroOf !== 0;
      break;
    case 5: // GE
      result = signOf < 0 === (overflow !== 0);
      break;
    default: // GT
      result = zeroOf !== 0 && signOf < 0 === (overflow !== 0);
  }
  return condition & 1 ? !result : result;
}
