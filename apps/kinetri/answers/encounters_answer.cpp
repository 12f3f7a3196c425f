// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <ostream>
#include <utility>

#include "answers/table_answer.h"
#include "cli/arguments.h"
#include "kinetri/impl/io/json_writer.h"

namespace kinetri::app {
namespace {

// In the form that NASA's High-rate Delay Tolerant Networking (HDTN) reads: one contact for each
// direction. The times of a contact are rounded into the encounter. An encounter of one instant is
// left out.
template <class Traits>
class Contact_plan : public Answer {
 public:
  Contact_plan(Simulation_2<Traits>& simulation, double range) : encounters_(simulation, range) {}

  void write(std::ostream& out) override {
    std::uint64_t number = 0;
    out << "{\"contacts\": [";
    for (const Encounter& encounter : encounters_.encounters()) {
      const double begin = encounter.begin.tight_interval().upper;
      const double end = encounter.end.tight_interval().lower;
      if (begin >= end) continue;
      const auto [a, b] = encounter.points;
      for (const auto& [source, destination] : {std::pair(a, b), std::pair(b, a)}) {
        out << (number == 0 ? "\n" : ",\n") << contact(number, source, destination, begin, end);
        ++number;
      }
    }
    out << "\n]}\n";
  }

 private:
  static std::string contact(std::uint64_t number, Point_id source, Point_id destination,
                             double begin, double end) {
    std::string text;
    Json_writer json(text);
    json.begin_object();
    json.member("contact", number);
    json.member("source", source);
    json.member("dest", destination);
    json.member("startTime", begin);
    json.member("endTime", end);
    json.end_object();
    return text;
  }

  Encounters<Traits> encounters_;
};

}  // namespace

std::unique_ptr<Answer> encounters_answer(const Answer_settings& settings,
                                          const Any_simulation& simulation,
                                          const Run_source& source) {
  return simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) -> std::unique_ptr<Answer> {
    constexpr bool is_periodic = PeriodicKineticTraits_2<Traits>;
    constexpr bool has_radii = HasWeight<typename Traits::Motion>;
    if constexpr (is_periodic && has_radii) {
      throw Usage_error(
          "--encounters: in a periodic box those of discs of several radii, or that grow, are not "
          "supported; expected points, or discs of one constant radius");
    } else {
      const bool has_discs = has_radii || s.options().radius != 0;
      return table_answer<Encounters<Traits>>(
          source, detail::Encounter_columns{has_discs, is_periodic}, s, settings.range);
    }
  });
}

std::unique_ptr<Answer> contact_plan_answer(const Answer_settings& settings,
                                            const Any_simulation& simulation,
                                            const Run_source& /*source*/) {
  return simulation.visit_plane(
      [&]<class Traits>(Simulation_2<Traits>& s) -> std::unique_ptr<Answer> {
        return std::make_unique<Contact_plan<Traits>>(s, settings.range);
      });
}

}  // namespace kinetri::app
