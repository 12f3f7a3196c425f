# SPDX-License-Identifier: GPL-3.0-or-later
"""Screens of all sizes, the first look, and accessibility of every panel."""
import os
import pathlib
import shutil
import unittest

from page import Page

VIEWPORTS = ((360, 640), (740, 360), (768, 1024), (1024, 768), (1280, 800), (1920, 1080))
SMALL = ((360, 640), (740, 360))
# Whether what is at the middle of the element is the element: nothing lies over it, and it is on the screen.
TARGETS = """[...document.querySelectorAll('button, input, select')].filter((e) => e.checkVisibility())
  .map((e) => ({id: e.id || e.textContent, ...e.getBoundingClientRect().toJSON()}))"""
# What scrolls, as it has no room, and neither takes the focus nor has something that does.
STUCK = """[...document.querySelectorAll('#viewer *')].filter((e) => e.checkVisibility() &&
  e.scrollHeight > e.clientHeight + 1 && /auto|scroll/.test(getComputedStyle(e).overflowY) && e.tabIndex < 0 &&
  e.querySelector('button, input, select, [tabindex="0"]') === null).map((e) => e.id || e.className)"""
TEXTS = """(() => {
  const boxes = [];
  const walk = document.createTreeWalker(document.getElementById('viewer'), NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) {
    const node = walk.currentNode, parent = node.parentElement;
    if (node.data.trim() === '' || !parent.checkVisibility() || parent.closest('select, #legend, #hint')) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    const r = range.getBoundingClientRect(), middle = [r.x + r.width / 2, r.y + r.height / 2];
    const top = document.elementFromPoint(...middle);
    if (top !== null && (parent.contains(top) || top.contains(parent))) {
      boxes.push([node.data.trim(), r.left, r.top, r.right, r.bottom]);
    }
  }
  return boxes;
})()"""


