#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds the program and runs its main job: the paper's scenario, audited and verified. See --help.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

usage() {
  cat <<EOF
usage: scripts/demo.sh [--points N] [--until T] [--seed S]

Installs what is missing (with apt-get, as root), builds the program in build/release, and simulates
N = 100 points in a square of side 100, their velocity components uniform in [-5, 5], until time
T = 10. The triangulation is audited after every event. In the end kinetri-verify, which shares no code
with kinetri, decides from the points and the logs whether it was right at all times. The files go to
build/demo.
EOF
}

points=100 until=10 seed=1
while (($# > 0)); do
  case $1 in
    --help | -h) usage && exit 0 ;;
    --points | --until | --seed)
      (($# >= 2)) || kinetri_misused "$1 has no value"
      printf -v "${1#--}" '%s' "$2"
      shift 2
      ;;
    *) kinetri_misused "'$1' is unknown" ;;
  esac
done

kinetri_setup demo
kinetri_build "$kinetri_root/build/release" release -- kinetri_program kinetri_verify

kinetri="$kinetri_root/build/release/bin/kinetri"
out="$kinetri_root/build/demo"
mkdir -p "$out"
cd "$out"

kinetri_say "Simulating $points moving points until t = $until, auditing every event ..."
"$kinetri" generate uniform --points "$points" --side 100 --speed 5 --seed "$seed" \
  --output points.csv
"$kinetri" simulate points.csv --until "$until" --audit events --events events.csv \
  --initial-edges initial-edges.csv --edges edges.csv --stats stats.json --html run.html --verify

kinetri_say
kinetri_say "Files in $out:"
wc -c points.csv initial-edges.csv edges.csv events.csv stats.json run.html |
  awk '$2 != "total" { printf "  %-18s %9d bytes\n", $2, $1 }'
kinetri_say "To see the run, open $out/run.html in a browser."
