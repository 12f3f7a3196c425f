// SPDX-License-Identifier: GPL-3.0-or-later
// The triangulation that edges and motions imply at each time, and the lives of its certificates.
// The lemmas named here are in README.md.
#ifndef KINETRI_VERIFY_TRIANGULATION_H
#define KINETRI_VERIFY_TRIANGULATION_H

#include "lives.h"

namespace verify {

// Edges and motions may be changed at the present instant. When time advances, they must form a
// Delaunay triangulation just after that instant, whose certificates live until they are changed.
class Certified_triangulation {
 protected:
  Certified_triangulation(const Options& options, const std::vector<Change>& points,
                          const std::vector<Row>& rows)
      : options_(options), rows_(rows), scale_(options, points, rows), certifier_(options, scale_) {
    Id size = 0;
    const auto note_id = [&](const Change& change) { size = std::max(size, change.id + 1); };
    std::ranges::for_each(points, note_id);
    for (const Row& row : rows) std::ranges::for_each(row.changes, note_id);
    courses_.resize(size);
    neighbors_.resize(size);
    groups_of_.resize(size, groups_.end());
    begins_.resize(size);
    past_motions_.resize(size);
    workers_.resize(options.threads - 1);
    push_instant(exactly(options.from));
    for (const Change& change : points) set_motion(change);
  }

  using Triangle = std::array<Id, 3>;

  // A time at which the ends of an edge meet; or all points may be on a line (both ids are
  // `infinite`); or a hidden point leaves its triangle (both are that point).
  struct Special {
    Time time;
    std::set<Edge> what;
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
    has_rows_ = false;
  }

  void add_specials(const Polynomial& p, Id a, Id b) {
    for (Time& root : verify::roots_in(p, now_.lo, options_.until)) {
      if (compare(root, now_) <= 0) continue;
      int order = 1;
      std::size_t first = 0;
      for (std::size_t last = specials_.size(); first < last && order != 0;) {
        const std::size_t middle = (first + last) / 2;
        order = compare(specials_[middle].time, root);
        if (order < 0) first = middle + 1;
        if (order > 0) last = middle;
        if (order == 0) specials_[middle].what.insert({a, b});
      }
      if (order == 0) continue;
      specials_.insert(specials_.begin() + static_cast<std::ptrdiff_t>(first), {root, {{a, b}}});
    }
  }

  // Whether two points coincide now. Their motions may have changed since the special time was
  // found.
  bool do_meet(Id a, Id b) {
    return std::ranges::all_of(minus(course(a), course(b)),
                               [&](const Polynomial& p) { return sign_at(p, now_) == 0; });
  }

  void touch_specials() {
    const auto [time, what] = std::move(specials_.front());
    specials_.pop_front();
    for (const auto& [a, b] : what) {
      if (a == infinite) {
        if (is_on_line_) continue;  // the points of that time have been erased
        const auto is_flat = [&](const Course* c) {
          return c == nullptr || sign_at(orientation(*witness_[0], *witness_[1], *c), now_) == 0;
        };
        if (std::ranges::all_of(courses_, is_flat)) touch_all();
      } else if (a == b) {
        renew(hidden_life, key(a, a), std::nullopt);
        if (neighbors_[a].empty()) touched_.insert(a);
      } else if (neighbors_[a].contains(b) && do_meet(a, b)) {
        for (const Id v : {a, b}) {
          touched_.insert(v);
          touched_.insert(neighbors_[v].begin(), neighbors_[v].end());
        }
      }
    }
  }

  // Processes the earlier times, and this one if it is included, at which triangles may change
  // without a row (Lemma 5).
  void pass_before(Time time, bool is_included = false) {
    close();
    while (!specials_.empty()) {
      const int order = compare(specials_.front().time, time);
      if (is_included ? order > 0 : order >= 0) break;
      push_special();
      close();
    }
  }

  void push_special() {
    if (compare(specials_.front().time, now_) > 0) push_instant(specials_.front().time);
    touch_specials();
  }

