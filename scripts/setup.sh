#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Functions of scripts/demo.sh, test.sh, coverage.sh, lint.sh, fuzz.sh, platform.sh and check_deb.sh: the packages
# they need, and the calls of CMake. Source it, or run it to install missing packages:
#
#   scripts/setup.sh demo|test|browser|python|video|coverage|lint|fuzz|arm64|libcxx|live

kinetri_root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

kinetri_say() { printf '%s\n' "$*"; }

kinetri_fail() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

# kinetri_misused WHAT: prints the mistake in the command line, and the usage. Exits.
kinetri_misused() {
  printf 'error: %s\n\n' "$*" >&2
  usage >&2
  exit 2
}

# kinetri_packages PURPOSE...: the Debian packages needed, as `package` or, if a program from elsewhere suffices,
# `package=program`.
kinetri_packages() {
  local purpose
  {
    printf '%s\n' g++=c++ cmake=cmake libboost-dev libcgal-dev libcli11-dev libexpat1-dev \
      libgmp-dev libmpfr-dev libsqlite3-dev libtbb-dev ninja-build=ninja nlohmann-json3-dev
    for purpose; do kinetri_packages_for "$purpose"; done
  } | awk '!seen[$0]++'
}

# kinetri_packages_for PURPOSE: those that are needed besides the ones that everything needs.
kinetri_packages_for() {
  if [[ $1 != demo ]]; then
    printf '%s\n' gnuplot-nox=gnuplot libgtest-dev librapidcheck-dev pkg-config=pkg-config \
      python3=python3
  fi
  # For tests that are skipped without them: of the viewer page, of PNG pictures, and of the reference manual.
  # (Films are tested if ffmpeg, which is large, is installed.)
  if [[ $1 == browser ]]; then
    printf '%s\n' chromium-headless-shell=chromium-headless-shell doxygen=doxygen librsvg2-bin=rsvg-convert
  fi
  # The Python package, its tests and its examples.
  if [[ $1 == python ]]; then
    printf '%s\n' pybind11-dev python3-dev python3-distributed python3-hypothesis python3-matplotlib \
      python3-mypy python3-numpy python3-pandas python3-pip python3-pytest python3-scipy \
      python3-setuptools python3-shapely python3-venv python3-wheel
  fi
  # The program kinetri-video.
  if [[ $1 == video ]]; then
    printf '%s\n' libopencv-core-dev libopencv-imgproc-dev libopencv-video-dev libpng-dev libzstd-dev
  fi
  if [[ $1 == coverage ]]; then printf '%s\n' g++ gcovr=gcovr; fi
  if [[ $1 == lint ]]; then
    # The viewer's scripts are checked if node is installed.
    printf '%s\n' clang=clang++ clang-format-14 clang-tidy-14 pyflakes3=pyflakes3 \
      shellcheck=shellcheck
  fi
  # Other platforms (scripts/platform.sh).
  if [[ $1 == arm64 ]]; then printf '%s\n' g++-aarch64-linux-gnu qemu-user=qemu-aarch64; fi
  if [[ $1 == libcxx ]]; then printf '%s\n' clang-19 googletest libc++-19-dev libc++abi-19-dev; fi
  # WebAssembly. Emscripten's linker needs acorn; m4, make and xz build GMP and MPFR; node runs the tests.
  if [[ $1 == live ]]; then
    printf '%s\n' emscripten m4=m4 make=make node-acorn nodejs=node xz-utils=xz
  fi
  # Libraries of the sanitizers and libFuzzer.
  if [[ $1 == fuzz ]]; then printf '%s\n' clang=clang++ libclang-rt-dev; fi
}

# kinetri_missing PURPOSE...: those of them that are not installed, one per line.
kinetri_missing() {
  local entry package program
  while IFS= read -r entry; do
    package=${entry%%=*}
    program=${entry#"$package"}
    program=${program#=}
    if [[ -n $program ]] && command -v "$program" >/dev/null; then continue; fi
    if [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) != installed ]]; then
      printf '%s\n' "$package"
    fi
  done < <(kinetri_packages "$@")
}

