// SPDX-License-Identifier: GPL-3.0-or-later
//
// Events on several threads, by optimistic parallel discrete-event simulation: the events of a
// window of time are executed region by region, each region in its own order, by several threads;
// then, in unions of two regions, of four, and so on, those that concern several regions; and then
// all are reported in the order of time. What has come too early is rolled back. docs/PARALLEL.md
// has the terms, the contract and the invariants; docs/MATH.md, section 17, proves that the result
// is that of the sequential loop.
#ifndef KINETRI_SRC_TRIANGULATION_REGIONS_H
#define KINETRI_SRC_TRIANGULATION_REGIONS_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinetri/impl/triangulation/region_effort.h"
#include "kinetri/impl/triangulation/region_runs.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"
#include "triangulation/window_log.h"

namespace kinetri::detail {

/// How a run by regions is made. The result does not depend on it.
struct Region_options {
  /// How many: the greatest power of two up to this and to 128; by the number of points if 0.
  std::size_t regions = 0;
  double events_per_vertex = 0.5;  ///< in a window, about; a fifth of it where discs collide
  /// With fewer events to come, as it seems, the plain loop executes them.
  double least_events_per_vertex = 1;
  double events_per_division = 4;  ///< a vertex, after which regions are made anew
  /// The share of all events that windows may cost more than the plain loop; see Region_effort.
  double most_waste = 1.0 / 16;
  /// Of how many points at most one is hidden. What happens to those is left to the plain loop.
  double points_per_hidden_one = 1000;
  /// Of a node in a window. It leaves what is more to the node above it; the root cuts the window.
  std::size_t most_flips = std::size_t{1} << 22;
  /// Of the numbers of flips: a face has room for 24 (Flip_numbers). Fewer for tests.
  unsigned stamp_bits = 24;
  std::size_t flips_per_slice = 4096;  ///< that one thread puts in order. Fewer for tests
  std::size_t threads = 0;  ///< at most; 0: those of oneTBB's arena; 1: one region after the other
  /// If not 0, the order in which one thread takes regions and other tasks: another one for each
  /// number. For tests.
  std::uint64_t order_of_tasks = 0;
};

/// The options of a run with so many threads.
inline Region_options with_threads(std::size_t threads) {
  Region_options options;
  options.threads = threads;
  return options;
}

/// Calls work(k) for each k below the count, as the options say: in parallel, or one after the
/// other.
void call_for_each_index(const Region_options& options, std::size_t count,
                         const std::function<void(std::size_t)>& work);

/// What a run by regions has done. Turns are counted as flips.
struct Region_counters {
  std::uint64_t windows = 0;    ///< of time
  std::uint64_t cuts = 0;       ///< windows that ended early
  std::uint64_t by_region = 0;  ///< flips that regions executed, those undone included
  std::uint64_t by_union = 0;   ///< flips that unions of regions executed, those undone included
  std::uint64_t by_rest = 0;    ///< flips that the root executed, those undone included
  std::uint64_t undone = 0;     ///< flips that came too early
  std::uint64_t cut_off = 0;    ///< flips that were undone since their window was cut
};

/// Motions that nothing changes. The other model of Turns, which has the functions that Region_run
/// calls, is Contact_turns of simulation/contact_turns.h.
struct No_turns {
  static constexpr bool exist = false;
  struct Entry {};
  struct Part {};
  struct Discarded {};
};

/// A run of a kinetic triangulation by regions. `Turns` is No_turns, or tells of turns.
template <class Traits, class Turns = No_turns>
class Region_run {
 public:
  using Types = detail::Topology<Traits>;
  using Time = typename Types::Time;      ///< of events
  using Change = typename Types::Change;  ///< of a point

  /// The triangulation must outlive this object.
  explicit Region_run(Kinetic_core<Traits>& core, const Region_options& options = {},
                      Turns turns = {});

