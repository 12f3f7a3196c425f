// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <variant>

#include "cli/text.h"
#include "kinetri/impl/io/text.h"
#include "video/codec/moving_picture.h"
#include "video/program/commands.h"
#include "video/stream/stream_reader.h"

namespace kinetri::video {
namespace {

using app::Command;

// Statistics of a stream.
class Summary {
 public:
  explicit Summary(const Stream_header& header) : header_(header), picture_(header) {}

  void follow(const Block& block) {
    if (const Key* key = std::get_if<Key>(&block)) {
      picture_.begin(*key);
      ++keys_;
      points_ += key->points.size();
      most_ = std::max(most_, key->points.size());
    } else if (const Group* group = std::get_if<Group>(&block)) {
      picture_.begin(*group);
      picture_.advance_to(static_cast<double>(group->last()));
      ++groups_;
      inserted_ += group->inserted.size();
      erased_ += group->erased.size();
      most_ = std::max(most_, group->targets.size());
    } else {
      frames_ = std::get<End>(block).frames;
    }
  }

  std::string text(std::uint64_t bytes) const {
    const Video_format& format = header_.format;
    const double seconds =
        static_cast<double>(frames_) * format.rate.denominator / format.rate.numerator;
    const double pixels = static_cast<double>(format.width) * format.height * frames_;
    return joined(
        "size      ", format.width, " x ", format.height, "\nrate      ", format.rate.numerator,
        ":", format.rate.denominator, " frames a second\nframes    ", frames_, " (",
        app::significant(seconds, 4), " s)\nkeys      ", keys_, "\ngroups    ", groups_,
        "\npoints    ", most_, " at one time, at most; ", points_, " in keys, ", inserted_,
        " come later, ", erased_, " go\nevents    ", picture_.events(), "\nbytes     ", bytes, " (",
        app::significant(8.0 * static_cast<double>(bytes) / pixels, 4), " bits per pixel)\n");
  }

 private:
  Stream_header header_;
  Moving_picture picture_;
  std::uint32_t frames_ = 0;
  std::uint64_t keys_ = 0;
  std::uint64_t groups_ = 0;
  std::uint64_t points_ = 0;
  std::uint64_t inserted_ = 0;
  std::uint64_t erased_ = 0;
  std::size_t most_ = 0;
};

}  // namespace

Command info_command() {
  const auto input = std::make_shared<std::string>();
  Command result;
  result.name = "info";
  result.summary = "Show the numbers of frames, points, events and bytes of a stream";
  result.add_required("IN", input.get(), "FILE", "The stream (.kvd), - for standard input");
  result.description = {
      "Events are those of the exact triangulation, mostly flips, which the command executes to "
      "count them.",
      "Exit codes: see kinetri-video encode."};
  result.examples = {"kinetri-video info clip.kvd"};
  result.run = [input](const Command& /*program*/) {
    Stream_reader stream = Stream_reader::open(*input);
    Summary summary(stream.header());
    while (const auto block = stream.read()) summary.follow(*block);
    std::cout << summary.text(stream.bytes());
    return app::Exit_code::done;
  };
  return result;
}

}  // namespace kinetri::video
