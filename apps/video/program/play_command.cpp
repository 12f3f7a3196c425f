// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <string>

#include "kinetri/impl/io/output_file.h"
#include "video/player/play_page.h"
#include "video/program/commands.h"

namespace kinetri::video {
namespace {

// The texts of the options.
struct Play_options {
  std::string input;
  std::string page;
};

}  // namespace

app::Command play_command() {
  const auto options = std::make_shared<Play_options>();
  app::Command result;
  result.name = "play";
  result.summary = "Write a page that plays a stream in a browser";
  result.add_required("IN", &options->input, "FILE", "The stream (.kvd), - for standard input");
  result.add_required("--html", &options->page, "FILE", "The page, - for standard output");
  result.description = {
      "The page needs no other file. It plays forward and backward at any speed, in the size of "
      "the "
      "window, and shows the mesh over the picture. The triangles are those of the exact run, "
      "which "
      "change at the times of its events.",
      "Exit codes: see kinetri-video encode."};
  result.examples = {"kinetri-video play clip.kvd --html clip.html"};
  result.run = [options](const app::Command& /*program*/) {
    Stream_reader stream = Stream_reader::open(options->input);
    check_output("--html", options->page, options->input);
    Output_file output(options->page);
    write_play_page(output.stream(), stream, stream.name());
    output.commit();
    return app::Exit_code::done;
  };
  return result;
}

}  // namespace kinetri::video
