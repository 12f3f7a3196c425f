// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/stream/block_bytes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "kinetri/impl/io/checksum.h"

namespace kinetri::video {
namespace {

// Variable-length numbers (LEB128): seven bits a byte, the lowest first; the highest bit of a byte
// means that more follow. Signed numbers are mapped to 0, 1, 2, ... in the order 0, -1, 1, -2, 2,
// ...
class Number_writer {
 public:
  void add(std::uint32_t number) {
    while (number >= 128) {
      bytes_ += static_cast<char>(number % 128 + 128);
      number /= 128;
    }
    bytes_ += static_cast<char>(number);
  }
  void add_signed(std::int32_t number) {
    const auto bits = static_cast<std::uint32_t>(number);
    add(number < 0 ? ~(bits << 1U) : bits << 1U);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Reads numbers. After one that is missing or too large, all are 0, and `is_good` is false.
class Number_reader {
 public:
  explicit Number_reader(std::string_view bytes) : bytes_(bytes) {}

  std::uint32_t next() {
    std::uint32_t result = 0;
    for (unsigned shift = 0; shift < 35 && !bytes_.empty(); shift += 7) {
      const auto byte = static_cast<std::uint8_t>(bytes_.front());
      bytes_.remove_prefix(1);
      const std::uint32_t bits = byte % 128U;
      if (shift == 28 && bits >= 16) break;
      result |= bits << shift;
      if (byte < 128) return result;
    }
    is_good_ = false;
    bytes_ = {};
    return 0;
  }
  std::int32_t next_signed() {
    const std::uint32_t number = next();
    const auto half = static_cast<std::int32_t>(number >> 1U);
    return number % 2 == 0 ? half : -half - 1;
  }
  // Reads a number of elements that take at least a byte each.
  std::size_t next_count() {
    const std::uint32_t number = next();
    if (number <= bytes_.size()) return number;
    is_good_ = false;
    return 0;
  }
  bool is_good() const { return is_good_; }
  bool is_at_end() const { return is_good_ && bytes_.empty(); }
  void refuse() { is_good_ = false; }

 private:
  std::string_view bytes_;
  bool is_good_ = true;
};

std::int32_t sum(Number_reader& in, std::int32_t expected, std::int64_t lower, std::int64_t upper) {
  const std::int64_t result = std::int64_t{expected} + in.next_signed();
  if (result >= lower && result <= upper) return static_cast<std::int32_t>(result);
  in.refuse();
  return 0;
}
std::int32_t coordinate(Number_reader& in, std::int32_t expected) {
  constexpr std::int64_t outside = 255 << most_place_bits;
  return sum(in, expected, -outside, (std::int64_t{greatest_size} << most_place_bits) + outside);
}
std::int16_t color(Number_reader& in, std::int16_t expected) {
  using Limits = std::numeric_limits<std::int16_t>;
  return static_cast<std::int16_t>(sum(in, expected, Limits::min(), Limits::max()));
}

// Adds new points, each as the difference to the previous one.
void add_nodes(Number_writer& out, const std::vector<Node>& nodes, std::size_t planes) {
  Place place;
  for (const Node& node : nodes) {
    out.add_signed(node.place.x - place.x);
    place.x = node.place.x;
  }
  for (const Node& node : nodes) {
    out.add_signed(node.place.y - place.y);
    place.y = node.place.y;
  }
  for (std::size_t plane = 0; plane < planes; ++plane) {
    std::int32_t before = 0;
    for (const Node& node : nodes) {
      out.add_signed(node.colors[plane] - before);
      before = node.colors[plane];
    }
  }
}

std::vector<Node> read_nodes(Number_reader& in, std::size_t planes) {
  std::vector<Node> nodes(in.next_count());
  Place place;
  for (Node& node : nodes) place.x = node.place.x = coordinate(in, place.x);
  for (Node& node : nodes) place.y = node.place.y = coordinate(in, place.y);
  for (std::size_t plane = 0; plane < planes; ++plane) {
    std::int16_t before = 0;
    for (Node& node : nodes) before = node.colors[plane] = color(in, before);
  }
  return nodes;
}

// The median step of the points other than corners, which is the expected step of new points.
Place median_step(const std::vector<Present_points::Point>& points,
                  const std::vector<Node>& targets) {
  std::vector<std::int32_t> xs;
  std::vector<std::int32_t> ys;
  for (std::size_t i = number_of_corners; i < points.size(); ++i) {
    xs.push_back(targets[i].place.x - points[i].node.place.x);
    ys.push_back(targets[i].place.y - points[i].node.place.y);
  }
  if (xs.empty()) return {};
  const auto median = [](std::vector<std::int32_t>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
  };
  return {median(xs), median(ys)};
}

std::string content(const Key& key, std::size_t planes) {
  Number_writer out;
  out.add(static_cast<std::uint32_t>(key.points.size()));
  add_nodes(out, key.points, planes);
  return out.take();
}

std::string content(const Group& group, const Present_points& present, std::size_t planes) {
  Number_writer out;
  out.add(static_cast<std::uint32_t>(std::countr_zero(group.frames)));
  out.add(static_cast<std::uint32_t>(group.erased.size()));
  Point_id before = 0;
  for (const Point_id id : group.erased) {
    out.add(id - before);
    before = id;
  }
  out.add(static_cast<std::uint32_t>(group.inserted.size()));
  add_nodes(out, group.inserted, planes);
  const auto points = present.at_begin_of(group);
  const Place shift = median_step(points, group.targets);
  out.add_signed(shift.x);
  out.add_signed(shift.y);
  std::vector<Place> expected;
  for (const auto& point : points) {
    expected.push_back(Present_points::expected_place(point, group.frames, shift));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    out.add_signed(group.targets[i].place.x - expected[i].x);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    out.add_signed(group.targets[i].place.y - expected[i].y);
  }
  for (std::size_t plane = 0; plane < planes; ++plane) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      out.add_signed(group.targets[i].colors[plane] - points[i].node.colors[plane]);
    }
  }
  return out.take();
}

std::optional<Block> group_of(std::uint32_t frame, Number_reader& in, const Present_points& present,
                              std::size_t planes) {
  Group group;
  group.first = frame;
  const std::uint32_t exponent = in.next();
  if (exponent > static_cast<std::uint32_t>(std::countr_zero(most_group_frames))) return {};
  group.frames = 1U << exponent;
  group.erased.resize(in.next_count());
  Point_id before = 0;
  for (Point_id& id : group.erased) {
    const std::uint32_t difference = in.next();
    if (difference > no_point - before) return {};
    id = before = before + difference;
  }
  if (!std::ranges::is_sorted(group.erased, std::less_equal())) return {};
  group.inserted = read_nodes(in, planes);
  const std::int32_t limit = std::numeric_limits<std::int32_t>::max() / 4;
  Place shift = {in.next_signed(), in.next_signed()};
  if (!in.is_good() || shift.x > limit || shift.x < -limit || shift.y > limit || shift.y < -limit ||
      present.points().size() + group.inserted.size() > most_points) {
    return {};
  }
  const auto points = present.at_begin_of(group);
  group.targets.resize(points.size());
  std::vector<Place> expected;
  for (const auto& point : points) {
    expected.push_back(Present_points::expected_place(point, group.frames, shift));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    group.targets[i].place.x = coordinate(in, expected[i].x);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    group.targets[i].place.y = coordinate(in, expected[i].y);
  }
  for (std::size_t plane = 0; plane < planes; ++plane) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      group.targets[i].colors[plane] = color(in, points[i].node.colors[plane]);
    }
  }
  if (!in.is_at_end()) return {};
  return group;
}

}  // namespace

