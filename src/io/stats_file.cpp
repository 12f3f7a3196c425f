// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/io/stats_file.h"

#include <ostream>
#include <string>

#include "counters.h"
#include "kinetri/impl/io/json_writer.h"

namespace kinetri {
namespace {

template <class Counters, std::size_t n>
void write_object(Json_writer& json, const char* key, const Counters& counters,
                  const std::array<Named_counter<Counters>, n>& names) {
  json.key(key);
  json.begin_object();
  write_counters(json, counters, names);
  json.end_object();
}

void write_events(Json_writer& json, const char* key,
                  const std::array<std::uint64_t, event_kinds>& counts) {
  json.key(key);
  json.begin_object();
  for (std::size_t kind = 0; kind < event_kinds; ++kind) {
    json.member(name(static_cast<Event_kind>(kind)), counts[kind]);
  }
  json.end_object();
}

void write_all_counters(Json_writer& json, const Run_statistics& statistics) {
  const Contact_counters& contacts = statistics.contacts;
  Triangulation_counters triangulation = statistics.triangulation;
  triangulation.instants += contacts.instants;
  triangulation.discarded[static_cast<std::size_t>(Event_kind::wall)] = contacts.discarded_walls;
  triangulation.discarded[static_cast<std::size_t>(Event_kind::collision)] =
      contacts.discarded_collisions;
  write_events(json, "events", triangulation.events);
  json.member("events_total", triangulation.number_of_events());
  write_events(json, "events_discarded", triangulation.discarded);
  write_counters(json, triangulation, triangulation_counters);
  json.member("rechecks", triangulation.rechecks);
  write_object(json, "certificates", statistics.certificates, certificate_counters);
  write_object(json, "queue", statistics.queue, queue_counters);
  json.key("contacts");
  json.begin_object();
  write_counters(json, contacts.queue, queue_counters);
  json.member("most_at_one_time", contacts.most_at_one_time);
  json.end_object();
}

void write_seconds(Json_writer& json, const Run_seconds& seconds) {
  json.key("seconds");
  json.begin_object();
  json.member("read", seconds.read);
  json.member("build", seconds.build);
  json.member("initialize", seconds.initialize);
  json.member("run", seconds.run);
  json.member("audit", seconds.audit);
  json.member("write", seconds.write);
  json.end_object();
}

}  // namespace

void write_stats(std::ostream& out, const Run_statistics& statistics) {
  std::string text;
  Json_writer json(text, 2);
  json.begin_object();
  json.member("points", statistics.points);
  json.member("from", statistics.from);
  json.member("until", statistics.until);
  json.member("reached", statistics.reached);
  json.member("interrupted", statistics.interrupted);
  write_all_counters(json, statistics);
  write_seconds(json, statistics.seconds);
  json.member("peak_rss_bytes", statistics.peak_rss_bytes);
  json.key("audits");
  json.begin_object();
  json.member("run", statistics.audits_run);
  json.member("failed", statistics.audits_failed);
  json.end_object();
  json.end_object();
  out << text << '\n';
}

}  // namespace kinetri