  /// As advance_to of the triangulation, with the same result. Observers that look at the
  /// triangulation get the plain loop. If an observer throws, the triangulation is what it is after
  /// all events of a window of time, of which observers have not been told the later ones. If
  /// memory is missing in a window, it is what it was before the window, or after its events, if
  /// there is memory to schedule all anew; else it can only be destroyed. Precondition: as there.
  std::size_t advance_to(const Time& until, const std::function<bool()>& may_go_on = nullptr);

  /// Gives points other motions at the present time, each region those whose triangles it owns, and
  /// schedules their edges anew. Cost: proportional to the degrees of the points. Precondition: the
  /// queue is in parts; the triangles stay embedded.
  void make_turns(std::span<const Change> turns);

  /// Puts the queue into one part again.
  void join();

  /// What has been done so far.
  const Region_counters& counters() const { return counters_; }

 private:
  using Schedule = detail::Schedule<Traits>;
  using Entry = typename Schedule::Entry;
  using Edge = typename Types::Edge;
  using Two_sided_edge = typename Types::Two_sided_edge;
  using Certificate_points = typename Schedule::Certificate_points;
  using Face_handle = typename Types::Face_handle;
  using Vertex_handle = typename Types::Vertex_handle;
  using Triangulation = typename Types::Triangulation;
  using Queue = typename Schedule::Queue;
  using Part = typename Queue::Part;
  using Point_2 = typename Types::Point_2;
  using Turn_entry = typename Turns::Entry;
  using Turn_part = typename Turns::Part;
  using Discarded_turns = typename Turns::Discarded;

  static constexpr bool has_turns = Turns::exist;

  using Log = Window_log<Traits, has_turns>;
  using Stamp = typename Log::Stamp;
  using Moment = typename Log::Moment;
  using Turn = typename Log::Turn;
  using Flip = typename Log::Flip;
  using Key = typename Log::Key;
  using Points = typename Log::Points;
  struct Nothing {};

  // Where a turn is made: memory that is used again for each.
  struct Buffers {
    std::vector<Two_sided_edge> edges;
    std::vector<std::tuple<Two_sided_edge, Entry_kind, Certificate>> edge_certificates;
    std::vector<std::pair<Turn_entry, Certificate>> turn_certificates;
    std::vector<Queue_handle> handles;
  };

  struct alignas(64) Lane {
    std::size_t number = 0;             // of the node
    unsigned level = 0;                 // of the node
    Part* part = nullptr;               // whose entries it executes
    Queue_handle first_handle = 0;      // of the part, as the queue names it
    Turn_part* turn_part = nullptr;     // the same of turns
    typename Log::Node* log = nullptr;  // of its events
    std::size_t most_flips = 0;         // how many it may have in a window, if there are numbers
    std::size_t capacity = 0;           // how many it may have in this window
    Certificate_counters certificates = {};
    Certificate_counters turn_certificates = {};
    Triangulation_counters counters = {};
    [[no_unique_address]] std::conditional_t<has_turns, Buffers, Nothing> buffers = {};
    std::vector<Point_id> stalled = {};  // points of turns that it has deferred
    Discarded_turns discarded_turns = {};
    std::uint64_t undone = 0;

    bool is_region() const { return level == 0; }
  };

  // The four outer edges of a quadrilateral before the flip.
  using Outer_edges = typename Types::Outer_edges;

  using Go_on = std::function<bool()>;

  bool can_run() const;
  bool has_contacts() const {
    if constexpr (has_turns) return turns_.has_pairs();
    return false;
  }
  std::size_t advance(const Time& until, const Go_on& may_go_on);
  bool run_windows(const Time& until, const Go_on& may_go_on);
  bool is_window_next(double begin, double last);
  bool may_windows_pay(double begin, double last);
  bool begin_window(double begin);
  void adapt_width(bool is_whole, bool is_full);
  bool run_loop(const Time& until, const Go_on& may_go_on);
  double cost_of_division() const;
  double cost_of_window() const;
  Window_work work_of_nodes() const;
  std::uint64_t executed(std::uint64_t before) const {
    return reporter_.counters().number_of_events() - before;
  }
  double events_in_window() const;
  bool are_stamps_spent() const;
  void clear_stamps();
  void divide();
  void go_on_with_division();
  void move_to_parts(std::size_t count);
  void choose_owners();
  std::size_t root() const { return lanes_.size() - 1; }
  bool is_root(const Lane& lane) const { return lane.number == root(); }
  // The parts after those of the nodes; see above. The root defers nothing, and a region has no
  // part of entries that are due.
  std::size_t deferred_part(std::size_t node) const { return lanes_.size() + node; }
  std::size_t due_part(std::size_t node) const { return 2 * lanes_.size() - 1 + node - regions_; }
  // Those of the level, in their order.
  std::vector<Lane*> lanes_at(unsigned level);