void append_number(std::string& bytes, std::uint64_t number, unsigned size) {
  for (unsigned i = 0; i < size; ++i) {
    bytes += static_cast<char>(static_cast<std::uint8_t>(number >> (8 * i)));
  }
}

std::uint64_t number_at(std::string_view bytes, std::size_t position, unsigned size) {
  std::uint64_t result = 0;
  for (unsigned i = 0; i < size; ++i) {
    result |= std::uint64_t{static_cast<std::uint8_t>(bytes[position + i])} << (8 * i);
  }
  return result;
}

std::uint32_t checksum(std::string_view bytes) {
  Checksum result;
  result.add(bytes);
  return result.crc32();
}

std::string content_of(const Block& block, const Present_points& points, std::size_t planes) {
  if (const Key* key = std::get_if<Key>(&block)) return content(*key, planes);
  if (const Group* group = std::get_if<Group>(&block)) return content(*group, points, planes);
  return {};
}

std::optional<Block> block_of(char type, std::uint32_t frame, std::string_view content,
                              const Present_points& points, std::size_t planes) {
  Number_reader in(content);
  if (type == key_type) {
    Key key = {frame, read_nodes(in, planes)};
    if (in.is_at_end()) return key;
  } else if (type == group_type) {
    return group_of(frame, in, points, planes);
  } else if (type == end_type && content.empty()) {
    return End{frame};
  }
  return {};
}

}  // namespace kinetri::video
