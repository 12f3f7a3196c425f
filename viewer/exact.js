// SPDX-License-Identifier: GPL-3.0-or-later
//
// Certificate polynomials, exactly. A binary64 number is a whole number times a power of two, so a
// polynomial is an array of BigInt coefficients times one power of two: {coefficients, exponent}.
// The variable is s = t - origin. Formulas: docs/MATH.md, section 2.
'use strict';

/** x = mantissa * 2^exponent. */
function dyadic(x) {
  if (x === 0) return {mantissa: 0n, exponent: 0};
  DOUBLE_VALUE[0] = x;
  const bits = BigInt.asUintN(64, DOUBLE_BITS[0]);
  const biased = Number((bits >> 52n) & 0x7ffn);
  let mantissa = bits & 0xfffffffffffffn;
  if (biased !== 0) mantissa |= 0x10000000000000n;
  return {mantissa: x < 0 ? -mantissa : mantissa, exponent: Math.max(biased, 1) - 1075};
}

function constant(x) {
  const {mantissa, exponent} = dyadic(x);
  return {coefficients: [mantissa], exponent};
}

function add(p, q) {
  if (p.exponent > q.exponent) return add(q, p);
  const shift = BigInt(q.exponent - p.exponent);
  const coefficients = p.coefficients.slice();
  q.coefficients.forEach((c, k) => {
    coefficients[k] = (coefficients[k] ?? 0n) + (c << shift);
  });
  return {coefficients, exponent: p.exponent};
}

function negate(p) {
  return {coefficients: p.coefficients.map((c) => -c), exponent: p.exponent};
}

function subtract(p, q) {
  return add(p, negate(q));
}

function multiply(p, q) {
  const coefficients = new Array(p.coefficients.length + q.coefficients.length - 1).fill(0n);
  p.coefficients.forEach((a, i) => q.coefficients.forEach((b, j) => {
    coefficients[i + j] += a * b;
  }));
  return {coefficients, exponent: p.exponent + q.exponent};
}

/** The coordinate of a motion, times 6, as a polynomial in s; in a periodic box of an image of it, {motion,
 * offset}. */
function coordinatePolynomial(recording, motion, coordinate, origin) {
  if (typeof motion === 'object') {
    return motion.offset.reduce((sum, number, vector) => add(sum, boxPolynomial(recording, vector, coordinate, number, origin)),
                                coordinatePolynomial(recording, motion.motion, coordinate, origin));
  }
  const {motionData: data, stride, degree} = recording;
  const at = (k) => constant(data[stride * motion + 1 + 2 * k + coordinate]);
  const times = (factor, p) => multiply({coefficients: [factor], exponent: 0}, p);
  const epoch = constant(data[stride * motion]);
  const elapsed = add(subtract(constant(origin), epoch), {coefficients: [0n, 1n], exponent: 0});
  let value = degree === 3 ? at(3) : constant(0);
  if (degree >= 2) value = add(multiply(value, elapsed), times(3n, at(2)));
  value = add(multiply(value, elapsed), times(6n, at(1)));
  return add(multiply(value, elapsed), times(6n, at(0)));
}

/** The coordinate of a vector of the periodic box, times 6 and a whole number, as a polynomial in s. */
function boxPolynomial({periodic}, vector, coordinate, number, origin) {
  const at = (k) => constant(periodic.numbers[5 * vector + k]);
  const elapsed = add(subtract(constant(origin), at(0)), {coefficients: [0n, 1n], exponent: 0});
  const value = add(at(1 + coordinate), multiply(at(3 + coordinate), elapsed));
  return multiply({coefficients: [6n * BigInt(number)], exponent: 0}, value);
}

/** The weight of a motion, or of an image, times 6^2: its radius squared, and what it has beside that. */
function weightPolynomial({motionData: data, stride, motionSizes: sizes}, of, origin) {
  const motion = typeof of === 'object' ? of.motion : of;
  const [radius, growth, weight] = sizes.subarray(3 * motion, 3 * motion + 3);
  const elapsed = add(subtract(constant(origin), constant(data[stride * motion])),
                      {coefficients: [0n, 1n], exponent: 0});
  const disc = add(constant(radius), multiply(constant(growth), elapsed));
  return multiply({coefficients: [36n], exponent: 0}, add(multiply(disc, disc), constant(weight)));
}

