// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every file of data/degenerate: audited between all instants; the same with and without filters,
// step by step and in one go; the same as the brute-force simulator where there are few points; and
// the same triangles in a recording.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "kinetri/io/points_file.h"
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "support/kinetic_runs.h"
#include "support/same_run.h"
#include "support/triangles.h"

namespace kinetri::corpus_test {
namespace {

using test::Event_recorder;
using test::Kinetic_delaunay;

const std::filesystem::path corpus = KINETRI_DEGENERATE_FOLDER;

constexpr std::size_t few_points = 8;  // the brute-force simulator looks at all quadruples

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

// What stands behind `# key: ` on a line of its own; none if there is no such line.
std::optional<std::string> setting(const std::string& text, const std::string& key) {
  const std::string intro = "\n# " + key + ": ";
  const std::size_t found = text.find(intro);
  if (found == std::string::npos) return std::nullopt;
  const std::size_t begin = found + intro.size();
  return text.substr(begin, text.find('\n', begin) - begin);
}

struct Degenerate_case {
  explicit Degenerate_case(const std::string& name)
      : motions(read_points_file((corpus / (name + ".csv")).string()).motions) {
    const std::string text = text_of(corpus / (name + ".csv"));
    if (const auto value = setting(text, "until")) until = Algebraic_number(std::stod(*value));
    if (const auto value = setting(text, "events")) events = std::stoul(*value);
  }

  std::vector<Linear_motion_2> motions;
  std::optional<Algebraic_number> until;
  std::optional<std::size_t> events;
};

template <class Kinetic>
void run(Kinetic& kinetic, const std::optional<Algebraic_number>& until) {
  if (until) {
    kinetic.advance_to(*until);
  } else {
    while (kinetic.step() > 0 || kinetic.next_event_time()) {
    }
  }
}

template <class Predicate>
std::vector<std::string> names_where(Predicate predicate) {
  std::vector<std::string> result;
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".csv" && predicate(name)) result.push_back(name);
  }
  std::ranges::sort(result);
  return result;
}

std::vector<std::string> all_names() {
  return names_where([](const std::string&) { return true; });
}

