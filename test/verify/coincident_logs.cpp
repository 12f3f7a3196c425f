// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the logs of small runs whose points often get the motion of another one, for
// coincident_test.py.
//
// usage: kinetri_coincident_logs FOLDER FIRST_SEED NUMBER
//
// For each seed: SEED.motions.csv, SEED.events.csv, SEED.initial.csv and SEED.edges.csv in the
// folder, and a line on standard output: the seed, and arguments of kinetri-verify. No line if
// there are very many events.
#include <algorithm>
#include <cstddef>
#include <fstream>
#include <iostream>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "kinetri/io/edges_file.h"
#include "kinetri/io/event_log.h"
#include "kinetri/io/motion_log.h"
#include "kinetri/simulation/simulation_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"

namespace kinetri {
namespace {

class Choices {
 public:
  explicit Choices(unsigned seed) : random_(seed) {}
  // Less than `limit`.
  std::size_t any(std::size_t limit) { return random_() % limit; }
  double whole(int lowest, int highest) {
    return lowest + static_cast<double>(any(static_cast<std::size_t>(highest - lowest) + 1));
  }

 private:
  std::mt19937 random_;
};

// A point of a tiny grid at the time `now`, with a small velocity; the representation varies.
template <class Motion>
Motion any_motion(Choices& choices, double now, double spacing) {
  const Vector_2 place = {spacing * choices.whole(0, 2), spacing * choices.whole(0, 2)};
  const Vector_2 velocity = {choices.whole(-1, 1), choices.whole(-1, 1)};
  const double before = choices.whole(0, 2);
  const Linear_motion_2 center = {
      {place.x - before * velocity.x, place.y - before * velocity.y}, velocity, now - before};
  if constexpr (HasWeight<Motion>) {
    const double growth = choices.any(4) == 0 ? spacing / 16 : 0;
    const double radius = spacing / 4 * (1 + choices.whole(0, 1));
    return {center, radius, growth};
  } else {
    return center;
  }
}

// A triangulation or a simulation of points, which are often copies of others.
template <class Made>
class Run {
 public:
  using Motion = typename Made::Motion;

  template <class Make>
  Run(Choices& choices, double spacing, const Make& make)
      : choices_(choices), spacing_(spacing), made_(make(start())) {}

  // Writes the files. Returns the time at the end; none if there are very many events.
  std::optional<double> write(const std::string& path, double radius) {
    std::ofstream events(path + ".events.csv");
    std::ofstream motions(path + ".motions.csv");
    Event_log_writer event_log(events);
    Motion_log_writer motion_log(motions, kinetic(), radius);
    write_edges_to(path + ".initial.csv");
    made_.add_observer(event_log);
    made_.add_observer(motion_log);
    try {
      for (int step = 0; step < 12; ++step) {
        if (!take_step()) return std::nullopt;
      }
      if (!advance(0.5)) return std::nullopt;
    } catch (const Endless_contacts_error&) {
      return std::nullopt;
    }
    write_edges_to(path + ".edges.csv");
    return now_;
  }

 private:
  static constexpr bool is_simulation = requires(const Made& made) {
    made.triangulation().motion(0);
  };

  const auto& kinetic() const {
    if constexpr (is_simulation) {
      return made_.triangulation();
    } else {
      return made_;
    }
  }

  std::vector<Motion> start() {
    std::vector<Motion> motions;
    const std::size_t n = 1 + choices_.any(9);
    for (std::size_t i = 0; i < n; ++i) {
      const bool is_copy = i > 0 && choices_.any(3) == 0;
      motions.push_back(is_copy ? motions[choices_.any(i)] : other_motion());
    }
    return motions;
  }

  Motion other_motion() { return any_motion<Motion>(choices_, now_, spacing_); }

  void write_edges_to(const std::string& path) const {
    std::ofstream out(path);
    write_edges(out, kinetic().finite_edge_ids());
  }

  // The ids of the points, shuffled.
  std::vector<Point_id> ids() {
    std::vector<Point_id> result;
    for (Point_id id = 0; id < kinetic().next_id(); ++id) {
      if (kinetic().contains(id)) result.push_back(id);
    }
    for (std::size_t k = result.size(); k > 1; --k) {
      std::swap(result[k - 1], result[choices_.any(k)]);
    }
    return result;
  }