/** The differences of two motions in x and y, times 6. */
function differences(recording, motion, other, origin) {
  return [0, 1].map((coordinate) =>
    subtract(coordinatePolynomial(recording, motion, coordinate, origin),
             coordinatePolynomial(recording, other, coordinate, origin)));
}

function cross([ax, ay], [bx, by]) {
  return subtract(multiply(ax, by), multiply(ay, bx));
}

function squaredLength([x, y]) {
  return add(multiply(x, x), multiply(y, y));
}

/** Positive where the motions make a left turn, times 6^2. */
function orientationPolynomial(recording, [a, b, c], origin) {
  return cross(differences(recording, b, a, origin), differences(recording, c, a, origin));
}

/** Minus the in-circle determinant of four motions, times 6^4; that of the circle of equal power to
 * three of them where they have weights. Where it vanishes at all times, x y, x^2 or y^2 is in the
 * place of x^2 + y^2 less the weight, the first with which it does not: docs/MATH.md, section 4. The
 * member `lifting` counts from 0 on which one it is. */
function delaunayPolynomial(recording, [a, b, c, d], origin) {
  const [p, q, r] = [a, b, c].map((motion) => differences(recording, motion, d, origin));
  const liftings = [
    (difference, motion) => {
      if (recording.motionSizes === null) return squaredLength(difference);
      const [weight, other] = [motion, d].map((m) => weightPolynomial(recording, m, origin));
      return subtract(squaredLength(difference), subtract(weight, other));
    },
    ([x, y]) => multiply(x, y),
    ([x]) => multiply(x, x),
    (difference) => multiply(difference[1], difference[1]),
  ];
  const determinant = (lifted) => negate(
    add(add(multiply(lifted(p, a), cross(q, r)), multiply(lifted(q, b), cross(r, p))),
        multiply(lifted(r, c), cross(p, q))));
  const isZero = ({coefficients}) => coefficients.every((c) => c === 0n);
  const all = liftings.map(determinant);
  const lifting = Math.max(0, all.findIndex((polynomial) => !isZero(polynomial)));
  return {...all[lifting], lifting};
}

/** The sign of the polynomial at the binary64 time: -1, 0 or 1. Exact. */
function signAt(polynomial, time, origin) {
  const s = subtract(constant(time), constant(origin));
  let value = constant(0);
  for (let k = polynomial.coefficients.length - 1; k >= 0; --k) {
    value = add(multiply(value, s), {coefficients: [polynomial.coefficients[k]], exponent: 0});
  }
  const [v] = value.coefficients;
  return v > 0n ? 1 : v < 0n ? -1 : 0;
}

/** The binary64 number nearest to value * 2^exponent / divisor. */
function roundedQuotient(value, exponent, divisor) {
  if (value === 0n) return 0;
  const magnitude = value < 0n ? -value : value;
  const length = (n) => n.toString(2).length;
  // A quotient of 64 bits or more, its last one set if anything is left: it rounds as the exact one.
  const shift = Math.max(0, 66 + length(divisor) - length(magnitude));
  let quotient = (magnitude << BigInt(shift)) / divisor;
  if (quotient * divisor !== magnitude << BigInt(shift)) quotient |= 1n;
  let scale = exponent - shift;
  const excess = length(quotient) - 66;
  if (excess > 0) {
    const kept = quotient >> BigInt(excess);
    quotient = kept << BigInt(excess) === quotient ? kept : kept | 1n;
    scale += excess;
  }
  const rounded = Number(quotient);
  const result = rounded * 2 ** Math.trunc(scale / 2) * 2 ** (scale - Math.trunc(scale / 2));
  return value < 0n ? -result : result;
}

/** The coefficients in s, rounded to binary64; that of the highest power is not zero. */
function roundedCoefficients(polynomial, divisor) {
  const rounded = polynomial.coefficients.map((c) =>
    roundedQuotient(c, polynomial.exponent, divisor));
  let count = polynomial.coefficients.length;
  while (count > 0 && polynomial.coefficients[count - 1] === 0n) --count;
  return rounded.slice(0, count);
}

function evaluate(coefficients, s) {
  let value = 0;
  for (let k = coefficients.length - 1; k >= 0; --k) value = value * s + coefficients[k];
  return value;
}
