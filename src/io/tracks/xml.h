// SPDX-License-Identifier: GPL-3.0-or-later
//
// The common part of readers of tracks as XML: elements, attributes and texts, and errors with
// lines.
#ifndef KINETRI_SRC_IO_TRACKS_XML_H
#define KINETRI_SRC_IO_TRACKS_XML_H

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tracks_readers.h"

namespace kinetri {

/// Attributes of an element: names and values.
using Xml_attributes = std::vector<std::pair<std::string_view, std::string_view>>;

/// The base of such readers.
class Xml_tracks {
 public:
  /// `content` is the expected content, as "floating-car data of SUMO". All arguments must outlive
  /// it.
  Xml_tracks(const Tracks_input& input, std::string_view content)
      : input_(input), content_(content) {}
  virtual ~Xml_tracks() = default;
  Xml_tracks(const Xml_tracks&) = delete;
  Xml_tracks& operator=(const Xml_tracks&) = delete;

  /// Reads the file. Throws Input_error, also if the library was built without expat.
  void parse();

 protected:
  /// @{
  /// Called for the parts of the file. `depth` is 1 for the first element.
  virtual void begin(std::string_view name, const Xml_attributes& attributes,
                     std::size_t depth) = 0;
  /// `text` is that after the last child of the element.
  virtual void end(std::string_view /*name*/, const std::string& /*text*/, std::size_t /*depth*/) {}
  virtual void comment(std::string_view /*text*/) {}
  /// @}

  /// The line of the present part.
  std::size_t line() const { return line_; }
  [[noreturn]] void fail(const std::string& message) const;

  /// The value of the attribute. Throws Input_error if there is none.
  std::string_view attribute(const Xml_attributes& attributes, std::string_view element,
                             std::string_view name) const;

  /// The number in the attribute. `or_else` is the end of the message if it is invalid.
  double number(const Xml_attributes& attributes, std::string_view element, std::string_view name,
                std::string_view or_else = "") const;

  const Tracks_input& input() const { return input_; }

 private:
  friend class Xml_parser;

  const Tracks_input& input_;
  std::string_view content_;
  std::size_t line_ = 0;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_XML_H
