// SPDX-License-Identifier: GPL-3.0-or-later
#include "checker.h"

namespace verify {

Checker::Checker(const std::vector<Motion>& motions, const Dyadic& from, const Dyadic& until)
    : neighbors_(motions.size()),
      next_(motions.size(), none),
      previous_(motions.size(), none),
      now_(exactly(from)),
      until_(exactly(until)) {
  unsigned long e = 0;
  for (const Motion& motion : motions) {
    for (const double number : motion) e = std::max(e, dyadic(number).e);
  }
  for (const Motion& motion : motions) {
    std::array<Integer, 4> c;
    for (std::size_t i = 0; i < 4; ++i) {
      const Dyadic number = dyadic(motion[i]);
      c[i] = number.m << (e - number.e);
    }
    points_.push_back({trimmed({c[0], c[2]}), trimmed({c[1], c[3]})});
  }
  Polynomial flat;
  for (Id i = 2; i < points_.size(); ++i) {
    flat = greatest_common_divisor(flat, orientation(0, 1, i));
  }
  is_on_line_ = flat.empty();
  add_special_times(flat);
}

// ---- the triangulation ----

void Checker::add_triangle(Id a, Id b, Id c) {
  for (const auto& [u, v, w] : {Triangle{a, b, c}, Triangle{b, c, a}, Triangle{c, a, b}}) {
    if (!neighbors_[u].contains(v)) {
      refute("the face with the edge " + name(edge(v, w)) + " is no triangle: there is no edge " +
             name(edge(u, v)));
    }
    if (!left_.emplace(key(u, v), w).second && apex(u, v) != w) {
      refute("two triangles are on the same side of the edge " + name(edge(u, v)));
    }
    changed_edges_.insert(edge(u, v));
  }
  changed_triangles_.insert(triangle(a, b, c));
}

void Checker::remove_triangle(Id a, Id b, Id c) {
  for (const auto& [u, v] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    left_.erase(key(u, v));
    changed_edges_.insert(edge(u, v));
  }
  changed_triangles_.insert(triangle(a, b, c));
}

void Checker::remove_edge(const Edge& removed) {
  const auto [a, b] = removed;
  if (neighbors_[a].erase(b) == 0) refute("there is no edge " + name(removed) + " to be removed");
  neighbors_[b].erase(a);
  --edges_;
}

void Checker::add_edge(const Edge& added) {
  const auto [a, b] = added;
  if (!neighbors_[a].insert(b).second) refute("the edge " + name(added) + " is there already");
  neighbors_[b].insert(a);
  ++edges_;
  const auto [x, y] = minus(a, b);
  add_special_times(greatest_common_divisor(x, y));
}

// Lets b follow a on the hull.
void Checker::set_hull(Id a, Id b) {
  next_[a] = b;
  previous_[b] = a;
  changed_corners_.insert({a, b});
  is_hull_changed_ = true;
}

void Checker::make_star(Id v) {
  // Around v, in two halves of the directions: up from the positive x-axis, and down from the
  // negative one.
  const auto is_lower = [&](Id n) {
    const auto [x, y] = minus(n, v);
    const int sign = sign_just_after(y, now_);
    return sign < 0 || (sign == 0 && sign_just_after(x, now_) < 0);
  };
  std::array<std::vector<Id>, 2> halves;
  for (const Id n : neighbors_[v]) halves[is_lower(n) ? 1 : 0].push_back(n);
  std::vector<Id> star;
  for (std::vector<Id>& half : halves) {
    std::sort(half.begin(), half.end(),
              [&](Id a, Id b) { return sign_just_after(orientation(v, a, b), now_) > 0; });
    star.insert(star.end(), half.begin(), half.end());
  }
  for (std::size_t i = 0; i < star.size(); ++i) {
    const Id a = star[i];
    const Id b = star[i + 1 == star.size() ? 0 : i + 1];
    if (sign_just_after(orientation(v, a, b), now_) > 0) {
      add_triangle(v, a, b);
    } else if (next_[v] == none) {
      next_[v] = b;
      previous_[v] = a;
      changed_corners_.insert({a, b});
    } else {
      refute("the triangles around point " + std::to_string(v) + " leave two gaps");
    }
  }
}

// ---- certificates ----

std::string Checker::name(const Certificate& certificate) {
  const std::vector<Id>& p = certificate.points;
  if (p.size() == 4 && p[3] != none) return "edge " + name(edge(p[0], p[1]));
  std::string result = p.size() == 3 ? "triangle" : "hull corner";
  for (std::size_t i = 0; i < 3; ++i) result += " " + std::to_string(p[i]);
  return result;
}

// Refutes unless the certificate holds from its birth until now, or just after now.
void Checker::check_life(const Certificate& certificate, bool with_end) {
  Time birth = certificate.birth;
  std::optional<Time> failure = first_failure(certificate.p, birth, now_, with_end);
  if (!failure) return;
  for (int i = 0; i < 60 && !failure->is_dyadic(); ++i) refine(*failure);
  std::string before = "the end";
  for (std::size_t i = 0; i < rows_->size(); ++i) {
    if (compare((*rows_)[i].hi, failure->lo) < 0) continue;
    before = "row " + std::to_string(i);
    where_ = before;
    break;
  }
  char number[40];
  const double time = approximate(failure->hi);
  const auto end = std::to_chars(number, number + sizeof number, time).ptr;
  refute(name(certificate) + " fails at " + std::string(number, end) + ", before " + before +
         ", and stays\n  polynomial " + text(certificate.p) +
         "\n  has a root of odd multiplicity in [" + std::to_string(approximate(failure->lo)) +
         ", " + std::to_string(time) + "]");
}

// Brings a certificate up to date with the triangulation just after now: `points` are empty if
// there is to be none.
template <class Key>
void Checker::renew(std::map<Key, Certificate>& all, const Key& which, std::vector<Id> points,
                    const std::function<Polynomial()>& polynomial) {
  const auto found = all.find(which);
  if (found != all.end()) {
    if (found->second.points == points) return;
    check_life(found->second, false);
    all.erase(found);
  }
  if (points.empty()) return;
  Certificate certificate = {std::move(points), polynomial(), now_};
  ++certificates_;
  const int sign = sign_just_after(certificate.p, now_);
  const bool may_be_zero = certificate.points.size() == 4;
  if (sign < 0 || (sign == 0 && !may_be_zero)) {
    refute(name(certificate) + " does not hold just after " + std::to_string(approximate(now_.hi)) +
           "\n  polynomial " + text(certificate.p));
  }
  all.emplace(which, std::move(certificate));
}

// All triangles anew, from the edges and their directions just after now.
void Checker::remake() {
  for (const auto& [ab, c] : std::exchange(left_, {})) {
    const Id a = static_cast<Id>(ab >> 32U);
    const Id b = static_cast<Id>(ab);
    changed_triangles_.insert(triangle(a, b, c));
    changed_edges_.insert(edge(a, b));
  }
  is_hull_changed_ = true;
  for (Id v = 0; v < points_.size(); ++v) {
    if (neighbors_[v].size() < (is_on_line_ ? 1 : 2) && points_.size() > 1) {
      refute("point " + std::to_string(v) + " is in no triangle");
    }
    changed_corners_.insert(v);
    next_[v] = previous_[v] = none;
    if (!is_on_line_) make_star(v);
  }
}

// Everything that has changed at this instant holds just after it.
void Checker::close_instant() {
  if (is_remade_) remake();
  is_remade_ = false;
  for (const Triangle& t : std::exchange(changed_triangles_, {})) {
    const auto [a, b, c] = t;
    std::vector<Id> points;
    if (apex(a, b) == c) points = {a, b, c};
    renew(triangle_certificates_, t, std::move(points),
          [&] { return orientation(t[0], t[1], t[2]); });
  }
  for (const Edge& e : std::exchange(changed_edges_, {})) {
    const Id l = apex(e.first, e.second);
    const Id r = apex(e.second, e.first);
    std::vector<Id> points;
    if (l != none && r != none) points = {e.first, e.second, l, r};
    renew(edge_certificates_, e, std::move(points),
          [&] { return outside(e.first, e.second, l, r); });
  }
  if (is_hull_changed_) is_on_line_ ? check_path() : check_hull();
  for (const Id v : std::exchange(changed_corners_, {})) {
    const Id a = previous_[v];
    const Id b = next_[v];
    std::vector<Id> points;
    if (a != none && b != none) points = {a, v, b, none};
    renew(corner_certificates_, v, points, [&] { return corner(a, v, b); });
    if (points.empty()) continue;
    // A double root of a corner is a rational number (Lemma 6).
    const Polynomial& p = corner_certificates_.at(v).p;
    if (p.size() != 3 || p[1] * p[1] != 4 * p[0] * p[2]) continue;
    Integer below;
    mpz_fdiv_q(below.get_mpz_t(), Integer(-p[1]).get_mpz_t(), Integer(2 * p[2]).get_mpz_t());
    for (Time& root : roots_in(derivative(p), {below, 0}, {below + 1, 0})) {
      if (compare(root, now_) > 0 && compare(root, until_) <= 0) touches_.emplace_back(v, root);
    }
  }
  if (is_hull_changed_ && !is_on_line_) check_goes_around_once(now_);
  is_hull_changed_ = false;
}

// The edges with a triangle at one side only are the cycle that the hull is said to be (Lemma 4).
void Checker::check_hull() {
  const auto first = std::find_if(next_.begin(), next_.end(), [](Id id) { return id != none; });
  if (first == next_.end()) refute("the triangulation has no hull");
  std::size_t length = 0;
  const Id start = static_cast<Id>(first - next_.begin());
  Id v = start;
  do {
    const Id n = next_[v];
    if (n == none || previous_[n] != v || apex(v, n) == none || apex(n, v) != none ||
        ++length > points_.size()) {
      refute("the hull is not a cycle at point " + std::to_string(v));
    }
    v = n;
  } while (v != start);
  const auto on_hull =
      points_.size() - static_cast<std::size_t>(std::count(next_.begin(), next_.end(), none));
  if (length != on_hull) refute("the hull is more than one cycle");
  if (left_.size() + length != 2 * edges_) refute("an edge inside the hull lacks a triangle");
}

// One corner of the hull is less than both its neighbors, in the order of x, then y, just after
// then.
void Checker::check_goes_around_once(Time time) const {
  const auto is_less = [&](Id a, Id b) {
    const auto [x, y] = minus(a, b);
    const int sign = sign_just_after(x, time);
    return sign != 0 ? sign < 0 : sign_just_after(y, time) < 0;
  };
  std::size_t count = 0;
  for (Id v = 0; v < points_.size(); ++v) {
    if (next_[v] != none && is_less(v, next_[v]) && is_less(v, previous_[v])) ++count;
  }
  if (count != 1) refute("the hull goes around " + std::to_string(count) + " times");
}

// Points that are always on a line: the edges are a path, and its inner points are its corners.
void Checker::check_path() {
  if (points_.size() < 2) return;
  if (edges_ + 1 != points_.size()) refute("the points are on a line, but their edges are no path");
  Id v = 0;
  while (v < points_.size() && neighbors_[v].size() != 1) ++v;
  std::size_t length = 1;
  for (Id from = none; v < points_.size(); ++length) {
    const std::set<Id>& n = neighbors_[v];
    if (n.size() > 2) break;
    if (n.size() == 2) {
      previous_[v] = *n.begin();
      next_[v] = *n.rbegin();
    }
    const Id to = *n.begin() != from ? *n.begin() : *n.rbegin();
    if (to == from) break;
    from = std::exchange(v, to);
  }
  if (length != points_.size()) refute("the points are on a line, but their edges are no path");
}

// ---- time ----

// Goes on to the time, by way of those at which the triangles may change without an event (Lemma
// 5).
void Checker::open_instant(Time time) {
  while (!special_times_.empty()) {
    Time special = special_times_.front();
    const int order = compare(special, time);
    if (order > 0) break;
    special_times_.erase(special_times_.begin());
    open_instant_itself(std::move(special));
    is_remade_ = true;
    if (order == 0) return;
    close_instant();
  }
  open_instant_itself(std::move(time));
}

void Checker::add_special_times(const Polynomial& p) {
  if (p.size() < 2) return;
  for (Time& time : roots_in(square_free_part(p), now_.lo, until_.hi)) {
    if (compare(time, now_) <= 0) continue;
    auto place = special_times_.begin();
    int order = 1;
    while (place != special_times_.end() && (order = compare(*place, time)) < 0) ++place;
    if (place == special_times_.end() || order != 0) special_times_.insert(place, std::move(time));
  }
}

// No touch of the hull before this time lets it go around more than once (Lemma 6).
void Checker::open_instant_itself(Time time) {
  std::erase_if(touches_, [&](std::pair<Id, Time>& touch) {
    if (compare(touch.second, time) >= 0) return false;
    if (!is_on_line_) check_goes_around_once(touch.second);
    return true;
  });
  now_ = std::move(time);
}

bool Checker::is_in(Time& time, const Row& row) {
  Time lo = exactly(row.lo);
  Time hi = exactly(row.hi);
  return compare(time, lo) >= 0 && compare(time, hi) <= 0;
}

// What is wrong after the rows before this one is their fault.
void Checker::close_instant_before(const Row& row) {
  const std::string where = where_;
  const auto index = &row - rows_->data();
  where_ = index == 0 ? "initial edges" : "row " + std::to_string(index - 1);
  close_instant();
  where_ = where;
}

// Goes on to the time at which something fails that this row ends.
void Checker::enter(std::optional<Time> failure, const Row& row, const std::string& what) {
  const std::string interval =
      "[" + std::to_string(approximate(row.lo)) + ", " + std::to_string(approximate(row.hi)) + "]";
  if (!failure) refute(what + " does not fail in " + interval);
  const int order = compare(*failure, now_);
  if (order < 0) refute(what + " fails before the event in the row before");
  if (compare(*failure, until_) > 0) refute(what + " fails after the end");
  if (order == 0) return;
  close_instant_before(row);
  open_instant(std::move(*failure));
}

// The first time in the interval of the row at which the certificate fails.
std::optional<Time> Checker::failure_in(const Certificate& certificate, const Row& row) {
  if (certificate.p.size() < 2) return std::nullopt;
  Time birth = certificate.birth;
  for (Time& root : roots_in(odd_part(certificate.p), row.lo, row.hi)) {
    if (compare(root, birth) > 0) return root;
  }
  return std::nullopt;
}

// The same for the certificate of `points`, with the polynomial p. One that is made only at this
// instant fails at once if it is negative just after it.
template <class Key>
std::optional<Time> Checker::failure_of(std::map<Key, Certificate>& all, const Key& which,
                                        const std::vector<Id>& points, const Polynomial& p,
                                        const Row& row) {
  auto found = all.find(which);
  if (found == all.end() || found->second.points != points) {
    if (is_in(now_, row) && sign_just_after(p, now_) < 0) return now_;
    close_instant_before(row);
    found = all.find(which);
  }
  return failure_in(found->second, row);
}

void Checker::flip(const Row& row) {
  const auto [a, b] = row.removed.front();
  const Id l = apex(a, b);
  const Id r = apex(b, a);
  const std::string what = "edge " + name(row.removed.front());
  if (l == none || r == none) refute(what + " is not between two triangles");
  if (edge(l, r) != row.added.front()) {
    refute(what + " becomes " + name(edge(l, r)) + ", and not " + name(row.added.front()));
  }
  enter(failure_of(edge_certificates_, edge(a, b), {a, b, l, r}, outside(a, b, l, r), row), row,
        what);
  remove_triangle(a, b, l);
  remove_triangle(b, a, r);
  remove_edge(row.removed.front());
  add_edge(row.added.front());
  add_triangle(l, r, b);
  add_triangle(r, l, a);
}

void Checker::hull_insert(const Row& row) {
  auto [a, b] = row.removed.front();
  const std::string what = "hull edge " + name(row.removed.front());
  if (next_[a] != b) std::swap(a, b);
  if (next_[a] != b) refute(what + " is not on the hull");
  const Id c = apex(a, b);
  if (next_[c] != none) refute("point " + std::to_string(c) + " is on the hull already");
  const Triangle t = triangle(a, b, c);
  enter(failure_of(triangle_certificates_, t, {t[0], t[1], t[2]}, orientation(a, b, c), row), row,
        what);
  remove_triangle(a, b, c);
  remove_edge(row.removed.front());
  set_hull(a, c);
  set_hull(c, b);
}

void Checker::hull_remove(const Row& row) {
  const auto [first, second] = row.added.front();
  std::optional<Time> failure;
  Id a = none;
  for (const auto& [u, w] : {std::pair(first, second), std::pair(second, first)}) {
    const Id v = next_[u];
    if (v == none || next_[v] != w || next_[w] == u) continue;
    std::optional<Time> found =
        failure_of(corner_certificates_, v, {u, v, w, none}, orientation(u, v, w), row);
    if (found && (!failure || compare(*found, *failure) < 0)) {
      failure = std::move(found);
      a = u;
    }
  }
  enter(std::move(failure), row, "a hull corner below the edge " + name(row.added.front()));
  const Id b = next_[a];
  const Id c = next_[b];
  add_edge(row.added.front());
  add_triangle(a, c, b);
  next_[b] = previous_[b] = none;
  changed_corners_.insert(b);
  set_hull(a, c);
}

// When the rebuild takes place: at this instant, when points meet or all are on a line, or at the
// first failure of a certificate of the points whose edges change; if none fails, when one touches
// 0.
std::optional<Time> Checker::time_of_rebuild(const Row* begin, const Row* end) {
  if (is_remade_ && is_in(now_, *begin)) return now_;
  close_instant_before(*begin);
  if (!special_times_.empty() && is_in(special_times_.front(), *begin))
    return special_times_.front();
  std::set<Id> touched;
  for (const Row* row = begin; row != end; ++row) {
    for (const auto& edges : {row->removed, row->added}) {
      for (const auto& [a, b] : edges) touched.insert({a, b});
    }
  }
  std::optional<Time> first;
  for (const bool is_touch : {false, true}) {
    const auto look_at = [&](const auto& all) {
      for (const auto& [which, certificate] : all) {
        const auto& p = certificate.points;
        if (certificate.p.size() < 2 ||
            std::none_of(p.begin(), p.end(), [&](Id id) { return touched.contains(id); })) {
          continue;
        }
        Time birth = certificate.birth;
        const Polynomial q = is_touch ? square_free_part(certificate.p) : odd_part(certificate.p);
        for (Time& root : roots_in(q, begin->lo, begin->hi)) {
          if (compare(root, birth) > 0 && compare(root, now_) >= 0 &&
              (!first || compare(root, *first) < 0)) {
            first = root;
          }
        }
      }
    };
    look_at(triangle_certificates_);
    look_at(edge_certificates_);
    look_at(corner_certificates_);
    if (first) break;
    if (is_in(now_, *begin)) return now_;
  }
  return first;
}

void Checker::rebuild(const Row* begin, const Row* end) {
  enter(time_of_rebuild(begin, end), *begin, "what is rebuilt");
  for (const Row* row = begin; row != end; ++row) {
    where_ = "row " + std::to_string(row - rows_->data());
    for (const Edge& e : row->removed) remove_edge(e);
    for (const Edge& e : row->added) add_edge(e);
  }
  is_remade_ = true;
  close_instant();
}

void Checker::check_end(const std::vector<Edge>* final_edges) {
  where_ = "the end";
  if (compare(now_, until_) < 0) {
    close_instant();
    open_instant(until_);
  }
  close_instant();
  for (const auto& [which, certificate] : triangle_certificates_) check_life(certificate, true);
  for (const auto& [which, certificate] : edge_certificates_) check_life(certificate, true);
  for (const auto& [which, certificate] : corner_certificates_) check_life(certificate, true);
  for (auto& [v, time] : touches_) {
    if (!is_on_line_) check_goes_around_once(time);
  }
  if (final_edges == nullptr) return;
  for (const auto& [a, b] : *final_edges) {
    if (!neighbors_[a].contains(b)) refute("there is no edge " + name(Edge(a, b)) + " of the file");
  }
  if (final_edges->size() != edges_) refute("the file of edges lacks an edge");
}

void Checker::check(const std::vector<Edge>& initial_edges, const std::vector<Row>& rows,
                    const std::vector<Edge>* final_edges,
                    const std::function<void(std::size_t)>& on_row) {
  rows_ = &rows;
  for (const Edge& e : initial_edges) add_edge(e);
  is_remade_ = true;
  close_instant();
  for (std::size_t i = 0; i < rows.size();) {
    const Row& row = rows[i];
    where_ = "row " + std::to_string(i);
    std::size_t end = i + 1;
    Time lo = exactly(row.lo);
    if (!special_times_.empty() && compare(special_times_.front(), lo) < 0) {
      close_instant_before(row);
      while (!special_times_.empty() && compare(special_times_.front(), lo) < 0) {
        open_instant(Time(special_times_.front()));
        close_instant();
      }
    }
    if (row.kind == "rebuild") {
      // One instant: the edges removed, then those added.
      while (end < rows.size() && rows[end].kind == "rebuild" &&
             compare(rows[end].lo, row.lo) == 0 && compare(rows[end].hi, row.hi) == 0 &&
             rows[end - 1].removed.size() >= rows[end].removed.size()) {
        ++end;
      }
      rebuild(&row, &row + (end - i));
    } else if (row.kind == "flip") {
      flip(row);
    } else if (row.kind == "hull_insert") {
      hull_insert(row);
    } else {
      hull_remove(row);
    }
    i = end;
    on_row(i);
  }
  check_end(final_edges);
}

}  // namespace verify
