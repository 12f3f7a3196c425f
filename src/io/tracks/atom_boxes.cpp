// SPDX-License-Identifier: GPL-3.0-or-later
#include "atom_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

// Numbers may be large, so products are those of a vector and a unit vector.
double length(const Vector_2& v) {
  return std::hypot(v.x, v.y);
}
Vector_2 direction(const Vector_2& v) {
  return {v.x / length(v), v.y / length(v)};
}
double dot(const Vector_2& a, const Vector_2& b) {
  return a.x * b.x + a.y * b.y;
}
double cross(const Vector_2& a, const Vector_2& b) {
  return a.x * b.y - a.y * b.x;
}
Vector_2 sum(const Vector_2& a, double times, const Vector_2& b) {
  return {a.x + times * b.x, a.y + times * b.y};
}

// The lattice reduction of Lagrange and Gauss: then one of a, b, a + b and a - b leads from any
// position to its nearest image.
void shorten(Vector_2& a, Vector_2& b) {
  for (;;) {
    if (length(b) < length(a)) std::swap(a, b);
    const Vector_2 shorter = sum(b, -std::round(dot(b, direction(a)) / length(a)), a);
    if (!(length(shorter) < length(b))) return;
    b = shorter;
  }
}

// Whole multiples of the basis vectors to subtract from the step, so that the rest is shortest.
std::array<double, 2> images_in(const Vector_2& step, const std::vector<Vector_2>& basis) {
  const Vector_2& a = basis.front();
  if (basis.size() == 1) return {std::round(dot(step, direction(a)) / length(a)), 0};
  const Vector_2& b = basis.back();
  const Vector_2 of_a = direction(a);
  const Vector_2 of_b = direction(b);
  const double first = std::round(cross(step, of_b) / cross(a, of_b));
  const double second = std::round(cross(of_a, step) / cross(of_a, b));
  std::array<double, 2> best = {first, second};
  double least = std::numeric_limits<double>::infinity();
  for (const double more_a : {0., -1., 1.}) {
    for (const double more_b : {0., -1., 1.}) {
      const double left = length(sum(sum(step, -(first + more_a), a), -(second + more_b), b));
      if (!(left < least)) continue;
      least = left;
      best = {first + more_a, second + more_b};
    }
  }
  return best;
}

}  // namespace

void Atom_boxes::add(std::size_t line, const Atom_box& box, bool are_wrapped) {
  const bool is_new = all_boxes_.empty() || !(all_boxes_.front().box == box);
  if (all_boxes_.size() < 2 && is_new) all_boxes_.push_back(images_of(line, box));
  if (!are_wrapped) return;
  if (boxes_.empty() || !(boxes_.back().box == box)) boxes_.push_back(images_of(line, box));
}

Atom_boxes::Images Atom_boxes::images_of(std::size_t line, const Atom_box& box) {
  Images result;
  result.line = line;
  result.box = box;
  std::vector<Vector_2> edges;
  for (std::size_t i = 0; i < box.edges.size(); ++i) {
    if (box.is_periodic[i] && !(box.edges[i] == Vector_2{})) edges.push_back(box.edges[i]);
  }
  result.edges = edges;
  if (edges.size() == 2 && cross(direction(edges[0]), direction(edges[1])) != 0) {
    shorten(edges[0], edges[1]);
    result.basis = edges;
  } else if (edges.size() == 1) {
    result.basis = edges;
  }
  // All sums with coefficients -1, 0 and 1, except negatives.
  edges.resize(3);
  for (int i = 0; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      for (int k = -1; k <= 1; ++k) {
        if (i == 0 && (j < 0 || (j == 0 && k <= 0))) continue;
        Vector_2 v;
        if (i != 0) v = sum(v, i, edges[0]);
        if (j != 0) v = sum(v, j, edges[1]);
        if (k != 0) v = sum(v, k, edges[2]);
        const auto is_known = [&](const Vector_2& u) { return u == v; };
        if (v == Vector_2{} ||
            std::any_of(result.shortest.begin(), result.shortest.end(), is_known))
          continue;
        result.shortest.push_back(v);
      }
    }
  }
  std::stable_sort(result.shortest.begin(), result.shortest.end(),
                   [](const Vector_2& u, const Vector_2& v) { return length(u) < length(v); });
  return result;
}

// The box of the frame that the line is in.
const Atom_boxes::Images& Atom_boxes::images_at(std::size_t line) const {
  const auto behind =
      std::upper_bound(boxes_.begin(), boxes_.end(), line,
                       [](std::size_t at, const Images& images) { return at < images.line; });
  return behind == boxes_.begin() ? *behind : *(behind - 1);
}

void Atom_boxes::settle_jumps(Tracks_file& file, const Tracks_input& input,
                              std::string_view expected) const {
  if (all_boxes_.size() == 1 && all_boxes_.front().basis.size() == 2) {
    const Vector_2& a = all_boxes_.front().edges[0];
    const Vector_2& b = all_boxes_.front().edges[1];
    const bool turns_left = cross(direction(a), direction(b)) > 0;
    file.periodic_box = turns_left ? std::array{a, b} : std::array{b, a};
  }
  const bool is_periodic = input.options.unwrap == Tracks_unwrap::periodic;
  if (is_periodic) expect_periodic_box(file, input.name);
  if (input.options.unwrap == Tracks_unwrap::nearest || (is_periodic && !boxes_.empty())) {
    unwrap(file, input.name, expected);
  } else if (!boxes_.empty()) {
    expect_no_jumps(file, input.name, expected);
  }
}

