// SPDX-License-Identifier: GPL-3.0-or-later
//
// Uncompressed video: YUV4MPEG2, as the program yuv4mpeg(5) of mjpegtools describes it, with the
// tags of color that ffmpeg writes. A header line, then each frame as a line that begins with FRAME
// and the samples of its planes.
#ifndef KINETRI_VIDEO_FORMATS_Y4M_H
#define KINETRI_VIDEO_FORMATS_Y4M_H

#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>

#include "video/formats/frame.h"

namespace kinetri::video {

/// Reads the header, then frames as they are asked for; so a pipe is read as it comes. `name` is
/// for messages. Throws Input_error for what is no such file, samples of more than 8 bits,
/// interlaced frames, a transparency plane, a tag of color that is not known, sizes beyond
/// greatest_size, a frame that is cut off, and a file without frames.
std::unique_ptr<Frame_source> read_y4m(std::istream& in, const std::string& name);

/// The same of a file, or of standard input ("-").
std::unique_ptr<Frame_source> open_y4m(const std::string& path);

/// @{
/// How a video of the format begins; and each of its frames, before the samples of its planes.
std::string y4m_header(const Video_format& format);
inline constexpr std::string_view y4m_frame_line = "FRAME\n";
/// The tag of color, as "420jpeg".
std::string_view y4m_color(Chroma chroma);
/// @}

/// Writes a file, or standard output ("-"). A file is there only when it is whole.
std::unique_ptr<Frame_sink> create_y4m(const std::string& path, const Video_format& format);

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_FORMATS_Y4M_H
