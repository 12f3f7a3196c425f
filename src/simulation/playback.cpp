// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/simulation/playback.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "kinetri/impl/base/check.h"

namespace kinetri {

bool has_weights(const Recording& recording) {
  return std::ranges::any_of(recording.motions, [](const Recorded_motion& recorded) {
    const auto& motion = recorded.motion;
    return motion && (motion->radius != 0 || motion->growth != 0 || motion->weight != 0);
  });
}

Periodic_triangle initial_triangle(const Recording& recording, std::size_t i) {
  if (recording.initial_offsets.empty()) return {recording.initial_triangles[i], {}};
  return {recording.initial_triangles[i], recording.initial_offsets[i]};
}

double shown_time(const Recording& recording, std::size_t row) {
  return std::min(recording.events[row].time.bounds.upper, recording.until);
}

Recorded_place place_of(const Polynomial_disc_motion_2& motion, double time) {
  const Vector_2 place = rounded_place(motion, time);
  Recorded_place result;
  result.is_there = true;
  result.x = place.x;
  result.y = place.y;
  result.radius = std::max(rounded_radius(motion, time), 0.0);
  result.weight = rounded_weight(motion, time);
  return result;
}

Playback::Playback(const Recording& recording) : recording_(recording) {
  const auto& motions = recording.motions;
  std::size_t points = 0;
  for (const Recorded_motion& motion : motions) {
    points = std::max(points, std::size_t{motion.point} + 1);
  }
  previous_.resize(motions.size());
  std::vector<std::optional<std::size_t>> last(points);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    previous_[i] = last[motions[i].point];
    last[motions[i].point] = i;
  }
  current_.resize(points);
  shown_.resize(points);
  start();
}

void Playback::start() {
  time_ = recording_.from;
  rows_ = next_motion_ = next_triangle_ = next_coincidence_ = 0;
  edges_.clear();
  triangles_ = {};
  for (std::size_t i = 0; i < recording_.initial_triangles.size(); ++i) {
    const auto corners = detail::images_of(initial_triangle(recording_, i));
    triangles_.insert(corners);
    if (!recording_.periodic_box) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      edges_.insert(detail::edge_between(corners[k], corners[(k + 1) % 3]));
    }
  }
  if (!recording_.periodic_box) {
    for (const Edge_ids& edge : recording_.initial_edges) edges_.insert({edge, {}});
  }
  std::ranges::fill(current_, std::nullopt);
  const auto& motions = recording_.motions;
  for (; next_motion_ < motions.size() && !motions[next_motion_].event; ++next_motion_) {
    current_[motions[next_motion_].point] = next_motion_;
  }
  std::iota(shown_.begin(), shown_.end(), Point_id{0});
  const auto& coincidences = recording_.coincidences;
  for (; next_coincidence_ < coincidences.size() && !coincidences[next_coincidence_].event;
       ++next_coincidence_) {
    shown_[coincidences[next_coincidence_].point] = coincidences[next_coincidence_].shown;
  }
}

// Executes the next row.
void Playback::execute() {
  const Recorded_event& event = recording_.events[rows_];
  if (event.removed) edges_.erase({*event.removed, event.removed_offset});
  if (event.added) edges_.insert({*event.added, event.added_offset});
  const auto& triangles = recording_.triangles;
  for (; next_triangle_ < triangles.size() && triangles[next_triangle_].event == rows_;
       ++next_triangle_) {
    const auto& [row, is_added, ids, offsets] = triangles[next_triangle_];
    const auto corners = detail::images_of({ids, offsets});
    is_added ? triangles_.insert(corners) : triangles_.erase(corners);
  }
  const auto& motions = recording_.motions;
  for (; next_motion_ < motions.size() && *motions[next_motion_].event == rows_; ++next_motion_) {
    current_[motions[next_motion_].point] = next_motion_;
  }
  const auto& coincidences = recording_.coincidences;
  for (; next_coincidence_ < coincidences.size() && coincidences[next_coincidence_].event == rows_;
       ++next_coincidence_) {
    shown_[coincidences[next_coincidence_].point] = coincidences[next_coincidence_].shown;
  }
  ++rows_;
}

