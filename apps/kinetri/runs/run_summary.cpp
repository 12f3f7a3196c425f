// SPDX-License-Identifier: GPL-3.0-or-later
#include "runs/run_summary.h"

#include <sys/resource.h>

#include <initializer_list>
#include <string_view>

#include "cli/terminal.h"
#include "cli/text.h"
#include "kinetri/impl/io/text.h"

namespace kinetri::app {
namespace {

std::string events_per_kind(const Triangulation_counters& counters) {
  std::string result;
  for (std::size_t kind = 0; kind < event_kinds; ++kind) {
    if (counters.events[kind] == 0) continue;
    if (!result.empty()) result += ", ";
    result += joined(counters.events[kind], " ", name(static_cast<Event_kind>(kind)));
  }
  return result;
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
    result += joined(stage, " ", fixed(share, 0), " %");
  }
  return result;
}

// "5 at 4 instants (3 flip, 2 wall)".
std::string events_summary(const Run_statistics& statistics) {
  const std::uint64_t events = statistics.triangulation.number_of_events();
  if (events == 0) return "none";
  return joined(
      events, " at ",
      counted(statistics.triangulation.instants + statistics.contacts.instants, "instant"), " (",
      events_per_kind(statistics.triangulation), ")");
}

}  // namespace

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

void Audits::note(const Audit_report& audited, double time, Run_statistics& statistics,
                  Progress& progress) {
  constexpr std::size_t most_messages = 100;
  ++statistics.audits_run;
  if (!audited.passed()) {
    ++statistics.audits_failed;
    progress.clear();
  }
  for (const std::string& failure : audited.failures) {
    ++failures_;
    if (failures_ > most_messages) break;
    report("kinetri", joined("audit just after t = ", time, ": ", failure));
    if (failures_ == most_messages) {
      report("kinetri", "further failures of audits are counted, not shown");
    }
  }
}

void report_failed_audits(const Run_statistics& statistics) {
  report("kinetri", joined(statistics.audits_failed, " of ", statistics.audits_run,
                           " audits failed; please report this with the input that caused it"));
}

void print_summary(const Run_summary& summary, const Run_statistics& s) {
  const auto executed =
      static_cast<double>(s.triangulation.number_of_events() - summary.events_before);
  const double rate = s.seconds.run > 0 ? executed / s.seconds.run : 0;
  const auto print = [](std::string_view label, const std::string& text) {
    constexpr std::size_t width = 13;
    const std::string blanks(width - label.size(), ' ');
    print_error(joined("  ", heading(label, Stream::error), blanks, text, "\n"));
  };
  print_error(joined(heading("kinetri:", Stream::error), " ", counted(s.points, "point"),
                     " from t = ", s.from, " to ", s.reached, summary.end, "\n"));
  for (const std::string& remark : summary.remarks) print("input", remark);
  if (!summary.coincident.empty()) print("coincident", summary.coincident);
  print("events", events_summary(s));
  if (summary.covered_share) {
    print("discs", joined("cover ", significant(*summary.covered_share, 6), " of the box"));
  }
  print("time", joined(significant(s.seconds.total(), 3), " s (", stage_shares(s.seconds), "), ",
                       fixed(rate, 0), " events/s"));
  print("certificates",
        joined(s.certificates.created, " made, ", s.certificates.root_solves, " solved for roots; ",
               s.certificates.filter_decided, " decided by the filter, ",
               s.certificates.exact_decided, " exactly"));
  print("queue", joined(s.queue.pushed, " pushed, ", s.queue.discarded, " discarded, at most ",
                        s.queue.peak, " at a time"));
  if (s.audits_run > 0) {
    print("audits", joined(s.audits_run, " run, ", s.audits_failed, " failed"));
  }
  if (!summary.paths.empty()) print("written", separated(summary.paths, ", "));
}

}  // namespace kinetri::app
