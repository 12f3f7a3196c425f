// SPDX-License-Identifier: GPL-3.0-or-later
//
// The viewer: one HTML page that plays a recorded run. It is self-contained: it opens from a file,
// in any browser, without a network.
//
// The page consists of viewer/ (see the README there) and the recording, the JSON object in the
// element `<script type="application/json" id="recording">`:
//
//   format        2; 3 in a periodic box
//   program       "kinetri 0.1.0"
//   title         of the run, for people
//   view          absent, or the first view: `t=2&color=area`, as in an address after `#`
//   from, until   the times between which it can be played
//   points        the number of point ids: these are 0 ... points - 1
//   names         the points' names by id; absent: their ids
//   box           [xmin, ymin, xmax, ymax], or null
//   periodic      absent, or of a periodic box ten numbers, five of each of its two vectors:
//                 e, x, y, vx, vy: the vector is (x, y) + (vx, vy) (t - e). Only then there are
//                 the members `offsets` below and initial_offsets: base64 of int32, two an offset
//   radius        of the discs if all are equal and none grows; else 0
//   thinned       null, or {"events": number of events of the run} if some are left out (Recording)
//   wave          null, or {"height": h, "width": w}: the page begins with the wave. Its height is
//                 h exp(-d^2 / (2 w^2)), d the distance in y to the mean of the moving points
//   encounters    absent, or the encounters: {range, in_all, count, ids, begin, end}, in a periodic
//                 box also offsets: ids: base64 of the ids, two an encounter; offsets: those of the
//                 second points, as in events; begin and end: base64 of binary64, the first and
//                 the last number among the times of the encounter (begin > end if no number is);
//                 in_all: the number of encounters, count: that of those in the page, which is 0
//                 if there are too many
//   initial_edges base64 of the ids of the ends, two an edge: the edges at the start that are sides
//                 of no triangle, sorted. There are such edges only if all points are collinear,
//                 and none in a periodic box
//   triangles     {initial, count, event, removed, added, ids}: initial: base64 of the ids of the
//                 corners of the triangles at the start, three a triangle, counterclockwise; their
//                 sides are the other edges at the start. A flip removes the two triangles at its
//                 removed edge and adds the two at its added edge. Of the `count` other events that
//                 change triangles: event: base64 of uint32, the index of the event; removed and
//                 added: base64 of uint32, how many triangles it removes and adds; ids: base64 of
//                 the corners of these, as in initial, of each event the removed ones first. In a
//                 periodic box initial_offsets and offsets have of each triangle in initial and in
//                 ids the offsets of its second and its third corner against its first one
//   motions       {count, degree, starting, event, point, there, data, sizes}: trajectories in the
//                 order in which they begin, the first `starting` of them at the start. event:
//                 base64 of uint32, index of the event from which on it is in force, 0 for those of
//                 the start; point: base64 of ids; there: base64 of uint8, 1, or 0 if the point is
//                 gone from then on; data: base64 of binary64, each trajectory (0 of points that
//                 are gone) the epoch e, x, y, vx, vy, and, as far as `degree` (1 to 3) asks for
//                 them, ax, ay, jx, jy: x + vx s + ax s^2/2 + jx s^3/6 with s = t - e; sizes:
//                 absent if points have no weights, else base64 of binary64, each trajectory r,
//                 g and w: the disc has the radius r + g s, the point the weight (r + g s)^2 + w
//   coincidences  absent if no points coincide for a while, else {count, starting, event, point,
//                 shown}: changes of the point that has the vertex of a point, as another one that
//                 coincides with it and hides it; in order, the first `starting` of them at the
//                 start. event: as of motions; point and shown: base64 of ids, the point, and the
//                 one that has its vertex, which may be itself. Before, each has its own
//   events        {count, first, kinds, colors, kind, fields, time, ids}: first: the number of
//                 the first one in the run, 0 if some are left out; kinds: the names of the kinds;
//                 colors: a color of each kind, as `#rrggbb`; kind: base64 of uint8, indices in
//                 `kinds`; fields: base64 of uint8, the sum of 1 if an edge is removed, 2 if one is
//                 added, 4 if there is a point_a, 8 if there is a point_b, and 0, 16 or 32 if the
//                 exact time is `time`, or lies between it and the next binary64 number above (16)
//                 or below (32); time: base64 of binary64; ids: base64 of the ids in that order, an
//                 edge being two; offsets: of each edge among these, in order, that of the second
//                 end against the first one. An event without edges and points changes triangles
//                 only; it is no event of the run and has no number
//
// In base64 all numbers are little-endian, ids uint16 if points <= 65536, else uint32.
#ifndef KINETRI_IO_VIEWER_PAGE_H
#define KINETRI_IO_VIEWER_PAGE_H

