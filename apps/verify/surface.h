// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles that edges and motions imply: a closed surface, in the plane with an infinite
// point, in a periodic box with images of the points. The lemmas named here are in README.md.
#ifndef KINETRI_VERIFY_SURFACE_H
#define KINETRI_VERIFY_SURFACE_H

#include "points.h"

namespace verify {

// Edges are removed and added; then the triangles at the touched points are made anew.
class Surface : protected Moving_points {
 protected:
  Surface(const Options& options, const std::vector<Change>& points, const std::vector<Row>& rows)
      : Moving_points(options, points, rows), neighbors_(courses_.size()) {}

  static Image moved(const Image& image, const Offset& by) { return {image.id, image.offset + by}; }
  // The directed edge from a to b.
  static Edge side(const Image& a, const Image& b) { return {a.id, b.id, b.offset - a.offset}; }

  // The third corner of the triangle at the left; `absent` if there is no triangle.
  Image apex(const Image& a, const Image& b) const {
    const auto found = left_.find(side(a, b));
    return found == left_.end() ? Image() : moved(found->second, a.offset);
  }
  // The ends of an edge, and the apexes at its left and right.
  Points around(const Edge& e) const {
    const Image a = begin_of(e);
    const Image b = end_of(e);
    return {a, b, apex(a, b), apex(b, a)};
  }
  bool has_edge(const Edge& e) const {
    return e.first < neighbors_.size() && neighbors_[e.first].contains(end_of(e));
  }
  // Whether the edge is there. Of the infinite point it is if one of its triangles is.
  bool is_there(const Edge& e) const {
    return e.second == infinite ? apex(e.first, infinite).id != absent : has_edge(e);
  }

  void add_triangle(const Image& a, const Image& b, const Image& c) {
    if (apex(a, b) == c) return;
    const std::array<Triangle, 3> turns = {{{a, b, c}, {b, c, a}, {c, a, b}}};
    for (const auto& [u, v, w] : turns) {
      if (u.id != infinite && v.id != infinite && !has_edge(edge(u, v))) {
        refute("a face is no triangle: there is no " + name(edge(u, v)));
      }
      if (apex(u, v).id != absent || side(u, v) == side(v, w)) {
        refute("two triangles are on one side of " + name(edge(u, v)));
      }
    }
    for (const auto& [u, v, w] : turns) {
      left_[side(u, v)] = moved(w, Offset() - u.offset);
      changed_.insert(edge(u, v));
      if (v.id == infinite) hull_.insert(u.id);
    }
    if (is_periodic()) covered_ += Lattice::area(a, b, c);
  }

  void remove_triangle(const Image& a, const Image& b, const Image& c) {
    for (const auto& [u, v] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      left_.erase(side(u, v));
      changed_.insert(edge(u, v));
      if (v.id == infinite) hull_.erase(u.id);
    }
    if (is_periodic()) covered_ -= Lattice::area(a, b, c);
  }
  void remove_triangles(const Edge& e) {
    const Image a = begin_of(e);
    const Image b = end_of(e);
    for (const auto& [u, v] : {std::pair(a, b), std::pair(b, a)}) {
      const Image w = apex(u, v);
      if (w.id != absent) remove_triangle(u, v, w);
    }
  }

  void remove_edge(const Edge& e) {
    if (!has_edge(e)) refute("there is no " + name(e));
    neighbors_[e.first].erase(end_of(e));
    neighbors_[e.second].erase({e.first, Offset() - e.offset});
    --edges_;
    remove_triangles(e);
    changed_.insert(e);
    touched_.insert({e.first, e.second});
  }

  void add_edge(const Edge& e) {
    if (!is_present(e.first) || !is_present(e.second)) {
      refute(name(e) + " has an end that is not there");
    }
    if (!neighbors_[e.first].insert(end_of(e)).second) refute(name(e) + " is there already");
    neighbors_[e.second].insert({e.first, Offset() - e.offset});
    ++edges_;
    changed_.insert(e);
    touched_.insert({e.first, e.second});
  }

  // The triangles at a point, from the directions of its edges just after now (Lemma 5).
  void make_star(Id v) {
    std::array<std::vector<Image>, 2> halves;  // of the directions: upper and lower
    for (const Image& n : neighbors_[v]) {
      const auto [dx, dy] = minus(course(n), course(v));
      if (dx.empty() && dy.empty()) refute("the ends of " + name(edge(n, v)) + " are one place");
      const int sign = sign_just_after(dy, now_);
      halves[sign < 0 || (sign == 0 && sign_just_after(dx, now_) < 0) ? 1 : 0].push_back(n);
    }
    const auto is_left_turn = [&](const Image& a, const Image& b) {
      return sign_just_after(orientation(course(v), course(a), course(b)), now_) > 0;
    };
    std::vector<Image> star;
    for (std::vector<Image>& half : halves) {
      std::ranges::sort(half, is_left_turn);
      star.insert(star.end(), half.begin(), half.end());
    }
    for (std::size_t i = 0; i < star.size(); ++i) {
      const Image& a = star[i];
      const Image& b = star[i + 1 == star.size() ? 0 : i + 1];
      if (is_left_turn(a, b)) {
        add_triangle(v, a, b);
      } else if (is_periodic()) {
        refute("no triangles surround point " + std::to_string(v));
      } else {  // the only gap, at which v is a corner of the hull
        add_triangle(v, a, infinite);
        add_triangle(b, v, infinite);
      }
    }
  }

