// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles that edges and motions imply: a closed surface with an infinite point. The lemmas
// named here are in README.md.
#ifndef KINETRI_VERIFY_SURFACE_H
#define KINETRI_VERIFY_SURFACE_H

#include "points.h"

namespace verify {

// Edges are removed and added; then the triangles at the touched points are made anew.
class Surface : protected Moving_points {
 protected:
  Surface(const Options& options, const std::vector<Change>& points, const std::vector<Row>& rows)
      : Moving_points(options, points, rows), neighbors_(courses_.size()) {}

  // The third corner of the triangle at the left.
  Id apex(Id a, Id b) const {
    const auto found = left_.find(key(a, b));
    return found == left_.end() ? absent : found->second;
  }
  void add_triangle(Id a, Id b, Id c) {
    const std::array<Triangle, 3> turns = {{{a, b, c}, {b, c, a}, {c, a, b}}};
    for (const auto& [u, v, w] : turns) {
      if (u != infinite && v != infinite && !neighbors_[u].contains(v)) {
        refute("a face is no triangle: there is no " + name(edge(u, v)));
      }
      if (apex(u, v) != absent && apex(u, v) != w) {
        refute("two triangles are on one side of " + name(edge(u, v)));
      }
    }
    for (const auto& [u, v, w] : turns) {
      left_[key(u, v)] = w;
      changed_.insert(edge(u, v));
      if (v == infinite) hull_.insert(u);
    }
  }

  void remove_triangle(Id a, Id b, Id c) {
    for (const auto& [u, v] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      left_.erase(key(u, v));
      changed_.insert(edge(u, v));
      if (v == infinite) hull_.erase(u);
    }
  }

  void remove_edge(const Edge& e) {
    const auto [a, b] = e;
    if (b >= neighbors_.size() || neighbors_[a].erase(b) == 0) refute("there is no " + name(e));
    neighbors_[b].erase(a);
    --edges_;
    for (const auto& [u, v] : {std::pair(a, b), std::pair(b, a)}) {
      if (apex(u, v) != absent) remove_triangle(u, v, apex(u, v));
    }
    changed_.insert(e);
    touched_.insert({a, b});
  }

  void add_edge(const Edge& e) {
    const auto [a, b] = e;
    if (!is_present(a) || !is_present(b)) refute(name(e) + " has an end that is not there");
    if (!neighbors_[a].insert(b).second) refute(name(e) + " is there already");
    neighbors_[b].insert(a);
    ++edges_;
    changed_.insert(e);
    touched_.insert({a, b});
  }

  // The triangles at a point, from the directions of its edges just after now (Lemma 5).
  void make_star(Id v) {
    std::array<std::vector<Id>, 2> halves;  // of the directions: upper and lower
    for (const Id n : neighbors_[v]) {
      const auto [dx, dy] = minus(course(n), course(v));
      if (dx.empty() && dy.empty()) refute("the ends of " + name(edge(n, v)) + " are one place");
      const int sign = sign_just_after(dy, now_);
      halves[sign < 0 || (sign == 0 && sign_just_after(dx, now_) < 0) ? 1 : 0].push_back(n);
    }
    const auto is_left_turn = [&](Id a, Id b) {
      return sign_just_after(orientation(course(v), course(a), course(b)), now_) > 0;
    };
    std::vector<Id> star;
    for (std::vector<Id>& half : halves) {
      std::ranges::sort(half, is_left_turn);
      star.insert(star.end(), half.begin(), half.end());
    }
    for (std::size_t i = 0; i < star.size(); ++i) {
      const Id a = star[i];
      const Id b = star[i + 1 == star.size() ? 0 : i + 1];
      if (is_left_turn(a, b)) {
        add_triangle(v, a, b);
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
      for (const Id n : neighbors_[v]) {
        for (const Id m : {apex(v, n), apex(n, v)}) {
          if (m == absent || m == infinite) continue;
          if (sign_at(orientation(course(v), course(n), course(m)), now_) != 0) continue;
          for (const Id w : {n, m}) {
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
      for (const Id n : neighbors_[v]) {
        if (apex(v, n) != absent) remove_triangle(v, n, apex(v, n));
        if (apex(n, v) != absent) remove_triangle(n, v, apex(n, v));
      }
    }
    for (const Id v : touched_) make_star(v);
    std::erase_if(touched_, [&](Id v) { return !neighbors_[v].empty(); });
  }

  // Points that are always on a line: the edges are a path, each inner point of which is a corner
  // between its neighbors (Lemma 4).
  void make_path() {
    for (const auto& [ab, c] : std::exchange(left_, {})) {
      changed_.insert(edge(static_cast<Id>(ab >> 32U), static_cast<Id>(ab)));
    }
    hull_.clear();
    touched_.clear();
    if (!hidden_.empty()) check_radii();
    if (!groups_.empty() && edges_ + 1 != groups_.size())
      refute("the points on a line have no path of edges");
    for (Id v = 0; v < courses_.size(); ++v) {
      const std::set<Id>& n = neighbors_[v];
      if (n.size() > 2) refute("the points on a line have no path of edges");
      for (const Id u : n) {
        if (course(u).place == course(v).place) {
          refute("the ends of " + name(edge(u, v)) + " are one place");
        }
      }
      if (n.size() < 2) continue;
      left_[key(v, infinite)] = *n.begin();
      left_[key(infinite, v)] = *n.rbegin();
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

  // Checks that the hull winds once: exactly one corner is less than both neighbors in the order of
  // x, then y.
  void check_hull() {
    const auto is_less = [&](Id a, Id b) {
      const auto [dx, dy] = minus(course(a), course(b));
      const int sign = sign_just_after(dx, now_);
      return sign != 0 ? sign < 0 : sign_just_after(dy, now_) < 0;
    };
    const auto count = std::ranges::count_if(hull_, [&](Id v) {
      return is_less(v, apex(v, infinite)) && is_less(v, apex(infinite, v));
    });
    if (count != 1) refute("the hull goes around " + std::to_string(count) + " times");
  }

  std::vector<const Course*> witness_;  // three points that are not always on a line, if there are
  bool is_on_line_ = true;              // all points, at all times
  std::vector<std::set<Id>> neighbors_;
  std::size_t edges_ = 0;
  std::unordered_map<std::uint64_t, Id> left_;  // apexes
  std::set<Id> hull_;

  // In this instant:
  std::set<Id> touched_;    // points whose triangles must be made anew
  std::set<Edge> changed_;  // edges whose ends or apexes changed
};

}  // namespace verify

#endif  // KINETRI_VERIFY_SURFACE_H
