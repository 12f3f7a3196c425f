// SPDX-License-Identifier: GPL-3.0-or-later
//
// Input without line ends is refused after a limited number of bytes, whichever reader has it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <istream>
#include <sstream>
#include <streambuf>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/io/checkpoint_file.h"
#include "kinetri/io/points_file.h"
#include "kinetri/io/tracks_file.h"

namespace kinetri::endless_input_test {
namespace {

// Gives a text and then one byte for ever. It counts what it has given, and ends far beyond every
// limit, so that a reader without one fails instead of taking all memory.
class Endless_buffer : public std::streambuf {
 public:
  Endless_buffer(std::string beginning, char byte)
      : piece_(std::move(beginning)), next_(4096, byte) {
    setg(piece_.data(), piece_.data(), piece_.data() + piece_.size());
    given_ = piece_.size();
  }
  std::size_t given() const { return given_; }

 protected:
  int_type underflow() override {
    constexpr std::size_t most = std::size_t{1} << 27U;
    if (given_ > most) return traits_type::eof();
    piece_ = next_;
    given_ += piece_.size();
    setg(piece_.data(), piece_.data(), piece_.data() + piece_.size());
    return traits_type::to_int_type(*gptr());
  }

 private:
  std::string piece_;
  std::string next_;
  std::size_t given_ = 0;
};

struct Reader {
  const char* name;
  std::function<void(std::istream&)> read;
  std::vector<std::string> beginnings;  // of files that it accepts so far
  std::size_t longest_line;
};

const std::vector<Reader>& readers() {
  constexpr std::size_t of_tables = std::size_t{1} << 20U;
  constexpr std::size_t of_checkpoints = std::size_t{1} << 24U;
  static const std::vector<Reader> all = {
      {"points",
       [](std::istream& in) { read_points(in, "in"); },
       {"", "#", "x,y,vx,vy\n", "x,y,vx,vy\n1,2,3,4\n#", "x,y,vx,vy\n1,2,3,"},
       of_tables},
      {"rows",
       [](std::istream& in) { read_tracks(in, "in", Tracks_format::rows); },
       {"", "#", "t,id,x,y\n", "t,id,x,y\n0,a,1,"},
       of_tables},
      {"frames",
       [](std::istream& in) { read_tracks(in, "in", Tracks_format::frames, 1); },
       {"", "#", "0 a 1 2\n", "0 a 1 "},
       of_tables},
      {"ids",
       [](std::istream& in) { read_tracks(in, "in", Tracks_format::ids); },
       {"", "#", "0 1 2 3 4\n", "# id frame x y\n0 1 "},
       of_tables},
      {"tables",
       [](std::istream& in) {
         read_tracks(in, "in",
                     {.format = Tracks_format::table,
                      .columns = {.t = "t", .id = "id", .x = "x", .y = "y"}});
       },
       {"", "#", "t;id;x;y\n", "t,id,x,y\n0,\"a"},
       of_tables},
      {"dumps",
       [](std::istream& in) { read_tracks(in, "in", Tracks_format::lammps); },
       {"", "ITEM: TIMESTEP\n",
        "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS id x y\n1 "},
       of_tables},
      {"xyz",
       [](std::istream& in) { read_tracks(in, "in", Tracks_format::xyz); },
       {"", "1", "1\n", "1\n\nAr 1 "},
       of_tables},
      {"recognized",
       [](std::istream& in) { read_tracks(in, "in", Tracks_format::automatic); },
       {"", "#", "t,id,x,y\n", "0 a 1 2\n", "0 1 2 3\n0 ", "ITEM: ", "1\n"},
       of_tables},
      {"checkpoint",
       [](std::istream& in) { read_checkpoint(in, "in"); },
       {"kinetri checkpoint 8\n", "kinetri checkpoint 8\n{\n\"motion\":\""},
       of_checkpoints}};
  return all;
}

TEST(Endless_input, is_refused_when_a_line_is_too_long) {
  for (const Reader& reader : readers()) {
    for (const std::string& beginning : reader.beginnings) {
      for (const char byte : {'\0', '1', ' ', ',', '"', '#'}) {
        SCOPED_TRACE(std::string(reader.name) + " '" + beginning + "' and " + byte);
        Endless_buffer buffer(beginning, byte);
        std::istream in(&buffer);
        try {
          reader.read(in);
          FAIL() << "no error";
        } catch (const Input_error& error) {
          const auto lines = std::count(beginning.begin(), beginning.end(), '\n');
          const std::string expected = "in:" + std::to_string(lines + 1) +
                                       ": the line is longer than " +
                                       std::to_string(reader.longest_line) + " bytes; expected";
          EXPECT_EQ(std::string(error.what()).rfind(expected, 0), 0U) << error.what();
        }
        EXPECT_GT(buffer.given(), reader.longest_line);
        // A buffer of the reader's may be as long again; 2^16 bytes are read to recognize a format.
        EXPECT_LE(buffer.given(), beginning.size() + 2 * reader.longest_line + (1U << 16U) + 4096);
      }
    }
  }
}

TEST(Endless_input, that_is_no_checkpoint_is_refused_after_its_first_bytes) {
  for (const std::string beginning : {"", "x,y,vx,vy\n", "kinetri checkpoint 9\n", "kinetri "}) {
    Endless_buffer buffer(beginning, '\0');
    std::istream in(&buffer);
    EXPECT_THROW(read_checkpoint(in, "in"), Input_error);
    EXPECT_LE(buffer.given(), beginning.size() + 4096);
  }
}

// The longest line that is not too long is read, and so is not why the file is refused.
TEST(Endless_input, line_of_a_checkpoint_may_have_2_to_the_24_bytes) {
  constexpr std::size_t longest_line = std::size_t{1} << 24U;
  const auto problem = [](std::size_t size) -> std::string {
    // The line lies across the ends of the pieces in which a file is read.
    std::istringstream in("kinetri checkpoint 8\n{\n" + std::string(size, ' ') + "\n}\n");
    try {
      read_checkpoint(in, "in");
    } catch (const Input_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(problem(longest_line).rfind("in: is cut short", 0), 0U) << problem(longest_line);
  EXPECT_EQ(problem(longest_line + 1).rfind("in:3: the line is longer than 16777216 bytes", 0), 0U)
      << problem(longest_line + 1);
}

}  // namespace
}  // namespace kinetri::endless_input_test
