// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/codec/encoder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <deque>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/impl/base/check.h"
#include "video/codec/group_motion.h"
#include "video/codec/moving_picture.h"
#include "video/codec/optical_flow.h"
#include "video/codec/picture_fit.h"
#include "video/codec/placement.h"
#include "video/codec/point_choice.h"
#include "video/stream/stream_writer.h"

namespace kinetri::video {
namespace {

// A frame begins a scene if this fraction of points is lost, or its histogram differs by this much.
constexpr double share_of_cut = 0.6;
constexpr double histogram_of_cut = 0.5;
// The margin of the stage in pixels.
constexpr unsigned margin = 32;
// Rounds of replacing points of a key by better ones.
constexpr int key_rounds = 10;
// The fraction of points that may be replaced at the beginning of a group.
constexpr double most_replaced = 1.0 / 16;
// A point is moved to a triangle only if its error is this many times that of removing the point: a
// new point costs more bits.
constexpr double worth_replacing = 4;

// Half of the sum of differences: 0 for equal histograms, 1 for disjoint ones.
double histogram_distance(const Frame& a, const Frame& b) {
  std::array<double, 32> counts = {};
  for (const std::uint8_t sample : a.planes[0]) counts[sample / 8] += 1;
  for (const std::uint8_t sample : b.planes[0]) counts[sample / 8] -= 1;
  double sum = 0;
  for (const double count : counts) sum += std::abs(count);
  return sum / 2 / static_cast<double>(a.planes[0].size());
}

class Encoder {
 public:
  Encoder(Frame_source& source, std::ostream& out, const Encoder_settings& settings,
          const std::function<void(std::uint32_t)>& progress)
      : source_(source),
        settings_(settings),
        progress_(progress),
        header_{source.format(), settings.place_bits, settings.color_step,
                settings.has_motion ? margin : 0},
        writer_(out, header_),
        picture_(header_),
        fit_(header_),
        flow_(header_.format.width, header_.format.height) {}

  Encoded run() {
    std::uint32_t next = 0;
    while (frame(next) != nullptr) {
      begin_segment(next);
      const bool has_groups = settings_.key_frames != 1;
      const std::uint32_t segment_end =
          settings_.key_frames == 0 ? UINT32_MAX : next + settings_.key_frames;
      while (has_groups && now() < segment_end && add_group(segment_end)) {
      }
      const bool is_periodic = has_groups && now() == segment_end;
      if (is_periodic && frame(now() + 1) == nullptr) break;
      next = is_periodic ? now() : now() + 1;
      if (has_groups && !is_periodic && frame(next) != nullptr) ++result_.scene_cuts;
    }
    result_.frames = first_frame_ + static_cast<std::uint32_t>(frames_.size());
    if (result_.frames == 0) throw Input_error(source_.name(), 0, "there is no frame");
    writer_.write(End{result_.frames});
    result_.bytes = writer_.bytes();
    result_.events = picture_.events();
    return result_;
  }

 private:
  using Points = std::vector<Present_points::Point>;
  using Index_pairs = std::vector<std::pair<std::size_t, std::size_t>>;

  // The time of the last block.
  std::uint32_t now() const { return writer_.points().time(); }
  double width() const { return header_.format.width; }
  double height() const { return header_.format.height; }

  // The frame, or null after the last one. Frames before the present time are dropped.
  const Frame* frame(std::uint32_t number) {
    while (number >= first_frame_ + frames_.size()) {
      Frame next;
      if (!source_.read(next)) return nullptr;
      frames_.push_back(std::move(next));
    }
    return &frames_[number - first_frame_];
  }

  Node node_at(const Place& place, const Frame& frame) const {
    Node result = {place, {}};
    for (std::size_t plane = 0; plane < header_.format.planes(); ++plane) {
      result.colors[plane] =
          fit_.quantized(sample_at(header_, frame, plane, position_of(header_, place)));
    }
    return result;
  }

  void write(const Block& block) {
    writer_.write(block);
    for (; first_frame_ < now(); ++first_frame_) frames_.pop_front();
    if (!std::holds_alternative<End>(block)) {
      error_ = fit_.error(writer_.points().points(), frames_.front());
    }
    if (progress_) progress_(now());
  }

  void begin_segment(std::uint32_t number) {
    for (; first_frame_ < number; ++first_frame_) frames_.pop_front();
    const Frame& picture = frames_.front();
    const bool is_grid = settings_.placement == Placement::grid;
    std::vector<Place> places = is_grid ? places_on_grid(header_, settings_.points)
                                        : places_by_content(header_, picture, settings_.points);
    Key key;
    for (int round = 0;; ++round) {
      sort_places(header_, std::span(places).subspan(number_of_corners));
      key = {number, {}};
      for (const Place& place : places) key.points.push_back(node_at(place, picture));
      picture_.begin(key);
      Points points = points_of(key);
      fit_colors(points, number, 0, key.points);
      if (is_grid || round == key_rounds) break;
      points = points_of(key);
      error_ = fit_.error(points, picture);
      std::vector<bool> is_replaced(points.size());
      const std::vector<Place> inserted = new_places(points, is_replaced);
      if (inserted.empty()) break;
      places.clear();
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (!is_replaced[i]) places.push_back(points[i].node.place);
      }
      std::ranges::copy(inserted, std::back_inserter(places));
    }
    picture_.begin(key);
    ++result_.keys;
    write(key);
  }

