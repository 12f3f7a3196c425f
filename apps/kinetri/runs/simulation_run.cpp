// SPDX-License-Identifier: GPL-3.0-or-later
#include "runs/simulation_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <ostream>
#include <string_view>
#include <utility>
#include <vector>

#include "answers/answer.h"
#include "cli/arguments.h"
#include "cli/interrupt.h"
#include "cli/terminal.h"
#include "cli/text.h"
#include "cli/worker_threads.h"
#include "kinetri/impl/io/stats_file.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/checkpoint_file.h"
#include "kinetri/io/event_log.h"
#include "kinetri/simulation/growth.h"
#include "outputs/area_output.h"
#include "outputs/certificate_output.h"
#include "outputs/edge_output.h"
#include "outputs/frame_outputs.h"
#include "outputs/motion_output.h"
#include "outputs/pressure_output.h"
#include "outputs/run_outputs.h"
#include "outputs/run_plot.h"
#include "outputs/verification.h"
#include "outputs/viewer_output.h"
#include "runs/run_summary.h"
#include "runs/thermostat.h"

namespace kinetri::app {
namespace {

// The files that the run reads.
std::vector<std::string> input_paths(const Run_settings& settings, const Run_source& source) {
  std::vector<std::string> result = source.other_paths();
  result.push_back(source.path());
  if (settings.answers.walkable) result.push_back(*settings.answers.walkable);
  return result;
}

// The file and line with which a message about the point begins.
std::string place_of(const Run_source& source, Point_id point) {
  const std::size_t line = source.line_of(point);
  return line == 0 ? "kinetri" : joined(input_name(source.path()), ":", line);
}

// Throws an error about the point, named as in the input.
[[noreturn]] void fail(const Run_source& source, Point_id point, const char* problem) {
  const std::size_t line = source.line_of(point);
  if (line == 0) throw Run_error(problem);
  throw Input_error(input_name(source.path()), line, problem);
}

class Simulation_run {
 public:
  Simulation_run(const Run_settings& settings, Run_source& source)
      : settings_(settings),
        source_(source),
        asked_(settings.answers),
        outputs_(settings.outputs, input_paths(settings, source)),
        progress_(settings.progress) {
    if (settings.verifies) verification_.emplace(settings.outputs);
    frames_ = frame_outputs(outputs_, settings.frame_rate);
    if (outputs_.has(Output::plot)) sampler_ = std::make_unique<Run_sampler>();
  }

  Exit_code run();

 private:
  void build();
  void expect_periodic_outputs();
  void expect_area() const;
  void expect_small_cells();
  void read_limits();
  std::uint64_t number_of_events() const {
    return simulation_.visit(
        [](const auto& s) { return s.triangulation().counters().number_of_events(); });
  }
  double time() const {
    return simulation_.visit([](const auto& s) { return s.current_time().to_double(); });
  }
  double end_of_run() const;
  void note_coincident();
  void watch_growth();
  bool is_jammed();
  std::optional<double> share_of_box() const;
  std::string jammed_discs() const;
  void report_early_end() const;
  void advance();
  bool go_to(double end);
  bool may_run_ahead() const;
  bool run_ahead(const Algebraic_number& until);
  bool has_room_for_events() const;
  template <class Run>
  std::size_t execute(const Run& run);
  void expect_logs_are_written();
  std::optional<double> next_stop() const;
  void stop_at(double time);
  template <class Change>
  void make_change(const Change& change);
  void audit(Audit_level level);
  void write_outputs();
  void write_edges_now(std::ostream& out);
  void write_ids(std::ostream& out);
  void write_state(std::ostream& out);
  void write_page(std::ostream& out);
  void write_plot(std::ostream& out);
  void write_statistics(std::ostream& out);
  void summarize() const;
  Exit_code verify() const;

