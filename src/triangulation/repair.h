// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangulation of points that have moved, from that before, without certificates.
//
// After small steps most triangles are still counterclockwise. Most of the others are mended by a
// flip: their point has crossed an edge. Points that flips leave in clockwise triangles are taken
// out of the triangulation. Then all triangles are counterclockwise, so that they form an embedded
// triangulation; Lawson's flips make it Delaunay, and the points are inserted again. Points that
// are taken out and inserted again are the filter of P. M. M. de Castro, J. Tournois, P. Alliez,
// O. Devillers, Filtering relocations on a Delaunay triangulation, Computer Graphics Forum 28(5),
// 2009. A torus has no hull; which flips are possible there says docs/MATH.md, section 18.
#ifndef KINETRI_SRC_TRIANGULATION_REPAIR_H
#define KINETRI_SRC_TRIANGULATION_REPAIR_H

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kinetic/certain_signs.h"
#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/triangulation/edge_changes.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "kinetri/impl/triangulation/static_construction.h"
#include "kinetri/impl/triangulation/topology.h"
#include "kinetri/impl/triangulation/torus_triangulation.h"
#include "triangulation/moved_points.h"

namespace kinetri::detail {

/// Moves points. Precondition: dimension 2; the triangulation is Delaunay (regular) at the instant
/// of its predicates; on a torus all weights are equal, before and after.
///
/// Cost: O(n), on all threads of oneTBB's arena; O(log n) expected for each flip that is noted, and
/// for each point that is taken out what its removal and insertion cost.
template <class Traits>
class Kinetic_types<Traits>::Repair {
 public:
  /// `time` is that of the predicates. Changes are noted. The others must outlive this object.
  Repair(Topology& topology, Change_notes<Edge_name>& notes, const Time& time)
      : topology_(topology),
        notes_(notes),
        triangulation_(topology.triangulation()),
        points_(topology, time) {}

  /// Gives the points their motions, and makes the triangulation Delaunay at the instant of its
  /// predicates. Returns false if a construction probably costs less, since many triangles turn
  /// over, or if points coincide: then all points have their motions, and the triangulation must be
  /// constructed anew; its finite edges are the former ones with the changes that are noted.
  bool move(std::span<const Change> changes);

 private:
  // If more triangles turn over, a construction costs less.
  static constexpr std::size_t points_for_each_turned = 2;

  using Vertex = typename Moved_points::Vertex;

  struct Removed {
    Vertex_handle vertex;
    Vertex_handle neighbor;  // which it had
  };

  bool is_violated(const Edge& edge) const;

  // ---- triangles that turn over ----
  struct Block {
    std::span<const Face_handle> faces;
    std::vector<Face_handle> turned;
    std::vector<Edge> suspects;
  };
  bool find_turned();
  void find_turned(Block& block) const;
  bool embed();
  void flip_turned();
  bool try_flip_turned(Face_handle face);
  bool is_obtuse(const Vertex& v, const Vertex& a, const Vertex& b) const;
  Vertex_handle corner_to_take_out(Face_handle face) const;
  bool take_out(Vertex_handle v);
  std::optional<Edge> best_ear(std::span<const Edge> spokes) const;
  void take_out_hidden(Face_handle face);

  // ---- the rest ----
  bool put_back();
  bool hide_or_show(Vertex_handle v, const Location& above);
  bool flip_hull(std::vector<Vertex_handle> suspects);
  std::vector<Vertex_handle> hull() const;
  std::vector<Vertex_handle> hull_loops() const;
  bool flip_suspects();
  Vertex_handle reflex_end(const Edge& edge) const;
  void flip(const Edge& edge);
  void suspect(Face_handle face) {
    for (int i = 0; i < 3; ++i) suspects_.emplace_back(face, i);
  }

  // A face that has changed.
  void add_new(Face_handle face) {
    suspect(face);
    if (!points_.is_left_turn(face)) turned_.push_back(face);
  }

