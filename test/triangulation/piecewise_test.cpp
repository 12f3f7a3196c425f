// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points that come, turn, jump and go, by hand or by schedule, against the brute-force simulator:
// the edges between all the times at which they may change, and the log of events. On grids so
// coarse that most instants are degenerate, with changes at exactly such instants.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

#include "support/brute_force_simulator.h"
#include "support/kinetic_runs.h"

namespace kinetri::piecewise_test {
namespace {

using test::Kinetic_delaunay;
using test::Kinetic_event;
using Simulation = Simulation_2<>;

bool is_of_points(const Kinetic_event& event) {
  return event.kind >= Event_kind::wall;
}

// Reads the log of a run beside the brute-force simulator. Each function says what is wrong, or
// nothing.
class Log_reader : public Event_observer {
 public:
  explicit Log_reader(const Kinetic_delaunay& kinetic)
      : kinetic_(kinetic), oracle_(kinetic.current_time()), edges_(test::edges_of(kinetic)) {
    for (Point_id id = 0; id < kinetic.next_id(); ++id) {
      oracle_.set_motion(id, kinetic.motion(id));
    }
  }

  void after_event(const Kinetic_event& event) override { log_.push_back(event); }

  const test::Brute_force_simulator& oracle() const { return oracle_; }

  // What happened up to `end` by itself, before the points that change at `end`.
  std::string problem_until(const Algebraic_number& end) {
    if (others_turn_now_ && end == oracle_.time()) return {};
    std::string problem = problem_of_edges();
    while (problem.empty() && !oracle_.critical_times().empty() &&
           oracle_.critical_times().front() <= end) {
      oracle_.advance_to(Algebraic_number(oracle_.critical_times().front()));
      const std::set<Edge_ids> before = edges_;
      const std::size_t first = read_;
      while (problem.empty() && is_next_now() && !is_of_points(log_[read_])) problem = read_edge();
      // Where the edges are right as they were, no certificate has failed.
      if (read_ > first && edges_ == before) return "events that change nothing" + now();
      if (problem.empty()) problem = problem_of_edges();
    }
    oracle_.advance_to(end);
    if (problem.empty() && read_ < log_.size() && !is_of_points(log_[read_]) &&
        log_[read_].time <= end) {
      return "an event at no critical time, or a second time" + now();
    }
    return problem;
  }

  // The next event is this change of a point, at the present time of the simulator, and what
  // follows reports all edges that change by it, each once.
  std::string problem_of_change(Event_kind kind, Point_id id,
                                const std::optional<Linear_motion_2>& motion) {
    if (!is_next_now()) return "a change without an event" + now();
    const Kinetic_event& event = log_[read_];
    if (event.kind != kind || event.point_a != id || event.point_b || event.removed ||
        event.added || event.number != read_) {
      return "the event of another change" + now();
    }
    ++read_;
    motion ? oracle_.set_motion(id, *motion) : oracle_.erase(id);
    // Points that turn at one time do so together: the edges come after the last of them.
    if (kind == Event_kind::trajectory && is_next_now() && log_[read_].kind == kind &&
        *log_[read_].point_a > id) {
      others_turn_now_ = true;
      return {};
    }
    others_turn_now_ = false;
    const std::set<Edge_ids> before = edges_;
    const std::size_t first = read_;
    while (is_next_now() && !is_of_points(log_[read_])) {
      if (log_[read_].kind != Event_kind::rebuild) return "a change that goes on as events" + now();
      const std::string problem = read_edge();
      if (!problem.empty()) return problem;
    }
    std::set<Edge_ids> changed;
    std::ranges::set_symmetric_difference(before, edges_, std::inserter(changed, changed.end()));
    if (changed.size() != read_ - first) return "an edge that is reported in vain" + now();
    return problem_of_edges();
  }

