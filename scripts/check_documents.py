#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks links and code in the documentation.

- Every relative link in a Markdown file leads to a file and, if it names one, to a heading there.
- So does every relative `href` and `src` in docs/index.html, the start page if docs is served.
- The program in README.md is the one that test/install builds.
- The lines of a block in a page of docs/guide are in an example that the page links: ```cpp or
  ```python in the program, ```text in its output, ```cmake and ```csv in a linked file. The block
  may be indented less. ```sh is for commands, which are not checked.
- A page of docs/guide shows every program of examples/ and examples/python/: the whole of it if it has
  at most 100 lines, and its whole output.

usage: check_documents.py [ROOT]

Prints `FILE:LINE: what is wrong` for each violation; exit code 1 if there are any.
"""
import collections
import pathlib
import re
import sys
import textwrap
import urllib.parse

sys.dont_write_bytecode = True
import check_tree  # noqa: E402

SKIPPED_FOLDERS = re.compile(r"^(build.*|out|__pycache__|\..*)$")
START_PAGE = pathlib.PurePath("docs/index.html")
README_PROGRAM = pathlib.PurePath("test/install/consumer/main.cpp")

# By the language of a block of the guide: the ending of the linked file that must contain it. Output is in
# the file beside the program.
PROGRAMS = {"cpp": ".cpp", "python": ".py"}
ENDINGS = {**PROGRAMS, "text": ".txt", "cmake": "CMakeLists.txt", "csv": ".csv"}
UNCHECKED = {"sh"}

# A program with at most this many lines is shown completely.
SHORT_PROGRAM = 100

FENCE = re.compile(r"^ {0,3}(```+|~~~+)\s*(\w*)\s*$")
HEADING = re.compile(r"^ {0,3}#{1,6}\s+(.*?)\s*#*\s*$")
CODE_SPAN = re.compile(r"(`+)(?!`).*?(?<!`)\1(?!`)")
# The text of a link may begin on the line before.
LINK = re.compile(r"\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)|^\[[^\]]+\]:\s*<?(\S+?)>?\s*$")
HTML_LINK = re.compile(r"\b(?:href|src)=\"([^\"#]+)")
SCHEME = re.compile(r"^[a-zA-Z][a-zA-Z0-9+.-]*:")

Block = collections.namedtuple("Block", "line language lines")


def pages(folder):
    """The Markdown files below the folder, in order."""
    for entry in sorted(folder.iterdir()):
        if entry.is_dir():
            if not SKIPPED_FOLDERS.match(entry.name):
                yield from pages(entry)
        elif entry.suffix == ".md":
            yield entry


def parse(text):
    """(the fenced blocks, [(line number, line)] of all other lines, without code) of a page."""
    blocks, prose = [], []
    fence = None
    for number, line in enumerate(text.splitlines(), 1):
        match = FENCE.match(line)
        if fence:
            if match and match.group(1).startswith(fence) and not match.group(2):
                fence = None
            else:
                blocks[-1].lines.append(line)
        elif match:
            fence = match.group(1)
            blocks.append(Block(number, match.group(2), []))
        elif not line.startswith("    "):
            prose.append((number, line))
    return blocks, prose


def anchors(text):
    """The anchors of the headings of a page, as GitHub makes them."""
    result = set()
    counts = collections.Counter()
    for _, line in parse(text)[1]:
        match = HEADING.match(line)
        if match:
            words = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", match.group(1)).lower()
            name = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
            result.add(f"{name}-{counts[name]}" if counts[name] else name)
            counts[name] += 1
    return result


def links(prose):
    """(line number, target) of each link that is relative."""
    for number, line in prose:
        for match in LINK.finditer(CODE_SPAN.sub("", line)):
            target = match.group(1) or match.group(2)
            if not SCHEME.match(target):
                yield number, target


def split_target(page, target):
    """(the file of a link in the page, the anchor or "")."""
    path, _, anchor = target.partition("#")
    path = urllib.parse.unquote(path)
    return ((page.parent / path).resolve() if path else page), anchor


def link_problems(root, page, prose):
    for number, target in links(prose):
        file, anchor = split_target(page, target)
        if not file.is_relative_to(root) or not file.exists():
            yield number, f"a link to {target}, which is not there"
        elif anchor and file.suffix == ".md":
            if anchor not in anchors(file.read_text(encoding="utf-8")):
                yield number, f"a link to {target}, but no heading there is called that"


def start_page_problems(root):
    page = root / START_PAGE
    if not page.is_file():
        return
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        for target in HTML_LINK.findall(line):
            if not SCHEME.match(target) and not split_target(page, target)[0].is_file():
                yield f"{START_PAGE}:{number}: a link to {target}, which is not there"


def occurs(lines, text):
    """Whether the lines are consecutive in the text, perhaps indented more."""
    there = text.splitlines()
    for start in range(len(there) - len(lines) + 1):
        part = there[start : start + len(lines)]
        if part == lines or textwrap.dedent("\n".join(part)).splitlines() == lines:
            return True
    return False


def whole(file):
    """The lines of a file without the comment at the top of a program."""
    lines = file.read_text(encoding="utf-8").splitlines()
    while file.suffix in PROGRAMS.values() and lines and lines[0].startswith(("//", "#!", "# ")):
        del lines[0]
    return lines


def block_problems(page, blocks, prose, shown):
    """The problems of the blocks of a page of the guide. Adds to `shown`, by file, whether all of it is
    shown."""
    linked = [split_target(page, target)[0] for _, target in links(prose)]
    linked += [file.with_suffix(".txt") for file in linked if file.suffix in PROGRAMS.values()]
    for block in blocks:
        if block.language in UNCHECKED:
            continue
        if block.language not in ENDINGS:
            known = ", ".join(sorted(UNCHECKED | set(ENDINGS)))
            yield block.line, f"a block in `{block.language}`; expected one of {known}"
            continue
        ending = ENDINGS[block.language]
        files = [file for file in linked if file.name.endswith(ending) and file.is_file()]
        found = [f for f in files if occurs(block.lines, f.read_text(encoding="utf-8"))]
        if not block.lines or not found:
            names = " or ".join(sorted({file.name for file in files})) or f"a linked *{ending}"
            yield block.line, f"a {block.language} block that does not stand in {names}"
        for file in found:
            shown[file] = shown.get(file, False) or block.lines == whole(file)


def readme_problems(root, blocks):
    program = (root / README_PROGRAM).read_text(encoding="utf-8").splitlines()[1:]  # no license
    if program not in [block.lines for block in blocks if block.language == "cpp"]:
        yield 1, f"no block is the program {README_PROGRAM}"


def check(root):
    """(number of pages checked, the violations) below `root`."""
    root = root.resolve()
    violations = []
    count = 0
    shown = {}
    for page in pages(root):
        count += 1
        path = page.relative_to(root)
        blocks, prose = parse(page.read_text(encoding="utf-8"))
        problems = list(link_problems(root, page, prose))
        if path.parts[:2] == ("docs", "guide"):
            problems += block_problems(page, blocks, prose, shown)
        if path == pathlib.PurePath("README.md"):
            problems += readme_problems(root, blocks)
        violations += [f"{path}:{line}: {problem}" for line, problem in problems]
    violations += start_page_problems(root)
    for program in sorted([*root.glob("examples/*.cpp"), *root.glob("examples/python/*.py")]):
        path = program.relative_to(root)
        output = program.with_suffix(".txt")
        length = len(program.read_text(encoding="utf-8").splitlines())
        if program not in shown:
            violations.append(f"{path}:1: no page of docs/guide shows it")
        elif length <= SHORT_PROGRAM and not shown[program]:
            violations.append(f"{path}:1: no page of docs/guide shows the whole of its {length} lines")
        elif output.exists() and not shown.get(output):
            violations.append(f"{path}:1: no page of docs/guide shows the whole of {output.name}")
    return count, violations


if __name__ == "__main__":
    check_tree.run(check, "documents", "pages", __doc__)
