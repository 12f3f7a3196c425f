// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's signs and results of comparisons, for sources that need no exact numbers.
#ifndef KINETRI_IMPL_ALGEBRA_SIGN_H
#define KINETRI_IMPL_ALGEBRA_SIGN_H

#include <CGAL/enum.h>

#include "kinetri/base/platform.h"

namespace kinetri {

using CGAL::Comparison_result;
using CGAL::Sign;

}  // namespace kinetri

#endif  // KINETRI_IMPL_ALGEBRA_SIGN_H