  void open(Time time) {
    Time until = exactly(options_.until);
    const int order = compare(time, now_);
    if (order < 0) refute("it is before the row before");
    if (compare(time, until) > 0) refute("it is after the end");
    if (order == 0) return;
    pass_before(time);
    push_instant(time);
    while (!specials_.empty() && compare(specials_.front().time, now_) == 0) touch_specials();
  }

  // Checks that everything changed at this time holds just after it.
  void close() {
    if (changed_.empty() && touched_.empty() && moved_.empty()) return;
    // Lives that have ended hold the instant as it was, which other threads read.
    if (instant_->rows_end != row_) {
      instant_ = std::make_shared<const Instant>(Instant{now_, instant_->first_row, row_});
    }
    end_passes();
    const long row = std::exchange(blamed_, instant_->blamed());
    if (is_witness_lost_) find_witness();
    note_hidden();
    is_on_line_ ? make_path() : remake();
    touched_.clear();
    check_contacts_of_twins();
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

  // ---- hidden points ----

  // The point of least id with the trajectory and weight of the point.
  Id shown(Id v) const { return *groups_of_[v]->second.begin(); }
  // Whether the point is hidden by another one (Lemma 8).
  bool is_twin(Id v) const { return is_present(v) && shown(v) != v; }
  // Whether the point is hidden in a triangle, if the edges are right (Lemma 6).
  bool is_in_triangle(Id v) const {
    return is_present(v) && !is_twin(v) && neighbors_[v].empty() && groups_.size() > 1;
  }
  // Whether it was when its row was due the last time, or before the first row.
  bool was_hidden(Id v) const { return hidden_.contains(v) || twins_.contains(v); }

  void set_hidden(Id v) {
    if (is_twin(v)) {
      twins_.insert(v);
    } else {
      twins_.erase(v);
    }
    if (is_in_triangle(v)) {
      hidden_.try_emplace(v, Triangle{absent, absent, absent});
    } else if (hidden_.erase(v) > 0) {
      renew(hidden_life, key(v, v), std::nullopt);
    }
  }

  // Each point that is hidden or revealed must have a row, and no other point.
  void note_hidden() {
    if (is_on_line_ && edges_ == 0 && groups_.size() > 1) check_radii();
    std::set<Id> looked_at = touched_;
    for (const auto& more : {moved_, regrouped_, told_}) {
      looked_at.insert(more.begin(), more.end());
    }
    regrouped_.clear();
    for (const Id v : looked_at) {
      const std::string which = "point " + std::to_string(v);
      if (!neighbors_[v].empty()) {
        if (!is_present(v)) refute(which + " still has edges");
        if (is_twin(v))
          refute(which + " has edges, but point " + std::to_string(shown(v)) + " hides it");
      }
      const bool is_hidden = is_twin(v) || is_in_triangle(v);
      const bool is_told = told_.erase(v) > 0;
      if (is_present(v) && (is_hidden != was_hidden(v)) != is_told) {
        refute(which + (is_told ? " is neither hidden nor revealed" : " is hidden or revealed"));
      }
      set_hidden(v);
    }
  }

  // ---- points that coincide (Lemma 8) ----

  // Changes in adjacent rows, which may have been made at once, or some before others, as long as
  // no row would be missing in between. The states before each of these are remembered.
  struct Regrouping {
    template <class Value>
    struct Past {
      std::vector<Value> values;
      std::size_t last = 0;  // the number of the change that has given it its present value
    };
    std::map<const Course*, Past<Id>, Is_before> shown;
    std::map<Id, Past<const Course*>> courses;
    std::size_t changes = 0;
    std::size_t complete = 0;  // the last but one, or an earlier one, after which no row is missing
    std::set<Id> lacking_rows;  // points that must have one
  };

  // The value that is replaced may have been one before some changes that were made at once.
  template <class Value>
  void remember(Regrouping::Past<Value>& past, Value value) {
    if (regrouping_.complete >= past.last) past.values.push_back(value);
    past.last = regrouping_.changes;
  }

  // The next row changes motions, maybe together with the row before.
  void continue_regrouping() {
    if (regrouping_.lacking_rows.empty() || !has_one_radius_) {
      regrouping_.complete = regrouping_.changes;
    }
    ++regrouping_.changes;
  }

  // The next row is not of the same change as the row before.
  void begin_regrouping() {
    for (const Id v : regrouping_.lacking_rows) {
      if (!is_twin(v) && !has_one_radius_) continue;  // a triangle may hide it
      blamed_ = row_ - 1;
      refute("point " + std::to_string(v) + " is hidden or revealed");
    }
    regrouping_ = {};
  }

  void note_regrouped(Id v) {
    regrouped_.insert(v);
    regrouping_.lacking_rows.erase(v);
    if (is_present(v) && is_twin(v) != (was_hidden(v) != told_.contains(v))) {
      regrouping_.lacking_rows.insert(v);
    }
  }

  void leave_group(Id v) {
    const auto group = groups_of_[v];
    auto& [course, points] = *group;
    remember(regrouping_.shown[course], shown(v));
    remember(regrouping_.courses[v], course);
    points.erase(v);
    if (points.empty()) {
      groups_.erase(group);
    } else {
      note_regrouped(*points.begin());
    }
  }

  void join_group(Id v) {
    const auto group = groups_.try_emplace(courses_[v]).first;
    groups_of_[v] = group;
    auto& points = group->second;
    if (!points.empty()) remember(regrouping_.shown[group->first], *points.begin());
    points.insert(v);
    if (*points.begin() == v && points.size() > 1) note_regrouped(*std::next(points.begin()));
  }

  // Whether a point may have been hidden by another one when the changes of the present rows were
  // made; or by none, if that is the point itself.
  bool may_have_been_hidden_by(Id v, Id other) const {
    const auto possible = [&](const auto& pasts, const auto& key, const auto& now) {
      const auto found = pasts.find(key);
      auto values = found == pasts.end() ? std::vector{now} : found->second.values;
      if (found != pasts.end() && regrouping_.complete >= found->second.last) values.push_back(now);
      return values;
    };
    const auto courses = possible(regrouping_.courses, v, courses_[v]);
    return std::ranges::any_of(courses, [&](const Course* course) {
      const auto group = groups_.find(course);
      const Id now = group == groups_.end() ? absent : *group->second.begin();
      const auto points = possible(regrouping_.shown, course, now);
      return std::ranges::find(points, other) != points.end();
    });
  }

  // Finds the triangle of each hidden point.
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

  // Walks from triangle t, or an arbitrary one, to the triangle that contains the point just after
  // now.
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

  // ---- contacts of discs ----

  // The first contact of two discs up to a time: since both got their motions and, if they passed
  // through each other, since they separated.
  std::optional<Time> first_contact(const Edge& pair, const Dyadic& last) {
    const auto [a, b] = pair;
    const Polynomial p = gap(course(a), course(b));
    Time begin = compare(begins_[a], begins_[b]) < 0 ? begins_[b] : begins_[a];
    const auto passing = passing_.find(pair);
    bool passes = passing != passing_.end();
    if (passes && compare(passing->second, begin) > 0) begin = passing->second;
    std::vector<Time> times = verify::roots_in(p, begin.lo, last);
    std::ranges::move(verify::roots_in(derivative(p), begin.lo, last), std::back_inserter(times));
    std::erase_if(times, [&](Time& time) { return compare(time, begin) < 0; });
    times.push_back(begin);
    for (std::size_t i = 0; i < times.size(); ++i) {  // in order
      for (std::size_t k = i; k > 0 && compare(times[k], times[k - 1]) < 0; --k) {
        std::swap(times[k], times[k - 1]);
      }
    }
    for (Time& time : times) {
      if (passes) {
        passes = sign_just_after(p, time) <= 0;
      } else if (verify::is_contact(p, time)) {
        return time;
      }
    }
    return std::nullopt;
  }

  // Whether the log may be that of a resumed run, in which discs may pass through each other from
  // the start until they separate.
  bool continues() const { return rows_.empty() || rows_.front().number != 0; }

  // Whether two discs have overlapped at all times from the start until now.
  bool have_always_overlapped(const Edge& pair) const {
    const std::vector<Past_motion>& first = past_motions_[pair.first];
    const std::vector<Past_motion>& second = past_motions_[pair.second];
    Time begin = exactly(options_.from);
    for (const auto* motions : {&first, &second}) {
      Time since = motions->front().begin;
      if (compare(since, begin) > 0) return false;
    }
    for (std::size_t i = 0, k = 0; i < first.size() && k < second.size();) {
      const Polynomial p = gap(*first[i].course, *second[k].course);
      Time of_first = i + 1 < first.size() ? first[i + 1].begin : now_;
      Time of_second = k + 1 < second.size() ? second[k + 1].begin : now_;
      const int order = compare(of_first, of_second);
      Time end = order < 0 ? of_first : of_second;
      if (compare(begin, end) < 0) {
        if (sign_just_after(p, begin) > 0) return false;
        for (Time& root : verify::roots_in(p, begin.lo, end.hi)) {
          const bool is_between = compare(root, begin) > 0 && compare(root, end) < 0;
          if (is_between && sign_just_after(p, root) > 0) return false;
        }
      }
      begin = end;
      if (order <= 0) ++i;
      if (order >= 0) ++k;
    }
    return true;
  }

  // Checks that two discs that become neighbors and overlap did not make contact without a row.
  void check_contact_before(const Edge& pair) {
    if (sign_at(gap(course(pair.first), course(pair.second)), now_) > 0) return;
    std::optional<Time> first = first_contact(pair, now_.hi);
    if (!first || compare(*first, now_) > 0) return;
    Time start = exactly(options_.from);
    if (continues() && (compare(*first, start) == 0 || have_always_overlapped(pair))) {
      passing_.insert_or_assign(pair, start);
      return;
    }
    refute("the contact of " + std::to_string(pair.first) + " and " + std::to_string(pair.second) +
           " is missing");
  }

  // Checks the contacts of discs that coincide with others: with these, when they get one motion
  // and grow; and, if one of them is in contact with another disc, those of all the others with it.
  void check_contacts_of_twins() {
    if (twins_.empty() || !options_.has_contacts) return;
    for (const Id v : moved_) {
      if (!is_present(v) || derivative(course(v).radius).empty()) continue;
      for (const Id other : groups_of_[v]->second) {
        if (other != v) check_contact_before(edge(v, other));
      }
    }
    std::set<Edge> done;  // points that are the least of their groups
    for (const std::vector<Id>& points : contacts_) {
      if (points.size() < 2) continue;
      const Edge pair = {points.front(), points.back()};
      const Edge least = {shown(pair.first), shown(pair.second)};
      if (least.first == least.second || !passing_.contains(pair) || !done.insert(least).second) {
        continue;
      }
      for (const Id a : groups_of_[pair.first]->second) {
        for (const Id b : groups_of_[pair.second]->second) check_contact_before(edge(a, b));
      }
    }
  }

  // Discs that have passed through each other may make contact again after they have separated.
  // Those whose motions change together are looked at before and after that.
  void end_passes(Id v) {
    std::erase_if(passing_, [&](const auto& entry) {
      const auto [a, b] = entry.first;
      if ((a != v && b != v) || changing_.contains(a == v ? b : a)) return false;
      return !is_present(a) || !is_present(b) || sign_at(gap(course(a), course(b)), now_) > 0;
    });
  }

  void end_passes() {
    for (const Id v : std::exchange(changing_, {})) end_passes(v);
  }

  // ---- motions ----

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
    begins_[v] = now_;
    if (old != nullptr) leave_group(v);
    courses_[v] = change.motion ? &motions_.emplace_back(scale_.course(*change.motion)) : nullptr;
    if (change.motion) {
      if (continues()) past_motions_[v].push_back({now_, courses_[v]});
      join_group(v);
      if (courses_[v]->radius != motions_.front().radius) has_one_radius_ = false;
    }
    note_regrouped(v);
    if (is_on_line_ || std::ranges::find(witness_, old) != witness_.end()) is_witness_lost_ = true;
    moved_.insert(v);
  }

