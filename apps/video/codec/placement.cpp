// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/codec/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri::video {
namespace {

constexpr double least_distance = 2;
// The side in pixels of the squares of large triangles that each get a point in one round.
constexpr std::size_t square_side = 16;

// The sum of squared errors in a triangle, and the position of the largest error.
struct Worst {
  double sum = 0;
  double largest = 0;
  std::size_t pixel = 0;
};

double squared_distance(const Vector_2& p, const Vector_2& q) {
  return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
}

// The corners of the stage, which every key has.
std::vector<Place> corner_places(const Stream_header& header) {
  const auto corners = header.corners();
  return {corners.begin(), corners.end()};
}

}  // namespace

Vector_2 position_of(const Stream_header& header, const Place& place) {
  const double unit = std::ldexp(1.0, -static_cast<int>(header.place_bits));
  return {place.x * unit, place.y * unit};
}

Place place_at(const Stream_header& header, const Vector_2& position) {
  const double units = std::ldexp(1.0, static_cast<int>(header.place_bits));
  const auto nearest = [&](double coordinate, std::int32_t least, std::int32_t most) {
    return static_cast<std::int32_t>(std::clamp(std::floor(coordinate * units + 0.5),
                                                static_cast<double>(least),
                                                static_cast<double>(most)));
  };
  return {nearest(position.x, header.left(), header.right()),
          nearest(position.y, header.top(), header.bottom())};
}

double sample_at(const Stream_header& header, const Frame& frame, std::size_t plane,
                 const Vector_2& position) {
  const Grid_2 grid = header.format.grid(plane, header.format);
  const double column = std::clamp((position.x - grid.origin.x) / grid.step.x, 0.0,
                                   static_cast<double>(grid.columns - 1));
  const double row = std::clamp((position.y - grid.origin.y) / grid.step.y, 0.0,
                                static_cast<double>(grid.rows - 1));
  const auto i = std::min(static_cast<std::size_t>(column), grid.columns - 1);
  const auto j = std::min(static_cast<std::size_t>(row), grid.rows - 1);
  const std::size_t right = std::min(i + 1, grid.columns - 1);
  const std::size_t below = std::min(j + 1, grid.rows - 1);
  const double u = column - static_cast<double>(i);
  const double v = row - static_cast<double>(j);
  const auto& samples = frame.planes[plane];
  const auto at = [&](std::size_t x, std::size_t y) { return samples[y * grid.columns + x]; };
  return (1 - v) * ((1 - u) * at(i, j) + u * at(right, j)) +
         v * ((1 - u) * at(i, below) + u * at(right, below));
}

void sort_places(const Stream_header& header, std::span<Place> places) {
  // Each strip runs in the opposite direction to the previous one.
  const double area = static_cast<double>(header.right()) * header.bottom();
  const double count = static_cast<double>(std::max<std::size_t>(places.size(), 1));
  const auto height = static_cast<std::int32_t>(std::max(1.0, std::sqrt(area / count) * 2));
  std::ranges::sort(places, {}, [&](const Place& p) {
    const std::int32_t strip = p.y / height;
    return std::array{strip, strip % 2 == 0 ? p.x : -p.x, p.y};
  });
}

std::vector<Candidate> candidates(const Stream_header& header,
                                  std::span<const Corner_weights> weights,
                                  std::span<const double> error,
                                  std::span<const Vector_2> positions) {
  const Grid_2 grid = header.format.grid(0, header.format);
  // By the corners and the number of the square.
  std::map<std::pair<std::array<Point_id, 3>, std::size_t>, Worst> worst;
  std::size_t square = 0;
  Worst* here = nullptr;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const auto& corners = weights[i].corners;
    const std::size_t square_before = square;
    square = i / grid.columns / square_side * grid.columns + i % grid.columns / square_side;
    if (i == 0 || square != square_before || corners != weights[i - 1].corners) {
      here = &worst[{corners, square}];
    }
    const double size = std::abs(error[i]);
    here->sum += size * size;
    if (size <= here->largest) continue;
    const Vector_2 place = grid.place(i % grid.columns, i / grid.columns);
    const bool is_free = std::ranges::all_of(corners, [&](Point_id corner) {
      return squared_distance(positions[corner], place) >= least_distance * least_distance;
    });
    if (is_free) {
      here->largest = size;
      here->pixel = i;
    }
  }
  std::vector<Candidate> result;
  for (const auto& [key, found] : worst) {
    if (found.largest == 0) continue;
    const Vector_2 place = grid.place(found.pixel % grid.columns, found.pixel / grid.columns);
    result.push_back({place_at(header, place), found.sum});
  }
  std::ranges::stable_sort(result, std::greater(), &Candidate::error);
  return result;
}

