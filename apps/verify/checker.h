// SPDX-License-Identifier: GPL-3.0-or-later
// Decides by the log whether its edges are a Delaunay triangulation at all times. The
// lemmas named here are in README.md.
#ifndef KINETRI_VERIFY_CHECKER_H
#define KINETRI_VERIFY_CHECKER_H

#include "rows.h"
#include "triangulation.h"

namespace verify {

class Checker : Certified_triangulation {
 public:
  Checker(const Options& options, const std::vector<Change>& points, const std::vector<Row>& rows)
      : Certified_triangulation(options, points, rows) {}

  // Checks the whole log; throws Refuted. Returns the number of certificates.
  std::size_t check(const std::vector<Edge>& initial_edges, const std::vector<Edge>* final_edges) {
    try {
      for (const Edge& e : initial_edges) add_edge(e);
      find_witness();
      for (const Id v : moved_) set_hidden(v);  // without a row
      if (is_on_line_ && !hidden_.empty()) check_radii();
      while (++row_ < std::ssize(rows_) && !refuted_) {
        enter(rows_[static_cast<std::size_t>(row_)]);
        if (row_ % 100'000 == 99'999) std::cerr << row_ + 1 << " of " << rows_.size() << " rows\n";
      }
      if (!refuted_) check_end(final_edges);
    } catch (const Refuted& refuted) {
      note(refuted);
    }
    // An earlier certificate may have failed before the row that was refuted.
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
  // ---- rows ----

  static bool is_contact(const Row& row) { return row.kind == "wall" || row.kind == "collision"; }
  // The discs of a contact; of a wall, twice its disc.
  static Edge pair_of(const Row& row) {
    return {row.points.front(), row.points.back(), row.offset};
  }

  void enter(const Row& row) {
    blamed_ = row_;
    if (begins_instant(row)) {
      begin_instant(row);
    } else if (!is_of_time_of(row, (&row)[-1])) {
      refute("it is of the instant of the row before, but not of its time");
    }
    if (!is_nearest(now_, row))
      refute("its time is not the binary64 number nearest to the exact one");
    has_rows_ = true;
    if (changes_motions(row)) {
      has_change_ = true;
      return change(row);
    }
    end_passes();
    if (!row.changes.empty()) refute("it has a motion, but a " + row.kind + " changes none");
    if (is_flip(row)) return flip(row);
    (row.kind == "rebuild" ? has_rebuild_ : has_hidden_) = true;
    for (const Edge& e : row.removed) remove_edge(e);
    for (const Edge& e : row.added) add_edge(e);
    for (const Id v : row.points) hide_or_reveal(row, v);
  }

  // What the row says must be so just after it, with the changes of motions up to it.
  void hide_or_reveal(const Row& row, Id v) {
    const std::string which = "point " + std::to_string(v);
    if (!is_present(v) || (was_hidden(v) != told_.contains(v)) == (row.kind == "hide")) {
      refute(which + " is so already, or is not there");
    }
    if (row.by == v) refute(which + " does not hide itself");
    const Id by = row.by.value_or(v);
    if (row.kind == "hide" ? shown(v) != by : is_twin(v)) {
      refute(which + " is hidden by " + hider(v, shown(v)));
    }
    if (row.kind == "reveal" && !may_have_been_hidden_by(v, by)) {
      refute(which + " was not hidden by " + hider(v, by));
    }
    if (told_.erase(v) == 0) told_.insert(v);
    regrouping_.lacking_rows.erase(v);
    touched_.insert(v);
  }
  static std::string hider(Id v, Id other) {
    return other == v ? "a triangle" : "point " + std::to_string(other);
  }

  // Whether the row is the first one of its instant. Without the column `instant`, a row belongs to
  // the instant of the previous row if its printed time is the same, and its event happens now or
  // is a rebuild.
  bool begins_instant(const Row& row) {
    if (row.instant) return row.instant == row.number;
    if (row_ == 0 || !is_of_time_of(row, (&row)[-1])) return true;
    if (is_binary64(row)) return false;
    if (is_flip(row)) return !flipped_now(row) && are_known(row);
    return is_contact(row) && !is_contact_now(row);
  }

  void begin_instant(const Row& row) {
    check_rebuild();
    Time time = exactly(row.lo);
    const bool is_now = compare(time, now_) == 0;
    // An exact time that is no binary64 number is inside its interval.
    if (!is_binary64(row) || !is_now) pass_before(time, !is_binary64(row));
    if (!is_binary64(row)) time = time_of_instant(row);
    Time start = exactly(options_.from);
    if (!changes_motions(row) && !continues() && compare(time, start) <= 0) {
      refute("it is not after the start");
    }
    if (has_rows_ && compare(time, now_) == 0) refute("it is of the time of the row before");
    open(time);
    first_row_ = row_;
    has_rebuild_ = false;
    has_hidden_ = false;
    has_change_ = false;
    regrouping_ = {};
  }

  // The time of the instant that begins with this row: the first failure of a certificate that its
  // rows concern. All certificates hold now, so a change is due at a failure.
  Time time_of_instant(const Row& row) {
    for (;;) {
      std::optional<Time> first = next_failure(row);
      if (specials_.empty() || !is_in(specials_.front().time, row)) {
        if (first) return *first;
        break;
      }
      const int order = first ? compare(*first, specials_.front().time) : 1;
      const bool may_be_special = !is_flip(row) && !is_contact(row);
      if (order < 0 || (order == 0 && !may_be_special)) return *first;
      open(Time(specials_.front().time));
      if (may_be_special && (is_false_now() || fails_now(row))) return now_;
      close();
    }
    if (!is_flip(row) && !is_contact(row) && !has_rows_ && is_in(now_, row)) return now_;
    std::ostringstream message;
    message.precision(17);
    message << "nothing that it tells of happens in [" << approximate(row.lo) << ", "
            << approximate(row.hi) << "]";
    refute(message.str());
  }

  // The first failure from now on, in the interval of the row, of the certificates that the row
  // concerns.
  std::optional<Time> next_failure(const Row& row) {
    if (is_contact(row)) return next_contact(row);
    if (!is_flip(row)) return next_failure_at(row);
    std::optional<Time> first;
    for (const Edge& e : candidates(row)) {
      if (!is_known(e)) continue;
      const Polynomial p = decider(e);
      for (Time& root : roots_in(p, row)) {
        if (compare(root, now_) <= 0 || !changes_sign(p, root)) continue;
        if (!first || compare(root, *first) < 0) first = root;
        break;
      }
    }
    return first;
  }

  // The first time after now, in the interval of the row, at which a certificate at its points
  // changes its sign.
  std::optional<Time> next_failure_at(const Row& row) {
    std::optional<Time> first;
    for (const Polynomial& p : certificates_at(row)) {
      for (Time& root : roots_in(p, row)) {
        if (compare(root, now_) <= 0 || (first && compare(root, *first) >= 0)) continue;
        if (changes_sign(p, root)) first = root;
      }
    }
    return first;
  }

  // Whether one of these certificates fails at the present time.
  bool fails_now(const Row& row) {
    const auto all = certificates_at(row);
    return std::ranges::any_of(all, [&](const Polynomial& p) {
      return sign_at(p, now_) == 0 && sign_just_after(p, now_) < 0;
    });
  }

  // The certificates of edges at the points of all rows of this instant (without the column
  // `instant`, of the same interval), and those by which hidden points there are above the
  // triangles that hide them. A time at which one leaves its triangle is a special time.
  std::vector<Polynomial> certificates_at(const Row& row) const {
    std::set<Edge> edges;
    std::vector<Polynomial> result;
    for (const Row* r = &row;
         r != rows_.data() + rows_.size() && r->instant == row.instant && is_of_time_of(*r, row);
         ++r) {
      std::set<Id> points(r->points.begin(), r->points.end());
      for (const auto& changed : {r->removed, r->added}) {
        for (const Edge& e : changed) points.insert({e.first, e.second});
      }
      for (const Id v : points) {
        if (!is_present(v)) continue;
        const auto hidden = hidden_.find(v);
        if (neighbors_[v].empty() && hidden != hidden_.end() && hidden->second[0].id != absent) {
          const auto& [a, b, c] = hidden->second;
          result.push_back(outside(course(a), course(b), course(c), course(v)));
        }
        edges.insert({v, infinite});
        for (const Image& n : neighbors_[v]) edges.insert({edge(v, n), {n.id, infinite}});
      }
    }
    for (const Edge& e : edges) {
      if (!is_there(e)) continue;
      for (Certificate& c : certifier_.certificates(life_of(e))) {
        if (!is_about_contact(c.rule)) result.push_back(std::move(c.p));
      }
    }
    return result;
  }

  // Whether the triangulation would be incorrect just after now without a row of this time: whether
  // triangles that are made anew are invalid, or a certificate of one does not hold.
  bool is_false_now() {
    try {
      find_witness();
      is_on_line_ ? make_path() : remake();
      check_surface();
      for (const auto& [v, t] : hidden_) {
        if (alive_[hidden_life].contains(itself(v))) continue;
        const auto [a, b, c] = triangle_of(v, {});
        if (sign_just_after(outside(course(a), course(b), course(c), course(v)), now_) < 0)
          return true;
      }
    } catch (const Refuted&) {
      return true;
    }
    return std::ranges::any_of(changed_, [&](const Edge& e) {
      if (!is_there(e)) return false;
      const auto all = certifier_.certificates(life_of(e));
      return std::ranges::any_of(all, [&](const Certificate& certificate) {
        if (is_about_contact(certificate.rule)) return false;
        const int sign = sign_just_after(certificate.p, now_);
        return sign < 0 || (sign == 0 && certificate.rule == Rule::positive);
      });
    });
  }

  // ---- flips ----

  // The edges that the row may flip: an edge between two triangles or, if a point leaves the hull,
  // the edge between it and the infinite point.
  std::vector<Edge> candidates(const Row& row) const {
    std::vector<Edge> result = row.removed;
    if (row.kind == "hull_remove") {
      const auto [a, b, offset] = row.added.front();
      for (const auto& [u, w] : {std::pair(a, b), std::pair(b, a)}) {
        const Id v = apex(u, infinite).id;
        if (v != absent && apex(v, infinite).id == w) result.push_back({v, infinite});
      }
    }
    return result;
  }

  // Whether the triangles at an edge are known, and their points are present. If other rows have
  // changed edges at both ends, the triangles are made after all rows.
  bool is_known(const Edge& e) const {
    const auto is_touched = [&](Id v) { return v == infinite || touched_.contains(v); };
    return !(is_touched(e.first) && is_touched(e.second)) &&
           std::ranges::all_of(around(e), [&](const Image& image) {
             return image.id == infinite || is_present(image.id);
           });
  }
  // Whether all edges that the row may flip are known. The point that leaves the hull is between
  // two corners of the hull, whose edges must be known, too.
  bool are_known(const Row& row) const {
    std::vector<Edge> edges = candidates(row);
    if (edges.empty()) return false;
    if (row.kind == "hull_remove") {
      const auto [a, b, offset] = row.added.front();
      edges.insert(edges.end(), {{a, infinite}, {b, infinite}});
    }
    return std::ranges::all_of(edges, [&](const Edge& e) { return is_known(e); });
  }
  Polynomial decider(const Edge& e) const { return Certifier::decider(life_of(e)); }

  // The edge that has to be flipped now, of those that the row may flip.
  std::optional<Edge> flipped_now(const Row& row) {
    for (const Edge& e : candidates(row)) {
      if (is_known(e) && sign_just_after(decider(e), now_) < 0) return e;
    }
    return std::nullopt;
  }

  // Replaces an edge between two triangles by the other diagonal. With the infinite point: a point
  // becomes a corner of the hull, or ceases to be one. If other rows of the instant have changed
  // edges nearby, the triangles are made from the edges after all rows.
  void flip(const Row& row) {
    if (has_change_ || (has_rebuild_ && !has_hidden_)) {
      refute("it is after a rebuild, or a change of a motion, of the same time");
    }
    const std::optional<Edge> flipped = flipped_now(row);
    if (!flipped) {
      if (are_known(row) || (touched_.empty() && moved_.empty())) {
        refute("it flips no edge that has to be flipped then");
      }
      for (const Edge& e : row.removed) remove_edge(e);
      for (const Edge& e : row.added) add_edge(e);
      return;
    }
    const auto [a, b, l, r] = around(*flipped);
    const auto finite = [](const Edge& e) {
      return e.second == infinite ? std::vector<Edge>() : std::vector<Edge>{e};
    };
    if (row.removed != finite(*flipped) || row.added != finite(edge(l, r))) {
      refute(name(*flipped) + " becomes " + name(edge(l, r)));
    }
    auto touched = std::exchange(touched_, {});
    remove_triangles(*flipped);
    for (const Edge& e : row.removed) remove_edge(e);
    for (const Edge& e : row.added) add_edge(e);
    touched_ = std::move(touched);
    add_triangle(l, r, b);
    add_triangle(r, l, a);
  }

  // Rows of a rebuild are valid only if flips alone do not lead to the triangulation just after: if
  // more than one certificate is zero, or all points are on a line. A single flip is not a rebuild.
  void check_rebuild() {
    if (!has_rows_ || is_on_line_ || is_periodic() || groups_.size() - hidden_.size() < 4) return;
    std::size_t removed = 0;
    std::size_t added = 0;
    std::set<Id> points;
    for (long i = first_row_; i < row_; ++i) {
      const Row& row = rows_[static_cast<std::size_t>(i)];
      if (row.kind != "rebuild") return;
      removed += row.removed.size();
      added += row.added.size();
      if (removed > 1 || added > 1) return;
      for (const auto& edges : {row.removed, row.added}) {
        for (const Edge& e : edges) points.insert({e.first, e.second});
      }
    }
    std::set<std::set<Image>> vanishing;
    const auto note = [&](const Life& life) {
      const auto [a, b, c, d] = life.points;
      const auto try_points = [&](const std::set<Image>& set, const Polynomial& p) {
        if (!p.empty() && !vanishing.contains(set) && sign_at(p, now_) == 0) vanishing.insert(set);
      };
      const auto [p, q, r, s] = life.courses;
      if (life.kind == hidden_life) {
        try_points({a, b, c, d}, outside(*p, *q, *r, *s));
      } else if (life.kind == edge_life) {
        if (q == nullptr) try_points({a, c, d}, orientation(*p, *r, *s));
        if (q != nullptr && r != nullptr) try_points({a, b, c}, orientation(*p, *q, *r));
        if (q != nullptr && s != nullptr) try_points({a, b, d}, orientation(*p, *q, *s));
        if (q != nullptr && r != nullptr && s != nullptr) {
          try_points({a, b, c, d}, outside(*p, *q, *r, *s));
        }
      }
      return vanishing.size() > 1;
    };
    const auto& lives = alive_[edge_life];
    for (const Id v : points) {  // certificates that are zero are usually near each other
      for (const Image& n : neighbors_[v]) {
        for (const Edge& e : {edge(v, n), Edge{n.id, infinite}}) {
          const auto life = lives.find(e);
          if (life != lives.end() && note(life->second)) return;
        }
      }
    }
    for (const Kind kind : {edge_life, hidden_life}) {
      for (const auto& [id, life] : alive_[kind]) {
        if (note(life)) return;
      }
    }
    if (vanishing.empty()) return;
    blamed_ = row_ - 1;
    refute("it is called a rebuild, but one edge is flipped there, and nothing else happens");
  }

  // ---- walls, collisions, and changes of motions ----

  void change(const Row& row) {
    // Points that change at once are in order. Several contacts are never one change.
    const bool may_be_more_of_a_change = row_ > first_row_ && !is_contact(row) &&
                                         (&row)[-1].kind == row.kind &&
                                         (&row)[-1].points.front() < row.points.front();
    if (!may_be_more_of_a_change) {
      end_passes();
      begin_regrouping();
    }
    continue_regrouping();
    for (const Id v : row.points) {
      if (is_present(v) == (row.kind == "insert")) {
        refute("point " + std::to_string(v) + (is_present(v) ? " is there" : " is not there"));
      }
    }
    if (is_contact(row)) {
      if (row.kind == "collision" && !options_.may_collide) refute("discs do not collide");
      if (!is_contact_now(row)) refute("it is not the first contact of the two");
      if (!contacts_.insert(pair_of(row)).second) refute("it is the row before, again");
    } else if (!is_binary64(row)) {
      refute("its time is no binary64 number");
    }
    if (row.kind != "collision" && row.changes.size() != 1) refute("it has no motion");
    if (is_contact(row) && row.changes.empty()) {  // the discs pass through each other
      if (!may_pass(row)) refute("it changes no motion");
      renew(edge_life, pair_of(row), std::nullopt);
      changed_.insert(pair_of(row));
      passing_.insert_or_assign(pair_of(row), now_);
    }
    for (const Change& change : row.changes) {
      if (std::ranges::find(row.points, change.id) == row.points.end() ||
          std::ranges::count(row.changes, change.id, &Change::id) != 1 ||
          (row.kind != "collision" && change.motion.has_value() == (row.kind == "erase"))) {
        refute("it has a motion of point " + std::to_string(change.id));
      }
      const Course* old = courses_[change.id];
      if (!is_contact(row) && row.kind != "insert" && hits_wall(change.id)) {
        refute("it has no row of a wall that point " + std::to_string(change.id) + " hits first");
      }
      // The position may jump; in a contact, as it is rounded.
      if (row.kind != "insert") touch_around(change.id);
      end_passes(change.id);
      set_motion(change);
      changing_.insert(change.id);
      if (is_contact(row) && change.motion && !certifier_.goes_on(*old, course(change.id), row)) {
        refute("the motion of point " + std::to_string(change.id) + " does not go on");
      }
      std::erase_if(contacts_, [&](const Edge& pair) {
        return pair.first == change.id || pair.second == change.id;
      });
    }
  }

  bool may_pass(const Row& row) const {
    using Passing = Options::Passing;
    if (options_.passing != Passing::at_rest) return options_.passing == Passing::all;
    return std::ranges::all_of(row.points, [&](Id v) { return is_at_rest(course(v).motion); });
  }

  // The next contact in the interval of the row that the row may mean.
  std::optional<Time> next_contact(const Row& row) {
    if (!std::ranges::all_of(row.points, [&](Id v) { return is_present(v); })) return std::nullopt;
    std::optional<Time> first;
    if (row.kind == "collision") {
      first = first_contact(pair_of(row), row.hi);
      if (first && (!is_in(*first, row) || compare(*first, now_) <= 0)) first.reset();
      return first;
    }
    for (const auto& [side, p] : certifier_.clearances(course(row.points.front()))) {
      std::vector<Time> times = roots_in(p, row);
      std::ranges::move(roots_in(derivative(p), row), std::back_inserter(times));
      for (Time& time : times) {
        if (compare(time, now_) <= 0 || (first && compare(time, *first) >= 0)) continue;
        if (verify::is_contact(p, time)) first = time;
      }
    }
    return first;
  }

  bool is_contact_now(const Row& row) {
    if (!std::ranges::all_of(row.points, [&](Id v) { return is_present(v); })) return false;
    if (row.kind == "collision") {
      std::optional<Time> first = first_contact(pair_of(row), row.hi);
      return first && compare(*first, now_) == 0;
    }
    return hits_wall(row.points.front());
  }

  bool hits_wall(Id v) {
    const auto sides = certifier_.clearances(course(v));
    return std::ranges::any_of(
        sides, [&](const auto& side) { return verify::is_contact(side.second, now_); });
  }

  void check_end(const std::vector<Edge>* final_edges) {
    check_rebuild();
    blamed_ = row_;
    open(exactly(options_.until));
    close();
    is_complete_ = true;
    if (final_edges == nullptr) return;
    for (const Edge& e : *final_edges) {
      if (!has_edge(e)) refute("there is no " + name(e));
    }
    if (final_edges->size() != edges_) refute("the file of edges lacks an edge");
  }

  // Of this instant:
  long first_row_ = -1;
  bool has_rebuild_ = false;  // whether there was a row of that kind
  bool has_hidden_ = false;   // or one of a point that is hidden or revealed
  bool has_change_ = false;   // or one that may change a motion
};

}  // namespace verify

#endif  // KINETRI_VERIFY_CHECKER_H
