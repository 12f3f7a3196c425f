// SPDX-License-Identifier: GPL-3.0-or-later
#include "runs/simulation_run.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <initializer_list>
#include <memory>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "cli/arguments.h"
#include "cli/interrupt.h"
#include "io/stats_file.h"
#include "kinetri/io/checkpoint_file.h"
#include "kinetri/io/edges_file.h"
#include "kinetri/io/event_log.h"
#include "kinetri/simulation/closest_approaches.h"
#include "kinetri/simulation/simulation_2.h"
#include "outputs/run_outputs.h"
#include "outputs/run_plot.h"
#include "outputs/viewer_output.h"

namespace kinetri::app {
namespace {

// Seconds since the last lap.
class Stopwatch {
 public:
  double lap() {
    const Clock::time_point now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

std::uint64_t peak_rss_bytes() {
  rusage usage = {};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#ifdef __APPLE__
  constexpr std::uint64_t unit = 1;
#else
  constexpr std::uint64_t unit = 1024;
#endif
  return static_cast<std::uint64_t>(usage.ru_maxrss) * unit;
}

class Simulation_run {
 public:
  Simulation_run(const Run_settings& settings, Run_source& source)
      : settings_(settings),
        source_(source),
        outputs_(settings, source.path()),
        progress_(settings.progress) {
    if (outputs_.frames != nullptr || outputs_.vtu != nullptr) {
      frames_.emplace(outputs_.frames, outputs_.vtu, settings.frames.rate);
    }
    if (outputs_.plot != nullptr) sampler_ = std::make_unique<Run_sampler>();
  }

  Exit_code run();

 private:
  void build();
  // What `function` says of the simulation, whichever it is.
  template <class Function>
  auto with_simulation(Function function) const {
    return std::visit([&](const auto& simulation) { return function(*simulation); }, simulation_);
  }
  std::vector<Edge_ids> edges() const {
    return with_simulation([](const auto& s) { return s.triangulation().finite_edge_ids(); });
  }
  std::uint64_t number_of_events() const {
    return with_simulation(
        [](const auto& s) { return s.triangulation().counters().number_of_events(); });
  }
  double time() const {
    return with_simulation([](const auto& s) { return s.current_time().to_double(); });
  }
  void advance();
  bool go_to(double end);
  std::optional<double> next_stop() const;
  void stop_at(double time);
  std::size_t step(const Algebraic_number& until);
  void audit(Audit_level level);
  void write_outputs();
  void write_approaches(std::ostream& out);
  void summarize() const;

  const Run_settings& settings_;
  Run_source& source_;
  Run_outputs outputs_;
  Progress progress_;
  Stopwatch stopwatch_;
  Run_statistics statistics_;
  std::optional<Event_log_writer> log_;
  Any_simulation simulation_;
  std::optional<Viewer_output> viewer_;
  std::optional<Closest_approaches> closest_;
  std::optional<Frame_outputs> frames_;
  std::unique_ptr<Run_sampler> sampler_;
  std::uint64_t events_before_ = 0;  // of the run that this one takes up
  std::size_t failures_ = 0;
};

Exit_code Simulation_run::run() {
  build();
  stop_gracefully_from_now_on();
  progress_.show_stage("running");
  if (settings_.audit == Audit_mode::events) audit(Audit_level::certificates);
  advance();
  if (settings_.audit != Audit_mode::none && !statistics_.interrupted) {
    progress_.show_stage("auditing");
    audit(Audit_level::certificates);
  }
  progress_.show_stage("writing");
  write_outputs();
  progress_.clear();
  if (!settings_.quiet) summarize();
  if (statistics_.audits_failed > 0) {
    fmt::print(
        stderr,
        "kinetri: {} of {} audits failed; please report this with the input that caused it\n",
        statistics_.audits_failed, statistics_.audits_run);
    return Exit_code::audit_failed;
  }
  return statistics_.interrupted ? Exit_code::interrupted : Exit_code::done;
}

// Reads the input and makes the first triangulation.
void Simulation_run::build() {
  progress_.show_stage("reading");
  source_.read();
  statistics_.points = source_.number_of_points();
  statistics_.from = source_.from();
  statistics_.until = source_.until();
  progress_.set_range(source_.from(), source_.until());
  progress_.show_stage(fmt::format("triangulating {} points", statistics_.points));
  statistics_.seconds.read = stopwatch_.lap();
  simulation_ = source_.make_simulation(settings_.arithmetic);
  events_before_ = number_of_events();
  const Construction_seconds construction =
      with_simulation([](const auto& s) { return s.triangulation().construction_seconds(); });
  statistics_.seconds.initialize = construction.initialize;
  statistics_.seconds.build = stopwatch_.lap() - construction.initialize;
  if (outputs_.initial_edges != nullptr) {
    write_edges(outputs_.initial_edges->stream(), edges());
  }
  if (outputs_.events != nullptr) {
    log_.emplace(outputs_.events->stream());
    with_simulation([this](auto& s) { s.add_observer(*log_); });
  }
  if (outputs_.html != nullptr) viewer_.emplace(simulation_, source_);
  // Asked for with recorded tracks only, which are linear.
  if (settings_.closest > 0) closest_.emplace(*std::get<0>(simulation_), settings_.closest);
  if (frames_) frames_->start(source_, simulation_);
  if (sampler_) sampler_->start(source_.until(), simulation_);
  statistics_.seconds.write += stopwatch_.lap();
}

std::size_t Simulation_run::step(const Algebraic_number& until) {
  try {
    return with_simulation([&](auto& s) { return s.step(until); });
  } catch (const Coincident_trajectories_error& error) {
    throw source_.coincidence(error, time());
  }
}

// The next time at which there is something to write or to count, none after the last.
std::optional<double> Simulation_run::next_stop() const {
  const auto frame = frames_ ? frames_->next_time() : std::nullopt;
  const auto sample = sampler_ ? sampler_->next_time() : std::nullopt;
  if (!frame || !sample) return frame ? frame : sample;
  return std::min(*frame, *sample);
}

void Simulation_run::stop_at(double time) {
  statistics_.seconds.run += stopwatch_.lap();
  if (frames_ && frames_->next_time() == time) frames_->write(simulation_);
  if (sampler_ && sampler_->next_time() == time) sampler_->take(simulation_);
  statistics_.seconds.write += stopwatch_.lap();
}

// Executes the events, up to the end or an interruption.
void Simulation_run::advance() {
  for (auto stop = next_stop(); stop && go_to(*stop); stop = next_stop()) stop_at(*stop);
  statistics_.interrupted = !go_to(source_.until());
  statistics_.reached = time();
  statistics_.seconds.run += stopwatch_.lap();
}

// Executes the events up to `end`. Whether it got there before an interruption.
bool Simulation_run::go_to(double end) {
  const Algebraic_number until(end);
  while (!interrupted() && step(until) > 0) {
    if (outputs_.events != nullptr && !outputs_.events->stream()) outputs_.events->finish();
    if (progress_.due()) progress_.show(time(), number_of_events());
    // Recomputing all certificates exactly is left to the audits at the two ends: it would take
    // nearly all the time of the run.
    if (settings_.audit == Audit_mode::events) audit(Audit_level::reference);
  }
  if (interrupted()) return false;
  with_simulation([&](auto& s) { s.advance_to(until); });
  return true;
}

void Simulation_run::audit(Audit_level level) {
  constexpr std::size_t most_messages = 100;
  statistics_.seconds.run += stopwatch_.lap();
  const Audit_report report = with_simulation([&](const auto& s) { return s.audit(level); });
  ++statistics_.audits_run;
  if (!report.passed()) {
    ++statistics_.audits_failed;
    progress_.clear();
  }
  for (const std::string& failure : report.failures) {
    ++failures_;
    if (failures_ > most_messages) break;
    fmt::print(stderr, "kinetri: audit just after t = {}: {}\n", time(), failure);
    if (failures_ == most_messages) {
      fmt::print(stderr, "kinetri: further failures of audits are counted, not shown\n");
    }
  }
  statistics_.seconds.audit += stopwatch_.lap();
}

void Simulation_run::write_approaches(std::ostream& out) {
  out << "id_a,id_b,time,time_lo,time_hi,distance\n";
  for (const Approach& approach : closest_->approaches()) {
    const Double_interval time = approach.time.tight_interval();
    out << fmt::format("{},{},{},{},{},{}\n", source_.name(approach.points[0]),
                       source_.name(approach.points[1]), approach.time.to_double(), time.lower,
                       time.upper, approach.distance);
  }
}

void Simulation_run::write_outputs() {
  if (outputs_.edges != nullptr) {
    write_edges(outputs_.edges->stream(), edges());
  }
  if (outputs_.points != nullptr) source_.write_points(outputs_.points->stream());
  if (outputs_.checkpoint != nullptr) {
    with_simulation([&](const auto& s) {
      write_checkpoint(outputs_.checkpoint->stream(), {s.snapshot(), source_.response()});
    });
  }
  if (viewer_) viewer_->write(outputs_.html->stream());
  if (outputs_.closest != nullptr) write_approaches(outputs_.closest->stream());
  if (frames_) frames_->finish();
  with_simulation([&](const auto& s) {
    statistics_.triangulation = s.triangulation().counters();
    statistics_.certificates = s.certificate_counters();
    statistics_.queue = s.triangulation().queue_counters();
    statistics_.contacts = s.contact_counters();
  });
  statistics_.seconds.write += stopwatch_.lap();
  if (sampler_) {
    sampler_->finish(simulation_);
    outputs_.plot->stream() << draw_run(sampler_->samples(), statistics_);
  }
  statistics_.peak_rss_bytes = peak_rss_bytes();
  if (outputs_.stats != nullptr) write_stats(outputs_.stats->stream(), statistics_);
  outputs_.commit();
}

std::string events_per_kind(const Triangulation_counters& counters) {
  std::string result;
  for (std::size_t kind = 0; kind < event_kinds; ++kind) {
    if (counters.events[kind] == 0) continue;
    if (!result.empty()) result += ", ";
    result += fmt::format("{} {}", counters.events[kind], name(static_cast<Event_kind>(kind)));
  }
  return result.empty() ? "none" : result;
}

std::string stage_shares(const Run_seconds& seconds) {
  const std::initializer_list<std::pair<std::string_view, double>> stages = {
      {"read", seconds.read}, {"build", seconds.build}, {"initialize", seconds.initialize},
      {"run", seconds.run},   {"audit", seconds.audit}, {"write", seconds.write}};
  std::string result;
  for (const auto& [stage, time] : stages) {
    const double share = seconds.total() > 0 ? 100 * time / seconds.total() : 0;
    if (share < 0.5) continue;
    if (!result.empty()) result += ", ";
    result += fmt::format("{} {:.0f} %", stage, share);
  }
  return result;
}

void Simulation_run::summarize() const {
  const Run_statistics& s = statistics_;
  const auto events = s.triangulation.number_of_events();
  const auto executed = static_cast<double>(events - events_before_);
  const double rate = s.seconds.run > 0 ? executed / s.seconds.run : 0;
  const auto print = [](std::string_view label, const std::string& text) {
    fmt::print(stderr, "  {:<13}{}\n", label, text);
  };
  fmt::print(stderr, "kinetri: {} points from t = {} to {}{}\n", s.points, s.from, s.reached,
             s.interrupted ? ", interrupted" : "");
  for (const std::string& remark : source_.remarks()) print("input", remark);
  print("events", fmt::format("{} at {} instants ({})", events,
                              s.triangulation.instants + s.contacts.instants,
                              events_per_kind(s.triangulation)));
  print("time", fmt::format("{:.3g} s ({}), {:.0f} events/s", s.seconds.total(),
                            stage_shares(s.seconds), rate));
  print("certificates",
        fmt::format("{} made, {} solved for roots; {} decided by the filter, {} exactly",
                    s.certificates.created, s.certificates.root_solves,
                    s.certificates.filter_decided, s.certificates.exact_decided));
  print("queue", fmt::format("{} pushed, {} discarded, at most {} at a time", s.queue.pushed,
                             s.queue.discarded, s.queue.peak));
  if (s.audits_run > 0) {
    print("audits", fmt::format("{} run, {} failed", s.audits_run, s.audits_failed));
  }
  const std::vector<std::string> paths = outputs_.paths();
  if (!paths.empty()) print("written", fmt::format("{}", fmt::join(paths, ", ")));
}

}  // namespace

Exit_code run_simulation(const Run_settings& settings, Run_source& source) {
  return Simulation_run(settings, source).run();
}

}  // namespace kinetri::app
