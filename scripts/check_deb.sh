#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs and uses the Debian packages in a clean root. See --help.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

usage() {
  cat <<EOF
usage: scripts/check_deb.sh [DIRECTORY]

Makes a clean root of the Debian that runs here (with mmdebstrap, which installs it from the network
and removes it at the end), installs the packages kinetri, libkinetri-dev, libkinetri-io-dev and, if the
Python package is built, python3-kinetri there by apt with what they depend on, and in it
  - runs kinetri generate and kinetri simulate, and looks for the manual page and the completions,
  - compiles a small program by find_package and by pkg-config, and runs it,
  - runs a small program in Python, with a wheel in DIRECTORY as well, if there is one,
  - removes the packages, after which nothing of them may be left.
The packages are those in DIRECTORY; without it they are built, in build/release. Needs root.
EOF
}

if [[ ${1:-} == --help || ${1:-} == -h ]]; then usage && exit 0; fi
(($# <= 1)) || kinetri_misused "expected at most one argument, the directory of the packages"
((EUID == 0)) || kinetri_fail "only root can make a root directory; expected: sudo $0"
command -v mmdebstrap >/dev/null ||
  kinetri_fail "mmdebstrap is missing; expected: apt-get install -y mmdebstrap"

folder=${1:-}
if [[ -z $folder ]]; then
  kinetri_setup demo
  kinetri_build "$kinetri_root/build/release" release
  folder=$kinetri_root/build/release/packages
  rm -rf "$folder"
  kinetri_quietly "packaging" "$kinetri_root/build/release/package.log" \
    cpack --config "$kinetri_root/build/release/CPackConfig.cmake" -B "$folder"
fi
shopt -s nullglob
packages=("$folder"/kinetri_*.deb "$folder"/libkinetri-dev_*.deb "$folder"/libkinetri-io-dev_*.deb)
((${#packages[@]} == 3)) ||
  kinetri_fail "$folder holds ${#packages[@]} packages; expected one kinetri_*.deb, one libkinetri-dev_*.deb and one libkinetri-io-dev_*.deb"
packages+=("$folder"/python3-kinetri_*.deb "$folder"/kinetri-*.whl)

# The script that runs in the root.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -r "${packages[@]}" "$kinetri_root/test/install/consumer" "$work"
cat >"$work/check.sh" <<'EOF'
set -euxo pipefail
cd /check
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8

cat >use.py <<'EOF_PY'
import kinetri
kd = kinetri.KineticDelaunay(*kinetri.scenario("uniform", 100, seed=1))
assert len(kd.record(until=5)) > 100 and kd.audit("delaunay")
EOF_PY

# The wheel, with nothing but NumPy.
shopt -s nullglob
for wheel in kinetri-*.whl; do
  apt-get install -y --no-install-recommends python3-numpy
  python3 -m zipfile -e "$wheel" wheel
  PYTHONPATH=wheel python3 use.py
done

# The Python package, and its removal.
for package in ./python3-kinetri_*.deb; do
  apt-get install -y --no-install-recommends "$package"
  (cd /tmp && python3 /check/use.py)
  test -d /usr/lib/python3/dist-packages/kinetri/__pycache__
  apt-get purge -y python3-kinetri
  test ! -e /usr/lib/python3/dist-packages/kinetri
done

# The program alone.
apt-get install -y --no-install-recommends ./kinetri_*.deb
cd /tmp
kinetri --version
kinetri generate uniform --points 100 --seed 1 |
  kinetri simulate - --until 5 --events events.csv --audit end
(($(wc -l <events.csv) > 100))
zcat /usr/share/man/man1/kinetri.1.gz | grep -q '^\.TH KINETRI'
test -s /usr/share/bash-completion/completions/kinetri
test -s /usr/share/doc/kinetri/copyright

# The library, with only its dependencies and the tools.
cd /check
apt-get install -y --no-install-recommends ./libkinetri-dev_*.deb g++ cmake make pkg-config
cmake -S consumer -B by_cmake -DCMAKE_BUILD_TYPE=Release
cmake --build by_cmake
by_cmake/consumer | diff consumer/expected.txt -
# shellcheck disable=SC2046
g++ $(pkg-config --cflags kinetri) consumer/main.cpp $(pkg-config --libs kinetri) \
  -o by_pkg_config
./by_pkg_config | diff consumer/expected.txt -

# Files as well.
apt-get install -y --no-install-recommends ./libkinetri-io-dev_*.deb
cmake -S consumer -B files_by_cmake -DCMAKE_BUILD_TYPE=Release -DKINETRI_COMPONENTS=io
cmake --build files_by_cmake
files_by_cmake/consumer_of_files | diff consumer/expected_of_files.txt -
# shellcheck disable=SC2046
g++ $(pkg-config --cflags kinetri-io) consumer/files.cpp $(pkg-config --libs kinetri-io) \
  -o files_by_pkg_config
./files_by_pkg_config | diff consumer/expected_of_files.txt -

files=$(dpkg-query -L kinetri libkinetri-dev libkinetri-io-dev | sort -u)
apt-get purge -y kinetri libkinetri-dev libkinetri-io-dev
for file in $files; do
  if [[ $file == *inetri* && -e $file ]]; then
    echo "$file is left" >&2
    exit 1
  fi
done
EOF

# shellcheck source=/dev/null
suite=$(. /etc/os-release && printf '%s' "$VERSION_CODENAME")
kinetri_say "Installing $(basename -a "${packages[@]}" | tr '\n' ' ')in a clean root of $suite ..."
mkdir -p "$kinetri_root/build"
kinetri_quietly "the check" "$kinetri_root/build/check_deb.log" mmdebstrap --quiet --variant=apt --format=null \
  --customize-hook="cp -r '$work' \"\$1/check\"" \
  --customize-hook="chroot \"\$1\" bash /check/check.sh" \
  "$suite" /dev/null
kinetri_say "The packages install, run, are compiled against, and are removed."
