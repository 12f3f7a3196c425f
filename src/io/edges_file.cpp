// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/edges_file.h"

#include <fmt/format.h>

#include <iterator>
#include <ostream>

namespace kinetri {

void write_edges(std::ostream& out, std::span<const Edge_ids> edges) {
  out << "a,b\n";
  fmt::memory_buffer line;
  for (const Edge_ids& edge : edges) {
    line.clear();
    fmt::format_to(std::back_inserter(line), "{},{}\n", edge[0], edge[1]);
    out.write(line.data(), static_cast<std::streamsize>(line.size()));
  }
}

}  // namespace kinetri