  // Calls work(element) for each element of a vector.
  template <class Vector, class Work>
  void for_each(Vector& elements, const Work& work) const {
    call_for_each_index(options_, elements.size(), [&](std::size_t k) { work(elements[k]); });
  }
  bool run_window(double end);
  double execute_window(double end);
  template <class Work>
  void or_go_back(const Work& work);
  void go_back();
  void start_anew();
  bool settle(const Time& until);
  double next_lower();
  bool is_divided();
  bool is_loop_next();
  // Whether what an entry says is for the plain loop.
  static bool is_for_loop(const Entry& entry) {
    return entry.kind == Entry_kind::coincidence || entry.is_hidden();
  }
  double gather_due(double end);
  double gather_due(Lane& lane, double end);
  void run_region(Lane& lane, double end);
  void run_union(Lane& lane, double end);
  bool may_execute(Lane& lane, const Entry& entry, const Two_sided_edge& edge);
  void defer(Lane& lane, std::size_t from);
  void settle_order();
  void close_window();
  void count_and_clear();
  void count_certificates(Lane& lane);
  std::size_t run_loop_instant(const Time& until);
  // To be called before several threads change parts of the queues.
  void forget_first() {
    queue().forget_first();
    if constexpr (has_turns) turns_.queue().forget_first();
  }

  // Whether a vertex is in a node.
  bool owns(const Lane& lane, Point_id id) const {
    const Region_division& division = schedule_.division();
    return std::size_t{division.owner(id)} >> lane.level ==
           lane.number - division.first_node(lane.level);
  }
  bool is_owned(const Lane& lane, const Two_sided_edge& edge) const;
  bool is_blocked(Lane& lane, const Entry& entry, const Two_sided_edge& edge);
  void recheck(Lane& lane, std::span<const Entry> entries);
  bool is_flip(const Entry& entry, const Two_sided_edge& edge, Moment& moment);
  static bool hides_points(Face_handle face);
  bool is_convex(const Two_sided_edge& edge, const Moment& moment) const;
  void undo_later(Lane& lane, const Two_sided_edge& edge, Moment& moment);
  Moment moment_of(const Entry& entry, const Two_sided_edge& edge, const Part& part) const;
  KINETRI_ALWAYS_INLINE void put(const Lane& lane, const Two_sided_edge& edge, Entry_kind kind,
                                 Certificate&& known);
  void execute(Lane& lane, const Entry& entry, const Two_sided_edge& edge, Moment& moment);
  void discard(Lane& lane, Queue_handle handle);
  void undo(Lane& lane, Stamp stamp);
  void undo_last(Lane& lane, Stamp stamp);
  const Time& birth(const Two_sided_edge& edge);
  void certify_again(Lane& lane, std::span<const Two_sided_edge> edges);

