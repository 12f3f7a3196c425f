// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/edges_file.h"

#include <ostream>
#include <string>

#include "kinetri/impl/io/text.h"

namespace kinetri {

void write_edges(std::ostream& out, std::span<const Edge_ids> edges) {
  out << "a,b\n";
  std::string line;
  for (const Edge_ids& edge : edges) {
    line.clear();
    append(line, edge[0], ',', edge[1], '\n');
    out << line;
  }
}

}  // namespace kinetri
