// SPDX-License-Identifier: GPL-3.0-or-later
//
// Infinitely many contacts before one time.
#ifndef KINETRI_SRC_SIMULATION_ZENO_WATCH_H
#define KINETRI_SRC_SIMULATION_ZENO_WATCH_H

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

namespace kinetri::detail {

/// Detects Zeno behavior: infinitely many contacts before a finite time, the accumulation point.
/// Discs without free area behave so, and discs whose responses add energy without end.
///
/// Near an accumulation point the rate of contacts is c / (end - t)^2 if each contact adds the same
/// to a speed. So it doubles again and again, each time within less time than before, by the factor
/// sqrt(1/2). Elsewhere, in a gas that is heated or compressed, the rate doubles within the same
/// time or more, or not often. So the watch measures the rate over some contacts of each point, and
/// counts how often in sequence it has doubled within at most 0.9 of the time before. After eight
/// such doublings there is an accumulation point, and its place is extrapolated.
///
/// This is a heuristic in binary64 that decides only when to give up. It depends on the contacts
/// alone, so it is repeatable.
class Zeno_watch {
 public:
  /// What has been measured.
  struct Accumulation {
    double point = 0;        ///< the time before which there seem to be infinitely many contacts
    double began = 0;        ///< the time at which the first doubling began
    double rate_before = 0;  ///< contacts per unit of time then
    double rate = 0;         ///< the same now
  };

  /// Counts a contact that changes a motion. True after many: then `look` is to be called.
  bool count() { return ++contacts_ >= next_; }

  /// Measures the rate of contacts until `now`, with so many points. Returns the accumulation point
  /// if there seems to be one, and again while the rate is as great as then, or greater.
  std::optional<Accumulation> look(double now, std::uint64_t points) {
    const std::uint64_t more = std::max(fewest, contacts_of_each * points);
    const bool is_first = next_ == 0;
    const double elapsed = now - time_;
    if (!is_first && !(elapsed > 0)) {  // these contacts have one rounded time
      next_ += more;
      return std::nullopt;
    }
    const double rate = static_cast<double>(contacts_) / elapsed;
    in_sequence_ += contacts_;
    next_ = more;
    time_ = now;
    const std::uint64_t contacts = std::exchange(contacts_, 0);
    if (is_first) return std::nullopt;
    if (level_ == 0 || rate < level_ / 2) {
      begin_level(now, rate);
      doublings_ = 0;
    } else if (rate >= 2 * level_) {
      double_level(now, rate);
      if (doublings_ == 1) in_sequence_ = contacts;
    }
    if (doublings_ < enough || in_sequence_ < std::max(least, least_of_each * points)) {
      return std::nullopt;
    }
    found_.rate = rate;
    return found_;
  }

 private:
  static constexpr std::uint64_t fewest = 1000;
  static constexpr std::uint64_t contacts_of_each = 16;
  static constexpr int enough = 8;
  // More than those after which Jam_watch finds jammed discs, which it names.
  static constexpr std::uint64_t least = 25'000;
  static constexpr std::uint64_t least_of_each = 80;

  void begin_level(double now, double rate) {
    level_ = rate;
    level_began_ = now;
  }

  void double_level(double now, double rate) {
    const double elapsed = now - level_began_;
    const double factor = elapsed / elapsed_before_;
    if (doublings_ > 0 && factor <= 0.9) {
      ++doublings_;
      found_.point = now + elapsed * factor / (1 - factor);
    } else {
      doublings_ = 1;
      found_ = {.began = level_began_, .rate_before = level_};
    }
    begin_level(now, rate);
    elapsed_before_ = elapsed;
  }

  std::uint64_t contacts_ = 0;  // since time_
  std::uint64_t next_ = 0;      // the number of them at the next measurement; 0 before the first
  double time_ = 0;
  double level_ = 0;               // the rate at the last doubling
  double level_began_ = 0;         // the time of that doubling
  double elapsed_before_ = 0;      // between that doubling and the one before
  int doublings_ = 0;              // in sequence, each within less time than the one before
  std::uint64_t in_sequence_ = 0;  // contacts since the first of these began
  Accumulation found_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_ZENO_WATCH_H
