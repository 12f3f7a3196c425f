// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/stats_file.h"

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

namespace kinetri {

void write_stats(std::ostream& out, const Run_statistics& statistics) {
  using Json = nlohmann::ordered_json;
  const Triangulation_counters& triangulation = statistics.triangulation;
  const Certificate_counters& certificates = statistics.certificates;
  const Queue_counters& queue = statistics.queue;
  const Run_seconds& seconds = statistics.seconds;

  Json events = Json::object();
  std::uint64_t total = 0;
  for (std::size_t kind = 0; kind < event_kinds; ++kind) {
    events[std::string(name(static_cast<Event_kind>(kind)))] = triangulation.events[kind];
    total += triangulation.events[kind];
  }
  const Json document = {
      {"points", statistics.points},
      {"from", statistics.from},
      {"until", statistics.until},
      {"reached", statistics.reached},
      {"interrupted", statistics.interrupted},
      {"events", events},
      {"events_total", total},
      {"instants", triangulation.instants},
      {"largest_instant", triangulation.largest_instant},
      {"batches", triangulation.batches},
      {"flat_hulls", triangulation.flat_hulls},
      {"points_set_aside", triangulation.points_set_aside},
      {"rebuilds", triangulation.rebuilds},
      {"looks_again", triangulation.looks_again},
      {"certificates",
       {{"created", certificates.created},
        {"root_solves", certificates.root_solves},
        {"filter_decided", certificates.filter_decided},
        {"refined_decided", certificates.refined_decided},
        {"exact_decided", certificates.exact_decided}}},
      {"queue", {{"pushed", queue.pushed}, {"discarded", queue.discarded}, {"peak", queue.peak}}},
      {"seconds",
       {{"read", seconds.read},
        {"build", seconds.build},
        {"initialize", seconds.initialize},
        {"run", seconds.run},
        {"audit", seconds.audit},
        {"write", seconds.write}}},
      {"peak_rss_bytes", statistics.peak_rss_bytes},
      {"audits", {{"run", statistics.audits_run}, {"failed", statistics.audits_failed}}},
  };
  out << document.dump(2) << '\n';
}

}  // namespace kinetri
