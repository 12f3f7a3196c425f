// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/codec/decoder.h"

#include <algorithm>

namespace kinetri::video {
namespace {

class Decoder {
 public:
  Decoder(const Stream_reader& stream, const Decoder_settings& settings,
          const std::function<void(const Frame&)>& take, Decoded& decoded)
      : picture_(stream.header()),
        format_(decoded_format(stream.header().format, settings)),
        style_(settings.style),
        take_(take),
        decoded_(decoded) {
    // The duration of an output frame in frames of the source, as a quotient of 64-bit numbers.
    const Ratio& source = stream.header().format.rate;
    step_numerator_ = std::uint64_t{source.numerator} * format_.rate.denominator;
    step_denominator_ = std::uint64_t{source.denominator} * format_.rate.numerator;
  }

  void follow(const Block& block) {
    if (const Key* key = std::get_if<Key>(&block)) {
      make_frames_before(Rational(key->frame));
      picture_.begin(*key);
    } else if (const Group* group = std::get_if<Group>(&block)) {
      picture_.begin(*group);
      make_frames_before(Rational(group->last()));
      decoded_.source_frames = group->last();
    } else {
      make_frames_before(Rational(std::get<End>(block).frames));
      picture_.advance_to(static_cast<double>(picture_.end()));
      decoded_.source_frames = std::get<End>(block).frames;
    }
    decoded_.events = picture_.events();
  }

 private:
  Rational next_time() const {
    return Rational(decoded_.frames) * Rational(step_numerator_) / Rational(step_denominator_);
  }

  void make_frames_before(const Rational& end) {
    for (Rational time = next_time(); time < end; time = next_time()) {
      picture_.advance_to(std::min(time, Rational(picture_.end())));
      picture_.draw(format_, style_, frame_);
      take_(frame_);
      ++decoded_.frames;
    }
  }

  Moving_picture picture_;
  Video_format format_;
  Interpolation style_;
  const std::function<void(const Frame&)>& take_;
  Decoded& decoded_;
  Frame frame_;
  std::uint64_t step_numerator_ = 0;
  std::uint64_t step_denominator_ = 1;
};

}  // namespace

Video_format decoded_format(const Video_format& source, const Decoder_settings& settings) {
  Video_format result = source;
  result.rate = settings.rate.value_or(source.rate);
  result.width = settings.width.value_or(source.width);
  result.height = settings.height.value_or(source.height);
  return result;
}

void decode(Stream_reader& stream, const Decoder_settings& settings,
            const std::function<void(const Frame&)>& take, Decoded& decoded) {
  decoded = {};
  Decoder decoder(stream, settings, take, decoded);
  while (const auto block = stream.read()) decoder.follow(*block);
}

}  // namespace kinetri::video
