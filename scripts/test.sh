#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds everything and runs every test. See --help.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

usage() {
  cat <<EOF
usage: scripts/test.sh [--sanitize[=thread]] [--compiler CXX] [--filter REGEX] [--quick] [--browser]

Installs what is missing (with apt-get, as root), builds everything, and runs every test. The last
line reads "N passed, N failed"; the exit code is 0 if none failed.

  --sanitize      with AddressSanitizer and UndefinedBehaviorSanitizer, in build/asan
  --sanitize=thread
                  the tests of what several threads do, with ThreadSanitizer, in build/tsan
  --compiler CXX  with another compiler, e.g. clang++, in a directory of its own
  --filter REGEX  only the tests whose names match
  --quick         without the tests labelled slow
  --browser       with chromium, which the tests of the viewer page need, and Doxygen; they are
                  installed if missing, and else their tests run where they are already

KINETRI_TEST_MULTIPLIER=N makes the randomized tests N times as long.
EOF
}

preset=test dir=build/test packages=test
configure=() targets=() select=()
while (($# > 0)); do
  case $1 in
    --help | -h) usage && exit 0 ;;
    --sanitize) preset=asan-ubsan dir=build/asan ;;
    --sanitize=thread)
      preset=tsan dir=build/tsan
      targets=(kinetri_threads_test) select+=(--label-regex '^threads$')
      ;;
    --browser) packages=browser ;;
    --quick) select+=(--label-exclude slow) ;;
    --compiler | --filter)
      (($# >= 2)) || kinetri_misused "$1 has no value"
      if [[ $1 == --filter ]]; then
        select+=(--tests-regex "$2")
      else
        compiler=$2
        [[ $compiler != clang ]] || compiler=clang++
        command -v "$compiler" >/dev/null || kinetri_misused "--compiler: there is no program $compiler"
        configure+=("-DCMAKE_CXX_COMPILER=$compiler")
      fi
      shift
      ;;
    *) kinetri_misused "'$1' is unknown" ;;
  esac
  shift
done
if [[ -n ${compiler:-} ]]; then dir+="-${compiler##*/}"; fi

kinetri_setup "$packages"
build_dir="$kinetri_root/$dir"
kinetri_build "$build_dir" "$preset" "${configure[@]}" -- "${targets[@]}"

kinetri_say "Testing ..."
results="$build_dir/test-results.xml"
rm -f "$results"
run=(ctest --test-dir "$build_dir" --parallel "$(kinetri_jobs)" --timeout 900 --no-tests=error
  --output-junit "$results" "${select[@]}")
if [[ -t 1 ]]; then
  "${run[@]}" --progress </dev/null || true
else
  "${run[@]}" --quiet </dev/null || true
fi
[[ -f $results ]] || kinetri_fail "ctest could not be run, or ended early: there is no $results"
exec python3 "$kinetri_root/scripts/summarize_tests.py" "$results"
