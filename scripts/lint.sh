#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Static checks. See --help.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

checks=(format layers sources documents names shell python javascript tidy)

usage() {
  cat <<EOF
usage: scripts/lint.sh [--fix] [CHECK...]

Checks, each check by its name; without a name all of them, after installing what is missing (with
apt-get, as root):

  format      C++ is formatted, by clang-format 14; --fix formats it
  layers      includes point downward (scripts/check_layers.py)
  sources     licence, guards and the like (scripts/check_sources.py)
  documents   links, and the programs of the guide (scripts/check_documents.py)
  names       names of the code in documents (scripts/check_names.py)
  shell       scripts, by shellcheck
  python      scripts, by pyflakes
  javascript  the syntax of the viewer's scripts, by node, if it is installed
  tidy        C++, by run-clang-tidy 14 with the checks of .clang-tidy: half a minute a source. For one
              folder, when this has configured build/lint: run-clang-tidy-14 -quiet -p build/lint src/io

Exit code 77 if the program of the one named check is not installed. The last line reads "lint: ok" if
nothing was found. The tests run all but tidy; pre-commit runs what .pre-commit-config.yaml lists.
EOF
}

fix='' chosen=()
while (($# > 0)); do
  case $1 in
    --help | -h) usage && exit 0 ;;
    --fix) fix=yes ;;
    *)
      [[ " ${checks[*]} " == *" $1 "* ]] || kinetri_misused "'$1' is unknown"
      chosen+=("$1")
      ;;
  esac
  shift
done
cd "$kinetri_root"

# on_files PROGRAM ARGUMENT... -- PATTERN...: runs the program on the files that match; 77 if it is not installed.
on_files() {
  local command=() names=() files
  while [[ $1 != -- ]]; do command+=("$1") && shift; done
  shift
  command -v "${command[0]}" >/dev/null || return 77
  while (($# > 0)); do names+=(-o -name "$1") && shift; done
  mapfile -d '' files < <(find .ci apps bench data examples include live python scripts setup.py src test \
    viewer -type f \( "${names[@]:1}" \) -print0 | sort -z)
  "${command[@]}" "${files[@]}" || return 1
}

run_check() {
  case $1 in
    format)
      # The result depends on the version: that of Debian 12.
      if [[ $fix ]]; then on_files clang-format-14 -i -- '*.h' '*.cpp'; else
        on_files clang-format-14 --dry-run -Werror -- '*.h' '*.cpp'
      fi
      ;;
    layers | sources | documents | names) python3 "scripts/check_$1.py" ;;
    shell) on_files shellcheck --external-sources -- '*.sh' run ;;
    python) on_files pyflakes3 -- '*.py' ;;
    javascript)
      on_files node --eval 'for (const filename of process.argv.slice(1))
        new (require("vm").Script)(require("fs").readFileSync(filename, "utf8"), {filename})' -- '*.js'
      ;;
    tidy)
      command -v run-clang-tidy-14 >/dev/null || return 77
      kinetri_configure build/lint dev -DCMAKE_CXX_COMPILER=clang++ -DKINETRI_BUILD_BENCH=ON
      run-clang-tidy-14 -quiet -p build/lint -j "$(kinetri_jobs)" ${fix:+-fix} \
        "^$kinetri_root/(apps|bench|examples|src|test|viewer)/"
      ;;
  esac
}

if ((${#chosen[@]} == 0)); then
  kinetri_setup lint
  chosen=("${checks[@]}")
fi
failed=''
for check in "${chosen[@]}"; do
  status=0
  run_check "$check" || status=$?
  if ((status == 77)); then kinetri_say "$check: its program is not installed; nothing checked"; fi
  if ((status == 77 && ${#chosen[@]} == 1)); then exit 77; fi
  if ((status != 0 && status != 77)); then failed+=" $check"; fi
done
[[ -z $failed ]] || kinetri_fail "found something:$failed"
kinetri_say "lint: ok"
