// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "make_engine_impl.h"

namespace kinetri::python {

KINETRI_PYTHON_INSTANTIATE(Linear_kinetic_traits_2);
KINETRI_PYTHON_INSTANTIATE(Polynomial_kinetic_traits_2);
template std::unique_ptr<Engine> make_engine(const Motion_columns&, const Algebraic_number&,
                                             Coincident_points, const Periodic_kinetic_traits_2&);
template std::unique_ptr<Engine> make_engine(const Motion_columns&, const Algebraic_number&,
                                             const Simulation_options&,
                                             const Periodic_kinetic_traits_2&);

std::unique_ptr<Engine> make_periodic_engine(
    const Simulation_snapshot<Linear_kinetic_traits_2>& snapshot, const Periodic_box_2& box) {
  const auto& [time, motions, counters, certificates] = snapshot.triangulation;
  return restored_triangulation<Periodic_kinetic_traits_2>({time, motions, counters, certificates},
                                                           Periodic_kinetic_traits_2(box),
                                                           snapshot.options.coincident);
}

}  // namespace kinetri::python
