#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that every include points to its own layer or to a lower one, and that each layer uses only
the libraries it may use (docs/ARCHITECTURE.md).

usage: check_layers.py [ROOT]

Prints `FILE:LINE: what is wrong` for each violation; exit code 1 if there are any.
"""
import re
import sys

sys.dont_write_bytecode = True
import check_tree  # noqa: E402

# A layer may include itself and every layer with a smaller number. A test may also include a layer with the
# same number, test/support and any library.
LAYERS = {
    "base": 0,
    "algebra": 1,
    "kinetic": 2,
    "events": 2,
    "triangulation": 3,
    "simulation": 4,
    "observers": 5,
    "io": 5,
    "cli": 6,
    "apps": 7,
    "python": 7,
    "video": 7,
}

NUMBER_TYPES = (
    "boost/multiprecision/",
    "gmp.h",
    "gmpxx.h",
    "mpfr.h",
    "CGAL/enum.h",
    "CGAL/number_type",
    "CGAL/number_utils.h",
    "CGAL/Interval_nt.h",
    "CGAL/Exact_",
    "CGAL/FPU.h",
)

# The libraries of a layer besides the C++ standard library, by the beginning of the header's name.
LIBRARIES = {
    "base": ("sanitizer/",),
    "algebra": NUMBER_TYPES,
    "kinetic": NUMBER_TYPES + ("CGAL/", "boost/smart_ptr/"),
    "events": (),
    "triangulation": NUMBER_TYPES + ("CGAL/", "tbb/"),
    "simulation": ("CGAL/",),
    "observers": NUMBER_TYPES
    + ("CGAL/", "boost/container/", "boost/geometry", "boost/math/quadrature/"),
    "io": ("nlohmann/", "boost/crc.hpp", "sqlite3.h", "expat.h"),
    "cli": ("CLI/", "tbb/"),
    "apps": (),
    "python": ("pybind11/",),
    "video": ("opencv2/", "png.h", "zstd.h"),
}

# CGAL's triangulations are below `triangulation` only.
NOT_FOR = {"kinetic": re.compile(r"CGAL/\w*[Tt]riangulation")}

# The checker of event logs includes only its own folder and these.
CHECKER = "apps/verify"
LIBRARIES_OF_CHECKER = ("gmp.h", "gmpxx.h")

# The layers that talk to the operating system may include C headers such as <unistd.h>.
PLATFORM = {"io", "cli", "apps", "video"}

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
BLOCK_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
STANDARD = re.compile(r"^[a-z_0-9]+$")
SUFFIXES = {".h", ".hpp", ".cpp", ".in"}

# May include every layer; nothing in a layer may include it.
UMBRELLA = "kinetri/kinetri.h"
# Written by the build; has no includes.
GENERATED = "kinetri/version.h"


def layer_of(path):
    """The layer of a path relative to the root; None if it belongs to none."""
    parts = path.parts
    for prefix in (("include", "kinetri", "impl"), ("include", "kinetri"), ("src",), ("test",)):
        if parts[: len(prefix)] == prefix and len(parts) > len(prefix) + 1:
            layer = parts[len(prefix)]
            return layer if layer in LAYERS else None
    if parts[0] == "apps":
        return {"cli": "cli", "kinetri": "apps", "video": "video"}.get(parts[1])
    return "python" if parts[0] == "python" else None


def includes(text):
    """(line number, name, whether in quotes) of each include."""
    text = BLOCK_COMMENT.sub(lambda comment: "\n" * comment.group().count("\n"), text)
    for number, line in enumerate(text.splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1) or match.group(2), match.group(1) is not None


def target_of(root, path, name):
    """The file of the project, relative to the root, that `path` includes as `name`."""
    folders = [root / name for name in ("include", "src", "test", "apps", "apps/kinetri", ".")]
    for folder in [(root / path).parent] + folders:
        file = (folder / name).resolve()
        if file.is_file() and file.is_relative_to(root):
            return file.relative_to(root)
    return None


def own_include_problem(root, path, layer, name):
    """The problem of an include of a file of the project, or None."""
    if name == GENERATED:
        return None
    if name == UMBRELLA:
        return None if layer == "apps" else f"{layer} includes the whole library"
    target = target_of(root, path, name)
    if target is None:
        return f'no such file in the project: "{name}" (libraries are included with <>)'
    other = layer_of(target)
    is_test = path.parts[0] == "test"
    if other is None:
        return None if is_test else f'"{name}" belongs to no layer'
    if other != layer and LAYERS[other] >= LAYERS[layer] + is_test:
        return (
            f"{layer} (layer {LAYERS[layer]}) includes {other} (layer {LAYERS[other]}): {name}; "
            "an include points to a lower layer"
        )
    return None


def library_problem(path, layer, name):
    """The problem of an include of a library's header, or None."""
    if path.parts[0] == "test" or STANDARD.match(name):
        return None
    if "/" not in name or name.startswith("sys/"):
        if name.endswith(".h") and not name.startswith(NUMBER_TYPES):
            return None if layer in PLATFORM else f"{layer} may not use the platform's <{name}>"
    forbidden = layer in NOT_FOR and NOT_FOR[layer].search(name)
    if forbidden or not name.startswith(LIBRARIES[layer]):
        return f"{layer} may not use <{name}>"
    return None


def checker_problem(root, path, name, quoted):
    """The problem of an include of the checker of event logs, or None."""
    if quoted:
        is_own = (root / path).parent.joinpath(name).is_file() and "/" not in name
    else:
        is_own = STANDARD.match(name) or name in LIBRARIES_OF_CHECKER
    return None if is_own else f"{CHECKER} shares nothing with the rest and may not use {name}"


def check(root):
    """(number of files checked, the violations) below `root`."""
    root = root.resolve()
    violations = []
    count = 0
    for top in ("include/kinetri", "src", "apps", "python", "test"):
        for file in sorted((root / top).rglob("*")):
            path = file.relative_to(root)
            layer = layer_of(path)
            if layer is None or file.suffix not in SUFFIXES or not file.is_file():
                continue
            count += 1
            for line, name, quoted in includes(file.read_text(encoding="utf-8")):
                if quoted or name.startswith("kinetri/"):
                    problem = own_include_problem(root, path, layer, name)
                else:
                    problem = library_problem(path, layer, name)
                if problem:
                    violations.append(f"{path}:{line}: {problem}")
    for file in sorted((root / CHECKER).glob("*.*")):
        if file.suffix not in SUFFIXES:
            continue
        count += 1
        for line, name, quoted in includes(file.read_text(encoding="utf-8")):
            problem = checker_problem(root, file.relative_to(root), name, quoted)
            if problem:
                violations.append(f"{file.relative_to(root)}:{line}: {problem}")
    return count, violations


if __name__ == "__main__":
    check_tree.run(check, "layers", "files", __doc__)
