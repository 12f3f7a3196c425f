// SPDX-License-Identifier: GPL-3.0-or-later
#include "runs/periodic_run.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <ostream>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "cli/interrupt.h"
#include "cli/terminal.h"
#include "cli/text.h"
#include "cli/worker_threads.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/edges_file.h"
#include "kinetri/io/event_log.h"
#include "outputs/frame_outputs.h"
#include "outputs/motion_output.h"
#include "outputs/run_outputs.h"
#include "outputs/verification.h"
#include "outputs/viewer_output.h"
#include "runs/run_summary.h"
#include "sources/periodic_triangulation.h"
#include "sources/run_source.h"

namespace kinetri::app {
namespace {

Run_error offset_error(const Periodic_offset_error& error) {
  return Run_error(joined("at t = ", error.time().to_double(), " ", error.what()));
}

class Periodic_run {
 public:
  Periodic_run(const Run_settings& settings, const Periodic_settings& periodic)
      : settings_(settings),
        periodic_(periodic),
        outputs_(settings.outputs, {periodic.path}),
        progress_(settings.progress) {
    if (settings.verifies) verification_.emplace(settings.outputs);
    frames_ = frame_outputs(outputs_, settings.frame_rate);
  }

  Exit_code run();

 private:
  void build();
  std::unique_ptr<Periodic_triangulation> make_triangulation() const;
  void note_coincident();
  double time() const { return triangulation_->current_time().to_double(); }
  std::uint64_t number_of_events() const { return triangulation_->counters().number_of_events(); }
  std::optional<double> next_stop() const;
  void stop_at(double time);
  void make_changes(double time);
  void advance();
  bool go_to(double end);
  bool may_go_on();
  void audit(Audit_level level);
  void write_outputs();
  void summarize() const;
  Exit_code verify() const;

