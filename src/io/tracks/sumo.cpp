// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracks as floating-car data of SUMO (--fcd-output): <fcd-export> with elements <timestep
// time="..">, and in these <vehicle id=".." x=".." y=".."/>, <person> and <container>.
#include <cstdint>

#include "io/text.h"
#include "kinetri/base/error.h"
#include "kinetri/io/points_file.h"
#include "tracks_readers.h"

#ifdef KINETRI_WITH_EXPAT
#include <expat.h>

#include <array>
#include <exception>
#include <functional>
#include <istream>
#include <map>
#include <memory>
#include <new>
#endif

namespace kinetri {

bool is_xml(std::string_view head) {
  const std::size_t begin = head.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && head[begin] == '<';
}

#ifndef KINETRI_WITH_EXPAT

Tracks_file read_sumo(const Tracks_input& input) {
  throw Input_error(input.name, 0,
                    "XML cannot be read, since this kinetri was built without expat; expected a "
                    "kinetri that was built where expat is (Debian: libexpat1-dev)");
}

#else

namespace {

constexpr std::size_t piece_size = std::size_t{1} << 16U;
constexpr std::int64_t longest_token = std::int64_t{1} << 20U;
constexpr std::size_t greatest_depth = 100;

class Sumo_reader {
 public:
  explicit Sumo_reader(const Tracks_input& input)
      : input_(input), builder_(input.name), parser_(XML_ParserCreate(nullptr)) {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), on_begin, on_end);
    XML_SetStartDoctypeDeclHandler(parser_.get(), on_doctype);
  }

  Tracks_file read() {
    std::array<char, piece_size> piece;
    std::int64_t given = 0;
    for (bool is_last = false; !is_last;) {
      input_.in.read(piece.data(), piece.size());
      if (input_.in.bad()) fail("reading failed; expected a readable file of tracks");
      const auto size = static_cast<int>(input_.in.gcount());
      is_last = size == 0;
      given += size;
      const XML_Status status = XML_Parse(parser_.get(), piece.data(), size, is_last ? 1 : 0);
      if (problem_) std::rethrow_exception(problem_);
      if (status != XML_STATUS_OK) {
        fail(joined("is no XML as it should be: ", XML_ErrorString(XML_GetErrorCode(parser_.get())),
                    "; expected floating-car data of SUMO, as far as it was written"));
      }
      if (given - XML_GetCurrentByteIndex(parser_.get()) >
          longest_token + static_cast<std::int64_t>(piece_size)) {
        fail(joined("a tag or a text is longer than ", longest_token,
                    " bytes; expected floating-car data of SUMO"));
      }
    }
    Tracks_file result = builder_.finish();
    result.format = Tracks_format::sumo;
    return result;
  }

 private:
  struct Free {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
  };

  // Exceptions must not pass through the parser, which is written in C.
  template <class Function>
  void guarded(Function function) noexcept {
    if (problem_) return;
    try {
      function();
    } catch (...) {
      problem_ = std::current_exception();
      XML_StopParser(parser_.get(), XML_FALSE);
    }
  }

  static void XMLCALL on_begin(void* self, const XML_Char* name, const XML_Char** attributes) {
    auto* const reader = static_cast<Sumo_reader*>(self);
    reader->guarded([&] { reader->begin(name, attributes); });
  }

  static void XMLCALL on_end(void* self, const XML_Char* /*name*/) {
    --static_cast<Sumo_reader*>(self)->depth_;
  }

  // Entities may grow beyond all memory, and stand in doctypes alone.
  static void XMLCALL on_doctype(void* self, const XML_Char* /*name*/, const XML_Char* /*system*/,
                                 const XML_Char* /*public*/, int /*has_subset*/) {
    auto* const reader = static_cast<Sumo_reader*>(self);
    reader->guarded(
        [&] { reader->fail("has a DOCTYPE, which SUMO does not write; expected none"); });
  }

  std::size_t line() const { return XML_GetCurrentLineNumber(parser_.get()); }

  [[noreturn]] void fail(const std::string& message) const {
    throw Input_error(input_.name, line(), message);
  }

  void begin(std::string_view name, const XML_Char** attributes) {
    ++depth_;
    if (depth_ > greatest_depth) {
      fail(joined("elements are nested more than ", greatest_depth,
                  " deep; expected floating-car data of SUMO"));
    }
    if (depth_ == 1 && name != "fcd-export") {
      fail(joined("the first element is ", quoted(name),
                  "; expected 'fcd-export', as SUMO writes it with --fcd-output"));
    }
    if (depth_ == 2) {
      is_in_timestep_ = name == "timestep";
      if (is_in_timestep_) time_ = number(attributes, name, "time");
    }
    const bool moves = name == "vehicle" || name == "person" || name == "container";
    if (depth_ == 3 && is_in_timestep_ && moves) add(name, attributes);
  }

  void add(std::string_view kind, const XML_Char** attributes) {
    Tracks_row row;
    row.id = attribute(attributes, kind, "id");
    if (row.id.empty()) fail(joined("the id of a ", kind, " is empty; expected any text"));
    row.time.number = time_;
    row.place = {number(attributes, kind, "x"), number(attributes, kind, "y")};
    row.line = line();
    expect_kind(row, kind);
    builder_.add(row);
  }

  // A vehicle and a person with one id are two things.
  void expect_kind(const Tracks_row& row, std::string_view kind) {
    const auto found = kinds_.find(row.id);
    if (found == kinds_.end()) {
      kinds_.emplace(row.id, Kind{std::string(kind), row.line});
    } else if (found->second.name != kind) {
      fail(joined("id ", quoted(row.id), " is a ", kind, ", but a ", found->second.name,
                  " in line ", found->second.line, "; expected ids that differ"));
    }
  }

  std::string_view attribute(const XML_Char** attributes, std::string_view element,
                             std::string_view name) const {
    for (; *attributes != nullptr; attributes += 2) {
      if (attributes[0] == name) return attributes[1];
    }
    fail(joined("a ", element, " has no attribute ", name, "; expected one"));
  }

  double number(const XML_Char** attributes, std::string_view element,
                std::string_view name) const {
    const std::string_view text = attribute(attributes, element, name);
    const Parsed_number parsed = parse_number(text);
    if (parsed.problem.empty()) return parsed.value;
    fail(joined("the ", name, " of a ", element, " is ", quoted(text), ", which ", parsed.problem,
                name == "time" ? ", as SUMO writes it without --human-readable-time" : ""));
  }

  struct Kind {
    std::string name;
    std::size_t line;
  };

  const Tracks_input& input_;
  Tracks_builder builder_;
  std::unique_ptr<XML_ParserStruct, Free> parser_;
  std::exception_ptr problem_;
  std::size_t depth_ = 0;
  bool is_in_timestep_ = false;
  double time_ = 0;
  std::map<std::string, Kind, std::less<>> kinds_;  // of each id
};

}  // namespace

Tracks_file read_sumo(const Tracks_input& input) {
  return Sumo_reader(input).read();
}

#endif

}  // namespace kinetri
