#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the documents: that each link between them leads to a file, and to a heading where it names
one; and that what the documents about the code call by a name of the code is there.

usage: check_documents.py [ROOT]

Names are those in `code` that consist of letters, digits and underscores, and paths of files. In
docs/MIGRATION.md they are looked for where it speaks of Kinetri alone: in the last column of tables,
and in code that begins with `// Kinetri`.

Prints `FILE:LINE: what is wrong` for each violation; exit code 1 if there are any.
"""
import pathlib
import re
import sys

sys.dont_write_bytecode = True
from doxygen_filter import slug  # noqa: E402

# Documents with names of the code, and the names in them that are not: of CGAL's former package, of
# the reader's own code, and those that stand for others.
NAMES_OF_OTHERS = {
    "CONTRIBUTING.md": {"Upper_snake_case", "_2", "snake_case", "CamelCase", "name_"},
    "docs/ARCHITECTURE.md": set(),
    "docs/MATH.md": {"rem"},
    "docs/MIGRATION.md": {"Flips", "My_traits", "My_triangulation"},
    "docs/TERMINOLOGY.md": {"Key", "Root", "Simulator", "set_time_to_after", "end_time"},
}
LAST_COLUMN_ONLY = {"docs/MIGRATION.md"}

CODE_FOLDERS = ("include", "src", "apps", "test", "scripts", "bench", "cmake")
CODE_SUFFIXES = {".h", ".cpp", ".txt", ".cmake", ".py", ".sh", ".js", ".in", ".json", ".html"}
SKIPPED_FOLDERS = re.compile(r"^(build.*|out|corpus|__pycache__|\..*)$")
COMMENT = re.compile(r"//.*")

LINK = re.compile(r"\[[^]]*\]\((?!\w+:)([^)#\s]*)(?:#([^)\s]*))?\)")
CODE = re.compile(r"`([^`]+)`")
WORD = re.compile(r"[A-Za-z_]\w*")
PATH = re.compile(r"[\w.*-]+(?:/[\w.*-]+)+\.(?:h|cpp|md|py|sh|js|txt|cmake|json)\b")
HEADING = re.compile(r"^#+ (.*\S)\s*$")


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


def anchors(file):
    """The anchors of the headings of a document."""
    text = file.read_text(encoding="utf-8")
    headings = (HEADING.match(line) for _, line, block in lines_of(text) if block is None)
    return {slug(heading.group(1)) for heading in headings if heading}


def broken_links(file, root):
    """(line, what is wrong) for each link of the document that leads nowhere."""
    for number, line, block in lines_of(file.read_text(encoding="utf-8")):
        if block is not None:
            continue
        for target, anchor in LINK.findall(line):
            other = (file.parent / target).resolve() if target else file
            if not other.is_relative_to(root) or not other.exists():
                yield number, f"a link to {target}, which is not there"
            elif anchor and anchor not in anchors(other):
                yield number, f"a link to the heading #{anchor}, which is not in {target or 'here'}"


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
    """The parts of a line that are code of ours."""
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
    """(line, what is wrong) for each name in the document that is not in the code."""
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
    """(number of documents looked at, the violations) below `root`."""
    root = root.resolve()
    words = words_of_code(root)
    violations = []
    documents = [file for file in below(root) if file.suffix == ".md"]
    for file in documents:
        path = file.relative_to(root).as_posix()
        problems = list(broken_links(file, root))
        if path in NAMES_OF_OTHERS:
            problems += unknown_names(file, root, words)
        violations += [f"{path}:{line}: {problem}" for line, problem in sorted(problems)]
    return len(documents), violations


def main():
    if len(sys.argv) > 2 or sys.argv[1:2] in (["-h"], ["--help"]):
        sys.exit(__doc__)
    root = pathlib.Path(sys.argv[1] if len(sys.argv) == 2 else pathlib.Path(__file__).parents[1])
    count, violations = check(root)
    for violation in violations:
        print(violation)
    if count == 0:
        print(f"{root}: no documents found")
    elif not violations:
        print(f"documents: ok ({count} files)")
    return 0 if count and not violations else 1


if __name__ == "__main__":
    sys.exit(main())
