// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/formats/png_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "support/directory_test.h"
#include "support/message_of.h"

namespace kinetri::video::png_folder_test {
namespace {

namespace fs = std::filesystem;
using kinetri::test::message_of;

class Png_folder_test : public kinetri::test::Directory_test {
 protected:
  void write(const std::string& folder, const Video_format& format,
             const std::vector<Frame>& frames) {
    const auto sink = create_png_folder(file(folder), format);
    for (const Frame& frame : frames) sink->write(frame);
    sink->commit();
  }
};

Video_format format_of(Chroma chroma, bool is_full_range = true) {
  return {6, 4, chroma, is_full_range, {25, 1}, {1, 1}};
}

TEST_F(Png_folder_test, gray_frames_come_back_as_they_are_in_the_order_of_names) {
  std::mt19937 random(1);
  const Video_format format = format_of(Chroma::mono);
  std::vector<Frame> frames;
  for (int i = 0; i < 12; ++i) {
    frames.push_back(black_frame(format));
    for (auto& sample : frames.back().planes[0]) sample = static_cast<std::uint8_t>(random());
  }
  write("a", format, frames);
  const auto source = open_png_folder(file("a"), {25, 1});
  EXPECT_EQ(source->format(), format);
  Frame frame;
  for (const Frame& expected : frames) {
    ASSERT_TRUE(source->read(frame));
    EXPECT_EQ(frame, expected);
  }
  EXPECT_FALSE(source->read(frame));
}

TEST_F(Png_folder_test, files_are_in_the_order_of_the_numbers_in_their_names) {
  const Video_format format = format_of(Chroma::mono);
  std::vector<Frame> frames;
  for (int i = 0; i < 12; ++i) {
    frames.push_back(black_frame(format));
    for (auto& sample : frames.back().planes[0]) sample = static_cast<std::uint8_t>(20 * i);
  }
  write("a", format, frames);
  for (const auto& [prefix, ending] :
       {std::pair{"frame", ".png"}, {"Img 1-", "b.png"}, {"", ".png"}, {"7x", "-2.png"}}) {
    SCOPED_TRACE(prefix);
    const auto folder = std::filesystem::path(file(std::string("of ") + prefix));
    std::filesystem::create_directory(folder);
    for (int i = 0; i < 12; ++i) {
      const std::string number = std::to_string(i);
      const std::string padded = "000" + std::string(i < 10 ? "0" : "") + number + ".png";
      std::filesystem::copy_file(std::filesystem::path(file("a")) / padded,
                                 folder / (prefix + number + ending));
    }
    const auto source = open_png_folder(folder.string(), {25, 1});
    Frame frame;
    for (const Frame& expected : frames) {
      ASSERT_TRUE(source->read(frame));
      EXPECT_EQ(frame, expected);
    }
  }
}

// The formulas of JFIF in binary64 arithmetic.
TEST_F(Png_folder_test, colors_are_those_of_jfif_and_come_back) {
  for (int r = 0; r < 256; r += 15) {
    for (int g = 0; g < 256; g += 15) {
      for (int b = 0; b < 256; b += 15) {
        const std::array<std::uint8_t, 3> rgb = {static_cast<std::uint8_t>(r),
                                                 static_cast<std::uint8_t>(g),
                                                 static_cast<std::uint8_t>(b)};
        const auto ycbcr = ycbcr_of(rgb);
        const double y = 0.299 * r + 0.587 * g + 0.114 * b;
        const std::array<double, 3> exact = {y, 128 + (b - y) / 1.772, 128 + (r - y) / 1.402};
        const auto back = rgb_of(ycbcr, true);
        for (std::size_t i = 0; i < 3; ++i) {
          EXPECT_LE(std::abs(ycbcr[i] - std::min(exact[i], 255.0)), 0.51);
          EXPECT_LE(std::abs(back[i] - rgb[i]), 2);
        }
      }
    }
  }
}

TEST_F(Png_folder_test, limited_range_is_widened_and_few_samples_of_color_stand_for_more) {
  const Video_format format = format_of(Chroma::yuv420_jpeg, false);
  Frame frame = black_frame(format);
  frame.planes[0].assign(frame.planes[0].size(), 235);
  write("white", format, {frame});
  const auto source = open_png_folder(file("white"), {25, 1});
  EXPECT_EQ(source->format().chroma, Chroma::yuv444);
  Frame read;
  ASSERT_TRUE(source->read(read));
  for (const auto sample : read.planes[0]) EXPECT_EQ(sample, 255);
  for (const auto sample : read.planes[1]) EXPECT_EQ(sample, 128);
}

TEST_F(Png_folder_test, what_cannot_be_used_is_refused_with_the_reason) {
  const auto problem = [&](const std::string& folder) {
    return message_of<Input_error>([&] {
      const auto source = open_png_folder(file(folder), {25, 1});
      Frame frame;
      while (source->read(frame)) {
      }
    });
  };
  fs::create_directory(file("empty"));
  EXPECT_NE(problem("empty").find("there is no file *.png"), std::string::npos);
  const Video_format format = format_of(Chroma::mono);
  write("sizes", format, {black_frame(format)});
  Video_format larger = format;
  larger.width = 9;
  write("other", larger, {black_frame(larger)});
  fs::copy(file("other/00000.png"), file("sizes/00001.png"));
  EXPECT_NE(problem("sizes").find("00001.png: it has 9 x 4 pixels; expected 6 x 4, as"),
            std::string::npos)
      << problem("sizes");
  kinetri::test::write_file(file("other/00000.png"), "no picture");
  EXPECT_NE(problem("other").find("cannot be read"), std::string::npos);
}

TEST_F(Png_folder_test, a_folder_appears_only_when_it_is_whole) {
  const Video_format format = format_of(Chroma::mono);
  {
    const auto sink = create_png_folder(file("a"), format);
    sink->write(black_frame(format));
    EXPECT_FALSE(fs::exists(file("a")));
  }
  EXPECT_TRUE(entries().empty());
  kinetri::test::write_file(file("b"), "");
  EXPECT_FALSE(message_of<Output_error>([&] { create_png_folder(file("b"), format); }).empty());
}

}  // namespace
}  // namespace kinetri::video::png_folder_test
