// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/triangulation/detail/regions.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <span>

#include "kinetri/triangulation/detail/regions_impl.h"
#include "kinetri/triangulation/kinetic_triangulation_2_impl.h"

namespace kinetri::detail {

// With fewer points two threads gain little (bench/README.md).
bool may_pay_by_regions(std::size_t points, std::size_t threads) {
  constexpr std::size_t least_points = 50'000;
  constexpr std::size_t most_points = 100'000'000;  // so that handles of a part have enough bits
  if (points < least_points || points > most_points || threads == 1) return false;
  const bool has_arena = threads > 1 || tbb::this_task_arena::max_concurrency() > 1;
  return has_arena &&
         tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism) > 1;
}

int arena_size(std::size_t threads) {
  const std::size_t allowed =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return static_cast<int>(std::min(threads, allowed));
}

// Of turns, which are not there, nothing is compiled.
template <class Traits>
using Run = Region_run<Kinetic_triangulation_2<Traits>>;
template Run<Linear_kinetic_traits_2>::Region_run(Kinetic_triangulation_2<Linear_kinetic_traits_2>&,
                                                  const Region_options&, No_turns);
template std::size_t Run<Linear_kinetic_traits_2>::advance_to(const Algebraic_number&,
                                                              const std::function<bool()>&);
template void Run<Linear_kinetic_traits_2>::join();
template void Run<Linear_kinetic_traits_2>::make_turns(
    std::span<const Kinetic_triangulation_2<Linear_kinetic_traits_2>::Change>);
template Run<Polynomial_kinetic_traits_2>::Region_run(
    Kinetic_triangulation_2<Polynomial_kinetic_traits_2>&, const Region_options&, No_turns);
template std::size_t Run<Polynomial_kinetic_traits_2>::advance_to(const Algebraic_number&,
                                                                  const std::function<bool()>&);
template void Run<Polynomial_kinetic_traits_2>::join();
template void Run<Polynomial_kinetic_traits_2>::make_turns(
    std::span<const Kinetic_triangulation_2<Polynomial_kinetic_traits_2>::Change>);
template Run<Disc_kinetic_traits_2>::Region_run(Kinetic_triangulation_2<Disc_kinetic_traits_2>&,
                                                const Region_options&, No_turns);
template std::size_t Run<Disc_kinetic_traits_2>::advance_to(const Algebraic_number&,
                                                            const std::function<bool()>&);
template void Run<Disc_kinetic_traits_2>::join();
template Run<Polynomial_disc_kinetic_traits_2>::Region_run(
    Kinetic_triangulation_2<Polynomial_disc_kinetic_traits_2>&, const Region_options&, No_turns);
template std::size_t Run<Polynomial_disc_kinetic_traits_2>::advance_to(
    const Algebraic_number&, const std::function<bool()>&);
template void Run<Polynomial_disc_kinetic_traits_2>::join();

}  // namespace kinetri::detail
