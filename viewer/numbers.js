// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers in a recording: decoded from base64, collected in arrays that grow, and given to pairs of
// points.
'use strict';

/** The recording cannot be played; the message says why. */
class RecordingError extends Error {}

function demand(condition, what) {
  if (!condition) throw new RecordingError(what);
}

const IS_LITTLE_ENDIAN = new Uint8Array(Uint16Array.of(1).buffer)[0] === 1;

/** The numbers of type 'Uint8', 'Uint16', 'Uint32', 'Int32' or 'Float64' in the base64 text. */
function decodeNumbers(text, type, what) {
  demand(typeof text === 'string', `${what} is not there`);
  let bytes;
  try {
    bytes = atob(text);
  } catch {
    throw new RecordingError(`${what} is not base64`);
  }
  const size = {Uint8: 1, Uint16: 2, Uint32: 4, Int32: 4, Float64: 8}[type];
  demand(bytes.length % size === 0, `${what} ends within a number`);
  const octets = new Uint8Array(bytes.length);
  for (let i = 0; i < bytes.length; ++i) octets[i] = bytes.charCodeAt(i);
  const Type = {Uint8: Uint8Array, Uint16: Uint16Array, Uint32: Uint32Array, Int32: Int32Array,
                Float64: Float64Array}[type];
  if (IS_LITTLE_ENDIAN) return new Type(octets.buffer);
  const view = new DataView(octets.buffer);
  return Type.from({length: bytes.length / size}, (_, i) => view[`get${type}`](size * i, true));
}

const DOUBLE_BITS = new BigInt64Array(1);
const DOUBLE_VALUE = new Float64Array(DOUBLE_BITS.buffer);

/** The next binary64 number above (direction 1) or below (-1) the finite number x. */
function neighborDouble(x, direction) {
  if (x === 0) return direction * Number.MIN_VALUE;
  DOUBLE_VALUE[0] = x;
  DOUBLE_BITS[0] += (x > 0) === (direction > 0) ? 1n : -1n;
  return DOUBLE_VALUE[0];
}

/** Numbers that are appended, in a typed array that grows. */
class Numbers {
  constructor(Type) {
    this.values = new Type(1024);
    this.length = 0;
  }

  push(value) {
    if (this.length === this.values.length) {
      const values = new this.values.constructor(2 * this.length);
      values.set(this.values);
      this.values = values;
    }
    this.values[this.length++] = value;
  }

  /** The numbers, which are not appended to any more. */
  finish() {
    return this.values.slice(0, this.length);
  }
}

/** Gives numbers to pairs of points, in the order in which the pairs occur; in a periodic box to pairs with
 * an offset. A hash table with open addressing: there are several times as many pairs as points, and the
 * page opens with this. */
class EdgeNumbers {
  constructor(points, isPeriodic = false) {
    this.points = points;
    this.x = isPeriodic ? new Numbers(Int32Array) : null;  // offsets of b against a
    this.y = isPeriodic ? new Numbers(Int32Array) : null;
    this.a = new Numbers(Uint32Array);
    this.b = new Numbers(Uint32Array);
    this.slots = new Int32Array(4096).fill(-1);  // numbers; a power of two, at most half full
  }

  get count() {
    return this.a.length;
  }

  /** The number of the edge from a to the image of b with the offset (x, y). */
  number(a, b, what, x = 0, y = 0) {
    if (a >= this.points || b >= this.points) {
      demand(false, `${what} names the point ${Math.max(a, b)}, but the ids end with ${this.points - 1}`);
    }
    if (a === b && x === 0 && y === 0) demand(false, `${what} has an edge from point ${a} to itself`);
    if (!isForward(a, b, x, y)) return this.number(b, a, what, -x, -y);
    const {slots} = this;
    let slot = this.slotOf(a, b, x, y);
    for (; slots[slot] >= 0; slot = (slot + 1) & (slots.length - 1)) {
      if (this.is(slots[slot], a, b, x, y)) return slots[slot];
    }
    const number = this.count;
    slots[slot] = number;
    this.a.push(a);
    this.b.push(b);
    this.x?.push(x);
    this.y?.push(y);
    if (2 * this.count > slots.length) this.grow();
    return number;
  }

  is(number, a, b, x, y) {
    return this.a.values[number] === a && this.b.values[number] === b &&
      (this.x === null || this.x.values[number] === x && this.y.values[number] === y);
  }

  slotOf(a, b, x, y) {
    const mixed = Math.imul(a, 0x9e3779b1) ^ Math.imul(b, 0x85ebca6b) ^ Math.imul(x, 0xc2b2ae35) ^
      Math.imul(y, 0x27d4eb2f);
    return (mixed ^ (mixed >>> 15)) & (this.slots.length - 1);
  }

  grow() {
    const slots = this.slots = new Int32Array(2 * this.slots.length).fill(-1);
    for (let number = 0; number < this.count; ++number) {
      let slot = this.slotOf(this.a.values[number], this.b.values[number], this.x?.values[number] ?? 0,
                             this.y?.values[number] ?? 0);
      while (slots[slot] >= 0) slot = (slot + 1) & (slots.length - 1);
      slots[slot] = number;
    }
  }
}
