# SPDX-License-Identifier: GPL-3.0-or-later
"""Screens of all sizes: what is where, and how large; the first look; and accessibility of every panel."""
import os
import pathlib
import shutil
import time
import unittest

from page import Page

PHONES = ((320, 568), (390, 844))
UPRIGHT = (*PHONES, (600, 960), (768, 1024))
LOW = ((740, 360),)
SMALL = (*UPRIGHT, *LOW)
LARGE = ((1024, 768), (1280, 800), (1920, 1080))
EMBEDDED = ((400, 300), (640, 360), (480, 320))
LEAST_TARGET = 44  # pixels, of what a finger presses
LEAST_FONT = 12    # pixels
BOX = "document.getElementById('{}').getBoundingClientRect().toJSON()"
# What is beside the picture: all that can be pressed or read.
AROUND = """[...document.querySelectorAll('#viewer :is(button, input, select, label, h1, h2, p, #legend, #events, .panel)')]
  .filter((e) => e.checkVisibility() && !['hint', 'status'].includes(e.id))
  .map((e) => ({id: e.id || e.textContent, ...e.getBoundingClientRect().toJSON()}))"""
TARGETS = """[...document.querySelectorAll('button, input, select')].filter((e) => e.checkVisibility())
  .map((e) => ({id: e.id || e.textContent, isLink: e.classList.contains('link'),
                ...e.getBoundingClientRect().toJSON()}))"""
# What scrolls, as it has no room, and neither takes the focus nor has something that does.
STUCK = """[...document.querySelectorAll('#viewer *')].filter((e) => e.checkVisibility() &&
  e.scrollHeight > e.clientHeight + 1 && /auto|scroll/.test(getComputedStyle(e).overflowY) && e.tabIndex < 0 &&
  e.querySelector('button, input, select, [tabindex="0"]') === null).map((e) => e.id || e.className)"""
# Texts, as far as they are seen: what scrolls and what ends with an ellipsis is clipped.
TEXTS = """(() => {
  const boxes = [];
  let number = 0;
  const walk = document.createTreeWalker(document.getElementById('viewer'), NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) {
    const node = walk.currentNode, parent = node.parentElement;
    if (node.data.trim() === '' || !parent.checkVisibility() || parent.closest('select, #hint')) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    ++number;
    for (const line of range.getClientRects()) {
      let {left, top, right, bottom} = line;
      for (let around = parent; around !== null; around = around.parentElement) {
        if (getComputedStyle(around).overflow === 'visible') continue;
        const clip = around.getBoundingClientRect();
        left = Math.max(left, clip.left), right = Math.min(right, clip.right);
        top = Math.max(top, clip.top), bottom = Math.min(bottom, clip.bottom);
      }
      if (left >= right || top >= bottom) continue;
      const seen = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
      if (seen !== null && (parent.contains(seen) || seen.contains(parent))) {
        boxes.push([number, node.data.trim(), left, top, right, bottom, parseFloat(getComputedStyle(parent).fontSize)]);
      }
    }
  }
  return boxes;
})()"""
# Of what scrolls across: how much more there is, the fades, and the right ends of its items.
ACROSS = """(() => {
  const e = document.getElementById('ID'), style = getComputedStyle(e);
  return {more: e.scrollWidth - e.clientWidth - e.scrollLeft, masks: /linear-gradient/.test(style.maskImage),
          before: parseFloat(e.style.getPropertyValue('--before')), after: parseFloat(e.style.getPropertyValue('--after')),
          right: e.getBoundingClientRect().right,
          items: [...e.children].filter((c) => c.checkVisibility()).map((c) => {
            const r = c.getBoundingClientRect();
            return [r.left, r.right];
          })};
})()"""


def overlap(a, b):
    """(width, height) of what two boxes share; not positive if that is nothing."""
    return (min(a["right"], b["right"]) - max(a["left"], b["left"]),
            min(a["bottom"], b["bottom"]) - max(a["top"], b["top"]))


