// SPDX-License-Identifier: GPL-3.0-or-later
#include "runs/experiment_run.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "cli/interrupt.h"
#include "cli/terminal.h"
#include "cli/text.h"
#include "cli/worker_threads.h"
#include "kinetri/events/event.h"
#include "kinetri/impl/io/output_file.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/impl/simulation/experiment.h"
#include "outputs/gnuplot.h"

namespace kinetri::app {
namespace {

constexpr std::array<int, 11> percentages = {0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100};

// The time steps of the comparison, as fractions of the duration.
constexpr std::array<double, 8> steps = {0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005};

struct Run {
  int percentage;
  std::uint64_t seed;
  Experiment_result result;
};

struct Comparison {
  std::uint64_t seed;
  Discrete_comparison result;
};

std::uint64_t executed(const Run& run, std::initializer_list<Event_kind> kinds) {
  std::uint64_t sum = 0;
  for (const Event_kind kind : kinds) {
    sum += run.result.events.events[static_cast<std::size_t>(kind)];
  }
  return sum;
}

std::uint64_t discarded(const Run& run, std::initializer_list<Event_kind> kinds) {
  std::uint64_t sum = 0;
  for (const Event_kind kind : kinds) {
    sum += kind == Event_kind::wall ? run.result.contacts.discarded_walls
           : kind == Event_kind::collision
               ? run.result.contacts.discarded_collisions
               : run.result.events.discarded[static_cast<std::size_t>(kind)];
  }
  return sum;
}

// Statistics over the seeds at one abscissa.
struct Spread {
  double least = 0;
  double median = 0;
  double greatest = 0;
};

Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  const double median =
      values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
  return {values.front(), median, values.back()};
}

class Experiments {
 public:
  explicit Experiments(const Experiment_plan& plan)
      : plan_(plan), setting_(experiment_setting(plan.run)), progress_(plan.progress) {}

  Exit_code run();

 private:
  using Content = std::function<void(std::ostream&)>;
  using Files = std::vector<Output_file>;

  void measure();
  void compare();
  void write() const;
  void add_file(Files& files, const std::string& name, const Content& content) const;
  void write_runs(std::ostream& out) const;
  void write_comparisons(std::ostream& out) const;
  void add_plot(Files& files, const std::string& name, const std::string& script, int width) const;
  std::string title() const;
  std::string run_time_plot() const;
  std::string events_plot() const;
  std::string comparison_plot() const;
  void summarize() const;

  template <class Value>
  Spread over_seeds(int percentage, Value value) const;
  template <class Value>
  Spread over_seeds(double step, Value value) const;

