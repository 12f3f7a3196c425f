// SPDX-License-Identifier: GPL-3.0-or-later
//
// parallel.cpp and regions.cpp for platforms without oneTBB: everything runs on one thread.
#include <cstddef>
#include <functional>
#include <span>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/kinetic_core.h"
#include "kinetri/impl/triangulation/parallel.h"

namespace kinetri::detail {

std::size_t usable_threads(std::size_t) {
  return 1;
}

void call_with_threads(std::size_t, const std::function<void()>& work) {
  work();
}

void for_each_index_in_parallel(std::size_t count, const std::function<void(std::size_t)>& work) {
  for (std::size_t k = 0; k < count; ++k) work(k);
}

bool may_pay_by_regions(std::size_t, std::size_t) {
  return false;
}

// So nothing below is called.

template <class Traits>
std::size_t Region_runs<Traits>::advance_to(Core&, const Algebraic_number&,
                                            const std::function<bool()>&) {
  KINETRI_ASSERT(false, "one thread executes the events");
  return 0;
}

template <class Traits>
void Region_runs<Traits>::change_in_place(Core&,
                                          std::span<const typename Kinetic_types<Traits>::Change>) {
  KINETRI_ASSERT(false, "the queue is in one part");
}

template <class Traits>
void Region_runs<Traits>::join(Core&) {
  KINETRI_ASSERT(false, "the queue is in one part");
}

template struct Region_runs<Linear_kinetic_traits_2>;
template struct Region_runs<Polynomial_kinetic_traits_2>;
template struct Region_runs<Disc_kinetic_traits_2>;
template struct Region_runs<Polynomial_disc_kinetic_traits_2>;
template struct Region_runs<Periodic_kinetic_traits_2>;
template struct Region_runs<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri::detail
