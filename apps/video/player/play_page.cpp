// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/player/play_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <ostream>
#include <vector>

#include "kinetri/impl/io/bytes.h"
#include "kinetri/impl/io/json_writer.h"
#include "kinetri/simulation/recording.h"
#include "video/codec/moving_picture.h"
#include "video/player/player_assets.h"

namespace kinetri::video {
namespace {

// More than any run has, so that recordings are not thinned.
constexpr std::size_t most_rows = std::size_t{1} << 40U;
// After the end of every stream.
constexpr double last_time = 0x1p33;

class Page_data {
 public:
  explicit Page_data(const Stream_header& header)
      : header_(header), picture_(header), points_(header), json_(text_) {
    json_.begin_object();
    json_.member("width", header.format.width);
    json_.member("height", header.format.height);
    json_.member("unit", std::ldexp(1.0, -static_cast<int>(header.place_bits)));
    json_.key("rate");
    json_.begin_list();
    json_.value(header.format.rate.numerator);
    json_.value(header.format.rate.denominator);
    json_.end_list();
    json_.key("segments");
    json_.begin_list();
  }

  void follow(const Block& block) {
    if (const Key* key = std::get_if<Key>(&block)) {
      end_segment();
      picture_.begin(*key);
      recorder_.emplace(picture_.triangulation(), last_time, most_rows);
      picture_.add_observer(*recorder_);
      begin_ = key->frame;
      json_.begin_object();
      json_.member("begin", begin_);
      json_.key("groups");
      json_.begin_list();
      points_.follow(block);
      // A group for a key that no group follows.
      add_group(begin_, begin_, points_.points(), key->points);
    } else if (const Group* group = std::get_if<Group>(&block)) {
      picture_.begin(*group);
      add_group(group->first, group->last(), points_.at_begin_of(*group), group->targets);
      points_.follow(block);
    } else {
      end_segment();
      json_.end_list();
      json_.member("frames", std::get<End>(block).frames);
    }
  }

  std::string end(const std::string& title) {
    json_.member("title", title);
    json_.end_object();
    return text_;
  }

 private:
  void end_segment() {
    if (!recorder_) return;
    picture_.advance_to(static_cast<double>(picture_.end()));
    json_.end_list();
    json_.member("end", picture_.end());
    write_triangles(recorder_->recording());
    json_.end_object();
    picture_.remove_observer(*recorder_);
    recorder_.reset();
  }

  void add_group(std::uint32_t begin, std::uint32_t end,
                 const std::vector<Present_points::Point>& points,
                 const std::vector<Node>& targets) {
    Bytes ids;
    Bytes places;
    Bytes colors;
    for (std::size_t i = 0; i < points.size(); ++i) {
      ids.add(static_cast<std::uint32_t>(points[i].id));
      for (const Node& node : {points[i].node, targets[i]}) {
        places.add(static_cast<std::uint32_t>(node.place.x));
        places.add(static_cast<std::uint32_t>(node.place.y));
        for (const std::int16_t color : rgb_at(node)) colors.add(static_cast<std::uint16_t>(color));
      }
    }
    json_.begin_object();
    json_.member("begin", begin);
    json_.member("end", end);
    json_.member("ids", ids.base64());
    json_.member("places", places.base64());
    json_.member("colors", colors.base64());
    json_.end_object();
  }

  // Red, green, blue by the formulas of JFIF. They may be out of the displayable range.
  std::array<std::int16_t, 3> rgb_at(const Node& node) const {
    const double unit = header_.color_step / 8.0;
    const bool is_full = header_.format.is_full_range;
    const double y = is_full ? node.colors[0] * unit : (node.colors[0] * unit - 16) * 255 / 219;
    if (header_.format.planes() == 1) return {rounded(y), rounded(y), rounded(y)};
    const double range = is_full ? 1 : 255.0 / 224;
    const double cb = (node.colors[1] * unit - 128) * range;
    const double cr = (node.colors[2] * unit - 128) * range;
    return {rounded(y + 1.402 * cr), rounded(y - 0.344136 * cb - 0.714136 * cr),
            rounded(y + 1.772 * cb)};
  }

  static std::int16_t rounded(double value) {
    return static_cast<std::int16_t>(std::clamp(std::floor(value + 0.5), -32768.0, 32767.0));
  }

  void write_triangles(const Recording& recording) {
    Bytes initial;
    for (const Triangle_ids& corners : recording.initial_triangles) {
      for (const Point_id id : corners) initial.add(static_cast<std::uint32_t>(id));
    }
    Bytes times;
    Bytes counts;
    Bytes changes;
    const auto& triangles = recording.triangles;
    for (auto change = triangles.begin(); change != triangles.end();) {
      const std::size_t row = change->event;
      times.add(recording.events[row].time.nearest);
      std::array<std::uint32_t, 2> numbers = {0, 0};
      for (; change != triangles.end() && change->event == row; ++change) {
        ++numbers[change->is_added ? 1 : 0];
        for (const Point_id id : change->corners) changes.add(static_cast<std::uint32_t>(id));
      }
      for (const std::uint32_t number : numbers) counts.add(number);
    }
    json_.member("initial", initial.base64());
    json_.member("times", times.base64());
    json_.member("counts", counts.base64());
    json_.member("changes", changes.base64());
  }

  Stream_header header_;
  Moving_picture picture_;
  Present_points points_;
  std::optional<Recorder<>> recorder_;
  std::string text_;
  Json_writer json_;
  std::uint32_t begin_ = 0;
};

// JSON as the content of an element of HTML.
std::string embedded(const std::string& json) {
  std::string result;
  for (const char c : json) {
    c == '<' ? result += "\\u003c" : result += c;
  }
  return result;
}

}  // namespace

void write_play_page(std::ostream& out, Stream_reader& stream, const std::string& title) {
  Page_data data(stream.header());
  while (const auto block = stream.read()) data.follow(*block);
  out << player_page << "<script type=\"application/json\" id=\"stream\">"
      << embedded(data.end(title)) << "</script>\n<script>\n"
      << player_script << "</script>\n</body>\n</html>\n";
}

}  // namespace kinetri::video
