// SPDX-License-Identifier: GPL-3.0-or-later
//
// What kinetri-video reads. Contents of blocks are changed by bytes: each is refused, or can be
// drawn at all times up to its end. Any bytes as a stream, as Y4M and as a PNG file are refused, or
// give frames of the size that their header says.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "fuzz/fuzz.h"
#include "kinetri/base/error.h"
#include "video/codec/decoder.h"
#include "video/formats/png_folder.h"
#include "video/formats/y4m.h"
#include "video/stream/block_bytes.h"
#include "video/streams.h"

namespace kinetri::video {
namespace {

using kinetri::test::Fuzz_input;
using kinetri::test::require;

Stream_header header() {
  return {{12, 9, Chroma::yuv420_jpeg, false, {25, 1}, {1, 1}}, 2, 8, 3};
}

const std::vector<Block>& original() {
  static const std::vector<Block> blocks = test::Random_blocks(header(), 1)(9, 2, 2);
  return blocks;
}

void change_contents(Fuzz_input& input) {
  Present_points present(header());
  Moving_picture picture(header());
  Frame frame;
  const auto changed_block = static_cast<std::size_t>(input.byte()) % original().size();
  for (std::size_t i = 0; i < original().size(); ++i) {
    Block block = original()[i];
    if (std::holds_alternative<End>(block)) break;
    // Blocks after a change may not fit any more.
    if (!present.problem(block).empty()) break;
    if (i == changed_block) {
      const bool is_key = std::holds_alternative<Key>(block);
      const std::uint32_t begin =
          is_key ? std::get<Key>(block).frame : std::get<Group>(block).first;
      std::string content = content_of(block, present, 3);
      for (int k = input.integer(0, 3); k >= 0; --k) {
        content[(256U * input.byte() + input.byte()) % content.size()] =
            static_cast<char>(input.byte());
      }
      const auto changed = block_of(is_key ? key_type : group_type, begin, content, present, 3);
      if (!changed || !present.problem(*changed).empty()) return;
      block = *changed;
    }
    present.follow(block);
    if (const Key* key = std::get_if<Key>(&block)) {
      picture.begin(*key);
    } else {
      picture.begin(std::get<Group>(block));
      picture.advance_to(static_cast<double>(std::get<Group>(block).last()));
    }
    picture.draw(header().format, Interpolation::linear, frame);
  }
}

void read_stream(const std::string& bytes) {
  static const std::string whole = test::bytes_of(header(), original());
  std::istringstream in(whole.substr(0, header_bytes) + bytes);
  Decoded decoded;
  try {
    Stream_reader stream(in, "input");
    decode(
        stream, {}, [](const Frame&) {}, decoded);
  } catch (const Input_error&) {
  }
}

void read_frames(Frame_source& source) {
  Frame frame;
  while (source.read(frame)) {
    require(frame.planes[0].size() == std::size_t{source.format().width} * source.format().height,
            "a frame has another size than the header says");
  }
}

void read_y4m_video(const std::string& bytes) {
  std::istringstream in("YUV4MPEG2" + bytes);
  try {
    read_frames(*read_y4m(in, "input"));
  } catch (const Input_error&) {
  }
}

void read_png(const std::string& bytes) {
  std::filesystem::create_directory("frames");
  std::ofstream("frames/a.png", std::ios::binary) << bytes;
  try {
    read_frames(*open_png_folder("frames", {25, 1}));
  } catch (const Input_error&) {
  }
}

}  // namespace
}  // namespace kinetri::video

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kinetri::test::Fuzz_input input(data, size);
  const int kind = input.integer(0, 7);
  const std::string rest(data + (size - input.left()), data + size);
  if (kind < 4) {
    kinetri::video::change_contents(input);
  } else if (kind < 6) {
    kinetri::video::read_y4m_video(rest);
  } else if (kind == 6) {
    kinetri::video::read_stream(rest);
  } else {
    kinetri::video::read_png(rest);
  }
  return 0;
}