  bool is_infinite(Vertex_handle v) const { return triangulation_.is_infinite(v); }
  Vertex_handle finite_corner(Face_handle face) const {
    return face->vertex(is_infinite(face->vertex(0)) ? 1 : 0);
  }
  void delete_unlinked() {
    for (const Face_handle face : unlinked_) triangulation_.tds().delete_face(face);
    unlinked_.clear();
  }
  static Vertex_handle handle(const Vertex& v) { return Moved_points::handle(v); }
  // Whether the face was left over when a point was taken out.
  static bool is_unlinked(Face_handle face) { return face->vertex(0) == Vertex_handle(); }
  bool are_adjacent(const Vertex& v, const Vertex& w) const;
  bool may_flip(const Edge& edge) const;
  int ends_lost_by_flip(const Edge& edge, Vertex_handle v) const;
  void note(const Edge& edge, int change) {
    if (!triangulation_.is_infinite(edge)) notes_.note(Topology::name_of(edge), change);
  }

  Topology& topology_;
  Change_notes<Edge_name>& notes_;
  Triangulation& triangulation_;
  Moved_points points_;
  std::vector<Face_handle> turned_;    // finite triangles that have turned over, or may have
  std::vector<Edge> suspects_;         // edges that may be violated
  std::vector<Face_handle> unlinked_;  // to be deleted
  std::vector<Removed> removed_;
  std::size_t flips_left_ = 0;
};

template <class Traits>
bool Kinetic_types<Traits>::Repair::move(std::span<const Change> changes) {
  points_.set(changes);
  flips_left_ = 4 * triangulation_.tds().number_of_faces();
  if (!points_.are_known() || !find_turned()) return false;
  if constexpr (is_weighted) {
    for (const Face_handle face : triangulation_.finite_face_handles()) take_out_hidden(face);
  }
  bool is_done = false;
  try {
    is_done = embed() && flip_suspects();
    delete_unlinked();
    is_done = is_done && put_back();
  } catch (const Offset_overflow&) {
    is_done = false;  // A construction may not need so long an edge.
  }
  delete_unlinked();
  return is_done;
}

template <class Traits>
bool Kinetic_types<Traits>::Repair::is_violated(const Edge& edge) const {
  if (triangulation_.is_infinite(edge.first)) return false;
  const auto [here, right, there, left] = Moved_points::quadrilateral(edge);
  return !is_infinite(handle(there)) && points_.is_in_circle(here, right, left, there);
}

// ---- triangles that turn over ----

// Finds triangles that may have turned over, and edges that may be violated. Returns false if there
// are too many of the former. The result is the same on any number of threads.
template <class Traits>
bool Kinetic_types<Traits>::Repair::find_turned() {
  constexpr std::size_t faces_per_block = 8192;
  const std::size_t most = topology_.number_of_vertices() / points_for_each_turned;
  const std::vector<Face_handle> faces = topology_.faces();
  std::vector<Block> blocks;
  for (const auto& some : blocks_of(std::span(faces), faces_per_block)) {
    blocks.push_back({some, {}, {}});
  }
  std::atomic<std::size_t> turned = 0;
  for_each_in_parallel(blocks, [&](Block& block) {
    if (turned > most) return;
    find_turned(block);
    turned += block.turned.size();
  });
  if (turned > most) return false;
  for (const Block& block : blocks) {
    turned_.insert(turned_.end(), block.turned.begin(), block.turned.end());
    suspects_.insert(suspects_.end(), block.suspects.begin(), block.suspects.end());
  }
  return true;
}

template <class Traits>
void Kinetic_types<Traits>::Repair::find_turned(Block& block) const {
  // Edges in batches, so that the vertices beyond them are in the cache when they are needed.
  std::array<Edge, 96> edges;
  std::array<std::array<Vertex, 4>, 96> quadrilaterals;
  std::size_t count = 0;
  const auto find_violated = [&] {
    for (std::size_t k = 0; k < count; ++k) {
      quadrilaterals[k] = Moved_points::quadrilateral(edges[k]);
      prefetch(handle(quadrilaterals[k][2]));
    }
    for (std::size_t k = 0; k < count; ++k) {
      const auto& [here, right, there, left] = quadrilaterals[k];
      if (is_infinite(handle(there))) continue;
      if (points_.certain_side(here, right, left, there) != CGAL::NEGATIVE) {
        block.suspects.push_back(edges[k]);
      }
    }
    count = 0;
  };
  for (const Face_handle face : block.faces) {
    if (triangulation_.is_infinite(face)) continue;
    const auto [a, b, c] = Moved_points::corners(face);
    if (points_.certain_turn(a, b, c) != CGAL::POSITIVE) block.turned.push_back(face);
    for (int i = 0; i < 3; ++i) {
      const Face_handle neighbor = face->neighbor(i);
      prefetch(neighbor);
      edges[count] = Edge(face, i);
      count += face < neighbor ? 1U : 0U;  // without a branch, which would be mispredicted
    }
    if (count + 3 > edges.size()) find_violated();
  }
  find_violated();
}

// Makes all finite triangles counterclockwise, and the hull, if there is one, convex and simple.
// Returns false if it could not. In between, `turned_` has all triangles that have turned over.
template <class Traits>
bool Kinetic_types<Traits>::Repair::embed() {
  flip_turned();
  for (;;) {
    while (!turned_.empty()) {
      const Face_handle face = turned_.back();
      if (is_unlinked(face) || points_.is_left_turn(face)) {
        turned_.pop_back();
      } else if (!try_flip_turned(face) && !take_out(corner_to_take_out(face))) {
        return false;
      }
    }
    if constexpr (is_periodic) {
      return true;
    } else {
      if (!flip_hull(hull())) return false;
      const std::vector<Vertex_handle> loops = hull_loops();
      if (loops.empty()) return true;
      if (!std::ranges::all_of(loops, [&](Vertex_handle v) { return take_out(v); })) return false;
    }
  }
}

// Flips edges of the turned triangles, and of those that this turns over, as long as that helps.
template <class Traits>
void Kinetic_types<Traits>::Repair::flip_turned() {
  constexpr std::size_t ahead = 4;
  const std::vector<Face_handle> faces = std::exchange(turned_, {});
  std::vector<Face_handle> left;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (k + ahead < faces.size()) prefetch_around(faces[k + ahead]);
    turned_.push_back(faces[k]);
    while (!turned_.empty()) {
      const Face_handle face = turned_.back();
      turned_.pop_back();
      if (!points_.is_left_turn(face) && !try_flip_turned(face)) left.push_back(face);
    }
  }
  turned_ = std::move(left);
}

