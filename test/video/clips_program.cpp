// SPDX-License-Identifier: GPL-3.0-or-later
//
// The known clips for programs (bench/run_video.py): writes one as Y4M, or says how far the points
// of its stream are from where its texture goes.
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "video/formats/y4m.h"
#include "video/known_clips.h"
#include "video/stream/stream_reader.h"

namespace {

using namespace kinetri::video;  // NOLINT(google-build-using-namespace): the program is a test's

constexpr std::string_view usage =
    "usage: kinetri_video_clips write CLIP WIDTH HEIGHT FRAMES OUT.y4m\n"
    "       kinetri_video_clips errors CLIP WIDTH HEIGHT FRAMES STREAM.kvd [STEP]\n"
    "CLIP: translation, rotation, layers, cut or fade. `errors` prints the number of points in "
    "all\n"
    "groups, and the median and nine tenths of how far they are off, in pixels; frame n of the "
    "stream\n"
    "is frame n * STEP of the clip.\n";

int run(const std::vector<std::string>& words) {
  if (words.size() < 6 || words.size() > 7) return std::cerr << usage, 2;
  const auto width = static_cast<std::uint32_t>(std::stoul(words[2]));
  const auto height = static_cast<std::uint32_t>(std::stoul(words[3]));
  const int frames = std::stoi(words[4]);
  const auto clips = test::known_clips(width, height, frames);
  const auto clip = std::ranges::find(clips, words[1], &test::Known_clip::name);
  if (clip == clips.end()) return std::cerr << usage, 2;
  if (words[0] == "write") {
    const Video_format format = test::gray_format(width, height);
    const auto sink = create_y4m(words[5], format);
    for (int t = 0; t < frames; ++t) sink->write(test::frame_of(format, clip->scene, t));
    sink->commit();
    return 0;
  }
  Stream_reader stream = Stream_reader::open(words[5]);
  std::vector<Block> blocks;
  while (auto block = stream.read()) blocks.push_back(std::move(*block));
  const int step = words.size() == 7 ? std::stoi(words[6]) : 1;
  const auto errors = test::correspondence_errors(stream.header(), blocks, *clip, step);
  if (errors.empty()) return std::cerr << "there are no groups\n", 2;
  std::cout << errors.size() << ' ' << errors[errors.size() / 2] << ' '
            << errors[errors.size() * 9 / 10] << '\n';
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
