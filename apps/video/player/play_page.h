// SPDX-License-Identifier: GPL-3.0-or-later
//
// A page that plays a stream: one HTML file that needs no network.
//
// The page has the files of this folder, and the element `<script type="application/json"
// id="stream">` with the object
//
//   title     for people
//   width, height, frames, rate    of the source; rate as [numerator, denominator]
//   unit      of places, in pixels
//   segments  for each segment {begin, end, groups, initial, times, counts, changes}: begin, end:
//   of
//             what moves, in frames; groups: {begin, end, ids, places, colors}: ids of the points;
//             places: x and y at the beginning and at the end of the group; colors: red, green and
//             blue at the beginning and at the end; initial: the corners of the triangles at the
//             beginning; times: at which triangles change, rounded; counts: how many triangles are
//             removed and added then; changes: the corners of these, the removed ones first
//
// Lists of numbers are base64: int32 (ids, places, initial, counts, changes), int16 (colors) or
// binary64 (times), the least significant byte first.
#ifndef KINETRI_VIDEO_PLAYER_PLAY_PAGE_H
#define KINETRI_VIDEO_PLAYER_PLAY_PAGE_H

#include <iosfwd>
#include <string>

#include "video/stream/stream_reader.h"

namespace kinetri::video {

/// Reads the stream, runs its triangulation, and writes the page. Throws Damaged_stream_error, and
/// then has written nothing. The same stream gives the same bytes.
void write_play_page(std::ostream& out, Stream_reader& stream, const std::string& title);

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_PLAYER_PLAY_PAGE_H
