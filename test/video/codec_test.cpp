// SPDX-License-Identifier: GPL-3.0-or-later
//
// From frames to a stream and back, on clips whose motion is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "kinetri/triangulation/queries_2.h"
#include "video/clips.h"
#include "video/codec/decoder.h"
#include "video/codec/encoder.h"
#include "video/codec/quality.h"
#include "video/known_clips.h"
#include "video/streams.h"

namespace kinetri::video::codec_test {
namespace {

using test::bytes_of;
using test::Clip;
using test::corner_nodes;
using test::gray_format;
using test::Random_blocks;
using test::read_all;
using test::Scene;
using test::Texture;

std::vector<Frame> decoded(const std::string& bytes, const Decoder_settings& settings = {},
                           Decoded* found = nullptr) {
  std::istringstream in(bytes);
  Stream_reader stream(in, "stream");
  std::vector<Frame> frames;
  Decoded result;
  try {
    decode(
        stream, settings, [&](const Frame& frame) { frames.push_back(frame); }, result);
  } catch (const Damaged_stream_error&) {
  }
  EXPECT_EQ(result.frames, frames.size());
  if (found != nullptr) *found = result;
  return frames;
}

struct Encoding {
  std::string bytes;
  Encoded encoded;
};
Encoding encoding_of(Clip& clip, const Encoder_settings& settings) {
  std::ostringstream out;
  clip.rewind();
  const Encoded encoded = encode(clip, out, settings);
  EXPECT_EQ(encoded.bytes, out.str().size());
  return {out.str(), encoded};
}

double psnr(const Video_format& format, const std::vector<Frame>& source,
            const std::vector<Frame>& other) {
  EXPECT_EQ(source.size(), other.size());
  Quality quality(format);
  for (std::size_t i = 0; i < std::min(source.size(), other.size()); ++i) {
    quality.add(source[i], other[i]);
  }
  return quality.mean().psnr(0);
}

// The triangulation of the blocks, run by hand: each point has a motion of its own in each group,
// the triangulation is built anew at the beginning of each, and its events are counted.
std::uint64_t events_by_hand(const Stream_header& header, const std::vector<Block>& blocks) {
  std::uint64_t events = 0;
  Present_points present(header);
  const double unit = std::ldexp(1.0, -static_cast<int>(header.place_bits));
  for (const Block& block : blocks) {
    if (const Group* group = std::get_if<Group>(&block)) {
      const auto points = present.at_begin_of(*group);
      std::vector<Linear_motion_2> motions;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Place from = points[i].node.place;
        const Place to = group->targets[i].place;
        motions.push_back(
            {{from.x * unit, from.y * unit},
             {(to.x - from.x) * unit / group->frames, (to.y - from.y) * unit / group->frames},
             static_cast<double>(group->first)});
      }
      Kinetic_delaunay_triangulation_2<> triangulation(motions, static_cast<double>(group->first));
      events += triangulation.advance_to(static_cast<double>(group->last()));
    }
    present.follow(block);
  }
  return events;
}

TEST(Codec, the_number_of_events_is_that_of_a_run_by_hand) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Stream_header header = {gray_format(40, 30), 8, 8, seed};
    const auto blocks = Random_blocks(header, seed)(25, 2, 4);
    Decoded found;
    decoded(bytes_of(header, blocks), {}, &found);
    EXPECT_GT(found.events, 100U);
    EXPECT_EQ(found.events, events_by_hand(header, blocks)) << "seed " << seed;
  }
}

