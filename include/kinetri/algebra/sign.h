// SPDX-License-Identifier: GPL-3.0-or-later
//
// Signs and the results of comparisons, as CGAL has them. For sources that need no exact number,
// whose headers are long.
#ifndef KINETRI_ALGEBRA_SIGN_H
#define KINETRI_ALGEBRA_SIGN_H

#include <CGAL/enum.h>

#include "kinetri/base/platform.h"

namespace kinetri {

using CGAL::Comparison_result;
using CGAL::Sign;

}  // namespace kinetri

#endif  // KINETRI_ALGEBRA_SIGN_H
