#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Everything that is checked without running it. See --help.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

checks=(format layers sources documents names messages shell python javascript tidy)

usage() {
  cat <<EOF
usage: scripts/lint.sh [--fix] [--only CHECK]... [--changed | FILE...]

Installs what is missing (with apt-get, as root) and checks, each check by its name:

  format      C++ is formatted (scripts/check_format.sh; --fix formats it)
  layers      includes point downward (scripts/check_layers.py)
  sources     licence, guards and the like (scripts/check_sources.py)
  documents   links, and the programs of the guide (scripts/check_documents.py)
  names       names of the code in documents (scripts/check_names.py)
  messages    every message is in docs/ERRORS.md (scripts/check_messages.py)
  shell       scripts, by shellcheck
  python      scripts, by pyflakes
  javascript  the syntax of the viewer's scripts, by node, where it is installed
  tidy        C++, by clang-tidy 14 with the checks of .clang-tidy: half a minute a source

  --only CHECK  this check, installing nothing; exit code 77 if its program is not installed
  --changed     what differs from the branch main, committed or not; FILE...: these files. What a
                script of our own checks is always checked everywhere, which takes a second.

The last line reads "lint: ok" if nothing was found. The tests run all but tidy.
EOF
}

fix=() only=() changed='' files=()
while (($# > 0)); do
  case $1 in
    --help | -h) usage && exit 0 ;;
    --fix) fix=(--fix) ;;
    --changed) changed=yes ;;
    --only)
      [[ " ${checks[*]} " == *" ${2:-} "* ]] || kinetri_misused "--only: '${2:-}' is unknown"
      only+=("$2")
      shift
      ;;
    -*) kinetri_misused "'$1' is unknown" ;;
    *)
      [[ -f $1 ]] || kinetri_fail "no such file: $1"
      files+=("$(realpath --relative-to="$kinetri_root" "$1")")
      ;;
  esac
  shift
done
if [[ -n $changed ]] && ((${#files[@]} > 0)); then kinetri_misused "--changed: expected no files beside it"; fi

cd "$kinetri_root"
if [[ -n $changed ]]; then
  base=$(git merge-base main HEAD) || kinetri_fail "there is no branch main to compare with"
  mapfile -t files < <({
    git diff --name-only --diff-filter=d "$base"
    git ls-files --others --exclude-standard
  } | sort -u)
  if ((${#files[@]} == 0)); then kinetri_say "nothing differs from main" && exit 0; fi
elif ((${#files[@]} == 0)); then
  mapfile -t files < <(find .ci apps bench data docs examples include scripts src test viewer -type f | sort)
fi

# select_files SUFFIX...: those of the files, in the array `selected`.
select_files() {
  local file suffix
  selected=()
  for file in "${files[@]}"; do
    for suffix in "$@"; do
      if [[ $file == *"$suffix" ]]; then selected+=("$file"); fi
    done
  done
}

# check_by CHECK COMMAND...: runs the command on the selected files, if there are any and its program
# is installed.
check_by() {
  local check=$1
  shift
  if ((${#selected[@]} == 0)); then return 0; fi
  if ! command -v "$1" >/dev/null; then
    kinetri_say "$check: $1 is not installed; nothing checked"
    return 77
  fi
  "$@" "${selected[@]}" || return 1
  kinetri_say "$check: ok (${#selected[@]} files)"
}

run_check() {
  case $1 in
    format) scripts/check_format.sh "${fix[@]}" ;;
    layers | sources | documents | names | messages) python3 "scripts/check_$1.py" ;;
    shell)
      select_files .sh .ci/run  # which has no suffix
      check_by shell shellcheck --external-sources
      ;;
    python)
      select_files .py
      check_by python pyflakes3
      ;;
    javascript)
      select_files .js
      check_by javascript node --eval 'for (const filename of process.argv.slice(1))
        new (require("vm").Script)(require("fs").readFileSync(filename, "utf8"), {filename})'
      ;;
    tidy)
      select_files .cpp .h
      if ((${#selected[@]} > 0)) && command -v clang-tidy-14 >/dev/null; then
        kinetri_configure build/lint dev -DCMAKE_CXX_COMPILER=clang++ -DKINETRI_BUILD_BENCH=ON
      fi
      check_by tidy scripts/run_clang_tidy.py "${fix[@]}" --jobs "$(kinetri_jobs)" build/lint
      ;;
  esac
}

if ((${#only[@]} == 0)); then
  kinetri_setup lint
else
  checks=("${only[@]}")
fi
code=0
for check in "${checks[@]}"; do
  status=0
  run_check "$check" || status=$?
  if ((status == 77 && ${#only[@]} == 1)); then exit 77; fi
  if ((status != 0 && status != 77)); then code=1; fi
done
if ((code == 0)); then kinetri_say "lint: ok"; fi
exit "$code"
