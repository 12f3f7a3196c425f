# SPDX-License-Identifier: GPL-3.0-or-later
"""What all tests of the page share: a browser that shows it, and looks at the picture."""
import unittest

import browser
import runs

MARGIN = 20
STEPS = """(() => {
  const seen = [];
  const note = () => seen.push([kinetri.time, kinetri.event, kinetri.edges(), kinetri.triangles()]);
  note();
  while (kinetri.DIRECTION()) note();
  return seen;
})()"""
PICTURE_AT = "document.getElementById('picture').getBoundingClientRect().toJSON()"


def edges(pairs):
    return [tuple(pair) for pair in pairs]


class Page(unittest.TestCase):
    """A test with a page of its own, which must have had no problem at the end, in a browser that the tests
    of a class share: to start it takes longer than most of them."""

    program = folder = None  # the arguments of viewer_test.py
    kind = None  # of browser: Chromium or Firefox
    without_webgl = False
    made = {}   # the runs so far, by name

    @classmethod
    def setUpClass(cls):
        cls.browser = cls.kind(without_webgl=cls.without_webgl)
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.maxDiff = 2000
        self.browser.begin_page(1000, 640, [("prefers-reduced-motion", "reduce")])

    def tearDown(self):
        self.assertEqual(self.browser.problems, [])

    def run_of(self, name):
        if name not in Page.made:
            Page.made[name] = runs.Run(self.program, self.folder, name)
        return Page.made[name]

    def open(self, path):
        self.browser.open(path)
        self.assertFalse(self.evaluate("document.getElementById('viewer').hidden"),
                         "the page shows no viewer")

    def evaluate(self, expression):
        return self.browser.evaluate(expression)

    def go_to(self, when):
        self.evaluate(f"kinetri.goTo({when!r})")
        self.browser.settle()

    def picture_box(self):
        at = self.evaluate(PICTURE_AT)
        return tuple(round(at[side]) for side in ("left", "top", "right", "bottom"))

    def drag(self, dx, dy):
        """From the middle of the picture, in four steps."""
        left, top, right, bottom = self.picture_box()
        x, y = (left + right) // 2, (top + bottom) // 2 + 40
        self.browser.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
        for step in range(1, 5):
            self.browser.mouse("mouseMoved", x + dx * step / 4, y + dy * step / 4, button="left",
                               buttons=1)
        self.browser.mouse("mouseReleased", x + dx, y + dy, button="left", clickCount=1)
        self.browser.move(5, 5)

    def look(self):
        """What is in the picture, but for its edges: the round corners are not drawn alike each time. Nor is
        the hint, which is hidden."""
        self.evaluate("void (document.getElementById('hint').hidden = true)")
        left, top, right, bottom = self.picture_box()
        inside = (left + MARGIN, top + MARGIN, right - MARGIN, bottom - MARGIN)
        return browser.Picture(self.browser, self.browser.screenshot(inside))