// A stream at any time, by a triangulation of places that are computed in rational arithmetic.
TEST(Codec, in_between_frames_are_the_picture_at_their_exact_times) {
  const Stream_header header = {gray_format(16, 12), 4, 8, 4};
  const auto blocks = Random_blocks(header, 3)(14, 1, 3);
  Decoder_settings settings;
  settings.rate = Ratio{70, 1};  // 25/70 of a frame apart
  settings.style = Interpolation::flat;
  const std::vector<Frame> frames = decoded(bytes_of(header, blocks), settings);
  ASSERT_GT(frames.size(), 10U);
  Present_points present(header);
  std::size_t j = 0;
  for (const Block& block : blocks) {
    const Group* group = std::get_if<Group>(&block);
    if (group == nullptr) {
      present.follow(block);
      continue;
    }
    const auto points = present.at_begin_of(*group);
    for (; Rational(j) * 25 / 70 < group->last(); ++j) {
      const Rational t = Rational(j) * 25 / 70;
      const Rational share = (t - group->first) / group->frames;
      std::vector<Linear_motion_2> motions;
      std::vector<double> colors;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Place from = points[i].node.place;
        const Place to = group->targets[i].place;
        motions.push_back(
            {{from.x / 16.0, from.y / 16.0},
             {(to.x - from.x) / 16.0 / group->frames, (to.y - from.y) / 16.0 / group->frames},
             static_cast<double>(group->first)});
        const int color = points[i].node.colors[0];
        colors.push_back(
            to_double(Rational(color) + share * (group->targets[i].colors[0] - color)));
      }
      // Built at the time itself: the triangulation of a moment has no history.
      const Kinetic_delaunay_triangulation_2<> triangulation(motions, Algebraic_number(t));
      const Kinetic_queries_2 queries(triangulation);
      std::size_t checked = 0;
      for (std::size_t row = 0; row < 12; ++row) {
        for (std::size_t column = 0; column < 16; ++column) {
          const auto location =
              queries.locate({static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5});
          if (location.points.size() != 3) continue;  // on an edge
          double mean = 0;
          for (const Point_id id : location.points) mean += colors[id] / 3;
          EXPECT_NEAR(frames[j].planes[0][row * 16 + column], mean, 0.5 + 1e-9);
          ++checked;
        }
      }
      EXPECT_GT(checked, 100U);
    }
    present.follow(block);
  }
}

// A damaged stream gives the first frames of the whole one, and an error that names the frame.
void check_damaged(const std::string& bytes, const std::vector<Frame>& whole) {
  std::istringstream in(bytes);
  std::size_t frames = 0;
  Decoded found;
  try {
    Stream_reader stream(in, "stream");
    const auto take = [&](const Frame& frame) {
      ASSERT_LT(frames, whole.size());
      ASSERT_EQ(frame, whole[frames]);
      ++frames;
    };
    decode(stream, {}, take, found);
    FAIL() << "nothing was noticed";
  } catch (const Damaged_stream_error& error) {
    EXPECT_NE(std::string(error.what()).find("at byte "), std::string::npos) << error.what();
    if (frames > 0 && frames < whole.size()) {
      const std::string expected = "before frame " + std::to_string(frames) + " can";
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  } catch (const Input_error&) {
    EXPECT_EQ(frames, 0U) << "the header is damaged";
  }
  EXPECT_EQ(found.frames, frames);
}

TEST(Codec, a_stream_that_is_cut_off_anywhere_gives_the_frames_before_that) {
  const Stream_header header = {gray_format(16, 12), 4, 8, 2};
  const std::string bytes = bytes_of(header, Random_blocks(header, 4)(8, 2, 2));
  const std::vector<Frame> whole = decoded(bytes);
  ASSERT_GT(whole.size(), 4U);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    SCOPED_TRACE(size);
    check_damaged(bytes.substr(0, size), whole);
  }
}

TEST(Codec, a_stream_with_wrong_bits_gives_the_frames_before_them) {
  const Stream_header header = {gray_format(16, 12), 4, 8, 2};
  const std::string bytes = bytes_of(header, Random_blocks(header, 5)(8, 2, 2));
  const std::vector<Frame> whole = decoded(bytes);
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    std::string damaged = bytes;
    for (std::size_t k = random() % 4 + 1; k > 0; --k) {
      char& byte = damaged[random() % damaged.size()];
      byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << random() % 8));
    }
    SCOPED_TRACE(i);
    if (damaged != bytes) check_damaged(damaged, whole);
  }
}

