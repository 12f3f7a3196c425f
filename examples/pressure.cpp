// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 17, periodic boxes: the pressure of a gas of hard discs, from the momenta that they
// exchange.
#include <kinetri/kinetic/periodic_kinetic_traits_2.h>
#include <kinetri/simulation/simulation_2.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <random>
#include <vector>

using Traits = kinetri::Periodic_kinetic_traits_2;
using Simulation = kinetri::Simulation_2<Traits>;
using kinetri::Vector_2;

// Adds up the products of the momenta that two discs exchange and of the vector between them.
class Virial : public kinetri::Event_observer {
 public:
  explicit Virial(Simulation& simulation) : simulation_(simulation) {
    simulation.add_observer(*this);
  }
  ~Virial() override { simulation_.remove_observer(*this); }

  void before_event(const kinetri::Event& event) override {
    if (event.kind == kinetri::Event_kind::collision) before_ = motion(*event.point_b).velocity;
  }
  void after_event(const kinetri::Event& event) override {
    if (event.kind != kinetri::Event_kind::collision) return;
    const double t = event.time.to_double();
    const auto& box = simulation_.triangulation().traits().box();
    // The image of the second disc that the first one has touched.
    const kinetri::Image_motion_2 image = {motion(*event.point_b), event.added_offset, &box};
    const Vector_2 a = rounded_place(motion(*event.point_a), t);
    const Vector_2 b = rounded_place(image, t);
    const Vector_2 after = image.motion.velocity;
    sum_ += (b.x - a.x) * (after.x - before_.x) + (b.y - a.y) * (after.y - before_.y);
  }
  double sum() const { return sum_; }

 private:
  const kinetri::Linear_motion_2& motion(kinetri::Point_id id) const {
    return simulation_.triangulation().motion(id);
  }
  Simulation& simulation_;
  Vector_2 before_;
  double sum_ = 0;
};

// Discs on a square lattice, which melts at once, get random velocities. Their sum is zero, so that
// the temperature is the kinetic energy divided by one less than the number of discs: 1.
static std::vector<kinetri::Linear_motion_2> gas(int side) {
  std::mt19937 random(1);
  std::vector<kinetri::Linear_motion_2> discs;
  Vector_2 mean;
  const auto number = [&] { return static_cast<double>(random()) / 0x1p31 - 1; };
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const Vector_2 velocity = {number(), number()};
      mean = {mean.x + velocity.x, mean.y + velocity.y};
      discs.push_back({{double(column), double(row)}, velocity});
    }
  }
  const auto size = static_cast<double>(discs.size());
  double squares = 0;
  for (auto& [position, velocity, epoch] : discs) {
    velocity = {velocity.x - mean.x / size, velocity.y - mean.y / size};
    squares += velocity.x * velocity.x + velocity.y * velocity.y;
  }
  const double scale = std::sqrt(2 * (size - 1) / squares);
  for (auto& disc : discs) disc.velocity = {scale * disc.velocity.x, scale * disc.velocity.y};
  return discs;
}

// The virial series of hard discs, with the coefficients of N. Clisby and B. M. McCoy, Journal of
// Statistical Physics 122 (2006), 15; and the equation of D. Henderson, Molecular Physics 30
// (1975), 971.
static double virial_series(double share) {
  constexpr std::array coefficients = {1.0,        0.7820044, 0.53223180, 0.33355604, 0.1988425,
                                       0.11486728, 0.0649930, 0.0362193,  0.0199537};
  double result = 1;
  double power = 1;
  for (const double coefficient : coefficients) result += coefficient * (power *= 2 * share);
  return result;
}
static double henderson(double share) {
  return (1 + share * share / 8) / ((1 - share) * (1 - share));
}

// Prints p A / (N k T) if discs cover this share of a square box with the given side.
static bool measure(double share, int side, double collisions) {
  const kinetri::Periodic_box_2 box({{double(side), 0}, {0, 0}}, {{0, double(side)}, {0, 0}});
  kinetri::Simulation_options options;
  options.radius = std::sqrt(share / std::numbers::pi);
  options.response = kinetri::collide_elastically;
  options.refuses_overlaps = true;
  Simulation simulation(gas(side), options, 0, Traits(box));
  Virial virial(simulation);

  const double number = side * side;
  constexpr int blocks = 20;
  // In which each disc has about so many collisions, by Enskog's rate.
  const double rate = 2 * (henderson(share) - 1) / options.radius / std::sqrt(std::numbers::pi);
  const double duration = collisions / rate / blocks;
  double mean = 0;
  double squares = 0;
  // The first four blocks are not counted.
  for (int block = -4; block < blocks; ++block) {
    const double before = virial.sum();
    simulation.advance_to((block + 5) * duration);
    if (block < 0) continue;
    const double compressibility = 1 + (virial.sum() - before) / (2 * number * duration);
    mean += compressibility / blocks;
    squares += compressibility * compressibility / blocks;
  }
  const double error = std::sqrt((squares - mean * mean) / (blocks - 1));
  std::printf("%.2f  %7.3f +- %.3f  %10.3f  %10.3f\n", share, mean, error, virial_series(share),
              henderson(share));
  return simulation.audit(kinetri::Audit_level::certificates).passed();
}

int main(int arguments, char** values) {
  const double collisions = arguments > 1 ? std::atof(values[1]) : 200;
  const int side = arguments > 2 ? std::atoi(values[2]) : 10;
  std::printf("share  p A / (N k T)    10 virials  Henderson\n");
  bool is_right = true;
  for (const double share : {0.3, 0.5, 0.69}) {
    is_right = measure(share, side, collisions) && is_right;
  }
  return is_right ? 0 : 1;
}