void Playback::go_to(double time) {
  KINETRI_PRECONDITION(time >= recording_.from && time <= recording_.until,
                       "a time outside of the recording");
  const auto& events = recording_.events;
  if (time < time_) start();
  time_ = time;
  while (rows_ < events.size() && events[rows_].time.bounds.upper <= time) execute();
}

void Playback::go_to_row(std::size_t rows) {
  KINETRI_PRECONDITION(rows <= recording_.events.size(), "a row that is not in the recording");
  if (rows < rows_ || rows == 0) start();
  while (rows_ < rows) execute();
  if (rows > 0) time_ = shown_time(recording_, rows - 1);
}

const Polynomial_disc_motion_2* Playback::motion(Point_id id) const {
  if (!current_[id]) return nullptr;
  const auto& motion = recording_.motions[*current_[id]].motion;
  return motion ? &*motion : nullptr;
}

std::vector<std::size_t> Playback::numbers_of_coincident() const {
  std::vector<std::size_t> result(points());
  for (Point_id id = 0; id < result.size(); ++id) {
    if (shown_[id] != id) ++result[shown_[id]];
  }
  return result;
}

std::vector<Recorded_place> Playback::places() const {
  std::vector<Recorded_place> result(points());
  for (std::size_t id = 0; id < result.size(); ++id) {
    const auto* there = motion(static_cast<Point_id>(id));
    if (there != nullptr) result[id] = place_of(*there, time_);
  }
  if (recording_.is_thinned) interpolate_changing_points(result);
  find_hidden(result);
  return result;
}

// In a thinned recording, points that get another motion at the next instant are interpolated
// linearly between their positions at the two instants, since their events are missing.
void Playback::interpolate_changing_points(std::vector<Recorded_place>& places) const {
  const auto& events = recording_.events;
  if (rows_ == events.size()) return;
  const double before = rows_ == 0 ? recording_.from : events[rows_ - 1].time.nearest;
  const Recorded_time& instant = events[rows_].time;
  const double share = (time_ - before) / (instant.nearest - before);
  if (!(share <= 1)) return;
  for (std::size_t i = next_motion_; i < recording_.motions.size(); ++i) {
    const auto& [event, id, motion] = recording_.motions[i];
    if (events[*event].time != instant) return;
    if (!motion || !places[id].is_there) continue;
    const Recorded_place from = place_of(*this->motion(id), before);
    const Recorded_place to = place_of(*motion, instant.nearest);
    places[id].x = from.x + (to.x - from.x) * share;
    places[id].y = from.y + (to.y - from.y) * share;
  }
}

// Points that coincide with the one that is shown are hidden, and with weights those without edges.
// If there are no edges, one point is the only vertex: that of least power.
void Playback::find_hidden(std::vector<Recorded_place>& places) const {
  const auto coincides = [&](std::size_t id) { return shown_[id] != id; };
  const bool are_weighted = has_weights(recording_);
  for (std::size_t id = 0; id < places.size(); ++id) {
    places[id].is_hidden = places[id].is_there && (are_weighted || coincides(id));
  }
  if (!are_weighted) return;
  for (const auto& [ids, offset] : edges_) {
    places[ids[0]].is_hidden = places[ids[1]].is_hidden = false;
  }
  if (!edges_.empty()) return;
  double least = std::numeric_limits<double>::infinity();
  Recorded_place* vertex = nullptr;
  for (std::size_t id = 0; id < places.size(); ++id) {
    Recorded_place& place = places[id];
    if (!place.is_there || coincides(id)) continue;
    const double power = place.x * place.x + place.y * place.y - place.weight;
    if (!(power < least)) continue;
    least = power;
    vertex = &place;
  }
  if (vertex != nullptr) vertex->is_hidden = false;
}

}  // namespace kinetri
