// SPDX-License-Identifier: GPL-3.0-or-later
// Decides by the log whether its edges are a Delaunay triangulation of all images of the points in
// a periodic box at all times. The lemmas named here are in README.md.
#ifndef KINETRI_VERIFY_TORUS_CHECKER_H
#define KINETRI_VERIFY_TORUS_CHECKER_H

#include "rows.h"
#include "torus.h"

namespace verify {

class Torus_checker : Torus {
 public:
  Torus_checker(const Options& options, const std::vector<Change>& points,
                const std::vector<Row>& rows)
      : Torus(options, points, rows), options_(options), rows_(rows), certifier_(options, scale_) {
    push_instant(exactly(options.from));
  }

  // Checks the whole log; throws Refuted. Returns the number of certificates.
  std::size_t check(const std::vector<Periodic_edge>& initial_edges,
                    const std::vector<Periodic_edge>* final_edges) {
    try {
      for (const Periodic_edge& e : initial_edges) add_edge(e);
      for (Id v = 0; v < shown_.size(); ++v) {
        if (shown_[v] == v) touched_.insert(v);
      }
      close();
      while (++row_ < std::ssize(rows_) && !refuted_) {
        enter(rows_[static_cast<std::size_t>(row_)]);
        if (row_ % 100'000 == 99'999) std::cerr << row_ + 1 << " of " << rows_.size() << " rows\n";
      }
      if (!refuted_) check_end(final_edges);
    } catch (const Refuted& refuted) {
      note(refuted);
    }
    // An earlier certificate may have failed before the row that was refuted.
    for (auto& [e, life] : alive_) {
      life.goes_on = is_complete_;
      end(life);
    }
    if (refuted_) throw Refuted(*refuted_);
    return certificates_;
  }

 private:
  // ---- rows ----

  void enter(const Row& row) {
    blamed_ = row_;
    if (row.instant == row.number) {
      begin_instant(row);
    } else if (!is_of_time_of(row, (&row)[-1])) {
      refute("it is of the instant of the row before, but not of its time");
    }
    if (!is_nearest(now_, row)) {
      refute("its time is not the binary64 number nearest to the exact one");
    }
    has_rows_ = true;
    if (row.kind == "flip") return flip(row);
    if (row.kind != "rebuild") refute("there is no " + row.kind + " in a periodic box");
    has_rebuild_ = true;
    if (const auto e = removed(row)) remove_edge(*e);
    if (const auto e = added(row)) add_edge(*e);
  }

  static std::optional<Periodic_edge> removed(const Row& row) {
    return edge_of(row.removed, row.removed_offset);
  }
  static std::optional<Periodic_edge> added(const Row& row) {
    return edge_of(row.added, row.added_offset);
  }
  static std::optional<Periodic_edge> edge_of(const std::vector<Edge>& edges,
                                              const Offset& offset) {
    if (edges.empty()) return std::nullopt;
    return Periodic_edge{edges.front().first, edges.front().second, offset};
  }

  void begin_instant(const Row& row) {
    Time time = exactly(row.lo);
    // An exact time that is no binary64 number is inside its interval.
    if (!is_binary64(row) || compare(time, now_) != 0) pass_before(time, !is_binary64(row));
    if (!is_binary64(row)) time = time_of_instant(row);
    Time start = exactly(options_.from);
    if (compare(time, start) <= 0) refute("it is not after the start");
    if (has_rows_ && compare(time, now_) == 0) refute("it is of the time of the row before");
    open(time);
    has_rebuild_ = false;
  }

  // The time of the instant that begins with this row: the first failure of a certificate that its
  // rows concern. All certificates hold now, so a change is due at a failure.
  Time time_of_instant(const Row& row) {
    for (;;) {
      std::optional<Time> first = next_failure(row);
      if (specials_.empty() || !is_in(specials_.begin()->time, row)) {
        if (first) return *first;
        break;
      }
      Time special = specials_.front().time;
      const int order = first ? compare(*first, special) : 1;
      if (order < 0 || (order == 0 && is_flip(row))) return *first;
      open(special);
      if (!is_flip(row) && (is_false_now() || fails_now(row))) return now_;
      close();
    }
    if (!is_flip(row) && !has_rows_ && is_in(now_, row)) return now_;
    std::ostringstream message;
    message.precision(17);
    message << "nothing that it tells of happens in [" << approximate(row.lo) << ", "
            << approximate(row.hi) << "]";
    refute(message.str());
  }