  // Often those of other points.
  std::vector<Motion> motions(std::size_t count) {
    const std::vector<Point_id> present = ids();
    std::vector<Motion> result;
    while (result.size() < count) {
      const bool is_copy = !present.empty() && choices_.any(3) > 0;
      result.push_back(is_copy ? kinetic().motion(present[choices_.any(present.size())])
                               : other_motion());
    }
    return result;
  }

  // Returns false if there are very many events.
  bool take_step() {
    std::vector<Point_id> some = ids();
    const std::size_t choice = choices_.any(8);
    if (choice < 2 || some.empty()) {
      const std::vector<Motion> more = motions(1 + choices_.any(3));
      if constexpr (is_simulation) {
        for (const Motion& motion : more) made_.insert(motion);
      } else {
        made_.insert(more);
      }
    } else if (choice == 2 && some.size() > 3) {
      some.resize(1 + choices_.any(3));
      if constexpr (is_simulation) {
        for (const Point_id id : some) made_.erase(id);
      } else {
        made_.erase(some);
      }
    } else if (choice < 5) {
      made_.set_motion(some.front(), motions(1).front());
    } else if (choice == 5) {
      some.resize(1 + choices_.any(some.size()));
      made_.set_motions(some, motions(some.size()));
    } else {
      return advance(0.5 * choices_.whole(1, is_simulation ? 12 : 3));
    }
    return true;
  }

  // As take_step().
  bool advance(double by) {
    now_ += by;
    const Algebraic_number until(now_);
    for (std::size_t events = 0, more = 1; more > 0; events += more) {
      if (events > 1000) return false;
      more = made_.step(until);
    }
    made_.advance_to(until);
    return true;
  }

  Choices& choices_;
  double spacing_;
  double now_ = 0;
  Made made_;
};

template <class Traits>
std::optional<double> write_run(Choices& choices, const std::string& path) {
  using Made = Kinetic_triangulation_2<Traits>;
  return Run<Made>(choices, 1, [](const auto& motions) { return Made(motions); }).write(path, 0);
}

// Discs in a box that are apart at the start unless they coincide. Appends to `verify` the options
// of kinetri-verify.
template <class Traits>
std::optional<double> write_simulation(Choices& choices, const std::string& path,
                                       std::string& verify) {
  using Made = Simulation_2<Traits>;
  constexpr double spacing = 4;
  Simulation_options options;
  options.max_contacts_per_instant = 1000;
  const Named_response& named = named_responses[choices.any(named_responses.size())];
  options.response = named.response;
  if (!HasWeight<typename Traits::Motion>) options.radius = choices.any(2) == 0 ? 0.5 : 1;
  verify += " --collisions " + std::string(named.name);
  if (choices.any(2) == 0) {
    options.box = Box_2{-spacing, -spacing, 3 * spacing, 3 * spacing};
    verify += " --box=-4,-4,12,12";
  }
  return Run<Made>(choices, spacing, [&](const auto& motions) { return Made(motions, options); })
      .write(path, options.radius);
}

}  // namespace
}  // namespace kinetri

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: kinetri_coincident_logs FOLDER FIRST_SEED NUMBER\n";
    return 2;
  }
  const auto first = static_cast<unsigned>(std::stoul(argv[2]));
  const auto number = static_cast<unsigned>(std::stoul(argv[3]));
  for (unsigned seed = first; seed < first + number; ++seed) {
    const std::string path = std::string(argv[1]) + "/" + std::to_string(seed);
    kinetri::Choices choices(seed);
    std::string verify;
    std::optional<double> end;
    switch (seed % 4) {
      case 0:
        end = kinetri::write_run<kinetri::Linear_kinetic_traits_2>(choices, path);
        break;
      case 1:
        end = kinetri::write_run<kinetri::Disc_kinetic_traits_2>(choices, path);
        break;
      case 2:
        end = kinetri::write_simulation<kinetri::Linear_kinetic_traits_2>(choices, path, verify);
        break;
      default:
        end = kinetri::write_simulation<kinetri::Disc_kinetic_traits_2>(choices, path, verify);
    }
    if (end) std::cout << seed << " --until " << *end << verify << "\n";
  }
}
