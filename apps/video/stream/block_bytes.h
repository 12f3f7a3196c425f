// SPDX-License-Identifier: GPL-3.0-or-later
//
// The content of a block as bytes, before it is compressed (docs/VIDEO.md): whole numbers of
// variable length, grouped by kind, as differences to expected values.
#ifndef KINETRI_VIDEO_STREAM_BLOCK_BYTES_H
#define KINETRI_VIDEO_STREAM_BLOCK_BYTES_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "video/stream/present_points.h"
#include "video/stream/stream.h"

namespace kinetri::video {

/// @{
/// The bytes of the file that do not depend on a stream.
inline constexpr std::string_view stream_signature = "\x89KVD\r\n\x1a\n";
inline constexpr std::uint16_t stream_version = 1;
inline constexpr std::size_t header_bytes = 48;
inline constexpr std::size_t block_header_bytes = 17;
inline constexpr char key_type = 'K';
inline constexpr char group_type = 'G';
inline constexpr char end_type = 'E';
/// The greatest size of the content of a block.
inline constexpr std::uint32_t most_block_bytes = 1U << 30U;
/// @}

/// @{
/// Numbers with a fixed number of bytes, the least significant one first.
void append_number(std::string& bytes, std::uint64_t number, unsigned size);
std::uint64_t number_at(std::string_view bytes, std::size_t position, unsigned size);
/// @}

/// The CRC-32 of the bytes.
std::uint32_t checksum(std::string_view bytes);

/// The content of a block that comes after `points`; an End has none. Precondition:
/// points.problem(block) is empty.
std::string content_of(const Block& block, const Present_points& points, std::size_t planes);

/// The block of a type that begins at the time `frame`, from its content; none if the content is
/// not that of such a block. Whether it may come after `points` is not checked.
std::optional<Block> block_of(char type, std::uint32_t frame, std::string_view content,
                              const Present_points& points, std::size_t planes);

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_STREAM_BLOCK_BYTES_H