// Flips the edge of a turned triangle opposite to its obtuse angle, if fewer of the two new
// triangles have turned over, or as many of less area. (The sum of the signed areas stays.)
template <class Traits>
bool Kinetic_types<Traits>::Repair::try_flip_turned(Face_handle face) {
  struct Turned {
    int number = 0;
    double area = 0;
  };
  const auto turned = [&](const auto&... triangles) {
    Turned result;
    const auto add = [&](const std::array<Vertex, 3>& corners) {
      const auto& [a, b, c] = corners;
      if (points_.is_left_turn(a, b, c)) return;
      ++result.number;
      result.area += std::abs(cross(difference(points_.place(b), points_.place(a)),
                                    difference(points_.place(c), points_.place(a))));
    };
    (add(triangles), ...);
    return result;
  };
  for (int i = 0; i < 3; ++i) {
    const Face_handle beyond = face->neighbor(i);
    const auto [here, right, there, left] = Moved_points::quadrilateral(Edge(face, i));
    if (!is_obtuse(here, right, left)) continue;
    const Turned before = turned(std::array{here, right, left}, std::array{there, left, right});
    const Turned after = turned(std::array{here, right, there}, std::array{here, there, left});
    constexpr double less = 0.99;  // flips of areas that differ by rounding alone might not end
    if (after.number > before.number) continue;
    if (after.number == before.number && !(after.area < less * before.area)) continue;
    if (flips_left_ == 0 || !may_flip(Edge(face, i))) continue;
    --flips_left_;
    flip(Edge(face, i));
    add_new(face);
    add_new(beyond);
    return true;
  }
  return false;
}

