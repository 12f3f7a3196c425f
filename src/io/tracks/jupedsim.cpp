// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracks in a database of SQLite as JuPedSim writes them: trajectory_data(frame, id, pos_x, pos_y),
// metadata(key, value) with fps, and the walkable area in geometry(wkt). Version 2 has a hash
// beside each area, and one area for each frame; version 3 leaves the orientation out.
#include <cstdint>
#include <optional>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/impl/io/text.h"
#include "tracks_readers.h"

#ifdef KINETRI_WITH_SQLITE
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <istream>
#include <memory>
#include <new>
#include <vector>
#endif

namespace kinetri {

bool is_sqlite(std::string_view head) {
  constexpr std::string_view magic("SQLite format 3\0", 16);
  return head.starts_with(magic);
}

#ifndef KINETRI_WITH_SQLITE

Tracks_file read_jupedsim(const Tracks_input& input) {
  throw Input_error(input.name, 0,
                    "databases of SQLite cannot be read, since this kinetri was built without it; "
                    "expected a kinetri that was built where SQLite is (Debian: libsqlite3-dev)");
}

#else

namespace {

constexpr std::size_t header_size = 100;
constexpr int longest_value = 1 << 26;  // of a walkable area, in bytes
constexpr int instructions_between_checks = 1000;

// The whole database, with the size in its header.
std::string bytes_of(const Tracks_input& input) {
  const auto fail = [&](const std::string& message) { throw Input_error(input.name, 0, message); };
  const auto append_up_to = [&](std::string& bytes, std::uint64_t size) {
    constexpr std::uint64_t piece = std::uint64_t{1} << 20U;
    while (bytes.size() < size) {
      const std::size_t before = bytes.size();
      bytes.resize(before + static_cast<std::size_t>(std::min(piece, size - before)));
      input.in.read(bytes.data() + before, static_cast<std::streamsize>(bytes.size() - before));
      if (input.in.bad()) fail("reading failed; expected a readable file of tracks");
      bytes.resize(before + static_cast<std::size_t>(input.in.gcount()));
      if (bytes.size() == before) break;
    }
  };
  std::string bytes;
  append_up_to(bytes, header_size);
  if (!is_sqlite(bytes)) fail("is no database of SQLite; expected one that JuPedSim wrote");
  // https://www.sqlite.org/fileformat.html, section 1.3: big-endian numbers.
  const auto number = [&](std::size_t offset, std::size_t size) {
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < size; ++i) {
      result = result << 8U | static_cast<unsigned char>(bytes[offset + i]);
    }
    return result;
  };
  if (bytes.size() == header_size) {
    if (number(18, 1) == 2 || number(19, 1) == 2) {
      fail(
          "is a database with a write-ahead log, the rows of which may be in another file; "
          "expected one file: sqlite3 FILE 'PRAGMA journal_mode=DELETE' makes it");
    }
    const std::uint64_t page = number(16, 2) == 1 ? 65536 : number(16, 2);
    const std::uint64_t size = page * number(28, 4);
    append_up_to(bytes, size);
    if (size >= header_size && bytes.size() == size) return bytes;
  }
  fail(joined("is cut short: it ends after ", bytes.size(),
              " bytes; expected as many as its header says"));
  return bytes;
}

class Database {
 public:
  Database(const Tracks_input& input, std::string& bytes) : input_(input) {
    sqlite3* opened = nullptr;
    const int code = sqlite3_open_v2(":memory:", &opened, SQLITE_OPEN_READWRITE, nullptr);
    database_.reset(opened);
    if (code != SQLITE_OK) fail("SQLite cannot be started; expected enough memory");
    // Disables content of files that could compute endlessly, or read other files.
    sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
    sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, longest_value);
    steps_left_ = 1000 + static_cast<std::int64_t>(bytes.size());
    sqlite3_progress_handler(opened, instructions_between_checks, is_too_long, &steps_left_);
    const auto size = static_cast<sqlite3_int64>(bytes.size());
    if (sqlite3_deserialize(opened, "main", reinterpret_cast<unsigned char*>(bytes.data()), size,
                            size, SQLITE_DESERIALIZE_READONLY) != SQLITE_OK) {
      fail_as_damaged();
    }
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw Input_error(input_.name, 0, message);
  }
  [[noreturn]] void fail_as_damaged() const {
    fail(joined("is damaged: SQLite says ", in_quotes(sqlite3_errmsg(database_.get())),
                "; expected a database as JuPedSim writes it"));
  }