double ring_spacing(const Stream_header& header, std::size_t count) {
  const double area = static_cast<double>(header.format.width) * header.format.height;
  return 1.6 * std::sqrt(area / static_cast<double>(count));
}

std::vector<Place> ring_places(const Stream_header& header, double spacing) {
  struct Ring {
    double distance;  // from the picture
    double spacing;
  };
  const std::vector<Ring> rings =
      header.margin == 0 ? std::vector<Ring>{{0, spacing}}
                         : std::vector<Ring>{{0.5 * spacing, spacing}, {2 * spacing, 2 * spacing}};
  std::vector<Place> result;
  const auto corners = header.corners();
  std::set<Place> known(corners.begin(), corners.end());
  for (const Ring& ring : rings) {
    if (ring.distance >= header.margin && header.margin > 0) continue;
    const double width = header.format.width + 2 * ring.distance;
    const double height = header.format.height + 2 * ring.distance;
    const auto count = static_cast<int>(2 * (width + height) / ring.spacing);
    for (int i = 0; i < count; ++i) {
      const double way = (i + 0.5) * 2 * (width + height) / count;
      Vector_2 p = {way, 0};
      if (way > width) p = {width, way - width};
      if (way > width + height) p = {2 * width + height - way, height};
      if (way > 2 * width + height) p = {0, 2 * (width + height) - way};
      const Place place = place_at(header, {p.x - ring.distance, p.y - ring.distance});
      if (known.insert(place).second) result.push_back(place);
    }
  }
  return result;
}

std::vector<Place> places_on_grid(const Stream_header& header, std::size_t count) {
  std::vector<Place> places = corner_places(header);
  const double ratio = static_cast<double>(header.right()) / header.bottom();
  const double n = static_cast<double>(count);
  const auto columns =
      std::clamp<std::int64_t>(std::llround(std::sqrt(n * ratio)), 2, header.right());
  const auto rows =
      std::clamp<std::int64_t>(static_cast<std::int64_t>(n) / columns, 2, header.bottom());
  const std::set<Place> known(places.begin(), places.end());
  for (std::int64_t j = 0; j < rows; ++j) {
    for (std::int64_t i = 0; i < columns && places.size() < count; ++i) {
      const Place place = {static_cast<std::int32_t>(header.right() * i / (columns - 1)),
                           static_cast<std::int32_t>(header.bottom() * j / (rows - 1))};
      if (!known.contains(place)) places.push_back(place);
    }
  }
  return places;
}

std::vector<Place> places_by_content(const Stream_header& header, const Frame& frame,
                                     std::size_t count) {
  const Video_format& format = header.format;
  std::vector<Place> places = corner_places(header);
  const std::vector<Place> ring = ring_places(header, ring_spacing(header, count));
  // If there are few points in total, every n-th position of a ring.
  const std::size_t most_in_ring = (count - number_of_corners) / 2;
  const std::size_t every = ring.size() / (most_in_ring + 1) + 1;
  for (std::size_t i = every - 1; i < ring.size(); i += every) places.push_back(ring[i]);

  const Grid_2 grid = format.grid(0, format);
  std::vector<Corner_weights> weights(grid.columns * grid.rows);
  std::vector<double> error(weights.size());
  std::vector<double> values;
  std::vector<Vector_2> positions;
  std::set<Place> known(places.begin(), places.end());
  std::vector<Linear_motion_2> motions;
  const auto take = [&](const Place& place) {
    positions.push_back(position_of(header, place));
    values.push_back(sample_at(header, frame, 0, positions.back()));
    motions.push_back({positions.back(), {0, 0}, 0});
  };
  for (const Place& place : places) take(place);
  Kinetic_delaunay_triangulation_2<> triangulation(motions);
  while (places.size() < count) {
    find_corner_weights(triangulation, grid, weights);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      double value = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        value += weights[i].weights[k] * values[weights[i].corners[k]];
      }
      error[i] = frame.planes[0][i] - value;
    }
    // At most half as many as there are points: the errors are those of the previous round.
    const std::size_t most =
        std::min(count - places.size(), std::max<std::size_t>(16, places.size() / 2));
    motions.clear();
    for (const Candidate& candidate : candidates(header, weights, error, positions)) {
      if (motions.size() == most) break;
      if (!known.insert(candidate.place).second) continue;
      places.push_back(candidate.place);
      take(candidate.place);
    }
    if (motions.empty()) break;
    triangulation.insert(motions);
  }
  return places;
}

}  // namespace kinetri::video
