// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/algebra/failure_certificate.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/algebra/sturm_sequence.h"
#include "kinetri/impl/base/check.h"

namespace kinetri {
namespace {

using Root = std::vector<Real_root>::const_iterator;

// A dyadic number after `t` and before `next`, which may be null; `t` itself if it is a binary64
// number and `t_counts`.
Rational dyadic_from(const Algebraic_number& t, bool t_counts, const Algebraic_number* next) {
  const Double_interval tight = t.tight_interval();
  const bool is_usable = tight.lower < tight.upper || t_counts;
  if (is_usable && std::isfinite(tight.upper)) {
    const Rational result = to_rational(tight.upper);
    if (next == nullptr || compare(*next, result) == CGAL::LARGER) return result;
  }
  KINETRI_ASSERT(next != nullptr, "certified times are within the range of binary64");
  return simplest_between(t, *next);
}

// The intervals of roots that follow each other, from one that begins at or after `from`.
class Brackets {
 public:
  Brackets(Rational from, Root end) : least_(std::move(from)), end_(end) {}

  Rational_interval next(Root root) {
    const Algebraic_number& value = root->value;
    const Double_interval tight = value.tight_interval();
    Rational_interval result = {to_rational(tight.lower), to_rational(tight.lower)};
    if (tight.lower < tight.upper) {
      const Root following = std::next(root);
      result.upper = dyadic_from(value, false, following == end_ ? nullptr : &following->value);
      if (previous_ != nullptr && compare(*previous_, result.lower) != CGAL::SMALLER) {
        result.lower = simplest_between(*previous_, value);
      }
      result.lower = std::max(result.lower, least_);
    }
    previous_ = &value;
    return result;
  }

 private:
  Rational least_;
  Root end_;
  const Algebraic_number* previous_ = nullptr;  // the root before
};

std::vector<Sign> signs_at(const Sturm_sequence& sequence, const Rational& t) {
  std::vector<Sign> result;
  for (const Polynomial& term : sequence.terms()) result.push_back(term.sign_at(t));
  return result;
}

bool is_even(const Real_root& root) {
  return root.multiplicity % 2 == 0;
}

}  // namespace

std::optional<Failure_certificate> certify_failure(const Polynomial& p,
                                                   const Algebraic_number& start,
                                                   const Algebraic_number& failure) {
  const bool is_at_start = start == failure;
  KINETRI_PRECONDITION(is_at_start || start < failure,
                       "a polynomial that fails before the time from which it must not be "
                       "negative; take a failure at that time or later");
  if (p.degree() < 1) return std::nullopt;
  const std::vector<Real_root> roots = real_roots(p);
  const Root end = roots.end();
  const Root failed = std::find_if(roots.begin(), end,
                                   [&](const Real_root& root) { return root.value == failure; });
  if (failed == end) return std::nullopt;
  Sign sign_after = p.sign_at_plus_infinity();
  for (Root root = std::next(failed); root != end; ++root) {
    if (!is_even(*root)) sign_after = -sign_after;
  }
  if (sign_after != CGAL::NEGATIVE) return std::nullopt;
  // The roots from here on are after the start, and those before the failure must be touches.
  const Root first = is_at_start ? failed : std::find_if(roots.begin(), failed, [&](auto& root) {
    return root.value > start;
  });
  if (!is_at_start && (is_even(*failed) || !std::all_of(first, failed, is_even))) {
    return std::nullopt;
  }

  Failure_certificate result;
  result.polynomial = primitive_part(p);
  result.multiplicity = failed->multiplicity;
  if (is_at_start) {
    Rational_interval present = {to_rational(failure.tight_interval().lower), 0};
    const bool has_previous = failed != roots.begin();
    if (has_previous && compare(std::prev(failed)->value, present.lower) != CGAL::SMALLER) {
      present.lower = simplest_between(std::prev(failed)->value, failure);
    }
    present = Brackets(present.lower, end).next(failed);
    result.from = result.lower = present.lower;
    result.upper = present.upper;
  } else {
    const bool start_is_root = first != roots.begin() && std::prev(first)->value == start;
    result.from = dyadic_from(start, !start_is_root, &first->value);
    Brackets brackets(result.from, end);
    for (Root root = first; root != failed; ++root) result.touches.push_back(brackets.next(root));
    const Rational_interval present = brackets.next(failed);
    result.lower = present.lower;
    result.upper = present.upper;
  }
  const Sturm_sequence sequence(p);
  result.signs = {signs_at(sequence, result.from), signs_at(sequence, result.lower),
                  signs_at(sequence, result.upper)};
  return result;
}

}  // namespace kinetri