TEST(Codec, a_picture_is_drawn_at_any_size_and_in_any_style) {
  // Brightness is a linear function of the place, which linear and smooth reproduce.
  Stream_header header = {gray_format(20, 10), 4, 8, 0};
  Key key = {0, corner_nodes(header)};
  key.points.push_back({{100, 80}, {}});
  for (Node& node : key.points) {
    node.colors[0] = static_cast<std::int16_t>((node.place.x + 2 * node.place.y) / 4);
  }
  const std::string bytes = bytes_of(header, {key, End{1}});
  for (const Interpolation style : {Interpolation::linear, Interpolation::smooth}) {
    Decoder_settings settings;
    settings.width = 33;
    settings.height = 7;
    settings.style = style;
    const std::vector<Frame> frames = decoded(bytes, settings);
    ASSERT_EQ(frames.size(), 1U);
    for (int row = 0; row < 7; ++row) {
      for (int column = 0; column < 33; ++column) {
        const double x = (column + 0.5) * 20 / 33;
        const double y = (row + 0.5) * 10 / 7;
        EXPECT_NEAR(frames[0].planes[0][static_cast<std::size_t>(row * 33 + column)], 4 * x + 8 * y,
                    0.5 + 1e-9);
      }
    }
  }
}

// Its texture goes by (2.5, 1) a frame, which points can follow exactly.
Scene translating(const Texture& texture) {
  return [texture](double x, double y, double t) { return texture(x - 2.5 * t, y - t); };
}

struct Expected_errors {
  std::string clip;
  double median;
  double nine_in_ten;
};

// Pixels, over up to eight frames. In a group points move on straight lines, which the paths of a
// rotation are not.
TEST(Codec, points_go_where_their_texture_goes) {
  const std::vector<Expected_errors> expected = {{"translation", 0.15, 1},
                                                 {"rotation", 0.25, 1.5},
                                                 {"layers", 0.15, 1},
                                                 {"cut", 0.15, 1},
                                                 {"fade", 0.15, 1}};
  const Video_format format = gray_format(128, 96);
  const auto clips = test::known_clips(format.width, format.height, 17);
  ASSERT_EQ(clips.size(), expected.size());
  for (std::size_t i = 0; i < clips.size(); ++i) {
    ASSERT_EQ(clips[i].name, expected[i].clip);
    SCOPED_TRACE(clips[i].name);
    Clip clip(format, clips[i].scene, 17);
    Encoder_settings settings;
    settings.points = 500;
    const Encoding encoding = encoding_of(clip, settings);
    EXPECT_EQ(encoding.encoded.frames, 17U);
    EXPECT_EQ(encoding.encoded.keys, clips[i].name == "cut" ? 2U : 1U);
    Decoded found;
    EXPECT_GT(psnr(format, clip.frames(), decoded(encoding.bytes, {}, &found)), 20);
    std::istringstream in(encoding.bytes);
    const Stream_header header = Stream_reader(in, "stream").header();
    const auto read = read_all(encoding.bytes);
    EXPECT_EQ(read.error, "");
    const std::uint64_t events = events_by_hand(header, read.blocks);
    EXPECT_GT(events, 5U);
    EXPECT_EQ(encoding.encoded.events, events);
    EXPECT_EQ(found.events, events);
    const auto errors = test::correspondence_errors(header, read.blocks, clips[i]);
    ASSERT_GT(errors.size(), 300U);
    EXPECT_LT(errors[errors.size() / 2], expected[i].median);
    EXPECT_LT(errors[errors.size() * 9 / 10], expected[i].nine_in_ten);
  }
}