class Screens(Page):
    def setUp(self):
        super().setUp()
        self.run_ = self.run_of("discs")

    def box(self, identifier):
        return self.evaluate(BOX.format(identifier))

    def open_on(self, size, words, run=None):
        """On a screen of that size, which fingers touch if it is small."""
        if (size in SMALL) != self.is_touched:
            self.is_touched = size in SMALL
            self.browser.touch(self.is_touched)
        self.browser.resize(*size)
        self.browser.open((run or self.run_).page, words)

    is_touched = False

    def check_inside(self, box, size, what):
        self.assertTrue(-0.5 <= box["left"] and box["right"] <= size[0] + 0.5 and -0.5 <= box["top"] and
                        box["bottom"] <= size[1] + 0.5, (what, box))

    def check_texts(self):
        """No text lies over another one, and each is large enough to be read."""
        boxes = self.evaluate(TEXTS)
        self.assertGreater(len(boxes), 3)
        for i, (node, text, left, top, right, bottom, font) in enumerate(boxes):
            self.assertGreaterEqual(font, LEAST_FONT, text)
            for another, other, l, t, r, b, _ in boxes[:i]:
                width = min(right, r) - max(left, l)
                height = min(bottom, b) - max(top, t)
                self.assertFalse(node != another and width > 2 and height > 4, f"'{text}' and '{other}'")

    def check_picture(self, size, least):
        """The picture has this share of the screen at least, and nothing lies over it."""
        picture = self.box("picture")
        self.check_inside(picture, size, "picture")
        self.assertGreater(picture["width"] * picture["height"] / (size[0] * size[1]), least)
        for other in self.evaluate(AROUND):
            width, height = overlap(picture, other)
            self.assertFalse(width > 0.5 and height > 0.5, (other["id"], "lies over the picture"))

    def edge(self):
        """In the middle of the list, as the address has it."""
        self.open_on((1280, 800), "#t=3")
        edges = self.evaluate("kinetri.edges()")
        return "-".join(map(str, edges[len(edges) // 2]))

    def on_each(self, sizes, words, check, key=None):
        """Checks the page on these screens, after a key. It is loaded on the first and resized for the others, since
        loading takes most of the time; test_the_hint loads it on each."""
        for size in sizes:
            with self.subTest(size=size, words=words, key=key):
                if size == sizes[0]:
                    self.open_on(size, "#t=3&" + words)
                    if key:
                        self.browser.key(key)
                else:
                    self.browser.resize(*size)
                    self.browser.settle()
                check(size)

    def test_views(self):
        """The picture is large; what opens beside it has room: the list two whole rows at least, each panel some lines;
        texts can be read; what a finger presses is large; what scrolls can be reached by keys."""
        for words, part, scrolls, least in (
                ("", None, None, 0), ("list=on", "events", "list", 88), ("point=12", "point", "point .panel-body", 110),
                (f"edge={self.edge()}", "certificate", "certificate-body", 110),
                ("color=area&legend=on", "legend", "legend", 60),
                ("color=area&legend=on&show=axes,scale,heat,arrows,trails", "legend", "legend", 60)):
            def check(size):
                self.assertEqual(self.evaluate(
                    "[document.documentElement.scrollWidth, document.documentElement.scrollHeight]"), list(size))
                self.check_picture(size, 0.2 if part == "legend" else 0.36 if size in LARGE else 0.22 if part else 0.45)
                self.check_texts()
                self.check_inside(self.box("button-play"), size, "play")
                rooms = [(scrolls, least)] if part else []
                if part:
                    self.check_inside(self.box(part), size, part)
                if size in LARGE:  # The list is there, too.
                    rooms.append(("list", 88))
                for scrolling, room in rooms:
                    self.assertGreaterEqual(
                        self.evaluate(f"document.querySelector('#{scrolling}').clientHeight"), room, scrolling)
                if size in SMALL:
                    self.check_targets()
                    self.assertEqual(self.evaluate(STUCK), [])

            for sizes in (SMALL, LARGE):
                self.on_each(sizes, words, check)

    def check_targets(self):
        for target in self.evaluate(TARGETS):
            if target["isLink"]:
                continue
            least = 40 if target["id"] == "color" else LEAST_TARGET
            self.assertGreaterEqual(round(target["height"]), least, target)
            self.assertGreaterEqual(round(target["width"]), LEAST_TARGET, target)

    def test_dialogs_have_room(self):
        for key, dialog in (("?", "help"), ("s", "export")):
            def check(size):
                box = self.box(dialog)
                self.check_inside(box, size, dialog)
                self.assertGreater(box["height"], 120)

            for sizes in (SMALL, LARGE):
                self.on_each(sizes, "", check, key)
        self.assertEqual(self.evaluate("document.getElementById('export-title').textContent"), "Export")

    def test_the_button_opens_the_list(self):
        for size in SMALL:
            with self.subTest(size=size):
                self.open_on(size, "")
                self.assertFalse(self.evaluate("document.getElementById('events').checkVisibility()"))
                self.browser.click_element("button-list")
                self.assertGreaterEqual(self.evaluate("document.getElementById('list').clientHeight"), 88)
                self.assertGreaterEqual(self.evaluate(
                    "[...document.querySelectorAll('.row:not([hidden])')].filter((e) => {"
                    " const r = e.getBoundingClientRect();"
                    " return document.elementFromPoint(r.x + 40, r.y + r.height / 2)?.closest('.row') === e; }).length"), 2)

    def check_seen(self, points):
        """The points, and the middle between them, are in the picture, and nothing lies over them."""
        places = self.evaluate(f"{points!r}.map((point) => kinetri.screen(...kinetri.positions()[point]))")
        middle = [sum(place[k] for place in places) / len(places) for k in (0, 1)]
        picture = self.box("picture")
        for x, y in (*places, middle):
            self.assertTrue(picture["left"] + 4 < x < picture["right"] - 4 and
                            picture["top"] + 4 < y < picture["bottom"] - 4, (points, x, y, picture))
            self.assertEqual(self.evaluate(f"document.elementFromPoint({x!r}, {y!r}).id"), "picture")

    def test_what_is_selected_is_seen(self):
        """As soon as it is tapped, and while the run goes on; also in a part of the picture that was zoomed."""
        for size in SMALL:
            with self.subTest(size=size):
                self.open_on(size, "#t=3")
                for point in range(0, 25, 3):
                    self.evaluate(f"void (location.hash = 't=3&point={point}')")
                    self.browser.settle()
                    self.check_seen([point])
                for a, b in self.evaluate("kinetri.edges()")[::7]:
                    self.evaluate(f"void (location.hash = 't=3&edge={a}-{b}')")
                    self.browser.settle()
                    self.check_seen([a, b])
                    self.go_to(5.5)
                    self.check_seen([a, b])
                for name, at in (("lowest", 1), ("rightmost", 0)):
                    self.open_on(size, "#t=3&hide=delaunay")
                    self.evaluate("kinetri.zoom(2.5)")
                    self.browser.settle()
                    picture = self.box("picture")
                    places = self.evaluate("kinetri.positions().map((place) => kinetri.screen(...place))")
                    inside = [point for point, (x, y) in enumerate(places) if picture["left"] + 30 < x < picture["right"] - 30 and
                              picture["top"] + 30 < y < picture["bottom"] - 30]  # else the slider is tapped
                    point = max(inside, key=lambda point: places[point][at])
                    self.browser.tap(*places[point])
                    self.assertEqual(self.evaluate("kinetri.point"), point, name)
                    self.assertTrue(self.evaluate("document.getElementById('point').checkVisibility()"))
                    self.check_seen([point])

    def test_what_scrolls_across_shows_it(self):
        """The last item that is seen fades out, and those beyond are reached."""
        for sizes, words, identifier in ((SMALL, "", "switches"), (PHONES[:1], "list=on", "kinds")):
            def scroll(left):
                self.evaluate(f"void (document.getElementById('{identifier}').scrollLeft = {left})")
                self.browser.settle()
                return self.evaluate(ACROSS.replace("ID", identifier))

            def check(size):
                at_first = scroll(0)
                self.assertGreater(at_first["more"], 20)
                self.assertTrue(at_first["masks"])
                self.assertEqual((at_first["before"], at_first["after"]), (0, min(32, at_first["more"])))
                fade = at_first["right"] - at_first["after"]
                self.assertTrue(any(left < at_first["right"] and right > fade for left, right in at_first["items"]))
                at_last = scroll(1e4)
                self.assertEqual((at_last["before"], at_last["after"]), (32, 0))
                self.assertLessEqual(at_last["items"][-1][1], at_last["right"])

            self.on_each(sizes, words, check)
        self.open_on((1280, 800), "#t=3")
        self.assertEqual(self.evaluate(ACROSS.replace("ID", "switches"))["after"], 0)

    def test_keys_scroll_the_legend(self):
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

    def test_the_hint(self):
        """It fits, says what a finger or a mouse does, lies over no point and no control, and goes when something is
        pressed."""
        for run in (self.run_, self.run_of("uniform")):
            for size in (*SMALL, *LARGE):
                with self.subTest(size=size):
                    self.open_on(size, "", run)
                    self.check_picture(size, 0.36 if size in LARGE else 0.45)
                    hint = self.box("hint")
                    self.check_inside(hint, size, "hint")
                    self.assertGreaterEqual(hint["height"], 20)
                    self.assertEqual(self.evaluate("document.getElementById('hint').textContent"),
                                     f"{'Tap' if size in SMALL else 'Click'} a point or an edge for details")
                    self.assertLessEqual(*self.evaluate("(({scrollWidth, clientWidth}) => [scrollWidth, clientWidth])"
                                                        "(document.getElementById('hint'))"))
                    for other in self.evaluate(AROUND):
                        width, height = overlap(hint, other)
                        self.assertFalse(width > 0 and height > 0, other)
                    for x, y in self.evaluate("kinetri.positions().map((place) => kinetri.screen(...place))"):
                        self.assertFalse(hint["left"] - 4 < x < hint["right"] + 4 and hint["top"] - 4 < y, (x, y, hint))
                    picture = self.box("picture")
                    (self.browser.tap if size in SMALL else self.browser.click)(picture["left"] + 10, picture["top"] + 10)
                    self.assertTrue(self.evaluate("document.getElementById('hint').hidden"))

    def test_the_hint_goes_by_itself(self):
        self.open_on((360, 740), "")
        self.assertFalse(self.evaluate("document.getElementById('hint').hidden"))
        deadline = time.monotonic() + 60
        while not self.evaluate("document.getElementById('hint').hidden"):
            self.assertLess(time.monotonic(), deadline, "the hint stays")
            time.sleep(0.2)

    def test_embedded(self):
        """The picture, and one bar with what plays it; nothing opens beside or over it."""
        for size in (*EMBEDDED, (1000, 700)):
            for words, least in (("", 0.82), ("#t=3&point=12&list=on" if size in EMBEDDED else "#t=3&list=on", 0.82),
                                 ("#t=3&legend=on", 0.6)):
                with self.subTest(size=size, words=words):
                    self.open_on(size, "?embed" + words)
                    self.check_picture(size, least)
                    self.assertEqual(self.evaluate(f"{TARGETS}.map(({{id}}) => id).sort()"), ["button-play", "scrub"])
                    for target in self.evaluate(TARGETS):
                        self.assertGreaterEqual(round(target["height"]), 40)
                        self.check_inside(target, size, target["id"])
                    self.check_inside(self.box("time"), size, "time")
                    self.assertFalse(self.evaluate("document.getElementById('hint').checkVisibility()"))
            self.assertEqual(self.evaluate("kinetri.time"), 3)
            self.assertFalse(self.evaluate("document.getElementById('title').checkVisibility()"))
            self.browser.click_element("button-play")
            deadline = time.monotonic() + 60
            while self.evaluate("kinetri.time") <= 3:
                self.assertLess(time.monotonic(), deadline, "it does not play")


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
