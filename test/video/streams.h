// SPDX-License-Identifier: GPL-3.0-or-later
//
// Streams for tests: random ones, and their bytes.
#ifndef KINETRI_TEST_VIDEO_STREAMS_H
#define KINETRI_TEST_VIDEO_STREAMS_H

#include <algorithm>
#include <cstdint>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "video/stream/stream_reader.h"
#include "video/stream/stream_writer.h"

namespace kinetri::video::test {

inline std::string bytes_of(const Stream_header& header, const std::vector<Block>& blocks) {
  std::ostringstream out;
  Stream_writer writer(out, header);
  for (const Block& block : blocks) writer.write(block);
  return out.str();
}

/// What can be read of the bytes, and the error after that; empty if there is none.
struct Read_stream {
  std::vector<Block> blocks;
  std::string error;
};
inline Read_stream read_all(const std::string& bytes) {
  Read_stream result;
  std::istringstream in(bytes);
  try {
    Stream_reader reader(in, "stream");
    while (const auto block = reader.read()) result.blocks.push_back(*block);
  } catch (const Input_error& error) {
    result.error = error.what();
  }
  return result;
}

inline std::vector<Node> corner_nodes(const Stream_header& header, const Colors& colors = {}) {
  std::vector<Node> result;
  for (const Place& place : header.corners()) result.push_back({place, colors});
  return result;
}

/// Points that move, come and go at random, also across each other and along the border.
class Random_blocks {
 public:
  Random_blocks(const Stream_header& header, unsigned seed) : header_(header), random_(seed) {}

  std::vector<Block> operator()(std::size_t points, int segments, int groups) {
    std::vector<Block> result;
    Present_points present(header_);
    const auto add = [&](const Block& block) {
      present.follow(block);
      result.push_back(block);
    };
    for (int segment = 0; segment < segments; ++segment) {
      Key key = {segment == 0 ? 0 : present.time() + below(3), corner_nodes(header_)};
      taken_.clear();
      for (const Node& node : key.points) taken_.insert(node.place);
      for (Node& node : key.points) node.colors = colors();
      while (key.points.size() < points) key.points.push_back(new_node());
      add(key);
      for (int i = 0; i < groups; ++i) add(group(present));
    }
    add(End{present.time() + 1 + below(3)});
    return result;
  }

 private:
  std::uint32_t below(std::uint32_t limit) {
    return static_cast<std::uint32_t>(std::uint64_t{random_()} * limit >> 32U);
  }
  Place place() {
    return {coordinate(header_.left(), header_.right()),
            coordinate(header_.top(), header_.bottom())};
  }
  std::int32_t coordinate(std::int32_t least, std::int32_t most) {
    return least + static_cast<std::int32_t>(below(static_cast<std::uint32_t>(most - least) + 1));
  }
  Colors colors() {
    Colors result = {};
    for (std::size_t p = 0; p < header_.format.planes(); ++p) {
      result[p] = static_cast<std::int16_t>(below(256 * 8 / header_.color_step));
    }
    return result;
  }
  Node new_node() {
    Node node;
    do {
      node = {place(), colors()};
    } while (!taken_.insert(node.place).second);
    return node;
  }

  Group group(const Present_points& present) {
    Group result;
    result.first = present.time();
    result.frames = 1U << below(4);
    taken_.clear();
    // Where points have come to one place, all but the first go.
    for (const auto& point : present.points()) {
      const bool is_first = taken_.insert(point.node.place).second;
      if (point.id >= number_of_corners && (!is_first || below(8) == 0)) {
        result.erased.push_back(point.id);
      }
    }
    for (std::uint32_t i = below(6); i > 0; --i) result.inserted.push_back(new_node());
    for (const auto& point : present.at_begin_of(result)) {
      Node target = {point.node.place, colors()};
      if (point.id >= number_of_corners && below(4) != 0) {
        target.place = place();
      }
      result.targets.push_back(target);
    }
    return result;
  }

  Stream_header header_;
  std::mt19937 random_;
  std::set<Place> taken_;
};

}  // namespace kinetri::video::test

#endif  // KINETRI_TEST_VIDEO_STREAMS_H
