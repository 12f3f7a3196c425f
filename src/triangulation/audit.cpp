// SPDX-License-Identifier: GPL-3.0-or-later
//
// The audits have a source of their own, since their static triangulation takes long to compile.
#include "kinetri/triangulation/audit.h"

#include <iostream>

#include "kinetri/triangulation/audit_impl.h"

namespace kinetri {

namespace detail {
template Audit_report audit<Linear_kinetic_traits_2>(const Kinetic_core<Linear_kinetic_traits_2>&,
                                                     Audit_level);
template Audit_report audit<Polynomial_kinetic_traits_2>(
    const Kinetic_core<Polynomial_kinetic_traits_2>&, Audit_level);
template Audit_report audit<Disc_kinetic_traits_2>(const Kinetic_core<Disc_kinetic_traits_2>&,
                                                   Audit_level);
template Audit_report audit<Polynomial_disc_kinetic_traits_2>(
    const Kinetic_core<Polynomial_disc_kinetic_traits_2>&, Audit_level);
}  // namespace detail

bool detail::is_passed(const Audit_report& report, bool verbose) {
  if (verbose) {
    for (const std::string& failure : report.failures) std::cerr << failure << '\n';
  }
  return report.passed();
}

}  // namespace kinetri
