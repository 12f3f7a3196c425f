// SPDX-License-Identifier: GPL-3.0-or-later
//
// Video as PNG files of one size in a folder, in the order of the numbers in their names:
// frame2.png is before frame10.png.
//
// PNG files have red, green and blue. They become brightness and color, and back, by the formulas
// of ITU-R BT.601 with full range, as JFIF has them, computed with whole numbers; a color that is
// converted there and back is off by at most 2. Gray files stay as they are.
#ifndef KINETRI_VIDEO_FORMATS_PNG_FOLDER_H
#define KINETRI_VIDEO_FORMATS_PNG_FOLDER_H

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "video/formats/frame.h"

namespace kinetri::video {

/// Reads the files of the folder that end with .png. Throws Input_error if there are none, if they
/// are of different sizes, have more than 8 bits, or are transparent anywhere.
std::unique_ptr<Frame_source> open_png_folder(const std::string& path, const Ratio& rate);

/// Writes 00000.png, 00001.png, ... into a new folder, or an empty one, which is there only when it
/// is whole. Color that has fewer samples is taken from the nearest one.
std::unique_ptr<Frame_sink> create_png_folder(const std::string& path, const Video_format& format);

/// @{
/// Y, Cb, Cr of full range from red, green, blue; and red, green, blue from Y, Cb, Cr of full or
/// limited range. Each is rounded to the nearest number.
std::array<std::uint8_t, 3> ycbcr_of(const std::array<std::uint8_t, 3>& rgb);
std::array<std::uint8_t, 3> rgb_of(const std::array<std::uint8_t, 3>& ycbcr, bool is_full_range);
/// @}

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_FORMATS_PNG_FOLDER_H
