// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unpacks the module, which pack.py has packed: LZMA, since the module repeats itself at distances that the
// decompression of browsers does not see.

/** The bytes of a text that has two characters for each 13 bits, the lowest first. */
function bytesOfText(text) {
  const digits = new Uint8Array(128);
  let count = 0;
  for (let code = 33; code < 127; ++code) if (!'<"\\'.includes(String.fromCharCode(code))) digits[code] = count++;
  const bytes = new Uint8Array(text.length / 2 * 13 >> 3);
  let bits = 0, size = 0;
  for (let i = 0, at = 0; i + 1 < text.length; i += 2) {
    bits |= (digits[text.charCodeAt(i)] + count * digits[text.charCodeAt(i + 1)]) << size;
    for (size += 13; size >= 8; size -= 8) {
      bytes[at++] = bits;
      bits >>>= 8;
    }
  }
  return bytes;
}

const EVEN = 1024, CERTAIN = 2048;  // chances
const SMALLEST_RANGE = 1 << 24;

/** `count` chances that a bit is 0, of CERTAIN; each follows the bits that are read with it. */
function evenChances(count) {
  return new Uint16Array(count).fill(EVEN);
}

/** Reads bits, and numbers of them, of a range coder. */
class BitReader {
  constructor(bytes) {
    this.bytes = bytes;
    this.next = 5;  // after a byte that is 0, and those of `code`
    // Numbers of 32 bits, which are fast in a typed array.
    this.state = Uint32Array.of(0xffffffff, new DataView(bytes.buffer, bytes.byteOffset).getUint32(1));
  }

  bit(chances, i) {
    const {state} = this, chance = chances[i], bound = (state[0] >>> 11) * chance;
    const isOne = state[1] >= bound;
    if (isOne) {
      state[0] -= bound;
      state[1] -= bound;
      chances[i] = chance - (chance >> 5);
    } else {
      state[0] = bound;
      chances[i] = chance + ((CERTAIN - chance) >> 5);
    }
    if (state[0] < SMALLEST_RANGE) this.refill();
    return isOne ? 1 : 0;
  }

  refill() {
    this.state[0] <<= 8;
    this.state[1] = this.state[1] << 8 | this.bytes[this.next++];
  }

  /** A number whose bits are all as likely as not. */
  evenNumber(bits) {
    const {state} = this;
    let value = 0;
    for (let i = 0; i < bits; ++i) {
      state[0] >>>= 1;
      const bit = state[1] >= state[0] ? 1 : 0;
      if (bit === 1) state[1] -= state[0];
      value = 2 * value + bit;
      if (state[0] < SMALLEST_RANGE) this.refill();
    }
    return value;
  }

  /** A number, the highest bit first. */
  number(chances, from, bits) {
    let node = 1;
    for (let i = 0; i < bits; ++i) node = 2 * node + this.bit(chances, from + node);
    return node - (1 << bits);
  }

  /** A number, the lowest bit first. */
  reversedNumber(chances, from, bits) {
    let node = 1, value = 0;
    for (let i = 0; i < bits; ++i) {
      const bit = this.bit(chances, from + node);
      node = 2 * node + bit;
      value |= bit << i;
    }
    return value;
  }

  /** The length of a copy. */
  length(chances) {
    if (this.bit(chances, 0) === 0) return 2 + this.number(chances, 2, 3);
    if (this.bit(chances, 1) === 0) return 10 + this.number(chances, 10, 3);
    return 18 + this.number(chances, 18, 8);
  }
}

/** What LZMA has compressed to `bytes`: literals, and copies of what has been before. */
function decompressed(bytes, size) {
  const reader = new BitReader(bytes), output = new Uint8Array(size);
  // By the state, which tells the kinds of the last few items.
  const isCopy = evenChances(12), isAgain = evenChances(12), isNotLast = evenChances(12);
  const isLong = evenChances(12), isThird = evenChances(12), isFourth = evenChances(12);
  const literals = evenChances(8 * 768), lengths = evenChances(274), lengthsAgain = evenChances(274);
  const slots = evenChances(4 * 64), middle = evenChances(128), lowest = evenChances(16);

  /** A byte. After a copy, `likely` is what would have been copied next, which it is not; else -1. */
  const literal = (before, likely) => {
    const from = 768 * (before >> 5);
    let node = 1;
    for (let bit = 0, expected = 0; likely >= 0 && node < 256 && bit === expected; likely <<= 1) {
      expected = likely >> 7 & 1;
      bit = reader.bit(literals, from + 256 + 256 * expected + node);
      node = 2 * node + bit;
    }
    while (node < 256) node = 2 * node + reader.bit(literals, from + node);
    return node;
  };

  const distance = (length) => {
    const slot = reader.number(slots, 64 * Math.min(length - 2, 3), 6);
    if (slot < 4) return slot + 1;
    const bits = (slot >> 1) - 1, least = (2 + (slot & 1)) * 2 ** bits + 1;
    if (slot < 14) return least + reader.reversedNumber(middle, least - 1 - slot, bits);
    return least + 16 * reader.evenNumber(bits - 4) + reader.reversedNumber(lowest, 0, 4);
  };

  let first = 1, second = 1, third = 1, fourth = 1;  // the last distances, the last one first
  let state = 0;
  for (let at = 0; at < size;) {
    if (reader.bit(isCopy, state) === 0) {
      output[at] = literal(at === 0 ? 0 : output[at - 1], state < 7 ? -1 : output[at - first]);
      ++at;
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    let length = 1;
    if (reader.bit(isAgain, state) === 0) {
      length = reader.length(lengths);
      [first, second, third, fourth] = [distance(length), first, second, third];
      state = state < 7 ? 7 : 10;
    } else {
      let isByte = false;
      if (reader.bit(isNotLast, state) === 0) {
        isByte = reader.bit(isLong, state) === 0;
      } else if (reader.bit(isThird, state) === 0) {
        [first, second] = [second, first];
      } else if (reader.bit(isFourth, state) === 0) {
        [first, second, third] = [third, first, second];
      } else {
        [first, second, third, fourth] = [fourth, first, second, third];
      }
      if (!isByte) length = reader.length(lengthsAgain);
      state = isByte ? (state < 7 ? 9 : 11) : (state < 7 ? 8 : 11);
    }
    for (const end = at + length; at < end; ++at) output[at] = output[at - first];
  }
  return output;
}

/** The bytes of the module: four for its size, and what is compressed. */
function unpacked(text) {
  const bytes = bytesOfText(text.trim());
  return decompressed(bytes.subarray(4), new DataView(bytes.buffer).getUint32(0));
}
