// SPDX-License-Identifier: GPL-3.0-or-later
// Goes through the log and decides whether its edges are a Delaunay triangulation at all times. The
// lemmas named here are in README.md.
#ifndef KINETRI_VERIFY_CHECKER_H
#define KINETRI_VERIFY_CHECKER_H

#include "lives.h"

namespace verify {

class Checker {
 public:
  Checker(const Options& options, const std::vector<Change>& points, const std::vector<Row>& rows)
      : options_(options), rows_(rows), scale_(options, points, rows), certifier_(options, scale_) {
    Id size = 0;
    const auto note_id = [&](const Change& change) { size = std::max(size, change.id + 1); };
    std::ranges::for_each(points, note_id);
    for (const Row& row : rows) std::ranges::for_each(row.changes, note_id);
    courses_.resize(size);
    neighbors_.resize(size);
    workers_.resize(options.threads - 1);
    push_instant(exactly(options.from));
    for (const Change& change : points) set_motion(change);
  }

  // All of it; throws Refuted. Returns the number of certificates.
  std::size_t check(const std::vector<Edge>& initial_edges, const std::vector<Edge>* final_edges) {
    try {
      for (const Edge& e : initial_edges) add_edge(e);
      while (++row_ < std::ssize(rows_) && !refuted_) {
        enter(rows_[static_cast<std::size_t>(row_)]);
        if (row_ % 100'000 == 99'999) std::cerr << row_ + 1 << " of " << rows_.size() << " rows\n";
      }
      if (!refuted_) check_end(final_edges);
    } catch (const Refuted& refuted) {
      note(refuted);
    }
    // What is false may have begun before the row at which it was noticed.
    for (auto& lives : alive_) {
      for (auto& [id, life] : lives) {
        life.goes_on = is_complete_;
        end(life);
      }
    }
    note(refutation_of(ended_));
    for (auto& worker : workers_) {
      if (worker.valid()) note(worker.get());
    }
    if (refuted_) throw Refuted(*refuted_);
    return certificates_;
  }

 private:
  using Triangle = std::array<Id, 3>;

  // The ends of an edge meet; or all points may be on a line (both infinite); or a hidden point
  // leaves its triangle (both are that point).
  struct Special {
    Time time;
    Id a, b;
  };

  // ---- the triangulation: a closed surface with an infinite point ----

  static std::uint64_t key(Id a, Id b) { return std::uint64_t{a} << 32U | b; }
  static Edge edge(Id a, Id b) { return {std::min(a, b), std::max(a, b)}; }
  static std::string name(const Edge& e) {
    const std::string a = std::to_string(e.first);
    return e.second == infinite ? "hull corner " + a : "edge " + a + "-" + std::to_string(e.second);
  }

  // The third corner of the triangle at the left.
  Id apex(Id a, Id b) const {
    const auto found = left_.find(key(a, b));
    return found == left_.end() ? absent : found->second;
  }
  bool is_present(Id id) const { return id < courses_.size() && courses_[id] != nullptr; }
  const Course& course(Id id) const { return *courses_[id]; }

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