  static Points points_of(const Key& key) {
    Points points;
    for (const Node& node : key.points) {
      points.push_back({static_cast<Point_id>(points.size()), node, {}, 0});
    }
    return points;
  }

  void fit_colors(const Points& points, std::uint32_t first, std::uint32_t frames,
                  std::vector<Node>& targets, std::size_t fixed = 0) {
    fit_.fit(
        picture_, points, first, frames,
        [&](std::uint32_t number) -> const Frame& { return *frame(number); }, targets, fixed);
  }

  // Adds a group that ends at `segment_end` at the latest. False if there is no next frame, or it
  // begins a scene.
  bool add_group(std::uint32_t segment_end) {
    const std::uint32_t first = now();
    std::vector<bool> is_replaced(writer_.points().points().size());
    std::vector<Place> inserted = new_places(writer_.points().points(), is_replaced);
    sort_places(header_, inserted);
    Points points;
    std::vector<std::size_t> index(writer_.points().next_id(), SIZE_MAX);
    for (std::size_t i = 0; i < is_replaced.size(); ++i) {
      if (is_replaced[i]) continue;
      points.push_back(writer_.points().points()[i]);
      index[points.back().id] = points.size() - 1;
    }
    const std::size_t staying = points.size();
    for (const Place& place : inserted) {
      points.push_back({no_point, node_at(place, frames_.front()), {}, 0});
    }

    std::vector<Vector_2> places;
    for (const auto& point : points) places.push_back(position_of(header_, point.node.place));
    Followed_points followed(std::move(places));
    const std::uint32_t steps =
        follow(followed, first, std::min(settings_.group_frames, segment_end - first));
    if (steps == 0) return false;
    const std::uint32_t frames = std::bit_floor(steps);
    std::vector<std::optional<Place>> targets;
    if (settings_.has_motion) {
      targets = targets_of(header_, points, followed, frames, edges_of(index, points, staying));
    } else {
      for (const auto& point : points) targets.emplace_back(point.node.place);
    }
    if (settings_.has_motion) add_entering_points(first + frames, staying, points, targets);
    write_group(first, frames, points, targets, staying);
    return true;
  }

  // Adds points for what enters the picture until the time `last`. If there would be too many
  // points, the least valuable ones are removed.
  void add_entering_points(std::uint32_t last, std::size_t staying, Points& points,
                           std::vector<std::optional<Place>>& targets) {
    if (settings_.placement == Placement::grid) return;
    const auto entering = entering_points(header_, settings_.points, points, targets);
    std::size_t count = static_cast<std::size_t>(
        std::ranges::count_if(targets, [](const auto& target) { return target.has_value(); }));
    const Points old(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(staying));
    const auto removable =
        removable_points(header_, settings_.points, writer_.points().points(), fit_.weights(),
                         picture_.triangulation().finite_edge_ids());
    std::vector<std::size_t> index(writer_.points().next_id(), SIZE_MAX);
    for (std::size_t i = 0; i < old.size(); ++i) index[old[i].id] = i;
    auto next = removable.begin();
    for (const Entering& point : entering) {
      while (count >= settings_.points && next != removable.end()) {
        const std::size_t i = index[writer_.points().points()[next->index].id];
        if (i != SIZE_MAX && targets[i]) {
          targets[i].reset();
          --count;
        }
        ++next;
      }
      if (count >= settings_.points) break;
      Node node = node_at(point.target, *frame(last));
      node.place = point.begin;
      points.push_back({no_point, node, {}, 0});
      targets.emplace_back(point.target);
      ++count;
    }
  }

  // The number of frames over which the points can be followed, at most `most`.
  std::uint32_t follow(Followed_points& followed, std::uint32_t first, std::uint32_t most) {
    if (settings_.has_motion && flow_end_ != first + 1) flow_.add(frame(first)->planes[0]);
    for (std::uint32_t step = 1; step <= most; ++step) {
      if (frame(first + step) == nullptr) return step - 1;
      if (settings_.has_motion) {
        flow_.add(frame(first + step)->planes[0]);
        flow_end_ = first + step + 1;
        followed.step(flow_, width(), height());
      }
      const double distance = histogram_distance(*frame(first + step - 1), *frame(first + step));
      if (settings_.has_scene_cuts &&
          (distance > histogram_of_cut || followed.lost_share() > share_of_cut)) {
        return step - 1;
      }
    }
    return most;
  }

