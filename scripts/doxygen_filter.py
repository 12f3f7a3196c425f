#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Converts a file of the project for Doxygen (docs/Doxyfile.in, FILTER_PATTERNS), so that headers and
documents need no commands of Doxygen. Lines keep their numbers.

usage: doxygen_filter.py FILE

In a header, the first comment documents the file; its declarations belong to the group of its layer
(docs/groups.dox); defaulted comparisons get a comment; explicit instantiations and friends, which
Doxygen takes for declarations, are removed; and blocks in comments, indented by three blanks or more,
are shown verbatim. In a document, headings get anchors for links; a link to a file that is not a page
becomes its text.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
NAMESPACE_BEGIN = "namespace kinetri {"
NAMESPACE_END = "}  // namespace kinetri"
HIDDEN = re.compile(r"^(extern template|\s*friend class) ")
DEFAULTED_COMPARISON = re.compile(r"^\s*friend .*operator(==|<=>)\(.*\) = default;$")
PLAIN_COMMENT = re.compile(r"^//(?!/)")
# A line of a block in a comment.
INDENTED = re.compile(r"^\s*///   ")
EMPTY = re.compile(r"^\s*///$")
# The end of a comment about the next line.
TOLD = re.compile(r"^\s*///(?! @})")
HEADING = re.compile(r"^#+ (.*\S)\s*$")
CODE = re.compile(r"`([^`]+)`")
# [text](target), not that of an image.
LINK = re.compile(r"(?<!!)\[([^]]+)\]\((?!https?:)([^)#]*)(#[^)]*)?\)")

# An image in another folder.
IMAGE = re.compile(r"(!\[[^]]*\]\()(?!https?:)[^)]*/([^)/]+\))")


def header(lines, layer):
    """The lines of a public header of the layer."""
    is_beginning = True
    is_hidden = False
    for i, line in enumerate(lines):
        is_beginning = is_beginning and bool(PLAIN_COMMENT.match(line))
        if is_beginning:
            lines[i] = "/// \\file" if i == 0 else "/" + line
        elif line == NAMESPACE_BEGIN:
            lines[i] += f" /** \\addtogroup {layer} */ /** @{{ */"
        elif line == NAMESPACE_END:
            lines[i] = "/** @} */ " + line
        elif is_hidden or HIDDEN.match(line):
            is_hidden = not line.endswith(";")
            lines[i] = ""
        elif DEFAULTED_COMPARISON.match(line) and not TOLD.match(lines[i - 1]):
            lines[i] += "  ///< Compares all members."
    is_block = False
    for i, line in enumerate(lines):
        is_block = bool(INDENTED.match(line)) and (is_block or bool(EMPTY.match(lines[i - 1])))
        if is_block:
            lines[i] = line.replace("///", "///  ", 1)
    return lines


def slug(heading):
    """The anchor of a heading on a code host."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def name(path, anchor):
    """The name of a heading in Doxygen, unique in all documents."""
    return re.sub(r"\W", "_", path.with_suffix("").as_posix()) + "-" + anchor


def first_heading(file):
    return next(match.group(1) for line in file.read_text(encoding="utf-8").split("\n")
                if (match := HEADING.match(line)))


def document(lines, path, root):
    """The lines of a Markdown document with the path from the root."""

    def link(match):
        text, target, anchor = match.groups()
        file = (root / path.parent / target).resolve() if target else root / path
        if file.suffix != ".md":
            return text
        # Doxygen makes no link to a path with a space: a document is named by its first heading.
        if not anchor and file == root / "README.md":
            return f"[{text}](@ref index)"
        anchor = anchor[1:] if anchor else slug(first_heading(file))
        return f"[{text}](@ref {name(file.relative_to(root), anchor)})"

    def code(match):
        # Doxygen takes an apostrophe for the end of a quotation, unless the marks are double.
        return f"`{match.group()}`" if "'" in match.group(1) else match.group()

    is_code = False
    for i, line in enumerate(lines):
        if line.startswith("```"):
            is_code = not is_code
        elif not is_code and (heading := HEADING.match(line)):
            lines[i] = f"{line} {{#{name(path, slug(heading.group(1)))}}}"
        elif not is_code:
            # Doxygen finds an image by its name alone, below IMAGE_PATH.
            lines[i] = CODE.sub(code, IMAGE.sub(r"\1\2", LINK.sub(link, line)))
    return lines


def filtered(file, root):
    """The text of the file for Doxygen."""
    lines = file.read_text(encoding="utf-8").split("\n")
    if file.suffix == ".md":
        lines = document(lines, file.relative_to(root), root)
    else:
        # A header outside the folders of the layers belongs to the lowest one.
        folder = file.parent.name
        lines = header(lines, "base" if folder == "kinetri" else folder)
    return "\n".join(lines)


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        sys.exit(__doc__)
    sys.stdout.reconfigure(encoding="utf-8")
    sys.stdout.write(filtered(pathlib.Path(sys.argv[1]).resolve(), ROOT))


if __name__ == "__main__":
    main()
