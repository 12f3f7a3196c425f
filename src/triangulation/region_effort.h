// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether windows pay: an account of their work, in events; and pauses after truncated windows.
#ifndef KINETRI_SRC_TRIANGULATION_REGION_EFFORT_H
#define KINETRI_SRC_TRIANGULATION_REGION_EFFORT_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "kinetri/base/platform.h"

namespace kinetri::detail {

/// The work of one window, in events.
struct Window_work {
  double reported = 0;  ///< events of the run
  double executed = 0;  ///< by all nodes, including those rolled back
  /// The number that one thread executes if the threads share the events as well as possible.
  double in_turn = 0;
  double rolled_back = 0;  ///< rolled back: executed too early, or the window was truncated
  double serial = 0;       ///< other work of one thread
};

/// An account of events. The unit is the cost of one event of the sequential loop, so nothing
/// depends on clocks: every run with the same number of threads makes the same decisions.
///
/// A new account has the balance A, the advance. Each event of the run adds `share`. Partitions of
/// the queue, and windows that cost more than the sequential loop would, reduce the balance;
/// windows that cost less increase it. The balance is at most A and may be negative; windows are
/// tried only while it is not. So the time of windows and partitions is at most that of the
/// sequential loop for the same E events + `share` E + A + the loss of one window, and the
/// processor time at most twice as much.
class Region_effort {
 public:
  /// The cost of an event that a node executes, with its record and the ordering.
  static constexpr double cost_of_event = 1.25;

  /// Begins a call of the run. The first call sets the balance to the advance; later ones keep it.
  /// If the share is infinite, windows are always tried.
  void open(double share, double advance) {
    share_ = share;
    if (!is_open_) balance_ = advance;
    advance_ = advance;
    is_open_ = true;
  }

  /// The sequential loop has executed the events of one time.
  void add_loop(std::size_t events) {
    alone_ = events == 1 ? alone_ + 1 : 0;
    earn(share_ * static_cast<double>(events));
  }

  /// A window has been executed. Its cost is that of the events that one thread executed in turn,
  /// or half of that of all events, if that is more: two threads that do the work of one gain
  /// nothing.
  void add_window(const Window_work& work) {
    const double in_turn = cost_of_event * work.in_turn + work.rolled_back + work.serial;
    const double in_all = cost_of_event * work.executed + work.rolled_back + work.serial;
    spend(std::max(in_turn, in_all / 2) - work.reported);
    earn(share_ * work.reported);
  }

  /// Other work has cost so much; negative if it was saved.
  void spend(double events) { earn(-events); }

  /// Whether the balance is at least this.
  bool has(double events) const { return is_unlimited() || balance_ >= events; }
  /// Whether windows are always tried.
  bool is_unlimited() const { return share_ == std::numeric_limits<double>::infinity(); }

  /// How many times with exactly one event the sequential loop has executed since the last other
  /// time. A time with several events truncates a window. Windows do not change this number.
  std::uint64_t alone() const { return alone_; }

 private:
  void earn(double events) {
    if (!is_unlimited()) balance_ = std::min(balance_ + events, advance_);
  }

  bool is_open_ = false;
  double share_ = 0;
  double advance_ = 0;
  double balance_ = 0;
  std::uint64_t alone_ = 0;
};

/// How many instants the sequential loop executes before the next window. After a window that was
/// truncated early there is a pause. Each pause is twice as long as the one before, up to `most`
/// instants, until a window executes enough events.
class Region_pause {
 public:
  /// A window has executed little, or could not begin.
  void lengthen(std::size_t most) {
    left_ = next_;
    next_ = std::min(2 * next_, most);
  }
  /// A window has executed enough: the next pause is one instant. The present pause is not changed.
  void shorten() { next_ = 1; }
  /// The present pause is one instant.
  void pass_one() { left_ = 1; }

  /// Takes up to `most` of the remaining instants, at least one, and returns their number: the
  /// sequential loop executes them at once.
  std::size_t take(std::size_t most) {
    const std::size_t taken = std::clamp<std::size_t>(left_, 1, most);
    left_ -= std::min(left_, taken);
    return taken;
  }

  /// Whether a window may be next.
  bool is_over() const { return left_ == 0; }

 private:
  std::size_t left_ = 0;
  std::size_t next_ = 1;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGION_EFFORT_H
