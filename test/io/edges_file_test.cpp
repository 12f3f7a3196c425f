// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of edges.
#include "kinetri/io/edges_file.h"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

namespace kinetri::edges_file_test {
namespace {

TEST(Write_edges, writes_a_header_and_one_edge_a_line) {
  std::ostringstream out;
  write_edges(out, std::vector<Edge_ids>{{0, 1}, {0, 4294967294}, {12, 345}});
  EXPECT_EQ(out.str(), "a,b\n0,1\n0,4294967294\n12,345\n");
}

TEST(Write_edges, without_edges_writes_the_header) {
  std::ostringstream out;
  write_edges(out, {});
  EXPECT_EQ(out.str(), "a,b\n");
}

TEST(Write_periodic_edges, writes_offsets) {
  std::ostringstream out;
  write_periodic_edges(out, std::vector<Periodic_edge>{{{0, 0}, {0, 1}}, {{2, 31}, {-4, 5}}});
  EXPECT_EQ(out.str(), "a,b,offset\n0,0,0 1\n2,31,-4 5\n");
}

}  // namespace
}  // namespace kinetri::edges_file_test
