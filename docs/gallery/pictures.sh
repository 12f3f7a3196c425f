#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The pictures of the gallery that kinetri render draws, their runs, and the small page of a run. Needs
# librsvg2-bin, ffmpeg, and the Python package of kinetri.
#
#   docs/gallery/pictures.sh KINETRI FOLDER
set -euo pipefail

if (($# != 2)); then
  sed -n 's/^#   /usage: /p' "$0" >&2
  exit 2
fi
kinetri=$(realpath "$1")
folder=$(realpath "$2")
here=$(realpath "$(dirname "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# A crowd that leaves a room.
"$here/crowd.py" > crowd.csv
"$kinetri" tracks crowd.csv --radius 0.22 --collisions log --html crowd.html --quiet \
  --html-view 'color=density&hide=delaunay,hull,ids&show=scale&unit=m&kinds=hide'
"$kinetri" render crowd.html --at 7 --output "$folder/crowd.png" --width 880 --height 520
"$kinetri" render crowd.html --animate "$folder/crowd.webp" --from 2 --until 14 --fps 8 --speed 4 \
  --width 440 --height 260 --view 'legend=off&hide=scale'

# Discs of two sizes that grow until they jam.
"$kinetri" generate lattice-jitter --points 100 --jitter 2 --seed 5 --output seeds.csv
awk -F, 'NR == 1 { print $0 ",radius,growth" } NR > 1 { print $0 (NR % 3 ? ",0.3,0.3" : ",0.6,0.6") }' seeds.csv > grow.csv
"$kinetri" simulate grow.csv --until 10.7 --box=-5,-5,95,95 --rim --collisions elastic --mass area --html grow.html \
  --quiet --html-view 'color=size&hide=delaunay,hull,ids&theme=dark&kinds=hide&legend=off'
"$kinetri" render grow.html --at 10.7 --output "$folder/packing.png" --view show=voronoi --width 640 --height 640
"$kinetri" render grow.html --animate "$folder/packing.webp" --from 0.7 --until 10.7 --fps 8 --speed 4 \
  --width 300 --height 300

# A packing in a periodic box that is sheared.
"$kinetri" generate packing --points 60 --sizes 1.4 --share 0.8 --periodic --side 10 --speed 0.3 --seed 4 \
  --output packing.csv 2> /dev/null
awk -F, -v OFS=, 'NR > 1 { $3 += 0.1 * $2 } { print }' packing.csv > moving.csv
"$kinetri" simulate moving.csv --until 20 --periodic 10,10 --shear 0.1 --collisions elastic --mass area --thermostat 8 \
  --quiet --html sheared.html --html-view 'color=size&show=voronoi&hide=delaunay,ids&theme=dark&kinds=hide&legend=off'
"$kinetri" render sheared.html --animate "$folder/sheared.webp" --from 0 --until 20 --fps 6 --speed 2.5 \
  --width 380 --height 270

# A flock that is steered live.
"$here/flock.py" > flock.csv
"$kinetri" tracks flock.csv --html flock.html --quiet --html-view 'show=arrows&hide=ids,hull&kinds=flip'
"$kinetri" render flock.html --at 7.05 --output "$folder/flock.png" --width 760 --height 560
"$kinetri" render flock.html --animate "$folder/flock.webp" --from 5 --until 8.1 --fps 8 --width 340 --height 250

# The wave.
"$kinetri" wave --jitter 2 --html wave.html --quiet --html-view kinds=hide
"$kinetri" render wave.html --at 14.3 --output "$folder/wave.png" --width 900 --height 560
"$kinetri" render wave.html --animate "$folder/wave.webp" --from 2.3 --until 26.3 --fps 8 --speed 8 \
  --width 400 --height 260

# Flips, and the page of this run.
"$kinetri" generate uniform --points 30 --side 60 --seed 7 --output small.csv
"$kinetri" simulate small.csv --until 8 --html "$folder/run.html" --quiet
"$kinetri" render "$folder/run.html" --animate "$folder/flips.webp" --from 2 --until 5 --fps 8 \
  --width 360 --height 280 --view 'show=voronoi&hide=ids'
