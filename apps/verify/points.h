// SPDX-License-Identifier: GPL-3.0-or-later
// The points at each time: their motions, and which of them coincide. The lemmas named here are in
// README.md.
#ifndef KINETRI_VERIFY_POINTS_H
#define KINETRI_VERIFY_POINTS_H

#include "lattice.h"

namespace verify {

// Points that are there at the present time, in groups of those that coincide (Lemma 8).
class Moving_points {
 protected:
  Moving_points(const Options& options, const std::vector<Change>& points,
                const std::vector<Row>& rows)
      : options_(options), rows_(rows), scale_(options, points, rows), lattice_(options, scale_) {
    Id size = 0;
    const auto note_id = [&](const Change& change) { size = std::max(size, change.id + 1); };
    std::ranges::for_each(points, note_id);
    for (const Row& row : rows) std::ranges::for_each(row.changes, note_id);
    courses_.resize(size);
    images_.resize(size);
    groups_of_.resize(size, groups_.end());
  }

  using Triangle = std::array<Image, 3>;  // of offsets only the differences matter

  bool is_periodic() const { return !options_.lattice.empty(); }

  static Image begin_of(const Edge& e) { return e.first; }
  static Image end_of(const Edge& e) { return {e.second, e.offset}; }
  static Edge edge(const Image& a, const Image& b) {
    const Edge e = {a.id, b.id, b.offset - a.offset};
    return is_normal(e) ? e : Edge{b.id, a.id, a.offset - b.offset};
  }
  std::string name(const Edge& e) const {
    const std::string a = std::to_string(e.first);
    if (e.second == infinite) return "hull corner " + a;
    return "edge " + a + "-" + std::to_string(e.second) +
           (is_periodic() ? " " + name_of(e.offset) : "");
  }

  bool is_present(Id id) const { return id < courses_.size() && courses_[id] != nullptr; }
  // The trajectory of an image of a point that is present. Valid as long as this object.
  const Course& course(const Image& image) const {
    if (image.offset == Offset()) return *courses_[image.id];
    const Course*& found = images_[image.id][image.offset];
    if (found == nullptr) {
      found = &motions_.emplace_back(lattice_.moved(*courses_[image.id], image.offset));
    }
    return *found;
  }

  // Whether the log may be that of a resumed run, in which discs may pass through each other from
  // the start until they separate.
  bool continues() const { return rows_.empty() || rows_.front().number != 0; }

  // ---- points that coincide ----

  // The point of least id with the trajectory and weight of the point, or of an image of it.
  Id shown(Id v) const { return *groups_of_[v]->second.begin(); }
  // Whether the point is hidden by another one (Lemma 8).
  bool is_twin(Id v) const { return is_present(v) && shown(v) != v; }
  // Whether it was when its row was due the last time, or before the first row.
  bool was_hidden(Id v) const { return hidden_.contains(v) || twins_.contains(v); }

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
    const Course* const wrapped =
        is_periodic() ? &motions_.emplace_back(lattice_.wrapped(course(v))) : courses_[v];
    const auto group = groups_.try_emplace(wrapped).first;
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
    const auto courses = possible(regrouping_.courses, v, groups_of_[v]->first);
    return std::ranges::any_of(courses, [&](const Course* course) {
      const auto group = groups_.find(course);
      const Id now = group == groups_.end() ? absent : *group->second.begin();
      const auto points = possible(regrouping_.shown, course, now);
      return std::ranges::find(points, other) != points.end();
    });
  }

  [[noreturn]] void refute(const std::string& message) const { throw Refuted{blamed_, message}; }

  const Options options_;
  const std::vector<Row>& rows_;
  const Scale scale_;
  const Lattice lattice_;
  mutable std::deque<Course> motions_;                           // of all times, and of images
  std::vector<const Course*> courses_;                           // of the points that are present
  mutable std::vector<std::map<Offset, const Course*>> images_;  // of these points
  std::map<const Course*, std::set<Id>, Is_before> groups_;      // of points that coincide
  std::vector<decltype(groups_)::iterator> groups_of_;           // by id, of the points present
  bool has_one_radius_ = true;                                   // all discs so far
  std::map<Id, Triangle> hidden_;                                // in triangles
  std::set<Id> twins_;                                           // hidden by other points

  // In this instant:
  std::set<Id> regrouped_;  // points that are the least of a group now, or were
  Regrouping regrouping_;
  std::set<Id> told_;  // points that are hidden or revealed

  Time now_;
  long row_ = -1;
  long blamed_ = -1;
};

}  // namespace verify

#endif  // KINETRI_VERIFY_POINTS_H