// Whether the angle at v is obtuse: then v has probably crossed the opposite edge of its triangle,
// which has turned over. Else its other corners may have changed places.
template <class Traits>
bool Kinetic_types<Traits>::Repair::is_obtuse(const Vertex& v, const Vertex& a,
                                              const Vertex& b) const {
  const Vector_2 to_a = difference(points_.place(a), points_.place(v));
  const Vector_2 to_b = difference(points_.place(b), points_.place(v));
  return to_a.x * to_b.x + to_a.y * to_b.y < 0;
}

// The corner at which the most triangles have turned over.
template <class Traits>
auto Kinetic_types<Traits>::Repair::corner_to_take_out(Face_handle face) const -> Vertex_handle {
  const auto turned_at = [&](Vertex_handle v) {
    int result = 0;
    for_each_face_at(triangulation_, v,
                     [&](Face_handle f) { result += points_.is_left_turn(f) ? 0 : 1; });
    return result;
  };
  const std::array corners = {face->vertex(0), face->vertex(1), face->vertex(2)};
  return *std::ranges::max_element(corners, {}, turned_at);
}

// Flips edges of a vertex until it has three, then takes it out. Of the ears of the polygon around
// it those are cut first that are counterclockwise and have the fewest corners in their circles.
template <class Traits>
bool Kinetic_types<Traits>::Repair::take_out(Vertex_handle v) {
  constexpr std::size_t most_left = 3;
  if (topology_.number_of_vertices() <= removed_.size() + most_left) return false;
  std::vector<Edge> spokes;
  for (;;) {
    spokes.clear();
    for_each_face_at(triangulation_, v, [&](Face_handle face, int i) {
      spokes.emplace_back(face, Triangulation::cw(i));
    });
    if (spokes.size() == 3) break;
    const auto ear = best_ear(spokes);
    if (!ear) return false;
    const auto [face, i] = *ear;
    const Face_handle beyond = face->neighbor(i);
    flip(*ear);
    add_new(face->has_vertex(v) ? beyond : face);
  }
  for (const Edge& edge : spokes) {
    note(edge, -1);
    take_out_hidden(edge.first);
  }
  const auto [face, second, third] = topology_.remove_degree_3(v);
  add_new(face);
  unlinked_.push_back(second);
  unlinked_.push_back(third);
  removed_.push_back({v, finite_corner(face)});
  return true;
}

// Takes out the points that the face hides. They remain marked as hidden.
template <class Traits>
void Kinetic_types<Traits>::Repair::take_out_hidden(Face_handle face) {
  if constexpr (is_weighted) {
    if (face->vertex_list().empty()) return;
    for (const Taken_point& taken : Topology::take_hidden({&face, 1})) {
      const Vertex_handle v = taken.vertex;
      v->set_event(no_event);
      notes_.note_moved_hidden(v->point().id());
      removed_.push_back({v, finite_corner(face)});
    }
  }
}

