// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "video/block_offsets.h"
#include "video/stream/block_bytes.h"
#include "video/streams.h"

namespace kinetri::video::stream_test {
namespace {

using test::bytes_of;
using test::corner_nodes;
using test::Random_blocks;
using test::read_all;

Stream_header header_of(std::uint32_t width, std::uint32_t height, Chroma chroma) {
  return {{width, height, chroma, true, {30000, 1001}, {1, 1}}, 4, 8};
}

TEST(Stream, what_is_written_is_read) {
  unsigned seed = 0;
  for (const Chroma chroma : {Chroma::mono, Chroma::yuv444, Chroma::yuv420_jpeg}) {
    for (const auto& [width, height] : {std::array{320U, 240U}, {5U, 3U}, {16384U, 16384U}}) {
      Stream_header header = header_of(width, height, chroma);
      header.place_bits = seed % (most_place_bits + 1);
      header.color_step = 1 + seed * 31 % 255;
      header.margin = seed * 29 % 256;
      const auto blocks = Random_blocks(header, ++seed)(24, 3, 5);
      const std::string bytes = bytes_of(header, blocks);
      const auto read = read_all(bytes);
      EXPECT_EQ(read.error, "");
      EXPECT_EQ(read.blocks, blocks);
      std::istringstream in(bytes);
      EXPECT_EQ(Stream_reader(in, "stream").header(), header);
    }
  }
}

// Byte by byte, as docs/VIDEO.md has them.
TEST(Stream, the_bytes_are_those_of_the_description) {
  const Stream_header header = header_of(320, 240, Chroma::yuv420_mpeg2);
  const std::string bytes = bytes_of(header, {Key{0, corner_nodes(header, {-1, 2, 200})}, End{7}});
  const std::string begin("\x89KVD\r\n\x1a\n\x01\x00\x04\x01\x40\x01\x00\x00\xf0\x00\x00\x00", 20);
  EXPECT_EQ(bytes.substr(0, 20), begin);
  EXPECT_EQ(number_at(bytes, 20, 4), 30000U);
  EXPECT_EQ(number_at(bytes, 24, 4), 1001U);
  EXPECT_EQ(bytes[36], 4);
  EXPECT_EQ(bytes[37], 8);
  EXPECT_EQ(bytes.substr(48, 5), std::string("K\0\0\0\0", 5));
  // 4 points; x: 0, +5120, 0, -5120; y: 0, 0, +3840, 0; then the colors, as differences.
  const std::string content(
      "\x04\x00\x80\x50\x00\xff\x4f\x00\x00\x80\x3c\x00\x01\x00\x00\x00\x04\x00\x00\x00\x90\x03\x00"
      "\x00\x00",
      25);
  const Block key = Key{0, corner_nodes(header, {-1, 2, 200})};
  EXPECT_EQ(content_of(key, Present_points(header), 3), content);
  EXPECT_EQ(number_at(bytes, 53, 4), content.size());
  const std::string end = bytes.substr(bytes.size() - 17);
  EXPECT_EQ(end.substr(0, 13), std::string("E\x07\0\0\0\0\0\0\0\0\0\0\0", 13));
}

TEST(Stream, points_that_go_on_as_before_cost_nearly_nothing) {
  const Stream_header header = header_of(1024, 1024, Chroma::mono);
  Key key = {0, corner_nodes(header)};
  for (int i = 0; i < 1000; ++i) key.points.push_back({{100 + 13 * i, 200 + i * i % 997}, {}});
  std::vector<Block> blocks = {key};
  Present_points present(header);
  present.follow(key);
  for (std::uint32_t i = 0; i < 4; ++i) {
    Group group;
    group.first = i;
    for (const auto& point : present.points()) {
      Node target = point.node;
      if (point.id >= number_of_corners) target.place.x += 21;
      group.targets.push_back(target);
    }
    present.follow(group);
    blocks.push_back(group);
  }
  const auto without = bytes_of(header, {blocks.front()}).size();
  EXPECT_LT(bytes_of(header, blocks).size(), without + 4 * 60);
}

// As docs/VIDEO.md has it: the last displacement times the length of the group over that of the
// last one, rounded towards zero.
TEST(Stream, a_point_is_expected_to_go_on_as_before) {
  const auto expected = [](Point_id id, std::uint32_t last_frames, std::uint32_t frames) {
    return Present_points::expected_place({id, {{100, 50}, {}}, {-7, 9}, last_frames}, frames,
                                          {3, -2});
  };
  EXPECT_EQ(expected(9, 4, 2), (Place{97, 54}));  // -3.5 and 4.5
  EXPECT_EQ(expected(9, 4, 4), (Place{93, 59}));
  EXPECT_EQ(expected(9, 4, 8), (Place{86, 68}));
  EXPECT_EQ(expected(9, 0, 2), (Place{103, 48})) << "it has just come, and takes the shift";
  EXPECT_EQ(expected(number_of_corners, 4, 2), (Place{97, 54}));
  EXPECT_EQ(expected(number_of_corners - 1, 4, 2), (Place{100, 50})) << "a corner rests";
}

TEST(Stream, a_stream_that_is_cut_off_is_read_up_to_there) {
  const Stream_header header = header_of(64, 48, Chroma::yuv444);
  const auto blocks = Random_blocks(header, 5)(12, 2, 3);
  const std::string bytes = bytes_of(header, blocks);
  const std::vector<std::size_t> ends = test::block_ends(bytes);
  ASSERT_EQ(ends.size(), blocks.size());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto read = read_all(bytes.substr(0, size));
    const auto whole = static_cast<std::size_t>(
        std::ranges::count_if(ends, [&](std::size_t end) { return end <= size; }));
    EXPECT_EQ(read.blocks,
              std::vector(blocks.begin(), blocks.begin() + static_cast<std::ptrdiff_t>(whole)));
    EXPECT_NE(read.error, "") << size;
    if (size < header_bytes) continue;
    const std::size_t begin = whole == 0 ? header_bytes : ends[whole - 1];
    const std::string place =
        "block " + std::to_string(whole) + ", at byte " + std::to_string(begin);
    EXPECT_NE(read.error.find(place), std::string::npos) << read.error;
  }
}

TEST(Stream, a_wrong_bit_anywhere_is_noticed) {
  const Stream_header header = header_of(64, 48, Chroma::mono);
  const auto blocks = Random_blocks(header, 6)(8, 1, 2);
  const std::string bytes = bytes_of(header, blocks);
  const std::vector<std::size_t> ends = test::block_ends(bytes);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(static_cast<unsigned char>(damaged[i]) ^ (1U << bit));
      const auto read = read_all(damaged);
      EXPECT_NE(read.error, "") << "byte " << i;
      // What comes before the damage is there.
      const auto whole = static_cast<std::size_t>(
          std::ranges::count_if(ends, [&](std::size_t end) { return end <= i; }));
      EXPECT_EQ(read.blocks.size(), whole);
    }
  }
  EXPECT_NE(read_all(bytes + "x").error.find("bytes come after the end"), std::string::npos);
}

