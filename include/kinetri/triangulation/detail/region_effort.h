// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a run by regions pays: an account of the work of windows, in events.
#ifndef KINETRI_TRIANGULATION_DETAIL_REGION_EFFORT_H
#define KINETRI_TRIANGULATION_DETAIL_REGION_EFFORT_H

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
/// Each event of the run earns a share; what windows and divisions of the queue take more than the
/// loop is paid, and what windows save is earned, up to an advance that a new account has, too.
/// Windows are tried only as long as the account is not overdrawn. Let E be the events of a run and
/// A the advance. Then windows and divisions take no more than the loop would and `share` E + A +
/// the loss of one window, in time, and no more than twice as much in time of the processor.
class Region_effort {
 public:
  /// An event that a node executes, with its record and its place in the order, takes so much.
  static constexpr double cost_of_event = 1.25;

  /// An account of runs with so many points. An infinite share: windows are always tried.
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

  /// A window has been executed.
  void add_window(const Window_work& work) {
    const double in_turn = cost_of_event * work.in_turn + work.undone + work.serial;
    const double in_all = cost_of_event * work.executed + work.undone + work.serial;
    spend(std::max(in_turn, in_all / 2) - work.reported);
    earn(share_ * work.reported);
  }

  /// Something else has taken so much; less than 0 if it was saved.
  void spend(double events) {
    if (events > 0) spent_ += events;
    earn(-events);
  }

  /// Whether the account has so much.
  bool has(double events) const { return is_unlimited() || balance_ >= events; }
  /// Whether windows are always tried.
  bool is_unlimited() const { return share_ == std::numeric_limits<double>::infinity(); }

  /// How many events the loop has executed that were alone at their times, since the last time with
  /// several events, or without one. A time with several cuts a window.
  std::uint64_t alone() const { return alone_; }
  /// What windows and divisions have taken more than the loop would, in all.
  double spent() const { return spent_; }

 private:
  void earn(double events) {
    if (!is_unlimited()) balance_ = std::min(balance_ + events, advance_);
  }

  bool is_open_ = false;
  double share_ = 0;
  double advance_ = 0;
  double balance_ = 0;
  double spent_ = 0;
  std::uint64_t alone_ = 0;
};

}  // namespace kinetri::detail

#endif  // KINETRI_TRIANGULATION_DETAIL_REGION_EFFORT_H