#include <array>
#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinetri/simulation/recording.h"

namespace kinetri {

/// The shape of a wave whose crest are the moving points.
struct Wave_shape {
  double height = 1;  ///< of the crest
  double width = 1;   ///< standard deviation of the Gaussian, in the unit of the coordinates
};

/// The binary64 times at which two points, or discs, are within range (Encounter).
struct Viewer_encounter {
  Edge_ids points = {no_point, no_point};  ///< the smaller first
  double begin = 0;                        ///< the first number
  double end = 0;                          ///< the last number; before `begin` if there is none
  Lattice_offset_2 offset = {};            ///< of the second in a periodic box (Encounter)
};

/// The encounters of a run.
struct Viewer_encounters {
  double range = 0;                        ///< see Encounters
  std::vector<Viewer_encounter> all = {};  ///< empty if there are too many for a page
  std::size_t in_all = 0;                  ///< how many the run has
};

/// The keys of a view, each followed by `=` and a value; see docs/PROGRAM.md.
inline constexpr std::array<std::string_view, 16> viewer_words = {
    "t",  "event", "show", "hide",   "edge", "point", "follow", "color",
    "at", "kinds", "unit", "legend", "play", "theme", "list",   "draw"};

/// The content of the page besides the recording.
struct Viewer_settings {
  std::string title;                        ///< of the run, for people
  std::vector<std::string> names;           ///< of the points by id, or empty
  std::optional<Box_2> box = std::nullopt;  ///< drawn if there is one
  std::string view = {};                    ///< shown first: `t=2&color=area`; see viewer_words
  /// Of the discs, if all are equal and none grows, and the motions have no radius; else 0.
  double radius = 0;
  std::optional<Wave_shape> wave = std::nullopt;               ///< shown first if there is one
  std::optional<Viewer_encounters> encounters = std::nullopt;  ///< drawn as links if known
  std::size_t points = 0;  ///< the least number of point ids, for points that are to come
};

/// The JSON object that write_viewer_page embeds.
std::string viewer_recording(const Recording& recording, const Viewer_settings& settings);

/// Writes the page. Errors are those of the stream. The same recording gives the same bytes.
void write_viewer_page(std::ostream& out, const Recording& recording,
                       const Viewer_settings& settings);

/// The content of a page that runs by itself.
struct Live_page {
  std::string title;    ///< for people
  std::string points;   ///< a file of points; empty: the page begins with a scene of its own
  std::string options;  ///< of KineticDelaunay (live/README.md): a JSON object without apostrophes
};

/// Whether this library has been built with the module of the page (live/README.md): together with
/// the program `kinetri`, it is.
bool has_live_module();

/// Writes the page, which contains the whole library as WebAssembly. Errors are those of the
/// stream. Precondition: has_live_module().
void write_live_page(std::ostream& out, const Live_page& page);

/// The arguments of write_viewer_page.
struct Viewer_page {
  Recording recording;       ///< the run
  Viewer_settings settings;  ///< the rest
};

/// Reads a page written by write_viewer_page, in the same format. Writing the result gives the same
/// page; the numbers of the events of a thinned recording are 0. The triangles of flips are found
/// from the edges, as in the page, without predicates.
///
/// Throws Input_error, with `name` for the page, if there is no recording, or it is damaged: an
/// edge or triangle is removed that does not exist, or added twice; events are not in order; ids or
/// numbers are missing or out of range. Cost: O(rows log rows) after the text is read.
Viewer_page read_viewer_page(std::istream& in, const std::string& name);

}  // namespace kinetri

#endif  // KINETRI_IO_VIEWER_PAGE_H
