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
  const Contact_counters& contacts = statistics.contacts;
  const Run_seconds& seconds = statistics.seconds;

  Json events = Json::object();
  Json discarded = Json::object();
  std::uint64_t total = 0;
  for (std::size_t kind = 0; kind < event_kinds; ++kind) {
    events[std::string(name(static_cast<Event_kind>(kind)))] = triangulation.events[kind];
    total += triangulation.events[kind];
    discarded[std::string(name(static_cast<Event_kind>(kind)))] = triangulation.discarded[kind];
  }
  discarded["wall"] = contacts.discarded_walls;
  discarded["collision"] = contacts.discarded_collisions;
  const Json document = {
      {"points", statistics.points},
      {"from", statistics.from},
      {"until", statistics.until},
      {"reached", statistics.reached},
      {"interrupted", statistics.interrupted},
      {"events", events},
      {"events_total", total},
      {"events_discarded", discarded},
      {"instants", triangulation.instants + contacts.instants},
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
      {"contacts",
       {{"pushed", contacts.queue.pushed},
        {"discarded", contacts.queue.discarded},
        {"peak", contacts.queue.peak},
        {"most_at_one_time", contacts.most_at_one_time}}},
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