  // The first time after now, in the interval of the row, at which a certificate that the row
  // concerns changes its sign.
  std::optional<Time> next_failure(const Row& row) {
    std::vector<Polynomial> polynomials;
    if (!is_flip(row)) {
      polynomials = certificates_at(row);
    } else if (const auto e = removed(row); e && is_known(*e)) {
      polynomials.push_back(decider(*e));
    }
    std::optional<Time> first;
    for (const Polynomial& p : polynomials) {
      for (Time& root : roots_in(p, row)) {
        if (compare(root, now_) <= 0 || (first && compare(root, *first) >= 0)) continue;
        if (changes_sign(p, root)) first = root;
      }
    }
    return first;
  }

  // Whether one of the certificates fails at the present time.
  bool fails_now(const Row& row) {
    return std::ranges::any_of(certificates_at(row), [&](const Polynomial& p) {
      return sign_at(p, now_) == 0 && sign_just_after(p, now_) < 0;
    });
  }

  // The certificates of edges at the points of all rows of this instant.
  std::vector<Polynomial> certificates_at(const Row& row) {
    std::set<Periodic_edge> edges;
    for (const Row* r = &row;
         r != rows_.data() + rows_.size() && r->instant == row.instant && is_of_time_of(*r, row);
         ++r) {
      for (const auto& e : {removed(*r), added(*r)}) {
        if (!e) continue;
        for (const Id v : {e->first, e->second}) {
          if (v >= spokes_.size()) continue;  // refuted when the row is entered
          for (const Image& n : spokes_[v]) edges.insert(edge({v, {}}, n));
        }
      }
    }
    std::vector<Polynomial> result;
    for (const Periodic_edge& e : edges) {
      if (!has_faces(e)) continue;
      for (Certificate& c : certifier_.certificates(life_of(e))) result.push_back(std::move(c.p));
    }
    return result;
  }

  // Whether the triangulation would be incorrect just after now without a row of this time.
  bool is_false_now() {
    try {
      remake();
      check_cover();
    } catch (const Refuted&) {
      return true;
    }
    return std::ranges::any_of(changed_, [&](const Periodic_edge& e) {
      if (!has_edge(e)) return false;
      const auto all = certifier_.certificates(life_of(e));
      return std::ranges::any_of(all, [&](const Certificate& certificate) {
        const int sign = sign_just_after(certificate.p, now_);
        return sign < 0 || (sign == 0 && certificate.rule == Rule::positive);
      });
    });
  }

  // ---- flips ----

  bool has_faces(const Periodic_edge& e) const {
    return has_edge(e) && apex(begin_of(e), end_of(e)) && apex(end_of(e), begin_of(e));
  }

  // Whether the faces at an edge are known. If other rows have changed edges at both ends, the
  // faces are made after all rows.
  bool is_known(const Periodic_edge& e) const {
    return has_faces(e) && !(touched_.contains(e.first) && touched_.contains(e.second));
  }

  // The polynomial that is negative when the edge has to be flipped.
  Polynomial decider(const Periodic_edge& e) { return Certifier::decider(life_of(e)); }

  // Replaces an edge between two faces by the other diagonal. If other rows of the instant have
  // changed edges nearby, the faces are made from the edges after all rows.
  void flip(const Row& row) {
    if (has_rebuild_) refute("it is after a rebuild of the same time");
    const Periodic_edge old = *removed(row);
    if (!is_known(old) || sign_just_after(decider(old), now_) >= 0) {
      if (is_known(old) || touched_.empty()) {
        refute(has_edge(old) ? "it flips no edge that has to be flipped then"
                             : "there is no " + name_of(old));
      }
      remove_edge(old);
      add_edge(*added(row));
      return;
    }
    const Image a = begin_of(old);
    const Image b = end_of(old);
    const Image l = *apex(a, b);
    const Image r = *apex(b, a);
    if (*added(row) != edge(l, r)) refute(name_of(old) + " becomes " + name_of(edge(l, r)));
    auto touched = std::exchange(touched_, {});
    remove_edge(old);
    add_edge(edge(l, r));
    touched_ = std::move(touched);
    add_face(l, r, b);
    add_face(r, l, a);
  }

  void check_end(const std::vector<Periodic_edge>* final_edges) {
    blamed_ = row_;
    open(exactly(options_.until));
    close();
    is_complete_ = true;
    if (final_edges == nullptr) return;
    for (const Periodic_edge& e : *final_edges) {
      if (!has_edge(e)) refute("there is no " + name_of(e));
    }
    if (final_edges->size() != edges_) refute("the file of edges lacks an edge");
  }

