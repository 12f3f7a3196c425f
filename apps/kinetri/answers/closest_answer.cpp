// SPDX-License-Identifier: GPL-3.0-or-later
#include <ostream>

#include "answers/answer.h"
#include "cli/arguments.h"
#include "cli/text.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/event_log.h"
#include "kinetri/observers/closest_approaches.h"

namespace kinetri::app {
namespace {

template <class Traits>
class Closest_answer : public Answer {
 public:
  Closest_answer(Simulation_2<Traits>& simulation, std::size_t number, const Run_source& source)
      : approaches_(simulation, number), source_(source) {}

  void write(std::ostream& out) override {
    constexpr bool has_gaps = HasWeight<typename Traits::Motion>;
    constexpr bool has_offsets = PeriodicKineticTraits_2<Traits>;
    out << (has_offsets ? "id_a,id_b,offset," : "id_a,id_b,") << "time,time_lo,time_hi,distance"
        << (has_gaps ? ",gap\n" : "\n");
    for (const Approach& approach : approaches_.approaches()) {
      out << joined(csv_field(source_.name(approach.points[0])), ",",
                    csv_field(source_.name(approach.points[1])), ",");
      if (has_offsets) out << offset_field(approach.offset) << ',';
      out << joined(time_fields(approach.time), ",", approach.distance);
      if (has_gaps) out << joined(",", approach.gap);
      out << '\n';
    }
  }

 private:
  Closest_approaches<Traits> approaches_;
  const Run_source& source_;
};

}  // namespace

// Only for recorded tracks, which do not accelerate.
std::unique_ptr<Answer> closest_answer(const Answer_settings& settings,
                                       const Any_simulation& simulation, const Run_source& source) {
  return simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) -> std::unique_ptr<Answer> {
    if constexpr (HasLinearMotion<Traits>) {
      return std::make_unique<Closest_answer<Traits>>(s, settings.closest, source);
    } else {
      throw Usage_error("--closest: the points accelerate; expected constant velocities");
    }
  });
}

}  // namespace kinetri::app