  // All of the log has been read, and is about the triangulation as it is.
  std::string problem_now() const {
    if (read_ != log_.size()) return "events left over" + now();
    if (kinetic_.current_time() != oracle_.time()) return "another present time" + now();
    if (edges_ != test::edges_of(kinetic_)) return "a log that does not add up" + now();
    if (kinetic_.number_of_points() != oracle_.motions().size()) return "a wrong number of points";
    for (const auto& [id, motion] : oracle_.motions()) {
      if (!kinetic_.contains(id) || kinetic_.motion(id) != motion) return "another motion" + now();
    }
    return test::audit_problem(kinetic_, Audit_level::reference);
  }

 private:
  bool is_next_now() const { return read_ < log_.size() && log_[read_].time == oracle_.time(); }

  std::string read_edge() {
    const Kinetic_event& event = log_[read_++];
    if (event.number + 1 != read_) return "events numbered wrongly" + now();
    if (!event.removed && !event.added) return "an event without an edge" + now();
    if (event.removed && edges_.erase(*event.removed) == 0) return "removes no edge" + now();
    if (event.added && !edges_.insert(*event.added).second) return "adds an edge again" + now();
    return {};
  }

  std::string problem_of_edges() const {
    if (edges_ != oracle_.edges()) return "wrong edges" + now();
    return {};
  }

  std::string now() const {
    std::ostringstream text;
    text << " just after " << oracle_.time();
    return text.str();
  }

  const Kinetic_delaunay& kinetic_;
  test::Brute_force_simulator oracle_;
  std::set<Edge_ids> edges_;  // as the log has left them
  std::vector<Kinetic_event> log_;
  std::size_t read_ = 0;
  bool others_turn_now_ = false;  // together with the last change that has been read
};

struct Grid {
  int points;
  int width;
  int height;
  int speed;

  friend std::ostream& operator<<(std::ostream& out, const Grid& grid) {
    return out << grid.points << " points, " << grid.width << " x " << grid.height << ", speed "
               << grid.speed;
  }
};

unsigned number_of_cases(const Grid& grid) {
  return test::cases(grid.points < 6 ? 12u : 4u);
}

// Random numbers and motions on a grid.
class Choices {
 public:
  Choices(const Grid& grid, unsigned seed) : grid_(grid), random_(seed) {}

  int number(int least, int greatest) {
    return std::uniform_int_distribution<int>(least, greatest)(random_);
  }

  bool one_in(int n) { return number(1, n) == 1; }

  // From a place of the grid at `epoch` on; of a flat grid mostly along it.
  Linear_motion_2 motion(double epoch) {
    const bool is_flat = grid_.height == 1 && !one_in(8);
    const auto component = [&] { return static_cast<double>(number(-grid_.speed, grid_.speed)); };
    const double x = number(0, grid_.width - 1);
    const double y = number(0, grid_.height - 1);
    const double vx = component();
    return {{x, y}, {vx, is_flat ? 0 : component()}, epoch};
  }

  std::vector<Linear_motion_2> motions() {
    std::vector<Linear_motion_2> result;
    while (result.size() < static_cast<std::size_t>(grid_.points)) {
      const Linear_motion_2 candidate = motion(0);
      const auto is_same = [&](const Linear_motion_2& m) { return same_trajectory(m, candidate); };
      if (std::ranges::none_of(result, is_same)) result.push_back(candidate);
    }
    return result;
  }

  // One of the points; none if there is none.
  std::optional<Point_id> point(const std::map<Point_id, Linear_motion_2>& motions) {
    if (motions.empty()) return std::nullopt;
    return std::next(motions.begin(), number(0, static_cast<int>(motions.size()) - 1))->first;
  }

 private:
  Grid grid_;
  std::mt19937_64 random_;
};

bool is_taken(const std::map<Point_id, Linear_motion_2>& motions, Point_id by_other_than,
              const Linear_motion_2& motion) {
  return std::ranges::any_of(motions, [&](const auto& entry) {
    return entry.first != by_other_than && same_trajectory(entry.second, motion);
  });
}

// At which instants points have changed.
struct Coverage {
  int at_critical_times = 0;  // changes there
  int at_meetings = 0;        // changes while points coincide
  int of_few = 0;             // changes in sets of up to two points
  int collinear = 0;          // changes in sets of three and more that are collinear for a while
  int refused = 0;

