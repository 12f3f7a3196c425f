// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/run_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string_view>

#include "cli/text.h"
#include "kinetri/algebra/number_types.h"
#include "kinetri/events/event.h"
#include "kinetri/impl/io/text.h"
#include "outputs/gnuplot.h"
#include "outputs/regular_times.h"

namespace kinetri::app {
namespace {

constexpr std::size_t intervals = 200;
constexpr std::size_t intervals_of_a_rate = 4;  // fewer would show noise
// For curves that are not of a kind of event.
constexpr std::string_view plain_color = "#5a6675";
constexpr std::string_view other_color = "#e69f00";

double count(const Run_sample& sample, Event_kind kind) {
  return static_cast<double>(sample.events[static_cast<std::size_t>(kind)]);
}

// The kinds of events that occurred, the most frequent first.
std::vector<Event_kind> kinds_by_count(const Run_sample& sample) {
  std::vector<Event_kind> result;
  for (std::size_t i = 0; i < event_kinds; ++i) {
    if (sample.events[i] > 0) result.push_back(static_cast<Event_kind>(i));
  }
  std::ranges::stable_sort(result, std::greater(),
                           [&](Event_kind kind) { return count(sample, kind); });
  return result;
}

// The name with a blank for each underscore, such as "hull insert": gnuplot would make a subscript.
std::string title(Event_kind kind) {
  std::string result(name(kind));
  std::ranges::replace(result, '_', ' ');
  return result;
}

// The horizontal axis: time, or, if gnuplot could not distinguish such times, the fraction of the
// run.
class Axis {
 public:
  explicit Axis(const std::vector<Run_sample>& samples)
      : from_(samples.front().time), to_(samples.back().time) {
    constexpr double largest = 1e100;
    constexpr double least_share = 1e-6;
    const double size = std::max(std::abs(from_), std::abs(to_));
    is_time_ = size <= largest && to_ - from_ >= 1 / largest && to_ - from_ > least_share * size;
  }

  double of(double time) const {
    if (is_time_) return time;
    if (from_ == to_) return 0;
    const Rational from = to_rational(from_);
    return to_double(100 * (to_rational(time) - from) / (to_rational(to_) - from));
  }
  double lower() const { return of(from_); }
  double upper() const { return is_time_ ? to_ : 100; }
  std::string label() const {
    return is_time_ ? "time" : joined("% of the time from ", from_, " to ", to_);
  }
  std::string_view unit() const { return is_time_ ? "unit of time" : "% of the time"; }

 private:
  double from_;
  double to_;
  bool is_time_ = false;
};

// One panel with curves over time, whose data are named $a0, $a1, ...
class Panel {
 public:
  Panel(std::string_view name, std::string_view label) : name_(name), label_(label) {}

  void begin_curve(std::string_view title, std::string_view color) {
    const std::string block = joined("$", name_, curves_++);
    if (curves_ > 1) data_ += "END\n";
    data_ += block + " << END\n";
    if (curves_ > 1) plot_ += ", ";
    plot_ += joined(block, " with lines lw 2 lc rgb '", color, "' title '", title, "'");
  }
  void add(double x, double y) {
    data_ += joined(x, " ", y, "\n");
    highest_ = std::max(highest_, y);
  }

  // `top` and `bottom` are fractions of the figure's height.
  std::string script(double top, double bottom, bool has_key) const {
    const std::string height = joined("[0:", highest_ > 0 ? 1.06 * highest_ : 1, "]");
    return joined(data_, "END\nset tmargin at screen ", top, "\nset bmargin at screen ", bottom,
                  "\nset ylabel '", label_, "'\nset yrange ", height,
                  "\nset key at screen 0.73, screen ", top, " left top\n",
                  has_key ? "" : "unset key\n", "plot ", plot_, "\n");
  }