  // The triangles anew at all points that are touched.
  void remake() {
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
    const auto has_other_radius = [&](const Course* c) {
      return c != nullptr && c->radius != witness_.front()->radius;
    };
    if (!hidden_.empty() && std::ranges::any_of(courses_, has_other_radius)) {
      throw Bad_input("hidden points among points on one line are not supported");
    }
    if (present_ > 0 && edges_ + 1 != present_)
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

  void touch_all() {
    for (Id v = 0; v < courses_.size(); ++v) {
      if (is_present(v)) touched_.insert(v);
    }
  }

  // Three points that are not always on a line, if there are any.
  void find_witness() {
    is_witness_lost_ = false;
    witness_.clear();
    for (const Course* c : courses_) {
      if (c == nullptr || (witness_.size() == 1 && c->place == witness_[0]->place)) continue;
      if (witness_.size() == 2 && orientation(*witness_[0], *witness_[1], *c).empty()) continue;
      witness_.push_back(c);
      if (witness_.size() == 3) break;
    }
    const bool was_on_line = std::exchange(is_on_line_, witness_.size() < 3);
    if (is_on_line_) return;
    if (was_on_line) {
      for (const auto& [ab, c] : left_) {
        changed_.insert(edge(static_cast<Id>(ab >> 32U), static_cast<Id>(ab)));
      }
      left_.clear();
      touch_all();
    }
    add_specials(orientation(*witness_[0], *witness_[1], *witness_[2]), infinite, infinite);
  }

  // ---- time ----

  void push_instant(const Time& time) {
    now_ = time;
    instant_ = std::make_shared<const Instant>(Instant{time, row_, row_});
    contacts_.clear();
    is_rebuilt_ = false;
  }

  void add_specials(const Polynomial& p, Id a, Id b) {
    for (Time& root : verify::roots_in(p, now_.lo, options_.until)) {
      if (compare(root, now_) <= 0) continue;
      int order = 1;
      const auto place = std::ranges::find_if(specials_, [&](Special& s) {
        order = compare(s.time, root);
        return order > 0 || (order == 0 && s.a == a && s.b == b);
      });
      if (place == specials_.end() || order > 0) specials_.insert(place, {root, a, b});
    }
  }

  void touch_special() {
    const auto [time, a, b] = specials_.front();
    specials_.pop_front();
    if (a == infinite) {
      if (is_on_line_) return;  // a time of points that have gone
      const auto is_flat = [&](const Course* c) {
        return c == nullptr || sign_at(orientation(*witness_[0], *witness_[1], *c), now_) == 0;
      };
      if (std::ranges::all_of(courses_, is_flat)) touch_all();
    } else if (a == b) {
      renew(hidden_life, key(a, a), std::nullopt);
      if (neighbors_[a].empty()) touched_.insert(a);
    } else if (neighbors_[a].contains(b)) {
      touched_.insert({a, b});
      for (const Id v : {a, b}) touched_.insert(neighbors_[v].begin(), neighbors_[v].end());
    }
  }

  // Goes by the times before this one at which triangles may change without a row (Lemma 5).
  void pass_before(Time time) {
    close();
    while (!specials_.empty() && compare(specials_.front().time, time) < 0) {
      if (compare(specials_.front().time, now_) > 0) push_instant(specials_.front().time);
      touch_special();
      close();
    }
  }

  void open(Time time) {
    Time until = exactly(options_.until);
    const int order = compare(time, now_);
    if (order < 0) refute("it is before the row before");
    if (compare(time, until) > 0) refute("it is after the end");
    if (order == 0) return;
    pass_before(time);
    push_instant(time);
    while (!specials_.empty() && compare(specials_.front().time, now_) == 0) touch_special();
  }

  // Everything that has changed at this time holds just after it.
  void close() {
    if (changed_.empty() && touched_.empty() && moved_.empty()) return;
    // Lives that have ended hold the instant as it was, which other threads read.
    if (instant_->rows_end != row_) {
      instant_ = std::make_shared<const Instant>(Instant{now_, instant_->first_row, row_});
    }
    const long row = std::exchange(blamed_, instant_->blamed());
    if (is_witness_lost_) find_witness();
    note_hidden();
    is_on_line_ ? make_path() : remake();
    for (const Id v : moved_) {
      const bool is_boxed = is_present(v) && !options_.box.empty();
      renew(box_life, key(v, v),
            is_boxed ? std::optional(Points{v, absent, absent, absent}) : std::nullopt);
    }
    moved_.clear();
    bool is_hull_changed = false;
    for (const auto& [a, b] : std::exchange(changed_, {})) {
      const Points points = {a, b, apex(a, b), apex(b, a)};
      const bool is_there = b == infinite ? points[2] != absent : neighbors_[a].contains(b);
      if (is_there && !is_on_line_ && (points[2] == absent || points[3] == absent)) {
        refute(name({a, b}) + " has no triangle on one side");
      }
      renew(edge_life, key(a, b), is_there ? std::optional(points) : std::nullopt);
      if (b == infinite) is_hull_changed = true;
    }
    if (is_hull_changed && !is_on_line_) check_hull();
    place_hidden();
    blamed_ = row;
  }

  // The hull goes around once: one corner is less than both neighbors, in the order of x, then y.
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

  // A point that is there without an edge is hidden, and rows tell of each change (Lemma 6).
  void note_hidden() {
    std::set<Id> looked_at = touched_;
    for (const auto& more : {moved_, told_}) looked_at.insert(more.begin(), more.end());
    for (const Id v : looked_at) {
      const std::string which = "point " + std::to_string(v);
      if (!is_present(v) && !neighbors_[v].empty()) refute(which + " still has edges");
      const bool is_hidden = is_present(v) && neighbors_[v].empty() && present_ > 1;
      const bool is_told = told_.erase(v) > 0;
      const bool has_changed = is_hidden != hidden_.contains(v);
      if (has_changed != is_told && !moved_.contains(v)) {
        refute(which + (is_told ? " is neither hidden nor revealed" : " is hidden or revealed"));
      }
      if (is_hidden) {
        hidden_.try_emplace(v, Triangle{absent, absent, absent});
      } else if (hidden_.erase(v) > 0) {
        renew(hidden_life, key(v, v), std::nullopt);
      }
    }
  }

  // The triangle of each hidden point.
  void place_hidden() {
    for (auto& [v, t] : hidden_) {
      const auto life = alive_[hidden_life].find(key(v, v));
      const bool is_there = t[0] != absent && apex(t[0], t[1]) == t[2];
      if (is_there && life != alive_[hidden_life].end() &&
          life->second.courses == courses({t[0], t[1], t[2], v})) {
        continue;
      }
      t = triangle_of(v, is_there ? t : Triangle{absent, absent, absent});
      renew(hidden_life, key(v, v), Points{t[0], t[1], t[2], v});
      for (std::size_t i = 0; i < 3; ++i) {
        add_specials(orientation(course(t[i]), course(t[(i + 1) % 3]), course(v)), v, v);
      }
    }
  }

  // Walks from a triangle, or from any one, to one that contains the point just after now.
  Triangle triangle_of(Id v, Triangle t) {
    for (auto any = left_.begin(); t[0] == absent && any != left_.end(); ++any) {
      const Triangle found = {static_cast<Id>(any->first >> 32U), static_cast<Id>(any->first),
                              any->second};
      if (std::ranges::max(found) != infinite) t = found;
    }
    for (std::size_t steps = 0; t[0] != absent && t[2] != infinite && steps < left_.size();
         ++steps) {
      const auto is_beyond = [&](std::size_t i) {
        const Polynomial p = orientation(course(t[i]), course(t[(i + 1) % 3]), course(v));
        return sign_just_after(p, now_) < 0;
      };
      std::size_t side = 0;
      while (side < 3 && !is_beyond(side)) ++side;
      if (side == 3) return t;
      const Id a = t[(side + 1) % 3];
      t = {a, t[side], apex(a, t[side])};
    }
    refute("point " + std::to_string(v) + " is in no triangle");
  }

  // ---- rows ----

  static bool is_of_time_of(const Row& a, const Row& b) {
    return compare(a.lo, b.lo) == 0 && compare(a.hi, b.hi) == 0;
  }
  // The ends of an interval are equal if the time is a binary64 number, and only then.
  static bool is_in(Time& time, const Row& row) {
    Time lo = exactly(row.lo);
    Time hi = exactly(row.hi);
    const int order = compare(time, lo);
    return compare(row.lo, row.hi) == 0 ? order == 0 : order > 0 && compare(time, hi) < 0;
  }
  static std::vector<Time> roots_in(const Polynomial& p, const Row& row) {
    std::vector<Time> roots = verify::roots_in(p, row.lo, row.hi);
    std::erase_if(roots, [&](Time& root) { return !is_in(root, row); });
    return roots;
  }

  // The rows of one rebuild tell of points, then of edges removed, then of edges added. A change of
  // a motion may be before them.
  static int rank(const Row& row) {
    if (row.kind == "flip" || row.kind.starts_with("hull")) return 4;
    if (row.kind == "rebuild") return row.added.empty() ? 2 : 3;
    return row.kind == "hide" || row.kind == "reveal" ? 1 : 0;
  }

  void enter(const Row& row) {
    blamed_ = row_;
    const bool is_joined =
        row_ > 0 ? is_of_time_of(row, (&row)[-1]) : compare(row.hi, options_.from) == 0;
    if (!is_joined) pass_before(exactly(row.lo));
    if (rank(row) == 0) return change(row);
    if (!row.changes.empty()) refute("it has a motion, but a " + row.kind + " changes none");
    if (rank(row) == 4) return flip(row);
    if (!is_joined || row_ == 0 || rank((&row)[-1]) == 0 || rank((&row)[-1]) > rank(row))
      open_at(time_of_rebuild(row), row);
    is_rebuilt_ = true;
    for (const Edge& e : row.removed) remove_edge(e);
    for (const Edge& e : row.added) add_edge(e);
    for (const Id v : row.points) {
      if (!is_present(v) || (hidden_.contains(v) != told_.contains(v)) == (row.kind == "hide")) {
        refute("point " + std::to_string(v) + " is so already, or is not there");
      }
      if (told_.erase(v) == 0) told_.insert(v);
      touched_.insert(v);
    }
  }

  void open_at(const std::optional<Time>& time, const Row& row) {
    if (time) return open(*time);
    std::ostringstream message;
    message.precision(17);
    message << "nothing that it tells of happens in [" << approximate(row.lo) << ", "
            << approximate(row.hi) << "]";
    refute(message.str());
  }

  // Goes to the next time at which triangles may change without a row (Lemma 5), if it is in the
  // interval of the row and not after the time that the row may have.
  bool open_special(const Row& row, std::optional<Time>& time) {
    if (specials_.empty() || !is_in(specials_.front().time, row)) return false;
    if (time && compare(specials_.front().time, *time) > 0) return false;
    open(Time(specials_.front().time));
    return true;
  }

  // An edge between two triangles becomes the other diagonal. With the infinite point: a point
  // becomes a corner of the hull, or ceases to be one.
  void flip(const Row& row) {
    const bool is_part_of_more = is_rebuilt_ || !touched_.empty() || has_edges_of_the_gone();
    if (is_part_of_more && is_in(now_, row) && is_needed_now(row)) {
      for (const Edge& e : row.removed) remove_edge(e);
      for (const Edge& e : row.added) add_edge(e);
      return;
    }
    std::vector<Edge> candidates = row.removed;
    if (row.kind == "hull_remove") {
      const auto [a, b] = row.added.front();
      for (const auto& [u, w] : {std::pair(a, b), std::pair(b, a)}) {
        const Id v = apex(u, infinite);
        if (v != absent && apex(v, infinite) == w) candidates.push_back({v, infinite});
      }
    }
    std::optional<Time> first;
    Edge flipped = {absent, absent};
    for (const Edge& e : candidates) {
      if (apex(e.first, e.second) == absent) refute("there is no " + name(e));
      std::optional<Time> time = failure_of(e, row);
      if (!time || (first && compare(*first, *time) <= 0)) continue;
      first = std::move(time);
      flipped = e;
    }
    if (open_special(row, first)) return flip(row);
    open_at(first, row);
    const auto [a, b] = flipped;
    const Id l = apex(a, b);
    const Id r = apex(b, a);
    const auto finite = [](const Edge& e) {
      return e.second == infinite ? std::vector<Edge>() : std::vector<Edge>{e};
    };
    if (row.removed != finite(flipped) || row.added != finite(edge(l, r))) {
      refute(name(flipped) + " becomes " + name(edge(l, r)));
    }
    remove_triangle(a, b, l);
    remove_triangle(b, a, r);
    for (const Edge& e : row.removed) remove_edge(e);
    for (const Edge& e : row.added) add_edge(e);
    touched_.clear();
    add_triangle(l, r, b);
    add_triangle(r, l, a);
  }

  // The first time in the interval of the row at which the edge has to be flipped. If what is
  // around it is new at this instant, that may be at once.
  std::optional<Time> failure_of(const Edge& e, const Row& row) {
    const Id a = e.first;
    const Id b = e.second;
    const auto decider = [&] {
      return Certifier::decider({edge_life, {}, courses({a, b, apex(a, b), apex(b, a)}), {}, {}});
    };
    if (changed_.contains(e)) {
      if (is_in(now_, row) && sign_just_after(decider(), now_) < 0) return now_;
      close();
    }
    const Polynomial p = decider();
    Time birth = alive_[edge_life].at(key(a, b)).birth->time;
    for (Time& root : roots_in(p, row)) {
      if (compare(root, birth) > 0 && changes_sign(p, root)) return root;
    }
    return std::nullopt;
  }

  // The certificates of triangles that changed in this instant, and of those at the points of the
  // rows from this one on that have one time.
  std::vector<Certificate> certificates_at(const Row& row) const {
    std::set<Edge> edges;
    for (const auto& [a, b] : changed_) {
      if (apex(a, b) != absent && apex(b, a) != absent) edges.insert({a, b});
    }
    std::vector<Certificate> result;
    const auto add = [&](Kind kind, const Points& points) {
      for (Certificate& c : certifier_.certificates({kind, points, courses(points), {}, {}})) {
        if (!is_about_contact(c.rule)) result.push_back(std::move(c));
      }
    };
    for (const Row* r = &row; r != rows_.data() + rows_.size() && is_of_time_of(*r, row); ++r) {
      std::set<Id> points(r->points.begin(), r->points.end());
      for (const auto& changed : {r->removed, r->added}) {
        for (const auto& [a, b] : changed) points.insert({a, b});
      }
      for (const Id v : points) {
        if (!is_present(v)) continue;
        const auto hidden = hidden_.find(v);
        if (neighbors_[v].empty() && hidden != hidden_.end() && hidden->second[0] != absent) {
          const auto& [a, b, c] = hidden->second;
          add(hidden_life, {a, b, c, v});
        }
        if (apex(v, infinite) != absent) edges.insert({v, infinite});
        for (const Id n : neighbors_[v]) {
          edges.insert(edge(v, n));
          if (apex(n, infinite) != absent) edges.insert({n, infinite});
        }
      }
    }
    for (const auto& [a, b] : edges) add(edge_life, {a, b, apex(a, b), apex(b, a)});
    return result;
  }

  // Whether a point that is erased in this instant still has edges.
  bool has_edges_of_the_gone() const {
    return std::ranges::any_of(moved_,
                               [&](Id v) { return !is_present(v) && !neighbors_[v].empty(); });
  }

  // Whether a row that may be of this instant is needed: whether something at its points, and at
  // those of the rows after it, is violated just after now, or there is no triangulation yet.
  bool is_needed_now(const Row& row) {
    if (is_witness_lost_) find_witness();
    if (is_on_line_ || has_edges_of_the_gone()) return true;
    try {
      remake();
      const auto is_of_hull = [](const Edge& e) { return e.second == infinite; };
      if (std::ranges::any_of(changed_, is_of_hull)) check_hull();
      std::set<Id> looked_at = touched_;
      for (const auto& [v, t] : hidden_) looked_at.insert(v);
      for (const Id v : looked_at) {
        if (!is_present(v) || !neighbors_[v].empty() || present_ < 2) continue;
        const auto [a, b, c] = triangle_of(v, {absent, absent, absent});
        if (sign_just_after(outside(course(a), course(b), course(c), course(v)), now_) < 0)
          return true;
      }
    } catch (const Refuted&) {
      return true;
    }
    return std::ranges::any_of(certificates_at(row), [&](const Certificate& certificate) {
      const int sign = sign_just_after(certificate.p, now_);
      return sign < 0 || (sign == 0 && certificate.rule == Rule::positive);
    });
  }

  // The time of a rebuild, or of what is hidden or revealed: now, or when something fails at the
  // points of its rows or, if nothing fails there, vanishes.
  std::optional<Time> time_of_rebuild(const Row& row) {
    if (compare(row.lo, row.hi) == 0) return exactly(row.lo);
    if (is_in(now_, row) && is_needed_now(row)) return now_;
    close();
    std::optional<Time> first;
    for (const bool is_failure : {true, false}) {
      for (const Certificate& certificate : certificates_at(row)) {
        for (Time& root : roots_in(certificate.p, row)) {
          if (compare(root, now_) <= 0 || (first && compare(root, *first) >= 0)) continue;
          if (!is_failure || changes_sign(certificate.p, root)) first = root;
        }
      }
      if (open_special(row, first)) return time_of_rebuild(row);
      if (first) break;
    }
    if (!first && is_in(now_, row)) return now_;
    return first;
  }

  // Walls, collisions, and changes of motions.
  void change(const Row& row) {
    const bool is_contact = row.kind == "wall" || row.kind == "collision";
    for (const Id v : row.points) {
      if (is_present(v) == (row.kind == "insert")) {
        refute("point " + std::to_string(v) + (is_present(v) ? " is there" : " is not there"));
      }
    }
    if (is_contact) {
      const Course& first = course(row.points.front());
      std::vector<Polynomial> distances;
      if (row.kind == "collision") {
        distances.push_back(gap(first, course(row.points.back())));
      } else {
        for (const auto& [side, p] : certifier_.clearances(first)) distances.push_back(p);
      }
      const Edge pair = edge(row.points.front(), row.points.back());
      const bool passes =
          passing_.contains(pair) && !moved_.contains(pair.first) && !moved_.contains(pair.second);
      open_at(contact_time(distances, passes, row), row);
      if (!contacts_.insert(row.points).second) refute("it is the row before, again");
    } else {
      if (compare(row.lo, row.hi) != 0) refute("its time is no binary64 number");
      open(exactly(row.lo));
    }
    if (row.kind != "collision" && row.changes.size() != 1) refute("it has no motion");
    if (is_contact && row.changes.empty()) {  // the discs pass through each other
      if (!options_.may_pass) refute("it changes no motion");
      const auto [a, b] = edge(row.points.front(), row.points.back());
      renew(edge_life, key(a, b), std::nullopt);
      changed_.insert({a, b});
      passing_.insert({a, b});
    }
    for (const Change& change : row.changes) {
      if (std::ranges::find(row.points, change.id) == row.points.end() ||
          std::ranges::count(row.changes, change.id, &Change::id) != 1 ||
          (row.kind != "collision" && change.motion.has_value() == (row.kind == "erase"))) {
        refute("it has a motion of point " + std::to_string(change.id));
      }
      const Course* old = courses_[change.id];
      if (row.kind == "trajectory") {  // maybe it jumps
        touched_.insert(change.id);
        touched_.insert(neighbors_[change.id].begin(), neighbors_[change.id].end());
      }
      end_passes(change.id);
      set_motion(change);
      end_passes(change.id);
      if (is_contact && change.motion && !certifier_.goes_on(*old, course(change.id), row)) {
        refute("the motion of point " + std::to_string(change.id) + " does not go on");
      }
      std::erase_if(contacts_, [&](const std::vector<Id>& points) {
        return std::ranges::find(points, change.id) != points.end();
      });
    }
  }

  // The first contact in the interval of the row. Discs that pass through each other have none
  // while they overlap.
  std::optional<Time> contact_time(const std::vector<Polynomial>& all, bool passes,
                                   const Row& row) {
    std::optional<Time> first;
    for (const Polynomial& p : all) {
      std::vector<Time> times = roots_in(p, row);
      std::ranges::move(roots_in(derivative(p), row), std::back_inserter(times));
      if (is_in(now_, row)) times.push_back(now_);
      for (Time& time : times) {
        if (compare(time, now_) < 0 || (first && compare(time, *first) >= 0)) continue;
        if (passes && sign_at(p, time) < 0) continue;
        if (verify::is_contact(p, time)) first = time;
      }
    }
    return first;
  }

  // Discs that have passed through each other may have a contact again once they are apart.
  void end_passes(Id v) {
    std::erase_if(passing_, [&](const Edge& e) {
      const auto [a, b] = e;
      if (a != v && b != v) return false;
      return !is_present(a) || !is_present(b) || sign_at(gap(course(a), course(b)), now_) > 0;
    });
  }

  void set_motion(const Change& change) {
    const Id v = change.id;
    const Course* old = courses_[v];
    for (const Id n : neighbors_[v]) {
      changed_.insert(edge(v, n));
      for (const Id m : {apex(v, n), apex(n, v)}) {
        if (m != absent) changed_.insert(edge(n, m));
      }
    }
    if (hull_.contains(v)) changed_.insert({v, infinite});
    if (old != nullptr) --present_;
    if (change.motion) ++present_;
    courses_[v] = change.motion ? &motions_.emplace_back(scale_.course(*change.motion)) : nullptr;
    if (is_on_line_ || std::ranges::find(witness_, old) != witness_.end()) is_witness_lost_ = true;
    moved_.insert(v);
  }

  void check_end(const std::vector<Edge>* final_edges) {
    blamed_ = row_;
    open(exactly(options_.until));
    close();
    is_complete_ = true;
    if (final_edges == nullptr) return;
    for (const auto& [a, b] : *final_edges) {
      if (b >= neighbors_.size() || !neighbors_[a].contains(b))
        refute("there is no " + name({a, b}));
    }
    if (final_edges->size() != edges_) refute("the file of edges lacks an edge");
  }

  // ---- lives ----

  std::array<const Course*, 4> courses(const Points& points) const {
    std::array<const Course*, 4> result = {};
    for (std::size_t i = 0; i < 4; ++i) {
      if (points[i] < absent) result[i] = courses_[points[i]];
    }
    return result;
  }

  // Ends the life with that key, unless it goes on with the same points and motions, and begins
  // one, if there are points.
  void renew(Kind kind, std::uint64_t id, const std::optional<Points>& points) {
    const auto found = alive_[kind].find(id);
    std::optional<Life> life;
    if (points) {
      const bool passes = options_.is_log || passing_.contains({(*points)[0], (*points)[1]});
      life = Life{kind, *points, courses(*points), instant_, nullptr, passes};
    }
    bool is_new_pair = true;
    if (found != alive_[kind].end()) {
      const Life& old = found->second;
      if (life && old.points == life->points && old.courses == life->courses) return;
      is_new_pair =
          !life || old.courses[0] != life->courses[0] || old.courses[1] != life->courses[1];
      end(old);
      alive_[kind].erase(found);
    }
    if (!life) return;
    ++certificates_;
    const auto [a, b] = std::pair(life->courses[0], life->courses[1]);
    if (kind == edge_life && is_new_pair && b != nullptr) {
      const auto [dx, dy] = minus(*a, *b);
      add_specials(greatest_common_divisor(dx, dy), (*points)[0], (*points)[1]);
    }
    alive_[kind].emplace(id, std::move(*life));
  }

  void end(Life life) {
    constexpr std::size_t batch = 4096;
    life.death = instant_;
    ended_.push_back(std::move(life));
    if (ended_.size() < batch) return;
    auto lives = std::exchange(ended_, {});
    for (auto& worker : workers_) {
      if (worker.valid()) {
        if (worker.wait_for(std::chrono::seconds(0)) != std::future_status::ready) continue;
        note(worker.get());
      }
      worker = std::async(std::launch::async,
                          [this, lives = std::move(lives)] { return refutation_of(lives); });
      return;
    }
    note(refutation_of(lives));
  }

  std::optional<Refuted> refutation_of(const std::vector<Life>& lives) const {
    std::optional<Refuted> first;
    for (const Life& life : lives) {
      std::optional<Refuted> refuted = certifier_.refutation(life, rows_);
      if (refuted && (!first || refuted->row < first->row)) first = std::move(refuted);
    }
    return first;
  }

  // Keeps what is refuted first in the log.
  void note(const std::optional<Refuted>& refuted) {
    if (refuted && (!refuted_ || refuted->row < refuted_->row)) refuted_ = refuted;
  }
  [[noreturn]] void refute(const std::string& message) const { throw Refuted{blamed_, message}; }

  const Options options_;
  const std::vector<Row>& rows_;
  const Scale scale_;
  const Certifier certifier_;
  std::deque<Course> motions_;
  std::vector<const Course*> courses_;  // of the points that are there
  std::size_t present_ = 0;
  std::vector<const Course*> witness_;
  bool is_witness_lost_ = true;
  bool is_on_line_ = true;  // all points, at all times

  std::vector<std::set<Id>> neighbors_;
  std::size_t edges_ = 0;
  std::unordered_map<std::uint64_t, Id> left_;  // apexes
  std::set<Id> hull_;
  std::map<Id, Triangle> hidden_;
  std::set<Edge>
      passing_;  // discs that pass through each other: a collision left them as they were

  // In this instant:
  std::set<Id> touched_;  // points whose triangles are to be made anew
  std::set<Id> moved_;
  std::set<Edge> changed_;  // edges whose ends or apexes changed
  std::set<Id> told_;       // points that are hidden or revealed
  std::set<std::vector<Id>> contacts_;
  bool is_rebuilt_ = false;  // whether there was a row of a rebuild

  std::list<Special> specials_;  // to come, in order
  Time now_;
  std::shared_ptr<const Instant> instant_;
  long row_ = -1;
  long blamed_ = -1;

  std::array<std::unordered_map<std::uint64_t, Life>, kinds> alive_;
  std::vector<Life> ended_;
  std::vector<std::future<std::optional<Refuted>>> workers_;
  std::optional<Refuted> refuted_;
  std::size_t certificates_ = 0;
  bool is_complete_ = false;  // whether the end has come without a fault
};

}  // namespace verify

#endif  // KINETRI_VERIFY_CHECKER_H
