// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "make_engine_impl.h"

namespace kinetri::python {

KINETRI_PYTHON_INSTANTIATE(Disc_kinetic_traits_2);
KINETRI_PYTHON_INSTANTIATE(Polynomial_disc_kinetic_traits_2);
template std::unique_ptr<Engine> make_engine(const Motion_columns&, const Algebraic_number&,
                                             const Simulation_options&,
                                             const Periodic_disc_kinetic_traits_2&);
template std::unique_ptr<Engine> make_engine(
    const Simulation_snapshot<Periodic_disc_kinetic_traits_2>&, Engine_kind, Collision_response,
    const Periodic_disc_kinetic_traits_2&);

}  // namespace kinetri::python
