#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds the fuzz targets with clang's libFuzzer and the sanitizers, and runs them. See --help.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

targets=()
for source in "$kinetri_root"/test/fuzz/*_fuzz.cpp; do
  name=${source##*/}
  targets+=("${name%_fuzz.cpp}")
done

usage() {
  cat <<EOF
usage: scripts/fuzz.sh [--seconds N] [TARGET]...

Runs each TARGET (${targets[*]}; default: all) for N seconds (default 60), one after the other, and
keeps what it learns in build/fuzz/corpus. An input on which a target stops is left in
build/fuzz/crashes, and the exit code is 1. Make a named regression of each: a file in
data/degenerate or a test.

Run one input again with

  build/fuzz/test/fuzz/kinetri_TARGET_fuzzer FILE
EOF
}

seconds=60 chosen=()
while (($# > 0)); do
  case $1 in
    --help | -h) usage && exit 0 ;;
    --seconds)
      [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || kinetri_misused "--seconds: '${2:-}' is no whole number greater than 0"
      seconds=$2
      shift
      ;;
    *)
      [[ " ${targets[*]} " == *" $1 "* ]] || kinetri_misused "'$1' is unknown"
      chosen+=("$1")
      ;;
  esac
  shift
done
if ((${#chosen[@]} == 0)); then chosen=("${targets[@]}"); fi

kinetri_setup fuzz
video=OFF
if [[ " ${chosen[*]} " == *" video "* ]]; then
  kinetri_setup video
  video=ON
fi
dir="$kinetri_root/build/fuzz"
mkdir -p "$dir/crashes"
programs=("${chosen[@]/#/kinetri_}")
kinetri_build "$dir" asan-ubsan -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_FLAGS=-fsanitize=fuzzer-no-link \
  -DKINETRI_BUILD_PROGRAM=OFF -DKINETRI_VIDEO="$video" -DKINETRI_FUZZ=ON -- "${programs[@]/%/_fuzzer}"

code=0
for target in "${chosen[@]}"; do
  corpus="$dir/corpus/$target"
  mkdir -p "$corpus"
  # The other targets read at most 300 bytes. Without seeds, libFuzzer would begin with short inputs.
  seeds=() lengths=(-max_len=300 -len_control=0)
  if [[ -d "$kinetri_root/test/fuzz/corpus/$target" ]]; then
    seeds=("$kinetri_root/test/fuzz/corpus/$target")
  fi
  case $target in
    points_file) lengths=(-max_len=20000) seeds+=("$kinetri_root/data/degenerate") ;;
    tracks) lengths=(-max_len=20000) ;;
    track_formats) lengths=(-max_len=20000) seeds+=("$kinetri_root/test/fuzz/corpus/tracks") ;;
  esac
  kinetri_say "Fuzzing $target for $seconds seconds; output in $dir/$target.log ..."
  if "$dir/test/fuzz/kinetri_${target}_fuzzer" -max_total_time="$seconds" -timeout=60 \
    -rss_limit_mb=4096 -print_final_stats=1 "${lengths[@]}" -artifact_prefix="$dir/crashes/$target-" \
    "$corpus" "${seeds[@]}" >"$dir/$target.log" 2>&1; then
    kinetri_say "  nothing found in $(sed -n 's/^stat::number_of_executed_units: *//p' "$dir/$target.log") inputs"
  else
    kinetri_say "  it stopped:"
    grep -E -m 5 'ERROR|fuzz target:|runtime error|Test unit written' "$dir/$target.log" || tail -n 5 "$dir/$target.log"
    code=1
  fi
done
exit "$code"