std::string test_name(const testing::TestParamInfo<std::string>& file) {
  std::string name = file.param;
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class Degenerate_corpus : public testing::TestWithParam<std::string> {
 protected:
  const Degenerate_case input = Degenerate_case(GetParam());
};
class Degenerate_corpus_to_an_end : public Degenerate_corpus {};
class Degenerate_corpus_of_few_points : public Degenerate_corpus {};

INSTANTIATE_TEST_SUITE_P(File, Degenerate_corpus, testing::ValuesIn(all_names()), test_name);
INSTANTIATE_TEST_SUITE_P(File, Degenerate_corpus_to_an_end,
                         testing::ValuesIn(names_where([](const std::string& name) {
                           return Degenerate_case(name).until.has_value();
                         })),
                         test_name);
INSTANTIATE_TEST_SUITE_P(File, Degenerate_corpus_of_few_points,
                         testing::ValuesIn(names_where([](const std::string& name) {
                           return Degenerate_case(name).motions.size() <= few_points;
                         })),
                         test_name);

TEST_P(Degenerate_corpus, passes_audits_between_all_instants) {
  Kinetic_delaunay kinetic(input.motions);
  const bool is_small = input.motions.size() <= few_points;
  EXPECT_EQ(test::audited_run(kinetic, input.until,
                              is_small ? Audit_level::certificates : Audit_level::reference),
            "");
  if (input.events) {
    EXPECT_EQ(kinetic.counters().number_of_events(), *input.events);
  }
}

// The triangles after each flip, by the number of the event. Rebuild events are reported when all
// of them have happened.
class Triangles_after_flips : public Kinetic_delaunay::Observer {
 public:
  explicit Triangles_after_flips(const Kinetic_delaunay& kinetic) : kinetic_(kinetic) {}

  void after_event(const Event& event) override {
    if (event.kind != Event_kind::rebuild) by_number[event.number] = test::triangles_of(kinetic_);
  }

  std::map<std::uint64_t, std::set<Triangle_ids>> by_number;

 private:
  const Kinetic_delaunay& kinetic_;
};

TEST_P(Degenerate_corpus, has_its_triangles_in_a_recording) {
  Kinetic_delaunay kinetic(input.motions);
  Triangles_after_flips after_flips(kinetic);
  kinetic.add_observer(after_flips);
  Recorder<> recorder(kinetic, input.until ? input.until->to_double() : 1e300, 1'000'000);
  kinetic.add_observer(recorder);
  // By the rounded time of an instant: it may be that of several.
  std::multimap<double, std::set<Triangle_ids>> after_instants;
  const std::set<Triangle_ids> first = test::triangles_of(kinetic);
  while (kinetic.next_event_time() &&
         (!input.until || *kinetic.next_event_time() <= *input.until)) {
    input.until ? kinetic.step(*input.until) : kinetic.step();
    after_instants.emplace(kinetic.current_time().to_double(), test::triangles_of(kinetic));
  }
  const Recording recording = recorder.recording();
  test::Triangle_player player(recording);
  EXPECT_EQ(player.triangles(), first);
  std::size_t flips = 0;
  for (std::size_t i = 0; i < recording.events.size(); ++i) {
    const Recorded_event& event = recording.events[i];
    player.execute(i);
    if (event.kind != Event_kind::rebuild) {
      EXPECT_EQ(player.triangles(), after_flips.by_number.at(event.number)) << "after row " << i;
      ++flips;
    }
    const bool is_last_of_instant =
        i + 1 == recording.events.size() || recording.events[i + 1].time != event.time;
    const bool is_reported = event.removed || event.added;
    if (!is_last_of_instant || !is_reported) continue;
    const auto [begin, end] = after_instants.equal_range(event.time.nearest);
    EXPECT_TRUE(std::any_of(
        begin, end, [&](const auto& instant) { return instant.second == player.triangles(); }))
        << "after row " << i << ", t = " << event.time.nearest;
  }
  EXPECT_EQ(flips, after_flips.by_number.size());
  EXPECT_TRUE(player.is_at_end());
  EXPECT_EQ(player.triangles(), test::triangles_of(kinetic));
}

TEST_P(Degenerate_corpus, has_the_same_events_without_filters) {
  Kinetic_delaunay filtered(input.motions);
  Kinetic_delaunay exact(input.motions, Algebraic_number(), Linear_kinetic_traits_2::exact());
  Event_recorder one(filtered);
  Event_recorder other(exact);
  EXPECT_EQ(one.edges, other.edges) << "at the start";
  run(filtered, input.until);
  run(exact, input.until);
  EXPECT_EQ(test::difference(one.events, other.events), "");
  EXPECT_EQ(exact.certificate_counters().filter_decided, 0u);
}

TEST_P(Degenerate_corpus, has_the_same_events_for_discs_of_one_size) {
  Kinetic_delaunay delaunay(input.motions);
  std::vector<Disc_motion_2> discs;
  for (const Linear_motion_2& motion : input.motions) discs.push_back({motion, 0.5, 0, 0});
  Kinetic_regular_triangulation_2<> regular(discs);
  Event_recorder one(delaunay);
  Event_recorder other(regular);
  EXPECT_EQ(one.edges, other.edges) << "at the start";
  run(delaunay, input.until);
  run(regular, input.until);
  EXPECT_EQ(test::difference(one.events, other.events), "");
}

TEST_P(Degenerate_corpus_to_an_end, has_the_same_events_in_one_go_as_in_steps) {
  Kinetic_delaunay whole(input.motions);
  Kinetic_delaunay halting(input.motions);
  Event_recorder one(whole);
  Event_recorder other(halting);
  whole.advance_to(*input.until);
  while (halting.next_event_time() && *halting.next_event_time() <= *input.until) {
    // Halts between instants too, where nothing happens.
    const Rational between = simplest_between(halting.current_time(), *halting.next_event_time());
    ASSERT_EQ(halting.advance_to(Algebraic_number(between)), 0u);
    halting.step();
  }
  EXPECT_EQ(test::difference(one.events, other.events), "");
}

TEST_P(Degenerate_corpus_of_few_points, equals_the_brute_force_simulator) {
  EXPECT_EQ(test::difference_from_brute_force(input.motions), "");
}

TEST(Degenerate_corpus_list, names_every_file) {
  const std::string list = text_of(corpus / "README.md");
  ASSERT_FALSE(all_names().empty());
  for (const std::string& name : all_names()) {
    EXPECT_NE(list.find("| " + name + ".csv |"), std::string::npos)
        << name << " is not in README.md; run generate.py";
  }
}

}  // namespace
}  // namespace kinetri::corpus_test
