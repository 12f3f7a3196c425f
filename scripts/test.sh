#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds everything and runs every test. See --help.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

usage() {
  cat <<EOF
usage: scripts/test.sh [--preset PRESET] [--compiler CXX] [--browser] [--python] [--video]
                       [--live] [CTEST_OPTION...]

Installs what is missing (with apt-get, as root), builds everything, and runs every test: about an hour of
processor time, 35 minutes on two cores. The last line reads "N passed, N failed"; the
exit code is 0 if none failed.

  --preset PRESET  test, the default; dev, with CGAL's own checks; asan-ubsan, with AddressSanitizer
                   and UndefinedBehaviorSanitizer; or tsan, the tests of what several threads do,
                   with ThreadSanitizer (CMakePresets.json)
  --compiler CXX   with another compiler, e.g. clang++, in a directory of its own
  --browser        installs chromium-headless-shell, for the tests of pages, and Doxygen; without this
                   option their tests run only if these are installed
  --python         likewise installs what the Python package and its tests need
  --video          likewise for the program kinetri-video
  --live           likewise installs Emscripten, and builds the module for JavaScript in build/wasm, in
                   some minutes

Other options are those of ctest, for example -R REGEX for the tests whose names match, or -LE slow
for those without the label slow. The labels are slow, install, threads, and release for those that take long
and are of use before a release: a second build of the library, without optimization and with CGAL's own
checks; the programs, and each public header, built alone; packages; pages in Firefox.

KINETRI_TEST_MULTIPLIER=N makes the randomized tests N times as long.
EOF
}

preset=test packages=(test) compiler='' options=() each=OFF
while (($# > 0)); do
  case $1 in
    --help | -h) usage && exit 0 ;;
    --browser) packages+=(browser) ;;
    --python) packages+=(python) ;;
    --video) packages+=(video) ;;
    --live) packages+=(live) ;;
    --preset | --compiler)
      (($# >= 2)) || kinetri_misused "$1 has no value"
      printf -v "${1#--}" '%s' "$2"
      shift
      ;;
    *)
      if [[ $1 =~ ^(-[RE]|--(tests|exclude)-regex) ]]; then each=ON; fi
      options+=("$1")
      ;;
  esac
  shift
done
[[ $preset =~ ^(test|dev|asan-ubsan|tsan)$ ]] ||
  kinetri_misused "--preset: '$preset' is unknown; expected test, dev, asan-ubsan or tsan"
[[ -z $compiler ]] || command -v "$compiler" >/dev/null ||
  kinetri_misused "--compiler: there is no program $compiler"

build_dir="$kinetri_root/build/$preset${compiler:+-${compiler##*/}}" targets=()
if [[ $preset == tsan ]]; then targets=(kinetri_threads_test) options+=(-L '^threads$'); fi
if ((${#options[@]} == 0)); then
  kinetri_say "To build everything and run every test takes about an hour of processor time, 35 minutes" \
    "on two cores; with sanitizers longer. -R REGEX runs some of the tests, -LE slow the fast ones."
fi
kinetri_setup "${packages[@]}"
# Before the program, which takes the module. With sanitizers it is not tested.
if [[ $preset =~ ^(test|dev)$ && " ${packages[*]} " == *' live '* ]]; then kinetri_build_module; fi
kinetri_build "$build_dir" "$preset" -DKINETRI_EACH_TEST=$each ${compiler:+"-DCMAKE_CXX_COMPILER=$compiler"} -- "${targets[@]}"

kinetri_say "Testing ..."
log=$build_dir/test.log results=$build_dir/Testing/Temporary/LastTest.log
: >"$log"
rm -f "$results"
kinetri_show_progress "$log" &
watcher=$!
# Shows the tests that fail, with their output, and those that are skipped. Two tests more than processors at a time:
# those of pages wait for the browser to draw, most of their time.
ctest --test-dir "$build_dir" --parallel "$(($(kinetri_jobs) + 2))" --timeout 900 --no-tests=error \
  --output-on-failure "${options[@]}" </dev/null 2>&1 | tee "$log" |
  grep -vE '^ +Start +[0-9]+: |^ *[0-9]+/[0-9]+ Test .* Passed |^\[( RUN  |       OK |-----)' || true
kill "$watcher"
summary='s/^[0-9]+% tests passed, ([0-9]+) tests? failed out of ([0-9]+)$'
failed=$(sed -nE "$summary/\\1/p" "$log")
run=$(sed -nE "$summary/\\2/p" "$log")
[[ -n $run ]] || kinetri_fail "ctest ran no tests, or ended early; all of its output is in $log"
skipped=$(grep -cE '^ *[0-9]+/[0-9]+ Test .*\*\*\*Skipped' "$log") || true
passed=$((run - failed - skipped))
if [[ $each == OFF && -f $results ]]; then
  # ctest knows processes with many cases of GoogleTest: the cases are counted, and those that failed or
  # were skipped are named. A process may also fail at its end, after the last case.
  while read -r more_passed more_failed more_skipped name; do
    ((passed += more_passed, failed += more_failed, skipped += more_skipped)) || true
    if [[ -n $name ]]; then kinetri_say "$name"; fi
  done < <(awk '
    function end_case(result) {
      if (open != "" && result != "ok") print 0, 0, 0, result ": " layer "." open
      if (open != "") ++count[result]
      open = ""
    }
    function end_process() {
      end_case("failed")
      if (begun && process in fails) print count["ok"] + 0, (count["failed"] ? count["failed"] - 1 : 0), count["skipped"] + 0
      else if (begun) print count["ok"] - 1, 0, count["skipped"] + 0
      begun = 0
      split("", count)
    }
    FNR == NR {
      if (/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: / && !/ Passed +[0-9.]+ sec/) fails[$4]
      next
    }
    /^[0-9]+\/[0-9]+ Testing: / { end_process(); process = layer = $3; sub(/\.[0-9]+$/, "", layer) }
    /\[ RUN      \] / { end_case("failed"); open = $NF; begun = 1 }
    /\[       OK \] .*ms\)$/ { end_case("ok") }
    /\[  SKIPPED \] .*ms\)$/ { end_case("skipped") }
    /\[  FAILED  \] .*ms\)$/ { end_case("failed") }
    END { end_process() }' "$log" "$results")
fi
kinetri_say "$passed passed, $failed failed$( ((skipped == 0)) || printf ', %d skipped' "$skipped")"
((failed == 0 && passed > 0))
