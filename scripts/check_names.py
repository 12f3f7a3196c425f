#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that names of the code in documents exist.

usage: check_names.py [ROOT]

Names are those in `code` that consist of letters, digits and underscores, and paths of files. In
docs/MIGRATION.md only the parts about Kinetri are checked: the last column of tables,
and in code that begins with `// Kinetri`.

Prints `FILE:LINE: what is wrong` for each violation; exit code 1 if there are any.
"""
import re
import sys

sys.dont_write_bytecode = True
import check_tree  # noqa: E402

# Documents with names of the code, and other names in them: of CGAL's former package, of the reader's code,
# and placeholders.
NAMES_OF_OTHERS = {
    "CONTRIBUTING.md": {"Upper_snake_case", "_2", "snake_case", "CamelCase", "name_"},
    "docs/ARCHITECTURE.md": set(),
    "docs/MATH.md": {"rem"},
    "docs/MIGRATION.md": {"Flips", "My_traits", "My_triangulation"},
    "docs/TERMINOLOGY.md": {"Key", "Root", "Simulator", "set_time_to_after", "end_time"},
}
LAST_COLUMN_ONLY = {"docs/MIGRATION.md"}

CODE_FOLDERS = ("include", "src", "apps", "viewer", "test", "scripts", "bench", "cmake")
CODE_SUFFIXES = {".h", ".cpp", ".txt", ".cmake", ".py", ".sh", ".js", ".in", ".json", ".html"}
SKIPPED_FOLDERS = re.compile(r"^(build.*|out|corpus|__pycache__|\..*)$")
COMMENT = re.compile(r"//.*")

CODE = re.compile(r"`([^`]+)`")
WORD = re.compile(r"[A-Za-z_]\w*")
PATH = re.compile(r"[\w.*-]+(?:/[\w.*-]+)+\.(?:h|cpp|md|py|sh|js|txt|cmake|json)\b")


def below(folder):
    """The files below the folder that are ours, in order."""
    for entry in sorted(folder.iterdir()):
        if entry.is_dir():
            if not SKIPPED_FOLDERS.match(entry.name):
                yield from below(entry)
        else:
            yield entry


def lines_of(text):
    """(line number, line, the first line of the code block that it is in, or None)."""
    block = None
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("```"):
            block = "" if block is None else None
            continue
        if block == "":
            block = line
        yield number, line, block


def words_of_code(root):
    """The words of the code, without its comments."""
    result = set()
    for folder in CODE_FOLDERS:
        for file in below(root / folder) if (root / folder).is_dir() else ():
            if file.suffix in CODE_SUFFIXES:
                text = file.read_text(encoding="utf-8")
                if file.suffix in {".h", ".cpp", ".js"}:
                    text = COMMENT.sub("", text)
                result.update(WORD.findall(text))
                result.update(WORD.findall(file.stem))
    for file in root.glob("CMake*"):
        result.update(WORD.findall(file.read_text(encoding="utf-8")))
    return result


def code_in(line, block, last_column_only):
    """The parts of a line that are code of Kinetri."""
    if block is not None:
        if block.startswith("// Kinetri"):
            yield COMMENT.sub("", line)
        return
    if last_column_only:
        if not line.startswith("|"):
            return
        line = line.rstrip("| ").rsplit("|", 1)[-1]
    yield from CODE.findall(line)


def unknown_names(file, root, words):
    """(line, problem) for each name in the document that is not in the code."""
    document = file.relative_to(root).as_posix()
    known = words | NAMES_OF_OTHERS[document]
    folders = (root, root / "include", root / "include/kinetri", file.parent)
    for number, line, block in lines_of(file.read_text(encoding="utf-8")):
        for code in code_in(line, block, document in LAST_COLUMN_ONLY):
            for path in PATH.findall(code):
                if not any(any(folder.glob(path)) for folder in folders):
                    yield number, f"no such file: {path}"
            for word in WORD.findall(PATH.sub("", code)):
                if word not in known:
                    yield number, f"`{word}` is not in the code"


def check(root):
    """(number of documents checked, the violations) below `root`."""
    root = root.resolve()
    words = words_of_code(root)
    violations = []
    documents = [root / path for path in sorted(NAMES_OF_OTHERS) if (root / path).is_file()]
    for file in documents:
        path = file.relative_to(root).as_posix()
        problems = sorted(unknown_names(file, root, words))
        violations += [f"{path}:{line}: {problem}" for line, problem in problems]
    return len(documents), violations


if __name__ == "__main__":
    check_tree.run(check, "names", "documents", __doc__)
