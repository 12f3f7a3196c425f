// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reports an executed time window to the observers.
#ifndef KINETRI_SRC_TRIANGULATION_WINDOW_REPORTER_H
#define KINETRI_SRC_TRIANGULATION_WINDOW_REPORTER_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/triangulation/kinetic_core.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "triangulation/region_options.h"
#include "triangulation/window_log.h"

namespace kinetri::detail {

/// Reports the events of a window in the order of time, as the sequential loop does. Owns nothing.
template <class Traits, class Contacts>
class Window_reporter {
 public:
  static constexpr bool has_contacts = Contacts::exist;
  using Log = Window_log<Traits, has_contacts>;
  using Key = typename Log::Key;
  using Record = typename Log::Record;

  /// The others must outlive this object.
  Window_reporter(Kinetic_core<Traits>& core, const Region_options& options, Log& log,
                  Contacts& contacts)
      : schedule_(core.schedule),
        reporter_(core.reporter),
        options_(options),
        log_(log),
        contacts_(contacts) {}

  /// Counts the events of the log, which are sorted, and shows them to the observers with exact
  /// times, which several threads compute for some thousand events at once. Afterwards points have
  /// the motions of the end of the window. If an observer throws, all events are counted, and the
  /// present time is that of the last one.
  void report() {
    if (log_.order().empty()) return;
    count_events();
    auto next = log_.order().cbegin();
    const bool is_watched = !reporter_.observers().empty();
    if (is_watched) log_.restore_motions();
    reporter_.set_in_event(true);
    try {
      while (is_watched && next != log_.order().cend()) {
        const auto end = next + std::min(events_at_once, log_.order().cend() - next);
        auto blocks =
            blocks_of(std::span(&*next, static_cast<std::size_t>(end - next)), events_of_thread);
        call_for_each(options_, blocks, [this](std::span<const Key> block) {
          for (const Key& key : block) log_.time(key);
        });
        while (next != end) {
          const Key& key = *next++;
          report(key);
          log_.record(key).exact.reset();
        }
      }
    } catch (...) {
      for (const Key& key : log_.order()) log_.go_through(key);
      count_from(next);
      throw;
    }
    count_from(next);
  }

 private:
  // So many exact times are computed before these events are reported, and so many by one thread.
  static constexpr std::ptrdiff_t events_at_once = 16'384;
  static constexpr std::size_t events_of_thread = 1024;

  // Counts an event and shows it to the observers.
  void report(const Key& key) {
    Event event;
    if constexpr (has_contacts) {
      if (Log::is_contact(key)) event = contacts_.event(key);
    }
    if (!Log::is_contact(key)) {
      event = flip_event(key.kind, Log::flipped_edges(log_.record(key)));
    }
    schedule_.set_current_time(log_.time(key));
    event.time = schedule_.current_time();
    event.number = reporter_.counters().number_of_events();
    reporter_.count_event(key.kind);
    auto& observers = reporter_.observers();
    observers.call([&](Event_observer& observer) { observer.before_event(event); });
    log_.go_through(key);
    observers.call([&](Event_observer& observer) { observer.after_event(event); });
    if (!Log::is_contact(key)) return;
    // Each change of points is followed by the edges that it rebuilt, here none.
    observers.call([&](Event_observer& observer) { observer.after_rebuild(event.time, {}); });
  }

  // Updates the counters that are not by kind of event.
  void count_events() {
    Triangulation_counters& counters = reporter_.counters();
    counters.flat_hulls += static_cast<std::uint64_t>(
        std::ranges::count(log_.order(), Event_kind::hull_insert, &Key::kind));
    const auto flips = static_cast<std::uint64_t>(
        std::ranges::count_if(log_.order(), [](const Key& key) { return !Log::is_contact(key); }));
    counters.instants += flips;
    counters.largest_instant = std::max<std::uint64_t>(counters.largest_instant, flips > 0 ? 1 : 0);
    if constexpr (has_contacts) contacts_.count(log_.order().size() - flips);
  }

  // Counts the events from `next` on, and makes the time of the last one the present time.
  void count_from(typename std::vector<Key>::const_iterator next) {
    reporter_.set_in_event(false);
    if (next == log_.order().cend()) return;  // the present time is that of the last one
    for (; next != log_.order().cend(); ++next) reporter_.count_event(next->kind);
    const Key& last = log_.order().back();
    Record& record = log_.record(last);
    // With contacts, the points that the time is computed from may be in a record, which is
    // cleared.
    if (has_contacts || record.exact) {
      log_.time(last);
      schedule_.set_current_time(std::move(*record.exact));
    } else {
      schedule_.set_current_time(log_.certificate_points(last), last.bounds);
    }
  }

  Schedule<Traits>& schedule_;
  Event_reporter<Traits>& reporter_;
  const Region_options& options_;
  Log& log_;
  Contacts& contacts_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_WINDOW_REPORTER_H
