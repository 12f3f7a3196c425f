// SPDX-License-Identifier: GPL-3.0-or-later
//
// Uncompressed video: YUV4MPEG2, described by yuv4mpeg(5) of mjpegtools, with the color tags of
// ffmpeg. A header line, then each frame as a line that begins with FRAME and the samples of its
// planes.
#ifndef KINETRI_VIDEO_FORMATS_Y4M_H
#define KINETRI_VIDEO_FORMATS_Y4M_H

#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>

#include "video/formats/frame.h"

namespace kinetri::video {

/// Reads the header, then frames on demand, so that a pipe can be read. `name` is for messages.
/// Throws Input_error for other files, samples of more than 8 bits, interlaced frames, a
/// transparency plane, an unknown color tag, sizes beyond greatest_size, a truncated frame, and a
/// file without frames.
std::unique_ptr<Frame_source> read_y4m(std::istream& in, const std::string& name);

/// The same of a file, or of standard input ("-").
std::unique_ptr<Frame_source> open_y4m(const std::string& path);

/// @{
/// The line at the beginning of a video of the format, and the one before each frame.
std::string y4m_header(const Video_format& format);
inline constexpr std::string_view y4m_frame_line = "FRAME\n";
/// The tag of color, as "420jpeg".
std::string_view y4m_color(Chroma chroma);
/// @}

/// Writes a file, or standard output ("-"). A file appears only when complete.
std::unique_ptr<Frame_sink> create_y4m(const std::string& path, const Video_format& format);

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_FORMATS_Y4M_H
