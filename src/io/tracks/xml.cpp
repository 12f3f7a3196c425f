// SPDX-License-Identifier: GPL-3.0-or-later
#include "xml.h"

#include <algorithm>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/impl/io/text.h"

#ifdef KINETRI_WITH_EXPAT
#include <expat.h>

#include <array>
#include <cstdint>
#include <exception>
#include <istream>
#include <memory>
#include <new>
#endif

namespace kinetri {

void Xml_tracks::fail(const std::string& message) const {
  throw Input_error(input_.name, line_, message);
}

std::string_view Xml_tracks::attribute(const Xml_attributes& attributes, std::string_view element,
                                       std::string_view name) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const auto& pair) { return pair.first == name; });
  if (found != attributes.end()) return found->second;
  fail(joined("a ", element, " has no attribute ", name, "; expected one"));
}

double Xml_tracks::number(const Xml_attributes& attributes, std::string_view element,
                          std::string_view name, std::string_view or_else) const {
  const std::string_view text = attribute(attributes, element, name);
  const Parsed_number parsed = parse_number(text);
  if (parsed.problem.empty()) return parsed.value;
  fail(joined("the ", name, " of a ", element, " is ", in_quotes(text), ", which ", parsed.problem,
              or_else));
}

#ifndef KINETRI_WITH_EXPAT

void Xml_tracks::parse() {
  throw Input_error(input_.name, 0,
                    "XML cannot be read, since this kinetri was built without expat; expected a "
                    "kinetri that was built where expat is (Debian: libexpat1-dev)");
}

#else

namespace {

constexpr std::size_t piece_size = std::size_t{1} << 16U;
constexpr std::int64_t longest_token = std::int64_t{1} << 20U;
constexpr std::size_t greatest_depth = 100;

}  // namespace