  const Experiment_plan& plan_;
  Experiment_setting setting_;  // except for movers and seed
  Progress progress_;
  std::vector<Run> runs_;
  std::vector<Comparison> comparisons_;
  bool is_interrupted_ = false;
};

Exit_code Experiments::run() {
  std::error_code failure;
  std::filesystem::create_directories(plan_.directory, failure);
  if (failure) {
    throw Output_error(joined(plan_.directory, ": the directory cannot be made: ",
                              failure.message(), "; expected a path where that is possible"));
  }
  const Worker_threads workers(0);
  stop_gracefully_from_now_on();
  measure();
  if (plan_.compares) compare();
  is_interrupted_ = interrupted();
  complete_outputs_from_now_on();
  progress_.show_stage("writing");
  write();
  progress_.clear();
  if (!plan_.quiet) summarize();
  return is_interrupted_ ? Exit_code::interrupted : Exit_code::done;
}

void Experiments::measure() {
  Experiment_setting setting = setting_;
  setting.movers = setting.points;
  run_experiment(setting);  // warms up
  // The seed in the outer loop, so that a slow phase of the machine does not affect one percentage
  // alone.
  for (setting.seed = 1; setting.seed <= plan_.seeds; ++setting.seed) {
    for (const int percentage : percentages) {
      if (interrupted()) return;
      progress_.show_stage(
          joined("seed ", setting.seed, " of ", plan_.seeds, ", ", percentage, " % moving"));
      setting.movers = setting.points * static_cast<std::size_t>(percentage) / 100;
      runs_.push_back({percentage, setting.seed, run_experiment(setting)});
    }
  }
}

void Experiments::compare() {
  std::vector<double> times;
  for (const double step : steps) times.push_back(step * setting_.duration);
  Experiment_setting setting = setting_;
  setting.movers = setting.points;
  for (setting.seed = 1; setting.seed <= plan_.seeds; ++setting.seed) {
    if (interrupted()) return;
    progress_.show_stage(joined("discrete approach, seed ", setting.seed, " of ", plan_.seeds));
    for (const auto& result : compare_with_discrete_steps(setting, times)) {
      comparisons_.push_back({setting.seed, result});
    }
  }
}

template <class Value>
Spread Experiments::over_seeds(int percentage, Value value) const {
  std::vector<double> values;
  for (const Run& run : runs_) {
    if (run.percentage == percentage) values.push_back(static_cast<double>(value(run)));
  }
  return spread(std::move(values));
}

template <class Value>
Spread Experiments::over_seeds(double step, Value value) const {
  std::vector<double> values;
  for (const Comparison& comparison : comparisons_) {
    if (comparison.result.step == step) values.push_back(value(comparison.result));
  }
  return spread(std::move(values));
}

// ---- files ----

void Experiments::add_file(Files& files, const std::string& name, const Content& content) const {
  Output_file& file = files.emplace_back((std::filesystem::path(plan_.directory) / name).string());
  content(file.stream());
  file.finish();
}

void Experiments::write() const {
  Files files;
  add_file(files, "experiment.csv", [&](std::ostream& out) { write_runs(out); });
  if (plan_.compares) {
    add_file(files, "comparison.csv", [&](std::ostream& out) { write_comparisons(out); });
  }
  if (plan_.plots && !runs_.empty()) {
    add_plot(files, "runtime", run_time_plot(), 720);
    add_plot(files, "events", events_plot(), 1100);
    if (!comparisons_.empty()) add_plot(files, "comparison", comparison_plot(), 1100);
  }
  const Commit_section uninterrupted;
  for (Output_file& file : files) file.commit();
}

void Experiments::write_runs(std::ostream& out) const {
  // The kinds that can occur: no point is inserted or erased, and equal discs are hidden only if
  // they coincide, which random ones do not.
  std::vector<Event_kind> kinds = {Event_kind::rebuild,     Event_kind::hull_insert,
                                   Event_kind::hull_remove, Event_kind::flip,
                                   Event_kind::wall,        Event_kind::collision};
  if (setting_.has_sizes()) kinds.insert(kinds.end(), {Event_kind::hide, Event_kind::reveal});
  out << "movers_percent,seed,points,seconds";
  for (const Event_kind kind : kinds) {
    const std::string_view text = name(kind);
    out << ',' << text << ",discarded_" << text;
  }
  out << ",certificates,root_solves,exact_decided\n";
  for (const Run& run : runs_) {
    out << joined(run.percentage, ",", run.seed, ",", setting_.points, ",", run.result.seconds);
    for (const Event_kind kind : kinds) {
      out << ',' << executed(run, {kind}) << ',' << discarded(run, {kind});
    }
    const Certificate_counters& certificates = run.result.certificates;
    out << joined(",", certificates.created, ",", certificates.root_solves, ",",
                  certificates.exact_decided, "\n");
  }
}

void Experiments::write_comparisons(std::ostream& out) const {
  out << "step,seed,points,seconds,kinetic_seconds,topologic_events,edge_changes,"
         "edge_changes_missed,contacts,contacts_missed\n";
  for (const auto& [seed, c] : comparisons_) {
    out << joined(c.step, ",", seed, ",", setting_.points, ",", c.seconds, ",", c.kinetic_seconds,
                  ",", c.topologic_events, ",", c.edge_changes, ",", c.edge_changes_missed, ",",
                  c.contacts, ",", c.contacts_missed, "\n");
  }
}

// ---- plots ----

void Experiments::add_plot(Files& files, const std::string& name, const std::string& script,
                           int width) const {
  constexpr int height = 460;
  const Plot drawn = draw(script, width, height);
  add_file(files, name + ".svg", [&](std::ostream& out) { out << drawn.svg; });
  add_file(files, name + ".png", [&](std::ostream& out) { out << drawn.png; });
}

std::string data_row(double x, const Spread& s) {
  return joined(x, " ", s.median, " ", s.least, " ", s.greatest, "\n");
}

// Median with the spread over seeds; without a color it has that of the line style.
std::string curve(std::string_view block, std::string_view title, int style, bool dashed,
                  std::string_view color = {}) {
  const std::string look =
      color.empty() ? joined("ls ", style) : joined("ls ", style, " lc rgb '", color, "'");
  return joined("$", block, " using 1:2:3:4 with yerrorbars ", look, " lw 1 pt 0 notitle, $", block,
                " using 1:2 with linespoints ", look, dashed ? " dt 2" : "", " title '", title,
                "'");
}

std::string Experiments::title() const {
  return joined(counted(setting_.points, "point"), ", ", setting_.duration,
                " units of time: median and range of ", counted(plan_.seeds, "seed"));
}

std::string Experiments::run_time_plot() const {
  std::string script = "$time << END\n";
  for (const int percentage : percentages) {
    script +=
        data_row(percentage,
                 over_seeds(percentage, [](const Run& run) { return 1000 * run.result.seconds; }));
  }
  return script + joined("END\nset title '", title(),
                         "'\nset xlabel 'moving points (%)'\nset ylabel 'run time (ms)'\n"
                         "set yrange [0:*]\nset xrange [-2:102]\nunset key\nplot ",
                         curve("time", "run time", 1, false), "\n");
}

std::string Experiments::events_plot() const {
  struct Kinds {
    const char* name;
    std::initializer_list<Event_kind> kinds;
  };
  const std::array<Kinds, 4> curves_of = {
      {{"flips", {Event_kind::flip}},
       {"hull events", {Event_kind::hull_insert, Event_kind::hull_remove}},
       {"walls", {Event_kind::wall}},
       {"collisions", {Event_kind::collision}}}};
  std::string script;
  std::array<std::string, 2> curves;  // of flips, and of the others, which are fewer
  int style = 0;
  for (const Kinds& group : curves_of) {
    ++style;
    const auto add = [&](std::string_view fate, bool dashed, const auto& count) {
      const std::string block = joined(fate, style);
      script += joined("$", block, " << END\n");
      for (const int percentage : percentages) {
        script += data_row(percentage, over_seeds(percentage, count));
      }
      script += "END\n";
      std::string& panel = curves[style == 1 ? 0 : 1];
      if (!panel.empty()) panel += ", ";
      panel +=
          curve(block, joined(group.name, ", ", fate), style, dashed, color(*group.kinds.begin()));
    };
    add("executed", false, [&group](const Run& run) { return executed(run, group.kinds); });
    add("discarded", true, [&group](const Run& run) { return discarded(run, group.kinds); });
  }
  return script +
         joined("set multiplot layout 1,2 title '", title(),
                "'\nset xlabel 'moving points (%)'\nset ylabel 'events'\nset yrange [0:*]\n"
                "set xrange [-2:102]\nset key inside left top\nplot ",
                curves[0], "\nplot ", curves[1], "\nunset multiplot\n");
}

std::string Experiments::comparison_plot() const {
  std::string edges = "$edges << END\n";
  std::string contacts = "END\n$contacts << END\n";
  std::string seconds = "END\n$discrete << END\n";
  std::string kinetic = "END\n$kinetic << END\n";
  const auto share = [](std::uint64_t part, std::uint64_t all) {
    return all == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(all);
  };
  for (const double relative : steps) {
    const double step = relative * setting_.duration;
    edges += data_row(step, over_seeds(step, [&](const Discrete_comparison& c) {
                        return share(c.edge_changes_missed, c.edge_changes);
                      }));
    contacts += data_row(step, over_seeds(step, [&](const Discrete_comparison& c) {
                           return share(c.contacts_missed, c.contacts);
                         }));
    seconds += data_row(
        step, over_seeds(step, [](const Discrete_comparison& c) { return 1000 * c.seconds; }));
    kinetic += data_row(step, over_seeds(step, [](const Discrete_comparison& c) {
                          return 1000 * c.kinetic_seconds;
                        }));
  }
  return edges + contacts + seconds + kinetic +
         joined("END\nset multiplot layout 1,2 title '", setting_.points,
                " moving points: the discrete approach, median and range of ",
                counted(plan_.seeds, "seed"),
                "'\nset logscale x\nset xlabel 'time step (units of time)'\n"
                "set key inside left top\nset ylabel 'missed (%)'\nset yrange [0:100]\nplot ",
                curve("edges", "edge changes", 1, false), ", ",
                curve("contacts", "contacts of discs", 2, false),
                "\nset logscale y\nset yrange [*:*]\nset ylabel 'run time (ms)'\n"
                "set key inside right top\nplot ",
                curve("discrete", "discrete", 1, false), ", ",
                curve("kinetic", "kinetic", 3, false), "\nunset multiplot\n");
}

// ---- summary ----

void Experiments::summarize() const {
  print_error(joined(heading("kinetri experiment:", Stream::error), " ",
                     counted(setting_.points, "point"), ", ", counted(runs_.size(), "run"),
                     is_interrupted_ ? ", interrupted" : "", "\n"));
  print_error(heading("  moving   run time    events   discarded", Stream::error) + "\n");
  for (const int percentage : {0, 50, 100}) {
    const Spread time = over_seeds(percentage, [](const Run& run) { return run.result.seconds; });
    const Spread events =
        over_seeds(percentage, [](const Run& run) { return run.result.events.number_of_events(); });
    const Spread lost = over_seeds(percentage, [](const Run& run) {
      return discarded(run, {Event_kind::rebuild, Event_kind::hull_insert, Event_kind::hull_remove,
                             Event_kind::flip, Event_kind::wall, Event_kind::collision});
    });
    const auto column = [](double number, int decimals, std::size_t width) {
      return right_aligned(fixed(number, decimals), width);
    };
    print_error(joined("  ", column(percentage, 0, 4), " %  ", column(1000 * time.median, 1, 6),
                       " ms  ", column(events.median, 0, 8), "   ", column(lost.median, 0, 8),
                       "\n"));
  }
  for (const double relative : {steps.front(), steps.back()}) {
    const double step = relative * setting_.duration;
    if (comparisons_.empty()) break;
    const auto missed = [&](auto part, auto all) {
      return over_seeds(step,
                        [&](const Discrete_comparison& c) {
                          return c.*all == 0 ? 0
                                             : 100 * static_cast<double>(c.*part) /
                                                   static_cast<double>(c.*all);
                        })
          .median;
    };
    const double edges =
        missed(&Discrete_comparison::edge_changes_missed, &Discrete_comparison::edge_changes);
    const double contacts =
        missed(&Discrete_comparison::contacts_missed, &Discrete_comparison::contacts);
    print_error(joined("  steps of ", step, ": ", fixed(edges, 0), " % of edge changes and ",
                       fixed(contacts, 0), " % of contacts missed\n"));
  }
  print_error(joined("  ", heading("written", Stream::error), "      ", plan_.directory, "\n"));
}

}  // namespace

Exit_code run_experiments(const Experiment_plan& plan) {
  try {
    return Experiments(plan).run();
  } catch (const Contact_error& error) {
    throw Run_error(error.what());
  }
}

}  // namespace kinetri::app
