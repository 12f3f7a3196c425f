// SPDX-License-Identifier: GPL-3.0-or-later
//
// The statistics as JSON: outside programs look for these keys.
#include "kinetri/impl/io/stats_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace kinetri::stats_file_test {
namespace {

using Json = nlohmann::ordered_json;

Json written(const Run_statistics& statistics) {
  std::ostringstream out;
  write_stats(out, statistics);
  return Json::parse(out.str());
}

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> result;
  for (const auto& item : object.items()) result.push_back(item.key());
  return result;
}

TEST(Write_stats, each_number_stands_under_its_key) {
  Run_statistics statistics;
  statistics.points = 100;
  statistics.from = -1;
  statistics.until = 0.1;
  statistics.reached = 0.05;
  statistics.interrupted = true;
  statistics.triangulation.instants = 20;
  statistics.triangulation.largest_instant = 3;
  statistics.triangulation.batches = 15;
  statistics.triangulation.flat_hulls = 16;
  statistics.triangulation.points_set_aside = 17;
  statistics.triangulation.reconstructions = 1;
  statistics.triangulation.rechecks = 14;
  for (std::size_t kind = 0; kind < event_kinds; ++kind) {
    statistics.triangulation.events[kind] = std::uint64_t{1} << kind;
    statistics.triangulation.discarded[kind] = std::uint64_t{3} << kind;
  }
  statistics.certificates = {.created = 5,
                             .root_solves = 6,
                             .filter_decided = 7,
                             .refined_decided = 18,
                             .exact_decided = 8};
  statistics.queue = {.pushed = 9, .discarded = 10, .peak = 11};
  statistics.contacts = {.queue = {.pushed = 21, .discarded = 22, .peak = 23},
                         .discarded_walls = 24,
                         .discarded_collisions = 25,
                         .instants = 26,
                         .most_at_one_time = 27};
  statistics.seconds = {
      .read = 0.25, .build = 0.5, .initialize = 1, .run = 2, .audit = 4, .write = 8};
  statistics.peak_rss_bytes = std::uint64_t{1} << 40U;
  statistics.audits_run = 12;
  statistics.audits_failed = 13;

  EXPECT_EQ(written(statistics), Json::parse(R"({
    "points": 100, "from": -1.0, "until": 0.1, "reached": 0.05, "interrupted": true,
    "events": {"rebuild": 1, "hull_insert": 2, "hull_remove": 4, "flip": 8, "hide": 16,
               "reveal": 32, "wall": 64, "collision": 128, "insert": 256, "erase": 512,
               "trajectory": 1024},
    "events_total": 2047,
    "events_discarded": {"rebuild": 3, "hull_insert": 6, "hull_remove": 12, "flip": 24,
                         "hide": 48, "reveal": 96, "wall": 24, "collision": 25,
                         "insert": 768, "erase": 1536, "trajectory": 3072},
    "instants": 46, "largest_instant": 3, "batches": 15, "flat_hulls": 16,
    "points_set_aside": 17, "reconstructions": 1, "rechecks": 14,
    "certificates": {"created": 5, "root_solves": 6, "filter_decided": 7,
                     "refined_decided": 18, "exact_decided": 8},
    "queue": {"pushed": 9, "discarded": 10, "peak": 11},
    "contacts": {"pushed": 21, "discarded": 22, "peak": 23, "most_at_one_time": 27},
    "seconds": {"read": 0.25, "build": 0.5, "initialize": 1.0, "run": 2.0, "audit": 4.0,
                "write": 8.0},
    "peak_rss_bytes": 1099511627776,
    "audits": {"run": 12, "failed": 13}})"));
  EXPECT_EQ(statistics.seconds.total(), 15.75);
}

TEST(Write_stats, keys_are_always_there_in_one_order) {
  const Json document = written({});
  EXPECT_EQ(keys(document), (std::vector<std::string>{"points",
                                                      "from",
                                                      "until",
                                                      "reached",
                                                      "interrupted",
                                                      "events",
                                                      "events_total",
                                                      "events_discarded",
                                                      "instants",
                                                      "largest_instant",
                                                      "batches",
                                                      "flat_hulls",
                                                      "points_set_aside",
                                                      "reconstructions",
                                                      "rechecks",
                                                      "certificates",
                                                      "queue",
                                                      "contacts",
                                                      "seconds",
                                                      "peak_rss_bytes",
                                                      "audits"}));
  ASSERT_EQ(document["events"].size(), event_kinds);
  std::size_t kind = 0;
  for (const std::string& key : keys(document["events"])) {
    EXPECT_EQ(key, name(static_cast<Event_kind>(kind++)));
  }
}

}  // namespace
}  // namespace kinetri::stats_file_test