// Calls `tracks` for the parts of a file.
class Xml_parser {
 public:
  explicit Xml_parser(Xml_tracks& tracks) : tracks_(tracks), parser_(XML_ParserCreate(nullptr)) {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), on_begin, on_end);
    XML_SetCharacterDataHandler(parser_.get(), on_text);
    XML_SetCommentHandler(parser_.get(), on_comment);
    XML_SetStartDoctypeDeclHandler(parser_.get(), on_doctype);
  }

  void parse() {
    std::istream& in = tracks_.input_.in;
    std::array<char, piece_size> piece;
    std::int64_t given = 0;
    for (bool is_last = false; !is_last;) {
      in.read(piece.data(), piece.size());
      if (in.bad()) fail("reading failed; expected a readable file of tracks");
      const auto size = static_cast<int>(in.gcount());
      is_last = size == 0;
      if (given == 0) heed_encoding({piece.data(), static_cast<std::size_t>(size)});
      given += size;
      const XML_Status status = XML_Parse(parser_.get(), piece.data(), size, is_last ? 1 : 0);
      if (problem_) std::rethrow_exception(problem_);
      if (status != XML_STATUS_OK) {
        // The rest of the last piece from the error on.
        const auto behind = static_cast<std::size_t>(
            std::clamp<std::int64_t>(given - XML_GetCurrentByteIndex(parser_.get()), 0, size));
        fail_for_syntax(std::string_view(piece.data(), static_cast<std::size_t>(size))
                            .substr(static_cast<std::size_t>(size) - behind));
      }
      if (given - XML_GetCurrentByteIndex(parser_.get()) >
          longest_token + static_cast<std::int64_t>(piece_size)) {
        fail_too_long();
      }
    }
  }

 private:
  struct Free {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
  };

  // Throws an error about invalid XML, at the beginning of the text.
  [[noreturn]] void fail_for_syntax(std::string_view text) {
    const XML_Error error = XML_GetErrorCode(parser_.get());
    if (error == XML_ERROR_UNKNOWN_ENCODING) {
      fail(joined("is in the encoding ", in_quotes(encoding_), "; expected UTF-8, as iconv -f ",
                  encoding_, " -t UTF-8 FILE | sed '1s/", encoding_, "/UTF-8/' makes of it"));
    }
    const std::string_view token = text.substr(0, text.find_first_of("<>\n", 1));
    const auto is_beyond_ascii = [](char c) { return static_cast<unsigned char>(c) >= 0x80; };
    if (error == XML_ERROR_INVALID_TOKEN && encoding_.empty() &&
        std::any_of(token.begin(), token.end(), is_beyond_ascii)) {
      fail(
          "has bytes that are not of UTF-8, and names no other encoding; expected UTF-8, as iconv "
          "-f WINDOWS-1252 -t UTF-8 FILE makes of it, with the encoding that it is in");
    }
    fail(joined("is not well-formed XML: ", XML_ErrorString(error), "; expected ", tracks_.content_,
                ", and all of the file"));
  }

  // A declared encoding UTF-16 is UTF-8 here: the stream has been converted, else the declaration
  // could not be read.
  void heed_encoding(std::string_view head) {
    if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);  // the byte order mark
    if (!head.starts_with("<?xml")) return;
    const std::string_view declaration = head.substr(0, head.find("?>"));
    if (in_lower_case(declaration).find("utf-16") != std::string::npos) {
      XML_SetEncoding(parser_.get(), "UTF-8");
    }
    std::string_view rest =
        declaration.substr(std::min(declaration.find("encoding"), declaration.size()));
    rest = rest.substr(std::min(rest.find_first_of("\"'"), rest.size()));
    if (!rest.empty()) encoding_ = rest.substr(1, rest.find(rest.front(), 1) - 1);
  }

  [[noreturn]] void fail(const std::string& message) {
    set_line();
    tracks_.fail(message);
  }
  [[noreturn]] void fail_too_long() {
    fail(joined("a tag or a text is longer than ", longest_token, " bytes; expected ",
                tracks_.content_));
  }

  void set_line() { tracks_.line_ = XML_GetCurrentLineNumber(parser_.get()); }

  // Exceptions must not pass through the parser, which is in C.
  template <class Function>
  static void guarded(void* self, Function function) noexcept {
    auto* const parser = static_cast<Xml_parser*>(self);
    if (parser->problem_) return;
    try {
      parser->set_line();
      function(*parser);
    } catch (...) {
      parser->problem_ = std::current_exception();
      XML_StopParser(parser->parser_.get(), XML_FALSE);
    }
  }

  static void XMLCALL on_begin(void* self, const XML_Char* name, const XML_Char** attributes) {
    guarded(self, [&](Xml_parser& parser) { parser.begin(name, attributes); });
  }
  static void XMLCALL on_end(void* self, const XML_Char* name) {
    guarded(self, [&](Xml_parser& parser) {
      parser.tracks_.end(name, parser.texts_.back(), parser.texts_.size());
      parser.texts_.pop_back();
    });
  }
  static void XMLCALL on_text(void* self, const XML_Char* text, int size) {
    guarded(self, [&](Xml_parser& parser) {
      std::string& whole = parser.texts_.back();
      const std::string_view piece(text, static_cast<std::size_t>(size));
      if (whole.empty() && piece.find_first_not_of(" \t\r\n") == std::string_view::npos) return;
      whole.append(piece);
      if (whole.size() > static_cast<std::size_t>(longest_token)) parser.fail_too_long();
    });
  }
  static void XMLCALL on_comment(void* self, const XML_Char* text) {
    guarded(self, [&](Xml_parser& parser) { parser.tracks_.comment(text); });
  }
  // Entities, which only doctypes declare, may exhaust the memory.
  static void XMLCALL on_doctype(void* self, const XML_Char* /*name*/, const XML_Char* /*system*/,
                                 const XML_Char* /*public*/, int /*has_subset*/) {
    guarded(self, [](Xml_parser& parser) {
      parser.fail(joined("has a DOCTYPE; expected none, as in ", parser.tracks_.content_));
    });
  }

  void begin(std::string_view name, const XML_Char** attributes) {
    // Blanks and line ends between children are not wanted.
    if (!texts_.empty()) texts_.back().clear();
    texts_.emplace_back();
    if (texts_.size() > greatest_depth) {
      fail(joined("elements are nested more than ", greatest_depth, " deep; expected ",
                  tracks_.content_));
    }
    attributes_.clear();
    for (; *attributes != nullptr; attributes += 2) {
      attributes_.emplace_back(attributes[0], attributes[1]);
    }
    tracks_.begin(name, attributes_, texts_.size());
  }

  Xml_tracks& tracks_;
  std::unique_ptr<XML_ParserStruct, Free> parser_;
  std::exception_ptr problem_;
  std::string encoding_;            // of the declaration, or empty
  std::vector<std::string> texts_;  // of the open elements
  Xml_attributes attributes_;
};

void Xml_tracks::parse() {
  Xml_parser(*this).parse();
}

#endif

}  // namespace kinetri