  sqlite3* get() const { return database_.get(); }

 private:
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close(database); }
  };

  static int is_too_long(void* steps_left) {
    return --*static_cast<std::int64_t*>(steps_left) < 0 ? 1 : 0;
  }

  const Tracks_input& input_;
  std::int64_t steps_left_ = 0;
  std::unique_ptr<sqlite3, Close> database_;
};

// The rows of a query.
class Query {
 public:
  // `expected` ends the message if the query does not fit the tables.
  Query(const Database& database, const std::string& text, std::string_view expected)
      : database_(database) {
    sqlite3_stmt* prepared = nullptr;
    const int code = sqlite3_prepare_v2(database.get(), text.c_str(), -1, &prepared, nullptr);
    statement_.reset(prepared);
    if (code == SQLITE_ERROR) {
      database.fail(joined("does not have the tables of JuPedSim: SQLite says ",
                           in_quotes(sqlite3_errmsg(database.get())), "; expected ", expected));
    }
    if (code != SQLITE_OK) database.fail_as_damaged();
  }

  bool next() {
    const int code = sqlite3_step(statement_.get());
    if (code != SQLITE_ROW && code != SQLITE_DONE) database_.fail_as_damaged();
    return code == SQLITE_ROW;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (int i = 0; i < sqlite3_column_count(statement_.get()); ++i) {
      const char* const name = sqlite3_column_name(statement_.get(), i);
      if (name == nullptr) throw std::bad_alloc();
      result.emplace_back(name);
    }
    return result;
  }

  int type(int column) const { return sqlite3_column_type(statement_.get(), column); }
  bool is_number(int column) const {
    return type(column) == SQLITE_INTEGER || type(column) == SQLITE_FLOAT;
  }
  // Whole numbers are rounded to nearest, as SQLite does for columns of the type REAL.
  double number(int column) const {
    return type(column) == SQLITE_INTEGER
               ? static_cast<double>(sqlite3_column_int64(statement_.get(), column))
               : sqlite3_column_double(statement_.get(), column);
  }
  // Of a number or a text, valid until next().
  std::string_view text(int column) const {
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
    const int size = sqlite3_column_bytes(statement_.get(), column);
    return text == nullptr ? std::string_view()
                           : std::string_view(text, static_cast<std::size_t>(size));
  }

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };

  const Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

class Jupedsim_reader {
 public:
  explicit Jupedsim_reader(const Tracks_input& input)
      : input_(input),
        bytes_(bytes_of(input)),
        database_(input, bytes_),
        builder_(input.name, input.options.duplicates, "row") {}

  Tracks_file read() {
    if (!has_table("trajectory_data")) {
      database_.fail("has no table trajectory_data; expected a database as JuPedSim writes it");
    }
    read_metadata();
    read_rows();
    Tracks_file result = builder_.finish();
    result.format = Tracks_format::jupedsim;
    note_frame_rate(result, input_, file_rate_, "frames");
    read_walkable_area(result);
    note_unused(result);
    return result;
  }

 private:
  // Not a view, nor a virtual table.
  bool has_table(const std::string& name) const {
    Query query(database_,
                "SELECT 1 FROM sqlite_master WHERE type = 'table' AND rootpage > 0 AND name = '" +
                    name + "'",
                "a database as JuPedSim writes it");
    return query.next();
  }

  void read_metadata() {
    if (has_table("metadata")) {
      Query query(database_, "SELECT key, value FROM metadata",
                  "the columns key and value in metadata");
      while (query.next()) {
        const std::string key(query.text(0));
        if (key == "version") expect_version(query.text(1));
        if (key == "fps") take_frame_rate(query.text(1));
      }
    }
    if (!file_rate_ && !input_.options.fps) {
      database_.fail("has no frame rate; expected a row with the key fps in metadata, or --fps");
    }
  }

