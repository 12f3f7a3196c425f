// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/io/shared_paths.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "kinetri/algebra/number_types.h"

namespace kinetri {
namespace {

constexpr std::size_t most_pairs = 10;

// A stay between two observations.
struct Piece {
  std::size_t stay = 0;
  double radius = 0;
  double begin = 0;
  double end = 0;
  Linear_motion_2 motion;
};

// The exact position on the line of a motion at time 0.
using Intercept = std::pair<Rational, Rational>;

Intercept intercept(const Linear_motion_2& motion) {
  const Rational epoch = to_rational(motion.epoch);
  return {to_rational(motion.position.x) - to_rational(motion.velocity.x) * epoch,
          to_rational(motion.position.y) - to_rational(motion.velocity.y) * epoch};
}

// By numbers that are cheap to compare. Zeros of both signs are equal.
auto key(const Piece& piece) {
  return std::tuple(piece.radius, piece.motion.velocity.x, piece.motion.velocity.y);
}

class Search {
 public:
  // Adds pieces of one velocity.
  void add(std::span<const Piece> pieces) {
    if (pieces.size() < 2) return;
    std::map<Intercept, std::vector<Piece>> lines;
    for (const Piece& piece : pieces) lines[intercept(piece.motion)].push_back(piece);
    for (auto& [where, of_line] : lines) add_line(of_line);
  }

  Shared_paths result() {
    for (const auto& [pair, time] : pairs_) result_.first.push_back({pair, time});
    std::ranges::sort(result_.first, {},
                      [](const Shared_path& path) { return std::pair(path.time, path.stays); });
    if (result_.first.size() > most_pairs) {
      result_.first.resize(most_pairs);
      result_.are_all = false;
    }
    return std::move(result_);
  }

 private:
  void add_line(std::vector<Piece>& pieces) {
    std::ranges::sort(pieces, {},
                      [](const Piece& piece) { return std::tuple(piece.begin, piece.stay); });
    // The present pieces: as many as a message names.
    std::vector<const Piece*> present;
    for (const Piece& piece : pieces) {
      std::erase_if(present, [&](const Piece* other) { return !(other->end > piece.begin); });
      for (const Piece* const other : present) {
        if (other->stay != piece.stay) add_pair(*other, piece);
      }
      if (present.size() > most_pairs) {
        result_.are_all = false;
      } else {
        present.push_back(&piece);
      }
    }
  }

  void add_pair(const Piece& a, const Piece& b) {
    const std::array<std::size_t, 2> pair = {std::min(a.stay, b.stay), std::max(a.stay, b.stay)};
    const auto [known, is_new] = pairs_.emplace(pair, b.begin);
    if (!is_new) known->second = std::min(known->second, b.begin);
  }

  Shared_paths result_;
  std::map<std::array<std::size_t, 2>, double> pairs_;
};

}  // namespace

Shared_paths shared_paths(std::span<const std::vector<Observation_2>> tracks,
                          std::span<const Stay> stays, std::span<const double> radii, double from,
                          double until) {
  std::vector<Piece> pieces;
  for (std::size_t stay = 0; stay < stays.size(); ++stay) {
    const auto& [track, first, last] = stays[stay];
    for (std::size_t i = first; i < last; ++i) {
      const double begin = std::max(from, tracks[track][i].time);
      const double end = std::min(until, tracks[track][i + 1].time);
      if (!(begin < end)) continue;
      pieces.push_back(
          {stay, radii.empty() ? 0 : radii[track], begin, end, motion_after(tracks[track], i)});
    }
  }
  std::ranges::sort(pieces, {}, key);
  Search search;
  for (std::size_t begin = 0; begin < pieces.size();) {
    std::size_t end = begin + 1;
    while (end < pieces.size() && key(pieces[end]) == key(pieces[begin])) ++end;
    search.add(std::span(pieces).subspan(begin, end - begin));
    begin = end;
  }
  return search.result();
}

}  // namespace kinetri
