// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri wave` from outside, and the page of --html as a file.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/program_test.h"
#include "support/text.h"

namespace kinetri::wave_command_test {
namespace {

using test::Arguments;
using test::Entries;
using test::Outcome;

class Wave : public test::Program_test {
 protected:
  Outcome wave(Arguments more) const {
    more.insert(more.begin(), {"wave", "--columns", "6", "--rows", "5"});
    return run(more);
  }
  nlohmann::json page(const std::string& name) const {
    const std::string text = read(name);
    EXPECT_NE(text.find("</html>"), std::string::npos);
    return nlohmann::json::parse(test::between(text, "id=\"recording\">", "</script"));
  }
};

TEST_F(Wave, runs_across_and_back) {
  const Outcome outcome =
      wave({"--html", "wave.html", "--stats", "stats.json", "--audit", "events"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto stats = nlohmann::json::parse(read("stats.json"));
  EXPECT_EQ(stats["points"], 30);
  EXPECT_EQ(stats["until"], 10);
  EXPECT_EQ(stats["audits"]["failed"], 0);
  // Each column: at the top and at the bottom; 4 contacts up, 4 down.
  EXPECT_EQ(stats["events"]["wall"], 2 * 6);
  EXPECT_EQ(stats["events"]["collision"], 8 * 6);
  const auto data = page("wave.html");
  EXPECT_EQ(data["title"], "wave of 6 x 5 points");
  EXPECT_EQ(data["wave"]["height"], 30);
  EXPECT_EQ(data["wave"]["width"], 20);
  EXPECT_EQ(data["box"], nlohmann::json({-5, -5, 55, 45}));
}

TEST_F(Wave, has_jitter_where_it_is_asked_for) {
  const auto edges = [&](const Arguments& arguments) {
    Arguments all = {"--initial-edges", "-", "--quiet"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = wave(all);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  const std::string exact = edges({});
  EXPECT_EQ(exact, edges({"--seed", "2"}));
  EXPECT_NE(exact, edges({"--jitter", "3"}));
  EXPECT_EQ(edges({"--jitter", "3"}), edges({"--jitter", "3", "--seed", "1"}));
  EXPECT_NE(edges({"--jitter", "3"}), edges({"--jitter", "3", "--seed", "2"}));
}

TEST_F(Wave, the_page_of_a_run_with_names_has_them) {
  write("t.csv", "t,id,x,y\n0,ann,0,0\n0,bob,9,0\n0,<i>,0,9\n10,ann,1,1\n10,bob,9,0\n10,<i>,0,9\n");
  const Outcome outcome = run({"tracks", file("t.csv"), "--html", "t.html", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto data = page("t.html");
  EXPECT_EQ(data["title"], "t.csv");
  EXPECT_EQ(data["names"], nlohmann::json({"ann", "bob", "<i>"}));
  EXPECT_TRUE(data["wave"].is_null());
}

TEST_F(Wave, the_page_of_a_failing_run_is_not_there) {
  write("p.csv", "x,y,vx,vy\n0,0,0,0\n0,0,0,0\n");
  EXPECT_EQ(run({"simulate", "p.csv", "--coincident", "refuse", "--until", "1", "--html", "p.html"})
                .exit_code,
            2);
  EXPECT_EQ(entries(), Entries{"p.csv"});
}

}  // namespace
}  // namespace kinetri::wave_command_test
