// SPDX-License-Identifier: GPL-3.0-or-later
//
// Failures that the program must survive and that a right library never has. Linked in front of the
// library, this definition of Kinetic_triangulation_2<Linear_kinetic_traits_2>::audit takes the
// place of the real one; the environment variable KINETRI_TEST_FAULT chooses the failure.
#include <unistd.h>

#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string_view>

#include "kinetri/impl/base/check.h"
#include "kinetri/kinetri.h"

namespace kinetri {

// The member function under its name in the Itanium C++ ABI, where a member function takes the
// object as its first argument.
Audit_report
faulty_audit(const Kinetic_triangulation_2<Linear_kinetic_traits_2>* audited, Audit_level level) __asm__(
    "_ZNK7kinetri23Kinetic_triangulation_2INS_22Basic_kinetic_traits_2INS_15Linear_motion_"
    "2EEEE5audit"
    "ENS_11Audit_levelE");

Audit_report faulty_audit(const Kinetic_triangulation_2<Linear_kinetic_traits_2>* /*audited*/,
                          Audit_level /*level*/) {
  const char* const variable = std::getenv("KINETRI_TEST_FAULT");
  const std::string_view fault = variable == nullptr ? "" : variable;
  if (fault == "internal") KINETRI_ASSERT(false, "made on purpose");
  if (fault == "precondition") KINETRI_PRECONDITION(false, "made on purpose");
  if (fault == "unexpected") throw std::logic_error("an exception made on purpose");
  while (fault == "endless") ::pause();
  if (fault == "memory") throw std::bad_alloc();
  return {{"the edge 1-2 is wrong"}};
}

}  // namespace kinetri
