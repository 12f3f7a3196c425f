#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks all files of the project: the license is in the first lines; an installed header has an include
guard named after its path and includes a public header; a source includes its own header first; there is
no path of a machine, no tab, no space at the end of a line, and a newline at the end. The names of a test
are in a namespace named after its file. A test expects the message of each precondition.

usage: check_sources.py [ROOT]

Prints `FILE:LINE: what is wrong` for each violation; exit code 1 if there are any.
"""
import pathlib
import re
import sys

sys.dont_write_bytecode = True
import check_tree  # noqa: E402

LICENSE = "SPDX-License-Identifier: GPL-3.0-or-later"
LICENSE_LINES = 3

# Files that are checked, by suffix or by name.
SUFFIXES = {".h", ".cpp", ".cmake", ".in", ".py", ".sh", ".md", ".json", ".yml", ".yaml",
            ".html", ".css", ".js"}
NAMES = {"CMakeLists.txt", ".clang-format", ".gitignore", "run"}
# Folders that are not checked: of builds, hidden ones, and data.
SKIPPED_FOLDERS = re.compile(r"^(build.*|out|data|corpus|__pycache__|\..*)$")
CHECKED_HIDDEN_FOLDERS = {".ci"}
# Formats without comments.
WITHOUT_LICENSE = {".json", ".gitignore", ".clang-format"}

# Every installed header includes it, directly or through its first public header: it stops a compiler that
# is not set to C++20 before other errors.
FIRST_HEADER = "include/kinetri/base/platform.h"
INCLUDE_OF_OURS = re.compile(r'#include "kinetri/')

PRECONDITION = re.compile(r'\bKINETRI_PRECONDITION\([^;]*?"((?:[^"\\]|\\.)*)"')
# To violate these needs 2^32 items.
UNTESTED_PRECONDITIONS = {"the queue is full", "too many items"}

# A home directory, or a working directory of a build machine.
MACHINE_PATH = re.compile(r"(?<![\w.$}~])/(?:home|Users|root|work|workspace|builds|mnt)/[\w.-]+")


def files(root):
    """The files to check, relative to the root, in order."""
    for entry in sorted(root.iterdir()):
        if entry.is_dir():
            if entry.name in CHECKED_HIDDEN_FOLDERS or not SKIPPED_FOLDERS.match(entry.name):
                yield from files(entry)
        elif entry.suffix in SUFFIXES or entry.name in NAMES:
            yield entry


def expected_guard(path):
    """The include guard of an installed header, KINETRI_LAYER_NAME_H."""
    return "_".join(re.sub(r"[^A-Za-z0-9]", "_", part) for part in path.parts[1:]).upper()


def header_of(path, root):
    """The installed header that the source src/LAYER/NAME.cpp defines; None if there is none."""
    for folder in ("kinetri", "kinetri/impl"):
        header = pathlib.PurePath("include", folder, *path.parts[1:]).with_suffix(".h")
        if (root / header).is_file():
            return header
    return None


def problems(path, text, root):
    """(line, problem) for each violation in the file `path`, relative to the root."""
    lines = text.splitlines()
    kind = path.name if path.name.startswith(".") else path.suffix
    if kind not in WITHOUT_LICENSE and not any(LICENSE in line for line in lines[:LICENSE_LINES]):
        yield 1, f"no license; expected `{LICENSE}` in the first {LICENSE_LINES} lines"
    if path.suffix == ".h" and path.parts[0] == "include":
        guard = expected_guard(path)
        if f"#ifndef {guard}" not in lines or f"#define {guard}" not in lines:
            yield 1, f"no include guard {guard}"
        if str(path) != FIRST_HEADER and not any(INCLUDE_OF_OURS.match(line) for line in lines):
            yield 1, f"no public header included; expected {FIRST_HEADER.removeprefix('include/')}"
    header = header_of(path, root) if path.suffix == ".cpp" and path.parts[0] == "src" else None
    if header:
        own = f'#include "{pathlib.PurePath(*header.parts[1:])}"'
        first = next((i for i, line in enumerate(lines) if line.startswith("#include")), 0)
        if lines[first : first + 1] != [own]:
            # This proves that the header compiles alone (test/headers).
            yield first + 1, f"expected {own} before all other headers"
    if path.parts[0] == "test" and path.name.endswith("_test.cpp"):
        # Several tests are compiled as one, and have helpers of the same name.
        namespace = re.compile(rf"namespace \w[\w:]*\b({path.stem}|{path.parts[1]}_{path.stem}) {{")
        if not any(namespace.fullmatch(line) for line in lines):
            yield 1, f"expected a namespace ...::{path.stem} around the tests"
    for number, line in enumerate(lines, 1):
        if MACHINE_PATH.search(line):
            yield number, "a path of one machine: " + MACHINE_PATH.search(line).group()
        if "\t" in line:
            yield number, "a tab"
        if line != line.rstrip():
            yield number, "space at the end of the line"
    if not text.endswith("\n"):
        yield len(lines), "no newline at the end"


def untested_preconditions(root):
    """(path, line, problem) for each precondition whose message, or its first literal, is in no test."""
    tests = "".join(file.read_text(encoding="utf-8") for file in (root / "test").rglob("*.cpp"))
    tests = re.sub(r'"\s*\n\s*"', "", tests)  # A text in several literals is one text.
    for folder in ("include", "src"):
        for file in sorted([*(root / folder).rglob("*.h"), *(root / folder).rglob("*.cpp")]):
            source = file.read_text(encoding="utf-8")
            for match in PRECONDITION.finditer(source):
                if match[1] not in tests and match[1] not in UNTESTED_PRECONDITIONS:
                    line = source.count("\n", 0, match.start()) + 1
                    yield file.relative_to(root), line, f'"{match[1]}" is in no test; break it in one'


def check(root):
    """(number of files checked, the violations) below `root`."""
    root = root.resolve()
    violations = []
    count = 0
    for file in files(root):
        count += 1
        path = file.relative_to(root)
        for line, problem in problems(path, file.read_text(encoding="utf-8"), root):
            violations.append(f"{path}:{line}: {problem}")
    violations += [f"{path}:{line}: {problem}" for path, line, problem in untested_preconditions(root)]
    return count, violations


if __name__ == "__main__":
    check_tree.run(check, "sources", "files", __doc__)
