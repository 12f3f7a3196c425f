// SPDX-License-Identifier: GPL-3.0-or-later
//
// A page that is read back: it makes the same page again, and its recording, played, shows what the
// run had. Damaged pages are refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/bytes.h"
#include "kinetri/impl/simulation/playback.h"
#include "kinetri/io/viewer_page.h"
#include "kinetri/simulation/simulation_2.h"
#include "kinetri/simulation/tracks.h"
#include "support/disc_runs.h"
#include "support/motions.h"
#include "support/multiplier.h"
#include "support/precondition_error.h"
#include "support/text.h"
#include "support/triangles.h"

namespace kinetri::viewer_page_reader_test {
namespace {

const std::string begin_mark = "<script type=\"application/json\" id=\"recording\">";

std::string page_of(const Recording& recording, const Viewer_settings& settings) {
  std::ostringstream out;
  write_viewer_page(out, recording, settings);
  return out.str();
}

Viewer_page read_back(const std::string& page) {
  std::istringstream in(page);
  return read_viewer_page(in, "run.html");
}

// What the message of the refusal is; empty if the page is read.
std::string refusal(const std::string& page) {
  try {
    read_back(page);
  } catch (const Input_error& error) {
    return error.what();
  }
  return {};
}

// The triangles, by their sides.
std::set<Triangle_ids> triangles_of(const Playback& playback) {
  std::set<Triangle_ids> result;
  for (const auto& [edge, offset] : playback.edges()) {
    for (const auto& [p, q] : {edge, Edge_ids{edge[1], edge[0]}}) {
      const Point_id r = playback.apex(p, q);
      if (r != no_point) result.insert(triangle_ids(p, q, r));
    }
  }
  return result;
}

template <class Simulation>
struct Traits_of;
template <class Traits>
struct Traits_of<Simulation_2<Traits>> {
  using type = Traits;
};

// Records the run, and compares what is read back with a second run. `make` makes a simulation.
template <class Make>
Viewer_page expect_same(const Make& make, double until, std::size_t most_rows,
                        const Viewer_settings& settings) {
  const auto simulation = make();
  using Simulation = std::remove_cvref_t<decltype(*simulation)>;
  Recorder<typename Traits_of<Simulation>::type> recorder(simulation->triangulation(), until,
                                                          most_rows);
  simulation->add_observer(recorder);
  simulation->advance_to(Algebraic_number(until));
  const Recording recording = recorder.recording();
  simulation->remove_observer(recorder);
  const std::string page = page_of(recording, settings);
  Viewer_page read = read_back(page);
  EXPECT_EQ(page_of(read.recording, read.settings), page);
  EXPECT_EQ(read.recording.initial_edges, recording.initial_edges);
  EXPECT_EQ(read.recording.initial_triangles, recording.initial_triangles);
  EXPECT_EQ(read.recording.triangles, recording.triangles);
  EXPECT_EQ(read.recording.coincidences, recording.coincidences);
  EXPECT_EQ(read.recording.events_in_all, recording.events_in_all);
  EXPECT_EQ(read.recording.events.size(), recording.events.size());
  if (!recording.is_thinned) {
    for (std::size_t i = 0; i < recording.events.size(); ++i) {
      EXPECT_EQ(read.recording.events[i].number, recording.events[i].number);
      EXPECT_EQ(read.recording.events[i].time.nearest, recording.events[i].time.nearest);
    }
    const auto again = make();
    Playback playback(read.recording);
    for (int i = 0; i <= 20; ++i) {
      const double time = read.recording.from + (until - read.recording.from) * i / 20;
      again->advance_to(Algebraic_number(time));
      playback.go_to(time);
      const auto& triangulation = again->triangulation();
      const auto edges = triangulation.finite_edge_ids();
      std::vector<Edge_ids> played;
      for (const Periodic_edge& edge : playback.edges()) played.push_back(edge.ids);
      EXPECT_EQ(played, edges) << time;
      EXPECT_EQ(triangles_of(playback), test::triangles_of(triangulation)) << time;
      const std::vector<Recorded_place> places = playback.places();
      for (Point_id id = 0; id < triangulation.next_id(); ++id) {
        EXPECT_EQ(places[id].is_there, triangulation.contains(id)) << id;
        if (!triangulation.contains(id)) continue;
        EXPECT_EQ(places[id].is_hidden, triangulation.is_hidden(id)) << id << " at " << time;
        EXPECT_EQ(playback.shown(id), triangulation.vertex(id)->point().id())
            << id << " at " << time;
        const Vector_2 place = rounded_place(triangulation.motion(id), time);
        EXPECT_NEAR(places[id].x, place.x, 1e-9);
        EXPECT_NEAR(places[id].y, place.y, 1e-9);
      }
    }
    // Back to the start, before the events of that time.
    playback.go_to_row(0);
    EXPECT_EQ(triangles_of(playback), std::set<Triangle_ids>(recording.initial_triangles.begin(),
                                                             recording.initial_triangles.end()));
  }
  return read;
}

template <class Traits = Linear_kinetic_traits_2, class... Arguments>
auto maker(const Arguments&... arguments) {
  return [=] { return std::make_unique<Simulation_2<Traits>>(arguments...); };
}

Viewer_settings some_settings(std::size_t points) {
  Viewer_settings result;
  result.title = "a <run> & \"more\"";
  for (std::size_t i = 0; i < points; ++i)
    result.names.push_back("n" + std::to_string(i) + "\xc3\xbc");
  result.box = Box_2{0, 0, 40, 40};
  result.view = "t=2&color=area";
  result.radius = 0.5;
  result.wave = Wave_shape{3, 0.1};
  result.encounters = Viewer_encounters{1.5, {{{0, 7}, 0.25, 1}, {{3, 4}, 0.5, 0.25}}, 2};
  return result;
}

TEST(Viewer_page_reader, reads_what_was_written) {
  const Viewer_page read = expect_same(maker(test::random_motions(60, 40, 5, 2),
                                             test::discs({0, 0, 40, 40}, 0.5, collide_elastically)),
                                       5, 100'000, some_settings(60));
  EXPECT_EQ(read.settings.title, "a <run> & \"more\"");
  EXPECT_EQ(read.settings.names[7], "n7\xc3\xbc");
  EXPECT_EQ(read.settings.view, "t=2&color=area");
  EXPECT_EQ(read.settings.box->xmax, 40);
  EXPECT_EQ(read.settings.radius, 0.5);
  EXPECT_EQ(read.settings.encounters->all[1].end, 0.25);
  EXPECT_EQ(read.settings.wave->width, 0.1);
}

TEST(Viewer_page_reader, reads_points_that_go) {
  expect_same(
      maker(test::random_motions(60, 40, 5, 2), test::discs({0, 0, 40, 40}, 0.5, erase_both)), 5,
      100'000, {});
}

TEST(Viewer_page_reader, reads_thinned_runs) {
  const Viewer_page read =
      expect_same(maker(test::random_motions(60, 40, 5, 5),
                        test::discs({0, 0, 40, 40}, 0.25, collide_elastically)),
                  16, 450, {});
  EXPECT_TRUE(read.recording.is_thinned);
  Playback playback(read.recording);
  for (int i = 0; i <= 16; ++i) {
    playback.go_to(i);
    for (const Recorded_place& place : playback.places()) {
      EXPECT_TRUE(place.is_there && place.x >= 0 && place.y >= 0 && place.x <= 40 && place.y <= 40);
    }
  }
}

TEST(Viewer_page_reader, reads_hidden_points_that_accelerate) {
  std::vector<Polynomial_disc_motion_2> discs;
  for (const Linear_motion_2& m : test::random_motions(60, 60, 5, 14)) {
    const auto i = static_cast<double>(discs.size());
    discs.push_back({{m.position, m.velocity, {std::fmod(i, 3) - 1, -1}, {0.25, 0}, 0},
                     std::fmod(7 * i, 11) * 1.5,
                     std::fmod(i, 3) / 4,
                     i < 5 ? -20.0 : 0});
  }
  expect_same(maker<Polynomial_disc_kinetic_traits_2>(discs, Simulation_options()), 4, 100'000, {});
}

TEST(Viewer_page_reader, reads_degenerate_instants) {
  std::vector<Linear_motion_2> motions;
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 6; ++y) {
      motions.push_back({{x * 4.0, y * 4.0}, {(x * y) % 3 - 1.0, (x + 2 * y) % 3 - 1.0}});
    }
  }
  expect_same(maker(motions, Simulation_options()), 12, 100'000, {});
  const std::vector<Linear_motion_2> flat = {
      {{-9, -1}, {0, 1}}, {{9, -1}, {0, 1}}, {{1, 3}, {0, -3}}};
  expect_same(maker(flat, Simulation_options()), 2, 100, {});
  const std::vector<Linear_motion_2> on_a_line = {
      {{0, 0}, {1, 0}}, {{2, 0}, {}}, {{4, 0}, {-1, 0}}};
  expect_same(maker(on_a_line, Simulation_options()), 3, 100, {});
}

// Things that go with one of three leaders between most observations, so that many coincide.
std::vector<std::vector<Observation_2>> walks_in_groups() {
  std::mt19937 random(8);
  const auto number = [&](unsigned limit) { return static_cast<double>(random() % limit); };
  std::vector<std::vector<Observation_2>> result(14);
  for (int time = 0; time < 12; ++time) {
    std::vector<Vector_2> leaders(3);
    for (Vector_2& place : leaders) place = {number(40), number(40)};
    for (std::size_t i = 0; i < result.size(); ++i) {
      // Some come later, and some go earlier.
      if (time < static_cast<int>(i % 4) || time > 11 - static_cast<int>(i % 3)) continue;
      const bool is_alone = random() % 4 == 0;
      const Vector_2 alone = {number(40), number(40)};
      result[i].push_back({static_cast<double>(time), is_alone ? alone : leaders[(i + i / 5) % 3]});
    }
  }
  return result;
}

TEST(Viewer_page_reader, reads_points_that_coincide_for_a_while) {
  const auto walks = walks_in_groups();
  const std::vector<Stay> stays = stays_of(walks, {});
  const auto points = [&] { return simulate_tracks(walks, stays, 0); };
  EXPECT_GT(expect_same(points, 11, 100'000, {}).recording.coincidences.size(), 30u);
  const std::vector<double> radii = {1, 2, 2, 1, 3, 1, 1, 2, 1, 9, 1, 1, 1, 2};
  const auto discs = [&] { return simulate_tracks(walks, radii, stays, 0); };
  EXPECT_GT(expect_same(discs, 11, 100'000, {}).recording.coincidences.size(), 10u);
  // Two by two, until walls and contacts turn one after the other.
  std::vector<Linear_motion_2> pairs = test::random_motions(20, 40, 5, 9);
  for (std::size_t i = 0; i < 20; ++i) pairs.push_back(pairs[i]);
  for (const auto& response : {collide_elastically, erase_both}) {
    const auto turning = maker(pairs, test::discs({0, 0, 40, 40}, 0.5, response));
    EXPECT_GT(expect_same(turning, 5, 100'000, {}).recording.coincidences.size(), 20u);
  }
  // Two at one place, without an edge.
  const Linear_motion_2 one = {{1, 2}, {3, 4}};
  expect_same(maker(std::vector<Linear_motion_2>{one, one}, Simulation_options()), 2, 100, {});
  expect_same(maker<Disc_kinetic_traits_2>(std::vector<Disc_motion_2>{{one, 2}, {one, 2}},
                                           Simulation_options()),
              2, 100, {});
}

TEST(Viewer_page_reader, reads_thinned_runs_of_points_that_coincide) {
  const auto walks = walks_in_groups();
  const std::vector<Stay> stays = stays_of(walks, {});
  const auto points = [&] { return simulate_tracks(walks, stays, 0); };
  const Recording recording = expect_same(points, 11, 200, {}).recording;
  EXPECT_TRUE(recording.is_thinned);
  const auto simulation = points();
  Playback playback(recording);
  for (std::size_t row = 0; row < recording.events.size(); ++row) {
    // The triangulation is exact just after the time of a row.
    const double time = recording.events[row].time.bounds.upper;
    simulation->advance_to(Algebraic_number(time));
    playback.go_to(time);
    const auto& triangulation = simulation->triangulation();
    for (Point_id id = 0; id < triangulation.next_id(); ++id) {
      if (!triangulation.contains(id)) continue;
      EXPECT_EQ(playback.shown(id), triangulation.vertex(id)->point().id()) << time;
    }
  }
}

TEST(Viewer_page_reader, reads_few_points) {
  for (std::size_t n = 0; n < 3; ++n) {
    expect_same(maker(test::random_motions(n, 40, 5, 5), Simulation_options()), 4, 100, {});
  }
}

TEST(Playback, stays_within_the_recording) {
  Recording recording;
  recording.until = 3;
  Playback playback(recording);
  playback.go_to(3);
  EXPECT_EQ(playback.time(), 3);
  EXPECT_PRECONDITION_ERROR(playback.go_to(3.5), "a time outside of the recording");
  EXPECT_PRECONDITION_ERROR(playback.go_to_row(1), "a row that is not in the recording");
}

// ---- periodic boxes ----

Recording record_in_box(std::size_t most_rows) {
  const Periodic_box_2 box({{40, 0}, {0, 0}}, {{7, 40}, {30, 0}});
  Kinetic_triangulation_2<Periodic_kinetic_traits_2> kinetic(test::random_motions(20, 40, 5, 2), 0,
                                                             Periodic_kinetic_traits_2(box));
  Recorder<Periodic_kinetic_traits_2> recorder(kinetic, 5, most_rows);
  kinetic.add_observer(recorder);
  kinetic.advance_to(5);
  Recording result = recorder.recording();
  kinetic.remove_observer(recorder);
  return result;
}

// One encounter is of a point with an image of itself.
Viewer_settings settings_in_box() {
  Viewer_settings result = {"periodic", {}};
  result.encounters =
      Viewer_encounters{1.5, {{{0, 7}, 0.25, 1, {-2, 1}}, {{3, 3}, 0.5, 4, {1, 0}}}, 2};
  return result;
}

TEST(Viewer_page_reader, reads_runs_in_periodic_boxes) {
  for (const std::size_t most_rows : {100'000U, 60U}) {
    const Recording recording = record_in_box(most_rows);
    EXPECT_EQ(recording.is_thinned, most_rows == 60);
    const std::string page = page_of(recording, settings_in_box());
    const Viewer_page read = read_back(page);
    EXPECT_EQ(page_of(read.recording, read.settings), page);
    EXPECT_EQ(read.settings.encounters->all[0].offset, (Lattice_offset_2{-2, 1}));
    EXPECT_EQ(read.settings.encounters->all[1].points, (Edge_ids{3, 3}));
    EXPECT_EQ(read.recording.periodic_box, recording.periodic_box);
    EXPECT_EQ(read.recording.initial_edges, recording.initial_edges);
    EXPECT_EQ(read.recording.initial_triangles, recording.initial_triangles);
    EXPECT_EQ(read.recording.initial_offsets, recording.initial_offsets);
    EXPECT_EQ(read.recording.triangles, recording.triangles);
    ASSERT_EQ(read.recording.events.size(), recording.events.size());
    for (std::size_t i = 0; i < recording.events.size(); ++i) {
      EXPECT_EQ(read.recording.events[i].removed_offset, recording.events[i].removed_offset);
      EXPECT_EQ(read.recording.events[i].added_offset, recording.events[i].added_offset);
    }
  }
}

TEST(Playback, plays_runs_in_periodic_boxes) {
  const Recording recording = record_in_box(100'000);
  const Periodic_kinetic_traits_2 traits(*recording.periodic_box);
  Kinetic_triangulation_2<Periodic_kinetic_traits_2> kinetic(test::random_motions(20, 40, 5, 2), 0,
                                                             traits);
  Playback playback(recording);
  for (int i = 0; i <= 20; ++i) {
    kinetic.advance_to(i / 4.0);
    playback.go_to(i / 4.0);
    const auto edges = kinetic.periodic_edges();
    EXPECT_EQ(playback.edges(), std::set<Periodic_edge>(edges.begin(), edges.end())) << i;
    for (const auto face : kinetic.triangulation().finite_face_handles()) {
      const auto corner = [&](int k) {
        return Periodic_image{face->vertex(k)->point().id(), face->offset(k)};
      };
      EXPECT_EQ(playback.apex(corner(0), corner(1)), corner(2));
      EXPECT_EQ(playback.apex(corner(2), corner(0)), corner(1));
    }
  }
}

// ---- damage ----

std::string small_page() {
  Simulation_2<> simulation(test::random_motions(12, 40, 9, 3),
                            test::discs({0, 0, 40, 40}, 1, erase_both));
  Recorder<> recorder(simulation.triangulation(), 3, 1000);
  simulation.add_observer(recorder);
  simulation.advance_to(Algebraic_number(3));
  const Recording recording = recorder.recording();
  simulation.remove_observer(recorder);
  EXPECT_GT(recording.events.size(), 20u);
  return page_of(recording, {"small", {}});
}

// The page with the recording changed.
template <class Change>
std::string changed(const std::string& page, Change change) {
  const std::size_t first = page.find(begin_mark) + begin_mark.size();
  const std::size_t last = page.find("</script>", first);
  nlohmann::json json = nlohmann::json::parse(page.substr(first, last - first));
  change(json);
  return page.substr(0, first) + json.dump() + page.substr(last);
}

TEST(Viewer_page_reader, says_what_is_wrong_in_a_periodic_box) {
  const std::string page = page_of(record_in_box(100'000), settings_in_box());
  const auto expect = [&](const std::string& text, auto change) {
    const std::string said = refusal(changed(page, change));
    EXPECT_TRUE(said.starts_with("run.html: " + text)) << said;
  };
  const auto longer = [](nlohmann::json& list) {
    std::string bytes = *bytes_of_base64(list.get<std::string>());
    Bytes all;
    for (const char byte : bytes) all.add(static_cast<std::uint8_t>(byte));
    all.add(std::uint32_t{1});
    list = all.base64();
  };
  expect("recording.format is not 3", [](auto& json) { json["format"] = 2; });
  expect("recording.format is not 2", [](auto& json) { json.erase("periodic"); });
  expect("recording.periodic", [](auto& json) { json["periodic"].push_back(1); });
  expect("recording.periodic has no area at a time of the run; ",
         [](auto& json) { json["periodic"][7] = -40.0; });
  expect("recording.events.offsets is too long",
         [&](auto& json) { longer(json["events"]["offsets"]); });
  expect("recording.triangles.initial_offsets is too long",
         [&](auto& json) { longer(json["triangles"]["initial_offsets"]); });
  expect("recording.triangles.offsets is too long",
         [&](auto& json) { longer(json["triangles"]["offsets"]); });
  expect("recording.events", [](auto& json) { json["events"].erase("offsets"); });
  expect("recording.encounters.offsets is too long",
         [&](auto& json) { longer(json["encounters"]["offsets"]); });
  expect("recording.encounters", [](auto& json) { json["encounters"].erase("offsets"); });
  expect("recording event ", [](auto& json) {
    std::string& offsets = json["events"]["offsets"].template get_ref<std::string&>();
    offsets = "AQAA" + offsets.substr(4);  // the first offset begins with 1
    offsets[5] = 'B';
  });
  expect("recording.triangles.initial_offsets has an offset of -2^31", [](auto& json) {
    std::string& offsets = json["triangles"]["initial_offsets"].template get_ref<std::string&>();
    offsets = "AAAAgA" + offsets.substr(6);
  });
}

TEST(Viewer_page_reader, says_what_is_wrong) {
  const std::string page = small_page();
  const auto expect = [&](const std::string& text, auto change) {
    EXPECT_EQ(refusal(changed(page, change)), "run.html: " + text);
  };
  const std::string as_written = "; expected the page as it was written";
  EXPECT_EQ(refusal(page), "");
  EXPECT_EQ(refusal(""), "run.html: has no recording; expected a page that --html has written");
  EXPECT_EQ(refusal(page.substr(0, page.find(begin_mark) + 1000)),
            "run.html: ends within its recording; expected the whole page as it was written");
  EXPECT_EQ(refusal("<!doctype html>" + begin_mark + "{</script>"),
            "run.html: has a recording that is no JSON" + as_written);
  EXPECT_EQ(refusal("<!doctype html>" + begin_mark + "3</script>"),
            "run.html: recording is no object; expected one in braces");
  expect("recording.format is not 2, which this version reads; expected a page of this version",
         [](auto& json) { json["format"] = 1; });
  expect("recording.until is before the start of the run; expected a later time",
         [](auto& json) { json["until"] = -1.5; });
  expect("recording has no member \"events\"; expected one",
         [](auto& json) { json.erase("events"); });
  expect("recording.names has 2 elements; expected 12", [](auto& json) {
    json["names"] = {"a", "b"};
  });
  expect("recording.points is 13, but the motions are those of 12; expected as many",
         [](auto& json) { json["points"] = 13; });
  expect("recording.events.kind is not base64" + as_written,
         [](auto& json) { json["events"]["kind"] = "AA*="; });
  expect("recording.events.time is too short" + as_written,
         [](auto& json) { json["events"]["time"] = "AAAAAAAAAAA="; });
  expect("recording.events.time is too long" + as_written, [](auto& json) {
    json["events"]["time"] = json["events"]["time"].template get<std::string>().substr(0, 8) +
                             "AAAAAAAA" +
                             json["events"]["time"].template get<std::string>().substr(8);
    json["events"]["count"] = 0;
    for (const char* list : {"kind", "fields", "ids"}) json["events"][list] = "";
  });
  expect("recording.events.kinds[0] is no kind of event" + as_written,
         [](auto& json) { json["events"]["kinds"][0] = "flop"; });
  expect("recording.motions.degree is no whole number from 1 to 3; expected one",
         [](auto& json) { json["motions"]["degree"] = 4; });
  expect(
      "recording.coincidences.event has the coincidence 0 at event 65535, which is not there, or "
      "too early" +
          as_written,
      [](auto& json) {
        json["coincidences"] = {{"count", 1},
                                {"starting", 0},
                                {"event", "//8AAA=="},
                                {"point", "AAA="},
                                {"shown", "AAA="}};
      });
  expect("recording.triangles.initial names the point 65535, but the ids end with 11" + as_written,
         [](auto& json) { json["triangles"]["initial"] = "//////////8="; });
  expect("recording.triangles.initial has a triangle whose corners are 0, 0 and 0" + as_written,
         [](auto& json) { json["triangles"]["initial"] = "AAAAAAAA"; });
  expect("recording the start adds the triangle 0-1-2, which overlaps another one" + as_written,
         [](auto& json) { json["triangles"]["initial"] = "AAABAAIAAAABAAIA"; });
}

// Any change of the text is refused, or the page can still be played: it never crashes, nor does it
// fail an assertion.
TEST(Viewer_page_reader, of_a_page_with_random_damage_refuses_it_or_plays_it) {
  const std::string page = small_page();
  const std::size_t first = page.find(begin_mark) + begin_mark.size();
  const std::size_t last = page.find("</script>", first);
  std::mt19937 random(5);
  int refused = 0;
  const int times = test::cases(1000);
  for (int i = 0; i < times; ++i) {
    std::string damaged = page;
    const std::size_t at = first + random() % (last - first);
    const std::string letters = "AB/+z9=\",{}[]0-e.\\ \n";
    switch (random() % 3) {
      case 0:
        damaged[at] = letters[random() % letters.size()];
        break;
      case 1:
        damaged.erase(at, 1 + random() % 8);
        break;
      default:
        damaged.insert(at, page.substr(first + random() % (last - first - 8), 8));
    }
    try {
      const Viewer_page read = read_back(damaged);
      Playback playback(read.recording);
      playback.go_to_row(read.recording.events.size());
      playback.places();
    } catch (const Input_error& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find("run.html: "), 0u) << error.what();
      EXPECT_NE(std::string(error.what()).find("; expected "), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(refused, times / 3);
  EXPECT_LT(refused, times);
}

}  // namespace
}  // namespace kinetri::viewer_page_reader_test
