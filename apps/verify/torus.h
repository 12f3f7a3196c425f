// SPDX-License-Identifier: GPL-3.0-or-later
// Points in a periodic box, and the faces that their edges imply: a surface without a border. The
// lemmas named here are in README.md.
#ifndef KINETRI_VERIFY_TORUS_H
#define KINETRI_VERIFY_TORUS_H

#include "lives.h"

namespace verify {

// A point, moved by its offset.
struct Image {
  Id id;
  Offset offset;
  friend auto operator<=>(const Image&, const Image&) = default;
};

inline std::string name_of(const Periodic_edge& e) {
  return "edge " + std::to_string(e.first) + "-" + std::to_string(e.second) + " " +
         name_of(e.offset);
}

// Edges are removed and added; then the faces at the touched points are made anew. Motions do not
// change.
class Torus {
 protected:
  Torus(const Options& options, const std::vector<Change>& points, const std::vector<Row>& rows)
      : scale_(options, points, rows),
        vectors_{scale_.course(options.lattice[0]), scale_.course(options.lattice[1])},
        spokes_(points.size()) {
    for (const Change& change : points) courses_.push_back(scale_.course(*change.motion));
    std::map<Course, Id, Is_before_value> groups;
    for (Id v = 0; v < courses_.size(); ++v) {
      shown_.push_back(groups.try_emplace(wrapped(courses_[v]), v).first->second);
    }
    visible_ = groups.size();
  }

  // ---- images ----

  // A face has its corner 0 anywhere; so offsets may be against any image, and only differences
  // matter.
  static Image moved(const Image& image, const Offset& by) {
    return {image.id, {image.offset.x + by.x, image.offset.y + by.y}};
  }
  static Periodic_edge edge(const Image& a, const Image& b) {
    const Periodic_edge e = {a.id, b.id, b.offset - a.offset};
    return is_normal(e) ? e : Periodic_edge{b.id, a.id, a.offset - b.offset};
  }
  static Image begin_of(const Periodic_edge& e) { return {e.first, {}}; }
  static Image end_of(const Periodic_edge& e) { return {e.second, e.offset}; }

  // The trajectory of the image. Valid as long as this object.
  const Course& course(const Image& image) {
    if (image.offset == Offset()) return courses_[image.id];
    const auto found = images_.find(image);
    if (found != images_.end()) return found->second;
    return images_.emplace(image, moved(courses_[image.id], image.offset)).first->second;
  }

  // ---- faces ----

  // The third corner of the face at the left.
  std::optional<Image> apex(const Image& a, const Image& b) const {
    const auto found = left_.find({a.id, {b.id, b.offset - a.offset}});
    if (found == left_.end()) return std::nullopt;
    return moved(found->second, a.offset);
  }

  void add_face(const Image& a, const Image& b, const Image& c) {
    if (apex(a, b) == c) return;
    std::map<std::pair<Id, Image>, Image> sides;
    for (const auto& [u, v, w] : turns(a, b, c)) {
      if (!spokes_[u.id].contains({v.id, v.offset - u.offset})) {
        refute("a face is no triangle: there is no " + name_of(edge(u, v)));
      }
      const Image relative = {w.id, w.offset - u.offset};
      if (apex(u, v) || !sides.try_emplace({u.id, {v.id, v.offset - u.offset}}, relative).second) {
        refute("two faces are on one side of " + name_of(edge(u, v)));
      }
    }
    left_.merge(sides);
    for (const auto& [u, v, w] : turns(a, b, c)) changed_.insert(edge(u, v));
    covered_ += area(a, b, c);
  }

  void remove_face(const Image& a, const Image& b, const Image& c) {
    for (const auto& [u, v, w] : turns(a, b, c)) {
      left_.erase({u.id, {v.id, v.offset - u.offset}});
      changed_.insert(edge(u, v));
    }
    covered_ -= area(a, b, c);
  }

  void remove_edge(const Periodic_edge& e) {
    const Image a = begin_of(e);
    const Image b = end_of(e);
    if (!has_edge(e)) refute("there is no " + name_of(e));
    for (const auto& [u, v] : {std::pair(a, b), std::pair(b, a)}) {
      if (const auto w = apex(u, v)) remove_face(u, v, *w);
    }
    spokes_[a.id].erase(b);
    spokes_[b.id].erase({a.id, a.offset - b.offset});
    --edges_;
    changed_.insert(e);
    touched_.insert({a.id, b.id});
  }

  void add_edge(const Periodic_edge& e) {
    for (const Id v : {e.first, e.second}) {
      if (v >= shown_.size()) refute(name_of(e) + " has an end that is not there");
      if (shown_[v] != v) {
        refute("point " + std::to_string(v) + " has edges, but an image of point " +
               std::to_string(shown_[v]) + " hides it");
      }
    }
    if (!spokes_[e.first].insert(end_of(e)).second) refute(name_of(e) + " is there already");
    spokes_[e.second].insert({e.first, Offset() - e.offset});
    ++edges_;
    changed_.insert(e);
    touched_.insert({e.first, e.second});
  }

  bool has_edge(const Periodic_edge& e) const {
    return e.first < spokes_.size() && spokes_[e.first].contains(end_of(e));
  }

