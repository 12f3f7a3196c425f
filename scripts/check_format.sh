#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Checks that every C++ file is formatted as .clang-format says; with --fix, formats them. The result
# depends on the version of clang-format, so only that of Debian 12 counts.
set -euo pipefail

version=14
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if (($# > 1)) || [[ $# -eq 1 && $1 != --fix ]]; then
  echo "usage: $0 [--fix]" >&2
  exit 2
fi

formatter=
for candidate in "clang-format-$version" clang-format; do
  if "$candidate" --version 2>/dev/null | grep -q "version $version\."; then
    formatter=$candidate
    break
  fi
done
if [[ -z $formatter ]]; then
  echo "clang-format $version is not installed; nothing checked"
  exit 77
fi

folders=()
for folder in include src apps test examples bench; do
  if [[ -d $folder ]]; then folders+=("$folder"); fi
done
mapfile -d '' files < <(find "${folders[@]}" \( -name '*.h' -o -name '*.cpp' \) -print0 | sort -z)

if [[ ${1:-} == --fix ]]; then
  "$formatter" -i "${files[@]}"
elif ! problems=$("$formatter" --dry-run -Werror "${files[@]}" 2>&1); then
  # The first problem of each file.
  sed -nE 's/^([^ :]+:[0-9]+):[0-9]+: error: .*/\1: not formatted/p' <<<"$problems" | sort -t: -u -k1,1
  echo "run scripts/check_format.sh --fix"
  exit 1
else
  echo "format: ok (${#files[@]} files)"
fi
