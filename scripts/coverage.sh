#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds with gcc's counters of coverage, runs the tests, and prints the coverage. See --help.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

usage() {
  cat <<EOF
usage: scripts/coverage.sh [CTEST_OPTION...]

Installs what is missing (with apt-get, as root), builds all tests in build/coverage without
optimization, runs them, and prints by file, with gcovr, the lines never run, and then how many lines,
functions and branches were reached. The options are those of ctest: -LE slow leaves out the slow tests,
-R REGEX runs those whose names match.

Not counted: branches that the compiler makes for exceptions, and those of KINETRI_ASSERT, which no
test can take. Not measured: code in separate builds (the installed library, the program without
optimization). Not run: the soak test, which only repeats what others do.
EOF
}

if [[ ${1:-} == --help || ${1:-} == -h ]]; then usage && exit 0; fi
kinetri_setup coverage
build_dir="$kinetri_root/build/coverage"
kinetri_build "$build_dir" coverage -DCMAKE_CXX_COMPILER=g++

kinetri_say "Testing ..."
# Counters of earlier runs would be added to.
find "$build_dir" -name '*.gcda' -delete
kinetri_quietly "testing" "$build_dir/test.log" ctest --test-dir "$build_dir" --parallel "$(kinetri_jobs)" \
  --timeout 3600 --no-tests=error --output-on-failure --exclude-regex '^soak' "$@"
cd "$build_dir"
exec gcovr --root "$kinetri_root" --filter "$kinetri_root/(include|src|apps)/" -j "$(kinetri_jobs)" \
  --exclude-throw-branches --exclude-unreachable-branches \
  --exclude-branches-by-pattern '.*\bKINETRI_ASSERT\b.*' --txt --print-summary .