class Screens(Page):
    def setUp(self):
        super().setUp()
        self.run_ = self.run_of("discs")

    def check_texts(self):
        """No text lies over another one."""
        boxes = self.evaluate(TEXTS)
        self.assertGreater(len(boxes), 3)
        for i, (text, left, top, right, bottom) in enumerate(boxes):
            for other, l, t, r, b in boxes[:i]:
                width = min(right, r) - max(left, l)
                height = min(bottom, b) - max(top, t)
                self.assertFalse(width > 2 and height > 4, f"'{text}' and '{other}'")

    def test_viewports(self):
        for width, height in VIEWPORTS:
            for words in ("t=3", "t=3&point=12", "t=3&color=area&legend=on"):
                with self.subTest(width=width, height=height, words=words):
                    self.browser.resize(width, height)
                    self.browser.open(self.run_.page, "#" + words)
                    self.assertEqual(self.evaluate(
                        "[document.documentElement.scrollWidth, document.documentElement.scrollHeight]"),
                        [width, height])
                    picture = self.evaluate("document.getElementById('picture').getBoundingClientRect().toJSON()")
                    self.assertGreater(picture["width"], 0.5 * width)
                    self.assertGreater(picture["height"], 0.5 * height)
                    if "point" in words:
                        side = self.evaluate("document.getElementById('side').getBoundingClientRect().toJSON()")
                        self.assertTrue(0 <= side["left"] and side["right"] <= width and 0 <= side["top"] and
                                        side["bottom"] <= height)
                        free = (picture["width"] * picture["height"] -
                                max(0, min(side["right"], picture["right"]) - max(side["left"], picture["left"])) *
                                max(0, min(side["bottom"], picture["bottom"]) - max(side["top"], picture["top"])))
                        self.assertGreater(free, 0.2 * width * height, "the sheet covers the picture")
                    self.check_texts()
                    play = self.evaluate("document.getElementById('button-play').getBoundingClientRect().toJSON()")
                    self.assertTrue(0 <= play["left"] and play["right"] <= width and play["bottom"] <= height)

    def test_touch_targets(self):
        for width, height in SMALL:
            for words in ("t=3", "t=3&point=12", "t=3&list=on"):
                self.browser.resize(width, height)
                self.browser.open(self.run_.page, "#" + words)
                for target in self.evaluate(TARGETS):
                    if not target["id"].isdigit() and "#" not in target["id"]:  # links in a text
                        self.assertGreaterEqual(round(target["height"]), 40 if target["id"] == "color" else 44, target)
                        self.assertGreaterEqual(round(target["width"]), 44, target)

    def test_what_scrolls_can_be_reached_by_keys(self):
        for width, height in SMALL:
            for words in ("t=3&color=area&legend=on&show=heat,arrows,axes", "t=3&point=12", "t=3&list=on"):
                self.browser.resize(width, height)
                self.browser.open(self.run_.page, "#" + words)
                self.assertEqual(self.evaluate(STUCK), [], words)
        self.browser.open(self.run_.page, "#t=3&legend=on&show=heat,arrows,axes")
        self.evaluate("document.getElementById('legend').focus()")
        speed = self.evaluate("document.getElementById('speed').textContent")
        self.browser.key("ArrowDown", code="ArrowDown")
        self.assertEqual(self.evaluate("document.getElementById('speed').textContent"), speed)

    def test_it_plays_at_first(self):
        """Unless the reader prefers less motion, or the address says where to be."""
        is_playing = "document.querySelector('#button-play use').getAttribute('href') === '#icon-pause'"
        for media, fragment, expected in (((), "", True), ((), "#t=1", False), ((), "#t=1&play=on", True),
                                          ((("prefers-reduced-motion", "reduce"),), "", False)):
            self.browser.begin_page(1000, 640, media)
            self.browser.open(self.run_.page, fragment)
            self.assertEqual(self.evaluate(is_playing), expected, (media, fragment))
            self.assertEqual(self.evaluate("document.getElementById('hint').hidden"), fragment != "")
            self.browser.key("g")
            self.assertTrue(self.evaluate("document.getElementById('hint').hidden"))

    def test_embedded(self):
        self.browser.resize(480, 320)
        self.browser.open(self.run_.page, "?embed#t=3")
        box = self.evaluate("document.getElementById('picture').getBoundingClientRect().toJSON()")
        self.assertGreater(box["height"], 0.7 * 320)
        self.assertEqual(self.evaluate("kinetri.time"), 3)
        self.assertTrue(self.evaluate("document.getElementById('button-play').checkVisibility()"))
        self.assertFalse(self.evaluate("document.getElementById('title').checkVisibility()"))


def axe():
    """The path of axe.min.js (Deque's axe-core), or None."""
    named = os.environ.get("KINETRI_AXE")
    npm = shutil.which("npm")
    places = [named] if named else []
    if npm:
        places.append(str(pathlib.Path(npm).resolve().parent.parent / "axe-core" / "axe.min.js"))
    return next((pathlib.Path(place) for place in places if pathlib.Path(place).is_file()), None)


class Accessible(Page):
    """Every panel, light and dark, by axe-core."""

    @unittest.skipIf(axe() is None, "axe-core is not installed; KINETRI_AXE names its axe.min.js")
    def test_panels(self):
        discs, near = self.run_of("discs").page, self.run_of("near").page
        self.open(discs)
        a, b = self.evaluate("kinetri.edges()")[7]
        for width, height in ((1280, 800), (360, 640)):
            for theme in ("light", "dark"):
                for page, words, key in ((discs, "", None), (discs, "point=12", None), (discs, f"edge={a}-{b}", None),
                                         (discs, "color=area&legend=on&show=heat,arrows,axes", None), (discs, "", "?"),
                                         (discs, "", "s"), (discs, "", "/"), (discs, "list=on", None),
                                         (near, "color=component&legend=on&point=0", None)):
                    with self.subTest(width=width, theme=theme, words=words, key=key):
                        self.browser.resize(width, height)
                        self.browser.open(page, f"#theme={theme}&{words}".rstrip("&"))
                        self.evaluate("void 0;" + axe().read_text(encoding="utf-8") + ";void 0")
                        if key:
                            self.browser.key(key)
                        found = self.evaluate("axe.run().then((result) => result.violations.map((v) =>"
                                              " [v.id, v.nodes.map((n) => n.html.slice(0, 120))]))")
                        self.assertEqual(found, [])
