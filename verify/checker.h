// SPDX-License-Identifier: GPL-3.0-or-later
// Goes through the log and decides whether its edges are a Delaunay triangulation at all times. The
// lemmas named here are in README.md.
#ifndef KINETRI_VERIFY_CHECKER_H
#define KINETRI_VERIFY_CHECKER_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "files.h"
#include "roots.h"

namespace verify {

constexpr Id none = static_cast<Id>(-1);

using Moving_point = std::array<Polynomial, 2>;
using Triangle = std::array<Id, 3>;  // counterclockwise, the smallest id first

class Checker {
 public:
  Checker(const std::vector<Motion>& motions, const Dyadic& from, const Dyadic& until);

  // All of it; throws Refuted. `on_row` is called after each row.
  void check(const std::vector<Edge>& initial_edges, const std::vector<Row>& rows,
             const std::vector<Edge>* final_edges, const std::function<void(std::size_t)>& on_row);

  std::size_t certificates() const { return certificates_; }

 private:
  // What must not be negative for as long as `points` are what they are: the points of a triangle,
  // an edge with the apexes at its left and at its right, or a corner of the hull.
  struct Certificate {
    std::vector<Id> points;
    Polynomial p;
    Time birth;
  };

  // ---- polynomials of the points (README: the certificates) ----
  Moving_point minus(Id a, Id b) const {
    return {points_[a][0] - points_[b][0], points_[a][1] - points_[b][1]};
  }
  static Polynomial cross(const Moving_point& u, const Moving_point& v) {
    return u[0] * v[1] - u[1] * v[0];
  }
  static Polynomial dot(const Moving_point& u, const Moving_point& v) {
    return u[0] * v[0] + u[1] * v[1];
  }
  // Positive if abc is a left turn.
  Polynomial orientation(Id a, Id b, Id c) const { return cross(minus(b, a), minus(c, a)); }
  // Positive if d is outside the circle through a, b, c, which are counterclockwise.
  Polynomial outside(Id a, Id b, Id c, Id d) const {
    const Moving_point u = minus(a, d);
    const Moving_point v = minus(b, d);
    const Moving_point w = minus(c, d);
    return -(dot(u, u) * cross(v, w) + dot(v, v) * cross(w, u) + dot(w, w) * cross(u, v));
  }
  // Not negative if b is a corner of a convex hull: a left turn or, where a, b and c are always on
  // a line, no way back.
  Polynomial corner(Id a, Id b, Id c) const {
    Polynomial p = orientation(a, b, c);
    return p.empty() ? dot(minus(b, a), minus(c, b)) : p;
  }

  // ---- the triangulation ----
  Id apex(Id a, Id b) const {
    const auto found = left_.find(key(a, b));
    return found == left_.end() ? none : found->second;
  }
  static std::uint64_t key(Id a, Id b) { return std::uint64_t{a} << 32U | b; }
  static Edge edge(Id a, Id b) { return {std::min(a, b), std::max(a, b)}; }
  static Triangle triangle(Id a, Id b, Id c) {
    Triangle t = {a, b, c};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  }
  void add_triangle(Id a, Id b, Id c);
  void remove_triangle(Id a, Id b, Id c);
  void remove_edge(const Edge& removed);
  void add_edge(const Edge& added);
  void set_hull(Id a, Id b);
  void make_star(Id v);

  // ---- time ----
  void open_instant(Time time);
  void open_instant_itself(Time time);
  void remake();
  void add_special_times(const Polynomial& p);
  void close_instant();
  void enter(std::optional<Time> failure, const Row& row, const std::string& what);
  static bool is_in(Time& time, const Row& row);
  void close_instant_before(const Row& row);
  std::optional<Time> failure_in(const Certificate& certificate, const Row& row);
  template <class Key>
  std::optional<Time> failure_of(std::map<Key, Certificate>& all, const Key& which,
                                 const std::vector<Id>& points, const Polynomial& p,
                                 const Row& row);
  void flip(const Row& row);
  void hull_insert(const Row& row);
  void hull_remove(const Row& row);
  void rebuild(const Row* begin, const Row* end);
  std::optional<Time> time_of_rebuild(const Row* begin, const Row* end);
  void check_end(const std::vector<Edge>* final_edges);

  // ---- certificates ----
  template <class Key>
  void renew(std::map<Key, Certificate>& all, const Key& which, std::vector<Id> points,
             const std::function<Polynomial()>& polynomial);
  void check_life(const Certificate& certificate, bool with_end);
  void check_hull();
  void check_goes_around_once(Time time) const;
  void check_path();

  [[noreturn]] void refute(const std::string& message) const { throw Refuted{where_, message}; }
  static std::string name(const Edge& e) {
    return std::to_string(e.first) + "-" + std::to_string(e.second);
  }
  static std::string name(const Certificate& certificate);

  std::vector<Moving_point> points_;  // all times the same power of two
  bool is_on_line_ = true;            // all points, at all times
  std::vector<std::set<Id>> neighbors_;
  std::size_t edges_ = 0;
  std::unordered_map<std::uint64_t, Id> left_;  // the triangle at the left of a directed edge
  std::vector<Id> next_, previous_;             // on the hull, counterclockwise
  std::map<Triangle, Certificate> triangle_certificates_;
  std::map<Edge, Certificate> edge_certificates_;
  std::map<Id, Certificate> corner_certificates_;
  std::set<Triangle> changed_triangles_;  // in this instant
  std::set<Edge> changed_edges_;
  std::set<Id> changed_corners_;
  bool is_hull_changed_ = true;
  std::vector<std::pair<Id, Time>> touches_;  // of corners, to come
  std::vector<Time> special_times_;  // to come, in order: points meet, or all are on a line
  bool is_remade_ = false;           // all triangles are to be made anew at this instant
  Time now_;
  Time until_;
  std::string where_ = "initial edges";
  const std::vector<Row>* rows_ = nullptr;
  std::size_t certificates_ = 0;
};

}  // namespace verify

#endif  // KINETRI_VERIFY_CHECKER_H
