// SPDX-License-Identifier: GPL-3.0-or-later
// The triangulation as time goes on, and the lives of its certificates.
// The lemmas named here are in README.md.
#ifndef KINETRI_VERIFY_TRIANGULATION_H
#define KINETRI_VERIFY_TRIANGULATION_H

#include "surface.h"

namespace verify {

// Edges and motions may be changed at the present instant. When time advances, they must form a
// Delaunay triangulation just after that instant, whose certificates live until they are changed.
class Certified_triangulation : protected Surface {
 protected:
  Certified_triangulation(const Options& options, const std::vector<Change>& points,
                          const std::vector<Row>& rows)
      : Surface(options, points, rows),
        certifier_(options, scale_),
        begins_(courses_.size()),
        past_motions_(courses_.size()),
        workers_(options.threads - 1) {
    is_on_line_ = is_witness_lost_ = !is_periodic();
    push_instant(exactly(options.from));
    for (const Change& change : points) set_motion(change);
  }

  // What concerns one point and no edge.
  static Edge itself(Id v) { return {v, v}; }

  // A time at which the ends of an edge meet; or all points may be on a line (both ids are
  // `infinite`); or a hidden point leaves its triangle (`itself`).
  struct Special {
    Time time;
    std::set<Edge> what;
  };

  // Three points that are not always on a line, if there are any.
  void find_witness() {
    if (!std::exchange(is_witness_lost_, false)) return;
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
        changed_.insert(edge(ab.first, ab.second));
      }
      left_.clear();
      touch_all();
    }
    add_specials(orientation(*witness_[0], *witness_[1], *witness_[2]), {infinite, infinite});
  }

  // ---- time ----

  void push_instant(const Time& time) {
    now_ = time;
    instant_ = std::make_shared<const Instant>(Instant{time, row_, row_});
    contacts_.clear();
    has_rows_ = false;
  }

  void add_specials(const Polynomial& p, const Edge& of) {
    for (Time& root : verify::roots_in(p, now_.lo, options_.until)) {
      if (compare(root, now_) <= 0) continue;
      int order = 1;
      std::size_t first = 0;
      for (std::size_t last = specials_.size(); first < last && order != 0;) {
        const std::size_t middle = (first + last) / 2;
        order = compare(specials_[middle].time, root);
        if (order < 0) first = middle + 1;
        if (order > 0) last = middle;
        if (order == 0) specials_[middle].what.insert(of);
      }
      if (order == 0) continue;
      specials_.insert(specials_.begin() + static_cast<std::ptrdiff_t>(first), {root, {of}});
    }
  }

  // Whether two points coincide now. Their motions may have changed since the special time was
  // found.
  bool do_meet(const Edge& e) {
    return std::ranges::all_of(minus(course(begin_of(e)), course(end_of(e))),
                               [&](const Polynomial& p) { return sign_at(p, now_) == 0; });
  }

  void touch_specials() {
    const auto [time, what] = std::move(specials_.front());
    specials_.pop_front();
    for (const Edge& e : what) {
      const Id a = e.first;
      if (a == infinite) {
        if (is_on_line_) continue;  // the points of that time have been erased
        const auto is_flat = [&](const Course* c) {
          return c == nullptr || sign_at(orientation(*witness_[0], *witness_[1], *c), now_) == 0;
        };
        if (std::ranges::all_of(courses_, is_flat)) touch_all();
      } else if (e == itself(a)) {
        renew(hidden_life, e, std::nullopt);
        if (neighbors_[a].empty()) touched_.insert(a);
      } else if (has_edge(e) && do_meet(e)) {
        for (const Id v : {a, e.second}) touch_around(v);
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
    find_witness();
    note_hidden();
    is_on_line_ ? make_path() : remake();
    touched_.clear();
    check_surface();
    check_contacts_of_twins();
    for (const Id v : moved_) {
      const bool is_boxed = is_present(v) && !options_.box.empty();
      renew(box_life, itself(v),
            is_boxed ? std::optional(Points{v, absent, absent, absent}) : std::nullopt);
    }
    moved_.clear();
    for (const Edge& e : std::exchange(changed_, {})) {
      renew(edge_life, e, is_there(e) ? std::optional(around(e)) : std::nullopt);
    }
    place_hidden();
    blamed_ = row;
  }

  // ---- hidden points ----

  // Whether the point is hidden in a triangle, if the edges are right (Lemma 6).
  bool is_in_triangle(Id v) const {
    return is_present(v) && !is_twin(v) && neighbors_[v].empty() && groups_.size() > 1;
  }
  void set_hidden(Id v) {
    if (is_twin(v)) {
      twins_.insert(v);
    } else {
      twins_.erase(v);
    }
    if (is_in_triangle(v)) {
      hidden_.try_emplace(v, Triangle{absent, absent, absent});
    } else if (hidden_.erase(v) > 0) {
      renew(hidden_life, itself(v), std::nullopt);
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

  // Finds the triangle of each hidden point.
  void place_hidden() {
    for (auto& [v, t] : hidden_) {
      const auto life = alive_[hidden_life].find(itself(v));
      const bool is_there = t[0].id != absent && apex(t[0], t[1]) == t[2];
      if (is_there && life != alive_[hidden_life].end() &&
          life->second.courses == courses({t[0], t[1], t[2], v})) {
        continue;
      }
      t = triangle_of(v, is_there ? t : Triangle{absent, absent, absent});
      renew(hidden_life, itself(v), Points{t[0], t[1], t[2], v});
      for (std::size_t i = 0; i < 3; ++i) {
        add_specials(orientation(course(t[i]), course(t[(i + 1) % 3]), course(v)), itself(v));
      }
    }
  }

  // Walks from triangle t, or an arbitrary one, to the triangle that contains the point just after
  // now. Each next triangle is above the one before, at the point (Lemma 6): so the walk ends.
  Triangle triangle_of(Id v, Triangle t) {
    for (auto any = left_.begin(); t[0].id == absent && any != left_.end(); ++any) {
      const Triangle found = {begin_of(any->first), end_of(any->first), any->second};
      if (std::ranges::max(found).id != infinite) t = moved_near(v, found);
    }
    const auto sign_of = [&](const Polynomial& p) { return sign_just_after(p, now_); };
    while (t[0].id != absent && t[2].id != infinite) {
      const Course& a = course(t[0]);
      const Course& b = course(t[1]);
      const Course& c = course(t[2]);
      const Course& point = course(v);
      if (sign_of(orientation(a, b, c)) <= 0) refute("a triangle does not turn left");
      const auto is_beyond = [&](std::size_t i) {
        return sign_of(orientation(course(t[i]), course(t[(i + 1) % 3]), point)) < 0;
      };
      std::size_t side = 0;
      while (side < 3 && !is_beyond(side)) ++side;
      if (side == 3) return t;
      const Image& end = t[(side + 1) % 3];
      const Image next = apex(end, t[side]);
      if (next.id != infinite && sign_of(outside(a, b, c, course(next))) <= 0) {
        refute(name(edge(end, t[side])) + " has to be flipped");
      }
      t = {end, t[side], next};
    }
    refute("point " + std::to_string(v) + " is in no triangle");
  }

  // In a periodic box the image of the triangle whose first corner is about one box away from the
  // point at most.
  Triangle moved_near(Id v, Triangle t) const {
    if (!is_periodic()) return t;
    const Place way = minus(course(v), course(t[0]));
    std::array<std::int64_t, 2> by = {};
    for (std::size_t i = 0; i < 2; ++i) {
      const Integer count = lattice_.count_of(i, way, now_.lo);
      if (!count.fits_slong_p()) refute("point " + std::to_string(v) + " is too far away");
      by[i] = count.get_si();
    }
    for (Image& corner : t) corner = moved(corner, {by[0], by[1]});
    return t;
  }

  // ---- contacts of discs ----

  Polynomial gap_of(const Edge& pair) const {
    return gap(course(begin_of(pair)), course(end_of(pair)));
  }

  // The first contact of two discs up to a time: since both got their motions and, if they passed
  // through each other, since they separated.
  std::optional<Time> first_contact(const Edge& pair, const Dyadic& last) {
    const Polynomial p = gap_of(pair);
    Time& begin_a = begins_[pair.first];
    Time& begin_b = begins_[pair.second];
    Time begin = compare(begin_a, begin_b) < 0 ? begin_b : begin_a;
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
      const Polynomial p = gap(*first[i].course, lattice_.moved(*second[k].course, pair.offset));
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
    if (sign_at(gap_of(pair), now_) > 0) return;
    std::optional<Time> first = first_contact(pair, now_.hi);
    if (!first || compare(*first, now_) > 0) return;
    Time start = exactly(options_.from);
    if (continues() && (compare(*first, start) == 0 || have_always_overlapped(pair))) {
      passing_.insert_or_assign(pair, start);
      return;
    }
    refute("the contact of " + std::to_string(pair.first) + " and " + std::to_string(pair.second) +
           (is_periodic() ? " " + name_of(pair.offset) : "") + " is missing");
  }

  // Checks the contacts of discs that coincide with others: with these, when they get one motion
  // and grow; and, if one of them is in contact with another disc, those of all the others with it.
  void check_contacts_of_twins() {
    if (twins_.empty() || !options_.has_contacts) return;
    if (is_periodic()) {
      throw Bad_input(
          "discs coincide in a periodic box: such runs with contacts are not supported");
    }
    for (const Id v : moved_) {
      if (!is_present(v) || derivative(course(v).radius).empty()) continue;
      for (const Id other : groups_of_[v]->second) {
        if (other != v) check_contact_before(edge(v, other));
      }
    }
    std::set<Edge> done;  // points that are the least of their groups
    for (const Edge& pair : contacts_) {
      if (!passing_.contains(pair)) continue;
      const Edge least = {shown(pair.first), shown(pair.second)};
      if (least.first == least.second || !done.insert(least).second) {
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
      const auto [a, b, offset] = entry.first;
      if ((a != v && b != v) || changing_.contains(a == v ? b : a)) return false;
      return !is_present(a) || !is_present(b) || sign_at(gap_of(entry.first), now_) > 0;
    });
  }

  void end_passes() {
    for (const Id v : std::exchange(changing_, {})) end_passes(v);
  }

  // ---- motions ----

  void touch_around(Id v) {
    touched_.insert(v);
    for (const Image& n : neighbors_[v]) touched_.insert(n.id);
  }

  void set_motion(const Change& change) {
    const Id v = change.id;
    const Course* old = courses_[v];
    for (const Image& n : neighbors_[v]) {
      changed_.insert(edge(v, n));
      for (const Image& m : {apex(v, n), apex(n, v)}) {
        if (m.id != absent) changed_.insert(edge(n, m));
      }
    }
    if (hull_.contains(v)) changed_.insert({v, infinite});
    begins_[v] = now_;
    if (old != nullptr) leave_group(v);
    images_[v].clear();
    courses_[v] = change.motion ? &motions_.emplace_back(scale_.course(*change.motion)) : nullptr;
    if (change.motion) {
      if (continues()) past_motions_[v].push_back({now_, courses_[v]});
      join_group(v);
      if (courses_[v]->radius != motions_.front().radius) has_one_radius_ = false;
    }
    note_regrouped(v);
    if (!is_periodic() && (is_on_line_ || std::ranges::find(witness_, old) != witness_.end())) {
      is_witness_lost_ = true;
    }
    moved_.insert(v);
  }

  // ---- lives ----

  std::array<const Course*, 4> courses(const Points& points) const {
    std::array<const Course*, 4> result = {};
    for (std::size_t i = 0; i < 4; ++i) {
      if (points[i].id < absent) result[i] = &course(points[i]);
    }
    return result;
  }

  Life life_of(const Edge& e) const {
    const Points points = around(e);
    return {edge_life, points, courses(points), instant_, nullptr};
  }

  // Ends the life with that name unless its points and motions are unchanged, and begins a new one
  // if there are points.
  void renew(Kind kind, const Edge& id, const std::optional<Points>& points) {
    const auto found = alive_[kind].find(id);
    std::optional<Life> life;
    if (points) {
      life = Life{kind, *points, courses(*points), instant_, nullptr, passing_.contains(id)};
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
      add_specials(greatest_common_divisor(dx, dy), id);
      if (options_.has_contacts) check_contact_before(id);
      life->passes = passing_.contains(id);
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
  const Certifier certifier_;
  bool is_witness_lost_ = false;
  std::vector<Time> begins_;  // of motions
  struct Past_motion {
    Time begin;
    const Course* course;
  };
  std::vector<std::vector<Past_motion>> past_motions_;  // by id, if the log may continue a run
  std::map<Edge, Time> passing_;  // the last collision of discs that did not change them

  // In this instant:
  std::set<Id> moved_;
  std::set<Id> changing_;    // points whose motions the last rows have changed
  std::set<Edge> contacts_;  // of walls `itself`
  bool has_rows_ = false;

  std::deque<Special> specials_;  // to come, in order
  std::shared_ptr<const Instant> instant_;

  std::array<std::unordered_map<Edge, Life, Hash>, kinds> alive_;
  std::vector<Life> ended_;
  std::vector<std::future<std::optional<Refuted>>> workers_;
  std::optional<Refuted> refuted_;
  std::size_t certificates_ = 0;
  bool is_complete_ = false;  // whether the end was reached without a refutation
};

}  // namespace verify

#endif  // KINETRI_VERIFY_TRIANGULATION_H
