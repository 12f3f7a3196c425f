// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tiny regular triangulation from bytes, of discs and points with weights that grow, shrink,
// come, turn, jump and go, with full audits against CGAL's static one; the same without filters.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "fuzz/fuzz.h"
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "support/kinetic_runs.h"

namespace kinetri {
namespace {

using test::Fuzz_input;
using test::require;
using Kinetic = Kinetic_regular_triangulation_2<>;

constexpr std::size_t most_points = 7;
constexpr int most_operations = 8;

Disc_motion_2 read_disc(Fuzz_input& input, double epoch) {
  Disc_motion_2 result;
  result.position.x = input.integer(-3, 3);
  result.position.y = input.integer(-3, 3);
  result.velocity.x = input.integer(-2, 2);
  result.velocity.y = input.integer(-2, 2);
  result.epoch = epoch;
  result.radius = input.integer(0, 3);
  result.growth = input.integer(-1, 1);
  result.weight = input.integer(-2, 2);
  return result;
}

std::vector<Point_id> ids_of(const Kinetic& kinetic) {
  std::vector<Point_id> result;
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (kinetic.contains(id)) result.push_back(id);
  }
  return result;
}

// A triangulation with filters, and one without.
class Run {
 public:
  Run(const std::vector<Disc_motion_2>& discs, const Algebraic_number& start)
      : kinetic_(discs, start), exact_(discs, start, Disc_kinetic_traits_2::exact()) {
    check();
  }

  // Goes on by so many halves of a unit of time, and looks between all events.
  void advance(int halves) {
    const Algebraic_number end(kinetic_.current_time().to_double() + halves / 2.0);
    if (end < kinetic_.current_time()) return;
    while (kinetic_.step(end) > 0) {
      exact_.step(end);
      check();
    }
    kinetic_.advance_to(end);
    exact_.advance_to(end);
    check();
  }

  void change(Fuzz_input& input) {
    const std::vector<Point_id> ids = ids_of(kinetic_);
    const int kind = input.integer(0, 4);
    const Disc_motion_2 disc = read_disc(input, input.integer(-1, 1));
    if (kind == 0) {
      if (ids.size() < most_points) in_both([&](Kinetic& kinetic) { kinetic.insert(disc); });
      return;
    }
    if (ids.empty()) return;
    const Point_id id = ids[static_cast<std::size_t>(input.byte()) % ids.size()];
    if (kind == 1) return in_both([&](Kinetic& kinetic) { kinetic.erase(id); });
    if (kind == 2) return in_both([&](Kinetic& kinetic) { kinetic.set_motion(id, disc); });
    if (kind == 3) {  // the disc alone changes
      Disc_motion_2 other = kinetic_.motion(id);
      other.radius = disc.radius;
      other.growth = disc.growth;
      other.weight = disc.weight;
      return in_both([&](Kinetic& kinetic) { kinetic.set_motion(id, other); });
    }
    in_both([](Kinetic& kinetic) { kinetic.reverse(); });
  }

 private:
  template <class Change>
  void in_both(const Change& change) {
    for (Kinetic* kinetic : {&kinetic_, &exact_}) change(*kinetic);
    check();
  }

  void check() {
    require(kinetic_.current_time() == exact_.current_time(), "another time without filters");
    const std::string problem = test::audit_problem(kinetic_, Audit_level::certificates);
    require(problem.empty(), problem + state());
    require(kinetic_.finite_edge_ids() == exact_.finite_edge_ids(), "other edges without filters");
    require(kinetic_.number_of_hidden_points() == exact_.number_of_hidden_points(),
            "other hidden points without filters");
  }

  std::string state() const {
    std::ostringstream out;
    for (const Point_id id : ids_of(kinetic_)) {
      out << '\n' << kinetic_.vertex(id)->point() << (kinetic_.is_hidden(id) ? " (hidden)" : "");
    }
    return out.str();
  }

  Kinetic kinetic_;
  Kinetic exact_;
};

}  // namespace
}  // namespace kinetri

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kinetri::test::Fuzz_input input(data, size);
  std::vector<kinetri::Disc_motion_2> discs;
  for (int points = input.integer(0, 6); points > 0; --points) {
    const auto disc = kinetri::read_disc(input, 0);
    const auto is_same = [&](const auto& other) { return same_trajectory(other, disc); };
    if (std::ranges::none_of(discs, is_same)) discs.push_back(disc);
  }
  kinetri::Run run(discs, kinetri::Algebraic_number(kinetri::Rational(input.integer(-2, 2), 2)));
  for (int i = 0; i < kinetri::most_operations && !input.at_end(); ++i) {
    if (input.integer(0, 2) == 0) {
      run.advance(input.integer(1, 4));
    } else {
      run.change(input);
    }
  }
  return 0;
}
