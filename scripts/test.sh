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
                       [CTEST_OPTION...]

Installs what is missing (with apt-get, as root), builds everything, and runs every test: about an hour
of processor time, half an hour on two cores. The last line reads "N passed, N failed"; the
exit code is 0 if none failed.

  --preset PRESET  test, the default; dev, with CGAL's own checks; asan-ubsan, with AddressSanitizer
                   and UndefinedBehaviorSanitizer; or tsan, the tests of what several threads do,
                   with ThreadSanitizer (CMakePresets.json)
  --compiler CXX   with another compiler, e.g. clang++, in a directory of its own
  --browser        installs chromium, for the tests of the viewer page, and Doxygen; without this
                   option their tests run only if these are installed
  --python         likewise installs what the Python package and its tests need
  --video          likewise for the program kinetri-video

Other options are those of ctest, for example -R REGEX for the tests whose names match, or -LE slow
for those without the label slow. The labels are slow, install and threads.

KINETRI_TEST_MULTIPLIER=N makes the randomized tests N times as long.
EOF
}

preset=test packages=(test) compiler='' options=()
while (($# > 0)); do
  case $1 in
    --help | -h) usage && exit 0 ;;
    --browser) packages+=(browser) ;;
    --python) packages+=(python) ;;
    --video) packages+=(video) ;;
    --preset | --compiler)
      (($# >= 2)) || kinetri_misused "$1 has no value"
      printf -v "${1#--}" '%s' "$2"
      shift
      ;;
    *) options+=("$1") ;;
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
  kinetri_say "To build everything and run every test takes about an hour of processor time, half an hour" \
    "on two cores; with sanitizers longer. -R REGEX runs some of the tests, -LE slow the fast ones."
fi
for purpose in "${packages[@]}"; do kinetri_setup "$purpose"; done
kinetri_build "$build_dir" "$preset" ${compiler:+"-DCMAKE_CXX_COMPILER=$compiler"} -- "${targets[@]}"

kinetri_say "Testing ..."
log=$build_dir/test.log
: >"$log"
kinetri_show_progress "$log" &
watcher=$!
# Shows the tests that fail, with their output, and those that are skipped.
ctest --test-dir "$build_dir" --parallel "$(kinetri_jobs)" --timeout 900 --no-tests=error \
  --output-on-failure "${options[@]}" </dev/null 2>&1 | tee "$log" |
  grep -vE '^ +Start +[0-9]+: |^ *[0-9]+/[0-9]+ Test .* Passed ' || true
kill "$watcher"
summary='s/^[0-9]+% tests passed, ([0-9]+) tests? failed out of ([0-9]+)$'
failed=$(sed -nE "$summary/\\1/p" "$log")
run=$(sed -nE "$summary/\\2/p" "$log")
[[ -n $run ]] || kinetri_fail "ctest ran no tests, or ended early; all of its output is in $log"
skipped=$(grep -cE '^ *[0-9]+/[0-9]+ Test .*\*\*\*Skipped' "$log") || true
kinetri_say "$((run - failed - skipped)) passed, $failed failed$( ((skipped == 0)) || printf ', %d skipped' "$skipped")"
((failed == 0 && run > skipped))
