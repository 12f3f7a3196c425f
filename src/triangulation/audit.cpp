// SPDX-License-Identifier: GPL-3.0-or-later
//
// The audits are compiled on their own: their static triangulation is most of the compile time.
#include "kinetri/triangulation/audit.h"

#include <iostream>

#include "kinetri/triangulation/audit_impl.h"

namespace kinetri {

template Audit_report Kinetic_triangulation_2<Linear_kinetic_traits_2>::audit(
    Audit_level level) const;
template Audit_report Kinetic_triangulation_2<Polynomial_kinetic_traits_2>::audit(
    Audit_level level) const;
template Audit_report Kinetic_triangulation_2<Disc_kinetic_traits_2>::audit(
    Audit_level level) const;
template Audit_report Kinetic_triangulation_2<Polynomial_disc_kinetic_traits_2>::audit(
    Audit_level level) const;

bool detail::is_passed(const Audit_report& report, bool verbose) {
  if (verbose) {
    for (const std::string& failure : report.failures) std::cerr << failure << '\n';
  }
  return report.passed();
}

}  // namespace kinetri