// Checksums are right here: what is made up is refused for what it says, and nothing else happens.
TEST(Stream, made_up_content_is_refused) {
  const Stream_header header = header_of(64, 48, Chroma::mono);
  auto random = [engine = std::mt19937(7)]() mutable {
    return static_cast<std::uint32_t>(engine());
  };
  Present_points present(header);
  present.follow(Key{0, corner_nodes(header)});
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string content;
    for (std::uint32_t size = random() % 24; size > 0; --size) {
      content += static_cast<char>(random() % 3 == 0 ? random() % 256 : random() % 4);
    }
    for (const char type : {key_type, group_type, end_type}) {
      const auto block = block_of(type, random() % 3, content, present, 1);
      if (!block || !present.problem(*block).empty()) continue;
      Present_points next = present;
      next.follow(*block);
      ++accepted;
    }
  }
  EXPECT_GT(accepted, 0);
}

TEST(Stream, blocks_that_may_not_come_are_refused) {
  const Stream_header header = header_of(64, 48, Chroma::mono);
  const std::vector<Node> corners = corner_nodes(header);
  Present_points present(header);
  EXPECT_NE(present.problem(Key{1, corners}), "");
  EXPECT_NE(present.problem(Group{0, 1, {}, {}, corners}), "");
  EXPECT_NE(present.problem(End{1}), "");
  Key key = {0, corners};
  key.points.push_back({{100, 100}, {}});
  key.points.push_back({{200, 100}, {}});
  EXPECT_EQ(present.problem(key), "");
  present.follow(key);
  const std::vector<Node> targets = key.points;
  EXPECT_EQ(present.problem(Group{0, 2, {}, {}, targets}), "");
  EXPECT_NE(present.problem(Group{0, 3, {}, {}, targets}), "") << "no power of two";
  EXPECT_NE(present.problem(Group{1, 2, {}, {}, targets}), "") << "a gap";
  EXPECT_NE(present.problem(Group{0, 2, {}, {}, corners}), "") << "targets are missing";
  EXPECT_EQ(present.problem(Group{0, 2, {4, 5}, {}, corners}), "");
  EXPECT_NE(present.problem(Group{0, 2, {4, 6}, {}, corners}), "") << "there is no point 6";
  EXPECT_NE(present.problem(Group{0, 2, {5, 4}, {}, corners}), "") << "not ascending";
  EXPECT_NE(present.problem(Group{0, 2, {0}, {}, {targets.begin() + 1, targets.end()}}), "")
      << "a corner goes";
  std::vector<Node> moved = targets;
  moved[1].place.x -= 1;
  EXPECT_NE(present.problem(Group{0, 2, {}, {}, moved}), "") << "a corner moves";
  moved = targets;
  moved[4].place.x = header.right() + 1;
  EXPECT_NE(present.problem(Group{0, 2, {}, {}, moved}), "") << "outside";
  moved = targets;
  moved.push_back({{300, 100}, {}});
  EXPECT_EQ(present.problem(Group{0, 2, {}, {moved.back()}, moved}), "");
  moved.back() = targets[4];
  EXPECT_NE(present.problem(Group{0, 2, {}, {moved.back()}, moved}), "") << "two at one place";
  EXPECT_EQ(present.problem(Group{0, 2, {4}, {moved.back()}, targets}), "");
  // Two points may come to one place at the end; then one of them must go.
  moved = targets;
  moved[4] = moved[5];
  const Group meeting = {0, 2, {}, {}, moved};
  EXPECT_EQ(present.problem(meeting), "");
  present.follow(meeting);
  EXPECT_NE(present.problem(Group{2, 1, {}, {}, moved}), "");
  EXPECT_NE(present.problem(Key{1, corners}), "") << "before the end of the group";
  EXPECT_NE(present.problem(End{2}), "");
  EXPECT_EQ(present.problem(End{3}), "");
}

TEST(Stream, headers_that_cannot_be_used_say_why) {
  const Stream_header header = header_of(64, 48, Chroma::mono);
  const std::string bytes = bytes_of(header, {});
  EXPECT_NE(read_all("").error.find("it is empty"), std::string::npos);
  EXPECT_NE(read_all("YUV4MPEG2").error.find("does not begin as a stream"), std::string::npos);
  std::string newer = bytes;
  newer[8] = 2;
  EXPECT_NE(read_all(newer).error.find("version 2; expected 1"), std::string::npos);
}

}  // namespace
}  // namespace kinetri::video::stream_test