  // The faces at a point, from the directions of its edges just after now: each is between two
  // edges that follow one another, and the faces surround the point once.
  void make_star(Id v) {
    const Image center = {v, {}};
    std::array<std::vector<Image>, 2> halves;  // of the directions: upper and lower
    for (const Image& n : spokes_[v]) {
      const auto [dx, dy] = minus(course(n), course(center));
      const int sign = sign_just_after(dy, now_);
      halves[sign < 0 || (sign == 0 && sign_just_after(dx, now_) < 0) ? 1 : 0].push_back(n);
    }
    const auto is_left_turn = [&](const Image& a, const Image& b) {
      return sign_just_after(orientation(course(center), course(a), course(b)), now_) > 0;
    };
    std::vector<Image> star;
    for (std::vector<Image>& half : halves) {
      std::ranges::sort(half, is_left_turn);
      star.insert(star.end(), half.begin(), half.end());
    }
    for (std::size_t i = 0; i < star.size(); ++i) {
      const Image& a = star[i];
      const Image& b = star[i + 1 == star.size() ? 0 : i + 1];
      if (!is_left_turn(a, b)) refute("no faces surround point " + std::to_string(v));
      add_face(center, a, b);
    }
    if (star.empty()) refute("point " + std::to_string(v) + " has no edges");
  }

  // A face that is flat now, as two of its corners meet, may turn over while all edges stay. Then
  // the faces at these edges change, too, so all its corners are touched if one is (Lemma 5).
  void touch_flat() {
    std::vector<Id> more(touched_.begin(), touched_.end());
    while (!more.empty()) {
      const Image v = {more.back(), {}};
      more.pop_back();
      for (const Image& n : spokes_[v.id]) {
        const auto m = apex(v, n);
        if (!m || sign_at(orientation(course(v), course(n), course(*m)), now_) != 0) continue;
        for (const Id w : {n.id, m->id}) {
          if (touched_.insert(w).second) more.push_back(w);
        }
      }
    }
  }

  // Makes the faces at all touched points anew.
  void remake() {
    touch_flat();
    for (const Id v : touched_) {
      for (const Image& n : spokes_[v]) {
        const Image center = {v, {}};
        if (const auto w = apex(center, n)) remove_face(center, n, *w);
        if (const auto w = apex(n, center)) remove_face(n, center, *w);
      }
    }
    for (const Id v : touched_) make_star(v);
    touched_.clear();
  }

  // Checks the premises of Lemma 9 that concern all faces together.
  void check_cover() const {
    for (const Periodic_edge& e : changed_) {
      if (has_edge(e) && (!apex(begin_of(e), end_of(e)) || !apex(end_of(e), begin_of(e)))) {
        refute(name_of(e) + " has no face on one side");
      }
    }
    if (edges_ != 3 * visible_) {
      refute("there are " + std::to_string(edges_) + " edges; expected three for each of " +
             std::to_string(visible_) + " points");
    }
    if (visible_ > 0 && covered_ != 2) {
      mpq_class times_covered(covered_, 2);
      times_covered.canonicalize();
      refute("the faces do not cover the box once, but " + times_covered.get_str() + " times");
    }
  }

  [[noreturn]] void refute(const std::string& message) const { throw Refuted{blamed_, message}; }

  struct Is_before_value {
    bool operator()(const Course& a, const Course& b) const { return Is_before()(&a, &b); }
  };

  const Scale scale_;
  const std::array<Course, 2> vectors_;  // of the box
  std::vector<Course> courses_;
  std::vector<Id> shown_;    // by id: the point of least id with the same images
  std::size_t visible_ = 0;  // the number of points that are shown
  std::map<Image, Course> images_;

  std::vector<std::set<Image>> spokes_;  // the other ends of edges, against the point
  std::size_t edges_ = 0;
  std::map<std::pair<Id, Image>, Image> left_;  // apexes; offsets are against the point
  Integer covered_ = 0;  // twice the sum of the areas of the faces, over that of the box

  // In this instant:
  std::set<Id> touched_;             // points whose faces must be made anew
  std::set<Periodic_edge> changed_;  // edges that have changed, or whose faces have

  Time now_;
  long row_ = -1;
  long blamed_ = -1;

 private:
  static std::array<std::array<Image, 3>, 3> turns(const Image& a, const Image& b, const Image& c) {
    return {{{a, b, c}, {b, c, a}, {c, a, b}}};
  }

  // Twice the area of a face over that of the box, if all points were at the origin.
  static Integer area(const Image& a, const Image& b, const Image& c) {
    const Offset u = b.offset - a.offset;
    const Offset v = c.offset - a.offset;
    return Integer(u.x) * Integer(v.y) - Integer(u.y) * Integer(v.x);
  }

  Course moved(Course point, const Offset& by) const {
    for (std::size_t i = 0; i < 2; ++i) {
      point.place[i] = point.place[i] + times(vectors_[0].place[i], Integer(by.x)) +
                       times(vectors_[1].place[i], Integer(by.y));
    }
    return point;
  }
  static Polynomial times(const Polynomial& p, const Integer& factor) {
    return p * trimmed({factor});
  }

  // The image that is in the box at time 0. Two points have the same one if and only if their
  // images are the same at all times (Lemma 8), as moves by whole multiples of the two vectors do
  // not change it.
  Course wrapped(Course point) const {
    const auto constant = [](const Polynomial& p) { return p.empty() ? Integer(0) : p[0]; };
    for (const std::size_t i :
         {1UL, 0UL}) {  // the second vector is along x and y, the first along x
      Integer count;
      const Integer size = constant(vectors_[i].place[i]);
      mpz_fdiv_q(count.get_mpz_t(), constant(point.place[i]).get_mpz_t(), size.get_mpz_t());
      for (std::size_t k = 0; k < 2; ++k) {
        point.place[k] = point.place[k] - times(vectors_[i].place[k], count);
      }
    }
    return point;
  }
};

}  // namespace verify

#endif  // KINETRI_VERIFY_TORUS_H
