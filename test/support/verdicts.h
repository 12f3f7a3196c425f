// SPDX-License-Identifier: GPL-3.0-or-later
//
// Verdicts of the filters against exact arithmetic.
#ifndef KINETRI_TEST_SUPPORT_VERDICTS_H
#define KINETRI_TEST_SUPPORT_VERDICTS_H

#include <gtest/gtest.h>

#include <cfenv>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/filter_verdict.h"

namespace kinetri::test {

/// Whether `verdict` from `after` on is true of the certificate with the polynomial `p`; the root
/// at `after`, if the certificate vanishes there, does not count.
inline void expect_true(const Filter_verdict& verdict, const Polynomial& p,
                        const Algebraic_number& after) {
  if (verdict.kind == Filter_verdict::Kind::unknown) return;
  // Strictly positive: no root at all, not even a touch, before the end.
  ASSERT_FALSE(p.is_zero());
  ASSERT_EQ(sign_just_after(p, after), CGAL::POSITIVE);
  const auto root = first_root_after(p, after);
  if (verdict.kind != Filter_verdict::Kind::fails) {
    if (verdict.kind == Filter_verdict::Kind::holds_for_ever) {
      ASSERT_FALSE(root) << "fails, but was said to hold for ever";
    } else if (root) {
      ASSERT_GT(root->value, Algebraic_number(verdict.bounds.upper));
    }
    return;
  }
  ASSERT_TRUE(root) << "never fails, but was said to";
  ASSERT_EQ(root->multiplicity, 1);
  ASSERT_GT(root->value, Algebraic_number(verdict.bounds.lower));
  ASSERT_LT(root->value, Algebraic_number(verdict.bounds.upper));
  const auto next = first_root_after(p, root->value);
  if (next) {
    ASSERT_GT(next->value, Algebraic_number(verdict.bounds.upper)) << "two roots in one bracket";
  }
}

/// What `filter` says in a rounding mode, which it leaves as it is.
template <class Filter>
Filter_verdict in_mode(int mode, const Filter& filter) {
  std::fesetround(mode);
  const Filter_verdict verdict = filter();
  EXPECT_EQ(std::fegetround(), mode);
  std::fesetround(FE_TONEAREST);
  return verdict;
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_VERDICTS_H
