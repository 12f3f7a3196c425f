// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <ostream>
#include <utility>
#include <vector>

#include "answers/table_answer.h"
#include "kinetri/impl/io/json_writer.h"

namespace kinetri::app {
namespace {

// In the form that NASA's High-rate Delay Tolerant Networking (HDTN) reads: one contact for each
// direction. The times of a contact are rounded into the encounter. An encounter of one instant is
// left out. In a periodic box two points are in contact while any two images of them are.
template <class Traits>
class Contact_plan : public Answer {
 public:
  Contact_plan(Simulation_2<Traits>& simulation, double range) : encounters_(simulation, range) {}

  void write(std::ostream& out) override {
    std::uint64_t number = 0;
    out << "{\"contacts\": [";
    for (const Meeting& meeting : meetings()) {
      const double begin = meeting.begin.tight_interval().upper;
      const double end = meeting.end.tight_interval().lower;
      if (begin >= end) continue;
      const auto [a, b] = meeting.points;
      for (const auto& [source, destination] : {std::pair(a, b), std::pair(b, a)}) {
        out << (number == 0 ? "\n" : ",\n") << contact(number, source, destination, begin, end);
        ++number;
      }
    }
    out << "\n]}\n";
  }

 private:
  // A maximal interval in which two points are in range.
  struct Meeting {
    Edge_ids points;
    Algebraic_number begin;
    Algebraic_number end;
  };

  // In the order of their begins.
  std::vector<Meeting> meetings() {
    std::vector<Meeting> result;
    std::map<Edge_ids, std::size_t> last;  // the index of the last one of each pair
    for (const Encounter& encounter : encounters_.encounters()) {
      if (encounter.points[0] == encounter.points[1]) continue;  // a point and its own image
      const auto [known, is_first] = last.try_emplace(encounter.points, result.size());
      if (!is_first && encounter.begin <= result[known->second].end) {
        Algebraic_number& end = result[known->second].end;
        end = std::max(end, encounter.end);
        continue;
      }
      known->second = result.size();
      result.push_back({encounter.points, encounter.begin, encounter.end});
    }
    return result;
  }

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
    const bool has_discs = HasWeight<typename Traits::Motion> || s.options().radius != 0;
    return table_answer<Encounters<Traits>>(
        source, detail::Encounter_columns{has_discs, PeriodicKineticTraits_2<Traits>}, s,
        settings.range);
  });
}

std::unique_ptr<Answer> contact_plan_answer(const Answer_settings& settings,
                                            const Any_simulation& simulation,
                                            const Run_source& /*source*/) {
  return simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) -> std::unique_ptr<Answer> {
    return std::make_unique<Contact_plan<Traits>>(s, settings.range);
  });
}

}  // namespace kinetri::app
