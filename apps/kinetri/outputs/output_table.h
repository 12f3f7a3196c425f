// SPDX-License-Identifier: GPL-3.0-or-later
//
// The outputs of a run, a row for each. Options, --help, checks, opening of files and the summary
// use this table; runs/simulation_run.cpp writes the outputs.
#ifndef KINETRI_APPS_OUTPUT_TABLE_H
#define KINETRI_APPS_OUTPUT_TABLE_H

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace kinetri::app {

enum class Output {
  events,
  motions,
  certificates,
  initial_edges,
  edges,
  stats,
  ids,
  checkpoint,
  html,
  frames,
  vtu,
  plot,
  closest,
  neighbors,
  exchanges,
  nearest,
  components,
  connected,
  spanning_tree,
  areas,
  mean_areas,
  pressure,
  encounters,
  contact_plan,
};

constexpr std::size_t number_of_outputs = 24;

/// The commands that have an output.
enum class Offered {
  by_every_run,
  by_request,  ///< commands that request it, see add_run_options
};

struct Output_row {
  Output output;
  const char* option;  ///< as messages name it
  const char* names;   ///< all names of the option
  const char* type;    ///< "DIR" if it is a directory; else it is a file
  const char* help;
  Offered offered = Offered::by_every_run;
  bool has_range = false;   ///< whether it needs --range
  bool has_limits = false;  ///< whether --walkable and --cutoff limit its cells
  bool has_frames = false;  ///< whether --frames-per-time is for it

  bool is_directory() const { return type[0] == 'D'; }
};

/// In the order of the enumerators.
inline constexpr std::array<Output_row, number_of_outputs> output_table = {{
    {Output::events, "--events", "-o,--events", "FILE",
     "Write the event log here, as CSV; - is standard output"},
    {Output::motions, "--motions", "--motions", "FILE",
     "Write here the motions of the points at the start, and each later change with the number of "
     "its event, as CSV"},
    {Output::certificates, "--certificates", "--certificates", "FILE",
     "Write a proof of the time of each event here: its polynomial, and the signs of its Sturm "
     "sequence, as lines of JSON"},
    {Output::initial_edges, "--initial-edges", "--initial-edges", "FILE",
     "Write the edges of the triangulation just after the start here, as CSV"},
    {Output::edges, "--edges", "--edges", "FILE",
     "Write the edges of the triangulation at the end here, as CSV"},
    {Output::stats, "--stats", "--stats", "FILE",
     "Write counts of events and certificates, and run times, here, as JSON"},
    {Output::ids, "--ids", "--ids", "FILE",
     "Write here the id of each point of the run, and from when to when the point exists, as CSV",
     Offered::by_request},
    {Output::checkpoint, "--checkpoint", "--checkpoint", "FILE",
     "Write the state at the end, or at an interruption, here, for kinetri resume",
     Offered::by_request},
    {Output::html, "--html", "--html", "FILE", "Write a page here that plays the run in a browser"},
    {Output::frames, "--frames", "--frames", "DIR",
     "Write pictures of the run into this new directory, as SVG", Offered::by_every_run, false,
     false, true},
    {Output::vtu, "--vtu", "--vtu", "DIR",
     "Write the run into this new directory, as VTU files for ParaView", Offered::by_every_run,
     false, false, true},
    {Output::plot, "--plot", "--plot", "FILE",
     "Draw events, queue lengths and run times here, as SVG (needs gnuplot)"},
    {Output::closest, "--closest", "--closest", "FILE", "", Offered::by_request},
    {Output::neighbors, "--neighbors", "--neighbors", "FILE",
     "Write here each pair of points that were neighbors in the triangulation, and from when until "
     "when, as CSV",
     Offered::by_request},
    {Output::exchanges, "--exchanges", "--exchanges", "FILE",
     "Write here how often each point gained or lost a neighbor by an exchange (T1), as CSV",
     Offered::by_request},
    {Output::nearest, "--nearest", "--nearest", "FILE",
     "Write here the nearest neighbor of each point, and each change of it, as CSV",
     Offered::by_request},
    {Output::components, "--components", "--components", "FILE",
     "Write here each merge and split of the components that points near each other form, as CSV; "
     "needs --range",
     Offered::by_request, true},
    {Output::connected, "--connected", "--connected", "FILE",
     "Write here from when until when the points of --between were connected, by chains of points "
     "near each other, as CSV; needs --range",
     Offered::by_request, true},
    {Output::spanning_tree, "--spanning-tree", "--spanning-tree", "FILE",
     "Write the Euclidean minimum spanning tree here: its edges at the start, each change, and "
     "which edge is the longest, as CSV",
     Offered::by_request},
    {Output::areas, "--areas", "--areas", "FILE",
     "Write here the area of each point's Voronoi cell, of a disc's power cell, and the density, "
     "in each frame, as CSV",
     Offered::by_request, false, true, true},
    {Output::mean_areas, "--mean-areas", "--mean-areas", "FILE",
     "Write here the mean of that area over the time for which each point exists, as CSV",
     Offered::by_request, false, true},
    {Output::pressure, "--pressure", "--pressure", "FILE",
     "Write here the mean pressure tensor of discs that collide in a periodic box, the number of "
     "their collisions and the kinetic energy, for each interval between frames, as CSV",
     Offered::by_request, false, false, true},
    {Output::encounters, "--encounters", "--encounters", "FILE",
     "Write all pairs that come near each other here, from when until when, as CSV; needs --range",
     Offered::by_request, true},
    {Output::contact_plan, "--contact-plan", "--contact-plan", "FILE",
     "Write the same encounters here as contacts of a network, as JSON; needs --range",
     Offered::by_request, true},
}};

constexpr bool is_in_order(const std::array<Output_row, number_of_outputs>& table) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (static_cast<std::size_t>(table[i].output) != i) return false;
  }
  return true;
}
static_assert(is_in_order(output_table));

/// A path for each output that is requested; "-" is standard output.
class Output_paths {
 public:
  std::optional<std::string>& operator[](Output output) {
    return paths_[static_cast<std::size_t>(output)];
  }
  const std::optional<std::string>& operator[](Output output) const {
    return paths_[static_cast<std::size_t>(output)];
  }

 private:
  std::array<std::optional<std::string>, number_of_outputs> paths_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_OUTPUT_TABLE_H
