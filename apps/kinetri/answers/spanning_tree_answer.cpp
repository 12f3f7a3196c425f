// SPDX-License-Identifier: GPL-3.0-or-later
#include <optional>
#include <ostream>
#include <string_view>
#include <vector>

#include "answers/answer.h"
#include "cli/arguments.h"
#include "io/text.h"
#include "kinetri/observers/kinetic_spanning_tree_2.h"

namespace kinetri::app {
namespace {

template <class Traits>
class Spanning_tree_answer : public Answer {
 public:
  explicit Spanning_tree_answer(Simulation_2<Traits>& simulation)
      : tree_(simulation), start_(simulation.current_time()), at_start_(tree_.edges()) {}

  void write(std::ostream& out) override {
    out << "time_lo,time_hi,kind,a,b,length\n";
    for (const Edge_ids& edge : at_start_) row(out, start_, "start", edge);
    const auto longest = tree_.longest_edges();
    auto next = longest.begin();
    const auto write_longest = [&] {
      if (next->edge) row(out, next->time, "longest", *next->edge, next->length);
      ++next;
    };
    for (const auto& [time, removed, added] : tree_.changes()) {
      while (next != longest.end() && next->time < time) write_longest();
      for (const Edge_ids& edge : removed) row(out, time, "remove", edge);
      for (const Edge_ids& edge : added) row(out, time, "add", edge);
    }
    while (next != longest.end()) write_longest();
    const auto write_range = [&](std::string_view kind, const auto& found) {
      if (found) row(out, found->time, kind, found->edge, found->range.to_double());
    };
    write_range("least", tree_.least_connecting_range());
    write_range("greatest", tree_.greatest_connecting_range());
  }

 private:
  static void row(std::ostream& out, const Algebraic_number& time, std::string_view kind,
                  const Edge_ids& edge, std::optional<double> length = std::nullopt) {
    out << joined(time_bounds(time), ",", kind, ",", edge[0], ",", edge[1], ",");
    if (length) out << joined(*length);
    out << '\n';
  }

  Kinetic_spanning_tree_2<Traits> tree_;
  Algebraic_number start_;
  std::vector<Edge_ids> at_start_;
};

}  // namespace

std::unique_ptr<Answer> spanning_tree_answer(const Answer_settings& /*settings*/,
                                             const Any_simulation& simulation,
                                             const Run_source& /*source*/) {
  return simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) -> std::unique_ptr<Answer> {
    if constexpr (!HasWeight<typename Traits::Motion>) {
      return std::make_unique<Spanning_tree_answer<Traits>>(s);
    } else {
      throw Usage_error(
          "--spanning-tree: the triangulation is one of discs of different sizes, which need not "
          "have the tree of their centres; expected points, or discs of one size");
    }
  });
}

}  // namespace kinetri::app
