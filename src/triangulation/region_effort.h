// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a run by regions pays: an account of the work of windows, in events; and pauses between
// windows that are cut.
#ifndef KINETRI_SRC_TRIANGULATION_REGION_EFFORT_H
#define KINETRI_SRC_TRIANGULATION_REGION_EFFORT_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "kinetri/base/platform.h"

namespace kinetri::detail {

/// What one window of a run by regions has done, in events.
struct Window_work {
  double reported = 0;  ///< that are events of the run
  double executed = 0;  ///< by all nodes, those undone included
  /// Of these, how many one thread has executed after the other, if all threads have had as much to
  /// do as they can have.
  double in_turn = 0;
  double undone = 0;  ///< since they came too early, or the window was cut
  double serial = 0;  ///< what one thread has done besides
};

/// An account of events. The unit is what the sequential loop takes for an event, so that nothing
/// depends on clocks: decisions are the same in each run with as many threads.
///
/// A new account has an advance. Each event of the run earns a share, in the loop and in a window.
/// What windows and divisions of the queue take more than the loop is paid first, and what windows
/// save is earned. The account never has more than the advance, and may be overdrawn: windows are
/// tried only as long as it is not. Let E be the events of a run and A the advance. Then windows
/// and divisions take no more than the loop would and `share` E + A + the loss of one window, in
/// time, and no more than twice as much in time of the processor.
class Region_effort {
 public:
  /// An event that a node executes, with its record and its place in the order, takes so much.
  static constexpr double cost_of_event = 1.25;

  /// Begins a call of the run. The first one gives the advance; a later one keeps what there is.
  /// An infinite share: windows are always tried, and what is noted changes nothing.
  void open(double share, double advance) {
    share_ = share;
    if (!is_open_) balance_ = advance;
    advance_ = advance;
    is_open_ = true;
  }

  /// The loop has executed the events of one time.
  void add_loop(std::size_t events) {
    alone_ = events == 1 ? alone_ + 1 : 0;
    earn(share_ * static_cast<double>(events));
  }

  /// A window has been executed. It has taken what one thread has executed in turn, or half of what
  /// all have executed, if that is more: so two threads that do what one could are no gain.
  void add_window(const Window_work& work) {
    const double in_turn = cost_of_event * work.in_turn + work.undone + work.serial;
    const double in_all = cost_of_event * work.executed + work.undone + work.serial;
    spend(std::max(in_turn, in_all / 2) - work.reported);
    earn(share_ * work.reported);
  }

  /// Something else has taken so much; less than 0 if it was saved.
  void spend(double events) { earn(-events); }

  /// Whether the account has so much; so much exactly is enough.
  bool has(double events) const { return is_unlimited() || balance_ >= events; }
  /// Whether windows are always tried.
  bool is_unlimited() const { return share_ == std::numeric_limits<double>::infinity(); }

  /// How many times with one event the loop has executed since the last time with several, or with
  /// none. A time with several cuts a window. Windows do not change it.
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

/// How many instants the loop executes before the next window. A window that is cut where it has
/// executed little is followed by a pause, each twice as long as the last one, as far as `most`
/// instants, until a window executes enough: so where each window is cut at once, windows become
/// rare.
class Region_pause {
 public:
  /// A window has executed little, or could not begin.
  void lengthen(std::size_t most) {
    left_ = next_;
    next_ = std::min(2 * next_, most);
  }
  /// A window has executed enough: the next pause is one instant. The present one goes on.
  void shorten() { next_ = 1; }
  /// The loop is to execute one instant, and no more, before the next window.
  void pass_one() { left_ = 1; }

  /// The loop is about to execute at most so many instants. How many of these it is to execute at
  /// once: those that are left, but one at least.
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