TEST(Codec, motion_beats_a_grid_at_rest_that_has_as_many_points_and_more_bits) {
  const Video_format format = gray_format(128, 96);
  Clip clip(format, translating(Texture(1)), 17);
  Encoder_settings settings;
  settings.points = 700;
  settings.color_step = 16;
  const Encoding moving = encoding_of(clip, settings);
  settings.placement = Placement::grid;
  settings.has_motion = false;
  double best = 0;
  for (const std::uint32_t frames : {1U, 2U}) {
    settings.group_frames = frames;
    // Coarser colors until the grid has no more bits than the moving points.
    for (settings.color_step = 60; settings.color_step < 256; settings.color_step += 60) {
      const Encoding resting = encoding_of(clip, settings);
      EXPECT_EQ(resting.encoded.events, 0U);
      if (resting.bytes.size() > moving.bytes.size()) continue;
      best = std::max(best, psnr(format, clip.frames(), decoded(resting.bytes)));
      break;
    }
  }
  EXPECT_GT(best, 15) << "no grid has as few bits";
  EXPECT_GT(psnr(format, clip.frames(), decoded(moving.bytes)), best + 2);
}

// What comes has the color with which its surroundings are best, not that of the pixel it is at.
// Else frames would be worse at each begin of a group, by 0.9 dB here, and better until its end.
TEST(Codec, points_that_come_do_not_make_frames_worse) {
  const Video_format format = gray_format(128, 96);
  const auto known = test::known_clips(format.width, format.height, 33);
  const auto layers = std::ranges::find(known, "layers", &test::Known_clip::name);
  ASSERT_NE(layers, known.end());
  Clip clip(format, layers->scene, 33);
  Encoder_settings settings;
  settings.points = 500;
  const Encoding encoding = encoding_of(clip, settings);
  EXPECT_GT(encoding.encoded.inserted, 100U);
  const std::vector<Frame> frames = decoded(encoding.bytes);
  ASSERT_EQ(frames.size(), 33U);
  double change = 0;
  for (std::size_t i = 8; i < 32; i += 8) {
    change += psnr(format, {clip.frames()[i]}, {frames[i]}) -
              psnr(format, {clip.frames()[i - 1]}, {frames[i - 1]});
  }
  EXPECT_GT(change / 3, -0.5);
}

TEST(Codec, left_out_frames_are_nearer_than_repeated_and_blended_ones) {
  const Video_format format = gray_format(128, 96);
  const Scene scene = translating(Texture(2));
  const Clip all(format, scene, 17);
  Clip half(format, scene, 9, 2);
  Encoder_settings settings;
  settings.points = 700;
  settings.group_frames = 4;
  Decoder_settings twice;
  twice.rate = Ratio{50, 1};
  const std::vector<Frame> frames = decoded(encoding_of(half, settings).bytes, twice);
  ASSERT_GE(frames.size(), 17U);
  Quality between(format);
  Quality repeated(format);
  Quality blended(format);
  for (std::size_t i = 1; i < 17; i += 2) {
    const Frame& before = all.frames()[i - 1];
    const Frame& after = all.frames()[i + 1];
    Frame mean = before;
    for (std::size_t k = 0; k < mean.planes[0].size(); ++k) {
      mean.planes[0][k] =
          static_cast<std::uint8_t>((before.planes[0][k] + after.planes[0][k] + 1) / 2);
    }
    between.add(all.frames()[i], frames[i]);
    repeated.add(all.frames()[i], before);
    blended.add(all.frames()[i], mean);
  }
  EXPECT_GT(between.mean().psnr(0), repeated.mean().psnr(0) + 3);
  EXPECT_GT(between.mean().psnr(0), blended.mean().psnr(0) + 3);
}

