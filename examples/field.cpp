// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 14, fields: three corners of a square rest, and point 3 falls through the fourth one. Each
// point has a brightness. What is it between the points?
#include <kinetri/triangulation/field_2.h>
#include <kinetri/triangulation/kinetic_delaunay_triangulation_2.h>

#include <array>
#include <cmath>
#include <iostream>
#include <vector>

using Triangulation = kinetri::Kinetic_delaunay_triangulation_2<>;
using kinetri::Interpolation;

static void print_center(const Triangulation& kdt, const kinetri::Kinetic_field_2<>& field) {
  std::cout << "at t = " << kdt.current_time();
  std::cout << " flat " << (*field.at({1, 1}, Interpolation::flat))[0];
  std::cout << " linear " << (*field.at({1, 1}, Interpolation::linear))[0];
  std::cout << " smooth " << (*field.at({1, 1}, Interpolation::smooth))[0] << '\n';
}

static void print_picture(const kinetri::Kinetic_field_2<>& field) {
  // The first row is the upper one.
  const kinetri::Grid_2 grid = {{0.25, 2.25}, {0.5, -0.5}, 4, 5};
  std::vector<double> picture(grid.columns * grid.rows * field.channels());
  field.raster(grid, Interpolation::linear, picture);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (std::isnan(picture[i])) {
      std::cout << '-';
    } else {
      std::cout << picture[i];
    }
    std::cout << (i % grid.columns + 1 < grid.columns ? ' ' : '\n');
  }
}

int main() {
  const std::vector<kinetri::Linear_motion_2> motions = {
      {{0, 0}, {0, 0}}, {{2, 0}, {0, 0}}, {{2, 2}, {0, 0}}, {{0, 3}, {0, -1}}};
  Triangulation kdt(motions);

  // One channel. Point 1 stays at 8; point 3 gets brighter, from 6 at t = 0 by 2 per unit of time.
  kinetri::Kinetic_field_2<> field(kdt, 1);
  field.set_values(0, std::array{kinetri::Linear_value{0}});
  field.set_values(1, std::array{kinetri::Linear_value{8}});
  field.set_values(2, std::array{kinetri::Linear_value{0}});
  field.set_values(3, std::array{kinetri::Linear_value{6, 2}});

  kdt.advance_to(0.9375);
  print_center(kdt, field);
  kdt.advance_to(1);
  print_center(kdt, field);
  print_picture(field);

  // Outside of the convex hull there is nothing.
  std::cout << "outside: " << (field.at({3, 1}, Interpolation::linear) ? "a value" : "none")
            << '\n';
}