  const Run_settings& settings_;
  const Periodic_settings& periodic_;
  Run_outputs outputs_;
  Progress progress_;
  Stopwatch stopwatch_;
  std::optional<Worker_threads> workers_;  // from before the triangulation is made
  Run_statistics statistics_;
  std::optional<Periodic_points> points_;
  std::size_t next_change_ = 0;  // of the points
  std::optional<Event_log_writer> log_;
  std::unique_ptr<Event_observer> motion_log_;
  std::optional<Verification> verification_;
  std::optional<Frame_outputs> frames_;
  std::unique_ptr<Periodic_triangulation> triangulation_;
  std::optional<Viewer_output> viewer_;
  std::string coincident_;  // points that coincide, for the summary
  Audits audits_;
};

Exit_code Periodic_run::run() {
  build();
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
  if (number_of_events() > settings_.max_events) {
    report("kinetri", joined("more than ", settings_.max_events,
                             " events, and the run ends at t = ", statistics_.reached,
                             " instead of ", statistics_.until,
                             "; results up to then are written; expected fewer events, or a "
                             "greater --max-events"));
  }
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

// Reads the points and constructs the triangulation.
void Periodic_run::build() {
  progress_.show_stage("reading");
  points_.emplace(periodic_.read());
  statistics_.points = points_->number_of_points;
  statistics_.from = points_->from;
  statistics_.until = points_->until;
  progress_.show_stage(joined("triangulating ", counted(statistics_.points, "point")));
  statistics_.seconds.read = stopwatch_.lap();
  workers_.emplace(settings_.threads);
  triangulation_ = make_triangulation();
  progress_.set_range(statistics_.from, statistics_.until);
  note_coincident();
  statistics_.seconds.initialize = triangulation_->construction_seconds().initialize;
  statistics_.seconds.build = stopwatch_.lap() - statistics_.seconds.initialize;
  if (outputs_.has(Output::initial_edges)) {
    write_periodic_edges(outputs_.stream(Output::initial_edges), triangulation_->periodic_edges());
    outputs_.finish(Output::initial_edges);
  }
  if (outputs_.has(Output::events)) {
    log_.emplace(outputs_.stream(Output::events), Event_columns::periodic);
    triangulation_->add_observer(*log_);
  }
  if (outputs_.has(Output::motions)) {
    motion_log_ = follow_motions(outputs_.stream(Output::motions), *triangulation_);
  }
  if (verification_) verification_->start(*triangulation_);
  if (outputs_.has(Output::html)) {
    viewer_.emplace(*triangulation_, title_of(periodic_.path), points_->labels, statistics_.until,
                    settings_.html_view);
  }
  if (frames_) frames_->start(*triangulation_, statistics_.until);
  statistics_.seconds.write += stopwatch_.lap();
}

std::unique_ptr<Periodic_triangulation> Periodic_run::make_triangulation() const {
  const Arithmetic arithmetic =
      settings_.exact_only ? Arithmetic::exact_only : Arithmetic::filtered;
  try {
    return std::make_unique<Periodic_triangulation>(
        points_->motions, Algebraic_number(points_->from),
        Periodic_kinetic_traits_2(points_->box, arithmetic), periodic_.coincident);
  } catch (const Coincident_trajectories_error& error) {
    throw points_->coincidence(error, points_->from);
  } catch (const Periodic_box_error& error) {  // a point is too far away
    throw Input_error(input_name(periodic_.path), 0, error.what());
  } catch (const Periodic_offset_error& error) {
    throw offset_error(error);
  }
}

// "2 points, the first is 5, with 1"; if no motion changes, they coincide for the whole run.
void Periodic_run::note_coincident() {
  if (triangulation_->number_of_hidden_points() == 0) return;
  Point_id first = 0;
  while (!triangulation_->is_hidden(first)) ++first;
  coincident_ =
      joined(counted(triangulation_->number_of_hidden_points(), "point"),
             points_->changes.empty() ? " at all times" : " at the start", ", the first is ", first,
             ", with ", triangulation_->vertex(first)->point().id());
}

// Executes the events, up to the end or an interruption.
void Periodic_run::advance() {
  try {
    for (auto stop = next_stop(); stop && go_to(*stop); stop = next_stop()) stop_at(*stop);
    statistics_.interrupted = !go_to(points_->until);
  } catch (const Periodic_offset_error& error) {
    throw offset_error(error);
  }
  statistics_.reached = time();
  statistics_.seconds.run += stopwatch_.lap();
}

// The next time of changes or of a frame; none after the last.
std::optional<double> Periodic_run::next_stop() const {
  std::optional<double> result = frames_ ? frames_->next_time() : std::nullopt;
  const auto& changes = points_->changes;
  if (next_change_ < changes.size() && changes[next_change_].time <= points_->until) {
    const double time = changes[next_change_].time;
    if (!result || time < *result) result = time;
  }
  return result;
}

// Changes of a time come before a frame.
void Periodic_run::stop_at(double time) {
  make_changes(time);
  statistics_.seconds.run += stopwatch_.lap();
  if (!frames_ || frames_->next_time() != time) return;
  frames_->write(*triangulation_);
  statistics_.seconds.write += stopwatch_.lap();
}

void Periodic_run::make_changes(double time) {
  std::vector<Point_id> gone;
  std::vector<Point_id> turning;
  std::vector<Linear_motion_2> motions;
  std::vector<Linear_motion_2> coming;
  const auto& changes = points_->changes;
  for (; next_change_ < changes.size() && changes[next_change_].time == time; ++next_change_) {
    const auto& [at, id, motion] = changes[next_change_];
    if (!motion) {
      gone.push_back(id);
    } else if (id < triangulation_->next_id()) {
      turning.push_back(id);
      motions.push_back(*motion);
    } else {
      coming.push_back(*motion);
    }
  }
  try {
    if (!gone.empty()) triangulation_->erase(gone);
    if (!turning.empty()) triangulation_->set_motions(turning, motions);
    if (!coming.empty()) triangulation_->insert(coming);
  } catch (const Coincident_trajectories_error& error) {
    throw points_->coincidence(error, time);
  }
}

// Executes the events up to `end`. Returns false if the run must end before.
bool Periodic_run::go_to(double end) {
  const Algebraic_number until(end);
  while (may_go_on()) {
    bool is_at_end = true;
    if (settings_.audit == Audit_mode::events) {
      is_at_end = triangulation_->step(until) == 0;
      if (!is_at_end) audit(Audit_level::reference);
    } else {
      triangulation_->advance_to(until, [&] { return is_at_end = may_go_on(); });
    }
    if (!is_at_end) continue;
    triangulation_->advance_to(until);
    return true;
  }
  return false;
}

// Whether another time with events may follow. Throws if a log cannot be written; a closed pipe is
// not an error while there are other outputs.
bool Periodic_run::may_go_on() {
  for (const Output log : {Output::events, Output::motions}) {
    if (outputs_.has(log) && !outputs_.stream(log)) outputs_.finish(log);
  }
  if (interrupted() || number_of_events() > settings_.max_events) return false;
  if (progress_.due()) progress_.show(time(), number_of_events());
  return true;
}

void Periodic_run::audit(Audit_level level) {
  statistics_.seconds.run += stopwatch_.lap();
  audits_.note(triangulation_->audit(level), time(), statistics_, progress_);
  statistics_.seconds.audit += stopwatch_.lap();
}

void Periodic_run::write_outputs() {
  statistics_.triangulation = triangulation_->counters();
  statistics_.certificates = triangulation_->certificate_counters();
  statistics_.queue = triangulation_->queue_counters();
  if (outputs_.has(Output::edges)) {
    write_periodic_edges(outputs_.stream(Output::edges), triangulation_->periodic_edges());
  }
  if (outputs_.has(Output::ids)) points_->write_ids(outputs_.stream(Output::ids));
  if (frames_) frames_->finish();
  if (viewer_) viewer_->write(outputs_.stream(Output::html));
  statistics_.seconds.write += stopwatch_.lap();
  // The statistics come last, since they contain the time of writing the others.
  if (outputs_.has(Output::stats)) {
    statistics_.peak_rss_bytes = peak_rss_bytes();
    write_stats(outputs_.stream(Output::stats), statistics_);
  }
  if (verification_) verification_->finish(*triangulation_);
  outputs_.commit();
}

// Not if a signal has stopped the run: the user does not want to wait.
Exit_code Periodic_run::verify() const {
  if (!verification_ || interrupted()) return Exit_code::done;
  return verification_->run(*triangulation_, points_->verified, periodic_.box_options,
                            outputs_.has_standard_output() ? Stream::error : Stream::output);
}

void Periodic_run::summarize() const {
  Run_summary summary;
  if (statistics_.interrupted) summary.end = ", interrupted";
  summary.remarks = points_->remarks;
  summary.coincident = coincident_;
  summary.paths = outputs_.paths();
  print_summary(summary, statistics_);
}

}  // namespace

Exit_code run_periodic(const Run_settings& settings, const Periodic_settings& periodic) {
  return Periodic_run(settings, periodic).run();
}

}  // namespace kinetri::app
