// SPDX-License-Identifier: GPL-3.0-or-later
#include <ostream>
#include <string>

#include "answers/answer.h"
#include "io/text.h"
#include "kinetri/observers/neighbor_lives.h"

namespace kinetri::app {
namespace {

// From when until when two points were neighbors. Without --ridge, nothing is said to be short.
template <class Traits>
class Lives_answer : public Answer {
 public:
  Lives_answer(Simulation_2<Traits>& simulation, const std::optional<double>& ridge)
      : lives_(simulation, ridge), has_ridge_(ridge) {}

  void write(std::ostream& out) override {
    out << "a,b,begin_lo,begin_hi,end_lo,end_hi,begins_by,ends_by,short\n";
    for (const Neighbor_life& life : lives_.lives()) {
      const auto& [a, b] = life.points;
      out << joined(a, ",", b, ",", time_bounds(life.begin), ",", time_bounds(life.end), ",",
                    name(life.begins_by), ",", name(life.ends_by), ",",
                    has_ridge_ ? std::to_string(life.is_short ? 1 : 0) : std::string(), "\n");
    }
  }

 private:
  Neighbor_lives<Traits> lives_;
  bool has_ridge_;
};

// How often each point took part in a neighbor exchange, and how often in a unit of time.
template <class Traits>
class Exchanges_answer : public Answer {
 public:
  Exchanges_answer(Simulation_2<Traits>& simulation, const std::optional<double>& ridge)
      : lives_(simulation, ridge), has_ridge_(ridge) {}

  void write(std::ostream& out) override {
    out << "id,from_lo,from_hi,until_lo,until_hi,gained,lost,short,rate\n";
    for (const Point_exchanges& point : lives_.exchanges()) {
      const std::size_t counted = point.gained + point.lost - point.short_ones;
      const double duration = point.until.to_double() - point.from.to_double();
      out << joined(
          point.id, ",", time_bounds(point.from), ",", time_bounds(point.until), ",", point.gained,
          ",", point.lost, ",", has_ridge_ ? std::to_string(point.short_ones) : std::string(), ",",
          duration > 0 ? joined(static_cast<double>(counted) / duration) : std::string(), "\n");
    }
  }

 private:
  Neighbor_lives<Traits> lives_;
  bool has_ridge_;
};

}  // namespace

std::unique_ptr<Answer> neighbors_answer(const Answer_settings& settings,
                                         const Any_simulation& simulation,
                                         const Run_source& /*source*/) {
  return simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) -> std::unique_ptr<Answer> {
    return std::make_unique<Lives_answer<Traits>>(s, settings.ridge);
  });
}

std::unique_ptr<Answer> exchanges_answer(const Answer_settings& settings,
                                         const Any_simulation& simulation,
                                         const Run_source& /*source*/) {
  return simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) -> std::unique_ptr<Answer> {
    return std::make_unique<Exchanges_answer<Traits>>(s, settings.ridge);
  });
}

}  // namespace kinetri::app
