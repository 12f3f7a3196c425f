// SPDX-License-Identifier: GPL-3.0-or-later
//
// Frames of a video in memory, and the positions of their samples.
#ifndef KINETRI_VIDEO_FORMATS_FRAME_H
#define KINETRI_VIDEO_FORMATS_FRAME_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kinetri/triangulation/field_2.h"

namespace kinetri::video {

/// The chroma format: number and position of samples of color. The values are those in the stream
/// (docs/VIDEO.md).
enum class Chroma : std::uint8_t {
  mono = 0,          ///< none
  yuv444 = 1,        ///< one for each, at the same place
  yuv422 = 2,        ///< one for two in a row, at the place of the first
  yuv420_jpeg = 3,   ///< one for two times two, in their middle
  yuv420_mpeg2 = 4,  ///< one for two times two, in the column of the left ones, between the rows
  yuv420_paldv = 5,  ///< one for two times two, at the place of the upper left one
};

/// The greatest width and height of frames.
inline constexpr std::uint32_t greatest_size = 16384;

/// A positive ratio of whole numbers.
struct Ratio {
  std::uint32_t numerator = 0;
  std::uint32_t denominator = 1;

  friend bool operator==(const Ratio&, const Ratio&) = default;
};

/// The format of all frames of a video. The picture is the rectangle from (0, 0), its upper
/// left corner, to (width, height): the sample of brightness in column i and row j is at
/// (i + 1/2, j + 1/2).
struct Video_format {
  std::uint32_t width = 0;   ///< samples of brightness in a row
  std::uint32_t height = 0;  ///< number of rows
  Chroma chroma = Chroma::yuv444;
  /// Whether samples use 0 ... 255 (as JPEG does), else 16 ... 235 and 16 ... 240 (ITU-R BT.601).
  bool is_full_range = false;
  Ratio rate = {25, 1};   ///< frames a second
  Ratio aspect = {1, 1};  ///< width to height of a sample; 0:0 if it is not known

  friend bool operator==(const Video_format&, const Video_format&) = default;

  /// 1 or 3.
  std::size_t planes() const { return chroma == Chroma::mono ? 1 : 3; }
  /// @{
  /// The number of samples of color in a row, and of rows. If the picture has an odd size, the last
  /// ones cover less of it.
  std::uint32_t chroma_width() const;
  std::uint32_t chroma_height() const;
  /// @}
  /// The positions of samples of brightness (`plane` 0) or color (1 or 2) in a picture of format
  /// `picture` that is scaled to this format.
  Grid_2 grid(std::size_t plane, const Video_format& picture) const;
};

/// The samples of a frame, by plane (brightness Y, then Cb and Cr), row by row from the top.
struct Frame {
  std::array<std::vector<std::uint8_t>, 3> planes;

  friend bool operator==(const Frame&, const Frame&) = default;
};

/// A frame of the format, black.
Frame black_frame(const Video_format& format);

/// A source of frames in order.
class Frame_source {
 public:
  virtual ~Frame_source() = default;

  virtual const Video_format& format() const = 0;
  /// The name for messages.
  virtual const std::string& name() const = 0;
  /// Reads the next frame. Returns whether there is one. Throws Input_error.
  virtual bool read(Frame& frame) = 0;
};

/// A sink of frames in order. The output is not visible before `commit`, unless it is a pipe.
class Frame_sink {
 public:
  virtual ~Frame_sink() = default;

  /// Throws Output_error.
  virtual void write(const Frame& frame) = 0;
  /// Completes the output. Throws Output_error.
  virtual void commit() = 0;
};

/// The frames of a Y4M file, of standard input ("-") in that format, or of the PNG files of a
/// folder, which have the rate `rate`. Throws Input_error.
std::unique_ptr<Frame_source> open_frames(const std::string& path, const Ratio& rate);

/// Writes a file in the format Y4M, or standard output ("-"), or PNG files in a new folder if the
/// path ends with `/` or is an empty folder. Throws Output_error.
std::unique_ptr<Frame_sink> create_frames(const std::string& path, const Video_format& format);

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_FORMATS_FRAME_H