  // Turns.
  double gather_due_turns(Lane& lane, double end);
  bool settle_turns(Lane& lane, const Time& last);
  bool is_turn_first(Lane& lane, bool is_flip_due);
  bool execute_turn(Lane& lane);
  bool turn(Lane& lane, const Turn_entry& entry, Moment& moment);
  bool set_points(Turn& turn, std::span<const Change> changes, Moment& moment);
  bool certify_turn(Lane& lane, const Turn& turn, Points turned, Moment& moment);
  static bool fails_at(const Certificate& known, const Moment& moment) {
    return known.kind == Certificate::Kind::fails && known.bounds.lower <= moment.bounds.upper;
  }
  void record_turn(Lane& lane, const Turn_entry& entry, std::unique_ptr<Turn>&& made,
                   const Moment& moment);
  void leave_turn(Lane& lane);
  void stall(Lane& lane, const Turn_entry& entry);
  bool owns_star(const Lane& lane, Point_id id) const;
  bool is_turn_blocked(Lane& lane, Points points, Moment& moment);
  bool do_faces_hide_points(Points points) const;
  bool ends_equal_weights(const Point_2& before, const Point_2& after) const;
  bool is_stalled(Point_id id, const Double_interval& bounds) const;
  bool is_pair_blocked(Lane& lane, const Two_sided_edge& edge, const Entry& entry);
  template <class Exact>
  bool waits_before(Face_handle face, const Part* own, const Double_interval& bounds,
                    const Exact& exact);
  template <class Exact>
  bool waits_before(Queue_handle turn, const Turn_part* own, const Double_interval& bounds,
                    const Exact& exact);
  void undo_later_around(Lane& lane, Points points, Moment& moment);
  void put_turn(const Lane& lane, Turn_entry entry, Certificate&& known);
  Turn_entry take_turn_entry(Queue_handle handle);
  template <class Function>
  void take_turn_entries(Lane& lane, Points points, const Function& function);
  void recheck_turn(Lane& lane, const Turn_entry& entry);
  void follow_flip(Lane& lane, const Flip& flip, Moment& moment);
  void unfollow_flip(Lane& lane, const Flip& flip, const Time& now);
  void undo_turn(Lane& lane, Flip& flip, const Time& now);
  template <class Function>
  void for_each_face_around(Points points, const Function& function) const;
  std::span<const Two_sided_edge> edges_around(Lane& lane, Points points) const;
  bool do_ends_meet(const Two_sided_edge& edge, Moment& moment);
  Event turn_event(const Key& key);
  void settle_turns_of_window();

  void cut_off();
  void count_window();
  void report();
  void count_from(typename std::vector<Key>::const_iterator next);
  void report(const Key& key);

  Queue& queue() { return schedule_.queue(); }
  Region_division& division() { return schedule_.division(); }
  // The first window after the loop has so much of the events of one.
  static constexpr double first_share = 0.125;
  // For which several threads make what is then reported; and for one thread of these.
  static constexpr std::ptrdiff_t events_at_once = 16'384;
  static constexpr std::size_t events_of_thread = 1024;

  Topology<Traits>& topology_;
  Triangulation& triangulation_;
  const Certification<Traits>& certification_;
  Schedule& schedule_;
  Event_reporter<Traits>& reporter_;
  Updates<Traits>& updates_;
  Event_loop<Traits>& loop_;
  [[no_unique_address]] Turns turns_;
  Region_options options_;
  std::size_t regions_;
  std::size_t threads_;
  Log log_;
  std::vector<Lane> lanes_;  // of the nodes
  std::optional<Time> cut_;  // where the window ends early
  // Entries whose bounds begin at or before this are put where the node that executes now takes its
  // entries from; minus infinity where none does, and while regions do.
  double due_until_ = -std::numeric_limits<double>::infinity();
  std::uint64_t windows_before_ = 0;  // in other calls
  std::size_t done_ = 0;              // flips that the last window reported
  Window_work work_ = {};             // of the last window
  Region_pause pause_ = {};           // before the next window
  // Of each point, with turns: a time up to which no turn of it waits for a node above.
  std::vector<double> stalls_;
  Region_counters counters_;
};

/// A run of a triangulation by regions.
template <class Traits, class Turns = No_turns>
Region_run<Traits, Turns> region_run_of(Kinetic_triangulation_2<Traits>& kinetic,
                                        const Region_options& options = {}, Turns turns = {}) {
  return Region_run<Traits, Turns>(Core_access::core(kinetic), options, std::move(turns));
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGIONS_H