void Atom_boxes::expect_periodic_box(const Tracks_file& file, const std::string& name) const {
  if (file.periodic_box || file.tracks.empty()) return;
  if (all_boxes_.size() > 1) {
    throw Input_error(name, all_boxes_[1].line,
                      "the box differs from that of the frames before; expected one periodic box");
  }
  throw Input_error(name, 0,
                    "has no box that is periodic in two directions of the plane, and in no third "
                    "one that is oblique to it; expected one, such as boundaries pp pp in a dump");
}

void Atom_boxes::unwrap(Tracks_file& file, const std::string& name,
                        std::string_view expected) const {
  const auto fail = [&](std::size_t line, const std::string& message) {
    throw Input_error(name, line, message);
  };
  const auto has_images = [](const Images& images) { return !images.shortest.empty(); };
  if (std::none_of(boxes_.begin(), boxes_.end(), has_images)) {
    if (file.tracks.empty()) return;
    fail(0, "has no wrapped places in a box that is periodic in x or y; expected no --unwrap");
  }
  if (boxes_.size() > 1) {
    fail(boxes_[1].line,
         joined("the box differs from that of the frame before; ", expected, ", and no --unwrap"));
  }
  const std::vector<Vector_2>& basis = boxes_.front().basis;
  const std::vector<Vector_2>& shortest = boxes_.front().shortest;
  if (basis.empty()) {
    fail(boxes_.front().line,
         joined("the box is tilted so that places in the plane do not tell through which side an "
                "atom left; ",
                expected, ", and no --unwrap"));
  }
  std::size_t crossings = 0;
  for (Track& track : file.tracks) {
    std::array<double, 2> turns = {0, 0};  // images passed so far
    Vector_2 last = track.observations.front().place;
    for (std::size_t i = 1; i < track.observations.size(); ++i) {
      Track_observation& next = track.observations[i];
      const Vector_2 wrapped = next.place;
      const Vector_2 step = {wrapped.x - last.x, wrapped.y - last.y};
      const std::array<double, 2> images = images_in(step, basis);
      Vector_2 left = step;
      for (std::size_t k = 0; k < basis.size(); ++k) left = sum(left, -images[k], basis[k]);
      for (const Vector_2& v : shortest) {
        if (2 * std::abs(dot(left, direction(v))) != length(v)) continue;
        fail(next.line,
             joined("atom ", in_quotes(track.id), " goes half of the periodic box, which is ",
                    length(v), " wide, since line ", track.observations[i - 1].line,
                    ": two images of it are equally near; expected more frames"));
      }
      if (images[0] != 0 || images[1] != 0) ++crossings;
      for (std::size_t k = 0; k < basis.size(); ++k) {
        turns[k] -= images[k];
        if (turns[k] != 0) next.place = sum(next.place, turns[k], basis[k]);
      }
      if (!std::isfinite(next.place.x) || !std::isfinite(next.place.y)) {
        fail(next.line, joined("the place of atom ", in_quotes(track.id),
                               " beyond the box is out of the range of binary64; expected smaller "
                               "numbers"));
      }
      last = wrapped;
    }
  }
  file.remarks.push_back(
      joined("atoms go on to the nearest image of their next place, beyond the "
             "periodic box ",
             crossings, crossings == 1 ? " time" : " times"));
}

void Atom_boxes::expect_no_jumps(const Tracks_file& file, const std::string& name,
                                 std::string_view expected) const {
  const auto expect_none = [&](const Track& track, std::size_t i, const Images& images) {
    const Track_observation& last = track.observations[i - 1];
    const Track_observation& next = track.observations[i];
    const Vector_2 step = {next.place.x - last.place.x, next.place.y - last.place.y};
    for (const Vector_2& v : images.shortest) {
      const double way = std::abs(dot(step, direction(v)));
      if (!(way > length(v) / 2)) continue;
      const bool can_unwrap = !images.basis.empty() && boxes_.size() == 1;
      throw Input_error(
          name, next.line,
          joined("atom ", in_quotes(track.id), " goes ", way, " since line ", last.line,
                 ", more than half of the periodic box, which is ", length(v),
                 " wide: it left on one side and came in on the other; ", expected,
                 can_unwrap ? ", or --unwrap nearest, which lets atoms go the shortest way" : ""));
    }
  };
  for (const Track& track : file.tracks) {
    for (std::size_t i = 1; i < track.observations.size(); ++i) {
      const Images& before = images_at(track.observations[i - 1].line);
      const Images& now = images_at(track.observations[i].line);
      expect_none(track, i, now);
      if (&before != &now) expect_none(track, i, before);
    }
  }
}

}  // namespace kinetri