  // Pairs of neighbors, as indices; a new point's neighbors are the corners of the triangle that
  // contains it.
  Index_pairs edges_of(const std::vector<std::size_t>& index, const Points& points,
                       std::size_t staying) const {
    Index_pairs result;
    const auto add = [&](Point_id a, std::size_t b) {
      if (index[a] != SIZE_MAX && b != SIZE_MAX) result.emplace_back(index[a], b);
    };
    for (const auto& [a, b] : picture_.triangulation().finite_edge_ids()) add(a, index[b]);
    for (std::size_t i = staying; i < points.size(); ++i) {
      const Vector_2 p = position_of(header_, points[i].node.place);
      const auto column = static_cast<std::size_t>(std::clamp(p.x, 0.0, width() - 1));
      const auto row = static_cast<std::size_t>(std::clamp(p.y, 0.0, height() - 1));
      const std::size_t pixel = row * header_.format.width + column;
      for (const Point_id corner : fit_.weights()[pixel].corners) add(corner, i);
    }
    return result;
  }

  void write_group(std::uint32_t first, std::uint32_t frames, const Points& candidates,
                   const std::vector<std::optional<Place>>& targets, std::size_t staying) {
    Group group;
    group.first = first;
    group.frames = frames;
    std::size_t next = 0;
    for (const auto& point : writer_.points().points()) {
      const bool is_candidate = next < staying && candidates[next].id == point.id;
      if (!is_candidate || !targets[next]) group.erased.push_back(point.id);
      if (is_candidate) ++next;
    }
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (!targets[i]) continue;
      if (i >= staying) group.inserted.push_back(candidates[i].node);
      group.targets.push_back({*targets[i], candidates[i].node.colors});
    }
    Points points = writer_.points().at_begin_of(group);
    picture_.begin(group);
    // New points get colors fitted to their surroundings: the color of a pixel would be wrong in
    // large triangles.
    const std::size_t old = points.size() - group.inserted.size();
    std::vector<Node> at_begin(points.size());
    if (!group.inserted.empty()) fit_colors(points, first, 0, at_begin, old);
    for (std::size_t i = old; i < points.size(); ++i) {
      points[i].node.colors = group.inserted[i - old].colors = at_begin[i].colors;
    }
    fit_colors(points, first, frames, group.targets);
    picture_.set_colors(group);
    result_.inserted += group.inserted.size();
    result_.erased += group.erased.size();
    write(group);
  }

  // Positions of new points: in gaps of the rings around the picture, and where the error is
  // largest. They replace missing points, and some of the least valuable points, which are marked.
  std::vector<Place> new_places(const Points& points, std::vector<bool>& is_replaced) const {
    std::vector<Place> result;
    if (settings_.placement == Placement::grid) return result;
    std::vector<Vector_2> positions(points.back().id + std::size_t{1});
    for (const auto& point : points) positions[point.id] = position_of(header_, point.node.place);
    std::vector<Candidate> wanted = ring_gaps(header_, settings_.points, points);
    const std::size_t in_ring = wanted.size();
    std::ranges::copy(candidates(header_, fit_.weights(), error_, positions),
                      std::back_inserter(wanted));
    const std::size_t missing = settings_.points - std::min(settings_.points, points.size());
    const auto removable = removable_points(header_, settings_.points, points, fit_.weights(),
                                            picture_.triangulation().finite_edge_ids());
    const auto most =
        in_ring + static_cast<std::size_t>(most_replaced * static_cast<double>(settings_.points));
    std::size_t removed = 0;
    for (std::size_t i = 0; i < std::min(wanted.size(), missing + most); ++i) {
      if (i >= missing) {
        if (removed == removable.size()) break;
        if (wanted[i].error <= worth_replacing * removable[removed].worth) break;
        is_replaced[removable[removed].index] = true;
        ++removed;
      }
      result.push_back(wanted[i].place);
    }
    return result;
  }

  Frame_source& source_;
  Encoder_settings settings_;
  const std::function<void(std::uint32_t)>& progress_;
  Stream_header header_;
  Stream_writer writer_;
  Moving_picture picture_;
  Picture_fit fit_;
  Optical_flow flow_;
  std::uint32_t flow_end_ = 0;  // one more than the last frame of the flow
  std::deque<Frame> frames_;    // frames that have been read, from the present one on
  std::uint32_t first_frame_ = 0;
  std::vector<double> error_;  // of brightness, at the present time
  Encoded result_;
};

}  // namespace

Encoded encode(Frame_source& source, std::ostream& out, const Encoder_settings& settings,
               const std::function<void(std::uint32_t)>& progress) {
  KINETRI_PRECONDITION(settings.points >= number_of_corners && settings.points <= most_points,
                       "the number of points is too small or too large");
  KINETRI_PRECONDITION(
      std::has_single_bit(settings.group_frames) && settings.group_frames <= most_group_frames,
      "the frames of a group are no power of two, or too many");
  KINETRI_PRECONDITION(settings.place_bits > 0 && settings.place_bits <= most_place_bits &&
                           settings.color_step > 0 && settings.color_step < 256,
                       "the numbers of the stream are too coarse or too fine");
  return Encoder(source, out, settings, progress).run();
}

}  // namespace kinetri::video