  void note(const test::Brute_force_simulator& oracle, bool is_critical) {
    const std::size_t n = oracle.motions().size();
    at_critical_times += is_critical ? 1 : 0;
    of_few += n <= 2 ? 1 : 0;
    collinear += n > 2 && oracle.edges().size() == n - 1 ? 1 : 0;
    if (!oracle.time().is_known_rational()) return;
    std::set<test::Static_point> places;
    for (const auto& [id, m] : oracle.motions()) {
      places.insert(test::place_at(m, oracle.time().rational()));
    }
    at_meetings += places.size() < n ? 1 : 0;
  }
};

void expect_degenerate_changes(const Coverage& coverage, const Grid& grid) {
  EXPECT_TRUE(coverage.at_critical_times > 0 || grid.points <= 1);
  EXPECT_TRUE(coverage.of_few > 0 || grid.points > 2);
  EXPECT_TRUE(coverage.at_meetings > 0 || grid.points <= 2);
  EXPECT_TRUE(coverage.collinear > 0 || grid.points <= 2 || grid.height > 1);
}

// ---- changes by hand ----

class Run_by_hand {
 public:
  Run_by_hand(const Grid& grid, unsigned seed, Coverage& coverage)
      : choices_(grid, seed),
        coverage_(coverage),
        kinetic_(choices_.motions(), {}, {}, Coincident_points::refuse),
        reader_(kinetic_) {
    kinetic_.add_observer(reader_);
  }

  std::string problem(int operations) {
    for (int i = 0; i < operations; ++i) {
      std::string found = operate();
      if (found.empty()) found = reader_.problem_now();
      if (!found.empty()) return "operation " + std::to_string(i) + ": " + found;
    }
    const auto& rest = reader_.oracle().critical_times();
    if (!rest.empty()) {
      const std::string found = advance_to(Algebraic_number(rest.back()));
      if (!found.empty()) return found;
    }
    if (kinetic_.next_event_time()) return "an event after the last critical time";
    return reader_.problem_now();
  }

 private:
  std::string operate() {
    const auto& oracle = reader_.oracle();
    switch (choices_.number(0, 7)) {
      case 0: {
        // To any of the next few critical times, mostly without an event.
        const auto& times = oracle.critical_times();
        if (times.empty()) return {};
        const int last = std::min(3, static_cast<int>(times.size()) - 1);
        return advance_to(
            Algebraic_number(times[static_cast<std::size_t>(choices_.number(0, last))]));
      }
      case 1: {
        const double now = kinetic_.current_time().interval().upper;
        return advance_to(Algebraic_number(std::floor(now) + choices_.number(4, 8) / 4.0));
      }
      case 2:
      case 3:
        return step();
      case 4:
        if (oracle.motions().size() > 6) return {};
        return change(Event_kind::insert, static_cast<Point_id>(kinetic_.next_id()));
      case 5: {
        const auto id = choices_.point(oracle.motions());
        return id ? change(Event_kind::erase, *id) : std::string();
      }
      default: {
        const auto id = choices_.point(oracle.motions());
        return id ? change(Event_kind::trajectory, *id) : std::string();
      }
    }
  }

  std::string advance_to(const Algebraic_number& time) {
    const auto& times = reader_.oracle().critical_times();
    is_critical_ = std::ranges::binary_search(times, time);
    kinetic_.advance_to(time);
    return reader_.problem_until(time);
  }

  std::string step() {
    const auto announced = kinetic_.next_event_time();
    const std::size_t events = kinetic_.step();
    if (!announced) return events == 0 ? "" : "an event that was not announced";
    // A time at which points meet without an event is announced, and passed.
    if (kinetic_.current_time() < *announced) return "a step to before the time that was announced";
    is_critical_ = true;
    return reader_.problem_until(kinetic_.current_time());
  }

