// SPDX-License-Identifier: GPL-3.0-or-later
#include <kinetri/io/tracks_file.h>

#include <iostream>
#include <sstream>

int main() {
  std::istringstream rows("t,id,x,y\n0,a,0,0\n2,a,2,0\n0,b,0,1\n2,b,0,3\n");
  const kinetri::Tracks_file file =
      kinetri::read_tracks(rows, "rows", kinetri::Tracks_file_options{});
  for (const kinetri::Track& track : file.tracks) {
    std::cout << track.id << ": " << track.observations.size() << " observations\n";
  }
}