 private:
  std::string_view name_;
  std::string label_;
  std::string data_;
  std::string plot_;
  std::size_t curves_ = 0;
  double highest_ = 0;
};

void add_kinds(const std::vector<Run_sample>& samples, const Axis& axis, Panel& total,
               Panel& rate) {
  for (const Event_kind kind : kinds_by_count(samples.back())) {
    total.begin_curve(title(kind), color(kind));
    total.add(axis.lower(), 0);
    for (const Run_sample& sample : samples) {
      total.add(axis.of(sample.time), count(sample, kind));
    }
    rate.begin_curve(title(kind), color(kind));
    for (std::size_t first = 0; first + 1 < samples.size(); first += intervals_of_a_rate) {
      const std::size_t last = std::min(first + intervals_of_a_rate, samples.size() - 1);
      const double from = axis.of(samples[first].time);
      const double to = axis.of(samples[last].time);
      const double height =
          (count(samples[last], kind) - count(samples[first], kind)) / (to - from);
      rate.add(from, height);
      rate.add(to, height);
    }
    if (samples.size() == 1) rate.add(axis.lower(), 0);
  }
}

// gnuplot draws no panel without curves.
void add_zero(const Axis& axis, Panel& panel) {
  panel.begin_curve("no events", plain_color);
  panel.add(axis.lower(), 0);
  panel.add(axis.upper(), 0);
}

// A bar divided like the run time, and its legend, which gnuplot's own key would cut off.
std::string stages(const Run_seconds& seconds, double top, double bottom) {
  struct Stage {
    std::string_view name;
    double seconds;
    std::string_view color;
  };
  const std::array<Stage, 6> all = {{{"read", seconds.read, "#cc79a7"},
                                     {"build", seconds.build, "#009e73"},
                                     {"initialize", seconds.initialize, "#56b4e9"},
                                     {"run", seconds.run, "#0072b2"},
                                     {"audit", seconds.audit, "#d55e00"},
                                     {"write", seconds.write, "#e69f00"}}};
  const double total = seconds.total() > 0 ? seconds.total() : 1;
  constexpr double line = 0.023;
  std::string result;
  double from = 0;
  double y = top;
  for (const Stage& stage : all) {
    const double share = 100 * stage.seconds / total;
    result +=
        joined("set object rectangle from first ", from, ", graph 0 to first ", from + share,
               ", graph 1 fc rgb '", stage.color,
               "' fs solid border lc rgb '#ffffff'\n"
               "set object rectangle from screen 0.743, screen ",
               y - 0.004, " to screen 0.782, screen ", y + 0.004, " fc rgb '", stage.color,
               "' fs solid noborder\nset label '", stage.name, ", ", significant(stage.seconds, 2),
               " s (", fixed(share, 0), " %)' at screen 0.793, screen ", y, "\n");
    from += share;
    y -= line;
  }
  return result + joined("set tmargin at screen ", top, "\nset bmargin at screen ", bottom,
                         "\nunset ytics\nunset grid\nunset ylabel\nunset key\nset border 1\n"
                         "set xrange [0:100]\nset yrange [0:1]\n"
                         "set xlabel 'stages of the run, % of ",
                         significant(seconds.total(), 3), " s'\nplot -1\n");
}

std::string script(const std::vector<Run_sample>& samples, const Run_statistics& statistics) {
  const Axis axis(samples);
  Panel total("total", "events so far");
  Panel rate("rate", joined("events in a ", axis.unit()));
  add_kinds(samples, axis, total, rate);
  const Event_counts& counts = samples.back().events;
  const std::uint64_t events = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  if (events == 0) {
    add_zero(axis, total);
    add_zero(axis, rate);
  }
  Panel queue("queue", "entries in the queues");
  const auto add_queue = [&](std::string_view title, std::string_view color, auto length) {
    queue.begin_curve(title, color);
    for (const Run_sample& s : samples) {
      queue.add(axis.of(s.time), static_cast<double>(s.*length));
    }
  };
  add_queue("triangulation", plain_color, &Run_sample::queue);
  if (std::ranges::any_of(samples, [](const Run_sample& s) { return s.contact_queue > 0; })) {
    add_queue("contacts and changes", other_color, &Run_sample::contact_queue);
  }
  return joined("set multiplot title '", counted(statistics.points, "point"),
                " from t = ", statistics.from, " to ", statistics.reached,
                statistics.interrupted ? ", interrupted" : "", ": ", counted(events, "event"),
                "' font ',17'\nset lmargin at screen 0.1\nset rmargin at screen 0.7\n"
                "set xrange [",
                axis.lower(), ":", axis.upper(), "]\nset format x ''\n") +
         total.script(0.93, 0.71, true) + rate.script(0.67, 0.45, false) +
         joined("set format x '%g'\nset xlabel '", axis.label(), "'\n") +
         queue.script(0.41, 0.25, true) + stages(statistics.seconds, 0.15, 0.11) +
         "unset multiplot\n";
}

Run_sample sample_of(const Any_simulation& simulation, const Event_counts& before) {
  return simulation.visit([&](const auto& s) {
    Run_sample sample;
    sample.time = s.current_time().to_double();
    const Event_counts& events = s.triangulation().counters().events;
    std::ranges::transform(events, before, sample.events.begin(), std::minus());
    sample.queue = s.triangulation().queue_size();
    sample.contact_queue = s.queue_size();
    return sample;
  });
}

}  // namespace

void Run_sampler::start(double until, const Any_simulation& simulation) {
  simulation.visit([&](const auto& s) {
    times_ = evenly_spaced_times(s.current_time().tight_interval().upper, until, intervals);
    events_before_ = s.triangulation().counters().events;
  });
}

std::optional<double> Run_sampler::next_time() const {
  if (next_ == times_.size()) return std::nullopt;
  return times_[next_];
}

void Run_sampler::take(const Any_simulation& simulation) {
  samples_.push_back(sample_of(simulation, events_before_));
  ++next_;
}

// Rounded times are compared, since these are drawn.
void Run_sampler::finish(const Any_simulation& simulation) {
  const Run_sample last = sample_of(simulation, events_before_);
  if (samples_.empty() || samples_.back().time < last.time) samples_.push_back(last);
}

std::string draw_run(const std::vector<Run_sample>& samples, const Run_statistics& statistics) {
  constexpr int width = 960;
  constexpr int height = 940;
  return draw_svg(script(samples, statistics), width, height);
}

}  // namespace kinetri::app
