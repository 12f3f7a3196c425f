// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checks of failure certificates, with Sturm sequences and roots of the general kind.
#ifndef KINETRI_TEST_SUPPORT_FAILURE_PROOFS_H
#define KINETRI_TEST_SUPPORT_FAILURE_PROOFS_H

#include <gtest/gtest.h>

#include <array>
#include <cstddef>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/algebra/failure_certificate.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/algebra/sturm_sequence.h"

namespace kinetri::test {

/// Expects that the proof is right, for a polynomial that must not be negative from `since` on, and
/// fails at `time`.
inline void expect_proof(const Failure_certificate& proof, const Polynomial& polynomial,
                         const Algebraic_number& since, const Algebraic_number& time) {
  const Polynomial& p = proof.polynomial;
  ASSERT_EQ(p, primitive_part(polynomial));
  const std::array<Rational, 3> places = {proof.from, proof.lower, proof.upper};
  const auto& [from, lower, upper] = places;
  const Sturm_sequence sequence(p);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(proof.signs[i].size(), sequence.terms().size());
    for (std::size_t k = 0; k < sequence.terms().size(); ++k) {
      EXPECT_EQ(proof.signs[i][k], sequence.terms()[k].sign_at(places[i]))
          << p << " at " << places[i];
    }
  }
  EXPECT_EQ(sign_at(p, time), CGAL::ZERO);
  EXPECT_EQ(sign_just_after(p, time), CGAL::NEGATIVE);
  ASSERT_LE(from, lower);
  EXPECT_NE(compare(since, from), CGAL::LARGER);
  const bool is_at_once = time == since;
  EXPECT_EQ(compare(time, lower) == CGAL::EQUAL, lower == upper);
  EXPECT_NE(compare(time, upper), CGAL::LARGER);
  if (lower == upper) {
    EXPECT_EQ(p.sign_at(lower), CGAL::ZERO);
  } else {
    EXPECT_EQ(sequence.count(Interval_end{lower, false}, Interval_end{upper, true}), 1);
  }
  std::size_t touches = 0;
  for (const Real_root& root : real_roots(p)) {
    if (root.value == time) {
      EXPECT_EQ(root.multiplicity, proof.multiplicity);
      EXPECT_TRUE(is_at_once || root.multiplicity % 2 == 1);
    } else if (root.value > since && root.value < time) {
      EXPECT_EQ(root.multiplicity % 2, 0) << "a failure before " << time;
      EXPECT_EQ(compare(root.value, from), CGAL::LARGER);
      ASSERT_LT(touches, proof.touches.size());
      const Rational_interval& around = proof.touches[touches++];
      EXPECT_NE(compare(root.value, around.upper), CGAL::LARGER);
      EXPECT_NE(compare(root.value, around.lower), CGAL::SMALLER);
    }
  }
  EXPECT_EQ(touches, proof.touches.size());
  if (!is_at_once) {
    EXPECT_EQ(p.sign_at(from), CGAL::POSITIVE);
  }
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_FAILURE_PROOFS_H
