// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <system_error>

#include "cli/arguments.h"
#include "cli/documentation_commands.h"
#include "kinetri/impl/io/text.h"
#include "video/program/commands.h"

namespace kinetri::video {

app::Command program() {
  app::Command result;
  result.name = "kinetri-video";
  result.summary = "Video as moving triangles, on an exact kinetic Delaunay triangulation";
  result.description = {
      "Points with colors follow the picture from frame to frame, and the triangles between them "
      "are their Delaunay triangulation at every time. No triangle is stored: the triangulation is "
      "exact, so that every machine finds the same one. The result can be shown at any size and "
      "frame rate. Block codecs need fewer bits."};
  result.examples = {"ffmpeg -i clip.mp4 -f yuv4mpegpipe - | kinetri-video encode - clip.kvd",
                     "kinetri-video decode clip.kvd - --fps 100 --size 1920x1080 | ffplay -",
                     "kinetri-video play clip.kvd --html clip.html"};
  result.commands = {encode_command(), decode_command(), play_command(), info_command(),
                     compare_command()};
  result.exit_codes = {{0, "Done."},
                       {2, "Bad usage, input or output; standard error says what was expected."},
                       {3, "An internal check failed."},
                       {130, "Interrupted; there is no output, unless it is a pipe."},
                       {141, "The pipe at standard output has no reader any more."}};
  app::add_documentation_commands(result, "", {"kinetri-video help encode"});
  return result;
}

Ratio rate_argument(std::string_view option, std::string_view text) {
  const auto refuse = [&]() -> Ratio {
    throw app::Usage_error(joined(option, ": '", text,
                                  "' is no frame rate; expected a number greater than 0, or a "
                                  "ratio, as 25, 23.976 and 30000:1001"));
  };
  const auto whole = [&](std::string_view digits) {
    std::uint64_t number = 0;
    const char* const end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, number);
    if (error != std::errc() || stop != end || number > 1'000'000'000) refuse();
    return number;
  };
  std::uint64_t numerator = 0;
  std::uint64_t denominator = 1;
  if (const std::size_t colon = text.find_first_of(":/"); colon != std::string_view::npos) {
    numerator = whole(text.substr(0, colon));
    denominator = whole(text.substr(colon + 1));
  } else if (const std::size_t point = text.find('.'); point != std::string_view::npos) {
    const std::string_view decimals = text.substr(point + 1);
    if (decimals.size() > 6 || point > 4) refuse();
    for (std::size_t i = 0; i < decimals.size(); ++i) denominator *= 10;
    numerator = whole(text.substr(0, point)) * denominator + whole(decimals);
  } else {
    numerator = whole(text);
  }
  if (numerator == 0 || denominator == 0) refuse();
  const std::uint64_t divisor = std::gcd(numerator, denominator);
  if (numerator / divisor > UINT32_MAX) refuse();
  return {static_cast<std::uint32_t>(numerator / divisor),
          static_cast<std::uint32_t>(denominator / divisor)};
}

void check_output(std::string_view argument, const std::string& output, const std::string& input) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (!fs::is_regular_file(output, ignored) || !fs::equivalent(input, output, ignored)) return;
  throw app::Usage_error(joined(argument, ": ", output, " is the input; expected another file"));
}

}  // namespace kinetri::video
