// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/packing.h"

#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

#include "kinetri/algebra/number_types.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/simulation/growth.h"
#include "kinetri/simulation/scenarios.h"
#include "kinetri/simulation/simulation_2.h"
#include "simulation/disc_boxes.h"

namespace kinetri {
namespace {

using Simulation = Simulation_2<Disc_kinetic_traits_2>;

// A stage of the growth: up to the fraction `part` of the final radii, in `steps` steps between
// which velocities are rescaled; the growth of the mean radius is `growth` times the mean speed.
// Dense discs must grow slowly. The numbers were chosen to reach the area fractions in packing.h;
// they are not optimal.
struct Stage {
  double part;
  int steps;
  double growth;
};
constexpr std::array<Stage, 3> stages = {{{0.75, 3, 0.2}, {0.9, 5, 0.04}, {1, 20, 0.015}}};

// Slightly larger radii at the end, so that the discs of the result are apart.
constexpr double enough = 1 + 0x1p-30;

class Packer {
 public:
  explicit Packer(const Packing_options& options)
      : options_(options),
        side_(options.side.value_or(10 * std::sqrt(static_cast<double>(options.points)))),
        motions_(random_motions(options.seed)),
        radii_(final_radii()),
        mean_radius_(std::accumulate(radii_.begin(), radii_.end(), 0.0) /
                     static_cast<double>(radii_.size())),
        simulation_(points(), simulation_options()),
        watch_(mean_radius_ * enough) {}

  Packing run() {
    double done = 0;
    for (const auto& [part, steps, growth] : stages) {
      const double begin = done;
      for (int step = 1; step <= steps; ++step) {
        const double end = step == steps ? part : begin + (part - begin) * step / steps;
        grow((end - done) * (end == 1 ? enough : 1), growth);
        done = end;
      }
    }
    return result();
  }

 private:
  std::vector<Linear_motion_2> random_motions(std::uint64_t seed) const {
    Scenario_options scenario;
    scenario.points = options_.points;
    scenario.seed = seed;
    scenario.side = side_;
    scenario.speed = options_.speed == 0 ? side_ : options_.speed;
    return make_scenario(Scenario::uniform, scenario);
  }

  std::vector<double> final_radii() const {
    std::vector<double> sizes(options_.points, 1.0);
    for (std::size_t i = 1; i < sizes.size(); i += 2) sizes[i] = options_.size_ratio;
    double area = 0;
    for (const double size : sizes) area += std::numbers::pi * size * size;
    const double unit = side_ * std::sqrt(options_.share / area);
    for (double& size : sizes) size *= unit;
    return sizes;
  }

  std::vector<Disc_motion_2> points() const {
    std::vector<Disc_motion_2> result;
    for (const Linear_motion_2& motion : motions_) result.push_back({motion, 0, 0, 0});
    return result;
  }

  Simulation_options simulation_options() const {
    Simulation_options result;
    result.box = box();
    result.rim_touches = true;
    result.response = collide_elastically;
    // Masses are proportional to areas.
    for (const double radius : radii_) {
      const double size = radius / radii_.front();
      result.masses.push_back(size * size);
    }
    return result;
  }

  Box_2 box() const { return {0, 0, side_, side_}; }

  // Lets the radii grow by the fraction `part` of the final ones.
  void grow(double part, double growth) {
    const double now = simulation_.current_time().to_double();
    std::vector<Point_id> ids(options_.points);
    std::iota(ids.begin(), ids.end(), Point_id{0});
    double squares = 0;
    for (const Point_id id : ids) {
      const Vector_2 v = simulation_.triangulation().motion(id).velocity;
      squares += simulation_.mass(id) * (v.x * v.x + v.y * v.y);
    }
    // Scales to the mean energy of a disc of mass 1 and speed 1.
    const double scale = 1 / std::sqrt(squares / static_cast<double>(options_.points));
    std::vector<Disc_motion_2> motions;
    for (const Point_id id : ids) {
      const Disc_motion_2& old = simulation_.triangulation().motion(id);
      Disc_motion_2 motion =
          with_velocity_at(old, {scale * old.velocity.x, scale * old.velocity.y}, now);
      motion.growth = growth * radii_[id] / mean_radius_;
      motions.push_back(motion);
    }
    simulation_.set_motions(ids, motions);
    const double end = now + part * mean_radius_ / growth;
    while (simulation_.step(Algebraic_number(end)) > 0) {
      if (watch_.is_jammed(simulation_)) {
        throw Packing_error(
            "the discs are jammed before they cover the share; expected a smaller "
            "share");
      }
    }
    simulation_.advance_to(end);
  }

  Packing result() const {
    const double now = simulation_.current_time().to_double();
    const std::vector<Linear_motion_2> velocities = random_motions(options_.seed + 1);
    Packing packing = {box(), {}};
    for (Point_id id = 0; id < options_.points; ++id) {
      const Vector_2 place = rounded_place(simulation_.triangulation().motion(id), now);
      const Vector_2 velocity = options_.speed == 0 ? Vector_2() : velocities[id].velocity;
      packing.discs.push_back({{place, velocity, 0}, radii_[id], 0, 0});
    }
    check(packing);
    return packing;
  }

  // Exactly, for all pairs whose bounding boxes intersect.
  static void check(const Packing& packing) {
    std::vector<detail::Disc_box> boxes;
    for (Point_id id = 0; id < packing.discs.size(); ++id) {
      const Disc_motion_2& disc = packing.discs[id];
      boxes.push_back(detail::box_around(disc, id, 0, {0, 0}));
      const Rational x = to_rational(disc.position.x);
      const Rational y = to_rational(disc.position.y);
      const Rational radius = to_rational(disc.radius);
      const Rational side = to_rational(packing.box.xmax);
      KINETRI_ASSERT(x >= radius && y >= radius && x + radius <= side && y + radius <= side,
                     "a disc of a packing is partly outside of the box");
    }
    detail::for_each_pair_of_boxes(boxes, [&](Point_id a, Point_id b) {
      const Disc_motion_2& p = packing.discs[a];
      const Disc_motion_2& q = packing.discs[b];
      const Rational x = to_rational(p.position.x) - to_rational(q.position.x);
      const Rational y = to_rational(p.position.y) - to_rational(q.position.y);
      const Rational contact = to_rational(p.radius) + to_rational(q.radius);
      KINETRI_ASSERT(x * x + y * y >= contact * contact, "two discs of a packing overlap");
    });
  }

  Packing_options options_;
  double side_;
  std::vector<Linear_motion_2> motions_;
  std::vector<double> radii_;
  double mean_radius_;
  Simulation simulation_;
  Jam_watch watch_;
};

}  // namespace

Packing make_packing(const Packing_options& options) {
  KINETRI_PRECONDITION(options.points > 0, "a packing of no discs");
  KINETRI_PRECONDITION(options.share > 0 && options.share < 1,
                       "the share of a packing is not between 0 and 1");
  KINETRI_PRECONDITION(options.size_ratio >= 1 && options.size_ratio <= 1000,
                       "the ratio of the sizes of a packing is not from 1 to 1000");
  return Packer(options).run();
}

}  // namespace kinetri
