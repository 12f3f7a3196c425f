// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/linear_kinetic_traits_2.h"

#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/certificate_polynomials.h"

namespace kinetri {

std::optional<Algebraic_number> Linear_kinetic_traits_2::exact_failure_time(
    const Polynomial& certificate, const Time& t) {
  ++counters_.exact_decided;
  if (certificate.degree() > 0) ++counters_.root_solves;
  return failure_time(certificate, t);
}

std::optional<Algebraic_number> Linear_kinetic_traits_2::in_circle_failure_time(
    const Point_2& p, const Point_2& q, const Point_2& r, const Point_2& s, const Time& t) {
  ++counters_.created;
  return exact_failure_time(-in_circle_polynomial(p, q, r, s), t);
}

std::optional<Algebraic_number> Linear_kinetic_traits_2::orientation_failure_time(const Point_2& p,
                                                                                  const Point_2& q,
                                                                                  const Point_2& r,
                                                                                  const Time& t) {
  ++counters_.created;
  return exact_failure_time(orientation_polynomial(p, q, r), t);
}

std::optional<Algebraic_number> Linear_kinetic_traits_2::coincidence_time(const Point_2& p,
                                                                          const Point_2& q,
                                                                          const Time& t) {
  ++counters_.created;
  ++counters_.exact_decided;
  const Polynomial x = x_difference(p, q);
  const Polynomial y = y_difference(p, q);
  // Linear polynomials: a common root is a root of the one that is not constant, and of the other.
  const Polynomial& moving = x.degree() == 1 ? x : y;
  const Polynomial& other = x.degree() == 1 ? y : x;
  if (moving.degree() != 1) return std::nullopt;
  const Rational root(-moving[0], moving[1]);
  if (other.sign_at(root) != CGAL::ZERO || compare(t, root) != CGAL::SMALLER) return std::nullopt;
  return Algebraic_number(root);
}

}  // namespace kinetri
