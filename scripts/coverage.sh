#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds with gcc's counters of coverage, runs the tests, and prints what they have reached. See --help.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

usage() {
  cat <<EOF
usage: scripts/coverage.sh [--quick] [--filter REGEX]

Installs what is missing (with apt-get, as root), builds all tests in build/coverage without
optimization, runs them, and prints, file by file, the functions that were never called, the lines
never run, and the lines with a branch never taken; then, by layer, how many there are.

  --quick         without the tests labelled slow
  --filter REGEX  only the tests whose names match

Not counted: branches that the compiler makes for exceptions, and those of KINETRI_ASSERT, which no
test can take. Not run: what is compiled in builds of its own (the installed library, the program
without optimization), and the soak test, which does a million times what others do once.
EOF
}

select=(--exclude-regex '^soak')
while (($# > 0)); do
  case $1 in
    --help | -h) usage && exit 0 ;;
    --quick) select+=(--label-exclude slow) ;;
    --filter)
      (($# >= 2)) || kinetri_misused "$1 has no value"
      select+=(--tests-regex "$2")
      shift
      ;;
    *) kinetri_misused "'$1' is unknown" ;;
  esac
  shift
done

kinetri_setup coverage
build_dir="$kinetri_root/build/coverage"
kinetri_build "$build_dir" coverage -DCMAKE_CXX_COMPILER=g++

kinetri_say "Testing ..."
# The counters of earlier runs, which would be added to.
find "$build_dir" -name '*.gcda' -delete
kinetri_quietly "testing" "$build_dir/test.log" ctest --test-dir "$build_dir" \
  --parallel "$(kinetri_jobs)" --timeout 3600 --no-tests=error --output-on-failure "${select[@]}"

kinetri_say "Counting ..."
report="$build_dir/coverage.json"
(cd "$build_dir" && kinetri_quietly "gcovr" "$build_dir/gcovr.log" gcovr --json "$report" \
  --root "$kinetri_root" --filter "$kinetri_root/(include|src|apps)/" -j "$(kinetri_jobs)" \
  --exclude-throw-branches --exclude-unreachable-branches \
  --exclude-branches-by-pattern '.*\bKINETRI_ASSERT\b.*' .)
exec python3 "$kinetri_root/scripts/summarize_coverage.py" "$report"