  // ---- time ----

  // A time at which the ends of edges meet.
  struct Special {
    Time time;
    std::set<Periodic_edge> what;
  };

  void push_instant(const Time& time) {
    now_ = time;
    instant_ = std::make_shared<const Instant>(Instant{time, row_, row_});
    has_rows_ = false;
  }

  void add_specials(const Periodic_edge& e) {
    const auto [dx, dy] = minus(course(begin_of(e)), course(end_of(e)));
    for (Time& root : verify::roots_in(greatest_common_divisor(dx, dy), now_.lo, options_.until)) {
      if (compare(root, now_) <= 0) continue;
      auto at = specials_.begin();
      int order = -1;
      while (at != specials_.end() && (order = compare(at->time, root)) < 0) ++at;
      if (at != specials_.end() && order == 0) {
        at->what.insert(e);
      } else {
        specials_.insert(at, {root, {e}});
      }
    }
  }

  void touch_specials() {
    for (const Periodic_edge& e : specials_.front().what) {
      if (!has_edge(e)) continue;
      for (const Id v : {e.first, e.second}) {
        touched_.insert(v);
        for (const Image& n : spokes_[v]) touched_.insert(n.id);
      }
    }
    specials_.pop_front();
  }

  // Processes the earlier times, and this one if it is included, at which faces may change without
  // a row (Lemma 5).
  void pass_before(Time time, bool is_included = false) {
    close();
    while (!specials_.empty()) {
      const int order = compare(specials_.front().time, time);
      if (is_included ? order > 0 : order >= 0) break;
      if (compare(specials_.front().time, now_) > 0) push_instant(specials_.front().time);
      touch_specials();
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
    while (!specials_.empty() && compare(specials_.front().time, now_) == 0) touch_specials();
  }

  // Checks that everything changed at this time holds just after it.
  void close() {
    if (changed_.empty() && touched_.empty()) return;
    // Lives that have ended hold the instant as it was.
    if (instant_->rows_end != row_) {
      instant_ = std::make_shared<const Instant>(Instant{now_, instant_->first_row, row_});
    }
    const long row = std::exchange(blamed_, instant_->blamed());
    remake();
    check_cover();
    for (const Periodic_edge& e : std::exchange(changed_, {})) renew(e);
    blamed_ = row;
  }

  // ---- lives ----

  // Precondition: the edge has faces on both sides.
  Life life_of(const Periodic_edge& e) {
    const std::array<Image, 4> images = {begin_of(e), end_of(e), *apex(begin_of(e), end_of(e)),
                                         *apex(end_of(e), begin_of(e))};
    Life life = {edge_life, {}, {}, instant_, nullptr};
    for (std::size_t i = 0; i < 4; ++i) {
      life.points[i] = images[i].id;
      life.offsets[i] = images[i].offset;
      life.courses[i] = &course(images[i]);
    }
    return life;
  }

  // Ends the life of the edge unless its faces are unchanged, and begins a new one if it is there.
  void renew(const Periodic_edge& e) {
    const auto found = alive_.find(e);
    std::optional<Life> life;
    if (has_edge(e)) life = life_of(e);
    if (found != alive_.end()) {
      if (life && found->second.courses == life->courses) return;
      end(found->second);
      if (!life) alive_.erase(found);
    } else if (life) {
      add_specials(e);
    }
    if (!life) return;
    ++certificates_;
    alive_.insert_or_assign(e, std::move(*life));
  }

  void end(Life life) {
    life.death = instant_;
    note(certifier_.refutation(life, rows_));
  }

  // Keeps the refutation that is first in the log.
  void note(const std::optional<Refuted>& refuted) {
    if (refuted && (!refuted_ || refuted->row < refuted_->row)) refuted_ = refuted;
  }

  const Options options_;
  const std::vector<Row>& rows_;
  const Certifier certifier_;
  std::list<Special> specials_;  // to come, in order
  std::shared_ptr<const Instant> instant_;
  std::map<Periodic_edge, Life> alive_;
  std::optional<Refuted> refuted_;
  std::size_t certificates_ = 0;
  bool is_complete_ = false;  // whether the end was reached without a refutation

  // In this instant:
  bool has_rows_ = false;
  bool has_rebuild_ = false;
};

}  // namespace verify

#endif  // KINETRI_VERIFY_TORUS_CHECKER_H
