// SPDX-License-Identifier: GPL-3.0-or-later
#include "watch.h"

#include "kinetri/base/check.h"
#include "kinetri/observers/closest_approaches.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri::python {
namespace {

template <class Core>
struct Traits_of;
template <template <class> class Core, class Traits>
struct Traits_of<Core<Traits>> {
  using type = Traits;
};

[[noreturn]] void refuse(const std::string& problem) {
  throw Precondition_error(problem);
}

// An observer, and the function that makes its table.
template <class Observer, class Make_table>
class Watch_of final : public Watch {
 public:
  template <class Core>
  Watch_of(Core& core, auto parameter, Make_table make_table)
      : observer_(core, parameter), make_table_(make_table) {}
  Answer_table table() override { return make_table_(observer_); }

 private:
  Observer observer_;
  Make_table make_table_;
};

template <class Observer, class Core, class Parameter, class Make_table>
std::unique_ptr<Watch> watch_of(Core& core, Parameter parameter, Make_table make_table) {
  return std::make_unique<Watch_of<Observer, Make_table>>(core, parameter, make_table);
}

template <class Core, class Traits>
std::unique_ptr<Watch> closest(Core& core, std::size_t number) {
  if constexpr (std::is_same_v<Core, Simulation_2<Traits>> && HasLinearMotion<Traits>) {
    return watch_of<Closest_approaches<Traits>>(core, number, [](auto& observer) {
      const std::vector<Approach> rows = observer.approaches();
      Answer_table result;
      result.add_pair(rows, [](const Approach& row) { return row.points; });
      result.add_times("time", rows, [](const Approach& row) { return row.time; });
      result.add("distance", rows, [](const Approach& row) { return row.distance; });
      result.add("gap", rows, [](const Approach& row) { return row.gap; });
      return result;
    });
  } else {
    refuse("closest approaches are those of a simulation of points that move along straight lines");
  }
}

}  // namespace

template <class Core>
std::unique_ptr<Watch> watch(Core& core, const Question& question) {
  using Traits = typename Traits_of<Core>::type;
  if (question.about == "closest") return closest<Core, Traits>(core, question.number);
  refuse("nothing is known about " + question.about);
}

#define KINETRI_INSTANTIATE(Traits)                                                         \
  template std::unique_ptr<Watch> watch(Kinetic_triangulation_2<Traits>&, const Question&); \
  template std::unique_ptr<Watch> watch(Simulation_2<Traits>&, const Question&)
KINETRI_INSTANTIATE(Linear_kinetic_traits_2);
KINETRI_INSTANTIATE(Polynomial_kinetic_traits_2);
KINETRI_INSTANTIATE(Disc_kinetic_traits_2);
KINETRI_INSTANTIATE(Polynomial_disc_kinetic_traits_2);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri::python