// The edge to the tip of the ear that is cut first, of the edges from a vertex: `spokes`,
// counterclockwise, each in the face after it.
template <class Traits>
auto Kinetic_types<Traits>::Repair::best_ear(std::span<const Edge> spokes) const
    -> std::optional<Edge> {
  struct End {
    Vertex vertex;
    bool is_infinite;
    Vector_2 place;
  };
  const std::size_t degree = spokes.size();
  const Vertex_handle center = spokes[0].first->vertex(Triangulation::ccw(spokes[0].second));
  std::vector<End> ends;  // twice around
  for (std::size_t k = 0; k < 2 * degree; ++k) {
    const auto& [face, i] = spokes[k % degree];
    const Vertex v = Moved_points::corner(face, Triangulation::cw(i), Triangulation::ccw(i));
    const bool is_not_finite = is_infinite(handle(v));
    ends.push_back({v, is_not_finite, is_not_finite ? Vector_2() : points_.place(v)});
  }
  enum Kind { counterclockwise, infinite, turned };
  std::optional<Edge> best;
  std::pair<Kind, int> least;
  for (std::size_t k = 1; k <= degree; ++k) {
    const End& before = ends[k - 1];
    const End& tip = ends[k];
    const End& after = ends[k + 1];
    std::pair<Kind, int> badness = {infinite, 0};
    if (tip.is_infinite) continue;
    if (!before.is_infinite && !after.is_infinite) {
      badness.first =
          points_.is_left_turn(before.vertex, tip.vertex, after.vertex) ? counterclockwise : turned;
      for (std::size_t m = k + 2; m + 1 < k + degree; ++m) {
        const End& other = ends[m % degree];
        if (other.is_infinite) continue;
        // A preference, which decides nothing: on a torus the error of images may be greater.
        const Sign side = certain_side_of_oriented_circle(before.place, tip.place, after.place,
                                                          other.place, points_.error());
        badness.second += side == CGAL::POSITIVE ? 1 : 0;
      }
    }
    if (best && badness >= least) continue;
    if (!may_flip(spokes[k % degree])) continue;
    const int lost = ends_lost_by_flip(spokes[k % degree], center);
    if (lost <= 0 || degree < 3 + static_cast<std::size_t>(lost)) continue;
    least = badness;
    best = spokes[k % degree];
    if (badness == std::pair(counterclockwise, 0)) break;
  }
  return best;
}

// Inserts the points again, or hides them. Returns false if one of them coincides with another.
template <class Traits>
bool Kinetic_types<Traits>::Repair::put_back() {
  while (!removed_.empty()) {
    const auto [v, neighbor] = removed_.back();
    removed_.pop_back();
    const Location location = topology_.locate(v->point(), neighbor->face());
    const Face_handle face = location.face;
    const auto locus = location.locus;
    const int i = location.index;
    if (locus == Triangulation::VERTEX) return false;
    if constexpr (is_weighted) {
      std::vector<Edge_ids> coincident;
      topology_.find_coincident(v->point(), location, {}, coincident);
      if (!coincident.empty()) return false;
      if (hide_or_show(v, topology_.hiding_face(v->point(), location))) continue;
    }
    take_out_hidden(face);
    if (locus == Triangulation::EDGE) {
      take_out_hidden(face->neighbor(i));
      note(Edge(face, i), -1);
    }
    topology_.insert_in_faces(v, location);
    for_each_face_at(triangulation_, v, [&](Face_handle f, int corner) {
      note(Edge(f, Triangulation::cw(corner)), 1);
    });
    if constexpr (!is_periodic) {
      if (locus == Triangulation::OUTSIDE_CONVEX_HULL) {
        std::vector<Vertex_handle> beside = {v};
        for_each_neighbor(triangulation_, v, [&](Vertex_handle u) { beside.push_back(u); });
        if (!flip_hull(std::move(beside))) return false;
      }
    }
    for_each_face_at(triangulation_, v, [&](Face_handle f) { suspect(f); });
    if (!flip_suspects()) return false;
  }
  return true;
}

// Hides a point in the face that hides it. If there is none, the point is not hidden; returns
// false.
template <class Traits>
bool Kinetic_types<Traits>::Repair::hide_or_show(Vertex_handle v, const Location& above) {
  if constexpr (is_weighted) {
    const bool is_hidden = above.face != Face_handle();
    if (v->is_hidden() != is_hidden) {
      notes_.note_hidden(v->point().id(), is_hidden);
      notes_.note_moved_hidden(v->point().id());
    }
    if (is_hidden) {
      topology_.hide_in(v, above);
    } else if (v->is_hidden()) {
      triangulation_.show(v);
    }
    return is_hidden;
  }
  return false;
}

// ---- the hull ----

