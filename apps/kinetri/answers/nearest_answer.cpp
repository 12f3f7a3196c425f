// SPDX-License-Identifier: GPL-3.0-or-later
#include <ostream>
#include <string>

#include "answers/answer.h"
#include "cli/arguments.h"
#include "io/text.h"
#include "kinetri/observers/nearest_neighbors.h"

namespace kinetri::app {
namespace {

// Empty for no point.
std::string id_or_nothing(Point_id id) {
  return id == no_point ? std::string() : std::to_string(id);
}

template <class Traits>
class Nearest_answer : public Answer {
 public:
  explicit Nearest_answer(Simulation_2<Traits>& simulation) : nearest_(simulation) {}

  void write(std::ostream& out) override {
    out << "time_lo,time_hi,id,before,after\n";
    for (const Nearest_neighbor_change& change : nearest_.changes()) {
      out << joined(time_bounds(change.time), ",", change.id, ",", id_or_nothing(change.before),
                    ",", id_or_nothing(change.after), "\n");
    }
  }

 private:
  Nearest_neighbors<Traits> nearest_;
};

}  // namespace

std::unique_ptr<Answer> nearest_answer(const Answer_settings& /*settings*/,
                                       const Any_simulation& simulation,
                                       const Run_source& /*source*/) {
  return simulation.visit([]<class Traits>(Simulation_2<Traits>& s) -> std::unique_ptr<Answer> {
    if constexpr (HasNearestNeighbors<Traits>) {
      return std::make_unique<Nearest_answer<Traits>>(s);
    } else {
      throw Usage_error(
          "--nearest: the edges of a regular triangulation do not tell which discs are nearest; "
          "expected points, or discs of one size");
    }
  });
}

}  // namespace kinetri::app