  // From its place at the present time, where that is one of the grid, or to another place.
  Linear_motion_2 new_motion(Event_kind kind, Point_id id) {
    const double t = kinetic_.current_time().to_double();
    Linear_motion_2 motion = choices_.motion(choices_.one_in(3) ? 0 : std::floor(t));
    if (kind == Event_kind::trajectory && choices_.one_in(2)) {
      motion = with_velocity_at(kinetic_.motion(id), motion.velocity, t);
    }
    return motion;
  }

  std::string change(Event_kind kind, Point_id id) {
    const auto& motions = reader_.oracle().motions();
    coverage_.note(reader_.oracle(), is_critical_);
    if (kind == Event_kind::erase) {
      kinetic_.erase(id);
      return reader_.problem_of_change(kind, id, std::nullopt);
    }
    const Linear_motion_2 motion = new_motion(kind, id);
    const auto make = [&] {
      kind == Event_kind::insert ? static_cast<void>(kinetic_.insert(motion))
                                 : kinetic_.set_motion(id, motion);
    };
    if (is_taken(motions, id, motion)) {
      ++coverage_.refused;
      EXPECT_THROW(make(), Coincident_trajectories_error);
      return {};
    }
    make();
    return reader_.problem_of_change(kind, id, motion);
  }

  Choices choices_;
  Coverage& coverage_;
  Kinetic_delaunay kinetic_;
  Log_reader reader_;
  bool is_critical_ = false;  // the present time, for the motions up to it
};

class Piecewise_motion : public testing::TestWithParam<Grid> {};

TEST_P(Piecewise_motion, by_hand_is_that_of_the_brute_force_simulator) {
  Coverage coverage;
  for (unsigned seed = 0; seed < number_of_cases(GetParam()); ++seed) {
    Run_by_hand run(GetParam(), seed, coverage);
    ASSERT_EQ(run.problem(30), "") << "seed " << seed;
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  expect_degenerate_changes(coverage, GetParam());
}

// ---- changes by schedule ----

struct Scheduled_change {
  Algebraic_number time;
  Event_kind kind;
  Point_id id;
  std::optional<Linear_motion_2> motion;
};

// Of one time: those that erase first, then those that turn, then those that insert, then by id.
bool is_before(const Scheduled_change& a, const Scheduled_change& b) {
  const auto rank = [](Event_kind kind) {
    return kind == Event_kind::erase ? 0 : kind == Event_kind::trajectory ? 1 : 2;
  };
  if (a.time != b.time) return a.time < b.time;
  return std::pair(rank(a.kind), a.id) < std::pair(rank(b.kind), b.id);
}

class Run_by_schedule {
 public:
  Run_by_schedule(const Grid& grid, unsigned seed, Coverage& coverage)
      : choices_(grid, seed),
        coverage_(coverage),
        simulation_(choices_.motions(), {}),
        reader_(simulation_.triangulation()) {
    simulation_.add_observer(reader_);
    schedule();
  }

  std::string problem() {
    while (true) {
      if (choices_.one_in(3)) {
        simulation_.advance_to(simulation_.current_time().interval().upper + 0.5);
      } else if (simulation_.step() == 0) {
        break;
      }
      std::string found = problem_until(simulation_.current_time());
      if (found.empty()) found = reader_.problem_now();
      if (!found.empty()) return found;
    }
    // What is left are times without an event, and changes of points that are not there.
    Algebraic_number end = simulation_.current_time();
    const auto& rest = reader_.oracle().critical_times();
    if (!rest.empty()) end = rest.back();
    if (!changes_.empty()) end = std::max(end, changes_.back().time);
    if (simulation_.advance_to(end) != 0) return "an event that was not announced";
    const std::string found = problem_until(end);
    return found.empty() ? reader_.problem_now() : found;
  }

 private:
  // Many of the changes are at times that are critical for the motions of the start.
  void schedule() {
    const std::vector<Algebraic_number> critical = reader_.oracle().critical_times();
    auto next_id = static_cast<int>(simulation_.triangulation().next_id());
    for (int i = 0; i < 8; ++i) {
      Algebraic_number time(choices_.number(0, 12) / 4.0);
      if (!critical.empty() && choices_.one_in(2)) {
        const int last = std::min(15, static_cast<int>(critical.size()) - 1);
        time = critical[static_cast<std::size_t>(choices_.number(0, last))];
      }
      const int kind = choices_.number(0, 3);
      if (kind == 0) {
        changes_.push_back({time, Event_kind::insert, static_cast<Point_id>(next_id++), {}});
      } else if (next_id > 0) {
        // Of points, too, that are not there yet, or no longer.
        const auto id = static_cast<Point_id>(choices_.number(0, next_id - 1));
        changes_.push_back({time, kind == 1 ? Event_kind::erase : Event_kind::trajectory, id, {}});
      }
    }
    std::ranges::stable_sort(changes_, is_before);
    choose_motions();
    std::map<Point_id, const Scheduled_change*> inserts;
    for (const Scheduled_change& change : changes_) {
      if (change.kind == Event_kind::insert) inserts[change.id] = &change;
    }
    for (const auto& [id, change] : inserts) {
      EXPECT_EQ(simulation_.schedule_insert(change->time, *change->motion), id);
    }
    for (const Scheduled_change& change : changes_) {
      if (change.kind == Event_kind::trajectory) {
        simulation_.schedule_motion(change.time, change.id, *change.motion);
      } else if (change.kind == Event_kind::erase) {
        simulation_.schedule_erase(change.time, change.id);
      }
    }
  }

  // Motions that are those of no other point when their time has come.
  void choose_motions() {
    std::map<Point_id, Linear_motion_2> motions = reader_.oracle().motions();
    for (Scheduled_change& change : changes_) {
      if (change.kind == Event_kind::erase) {
        motions.erase(change.id);
        continue;
      }
      do {
        change.motion = choices_.motion(std::floor(change.time.to_double()));
      } while (is_taken(motions, change.id, *change.motion));
      if (change.kind == Event_kind::insert || motions.contains(change.id)) {
        motions[change.id] = *change.motion;
      }
    }
  }

  // The log up to the present time of the simulation, with the changes that were due.
  std::string problem_until(const Algebraic_number& end) {
    for (; done_ < changes_.size() && changes_[done_].time <= end; ++done_) {
      const auto& [time, kind, id, motion] = changes_[done_];
      const auto& critical = reader_.oracle().critical_times();
      const bool is_critical = std::ranges::binary_search(critical, time);
      std::string found = reader_.problem_until(time);
      const bool is_there = reader_.oracle().motions().contains(id);
      if (found.empty() && (kind == Event_kind::insert || is_there)) {
        coverage_.note(reader_.oracle(), is_critical);
        found = reader_.problem_of_change(kind, id, motion);
      }
      if (!found.empty()) return found;
    }
    return reader_.problem_until(end);
  }

  Choices choices_;
  Coverage& coverage_;
  Simulation simulation_;
  Log_reader reader_;
  std::vector<Scheduled_change> changes_;  // in the order in which they shall be made
  std::size_t done_ = 0;
};

TEST_P(Piecewise_motion, by_schedule_is_that_of_the_brute_force_simulator) {
  Coverage coverage;
  for (unsigned seed = 0; seed < number_of_cases(GetParam()); ++seed) {
    Run_by_schedule run(GetParam(), seed, coverage);
    ASSERT_EQ(run.problem(), "") << "seed " << seed;
  }
  expect_degenerate_changes(coverage, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Grids, Piecewise_motion,
                         testing::Values(Grid{0, 2, 2, 1}, Grid{1, 3, 1, 1}, Grid{2, 2, 2, 1},
                                         Grid{3, 4, 1, 1}, Grid{4, 2, 2, 1}, Grid{4, 3, 3, 1},
                                         Grid{5, 3, 3, 1}, Grid{5, 5, 5, 2}, Grid{6, 4, 4, 1}));

}  // namespace
}  // namespace kinetri::piecewise_test
