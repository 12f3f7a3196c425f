#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds Kinetri for another platform, runs its tests there, and compares its logs with those of this
# machine, byte for byte. See --help.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

usage() {
  cat <<EOF
usage: scripts/platform.sh PLATFORM [CTEST_OPTION...]

Builds the library, the program and the tests of algebra, kinetic, events and degenerate input for
another platform, in build/PLATFORM. Compares logs, edges, motions and messages of the program with
those of the one in build/test, which it builds as well; then runs the tests.

  arm64     64-bit ARM: Debian's cross compiler, and user-mode emulation
  libcxx    this machine: clang and libc++, the newest that Debian has
  wasm      WebAssembly, with Emscripten: the library and the module for JavaScript (live/). Its logs, by
            node, are compared with those of the program; of the tests only those of the module are run

What is missing is installed with apt-get, as root. Packages of another architecture are unpacked
in build/PLATFORM-libraries alone: those of this machine, and its list of architectures, stay as they are.
EOF
}

case ${1:-} in
  --help | -h) usage && exit 0 ;;
  arm64 | libcxx | wasm) platform=$1 ;;
  '') kinetri_misused "a platform is missing" ;;
  *) kinetri_misused "'$1' is no platform; expected arm64, libcxx or wasm" ;;
esac
shift

# unpack_packages ARCHITECTURE FOLDER PACKAGE...: unpacks these packages and their dependencies, except the C and
# C++ libraries, which the compiler has. apt-get uses a separate state.
unpack_packages() {
  local architecture=$1 folder=$2 state=$2.apt archive
  shift 2
  if [[ -d $folder ]]; then return; fi
  kinetri_say "Unpacking the libraries of $architecture in $folder ..."
  rm -rf "$state" "$folder.partly"
  mkdir -p "$state/lists/partial" "$state/archives/partial" "$folder.partly"
  : >"$state/status"
  local options=(-qq -o "APT::Architecture=$architecture" -o "APT::Architectures=$architecture"
    -o "Dir::State=$state" -o "Dir::State::lists=$state/lists" -o "Dir::State::status=$state/status"
    -o "Dir::Cache=$state" -o "Dir::Cache::archives=$state/archives" -o Debug::NoLocking=1
    -o "APT::Sandbox::User=$(id -un)")
  apt-get "${options[@]}" update </dev/null
  apt-get "${options[@]}" install -y --no-install-recommends --download-only "$@" </dev/null >/dev/null
  for archive in "$state"/archives/*.deb; do
    case ${archive##*/} in
      libc6* | libstdc++* | linux-libc-dev* | libgcc* | libcrypt*) ;;
      *) dpkg-deb -x "$archive" "$folder.partly" ;;
    esac
  done
  rm -rf "$state"
  mv "$folder.partly" "$folder"
}

if [[ $platform == wasm ]]; then
  kinetri_setup test live
  kinetri_build_module
  kinetri_build "$kinetri_root/build/test" test -- kinetri_program
  kinetri_say "Testing, and comparing with the logs of this machine ..."
  exec ctest --test-dir "$kinetri_root/build/test" --parallel "$(kinetri_jobs)" --timeout 3600 --no-tests=error \
    --output-on-failure -R '^live\.(module|logs)$' "$@" </dev/null
fi

build_dir=$kinetri_root/build/$platform
libraries=(libboost-dev libcgal-dev libcli11-dev libexpat1-dev libgmp-dev libmpfr-dev libsqlite3-dev
  libtbb-dev nlohmann-json3-dev libgtest-dev librapidcheck-dev)
kinetri_setup test "$platform"
settings=()
targets=(kinetri_program kinetri_algebra_test kinetri_kinetic_test kinetri_events_test
  kinetri_degenerate_test)
if [[ $platform == arm64 ]]; then
  unpack_packages arm64 "$build_dir-libraries" "${libraries[@]}"
  settings+=("-DKINETRI_SYSROOT=$build_dir-libraries")
fi
kinetri_build "$build_dir" "$platform" "${settings[@]}" -- "${targets[@]}"
kinetri_build "$kinetri_root/build/test" test -- kinetri_program

kinetri_say "Comparing with the logs of this machine ..."
program=$build_dir/bin/kinetri
if [[ $platform == arm64 ]]; then
  program="qemu-aarch64 -L /usr/aarch64-linux-gnu -E LD_LIBRARY_PATH=$(printf %q "$build_dir-libraries")/usr/lib/aarch64-linux-gnu $(printf %q "$program")"
fi
python3 -B "$kinetri_root/test/determinism/event_logs_test.py" platforms \
  "$kinetri_root/build/test/bin/kinetri" "$program" "$build_dir/compared" | tee "$build_dir/compared.log" | tail -n 1

kinetri_say "Testing ..."
ctest --test-dir "$build_dir" --parallel "$(kinetri_jobs)" --timeout 3600 --no-tests=error \
  --output-on-failure -R '^(algebra|kinetic|events|degenerate)\.' "$@" </dev/null
