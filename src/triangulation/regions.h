// SPDX-License-Identifier: GPL-3.0-or-later
//
// Events on several threads: decides which events Optimistic_window executes in time windows, and
// which the sequential loop executes.
#ifndef KINETRI_SRC_TRIANGULATION_REGIONS_H
#define KINETRI_SRC_TRIANGULATION_REGIONS_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "kinetri/impl/triangulation/kinetic_core.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"
#include "triangulation/optimistic_window.h"
#include "triangulation/region_effort.h"
#include "triangulation/region_options.h"

namespace kinetri::detail {

/// A run of a kinetic triangulation, with or without contacts (No_contacts), on several threads.
///
/// Owns the options, the window and the pause between windows. The rest of its state is in the
/// division of the triangulation, for the next run. Invariant: between two windows the state is
/// that of the sequential loop after the same events, except that the queues may be partitioned.
template <class Traits, class Contacts = No_contacts<Traits>>
class Region_run {
 public:
  using Window = Optimistic_window<Traits, Contacts>;
  using Time = typename Window::Time;                ///< time of an event
  using Change = typename Topology<Traits>::Change;  ///< another motion of a point
  using Go_on = std::function<bool()>;

  /// The triangulation, or simulation, must outlive this object.
  explicit Region_run(typename Contacts::Core& core, const Region_options& options = {});

  /// As advance_to of the triangulation, with the same result. If an observer looks at the
  /// triangulation, the sequential loop executes all events. If an observer throws, all events of
  /// the window have been executed, and observers have not seen the later ones. If memory runs out
  /// in a window, the state is that before the window or that after its events, if memory suffices
  /// to schedule everything again; else the object can only be destroyed. Precondition: as there.
  std::size_t advance_to(const Time& until, const Go_on& may_go_on = nullptr);

  /// Gives points other motions at the present time and schedules their edges again; each region
  /// does this for the points whose triangles it owns. Cost: proportional to the degrees of the
  /// points. Preconditions: the queue is partitioned; the triangles stay embedded; there are no
  /// contacts.
  void change_in_place(std::span<const Change> changes);

  /// Merges the parts of the queues.
  void join();

  const Region_counters& counters() const { return window_.counters(); }

 private:
  using Process = typename Window::Process;

  static constexpr bool has_contacts = Contacts::exist;
  // The first window after the sequential loop is shorter: this share of a usual one.
  static constexpr double first_share = 0.125;

  bool can_run() const;
  bool run_windows(const Time& until, const Go_on& may_go_on);
  bool is_window_next(double begin, double last);
  bool may_windows_pay(double begin, double last);
  bool begin_window(double begin);
  void run_window(double end, double last);
  void adapt_width(bool is_whole, bool is_full);
  void divide();
  void distribute(std::size_t parts);
  bool is_divided();
  double number_of_points() const { return static_cast<double>(topology_.number_of_vertices()); }
  double events_in_window() const;
  double cost_of_division() const { return 0.25 * number_of_points(); }
  double cost_of_window() const { return number_of_points() / (has_contacts ? 128 : 256); }

  // The sequential loop.
  bool run_loop(const Time& until, const Go_on& may_go_on);
  std::size_t run_loop_instant(const Time& until);
  bool settle(const Time& until);
  double next_lower();
  bool is_loop_next();
  std::uint64_t executed(std::uint64_t before) const {
    return reporter_.counters().number_of_events() - before;
  }

  Region_division& division() { return schedule_.division(); }

  Kinetic_core<Traits>& core_;
  const Topology<Traits>& topology_;
  Schedule<Traits>& schedule_;
  Event_reporter<Traits>& reporter_;
  const Region_options options_;
  std::size_t regions_;
  Window window_;
  std::uint64_t windows_before_ = 0;  // in earlier calls of advance_to
  Region_pause pause_ = {};           // before the next window
};

template <class Traits>
Region_run<Traits> region_run_of(Kinetic_triangulation_2<Traits>& kinetic,
                                 const Region_options& options = {}) {
  return Region_run<Traits>(Core_access::core(kinetic), options);
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGIONS_H