TEST(Codec, a_cut_begins_a_segment_and_a_fade_does_not) {
  const Video_format format = gray_format(128, 96);
  const Texture before(3);
  const Texture after(4);
  Clip cut(
      format, [&](double x, double y, double t) { return t < 7 ? before(x, y) : after(x, y); }, 12);
  Encoder_settings settings;
  settings.points = 300;
  const Encoding encoding = encoding_of(cut, settings);
  EXPECT_EQ(encoding.encoded.scene_cuts, 1U);
  std::vector<std::uint32_t> keys;
  for (const Block& block : read_all(encoding.bytes).blocks) {
    if (const Key* key = std::get_if<Key>(&block)) keys.push_back(key->frame);
  }
  EXPECT_EQ(keys, (std::vector<std::uint32_t>{0, 7}));
  settings.has_scene_cuts = false;
  EXPECT_EQ(encoding_of(cut, settings).encoded.keys, 1U);

  settings.has_scene_cuts = true;
  Clip fade(
      format, [&](double x, double y, double t) { return before(x, y) * (1 - t / 24); }, 12);
  EXPECT_EQ(encoding_of(fade, settings).encoded.keys, 1U);
}

TEST(Codec, keys_come_as_often_as_they_are_asked_for) {
  const Video_format format = gray_format(32, 24);
  Clip clip(
      format, [](double x, double y, double) { return x + y; }, 11);
  Encoder_settings settings;
  settings.points = 40;
  for (const auto& [every, keys] : std::vector<std::array<std::uint32_t, 2>>{
           {0, 1}, {1, 11}, {4, 3}, {5, 2}, {10, 1}, {20, 1}}) {
    settings.key_frames = every;
    const Encoding encoding = encoding_of(clip, settings);
    EXPECT_EQ(encoding.encoded.keys, keys) << every;
    EXPECT_EQ(decoded(encoding.bytes).size(), 11U);
  }
}

TEST(Codec, small_and_odd_clips_of_all_kinds_of_color_go_through) {
  for (const Chroma chroma : {Chroma::mono, Chroma::yuv444, Chroma::yuv422, Chroma::yuv420_jpeg,
                              Chroma::yuv420_mpeg2, Chroma::yuv420_paldv}) {
    for (const auto& [width, height] :
         std::vector<std::array<std::uint32_t, 2>>{{1, 1}, {2, 1}, {3, 5}, {17, 9}}) {
      for (const int frames : {1, 2, 4}) {
        const Video_format format = {width, height, chroma, false, {25, 1}, {1, 1}};
        Clip clip(
            format, [](double x, double y, double t) { return 60 + 3 * x + y + t; }, frames);
        for (const std::size_t points : {std::size_t{4}, std::size_t{5}, std::size_t{50}}) {
          Encoder_settings settings;
          settings.points = points;
          const Encoding encoding = encoding_of(clip, settings);
          const auto result = decoded(encoding.bytes);
          ASSERT_EQ(result.size(), static_cast<std::size_t>(frames));
          for (std::size_t plane = 0; plane < 3; ++plane) {
            EXPECT_EQ(result[0].planes[plane].size(), clip.frames()[0].planes[plane].size());
          }
        }
      }
    }
  }
}

TEST(Quality, equal_frames_are_equal_and_known_differences_have_known_numbers) {
  const Video_format format = gray_format(32, 32);
  const Texture texture(5);
  const Frame a = test::frame_of(
      format, [&](double x, double y, double) { return texture(x, y); }, 0);
  Frame b = a;
  Quality quality(format);
  quality.add(a, b);
  EXPECT_TRUE(std::isinf(quality.mean().psnr(0)));
  EXPECT_NEAR(quality.mean().ssim[0], 1, 1e-12);
  for (std::size_t i = 0; i < b.planes[0].size(); ++i) {
    b.planes[0][i] =
        static_cast<std::uint8_t>(b.planes[0][i] < 128 ? b.planes[0][i] + 4 : b.planes[0][i] - 4);
  }
  quality.add(a, b);
  EXPECT_EQ(quality.frames()[1].mean_square[0], 16);
  EXPECT_NEAR(quality.frames()[1].psnr(0), 36.0896, 1e-4);
  EXPECT_LT(quality.frames()[1].ssim[0], 1);
  // The source rests, the other one changes by 4 everywhere.
  EXPECT_EQ(quality.flicker(), 4);
}

}  // namespace
}  // namespace kinetri::video::codec_test
