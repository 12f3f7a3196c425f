// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_engine_impl.h"

namespace kinetri::python {

KINETRI_PYTHON_INSTANTIATE(Disc_kinetic_traits_2);
KINETRI_PYTHON_INSTANTIATE(Polynomial_disc_kinetic_traits_2);

}  // namespace kinetri::python