  // A triangle that is flat now may turn over while all its edges stay. Then the triangles at these
  // edges change, too, so all its corners are touched if one is (Lemma 5).
  void touch_flat() {
    std::vector<Id> more(touched_.begin(), touched_.end());
    while (!more.empty()) {
      const Id v = more.back();
      more.pop_back();
      for (const Image& n : neighbors_[v]) {
        for (const Image& m : {apex(v, n), apex(n, v)}) {
          if (m.id == absent || m.id == infinite) continue;
          if (sign_at(orientation(course(v), course(n), course(m)), now_) != 0) continue;
          for (const Id w : {n.id, m.id}) {
            if (touched_.insert(w).second) more.push_back(w);
          }
        }
      }
    }
  }

  // Makes the triangles at all touched points anew.
  void remake() {
    touch_flat();
    for (const Id v : touched_) {
      for (const Image& n : neighbors_[v]) remove_triangles(edge(v, n));
    }
    for (const Id v : touched_) make_star(v);
    std::erase_if(touched_, [&](Id v) { return !neighbors_[v].empty(); });
  }

  // Points that are always on a line: the edges are a path, each inner point of which is a corner
  // between its neighbors (Lemma 4).
  void make_path() {
    for (const auto& [ab, c] : std::exchange(left_, {})) {
      changed_.insert(edge(ab.first, ab.second));
    }
    hull_.clear();
    touched_.clear();
    if (!hidden_.empty()) check_radii();
    if (!groups_.empty() && edges_ + 1 != groups_.size())
      refute("the points on a line have no path of edges");
    for (Id v = 0; v < courses_.size(); ++v) {
      const std::set<Image>& n = neighbors_[v];
      if (n.size() > 2) refute("the points on a line have no path of edges");
      for (const Image& u : n) {
        if (course(u).place == course(v).place) {
          refute("the ends of " + name(edge(u, v)) + " are one place");
        }
      }
      if (n.size() < 2) continue;
      left_[{v, infinite}] = *n.begin();
      left_[{infinite, v}] = *n.rbegin();
      changed_.insert({v, infinite});
    }
  }

  // Not supported are points on one line some of which are hidden by others of other radii.
  void check_radii() const {
    const auto has_other_radius = [&](const Course* c) {
      return c != nullptr && c->radius != witness_.front()->radius;
    };
    if (std::ranges::any_of(courses_, has_other_radius)) {
      throw Bad_input(
          "all discs are on one line, and a larger one hides a smaller one: such runs are not "
          "supported");
    }
  }

  void touch_all() {
    for (Id v = 0; v < courses_.size(); ++v) {
      if (is_present(v)) touched_.insert(v);
    }
  }

  // Checks the premises of Lemmas 4 and 9 that concern all triangles together, if any has changed.
  void check_surface() {
    if (is_on_line_) return;
    for (const Edge& e : changed_) {
      const Points points = around(e);
      if (is_there(e) && (points[2].id == absent || points[3].id == absent)) {
        refute(name(e) + " has no triangle on one side");
      }
    }
    if (is_periodic()) return check_cover();
    if (std::ranges::any_of(changed_, [](const Edge& e) { return e.second == infinite; })) {
      check_hull();
    }
  }

  void check_cover() const {
    const std::size_t points = groups_.size() - hidden_.size();
    if (edges_ != 3 * points) {
      refute("there are " + std::to_string(edges_) + " edges; expected three for each of " +
             std::to_string(points) + " points");
    }
    if (!groups_.empty() && covered_ != 2) {
      mpq_class times_covered(covered_, 2);
      times_covered.canonicalize();
      refute("the triangles do not cover the box once, but " + times_covered.get_str() + " times");
    }
  }

  // Checks that the hull winds once: exactly one corner is less than both neighbors in the order of
  // x, then y.
  void check_hull() {
    const auto is_less = [&](Id a, const Image& b) {
      const auto [dx, dy] = minus(course(a), course(b));
      const int sign = sign_just_after(dx, now_);
      return sign != 0 ? sign < 0 : sign_just_after(dy, now_) < 0;
    };
    const auto count = std::ranges::count_if(hull_, [&](Id v) {
      return is_less(v, apex(v, infinite)) && is_less(v, apex(infinite, v));
    });
    if (count != 1) refute("the hull goes around " + std::to_string(count) + " times");
  }

  struct Hash {
    std::size_t operator()(const Edge& e) const {
      const auto word = [](auto number) { return static_cast<std::uint64_t>(number); };
      return (word(e.first) << 32U | e.second) + 0x9e3779b97f4a7c15U * word(e.offset.x) +
             0xc2b2ae3d27d4eb4fU * word(e.offset.y);
    }
  };

  std::vector<const Course*> witness_;  // three points that are not always on a line, if there are
  bool is_on_line_ = true;              // all points, at all times
  std::vector<std::set<Image>> neighbors_;  // by id; offsets are against the point
  std::size_t edges_ = 0;
  std::unordered_map<Edge, Image, Hash> left_;  // apexes; offsets are against the first end
  std::set<Id> hull_;
  Integer covered_ = 0;  // twice the sum of the areas of triangles over that of a periodic box

  // In this instant:
  std::set<Id> touched_;    // points whose triangles must be made anew
  std::set<Edge> changed_;  // edges whose ends or apexes changed
};

}  // namespace verify

#endif  // KINETRI_VERIFY_SURFACE_H
