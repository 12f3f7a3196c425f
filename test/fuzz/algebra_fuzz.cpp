// SPDX-License-Identifier: GPL-3.0-or-later
//
// The algebra on polynomials from bytes: the same roots by isolation, by Sturm counts and by signs,
// and comparisons that make one order.
//
// Each of two polynomials is read as a number of factors, each with its multiplicity, so that
// multiple and common roots are frequent; a coefficient is one byte, or eight.
#include <algorithm>
#include <sstream>
#include <vector>

#include "fuzz/fuzz.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/algebra/sturm_sequence.h"

namespace kinetri {
namespace {

using test::Fuzz_input;

constexpr int highest_degree = 8;

Polynomial read_factor(Fuzz_input& input, bool large) {
  const int degree = input.integer(0, 4);
  std::vector<Integer> coefficients;
  for (int i = 0; i <= degree; ++i) {
    coefficients.emplace_back(large ? static_cast<std::int64_t>(input.word())
                                    : input.integer(-6, 6));
  }
  return Polynomial(std::move(coefficients));
}

Polynomial read_polynomial(Fuzz_input& input) {
  const bool large = input.integer(0, 3) == 0;
  Polynomial product{1};
  for (int factors = input.integer(1, 3); factors > 0; --factors) {
    const Polynomial factor = read_factor(input, large);
    for (int times = input.integer(1, 4); times > 0; --times) {
      if (product.degree() + factor.degree() > highest_degree) break;
      product = product * factor;
    }
  }
  return product;
}

// Requirements on one polynomial, with it in the message.
class Checker {
 public:
  explicit Checker(const Polynomial& p) : p_(p), roots_(real_roots(p)) {}

  void check() const {
    check_multiplicities();
    check_signs();
    for (const Square_free_factor& f : square_free_decomposition(p_)) check_factor(f);
  }

  void check_at(const Rational& t) const {
    require(sign(p_(t)) == p_.sign_at(t), "the sign of the value");
    const Algebraic_number time(t);
    require(sign_at(p_, time) == p_.sign_at(t), "the sign at a rational algebraic number");
    const auto after =
        std::ranges::find_if(roots_, [&time](const Real_root& root) { return root.value > time; });
    const auto first = first_root_after(p_, time);
    require(first.has_value() == (after != roots_.end()), "a first root after a time");
    if (first) {
      require(first->value == after->value && first->multiplicity == after->multiplicity,
              "the first root after a time");
    }
    check_failure(time, static_cast<std::size_t>(after - roots_.begin()));
    const auto below = std::ranges::count_if(
        roots_, [&time](const Real_root& root) { return root.value <= time; });
    require(Sturm_sequence(p_).count(std::nullopt, Interval_end{t, true}) == below,
            "the Sturm count up to a time");
  }

  const std::vector<Real_root>& roots() const { return roots_; }

 private:
  void require(bool holds, const char* what) const {
    if (holds) return;
    std::ostringstream text;
    text << what << ": of " << p_;
    test::require(false, text.str());
  }

  void check_multiplicities() const {
    int sum = 0;
    for (const Real_root& root : roots_) {
      require(root.multiplicity > 0, "a multiplicity");
      sum += root.multiplicity;
    }
    require(sum <= p_.degree() && (p_.degree() - sum) % 2 == 0, "the sum of the multiplicities");
    require(Sturm_sequence(p_).count() == static_cast<int>(roots_.size()), "the Sturm count");
    require(std::ranges::is_sorted(
                roots_, [](const Real_root& a, const Real_root& b) { return a.value < b.value; }),
            "the order of the roots");
  }

  void check_signs() const {
    Sign before = p_.sign_at_minus_infinity();
    const Polynomial odd = odd_part(p_);
    for (std::size_t i = 0; i < roots_.size(); ++i) {
      const auto& [root, multiplicity] = roots_[i];
      const Sign after = multiplicity % 2 == 1 ? -before : before;
      require(root.is_root_of(p_) && sign_at(p_, root) == CGAL::ZERO, "a root");
      require(sign_just_before(p_, root) == before, "the sign just before a root");
      require(sign_just_after(p_, root) == after, "the sign just after a root");
      require(sign_just_after(odd, root) == after, "the sign of the odd part");
      require(root.is_root_of(odd) == (multiplicity % 2 == 1), "the roots of the odd part");
      const Double_interval tight = root.tight_interval();
      require(compare(root, to_rational(tight.lower)) != CGAL::SMALLER &&
                  compare(root, to_rational(tight.upper)) != CGAL::LARGER,
              "the interval of a root");
      if (i + 1 < roots_.size()) {
        require(root < roots_[i + 1].value, "distinct roots");
        require(p_.sign_at(simplest_between(root, roots_[i + 1].value)) == after,
                "the sign between roots");
      }
      before = after;
    }
    require(before == p_.sign_at_plus_infinity(), "the sign behind the last root");
  }

  void check_failure(const Algebraic_number& time, std::size_t after) const {
    const auto failure = failure_time(p_, time);
    if (sign_just_after(p_, time) == CGAL::NEGATIVE) {
      return require(failure == time, "a failure at once");
    }
    while (after < roots_.size() && roots_[after].multiplicity % 2 == 0) ++after;
    require(failure.has_value() == (after < roots_.size()), "a failure");
    if (failure) require(*failure == roots_[after].value, "the failure time");
  }

  void check_factor(const Square_free_factor& f) const {
    for (const Real_root& root : roots_) {
      require(root.value.is_root_of(f.factor) == (root.multiplicity == f.multiplicity),
              "the square-free factor with a root");
    }
  }

  const Polynomial& p_;
  std::vector<Real_root> roots_;
};

// The roots of both, in one order; as many are equal as their gcd has.
void check_order(const Polynomial& p, const Polynomial& q, const Checker& of_p,
                 const Checker& of_q) {
  int equal = 0;
  for (const Real_root& a : of_p.roots()) {
    for (const Real_root& b : of_q.roots()) {
      const Comparison_result result = compare(a.value, b.value);
      test::require(result == -compare(b.value, a.value), "a comparison that can be turned round");
      const bool is_common = a.value.is_root_of(q) && b.value.is_root_of(p);
      if (result == CGAL::EQUAL) {
        test::require(is_common, "equal roots that are not common");
        ++equal;
      } else {
        const bool is_smaller = result == CGAL::SMALLER;
        const Rational between =
            is_smaller ? simplest_between(a.value, b.value) : simplest_between(b.value, a.value);
        test::require(compare(a.value, between) == result, "a number between roots");
        test::require(compare(b.value, between) == -result, "a number between roots");
      }
    }
  }
  test::require(Sturm_sequence(gcd(p, q)).count() == equal, "the common roots of p and q");
}

}  // namespace
}  // namespace kinetri

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kinetri::test::Fuzz_input input(data, size);
  const kinetri::Polynomial p = kinetri::read_polynomial(input);
  const kinetri::Polynomial q = kinetri::read_polynomial(input);
  if (p.is_zero() || q.is_zero()) return 0;
  const kinetri::Checker of_p(p);
  const kinetri::Checker of_q(q);
  of_p.check();
  of_q.check();
  of_p.check_at(kinetri::Rational(input.integer(-9, 9), input.integer(1, 4)));
  kinetri::check_order(p, q, of_p, of_q);
  return 0;
}
