#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the viewer page in Debian's chromium-headless-shell, or chromium, or firefox-esr, without a window.

usage: viewer_test.py PROGRAM WORK_DIR TEST BROWSER

TEST is one of CASES. In `runs` the pages of runs are opened from their files, played event by event, forward
and backward, and must show the edges of the program's own logs. BROWSER is chromium or firefox. Exit code
77 if the browser is not there.
"""
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
from certificate import Certificate  # noqa: E402
from chromium import Chromium  # noqa: E402
from drawing import Drawing, Without_webgl  # noqa: E402
from encounters import Near  # noqa: E402
from exporting import Exporting  # noqa: E402
from firefox import Firefox  # noqa: E402
from interface import Interface  # noqa: E402
from page import Page  # noqa: E402
from periodic import Periodic  # noqa: E402
from playing import Playing  # noqa: E402
from points import Points  # noqa: E402
from recordings import Damaged, Small  # noqa: E402
from screens import Accessible, Screens  # noqa: E402

SKIPPED = 77
BROWSERS = {"chromium": (Chromium, "chromium-headless-shell"), "firefox": (Firefox, "firefox-esr")}
CASES = {"runs": Playing, "interface": Interface, "certificate": Certificate, "drawing": Drawing,
         "without_webgl": Without_webgl, "points": Points, "screens": Screens,
         "accessible": Accessible, "exporting": Exporting, "encounters": Near, "periodic": Periodic, "small": Small, "damaged": Damaged}


def main():
    if len(sys.argv) != 5 or sys.argv[4] not in BROWSERS:
        sys.exit(__doc__)
    Page.kind, package = BROWSERS[sys.argv[4]]
    if Page.kind.executable() is None:
        print(f"{package} is not installed; nothing tested")
        return SKIPPED
    if sys.argv[3] not in CASES:
        sys.exit(f"no such test: {sys.argv[3]}")
    Page.program, Page.folder = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    suite = unittest.defaultTestLoader.loadTestsFromTestCase(CASES[sys.argv[3]])
    return 0 if unittest.TextTestRunner(verbosity=2).run(suite).wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
