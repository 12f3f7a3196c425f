// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sturm sequences, exactly: terms are arrays of BigInt coefficients by ascending power, each a
// positive multiple of the term of the sequence f, f', -rem(f, f'), ... (docs/MATH.md, section 3).
'use strict';

/** The coefficients without zeros at the end. */
function withoutLeadingZeros(coefficients) {
  let count = coefficients.length;
  while (count > 0 && coefficients[count - 1] === 0n) --count;
  return coefficients.slice(0, count);
}

/** a |l|^(n + 1) = quotient b + remainder, where l is the leading coefficient of b and n the difference
 * of the degrees, which is not negative. */
function positivePseudoDivision(a, b) {
  const lead = b[b.length - 1];
  const factor = lead < 0n ? -lead : lead;
  const remainder = a.slice(), quotient = [];
  for (let n = a.length - b.length; n >= 0; --n) {
    const top = remainder.pop();
    const share = lead < 0n ? -top : top;
    for (let k = 0; k < remainder.length; ++k) remainder[k] *= factor;
    for (let k = 0; k < quotient.length; ++k) quotient[k] *= factor;
    for (let k = 0; k + 1 < b.length; ++k) remainder[n + k] -= share * b[k];
    quotient.unshift(share);
  }
  return {quotient, remainder: withoutLeadingZeros(remainder)};
}

/** The coefficients without the power of two that all of them have. */
function withoutPowerOfTwo(coefficients) {
  const all = coefficients.reduce((bits, c) => bits | (c < 0n ? -c : c), 0n);
  const shift = BigInt((all & -all).toString(2).length - 1);
  return coefficients.map((c) => c >> shift);
}

class SturmSequence {
  /** Of a polynomial of exact.js that is not zero. Remainders grow little, since each is divided by
   * what is known to divide it: the subresultants of W. S. Brown and J. F. Traub, 1971. */
  constructor({coefficients}) {
    const f = withoutPowerOfTwo(withoutLeadingZeros(coefficients));
    const slope = f.slice(1).map((c, k) => c * BigInt(k + 1));
    this.terms = slope.length > 0 ? [f, slope] : [f];
    let lead = 1n, height = 1n;
    while (this.terms[this.terms.length - 1].length > 1) {
      const [a, b] = this.terms.slice(-2);
      const drop = BigInt(a.length - b.length);
      const {remainder} = positivePseudoDivision(a, b);
      if (remainder.length === 0) break;
      const divisor = lead * height ** drop;
      this.terms.push(remainder.map((c) => -c / divisor));
      const top = b[b.length - 1];
      lead = top < 0n ? -top : top;
      height = lead ** drop / height ** (drop - 1n);
    }
    const last = this.terms[this.terms.length - 1];
    // At a multiple root all terms are zero: without their common divisor they are counted.
    this.counted = last.length === 1 ? this.terms :
      this.terms.map((term) => positivePseudoDivision(term, last).quotient);
  }

  /** Whether the polynomial has multiple roots, real or not. */
  get hasMultipleRoots() {
    return this.terms[this.terms.length - 1].length > 1;
  }

  /** The sign of each term at the binary64 time, or, at Infinity, after all roots. */
  signsAt(time, origin) {
    return signsOf(this.terms, time, origin);
  }

  /** V, the number of sign changes there. That before, less that after, is the number of roots after the
   * one time up to and with the other one. */
  changesAt(time, origin) {
    const signs = signsOf(this.counted, time, origin).filter((sign) => sign !== 0);
    return signs.filter((sign, k) => k > 0 && sign !== signs[k - 1]).length;
  }
}

function signsOf(terms, time, origin) {
  if (time === Infinity) return terms.map((term) => term[term.length - 1] > 0n ? 1 : -1);
  return terms.map((coefficients) => signAt({coefficients, exponent: 0}, time, origin));
}

/** How often the time is a root of the polynomial, which is not zero. */
function multiplicityAt({coefficients}, time, origin) {
  let rest = withoutLeadingZeros(coefficients), multiplicity = 0;
  while (signAt({coefficients: rest, exponent: 0}, time, origin) === 0) {
    rest = rest.slice(1).map((c, k) => c * BigInt(k + 1));
    ++multiplicity;
  }
  return multiplicity;
}