  void expect_version(std::string_view version) const {
    if (version == "1" || version == "2" || version == "3") return;
    database_.fail(joined("is of the version ", in_quotes(version), "; expected 1, 2 or 3"));
  }

  void take_frame_rate(std::string_view text) {
    const Parsed_number rate = parse_number(text);
    if (!rate.problem.empty() || rate.value <= 0) {
      database_.fail(
          joined("the fps in metadata is ", in_quotes(text), "; expected a number greater than 0"));
    }
    if (input_.options.fps && *input_.options.fps != rate.value) {
      database_.fail(joined("metadata gives ", rate.value,
                            " frames a second, but the file is read with ", *input_.options.fps,
                            "; expected the same rate"));
    }
    file_rate_ = rate.value;
  }

  void read_rows() {
    Query query(database_, "SELECT frame, id, pos_x, pos_y FROM trajectory_data",
                "the columns frame, id, pos_x and pos_y in trajectory_data");
    const double fps = frame_rate(input_.options, file_rate_);
    std::size_t row = 0;
    while (query.next()) {
      ++row;
      // A row has several bytes: pages of a damaged database may form a cycle.
      if (row > bytes_.size()) {
        database_.fail(
            "is damaged: it has more rows than bytes; expected a database as JuPedSim "
            "writes it");
      }
      Tracks_row seen;
      Parsed_time time = time_of_frame(number(query, row, 0, "frame"), fps);
      if (!time.problem.empty()) builder_.fail(row, time.problem);
      seen.time = time.value;
      if (query.type(1) == SQLITE_BLOB || query.text(1).empty()) {
        builder_.fail(row, "the column id is empty, or bytes; expected a number or a text");
      }
      seen.id = query.text(1);
      seen.place = {number(query, row, 2, "pos_x"), number(query, row, 3, "pos_y")};
      seen.line = row;
      builder_.add(seen);
    }
  }

  double number(const Query& query, std::size_t row, int column, std::string_view name) const {
    if (!query.is_number(column)) {
      builder_.fail(row, joined("the column ", name, " is ",
                                query.type(column) == SQLITE_NULL ? "empty" : "no number",
                                "; expected a number"));
    }
    const double result = query.number(column);
    if (!std::isfinite(result)) {
      builder_.fail(row, joined("the column ", name, " is ", result,
                                ", which is not finite; expected a finite number"));
    }
    return result;
  }

  void read_walkable_area(Tracks_file& file) {
    if (!has_table("geometry")) return;
    Query query(database_, "SELECT wkt FROM geometry", "the column wkt in geometry");
    bool has_several = false;
    while (query.next()) {
      const std::string_view area = query.text(0);
      if (query.type(0) != SQLITE_TEXT || area.empty()) {
        database_.fail("the wkt in geometry is no text; expected the walkable area as WKT");
      }
      has_several = has_several || (!file.walkable_area.empty() && file.walkable_area != area);
      file.walkable_area = area;
    }
    if (has_several) {
      file.walkable_area.clear();
      file.remarks.push_back("the walkable area changes, and is left out");
    }
  }

  // Names in SQLite are case-insensitive.
  void note_unused(Tracks_file& file) const {
    constexpr std::array<std::string_view, 4> used = {"frame", "id", "pos_x", "pos_y"};
    Unused_names unused;
    const Query query(database_, "SELECT * FROM trajectory_data", "its columns");
    for (const std::string& name : query.names()) {
      if (std::find(used.begin(), used.end(), in_lower_case(name)) == used.end()) unused.add(name);
    }
    unused.add_remarks(file);
  }

  const Tracks_input& input_;
  std::string bytes_;
  Database database_;
  Tracks_builder builder_;
  std::optional<double> file_rate_;
};

}  // namespace

Tracks_file read_jupedsim(const Tracks_input& input) {
  return Jupedsim_reader(input).read();
}

#endif

}  // namespace kinetri
