// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/codec/group_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "video/codec/placement.h"

namespace kinetri::video {
namespace {

constexpr std::size_t least_to_judge = 10;
constexpr int relaxations = 30;
// Within this distance of the border, in pixels, a feature may not be found.
constexpr double unseen = 8;
// If two points come nearer to each other than this, in pixels, one is removed.
constexpr double least_gap = 0.75;

bool is_inside(const Vector_2& p, double width, double height, double distance) {
  return p.x >= distance && p.y >= distance && p.x <= width - distance && p.y <= height - distance;
}

bool is_on_stage(const Stream_header& header, const Place& p) {
  return p.x > header.left() && p.y > header.top() && p.x < header.right() && p.y < header.bottom();
}

// Removes all but the first of points in the same square of the size of the least gap, or in
// adjacent ones.
void remove_crowds(const Stream_header& header, std::vector<std::optional<Place>>& targets) {
  const double gap = std::ldexp(least_gap, static_cast<int>(header.place_bits));
  std::set<std::pair<std::int64_t, std::int64_t>> squares;
  for (std::size_t i = number_of_corners; i < targets.size(); ++i) {
    std::optional<Place>& target = targets[i];
    if (!target) continue;
    const auto column = static_cast<std::int64_t>(std::floor(target->x / gap));
    const auto row = static_cast<std::int64_t>(std::floor(target->y / gap));
    if (!squares.insert({column, row}).second) target.reset();
  }
}

}  // namespace

Followed_points::Followed_points(std::vector<Vector_2> places) {
  kinds_.emplace_back(places.size(), Track::Kind::followed);
  places_.push_back(std::move(places));
}

void Followed_points::step(const Optical_flow& flow, double width, double height) {
  const std::vector<Track> tracks = flow.follow(places_.back());
  std::vector<Vector_2> places = places_.back();
  std::vector<Track::Kind> kinds = kinds_.back();
  std::size_t features = 0;
  std::size_t lost = 0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (kinds[i] == Track::Kind::lost) continue;
    Track::Kind kind = tracks[i].kind;
    const bool is_seen = is_inside(places[i], width, height, unseen);
    if (!is_inside(places[i], width, height, 0) || (kind == Track::Kind::lost && !is_seen)) {
      kind = Track::Kind::featureless;
    }
    if (is_seen && kind != Track::Kind::featureless) ++features;
    if (kind == Track::Kind::lost) ++lost;
    if (kind == Track::Kind::followed) places[i] = tracks[i].place;
    if (kind != Track::Kind::followed) kinds[i] = kind;
  }
  lost_share_ =
      features < least_to_judge ? 0 : static_cast<double>(lost) / static_cast<double>(features);
  places_.push_back(std::move(places));
  kinds_.push_back(std::move(kinds));
}

std::vector<std::optional<Place>> targets_of(
    const Stream_header& header, const std::vector<Present_points::Point>& points,
    const Followed_points& followed, std::uint32_t frames,
    std::span<const std::pair<std::size_t, std::size_t>> edges) {
  const std::size_t n = points.size();
  // The corners rest.
  enum class Role { given, relaxed, rests };
  std::vector<Role> roles(n, Role::rests);
  std::vector<Vector_2> moves(n);
  for (std::size_t i = number_of_corners; i < n; ++i) {
    const Track::Kind kind = followed.kind(i, frames);
    roles[i] = kind == Track::Kind::followed ? Role::given : Role::relaxed;
    if (roles[i] == Role::given) {
      const Vector_2 from = followed.place(i, 0);
      const Vector_2 to = followed.place(i, frames);
      moves[i] = {to.x - from.x, to.y - from.y};
    }
  }
  std::vector<Vector_2> sums(n);
  std::vector<double> counts(n);
  std::vector<bool> is_known(n);
  for (std::size_t i = 0; i < n; ++i) is_known[i] = roles[i] == Role::given;
  for (int round = 0; round < relaxations; ++round) {
    std::ranges::fill(sums, Vector_2());
    std::ranges::fill(counts, 0.0);
    const auto pass = [&](std::size_t from, std::size_t to) {
      if (!is_known[from] || roles[to] != Role::relaxed) return;
      sums[to].x += moves[from].x;
      sums[to].y += moves[from].y;
      counts[to] += 1;
    };
    for (const auto& [a, b] : edges) {
      pass(a, b);
      pass(b, a);
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (counts[i] == 0) continue;
      moves[i] = {sums[i].x / counts[i], sums[i].y / counts[i]};
      is_known[i] = true;
    }
  }
  std::vector<std::optional<Place>> result(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Place from = points[i].node.place;
    if (i < number_of_corners) {
      result[i] = from;
      continue;
    }
    const Vector_2 p = position_of(header, from);
    Place target = place_at(header, {p.x + moves[i].x, p.y + moves[i].y});
    const Place expected = Present_points::expected_place(points[i], frames, {});
    if (points[i].frames != 0 && std::abs(target.x - expected.x) <= 1 &&
        std::abs(target.y - expected.y) <= 1) {
      target = expected;
    }
    if (is_on_stage(header, target)) result[i] = target;
  }
  remove_crowds(header, result);
  return result;
}

}  // namespace kinetri::video
