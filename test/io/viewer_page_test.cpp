// SPDX-License-Identifier: GPL-3.0-or-later
//
// What stands in the page. That browsers show it is for viewer/test.
#include "kinetri/io/viewer_page.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "kinetri/events/event.h"
#include "support/precondition_error.h"
#include "support/text.h"

namespace kinetri::viewer_page_test {
namespace {

using nlohmann::json;

std::string page(const Recording& recording, const Viewer_settings& settings) {
  std::ostringstream out;
  write_viewer_page(out, recording, settings);
  return out.str();
}

// What a browser finds in the element: up to the next "</script".
json data(const std::string& page) {
  return json::parse(
      test::between(page, "<script type=\"application/json\" id=\"recording\">", "</script"));
}

Polynomial_disc_motion_2 disc(const Polynomial_motion_2& center, double radius = 0,
                              double growth = 0, double weight = 0) {
  return {center, radius, growth, weight};
}

// Three points: one accelerates, one leaves.
Recording small_recording() {
  Recording result;
  result.from = 0.5;
  result.until = 4;
  result.initial_edges = {{0, 1}, {0, 2}, {1, 2}};
  result.initial_triangles = {{0, 2, 1}};
  result.motions = {{std::nullopt, 0, disc({{1, 2}, {3, 4}})},
                    {std::nullopt, 1, disc({{-1, 0.25}, {}, {6, -7}, {}, 0.5})},
                    {std::nullopt, 2, disc({{1e300, 5e-324}, {0, -0.0}, {}, {}, 2})},
                    {1, 1, std::nullopt}};
  // 0.1 is above 1/10; the next number above it and itself bound some exact time.
  result.events = {{5, Event_kind::flip, {0.1, {0.1, 0.1 + 0x1p-56}}, {{0, 1}}, {{1, 2}}},
                   {6, Event_kind::erase, {2, {2, 2}}, {}, {}, 1},
                   {7, Event_kind::collision, {3, {3 - 0x1p-51, 3}}, {}, {}, 0, 2}};
  // The page leaves out what a flip does.
  result.triangles = {{0, false, {0, 2, 1}},
                      {0, true, {0, 1, 2}},
                      {1, false, {0, 1, 2}},
                      {2, true, {0, 2, 1}},
                      {2, true, {0, 1, 2}}};
  result.events_in_all = 3;
  return result;
}

// The texts in base64 are those that Python's struct and base64 make of the numbers.
TEST(Viewer_page, holds_the_recording) {
  const json object = data(page(small_recording(), {"a run", {}}));
  EXPECT_EQ(object["format"], 2);
  EXPECT_EQ(object["title"], "a run");
  EXPECT_EQ(object["from"], 0.5);
  EXPECT_EQ(object["until"], 4);
  EXPECT_EQ(object["points"], 3);
  EXPECT_EQ(object["initial_edges"], "");
  const json& triangles = object["triangles"];
  EXPECT_EQ(triangles["initial"], "AAACAAEA");
  EXPECT_EQ(triangles["count"], 2);
  EXPECT_EQ(triangles["event"], "AQAAAAIAAAA=");
  EXPECT_EQ(triangles["removed"], "AQAAAAAAAAA=");
  EXPECT_EQ(triangles["added"], "AAAAAAIAAAA=");
  EXPECT_EQ(triangles["ids"], "AAABAAIAAAACAAEAAAABAAIA");
  EXPECT_TRUE(object["box"].is_null() && object["thinned"].is_null() && object["wave"].is_null());
  EXPECT_EQ(object["radius"], 0);
  EXPECT_FALSE(object.contains("names"));
  const json& motions = object["motions"];
  EXPECT_EQ(motions["count"], 4);
  EXPECT_EQ(motions["degree"], 2);
  EXPECT_EQ(motions["starting"], 3);
  EXPECT_EQ(motions["event"], "AAAAAAAAAAAAAAAAAQAAAA==");
  EXPECT_EQ(motions["point"], "AAABAAIAAQA=");
  EXPECT_EQ(motions["there"], "AQEBAA==");
  EXPECT_EQ(
      motions["data"],
      "AAAAAAAAAAAAAAAAAADwPwAAAAAAAABAAAAAAAAACEAAAAAAAAAQQAAAAAAAAAAAAAAAAAAAAAAAAAAAAADgPwAA"
      "AAAAAPC/AAAAAAAA0D8AAAAAAAAAAAAAAAAAAAAAAAAAAAAAGEAAAAAAAAAcwAAAAAAAAABAnHUAiDzkN34BAAAA"
      "AAAAAAAAAAAAAAAAAAAAAAAAAIAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
      "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA=");
  const json& events = object["events"];
  EXPECT_EQ(events["count"], 3);
  EXPECT_EQ(events["first"], 5);
  EXPECT_EQ(events["kinds"].size(), event_kinds);
  EXPECT_EQ(events["kinds"][3], "flip");
  ASSERT_EQ(events["colors"].size(), event_kinds);
  for (std::size_t i = 0; i < event_kinds; ++i) {
    EXPECT_EQ(events["colors"][i], color(static_cast<Event_kind>(i)));
  }
  EXPECT_EQ(events["kind"], "AwkH");
  EXPECT_EQ(events["fields"], "EwQs");
  EXPECT_EQ(events["time"], "mpmZmZmZuT8AAAAAAAAAQAAAAAAAAAhA");
  EXPECT_EQ(events["ids"], "AAABAAEAAgABAAAAAgA=");
}

TEST(Viewer_page, has_edges_that_are_sides_of_no_triangle) {
  Recording recording = small_recording();
  recording.initial_triangles.clear();
  EXPECT_EQ(data(page(recording, {}))["initial_edges"], "AAABAAAAAgABAAIA");
}

TEST(Viewer_page, has_wide_ids_for_many_points) {
  Recording recording;
  recording.initial_edges = {{0, 1}, {0, 70'000}, {1, 70'000}};
  for (Point_id id = 0; id <= 70'000; ++id) {
    recording.motions.push_back({std::nullopt, id, disc({})});
  }
  EXPECT_EQ(data(page(recording, {}))["initial_edges"], "AAAAAAEAAAAAAAAAcBEBAAEAAABwEQEA");
}

TEST(Viewer_page, says_what_the_settings_say) {
  Viewer_settings settings;
  settings.names = {"a", "b", "c"};
  settings.box = Box_2{-1, 0.1, 2, 3};
  settings.radius = 0.25;
  settings.wave = Wave_shape{3, 20};
  Recording recording = small_recording();
  recording.is_thinned = true;
  recording.events_in_all = 12'345;
  recording.motions[0].motion->jerk = {0, 1};
  const json object = data(page(recording, settings));
  EXPECT_EQ(object["names"], json({"a", "b", "c"}));
  EXPECT_EQ(object["box"], json({-1, 0.1, 2, 3}));
  EXPECT_EQ(object["radius"], 0.25);
  EXPECT_EQ(object["thinned"]["events"], 12'345);
  EXPECT_EQ(object["events"]["first"], 0);
  EXPECT_EQ(object["wave"]["height"], 3);
  EXPECT_EQ(object["wave"]["width"], 20);
  EXPECT_EQ(object["motions"]["degree"], 3);
}

TEST(Viewer_page, has_the_sizes_of_discs) {
  Recording recording = small_recording();
  EXPECT_FALSE(data(page(recording, {}))["motions"].contains("sizes"));
  recording.motions[0].motion = disc({{1, 2}, {3, 4}}, 0.5, -0.25);
  recording.motions[2].motion = disc({{5, 6}}, 2, 0, -3);
  EXPECT_EQ(data(page(recording, {}))["motions"]["sizes"],
            "AAAAAAAA4D8AAAAAAADQvwAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
            "AAAAAAAAAEAAAAAAAAAAAAAAAAAAAAjAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA");
}

TEST(Viewer_page, has_encounters) {
  EXPECT_FALSE(data(page(small_recording(), {})).contains("encounters"));
  Viewer_settings settings;
  settings.encounters = Viewer_encounters{1.5, {{{0, 2}, 0.5, 4}, {{1, 2}, 2, 1.75}}, 2};
  const json encounters = data(page(small_recording(), settings))["encounters"];
  EXPECT_EQ(encounters["range"], 1.5);
  EXPECT_EQ(encounters["count"], 2);
  EXPECT_EQ(encounters["in_all"], 2);
  EXPECT_EQ(encounters["ids"], "AAACAAEAAgA=");
  EXPECT_EQ(encounters["begin"], "AAAAAAAA4D8AAAAAAAAAQA==");
  EXPECT_EQ(encounters["end"], "AAAAAAAAEEAAAAAAAAD8Pw==");
  EXPECT_FALSE(encounters.contains("offsets"));
}

TEST(Viewer_page, is_not_broken_by_texts) {
  Viewer_settings settings;
  settings.view = "t=1&color=area</script>";
  settings.title = "</title></script><!-- recording --> & \"x\" \\";
  settings.names = {"</script>", "<!-- scripts -->", "\xff\xfe not UTF-8"};
  const std::string text = page(small_recording(), settings);
  const json object = data(text);
  EXPECT_EQ(object["title"], settings.title);
  EXPECT_EQ(object["view"], settings.view);
  EXPECT_EQ(object["names"][0], "</script>");
  EXPECT_EQ(object["names"][1], "<!-- scripts -->");
  const std::size_t title = text.find("<title>");
  EXPECT_EQ(text.substr(title, text.find("</title>") - title),
            "<title>&lt;/title&gt;&lt;/script&gt;&lt;!-- recording --&gt; &amp; \"x\" \\");
}

TEST(Viewer_page, is_complete_and_the_same_each_time) {
  const std::string text = page(small_recording(), {});
  EXPECT_EQ(text.rfind("<!doctype html>", 0), 0u);
  EXPECT_NE(text.find("</html>"), std::string::npos);
  for (const char* marker : {"title", "style", "recording", "scripts"}) {
    EXPECT_EQ(text.find("<!-- " + std::string(marker) + " -->"), std::string::npos) << marker;
  }
  EXPECT_EQ(text, page(small_recording(), {}));
}

TEST(Viewer_page, shows_a_recording_of_nothing) {
  const json object = data(page({}, {}));
  EXPECT_EQ(object["points"], 0);
  EXPECT_EQ(object["events"]["count"], 0);
  EXPECT_EQ(object["events"]["first"], 0);
  EXPECT_EQ(object["motions"]["data"], "");
}

TEST(LivePage, has_the_points_and_the_module) {
  std::ostringstream out;
  const Live_page live = {"a < b", "x,y,vx,vy\n1,2,3,4\n", "{\"rim\":true}"};
  if (!has_live_module()) {
    EXPECT_PRECONDITION_ERROR(write_live_page(out, live), "a page without its module");
    return;
  }
  write_live_page(out, live);
  const std::string text = out.str();
  EXPECT_NE(text.find("<title>a &lt; b</title>"), std::string::npos);
  EXPECT_EQ(test::between(text, "data-options='{\"rim\":true}'>\n", "</script"), live.points);
  EXPECT_GT(test::between(text, "id=\"module\">", "</script").size(), 100'000u);
  EXPECT_EQ(text.find("id=\"recording\">"), std::string::npos);
}

}  // namespace
}  // namespace kinetri::viewer_page_test