  const Run_settings& settings_;
  Run_source& source_;
  Answer_settings asked_;
  Run_outputs outputs_;
  Progress progress_;
  Stopwatch stopwatch_;
  std::optional<Worker_threads> workers_;  // from before the simulation is made
  Run_statistics statistics_;
  std::optional<Event_log_writer> log_;
  std::unique_ptr<Event_observer> motion_log_;
  std::unique_ptr<Event_observer> certificate_log_;
  std::optional<Verification> verification_;
  Any_simulation simulation_;
  std::optional<Viewer_output> viewer_;
  std::vector<Followed_answer> answers_;
  std::optional<Frame_outputs> frames_;
  std::optional<Area_output> areas_;
  std::optional<Pressure_output> pressure_;
  std::optional<Thermostat> thermostat_;
  std::unique_ptr<Run_sampler> sampler_;
  std::string coincident_;              // points that coincide at the start, for the summary
  std::optional<Jam_watch> jam_watch_;  // if growing discs may jam
  bool jammed_ = false;
  std::optional<Contact_error> contact_;  // what has ended the run, before this contact
  std::string end_at_contact_;            // for the summary, as in ", in contacts without end"
  std::uint64_t executed_ = 0;
  std::uint64_t events_before_ = 0;  // of the run that this one continues
  Audits audits_;
};

Exit_code Simulation_run::run() {
  build();
  // A time window of parallel execution may have an event for every third point.
  stop_gracefully_from_now_on(std::chrono::milliseconds(400) +
                              std::chrono::microseconds(5 * statistics_.points));
  progress_.show_stage("running");
  if (settings_.audit == Audit_mode::events) audit(Audit_level::certificates);
  advance();
  if (settings_.audit != Audit_mode::none && !statistics_.interrupted) {
    progress_.show_stage("auditing");
    audit(Audit_level::certificates);
  }
  complete_outputs_from_now_on();
  progress_.show_stage("writing");
  write_outputs();
  progress_.clear();
  report_early_end();
  if (!settings_.quiet && !outputs_.is_unread()) summarize();
  const Exit_code verified = verify();
  if (statistics_.audits_failed > 0) {
    report_failed_audits(statistics_);
    return Exit_code::audit_failed;
  }
  if (verified != Exit_code::done) return verified;
  if (statistics_.interrupted) return Exit_code::interrupted;
  outputs_.expect_reader();
  return Exit_code::done;
}

// Reads the input and constructs the simulation.
void Simulation_run::build() {
  progress_.show_stage("reading");
  source_.read();
  if (outputs_.has(Output::events) || outputs_.has(Output::motions)) {
    source_.expect_logs(outputs_.identities());
  }
  statistics_.points = source_.number_of_points();
  statistics_.from = source_.from();
  progress_.show_stage(joined("triangulating ", counted(statistics_.points, "point")));
  statistics_.seconds.read = stopwatch_.lap();
  workers_.emplace(settings_.threads);
  simulation_ =
      source_.make_simulation(settings_.exact_only ? Arithmetic::exact_only : Arithmetic::filtered);
  expect_periodic_outputs();
  read_limits();
  simulation_.visit([this](auto& s) { s.set_threads(settings_.threads); });
  statistics_.until = end_of_run();
  expect_area();
  expect_small_cells();
  progress_.set_range(statistics_.from, statistics_.until);
  note_coincident();
  watch_growth();
  events_before_ = number_of_events();
  const Construction_seconds construction =
      simulation_.visit([](const auto& s) { return s.triangulation().construction_seconds(); });
  statistics_.seconds.initialize = construction.initialize;
  statistics_.seconds.build = stopwatch_.lap() - construction.initialize;
  if (outputs_.has(Output::initial_edges)) {
    write_present_edges(outputs_.stream(Output::initial_edges), simulation_);
    outputs_.finish(Output::initial_edges);
  }
  if (outputs_.has(Output::events)) {
    log_.emplace(outputs_.stream(Output::events), simulation_.event_columns());
    simulation_.visit([this](auto& s) { s.add_observer(*log_); });
  }
  if (outputs_.has(Output::motions)) {
    motion_log_ = follow_motions(outputs_.stream(Output::motions), simulation_);
  }
  if (outputs_.has(Output::certificates)) {
    certificate_log_ = follow_certificates(outputs_.stream(Output::certificates), simulation_);
  }
  if (verification_) verification_->start(simulation_);
  try {
    if (outputs_.has(Output::html)) {
      viewer_.emplace(simulation_, source_, statistics_.until, settings_.html_view,
                      settings_.html_range);
    }
    answers_ = follow_answers(outputs_, asked_, simulation_, source_);
  } catch (const Periodic_box_error& error) {
    throw Usage_error(joined("--range: ", error.what()));
  }
  if (frames_) frames_->start(source_, simulation_, statistics_.until);
  if (areas_) areas_->start(source_, simulation_, statistics_.until);
  if (outputs_.has(Output::pressure)) {
    pressure_.emplace(settings_.frame_rate)
        .start(outputs_.stream(Output::pressure), simulation_, statistics_.until);
  }
  if (settings_.thermostat) {
    thermostat_.emplace(*settings_.thermostat).start(simulation_, statistics_.until);
  }
  if (sampler_) sampler_->start(statistics_.until, simulation_);
  statistics_.seconds.write += stopwatch_.lap();
}

// Throws if the run is in a periodic box, as a checkpoint may say, and an option is not for that.
void Simulation_run::expect_periodic_outputs() {
  if (!simulation_.is_periodic()) return;
  if (!asked_.walkable) return;
  throw Usage_error("--walkable: is not for periodic boxes; expected no --walkable");
}

// Throws if a periodic box without contacts has no area at a time of the run. (With contacts a disc
// meets its own image before.)
void Simulation_run::expect_area() const {
  const auto box = simulation_.periodic_box();
  if (!box || source_.response() != "none") return;
  const Algebraic_number now = simulation_.visit([](const auto& s) { return s.current_time(); });
  try {
    box->require_area(now, statistics_.until);
  } catch (const Periodic_box_error& error) {
    throw Usage_error(joined("--until: ", error.what()));
  }
}

// Throws if an output measures cells, and the area of one in the periodic box need not be a
// binary64 number. A vector that changes linearly is longest at an end of the run.
void Simulation_run::expect_small_cells() {
  const auto box = simulation_.periodic_box();
  if (!box) return;
  constexpr double greatest = 1e149;  // well below the limit of cell_areas
  double length = 0;
  for (const Linear_motion_2& vector : {box->first(), box->second()}) {
    for (const double time : {statistics_.from, statistics_.until}) {
      const Vector_2 there = rounded_place(vector, time);
      length = std::max(length, std::hypot(there.x, there.y));
    }
  }
  if (length < greatest) return;
  for (const Output_row& row : output_table) {
    if (!row.has_limits || !outputs_.has(row.output)) continue;
    throw Usage_error(
        joined(row.option, ": a lattice vector of the periodic box has the length ", length,
               ", so that areas need not be binary64 numbers; expected less than ", greatest));
  }
}

// Reads the limits of cells if an output measures cells.
void Simulation_run::read_limits() {
  for (const Output_row& row : output_table) {
    if (!row.has_limits || !outputs_.has(row.output) || asked_.limits) continue;
    asked_.limits = std::make_shared<Cell_limits>(
        cell_limits(asked_, source_, simulation_.is_periodic(), row.option));
  }
  if (outputs_.has(Output::areas)) areas_.emplace(asked_.limits, settings_.frame_rate);
}

// The time at which the run ends, with the present growth of discs.
double Simulation_run::end_of_run() const {
  if (!settings_.until_share) return *source_.until();
  const std::optional<double> end =
      simulation_.visit([&]<class Traits>(const Simulation_2<Traits>& s) -> std::optional<double> {
        if constexpr (HasWeight<typename Traits::Motion> && PlanarKineticTraits_2<Traits>) {
          if (s.options().rim_touches && source_.response() == "elastic") {
            return time_of_share(s, *settings_.until_share);
          }
        }
        return std::nullopt;
      });
  if (end) return *end;
  throw Usage_error(
      "--until-share: the share that the discs cover need not increase; expected discs that grow, "
      "--box, --rim and --collisions elastic");
}

// "2 points at the start, the first is 5, with 1".
void Simulation_run::note_coincident() {
  simulation_.visit([this](const auto& s) {
    const auto& triangulation = s.triangulation();
    if (triangulation.number_of_hidden_points() == 0) return;
    std::size_t number = 0;
    std::string first;
    for (Point_id id = 0; id < triangulation.next_id(); ++id) {
      if (!triangulation.contains(id)) continue;
      const Point_id shown = triangulation.vertex(id)->point().id();
      if (shown == id) continue;
      if (number++ == 0) first = joined(source_.name(id), ", with ", source_.name(shown));
    }
    if (number > 0) {
      coincident_ = joined(counted(number, "point"), " at the start, the first is ", first);
    }
  });
}

void Simulation_run::watch_growth() {
  simulation_.visit([&]<class Traits>(Simulation_2<Traits>& s) {
    if constexpr (HasWeight<typename Traits::Motion>) {
      const auto& triangulation = s.triangulation();
      bool do_grow = false;
      for (Point_id id = 0; id < triangulation.next_id(); ++id) {
        do_grow = do_grow || (triangulation.contains(id) && triangulation.motion(id).growth > 0);
      }
      // Discs can jam if contacts change their velocities, or if one fills the box.
      const std::string response = source_.response();
      const bool do_turn = response == "elastic" || response == "swap";
      bool is_filled = false;
      if constexpr (PlanarKineticTraits_2<Traits>) {
        is_filled = s.options().rim_touches && does_disc_fill_box(s, statistics_.until);
      }
      if (do_grow && (do_turn || is_filled)) {
        jam_watch_.emplace(Jam_watch::until(statistics_.until));
        s.add_observer(*jam_watch_);
      }
    }
  });
}

bool Simulation_run::is_jammed() {
  if (!jam_watch_) return false;
  return simulation_.visit([this]<class Traits>(const Simulation_2<Traits>& s) {
    if constexpr (HasWeight<typename Traits::Motion>) return jam_watch_->is_jammed(s);
    return false;
  });
}

// The fraction that the discs cover, if they do not overlap and are inside of the box.
std::optional<double> Simulation_run::share_of_box() const {
  return simulation_.visit(
      []<class Traits>(const Simulation_2<Traits>& s) -> std::optional<double> {
        if constexpr (HasWeight<typename Traits::Motion> && PlanarKineticTraits_2<Traits>) {
          if (s.options().rim_touches && s.options().refuses_overlaps) return covered_share(s);
        }
        return std::nullopt;
      });
}

// Counts and returns the number of events that `run` executes.
template <class Run>
std::size_t Simulation_run::execute(const Run& run) {
  try {
    const std::size_t events = simulation_.visit(run);
    executed_ += events;
    return events;
  } catch (const Coincident_trajectories_error& error) {
    throw source_.coincidence(error, time());
  } catch (const Endless_contacts_error& error) {
    contact_ = error;
    end_at_contact_ = ", in contacts without end";
  } catch (const Own_image_error& error) {
    contact_ = error;
    end_at_contact_ = ", at a disc that meets its own image";
  }
  return 0;  // the state is that before the contact
}

// The next time of a change, a frame or a sample; none after the last.
std::optional<double> Simulation_run::next_stop() const {
  std::optional<double> result = source_.next_change();
  const auto include = [&](const auto& output) {
    const auto time = output ? output->next_time() : std::nullopt;
    if (time && (!result || *time < *result)) result = time;
  };
  include(frames_);
  include(areas_);
  include(pressure_);
  include(thermostat_);
  include(sampler_);
  return result;
}

template <class Change>
void Simulation_run::make_change(const Change& change) {
  const std::uint64_t before = number_of_events();
  try {
    change();
  } catch (const Coincident_trajectories_error& error) {
    throw source_.coincidence(error, time());
  }
  executed_ += number_of_events() - before;
  expect_logs_are_written();
}

void Simulation_run::stop_at(double time) {
  if (source_.next_change() == time) {
    // What follows from it at this time happens before a frame.
    return make_change([this] { source_.make_change(simulation_); });
  }
  if (thermostat_ && thermostat_->next_time() == time) {
    return make_change([this] { thermostat_->scale(simulation_); });
  }
  statistics_.seconds.run += stopwatch_.lap();
  if (frames_ && frames_->next_time() == time) frames_->write(simulation_);
  if (areas_ && areas_->next_time() == time) {
    areas_->write(outputs_.stream(Output::areas), simulation_);
    if (!outputs_.stream(Output::areas)) outputs_.finish(Output::areas);
  }
  if (pressure_ && pressure_->next_time() == time) {
    pressure_->write(outputs_.stream(Output::pressure));
    if (!outputs_.stream(Output::pressure)) outputs_.finish(Output::pressure);
  }
  if (sampler_ && sampler_->next_time() == time) sampler_->take(simulation_);
  statistics_.seconds.write += stopwatch_.lap();
}

// Executes the events, up to the end or an interruption.
void Simulation_run::advance() {
  for (auto stop = next_stop(); stop && go_to(*stop); stop = next_stop()) stop_at(*stop);
  statistics_.interrupted = !go_to(statistics_.until);
  // Contacts may have rounded radii down: then a little further.
  while (settings_.until_share && !statistics_.interrupted) {
    const double end = end_of_run();
    if (end == statistics_.until) break;
    statistics_.until = end;
    statistics_.interrupted = !go_to(end);
  }
  statistics_.reached = time();
  statistics_.seconds.run += stopwatch_.lap();
}

// Executes the events up to `end`. Returns false if an interruption or --max-events has stopped it
// before.
bool Simulation_run::go_to(double end) {
  const Algebraic_number until(end);
  while (!interrupted() && !jammed_ && !contact_ && executed_ <= settings_.max_events) {
    if (may_run_ahead()) {
      if (run_ahead(until)) return true;
      continue;
    }
    const std::size_t events = execute([&](auto& s) { return s.step(until); });
    if (contact_) return false;
    if (events == 0) {
      simulation_.visit([&](auto& s) { s.advance_to(until); });
      return true;
    }
    jammed_ = is_jammed();
    expect_logs_are_written();
    if (progress_.due()) progress_.show(time(), number_of_events());
    // Only the audits at start and end recompute all certificates exactly: that would dominate the
    // run time.
    if (settings_.audit == Audit_mode::events) audit(Audit_level::reference);
  }
  return false;
}

// Whether nothing is to be done between events, so that many may be executed at once.
bool Simulation_run::may_run_ahead() const {
  return settings_.audit != Audit_mode::events && !jam_watch_ && has_room_for_events();
}

// Whether --max-events cannot be exceeded within the next time window of parallel execution, or the
// next instant. A window has far fewer than 16 events per point.
bool Simulation_run::has_room_for_events() const {
  const std::uint64_t executed = number_of_events() - events_before_;
  const std::uint64_t needed = 16 * std::uint64_t{statistics_.points} + 1'000'000;
  return executed <= settings_.max_events && settings_.max_events - executed >= needed;
}

// Executes the events up to `until`, or until the run must continue step by step or end. Returns
// whether it reached `until`.
bool Simulation_run::run_ahead(const Algebraic_number& until) {
  bool goes_on = true;
  const std::function<bool()> may_go_on = [&] {
    expect_logs_are_written();
    goes_on = !interrupted() && has_room_for_events();
    if (goes_on && progress_.due()) progress_.show(time(), number_of_events());
    return goes_on;
  };
  execute([&](auto& s) { return s.advance_to(until, may_go_on); });
  expect_logs_are_written();
  return goes_on && !contact_;
}

// Throws if a log cannot be written. A closed pipe is not an error while there are other outputs.
void Simulation_run::expect_logs_are_written() {
  for (const Output log : {Output::events, Output::motions, Output::certificates}) {
    if (outputs_.has(log) && !outputs_.stream(log)) outputs_.finish(log);
  }
}

void Simulation_run::audit(Audit_level level) {
  statistics_.seconds.run += stopwatch_.lap();
  audits_.note(simulation_.visit([&](const auto& s) { return s.audit(level); }), time(),
               statistics_, progress_);
  statistics_.seconds.audit += stopwatch_.lap();
}

// Their ids: "3, 5 and 12 more".
std::string Simulation_run::jammed_discs() const {
  constexpr std::size_t most = 4;
  const std::vector<Point_id>& ids = jam_watch_->jammed_discs();
  std::vector<std::string> named;
  for (const Point_id id : ids) {
    if (named.size() < most) named.push_back(joined(id));
  }
  return joined(separated(named, ", "),
                ids.size() > most ? joined(" and ", ids.size() - most, " more") : "");
}

void Simulation_run::report_early_end() const {
  const std::string end = statistics_.reached < statistics_.until
                              ? joined(" instead of ", statistics_.until)
                              : ", before the last events of that time";
  const std::string where = joined("the run ends at t = ", statistics_.reached, end,
                                   "; results up to then are written; ");
  if (jammed_) {
    report("kinetri", joined("the discs are jammed (", jammed_discs(), "), and ", where,
                             "expected an earlier end or a smaller share, slower growth, faster or "
                             "fewer discs, or a larger box"));
  } else if (contact_) {
    report(place_of(source_, contact_->point()), joined(where, contact_->what()));
  } else if (executed_ > settings_.max_events) {
    report("kinetri", joined("more than ", settings_.max_events, " events, and ", where,
                             "expected fewer events, or a greater --max-events"));
  }
}

void Simulation_run::write_edges_now(std::ostream& out) {
  write_present_edges(out, simulation_);
}

void Simulation_run::write_ids(std::ostream& out) {
  source_.write_points(out);
}

void Simulation_run::write_state(std::ostream& out) {
  const std::vector<Checkpoint_log> logs = outputs_.finish_logs();
  simulation_.visit([&](const auto& s) {
    write_checkpoint(out, {s.snapshot(), source_.response(), logs, simulation_.periodic_box()});
  });
}

void Simulation_run::write_page(std::ostream& out) {
  viewer_->write(out);
}

void Simulation_run::write_plot(std::ostream& out) {
  sampler_->finish(simulation_);
  out << draw_run(sampler_->samples(), statistics_);
}

void Simulation_run::write_statistics(std::ostream& out) {
  statistics_.peak_rss_bytes = peak_rss_bytes();
  write_stats(out, statistics_);
}

void Simulation_run::write_outputs() {
  struct Writer {
    Output output;
    void (Simulation_run::*write)(std::ostream&);
  };
  // The plot and the statistics come last, since they contain the time of writing the others.
  // Initial edges, events, motions and certificates have been written before.
  constexpr std::array<Writer, 6> writers = {{{Output::edges, &Simulation_run::write_edges_now},
                                              {Output::ids, &Simulation_run::write_ids},
                                              {Output::checkpoint, &Simulation_run::write_state},
                                              {Output::html, &Simulation_run::write_page},
                                              {Output::plot, &Simulation_run::write_plot},
                                              {Output::stats, &Simulation_run::write_statistics}}};
  simulation_.visit([&](const auto& s) {
    statistics_.triangulation = s.triangulation().counters();
    statistics_.certificates = s.certificate_counters();
    statistics_.queue = s.triangulation().queue_counters();
    statistics_.contacts = s.contact_counters();
  });
  if (frames_) frames_->finish();
  for (const auto& [output, answer] : answers_) answer->write(outputs_.stream(output));
  for (const auto& [output, write] : writers) {
    statistics_.seconds.write += stopwatch_.lap();
    if (outputs_.has(output)) (this->*write)(outputs_.stream(output));
  }
  if (verification_) verification_->finish(simulation_);
  outputs_.commit();
}

// Not if a signal has stopped the run: the user does not want to wait. Nor if the run has ended
// within an instant, since the triangulation need only be correct after all events of a time.
Exit_code Simulation_run::verify() const {
  if (!verification_ || interrupted()) return Exit_code::done;
  if (contact_) {
    report("kinetri", "the run is not verified, as not all events of its last time have happened");
    return Exit_code::done;
  }
  return verification_->run(simulation_, source_,
                            outputs_.has_standard_output() ? Stream::error : Stream::output);
}

void Simulation_run::summarize() const {
  Run_summary summary;
  summary.events_before = events_before_;
  summary.end = jammed_                   ? ", jammed"
                : contact_                ? end_at_contact_
                : statistics_.interrupted ? ", interrupted"
                                          : "";
  summary.remarks = source_.remarks();
  if (asked_.limits && asked_.limits->walkable && !asked_.walkable) {
    summary.remarks.emplace_back("cells are those within the walkable area that it has");
  }
  summary.coincident = coincident_;
  summary.covered_share = share_of_box();
  summary.paths = outputs_.paths();
  print_summary(summary, statistics_);
}

}  // namespace

Exit_code run_simulation(const Run_settings& settings, Run_source& source) {
  try {
    return Simulation_run(settings, source).run();
  } catch (const Contact_error& error) {
    fail(source, error.point(), error.what());
  } catch (const Negative_radius_error& error) {
    fail(source, error.point(), error.what());
  } catch (const Periodic_offset_error& error) {
    throw Run_error(joined("at t = ", error.time().to_double(), " ", error.what()));
  }
}

}  // namespace kinetri::app
