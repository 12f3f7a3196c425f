// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/edges_file.h"

#include <ostream>
#include <string>

#include "kinetri/impl/io/text.h"
#include "kinetri/io/event_log.h"

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

void write_periodic_edges(std::ostream& out, std::span<const Periodic_edge> edges) {
  out << "a,b,offset\n";
  std::string line;
  for (const auto& [ids, offset] : edges) {
    line.clear();
    append(line, ids[0], ',', ids[1], ',', offset_field(offset), '\n');
    out << line;
  }
}

}  // namespace kinetri
