// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/gnuplot.h"

#include "cli/arguments.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/text.h"
#include "outputs/child_process.h"

namespace kinetri::app {
namespace {

// Colors of M. Okabe and K. Ito, Color universal design, 2008.
constexpr const char* plot_style = R"(
set encoding utf8
set style line 1 lc rgb '#0072b2' lw 2 pt 7 ps 0.7
set style line 2 lc rgb '#d55e00' lw 2 pt 5 ps 0.7
set style line 3 lc rgb '#009e73' lw 2 pt 9 ps 0.9
set style line 4 lc rgb '#cc79a7' lw 2 pt 11 ps 0.9
set style line 5 lc rgb '#000000' lw 2 pt 13 ps 0.9
set style line 6 lc rgb '#e69f00' lw 2 pt 4 ps 0.9
set style line 7 lc rgb '#56b4e9' lw 2 pt 6 ps 0.9
set pointintervalbox 0
set border 3 lc rgb '#404040'
set tics nomirror out
set grid lc rgb '#d8d8d8' lw 1
set key outside right top vertical Left reverse samplen 3
)";

std::string drawn(const std::string& terminal, const std::string& script) {
  const Tool_result result =
      run_tool("gnuplot", {"-"}, "set terminal " + terminal + "\n" + plot_style + script);
  if (!result.succeeded() || result.out.empty()) {
    throw Output_error(
        joined("gnuplot: drawing failed; expected a gnuplot with the terminals svg and pngcairo "
               "(Debian: gnuplot-nox); it said: ",
               result.says()));
  }
  return result.out;
}

}  // namespace

void require_gnuplot(std::string_view otherwise) {
  if (run_tool("gnuplot", {"--version"}, "").succeeded()) return;
  throw Usage_error(
      joined("gnuplot, which draws plots, is not installed; expected it (Debian: "
             "gnuplot-nox), or ",
             otherwise));
}

std::string draw_svg(const std::string& script, int width, int height) {
  return drawn(
      joined("svg size ", width, ",", height, " dynamic font 'sans-serif,14' background '#ffffff'"),
      script);
}

Plot draw(const std::string& script, int width, int height) {
  return {draw_svg(script, width, height),
          drawn(joined("pngcairo size ", 2 * width, ",", 2 * height,
                       " font 'sans,14' background '#ffffff' fontscale 1.8 linewidth 2 "
                       "pointscale 2"),
                script)};
}

}  // namespace kinetri::app