template <class Traits>
auto Kinetic_types<Traits>::Repair::hull() const -> std::vector<Vertex_handle> {
  std::vector<Vertex_handle> result;
  for_each_neighbor(triangulation_, triangulation_.infinite_vertex(),
                    [&](Vertex_handle v) { result.push_back(v); });
  return result;
}

// Adds the edge between the hull neighbors of each reflex hull vertex. Returns false if three
// successive hull vertices fold back.
template <class Traits>
bool Kinetic_types<Traits>::Repair::flip_hull(std::vector<Vertex_handle> suspects) {
  const auto compare = triangulation_.geom_traits().compare_xy_2_object();
  while (!suspects.empty()) {
    const Vertex_handle v = suspects.back();
    suspects.pop_back();
    // The edge from v to infinity, if v is on the hull.
    std::optional<Edge> infinite;
    for_each_face_at(triangulation_, v, [&](Face_handle face, int i) {
      if (is_infinite(face->vertex(Triangulation::ccw(i)))) {
        infinite = Edge(face, Triangulation::cw(i));
      }
    });
    if (!infinite) continue;
    const auto [previous, here, next] = topology_.hull_turn(topology_.with_mirror(*infinite));
    if (previous == next) return false;
    const Sign orientation = points_.turn(previous, here, next);
    if (orientation == CGAL::LEFT_TURN) continue;
    if (orientation == CGAL::COLLINEAR) {
      if (!topology_.are_weights_equal()) return false;  // it might be hidden
      if (compare(previous->point(), here->point()) != compare(here->point(), next->point())) {
        return false;
      }
      continue;
    }
    if (flips_left_-- == 0) return false;
    const Face_handle beyond = infinite->first->neighbor(infinite->second);
    const Face_handle face = infinite->first;
    flip(*infinite);
    suspect(triangulation_.is_infinite(face) ? beyond : face);
    suspects.push_back(previous);
    suspects.push_back(next);
  }
  return true;
}

// A vertex of each loop of the hull: it makes no right turn, and goes around once more for each
// vertex that is less than both hull neighbors, but for one.
template <class Traits>
auto Kinetic_types<Traits>::Repair::hull_loops() const -> std::vector<Vertex_handle> {
  const auto compare = triangulation_.geom_traits().compare_xy_2_object();
  const auto is_less = [&](Vertex_handle v, Vertex_handle w) {
    return compare(v->point(), w->point()) == CGAL::SMALLER;
  };
  const std::vector<Vertex_handle> around = hull();
  std::vector<Vertex_handle> result;
  for (std::size_t k = 0; k < around.size(); ++k) {
    const Vertex_handle before = around[(k + around.size() - 1) % around.size()];
    const Vertex_handle after = around[(k + 1) % around.size()];
    if (is_less(around[k], before) && is_less(around[k], after)) result.push_back(around[k]);
  }
  if (!result.empty()) result.erase(std::ranges::min_element(result, is_less));
  return result;
}

// ---- edges ----

// Whether there is an edge between them.
template <class Traits>
bool Kinetic_types<Traits>::Repair::are_adjacent(const Vertex& v, const Vertex& w) const {
  bool result = false;
  if constexpr (is_periodic) {
    const Vertex edge_to = {w.vertex, offset_between(v.offset, w.offset)};
    for_each_face_at(triangulation_, v.vertex, [&](Face_handle face, int i) {
      result = result || Moved_points::corner(face, Triangulation::ccw(i), i) == edge_to;
    });
  } else {
    const bool from_w = is_infinite(v);
    for_each_face_at(triangulation_, from_w ? w : v, [&](Face_handle face, int i) {
      result = result || face->vertex(Triangulation::ccw(i)) == (from_w ? v : w);
    });
  }
  return result;
}

