// SPDX-License-Identifier: GPL-3.0-or-later
#include <ostream>
#include <string>

#include "answers/answer.h"
#include "cli/arguments.h"
#include "io/text.h"
#include "kinetri/observers/connected_components.h"

namespace kinetri::app {
namespace {

// Empty for no point.
std::string field(Point_id id) {
  return id == no_point ? std::string() : std::to_string(id);
}

template <class Traits>
class Components_answer : public Answer {
 public:
  Components_answer(Simulation_2<Traits>& simulation, double range)
      : components_(simulation, range) {}

  void write(std::ostream& out) override {
    out << "time_lo,time_hi,kind,a,b,components,largest\n";
    for (const Component_event& event : components_.events()) {
      out << joined(time_bounds(event.time), ",", name(event.kind), ",", field(event.points[0]),
                    ",", field(event.points[1]), ",", event.components, ",", event.largest, "\n");
    }
  }

 private:
  Connected_components<Traits> components_;
};

}  // namespace

std::unique_ptr<Answer> components_answer(const Answer_settings& settings,
                                          const Any_simulation& simulation,
                                          const Run_source& /*source*/) {
  return simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) -> std::unique_ptr<Answer> {
    if constexpr (!HasWeight<typename Traits::Motion>) {
      if (s.options().radius == 0) {
        return std::make_unique<Components_answer<Traits>>(s, settings.range);
      }
    }
    throw Usage_error(
        "--components: the points are discs, between whose rims the gap would count; expected "
        "points without radii");
  });
}

}  // namespace kinetri::app