  // ---- lives ----

  std::array<const Course*, 4> courses(const Points& points) const {
    std::array<const Course*, 4> result = {};
    for (std::size_t i = 0; i < 4; ++i) {
      if (points[i] < absent) result[i] = courses_[points[i]];
    }
    return result;
  }

  // Ends the life with that key unless its points and motions are unchanged, and begins a new one
  // if there are points.
  void renew(Kind kind, std::uint64_t id, const std::optional<Points>& points) {
    const auto found = alive_[kind].find(id);
    std::optional<Life> life;
    if (points) {
      const bool passes = passing_.contains({(*points)[0], (*points)[1]});
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
      const Edge pair = {(*points)[0], (*points)[1]};
      if (options_.has_contacts) check_contact_before(pair);
      life->passes = passing_.contains(pair);
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

  // Keeps the refutation that is first in the log.
  void note(const std::optional<Refuted>& refuted) {
    if (refuted && (!refuted_ || refuted->row < refuted_->row)) refuted_ = refuted;
  }
  [[noreturn]] void refute(const std::string& message) const { throw Refuted{blamed_, message}; }

  const Options options_;
  const std::vector<Row>& rows_;
  const Scale scale_;
  const Certifier certifier_;
  std::deque<Course> motions_;
  std::vector<const Course*> courses_;                       // of the points that are present
  std::map<const Course*, std::set<Id>, Is_before> groups_;  // of points that coincide
  std::vector<decltype(groups_)::iterator> groups_of_;       // by id, of the points present
  bool has_one_radius_ = true;                               // all discs so far
  std::vector<const Course*> witness_;
  bool is_witness_lost_ = true;
  bool is_on_line_ = true;  // all points, at all times

  std::vector<std::set<Id>> neighbors_;
  std::size_t edges_ = 0;
  std::unordered_map<std::uint64_t, Id> left_;  // apexes
  std::set<Id> hull_;
  std::map<Id, Triangle> hidden_;  // in triangles
  std::set<Id> twins_;             // hidden by other points
  std::vector<Time> begins_;       // of motions
  struct Past_motion {
    Time begin;
    const Course* course;
  };
  std::vector<std::vector<Past_motion>> past_motions_;  // by id, if the log may continue a run
  std::map<Edge, Time> passing_;  // the last collision of discs that did not change them

  // In this instant:
  std::set<Id> touched_;  // points whose triangles must be made anew
  std::set<Id> moved_;
  std::set<Id> changing_;   // points whose motions the last rows have changed
  std::set<Id> regrouped_;  // points that are the least of a group now, or were
  Regrouping regrouping_;
  std::set<Edge> changed_;  // edges whose ends or apexes changed
  std::set<Id> told_;       // points that are hidden or revealed
  std::set<std::vector<Id>> contacts_;
  bool has_rows_ = false;

  std::deque<Special> specials_;  // to come, in order
  Time now_;
  std::shared_ptr<const Instant> instant_;
  long row_ = -1;
  long blamed_ = -1;

  std::array<std::unordered_map<std::uint64_t, Life>, kinds> alive_;
  std::vector<Life> ended_;
  std::vector<std::future<std::optional<Refuted>>> workers_;
  std::optional<Refuted> refuted_;
  std::size_t certificates_ = 0;
  bool is_complete_ = false;  // whether the end was reached without a refutation
};

}  // namespace verify

#endif  // KINETRI_VERIFY_TRIANGULATION_H
