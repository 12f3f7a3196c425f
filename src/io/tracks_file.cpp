// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/tracks_file.h"

#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <streambuf>
#include <utility>

#include "io/tracks/local_projection.h"
#include "io/tracks/tracks_readers.h"
#include "kinetri/base/check.h"
#include "kinetri/base/error.h"
#include "text.h"
#include "text_table.h"

namespace kinetri {
namespace {

constexpr std::size_t head_size = std::size_t{1} << 16U;

[[noreturn]] void fail_to_read(const std::string& name) {
  throw Input_error(name, 1, "reading failed; expected a readable file of tracks");
}

// Gives the beginning of a stream, which was read to recognize its format, and then the rest.
class Replayed_buffer : public std::streambuf {
 public:
  Replayed_buffer(std::string head, std::istream& rest) : piece_(std::move(head)), rest_(rest) {
    setg(piece_.data(), piece_.data(), piece_.data() + piece_.size());
  }

 protected:
  int_type underflow() override {
    piece_.resize(head_size);
    rest_.read(piece_.data(), static_cast<std::streamsize>(piece_.size()));
    // An exception makes the stream of this buffer bad as well.
    if (rest_.bad()) throw std::ios_base::failure("reading failed");
    const auto end = static_cast<std::size_t>(rest_.gcount());
    setg(piece_.data(), piece_.data(), piece_.data() + end);
    return end == 0 ? traits_type::eof() : traits_type::to_int_type(*gptr());
  }

 private:
  std::string piece_;
  std::istream& rest_;
};

std::string_view without_byte_order_mark(std::string_view head) {
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  return head;
}

bool has_named_columns(Tracks_format format) {
  return format == Tracks_format::table || format == Tracks_format::geojson;
}

// The reader of a file that begins so.
const Tracks_reader& reader_of(std::string_view head, const Tracks_input& input) {
  const std::span<const Tracks_reader> readers = tracks_readers();
  const auto reader = [&](Tracks_format format) -> const Tracks_reader& {
    return readers[static_cast<std::size_t>(format)];
  };
  const auto of_format = [&](Tracks_format format) { return reader(format).recognizes(head); };
  if (const std::string foreign = foreign_format(head); !foreign.empty()) {
    throw Input_error(input.name, 0, foreign);
  }
  // Those that are recognized by their first bytes come last in the table.
  for (std::size_t i = readers.size(); i-- > 0;) {
    const Tracks_format format = readers[i].name.format;
    if (!of_format(format)) continue;
    const bool is_table = format == Tracks_format::rows || format == Tracks_format::automatic;
    if (input.options.columns.is_empty() || has_named_columns(format)) return readers[i];
    if (is_table) return reader(Tracks_format::table);
    throw Input_error(input.name, 0,
                      joined("seems to be of the format ", readers[i].name.name,
                             ", whose columns have names already; expected no --columns"));
  }
  return reader(input.options.columns.is_empty() ? Tracks_format::rows : Tracks_format::table);
}

Tracks_file projected(Tracks_file file, const Tracks_input& input) {
  if (input.options.projection == Tracks_projection::local) project_locally(file, input.name);
  return file;
}

Tracks_file read_recognized(const Tracks_input& input) {
  std::string head(head_size, '\0');
  input.in.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (input.in.bad()) fail_to_read(input.name);
  head.resize(static_cast<std::size_t>(input.in.gcount()));
  const Tracks_reader& reader = reader_of(without_byte_order_mark(head), input);
  Replayed_buffer buffer(std::move(head), input.in);
  std::istream whole(&buffer);
  return reader.read({whole, input.name, input.options});
}

Tracks_file read_as(Tracks_format format, const Tracks_input& input) {
  const Tracks_reader& reader = tracks_readers()[static_cast<std::size_t>(format)];
  if (!input.options.columns.is_empty() && !has_named_columns(format)) {
    throw Input_error(input.name, 0,
                      joined("is read in the format ", reader.name.name,
                             ", whose columns have names already; expected no --columns, or "
                             "--format table"));
  }
  return reader.read(input);
}

Tracks_file_options options_of(Tracks_format format, double fps) {
  Tracks_file_options options;
  options.format = format;
  const bool has_rate = format == Tracks_format::frames || fps != 0;
  if (has_rate && format != Tracks_format::rows) options.fps = fps;
  return options;
}

}  // namespace

std::span<const Tracks_format_name> tracks_formats() {
  static const std::vector<Tracks_format_name> all = [] {
    std::vector<Tracks_format_name> names;
    for (const Tracks_reader& reader : tracks_readers()) names.push_back(reader.name);
    return names;
  }();
  return all;
}

Input_error tracks_error(const std::string& name, std::string_view place_name, std::size_t line,
                         const std::string& message) {
  if (line == 0 || place_name == "line") return Input_error(name, line, message);
  return Input_error(name, 0, joined(place_name, ' ', line, ": ", message));
}

Tracks_file read_tracks(std::istream& in, const std::string& name,
                        const Tracks_file_options& options) {
  KINETRI_PRECONDITION(!options.fps || (std::isfinite(*options.fps) && *options.fps > 0),
                       "the number of frames a second is not a finite number greater than 0");
  // A stream that has failed before would look like a file without frames.
  if (in.fail()) fail_to_read(name);
  const Tracks_input input = {in, name, options};
  return projected(options.format == Tracks_format::automatic ? read_recognized(input)
                                                              : read_as(options.format, input),
                   input);
}

Tracks_file read_tracks(std::istream& in, const std::string& name, Tracks_format format,
                        double fps) {
  return read_tracks(in, name, options_of(format, fps));
}

Tracks_file read_tracks_file(const std::string& path, const Tracks_file_options& options) {
  if (path == "-") return read_tracks(std::cin, "standard input", options);
  std::ifstream in = open_table(path, tracks_kind);
  return read_tracks(in, path, options);
}

Tracks_file read_tracks_file(const std::string& path, Tracks_format format, double fps) {
  return read_tracks_file(path, options_of(format, fps));
}

}  // namespace kinetri