# kinetri_setup PURPOSE...: installs the missing packages. Prints nothing if there are none.
kinetri_setup() {
  local missing
  if ! command -v dpkg-query >/dev/null; then
    kinetri_say "This is not a Debian system, so packages are not checked. Needed, by their Debian names:"
    kinetri_say "  $(kinetri_packages "$@" | sed 's/=.*//' | tr '\n' ' ')"
    return
  fi
  mapfile -t missing < <(kinetri_missing "$@")
  if ((${#missing[@]} == 0)); then return; fi
  kinetri_say "Missing packages: ${missing[*]}"
  if ((EUID != 0)); then
    kinetri_say "Install them, then run this again:" >&2
    kinetri_say "  sudo apt-get install -y ${missing[*]}" >&2
    exit 1
  fi
  kinetri_say "Installing them with apt-get ..."
  local options=(-qq -o DPkg::Lock::Timeout=300) package unknown='' preset=test
  export DEBIAN_FRONTEND=noninteractive
  apt-get "${options[@]}" update </dev/null ||
    kinetri_say "apt-get update failed; going on with the package lists that are there" >&2
  if apt-get "${options[@]}" install -y --no-install-recommends "${missing[@]}" </dev/null >/dev/null; then
    return
  fi
  mapfile -t missing < <(kinetri_missing "$@")
  for package in "${missing[@]}"; do
    apt-cache show "$package" >/dev/null 2>&1 || unknown+=" $package"
  done
  if [[ $1 == demo ]]; then preset=release; fi
  kinetri_fail "apt-get could not install: ${missing[*]}
${unknown:+Not in its package lists:$unknown
}Install them by hand, for example by
  apt-get install -y ${missing[*]}
and run this again. Where they come from elsewhere than from packages, build without this script:
  cmake --preset $preset && cmake --build --preset $preset"
}

# kinetri_sources FOLDER PACKAGE...: unpacks the sources of Debian packages in FOLDER/PACKAGE. apt-get uses lists of its
# own here, of the sources of the system's packages; the lists of the system stay as they are.
kinetri_sources() {
  local folder=$1 state=$1/apt package file
  shift
  mkdir -p "$state/sources" "$state/lists/partial" "$state/archives/partial"
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.{list,sources}; do
    if [[ ! -f $file ]]; then continue; fi
    sed -E 's/^(Types:).*/\1 deb-src/; s/^deb /deb-src /' "$file" >"$state/sources/${file##*/}"
  done
  local options=(-qq -o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$state/sources"
    -o "Dir::State=$state" -o "Dir::State::lists=$state/lists" -o "Dir::Cache=$state"
    -o "APT::Sandbox::User=$(id -un)")
  # Others than Debian need not have sources.
  apt-get "${options[@]}" update </dev/null ||
    kinetri_say "apt-get update failed for some sources; going on with those that are there" >&2
  (cd "$state" && apt-get "${options[@]}" source --download-only "$@" </dev/null) ||
    kinetri_fail "apt-get could not download the sources of: $*"
  for package; do
    mkdir -p "$folder/$package"
    file=$(find "$state" -maxdepth 1 -name "${package}_*.orig.tar.*" ! -name '*.asc')
    tar -xf "$file" -C "$folder/$package" --strip-components=1
  done
}

# kinetri_wasm_libraries: fills build/wasm-libraries, unless that has been done: GMP and MPFR for WebAssembly, from the
# sources of Debian's packages, and links to headers of this machine that fit every platform.
kinetri_wasm_libraries() {
  local folder=$kinetri_root/build/wasm-libraries work made name version clang flags cache settings
  # Where Debian has acorn, which another node does not know.
  export NODE_PATH=/usr/share/nodejs${NODE_PATH:+:$NODE_PATH}
  if [[ -d $folder ]]; then return; fi
  if ! command -v em-config >/dev/null || ! command -v apt-get >/dev/null; then
    kinetri_fail "the module needs Emscripten, and apt-get for the sources of GMP and MPFR"
  fi
  # Emscripten's compiler is clang. It is called directly, since its wrapper, emcc, takes longer to start than clang for
  # most of these sources. What is said about linking is for the programs with which configure tries things.
  version=$(em-config CLANG_ADD_VERSION)
  clang=$(em-config LLVM_ROOT)/clang
  if [[ -n $version && $version != None ]]; then clang+=-$version; fi
  flags=$(emcc --cflags)
  cache=$(em-config CACHE)
  settings=(--host=none --disable-shared CFLAGS=-O3 "CC=$clang $flags"
    "LDFLAGS=-nostdlib -L$cache/sysroot/lib/wasm32-emscripten -Wl,--no-entry,--no-gc-sections"
    'LIBS=-lc -lcompiler_rt -lstandalonewasm')
  kinetri_say "Building GMP and MPFR for WebAssembly in $folder, for a minute or two ..."
  # In a temporary folder, since the path of this one may have a space, and GMP cannot be built in such a path. If
  # that fails, it stays there, with its logs.
  work=$(mktemp -d "${TMPDIR:-/tmp}/kinetri-wasm.XXXXXX")
  made=$work/made
  mkdir -p "$made/include" "$made/lib" "${folder%/*}"
  kinetri_sources "$work" gmp mpfr4
  mkdir -p "$work/gmp/doc" "$work/gmp/build" && : >"$work/gmp/doc/Makefile.in"  # Debian leaves it out.
  # shellcheck disable=SC2016  # $0 is of the inner shell.
  (cd "$work/gmp/build" && kinetri_quietly "building GMP" "$work/gmp.log" bash -ec '
    emconfigure ../configure --disable-assembly CC_FOR_BUILD=cc HOST_CC=cc "$@"
    make -j "$0" "SUBDIRS=mpn mpz mpq mpf printf scanf rand"' "$(kinetri_jobs)" "${settings[@]}")
  cp "$work/gmp/build/gmp.h" "$made/include"
  cp "$work/gmp/build/.libs/libgmp.a" "$made/lib"
  mkdir -p "$work/mpfr4/build"
  # shellcheck disable=SC2016
  (cd "$work/mpfr4/build" && kinetri_quietly "building MPFR" "$work/mpfr4.log" bash -ec '
    emconfigure ../configure --disable-thread-safe "$@"
    make -j "$0" -C src libmpfr.la' "$(kinetri_jobs)" "--with-gmp=$made" "${settings[@]}")
  cp "$work/mpfr4/src/mpfr.h" "$made/include"
  cp "$work/mpfr4/build/src/.libs/libmpfr.a" "$made/lib"
  for name in boost CGAL CLI nlohmann; do ln -s "/usr/include/$name" "$made/include/$name"; done
  rm -rf "$folder.partly"
  mv "$made" "$folder.partly"
  mv "$folder.partly" "$folder"
  rm -rf "$work"
}

# kinetri_jobs: the number of compilers to run at once: at most one per processor, and one per 1.5 GB of available
# memory. KINETRI_JOBS overrides it.
kinetri_jobs() {
  if [[ -n ${KINETRI_JOBS:-} ]]; then
    printf '%s\n' "$KINETRI_JOBS"
    return
  fi
  local processors by_memory
  processors=$(nproc)
  by_memory=$(awk '/^MemAvailable:/ { print int($2 / 1500000) }' /proc/meminfo 2>/dev/null)
  if [[ -n $by_memory ]] && ((by_memory < processors)); then processors=$by_memory; fi
  printf '%s\n' $((processors < 1 ? 1 : processors))
}

# kinetri_show_progress LOG: prints the step that the command that writes the log has reached: on a terminal in one
# line, every two seconds; else in a new line, every 20 seconds.
kinetri_show_progress() {
  local log=$1 every=20 line='  %s (%d s)\n' step
  if [[ -t 1 ]]; then every=2 line='\r\033[K  %s (%d s)'; fi
  every=${kinetri_progress_seconds:-$every}  # Set by tests.
  SECONDS=0
  # A sleep that outlives this function must not keep the output open. Ends with the script.
  while sleep "$every" >/dev/null 2>&1 && kill -0 $$ 2>/dev/null; do
    # The formats of Ninja, make and ctest.
    step=$(grep -aoE '^(\[ *[0-9]+(/[0-9]+|%)\]| *[0-9]+/[0-9]+ Test)' "$log" | tail -n 1) || true
    # shellcheck disable=SC2059
    if [[ -n $step ]]; then printf "$line" "$step" "$SECONDS"; fi
  done
}

# kinetri_quietly WHAT LOG COMMAND...: runs the command with its output in the file LOG, and shows progress. If it
# fails, prints the errors in the log, or its end if there are none, and exits.
kinetri_quietly() {
  local what=$1 log=$2 code=0 watcher
  shift 2
  : >"$log"
  kinetri_show_progress "$log" &
  watcher=$!
  "$@" >"$log" 2>&1 </dev/null || code=$?
  { kill "$watcher" && wait "$watcher"; } 2>/dev/null || true
  if [[ -t 1 ]]; then printf '\r\033[K'; fi
  if ((code != 0)); then
    grep -E -m 20 -A 3 '(^|[^a-z])([Ee]rror|FAILED|undefined reference)\b' "$log" >&2 ||
      tail -n 60 "$log" >&2
    kinetri_fail "$what failed; all of its output is in $log"
  fi
}

# kinetri_configure DIR PRESET [CMAKE_OPTION...]: configures DIR by the preset.
kinetri_configure() {
  local dir=$1 preset=$2 configure=() launcher=
  shift 2
  mkdir -p "$dir"
  if command -v ccache >/dev/null; then
    launcher=ccache
    # Without this, ccache does not cache sources that use precompiled headers.
    export CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS:-pch_defines,time_macros,include_file_mtime,include_file_ctime}
  fi
  configure=(cmake -S "$kinetri_root" --preset "$preset" -B "$dir"
    "-DCMAKE_CXX_COMPILER_LAUNCHER=$launcher" "$@")
  if [[ ! -f $dir/CMakeCache.txt ]]; then
    if command -v ninja >/dev/null; then configure+=(-G Ninja); fi
  elif ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$kinetri_root" "$dir/CMakeCache.txt"; then
    configure+=(--fresh)  # The tree was moved or copied.
  fi
  # Presets are looked for in the current directory.
  (cd "$kinetri_root" && kinetri_quietly "configuring" "$dir/configure.log" "${configure[@]}") ||
    exit 1
}

# kinetri_build DIR PRESET [CMAKE_OPTION...] [-- TARGET...]: configures DIR by the preset and builds
# the targets, or everything.
kinetri_build() {
  local dir=$1 preset=$2 options=() targets=()
  shift 2
  while (($# > 0)) && [[ $1 != -- ]]; do
    options+=("$1")
    shift
  done
  if (($# > 1)); then targets=(--target "${@:2}"); fi
  kinetri_configure "$dir" "$preset" "${options[@]}"
  kinetri_say "Building in $dir ..."
  kinetri_quietly "building" "$dir/build.log" \
    cmake --build "$dir" --parallel "$(kinetri_jobs)" "${targets[@]}"
}

# kinetri_build_module: builds the module for JavaScript, and what it needs, in build/wasm.
kinetri_build_module() {
  kinetri_wasm_libraries
  kinetri_build "$kinetri_root/build/wasm" wasm
}

if [[ ${BASH_SOURCE[0]} == "$0" ]]; then
  set -euo pipefail
  if [[ $# -ne 1 || ! $1 =~ ^(demo|test|browser|python|video|coverage|lint|fuzz|arm64|libcxx|live)$ ]]; then
    printf 'usage: %s demo|test|browser|python|video|coverage|lint|fuzz|arm64|libcxx|live\n%s\n' "$0" \
      'Installs the Debian packages that are missing; live also builds GMP and MPFR for WebAssembly.' >&2
    exit 2
  fi
  kinetri_setup "$1"
  if [[ $1 == live ]]; then kinetri_wasm_libraries; fi
fi
