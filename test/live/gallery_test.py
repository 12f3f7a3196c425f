#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/gallery/live.html is made of the present files of viewer/ and live/. Its module is that of the machine on which it
was written: compilers need not make the same bytes.

usage: gallery_test.py FOLDER_OF_THE_PROJECT
"""
import pathlib
import re
import sys

PAGE = "docs/gallery/live.html"


def code(script):
    """Without indentation, empty lines, and lines that are comments but those about the license, as in the page."""
    lines, is_comment = [], False
    for line in script.splitlines(keepends=True):
        text = line.lstrip(" ")
        is_comment = is_comment or text.startswith("/*")
        if "SPDX" in text or not (is_comment or text.startswith("//") or text == "\n"):
            lines.append(text)
        is_comment = is_comment and "*/" not in text
    return "".join(lines)


def main():
    root = pathlib.Path(sys.argv[1])

    def read(name):
        return (root / name).read_text(encoding="utf-8")

    text = read(PAGE)
    module = re.search(r'<script type="text/plain" id="module">([!#-;=-\[\]-~]{100000,})</script>', text)
    if module is None:
        sys.exit(f"{PAGE} has no module")
    scripts = "".join(read(f"viewer/{name}") for name in read("viewer/scripts.txt").split())
    live = "".join(read(f"live/{name}") for name in (
        "kinetri.mjs", "presets.js", "unpack.js", "range.js", "bar.js", "live.js", "start.js"))
    expected = read("viewer/page.html")
    for marker, content in (
            ("title", "Kinetri live"),
            ("style", read("viewer/style.css")),
            ("recording", f"<style>{read('live/live.css')}</style>\n{module.group()}\n"
                          f'<script type="module">\n{code(live)}</script>\n'),
            ("scripts", f"<script>\n{code(scripts)}</script>\n")):
        before, after = expected.split(f"<!-- {marker} -->", 1)
        expected = before + content + after
    if text != expected:
        line = next((number for number, (ours, other) in
                     enumerate(zip(text.splitlines(), expected.splitlines()), 1) if ours != other), 0)
        sys.exit(f"{PAGE}, line {line}: the page is not made of the present files of viewer/ and live/; expected what "
                 f"kinetri live -o {PAGE} writes")


if __name__ == "__main__":
    main()
