// SPDX-License-Identifier: GPL-3.0-or-later
//
// Many operations on a set of a few hundred points: what is right stays right, and memory does
// not grow.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "support/live_bytes.h"
#include "support/motions.h"

namespace kinetri::soak_test {
namespace {

// A fifth of it where CGAL checks every step.
int number_of_operations() {
#ifdef NDEBUG
  return test::cases(100'000);
#else
  return test::cases(20'000);
#endif
}

constexpr double side = 100;
constexpr std::size_t least_points = 250;
constexpr std::size_t most_points = 350;

// Random motions in the square of width `side`: binary64 numbers, or so few small integers that
// points meet and many are cocircular.
class Motions {
 public:
  explicit Motions(unsigned seed) : random_(seed) {}

  Linear_motion_2 next(double now) {
    if (one_in(3)) {
      const auto place = [&] { return 5.0 * number(1, 19); };
      const auto component = [&] { return static_cast<double>(number(-2, 2)); };
      const double x = place();
      const double y = place();
      const double vx = component();
      return {{x, y}, {vx, component()}, std::floor(now)};
    }
    const double x = real(0, side);
    const double y = real(0, side);
    const double vx = real(-5, 5);
    return {{x, y}, {vx, real(-5, 5)}, now};
  }

  std::vector<Linear_motion_2> list(std::size_t n) {
    std::vector<Linear_motion_2> result;
    while (result.size() < n) {
      const Linear_motion_2 m = next(0);
      const auto is_same = [&](const Linear_motion_2& other) { return same_trajectory(m, other); };
      if (std::ranges::none_of(result, is_same)) result.push_back(m);
    }
    return result;
  }

  // Onward from where the point is; back to the square if it is outside.
  Linear_motion_2 turn(const Linear_motion_2& motion, double now) {
    const auto component = [](double place, double v) {
      return place < 0 ? std::abs(v) : place > side ? -std::abs(v) : v;
    };
    const Vector_2 place = rounded_place(motion, now);
    const Vector_2 velocity = next(now).velocity;
    return with_velocity_at(motion,
                            {component(place.x, velocity.x), component(place.y, velocity.y)}, now);
  }

  int number(int least, int greatest) {
    return std::uniform_int_distribution<int>(least, greatest)(random_);
  }
  bool one_in(int n) { return number(1, n) == 1; }
  double real(double least, double greatest) {
    return std::uniform_real_distribution<double>(least, greatest)(random_);
  }

 private:
  std::mt19937_64 random_;
};

/// The ids of the points that are there, as the events tell.
class Present_points : public Event_observer {
 public:
  using Triangulation = Kinetic_delaunay_triangulation_2<>;

  explicit Present_points(const Triangulation& triangulation) : triangulation_(triangulation) {
    for (Point_id id = 0; id < triangulation.next_id(); ++id) ids_.push_back(id);
  }

  void after_event(const Event& event) override {
    if (event.kind == Event_kind::insert) ids_.push_back(*event.point_a);
    for (const auto& id : {event.point_a, event.point_b}) {
      if (id && !triangulation_.contains(*id)) std::erase(ids_, *id);
    }
  }

  std::size_t size() const { return ids_.size(); }
  Point_id operator[](std::size_t i) const { return ids_[i]; }

 private:
  const Triangulation& triangulation_;
  std::vector<Point_id> ids_;
};

// Random operations on a run, with audits. The memory that it takes is that of the points that are
// there, but for tables of pointers by id, since ids are not used again.
template <class Run>
class Soak {
 public:
  Soak(Run& run, Motions& motions)
      : run_(run), motions_(motions), points_(run.triangulation()), table_(points_.size()) {
    run.add_observer(points_);
  }

  // The first tenth of the operations is not measured. It goes up to a hundred points more at
  // first, since containers keep the capacity of their peaks.
  void operate(int operations) {
    const auto started = Clock::now();
    for (int i = 1; i <= operations; ++i) {
      operate_once(i < operations / 20 ? 100 : 0);
      if (i % 4000 == 0) audit(i);
      if (testing::Test::HasFatalFailure()) return;
      if (i % (operations / 10) == 0) measure(i);
    }
    const double seconds = seconds_since(started) - seconds_of_audits_;
    std::printf("%.0f operations/s (%.1f s, and audits %.1f s), %d refused\n", operations / seconds,
                seconds, seconds_of_audits_, refused_);
    // Exact numbers take now more, now less: a fourth of all is for that.
    EXPECT_LT(bytes_.back(), bytes_.front() + bytes_.front() / 4)
        << "after " << run_.triangulation().next_id() << " insertions";
  }

 private:
  using Clock = std::chrono::steady_clock;

  static double seconds_since(Clock::time_point time) {
    return std::chrono::duration<double>(Clock::now() - time).count();
  }

  void audit(int i) {
    const auto started = Clock::now();
    const auto level = i % 100'000 == 0 ? Audit_level::certificates : Audit_level::reference;
    const Audit_report report = run_.audit(level);
    ASSERT_TRUE(report.passed()) << "operation " << i << ": " << report.failures.front();
    ASSERT_EQ(points_.size(), run_.triangulation().number_of_points());
    seconds_of_audits_ += seconds_since(started);
  }

  // The bytes for a number of points that is always the same.
  void measure(int i) {
    while (points_.size() != least_points) {
      points_.size() > least_points ? run_.erase(point()) : insert();
    }
    const std::size_t ids = run_.triangulation().next_id();
    while (table_.size() < ids) table_.emplace_back();
    const std::size_t table_bytes = table_.capacity() * sizeof(table_[0]);
    bytes_.push_back(test::live_bytes() - (1 + Run::tables) * table_bytes);
    std::printf("operation %8d: t = %9.3f, %zu bytes; %zu ids so far, their table %zu bytes\n", i,
                run_.triangulation().current_time().to_double(), bytes_.back(), ids, table_bytes);
  }

  void operate_once(std::size_t more_points) {
    const double now = present();
    try {
      const int kind = motions_.number(0, 99);
      if (kind < 45) {
        run_.step();
      } else if (kind < 50) {
        run_.advance_to(motions_.one_in(2) ? now + 0.01 : std::ceil(64 * now) / 64);
      } else if (kind < 70) {
        const Point_id id = point();
        run_.set_motion(id, motions_.turn(run_.triangulation().motion(id), now));
      } else if (kind < 80) {
        run_.set_motion(point(), motions_.next(now));
      } else if (points_.size() <= least_points + more_points ||
                 (points_.size() < most_points + more_points && motions_.one_in(2))) {
        insert();
      } else {
        run_.erase(point());
      }
    } catch (const Outside_box_error&) {
      ++refused_;
    }
  }

  void insert() { run_.insert(motions_.next(present())); }

  double present() const { return run_.triangulation().current_time().interval().upper; }

  Point_id point() {
    return points_[static_cast<std::size_t>(
        motions_.number(0, static_cast<int>(points_.size()) - 1))];
  }

  Run& run_;
  Motions& motions_;
  Present_points points_;
  std::vector<void*> table_;  // grows as those of the run
  std::vector<std::size_t> bytes_;
  double seconds_of_audits_ = 0;
  int refused_ = 0;
};

class Free_points {
 public:
  static constexpr std::size_t tables = 1;  // of vertices

  explicit Free_points(const std::vector<Linear_motion_2>& motions) : kinetic_(motions) {}

  const Present_points::Triangulation& triangulation() const { return kinetic_; }
  void add_observer(Present_points& points) { kinetic_.add_observer(points); }
  Audit_report audit(Audit_level level) const { return kinetic_.audit(level); }
  void step() { kinetic_.step(); }
  void advance_to(double time) { kinetic_.advance_to(time); }
  void set_motion(Point_id id, const Linear_motion_2& motion) { kinetic_.set_motion(id, motion); }
  void insert(const Linear_motion_2& motion) { kinetic_.insert(motion); }
  void erase(Point_id id) { kinetic_.erase(id); }

 private:
  Kinetic_delaunay_triangulation_2<> kinetic_;
};

TEST(Soak, of_many_operations_leaves_the_triangulation_right_and_small) {
  test::live_bytes();
  Motions motions(1);
  Free_points run(motions.list(most_points));
  Soak soak(run, motions);
  soak.operate(number_of_operations());
}

// Discs in a box: a third of the changes of points are scheduled, and some of these are of points
// that will have left by then, or lead out of the box.
class Discs {
 public:
  static constexpr std::size_t tables = 2;  // of vertices, and of contacts

  Discs(const std::vector<Linear_motion_2>& list, Motions& motions)
      : motions_(motions), simulation_(list, options()) {}

  const Present_points::Triangulation& triangulation() const { return simulation_.triangulation(); }
  void add_observer(Present_points& points) { simulation_.add_observer(points); }
  Audit_report audit(Audit_level level) const { return simulation_.audit(level); }
  void step() { simulation_.step(); }
  void advance_to(double time) { simulation_.advance_to(time); }

  void set_motion(Point_id id, const Linear_motion_2& motion) {
    if (!motions_.one_in(3)) return simulation_.set_motion(id, motion);
    const double time = later();
    simulation_.schedule_motion(time, id, scheduled(time));
  }
  void insert(const Linear_motion_2& motion) {
    if (!motions_.one_in(3)) return static_cast<void>(simulation_.insert(motion));
    const double time = later();
    const Point_id id = simulation_.schedule_insert(time, scheduled(time));
    if (motions_.one_in(4)) simulation_.schedule_erase(time + motions_.real(0, 1), id);
  }
  void erase(Point_id id) {
    motions_.one_in(3) ? simulation_.schedule_erase(later(), id) : simulation_.erase(id);
  }

 private:
  // Discs mostly collide; some go on through each other, and some vanish.
  static Contact_response_2 respond(const Contact_2& contact) {
    switch ((contact.point_a + contact.point_b) % 16) {
      case 0:
        return erase_both(contact);
      case 1:
        return log_contact(contact);
      default:
        return collide_elastically(contact);
    }
  }

  static Simulation_options options() {
    Simulation_options result;
    result.box = Box_2{0, 0, side, side};
    result.radius = 0.5;
    result.response = respond;
    return result;
  }

  double later() { return simulation_.current_time().interval().upper + motions_.real(0, 1); }

  Linear_motion_2 scheduled(double time) {
    Linear_motion_2 result = motions_.next(time);
    if (motions_.one_in(50)) result.position.x += side;
    return result;
  }

  Motions& motions_;
  Simulation_2<> simulation_;
};

TEST(Soak, of_many_operations_leaves_a_simulation_right_and_small) {
  test::live_bytes();
  Motions motions(2);
  const auto list = motions.list(most_points);
  Discs run(list, motions);
  Soak soak(run, motions);
  soak.operate(number_of_operations());
}

}  // namespace
}  // namespace kinetri::soak_test