// Whether an edge may be flipped: there is no edge yet with the ends of the new one, on a torus of
// that offset; and there the new one has two different ends, and no face gets an edge twice.
template <class Traits>
bool Kinetic_types<Traits>::Repair::may_flip(const Edge& edge) const {
  const auto& [here, right, there, left] = Moved_points::quadrilateral(edge);
  if constexpr (is_periodic) {
    const auto& [face, i] = edge;
    const auto [beyond, j] = Triangulation::mirror(edge);
    const Edge left_side(face, Triangulation::ccw(i));
    const Edge right_side(face, Triangulation::cw(i));
    if (here == there || Triangulation::mirror(left_side) == Edge(beyond, Triangulation::cw(j)) ||
        Triangulation::mirror(right_side) == Edge(beyond, Triangulation::ccw(j))) {
      return false;
    }
  }
  return !are_adjacent(here, there);
}

// By how much fewer edges a vertex has after a flip.
template <class Traits>
int Kinetic_types<Traits>::Repair::ends_lost_by_flip([[maybe_unused]] const Edge& edge,
                                                     [[maybe_unused]] Vertex_handle v) const {
  if constexpr (is_periodic) {
    return Triangulation::ends_lost_by_flip(edge, v);
  } else {
    return 1;
  }
}

template <class Traits>
void Kinetic_types<Traits>::Repair::flip(const Edge& edge) {
  const auto& [face, i] = edge;
  take_out_hidden(face);
  take_out_hidden(face->neighbor(i));
  if constexpr (is_periodic) Triangulation::offset_across(edge);  // may throw
  note(edge, -1);
  if constexpr (is_periodic) {
    triangulation_.flip(edge);
  } else {
    triangulation_.tds().flip(face, i);
  }
  note(Edge(face, Triangulation::ccw(i)), 1);
}

// The end of an edge at which its quadrilateral makes no left turn; none if it is convex, as it is
// without weights if the edge is violated.
template <class Traits>
auto Kinetic_types<Traits>::Repair::reflex_end(const Edge& edge) const -> Vertex_handle {
  if (topology_.are_weights_equal()) return Vertex_handle();
  const auto [here, right, there, left] = Moved_points::quadrilateral(edge);
  if (!points_.is_left_turn(here, right, there)) return handle(right);
  if (!points_.is_left_turn(here, there, left)) return handle(left);
  return Vertex_handle();
}

// Flips the edges that are violated, and those around them, until all are Delaunay [Lawson 1977].
// With weights, takes out points that this finds hidden.
template <class Traits>
bool Kinetic_types<Traits>::Repair::flip_suspects() {
  constexpr std::size_t ahead = 8;
  while (!suspects_.empty()) {
    const auto [face, i] = suspects_.back();
    suspects_.pop_back();
    if (const std::size_t size = suspects_.size(); size > 2 * ahead) {
      prefetch(suspects_[size - 2 * ahead].first);
      prefetch_around(suspects_[size - ahead].first);
    }
    if (is_unlinked(face) || !is_violated(Edge(face, i))) continue;
    if (flips_left_-- == 0) return false;
    if (const Vertex_handle v = reflex_end(Edge(face, i)); v != Vertex_handle()) {
      // It is above the triangle of the three other points, and so is hidden.
      bool was_on_hull = false;
      if constexpr (!is_periodic) was_on_hull = are_adjacent(v, triangulation_.infinite_vertex());
      if (!take_out(v)) return false;
      if ((was_on_hull || !turned_.empty()) && !embed()) return false;
      continue;
    }
    const auto [beyond, j] = topology_.with_mirror(Edge(face, i)).there;
    flip(Edge(face, i));
    // The outer edges of the quadrilateral (Topology::flip).
    suspects_.emplace_back(face, i);
    suspects_.emplace_back(face, Triangulation::cw(i));
    suspects_.emplace_back(beyond, j);
    suspects_.emplace_back(beyond, Triangulation::cw(j));
  }
  return true;
}

template <class Traits>
bool From_places<Traits>::move(Topology& topology, Change_notes<Edge_ids>& notes, const Time& time,
                               std::span<const Change> changes) {
  return typename Kinetic_types<Traits>::Repair(topology, notes, time).move(changes);
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REPAIR_H
