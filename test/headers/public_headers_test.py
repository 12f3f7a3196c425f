# SPDX-License-Identifier: GPL-3.0-or-later
"""The public headers are those of public_headers.txt, and users are shown no others. Of the headers below impl
those that public headers include are installed.

usage: public_headers_test.py ROOT

A header that users need not include is below include/kinetri/impl. Who adds a public one adds it to the list.
"""
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))
LISTED = (pathlib.Path(__file__).parent / "public_headers.txt").read_text(encoding="utf-8").split()
INCLUDE = re.compile(r"#include <(kinetri/[^>]+)>")
INCLUDE_OF_OURS = re.compile(r'#include "(kinetri/[^"]+)"')
# Headers that the programs include, or that only the library itself does: not installed (KinetriInstall.cmake).
NOT_INSTALLED = re.compile(
    r"kinetri/impl/(io/|kinetic/drawn_box_2|observers/(answer_columns|connections|spanning_tree_rows)"
    r"|simulation/(experiment|playback|wave))")
MOST_PUBLIC, MOST_LINES = 75, 17_250


class Public_headers(unittest.TestCase):
    def test_are_those_of_the_list(self):
        headers = {str(file.relative_to(ROOT / "include")) for file in (ROOT / "include").rglob("*.h")}
        public = {header for header in headers if not header.startswith("kinetri/impl/")}
        self.assertEqual(LISTED, sorted(public | {"kinetri/version.h"}))  # The build writes version.h.

    def test_are_all_that_users_are_shown(self):
        files = [ROOT / "README.md", *(ROOT / "docs").rglob("*.md"), *(ROOT / "examples").rglob("*.cpp"),
                 *(ROOT / "test" / "install").rglob("*.cpp")]
        shown = {(match[1], file.name) for file in files
                 for match in INCLUDE.finditer(file.read_text(encoding="utf-8"))}
        self.assertGreater(len(shown), 20)
        self.assertEqual([pair for pair in sorted(shown) if pair[0] not in LISTED], [])

    def test_include_those_below_impl_that_are_installed(self):
        headers = {str(file.relative_to(ROOT / "include")): file.read_text(encoding="utf-8")
                   for file in (ROOT / "include").rglob("*.h")}
        reached, left = set(), [header for header in LISTED if header in headers]
        while left:
            header = left.pop()
            if header not in reached:
                reached.add(header)
                left += [name for name in INCLUDE_OF_OURS.findall(headers[header]) if name in headers]
        self.assertEqual(reached, {header for header in headers if not NOT_INSTALLED.match(header)})
        self.assertLessEqual(len(LISTED), MOST_PUBLIC)
        lines = sum(headers[header].count("\n") for header in reached)
        template = (ROOT / "cmake/version.h.in").read_text(encoding="utf-8")
        self.assertLessEqual(lines + template.count("\n"), MOST_LINES)


if __name__ == "__main__":
    unittest.main()
