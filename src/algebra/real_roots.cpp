// SPDX-License-Identifier: GPL-3.0-or-later
//
// Real roots: isolated by Descartes' rule of signs (root_isolation.h), certified by Sturm counts
// (sturm_counter.h).
#include "kinetri/algebra/real_roots.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "gmp_access.h"
#include "kinetri/impl/base/check.h"
#include "root_isolation.h"
#include "sturm_counter.h"

namespace kinetri {
namespace {

// Checks by Sturm's theorem that the interval of a root has exactly one root and that no root was
// skipped: as many sign changes as given before it, and one less after it.
void certify(Sturm_counter& counter, int changes, const Algebraic_number& root) {
  const Rational_interval around = root.isolating_interval();
  KINETRI_ASSERT(around.is_point() ? counter.sign_at(around.lower) == CGAL::ZERO
                                   : counter.changes_at(around.lower) == changes,
                 "there is a root before the interval of a root");
  KINETRI_ASSERT(counter.changes_at(around.upper) == changes - 1,
                 "the interval of a root does not have one root");
}

// The roots of a square-free polynomial in ascending order.
std::vector<Algebraic_number> simple_roots(const Polynomial& square_free) {
  std::vector<Integer> c(square_free.coefficients().begin(), square_free.coefficients().end());
  const bool has_root_zero = c.front().is_zero();
  if (has_root_zero) c.erase(c.begin());
  const Polynomial rest(c);
  for (std::size_t i = 1; i < c.size(); i += 2) c[i] = -c[i];

  std::vector<Algebraic_number> result;
  for (const Algebraic_number& root : roots_beyond(Polynomial(std::move(c)), 0)) {
    result.push_back(-root);
  }
  std::ranges::reverse(result);
  if (has_root_zero) result.emplace_back();
  std::ranges::move(roots_beyond(rest, 0), std::back_inserter(result));

  Sturm_counter counter(square_free);
  int changes = counter.changes_at_minus_infinity();
  for (const Algebraic_number& root : result) certify(counter, changes--, root);
  KINETRI_ASSERT(changes == counter.changes_at_plus_infinity(), "there is another root");
  return result;
}

void append(std::vector<Real_root>& result, const std::vector<Algebraic_number>& roots,
            int multiplicity) {
  for (const Algebraic_number& root : roots) result.push_back({root, multiplicity});
}

void sort_by_value(std::vector<Real_root>& roots) {
  std::sort(roots.begin(), roots.end(), [](const Real_root& a, const Real_root& b) {
    return compare(a.value, b.value) == CGAL::SMALLER;
  });
}

std::string wrong_degree(const char* function, int degree, const Polynomial& p) {
  return std::string(function) + " solves polynomials of degree " + std::to_string(degree) +
         "; this one has degree " + std::to_string(p.degree()) +
         ": call real_roots, which solves those of any degree";
}

// --- The first root after a number --------------------------------------------------------------

std::optional<Algebraic_number> first_root_beyond(const Polynomial& q, const Rational& from) {
  Sturm_counter counter(q);
  const std::vector<Algebraic_number> roots = roots_beyond(q, from, 1);
  const int changes = counter.changes_at(from);
  if (roots.empty()) {
    KINETRI_ASSERT(changes == counter.changes_at_plus_infinity(), "there is a root");
    return std::nullopt;
  }
  certify(counter, changes, roots.front());
  return roots.front();
}

// The least root of the square-free polynomial q greater than t.
std::optional<Algebraic_number> first_simple_root_after(const Polynomial& q,
                                                        const Algebraic_number& t) {
  if (q.degree() < 1) return std::nullopt;
  Rational_interval around = t.isolating_interval();
  if (!around.is_point() && !equal_up_to_sign(q, t.polynomial())) {
    // Narrows the interval around t until q has no root in it, or only t: until q does not vanish
    // in it, or is monotone.
    const bool is_root = sign_at(q, t) == CGAL::ZERO;
    const Polynomial decisive = is_root ? derivative(q) : q;
    around = t.isolating_interval();
    while (!around.is_point() && !decisive.sign_on(around.lower, around.upper)) {
      t.refine();
      around = t.isolating_interval();
    }
  }
  return first_root_beyond(q, around.upper);
}

}  // namespace

std::vector<Real_root> real_roots(const Polynomial& p) {
  KINETRI_PRECONDITION(!p.is_zero(), "every number is a root of the zero polynomial");
  std::vector<Real_root> result;
  const std::vector<Square_free_factor> factors = square_free_decomposition(p);
  for (const Square_free_factor& f : factors) {
    append(result, simple_roots(f.factor), f.multiplicity);
  }
  if (factors.size() > 1) sort_by_value(result);
  return result;
}

std::vector<Real_root> sturm3(const Polynomial& p) {
  KINETRI_PRECONDITION(p.degree() == 3, wrong_degree("sturm3", 3, p));
  return real_roots(p);
}

std::vector<Real_root> sturm4(const Polynomial& p) {
  KINETRI_PRECONDITION(p.degree() == 4, wrong_degree("sturm4", 4, p));
  return real_roots(p);
}

std::optional<Real_root> first_root_after(const Polynomial& p, const Algebraic_number& t) {
  KINETRI_PRECONDITION(!p.is_zero(), "every number is a root of the zero polynomial");
  const std::vector<Square_free_factor> factors = square_free_decomposition(p);
  Polynomial square_free{1};
  for (const Square_free_factor& f : factors) square_free = square_free * f.factor;
  const std::optional<Algebraic_number> root = first_simple_root_after(square_free, t);
  if (!root) return std::nullopt;
  for (const Square_free_factor& f : factors) {
    if (factors.size() == 1 || sign_at(f.factor, *root) == CGAL::ZERO) {
      return Real_root{*root, f.multiplicity};
    }
  }
  KINETRI_ASSERT(false, "a root of a polynomial is a root of one of its square-free factors");
  return std::nullopt;
}

std::optional<Algebraic_number> failure_time(const Polynomial& p, const Algebraic_number& t) {
  if (p.is_zero()) return std::nullopt;
  if (sign_just_after(p, t) == CGAL::NEGATIVE) return t;
  return first_simple_root_after(odd_part(p), t);
}

}  // namespace kinetri
