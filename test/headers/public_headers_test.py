# SPDX-License-Identifier: GPL-3.0-or-later
"""The public headers are those of public_headers.txt, and users are shown no others.

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


if __name__ == "__main__":
    unittest.main()
