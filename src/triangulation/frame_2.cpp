// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/triangulation/frame_2.h"

#include <algorithm>

#include "kinetri/impl/kinetic/drawn_box_2.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri {
namespace {

// The index of each point in the ascending order of ids.
class Positions {
 public:
  explicit Positions(const std::vector<Point_id>& ids) : ids_(ids) {}

  std::size_t of(Point_id id) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(ids_, id) - ids_.begin());
  }

  std::array<std::size_t, 2> of(const Edge_ids& edge) const { return {of(edge[0]), of(edge[1])}; }

 private:
  const std::vector<Point_id>& ids_;
};

template <class Triangulation>
void add_faces(Frame_2& frame, const Triangulation& triangulation) {
  const Positions positions(frame.ids);
  for (const auto face : triangulation.all_face_handles()) {
    const auto id = [&](int i) { return face->vertex(i)->point().id(); };
    int infinite = 0;
    if (face->has_vertex(triangulation.infinite_vertex(), infinite)) {
      frame.hull.push_back(positions.of(
          edge_ids(id(Triangulation::ccw(infinite)), id(Triangulation::cw(infinite)))));
    } else {
      std::array<std::size_t, 3> corners = {positions.of(id(0)), positions.of(id(1)),
                                            positions.of(id(2))};
      std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
      frame.triangles.push_back(corners);
    }
  }
  std::ranges::sort(frame.hull);
  std::ranges::sort(frame.triangles);
}

// Moves the places into the box, and adds the edges and triangles.
template <class Traits>
void add_periodic(Frame_2& frame, const Kinetic_triangulation_2<Traits>& kinetic) {
  const Drawn_box_2 box(kinetic.traits().box(), frame.time);
  Frame_2::Periodic& periodic = frame.periodic.emplace();
  periodic.corners = box.corners();
  std::vector<Drawn_box_2::Image> images;
  for (Vector_2& place : frame.places) {
    images.push_back(box.image(place));
    place = images.back().place;
  }
  const Positions positions(frame.ids);
  for (const auto& [ids, offset] : kinetic.periodic_edges()) {
    frame.edges.push_back(positions.of(ids));
    const auto [a, b] = frame.edges.back();
    periodic.edge_shifts.push_back(box.shift(offset, images[a], images[b]));
  }
  std::vector<Periodic_triangle> triangles;
  for (const auto face : kinetic.triangulation().finite_face_handles()) {
    const auto image = [face](int i) {
      return Periodic_image{face->vertex(i)->point().id(), face->offset(i)};
    };
    triangles.push_back(periodic_triangle(image(0), image(1), image(2)));
  }
  std::ranges::sort(triangles);
  for (const Periodic_triangle& triangle : triangles) {
    const auto& ids = triangle.corners;
    const std::array corners = {positions.of(ids[0]), positions.of(ids[1]), positions.of(ids[2])};
    const auto shift = [&](std::size_t k) {
      return box.shift(triangle.offsets[k - 1], images[corners[0]], images[corners[k]]);
    };
    frame.triangles.push_back(corners);
    periodic.triangle_shifts.push_back({shift(1), shift(2)});
  }
}

}  // namespace

template <KineticTraits_2 Traits>
Frame_2 frame_of(const Kinetic_triangulation_2<Traits>& kinetic) {
  Frame_2 frame;
  frame.time = kinetic.current_time().to_double();
  frame.events = kinetic.counters().events;
  if constexpr (HasWeight<typename Traits::Motion>) frame.discs.emplace();
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (!kinetic.contains(id)) continue;
    const auto& motion = kinetic.motion(id);
    frame.ids.push_back(id);
    frame.places.push_back(rounded_place(motion, frame.time));
    frame.velocities.push_back(rounded_velocity(motion, frame.time));
    if constexpr (HasWeight<typename Traits::Motion>) {
      const double radius = std::max(rounded_radius(motion, frame.time), 0.0);
      frame.discs->push_back({radius, kinetic.is_hidden(id)});
    }
  }
  if constexpr (PeriodicKineticTraits_2<Traits>) {
    add_periodic(frame, kinetic);
  } else {
    const auto& triangulation = kinetic.triangulation();
    const Positions positions(frame.ids);
    for (const Edge_ids& edge : kinetic.finite_edge_ids()) {
      frame.edges.push_back(positions.of(edge));
    }
    if (triangulation.dimension() == 2) {
      add_faces(frame, triangulation);
    } else {
      frame.hull = frame.edges;
    }
  }
  return frame;
}

template Frame_2 frame_of(const Kinetic_triangulation_2<Linear_kinetic_traits_2>&);
template Frame_2 frame_of(const Kinetic_triangulation_2<Polynomial_kinetic_traits_2>&);
template Frame_2 frame_of(const Kinetic_triangulation_2<Disc_kinetic_traits_2>&);
template Frame_2 frame_of(const Kinetic_triangulation_2<Polynomial_disc_kinetic_traits_2>&);
template Frame_2 frame_of(const Kinetic_triangulation_2<Periodic_kinetic_traits_2>&);
template Frame_2 frame_of(const Kinetic_triangulation_2<Periodic_disc_kinetic_traits_2>&);

}  // namespace kinetri
