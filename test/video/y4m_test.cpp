// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/formats/y4m.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "support/directory_test.h"
#include "support/message_of.h"

namespace kinetri::video::y4m_test {
namespace {

using kinetri::test::message_of;
using kinetri::test::read_file;

class Y4m_test : public kinetri::test::Directory_test {
 protected:
  static std::string problem_of(const std::string& text) {
    return message_of<Input_error>([&] {
      std::istringstream in(text);
      const auto source = read_y4m(in, "clip");
      Frame frame;
      while (source->read(frame)) {
      }
    });
  }
};

Frame random_frame(const Video_format& format, std::mt19937& random) {
  Frame frame = black_frame(format);
  for (auto& plane : frame.planes) {
    for (auto& sample : plane) sample = static_cast<std::uint8_t>(random());
  }
  return frame;
}

TEST_F(Y4m_test, what_is_written_is_read_for_all_kinds_of_color_and_odd_sizes) {
  std::mt19937 random(1);
  for (const Chroma chroma : {Chroma::mono, Chroma::yuv444, Chroma::yuv422, Chroma::yuv420_jpeg,
                              Chroma::yuv420_mpeg2, Chroma::yuv420_paldv}) {
    for (const auto& [width, height] : {std::array{1U, 1U}, {4U, 2U}, {5U, 3U}, {2U, 7U}}) {
      const Video_format format = {width, height, chroma, width % 2 == 0, {30000, 1001}, {16, 11}};
      std::vector<Frame> frames;
      for (int i = 0; i < 3; ++i) frames.push_back(random_frame(format, random));
      const auto sink = create_y4m(file("a.y4m"), format);
      for (const Frame& frame : frames) sink->write(frame);
      EXPECT_EQ(entries().size(), 1U) << "a temporary";
      sink->commit();
      EXPECT_EQ(entries(), kinetri::test::Entries{"a.y4m"});
      const auto source = open_y4m(file("a.y4m"));
      EXPECT_EQ(source->format(), format);
      Frame frame;
      for (const Frame& expected : frames) {
        ASSERT_TRUE(source->read(frame));
        EXPECT_EQ(frame, expected);
      }
      EXPECT_FALSE(source->read(frame));
      std::filesystem::remove(file("a.y4m"));
    }
  }
}

TEST_F(Y4m_test, samples_are_read_plane_by_plane_from_the_top) {
  std::istringstream in("YUV4MPEG2 W3 H2 F25:1 C420jpeg\nFRAME Ip\nabcdefghij");
  const auto source = read_y4m(in, "clip");
  Frame frame;
  ASSERT_TRUE(source->read(frame));
  EXPECT_EQ(frame.planes[0], (std::vector<std::uint8_t>{'a', 'b', 'c', 'd', 'e', 'f'}));
  EXPECT_EQ(frame.planes[1], (std::vector<std::uint8_t>{'g', 'h'}));
  EXPECT_EQ(frame.planes[2], (std::vector<std::uint8_t>{'i', 'j'}));
  EXPECT_FALSE(source->format().is_full_range);
}

TEST_F(Y4m_test, the_color_of_a_header_without_one_is_420) {
  std::istringstream in("YUV4MPEG2 W2 H2 F25:1 XCOLORRANGE=FULL\nFRAME\nabcdef");
  const auto source = read_y4m(in, "clip");
  EXPECT_EQ(source->format().chroma, Chroma::yuv420_jpeg);
  EXPECT_TRUE(source->format().is_full_range);
}

TEST_F(Y4m_test, what_cannot_be_used_is_refused_with_the_reason) {
  const std::string begin = "YUV4MPEG2 W2 H2 F25:1 Cmono";
  const std::array<std::array<std::string, 2>, 17> cases = {{
      {"", "clip: it is empty"},
      {"RIFF", "does not begin with YUV4MPEG2"},
      {"YUV4MPEG21 W2 H2 F1:1\n", "does not begin with YUV4MPEG2"},
      {begin + "\n", "there is no frame"},
      {begin + "\nFRAME\nabc", "frame 0 is cut off after 3 bytes; expected 4"},
      {begin + "\nFRAME\nabcdFRAME\n", "frame 1 is cut off after 0 bytes; expected 4"},
      {begin + "\nFRAME\nabcdeFRAME\nabcd", "frame 1 does not begin with FRAME"},
      {"YUV4MPEG2 W2 H2 F25:1 C420p10\nFRAME\n", "more than 8 bits (C420p10)"},
      {"YUV4MPEG2 W2 H2 F25:1 Cmono16\nFRAME\n", "more than 8 bits (Cmono16)"},
      {"YUV4MPEG2 W2 H2 F25:1 C411\nFRAME\n", "C411 is not known"},
      {"YUV4MPEG2 W2 H2 F25:1 C444alpha\nFRAME\n", "transparent"},
      {"YUV4MPEG2 W2 H2 F25:1 It\nFRAME\n", "interlaced"},
      {"YUV4MPEG2 W0 H2 F25:1\nFRAME\n", "W0; expected a size from 1 to 16384"},
      {"YUV4MPEG2 W2 H99999 F25:1\nFRAME\n", "H99999"},
      {"YUV4MPEG2 W2 F25:1\nFRAME\n", "does not say the size"},
      {"YUV4MPEG2 W2 H2\nFRAME\n", "does not say the frame rate"},
      {"YUV4MPEG2 W2 H2 F0:1\nFRAME\n", "the frame rate is '0:1'"},
  }};
  for (const auto& [text, expected] : cases) {
    EXPECT_NE(problem_of(text).find(expected), std::string::npos)
        << problem_of(text) << "\n should say: " << expected;
  }
  EXPECT_NE(problem_of("YUV4MPEG2 W2" + std::string(5000, ' ')).find("a line has more than"),
            std::string::npos);
}

TEST_F(Y4m_test, a_file_that_is_not_there_is_named) {
  EXPECT_NE(message_of<Input_error>([&] { open_y4m(file("none")); }).find("No such file"),
            std::string::npos);
}

TEST_F(Y4m_test, a_full_disk_is_an_error) {
  const Video_format format = {64, 64, Chroma::mono, true, {25, 1}, {1, 1}};
  const auto message = message_of<Output_error>([&] {
    const auto sink = create_y4m("/dev/full", format);
    for (int i = 0; i < 100; ++i) sink->write(black_frame(format));
    sink->commit();
  });
  EXPECT_NE(message.find("/dev/full"), std::string::npos) << message;
}

TEST_F(Y4m_test, samples_of_color_are_where_the_tag_says) {
  Video_format format = {8, 6, Chroma::yuv420_jpeg, true, {25, 1}, {1, 1}};
  EXPECT_EQ(format.grid(0, format).place(0, 0), (Vector_2{0.5, 0.5}));
  EXPECT_EQ(format.grid(1, format).place(1, 2), (Vector_2{3, 5}));
  format.chroma = Chroma::yuv420_mpeg2;
  EXPECT_EQ(format.grid(1, format).place(1, 2), (Vector_2{2.5, 5}));
  format.chroma = Chroma::yuv420_paldv;
  EXPECT_EQ(format.grid(1, format).place(1, 2), (Vector_2{2.5, 4.5}));
  format.chroma = Chroma::yuv422;
  EXPECT_EQ(format.grid(2, format).place(1, 2), (Vector_2{2.5, 2.5}));
  // Shown at twice the size, the same picture has half the steps.
  Video_format large = format;
  large.width *= 2;
  large.height *= 2;
  EXPECT_EQ(large.grid(0, format).place(1, 0), (Vector_2{0.75, 0.25}));
}

}  // namespace
}  // namespace kinetri::video::y4m_test
