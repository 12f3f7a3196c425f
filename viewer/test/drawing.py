# SPDX-License-Identifier: GPL-3.0-or-later
"""The painters, and what is drawn of many points."""
import fractions

import runs
from page import Page

LEAST_CHANGE = 0.004  # share of the pixels, where something else is shown
MOST_NOISE = 0.002    # share of the pixels in which two painters differ
# From now on `labels` has what is written on the picture.
WRITTEN = """void (() => {
  const write = window.write ??= CanvasRenderingContext2D.prototype.fillText;
  window.labels = [];
  CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
    const {width} = this.measureText(text);
    if (this.canvas.id === 'picture') {
      labels.push([text, x - width * {left: 0, center: 0.5, right: 1}[this.textAlign], y, width]);
    }
    return write.call(this, text, x, y);
  };
})()"""
HAS_WEBGL = "document.createElement('canvas').getContext('webgl2') !== null"
SCENE = "document.getElementById('scene').hidden"


class Drawing(Page):
    """WebGL, the 2D context, and the level of detail."""

    def open_with(self, page, fragment):
        self.browser.open(page, fragment)
        self.assertTrue(self.evaluate("document.getElementById('address-note').hidden"))
        return self.look()

    def need_webgl(self):
        """Chromium emulates WebGL; firefox has it where there is a graphics card."""
        if self.browser.needs_card and not self.evaluate(HAS_WEBGL):
            self.skipTest("there is no WebGL")

    def test_both_painters_show_the_same(self):
        self.need_webgl()
        for name, words in (("sizes", "t=2&show=voronoi,trails,discs&hide=ids"),
                            ("discs", "t=3&show=trails&hide=ids"), ("uniform", "t=4&event=20")):
            page = self.run_of(name).page
            with self.subTest(run=name):
                canvas = self.open_with(page, f"#{words}&draw=canvas")
                self.assertTrue(self.evaluate(SCENE))
                webgl = self.open_with(page, f"#{words}&draw=webgl")
                self.assertFalse(self.evaluate(SCENE))
                self.assertLess(canvas.difference(webgl), MOST_NOISE)
                for switch in ("delaunay", "voronoi" if name == "sizes" else "hull"):
                    without = self.open_with(page, f"#{words}&draw=webgl&hide={switch}")
                    self.assertGreater(without.difference(webgl, 24), LEAST_CHANGE, switch)

    def test_the_page_draws_on_when_webgl_is_lost(self):
        self.need_webgl()
        page = self.run_of("uniform").page
        before = self.open_with(page, "#t=4&draw=webgl")
        self.evaluate("void document.getElementById('scene').getContext('webgl2')"
                      ".getExtension('WEBGL_lose_context').loseContext()")
        self.browser.settle()
        self.assertTrue(self.evaluate(SCENE))
        self.evaluate("kinetri.goTo(4)")
        self.browser.settle()
        self.assertLess(before.difference(self.look()), MOST_NOISE)
        self.browser.problems = []  # chromium reports the loss

    def generate(self, points, until):
        """The page of points in a square."""
        self.folder.mkdir(parents=True, exist_ok=True)
        csv = self.folder / f"{points}.csv"
        page = csv.with_suffix(f".{until}.html")
        if page in Page.made:
            return page
        Page.made[page] = page
        runs.execute(self.program, "generate", "uniform", "--points", points, "--seed", 3, "--output", csv)
        runs.execute(self.program, "simulate", csv, "--until", until, "--html", page, "--quiet")
        return page

    def paper(self, picture):
        """The share of the pixels that are of the background."""
        counts = picture.counts()
        return max(counts.values()) / sum(counts.values())

    def lightness(self, picture):
        """The mean of all channels, from 0 to 255."""
        counts = picture.counts()
        return sum(sum(color) * count for color, count in counts.items()) / 3 / sum(counts.values())

    def test_many_points(self):
        """Dots and edges shrink: the picture is no black carpet. Zoomed in, edges are seen."""
        self.browser.resize(1500, 960)
        for points, until in ((1000, 1), (20000, 0.2), (100000, 0.02)):
            with self.subTest(points=points):
                page = self.generate(points, until)
                self.browser.open(page)
                self.assertEqual(self.evaluate("kinetri.counts.points"), points)
                first = self.look()
                counts = first.counts()
                dark = sum(count for color, count in counts.items() if max(color) < 160) / sum(counts.values())
                self.assertLess(dark, 0.25)
                self.assertGreater(dark if points <= 20000 else 1 - self.paper(first), 0.01)  # the dots
                self.browser.key("d")
                has_edges = first.difference(self.look(), 8) > LEAST_CHANGE
                self.assertEqual(has_edges, points <= 20000)
                self.browser.key("d")
                for _ in range(9):
                    self.browser.key("+")
                near = self.look()
                self.browser.key("d")
                self.assertGreater(near.difference(self.look(), 24), LEAST_CHANGE)
                self.evaluate("kinetri.goTo(kinetri.span[1]); kinetri.pan(30, 0)")
                self.browser.settle()
                self.assertNotEqual(self.look(), near)

    def test_both_painters_show_as_much_of_small_dots(self):
        """Where a dot is about a pixel, and lines are drawn as images."""
        self.need_webgl()
        self.browser.resize(440, 560)
        page = self.generate(1000, 1)
        # All of it, and a part: then lines and dots are cut at the border.
        for view in ("", "&at=160,160,255"):
            with self.subTest(view=view):
                pictures = [self.open_with(page, f"#draw={way}{view}") for way in ("canvas", "webgl")]
                self.assertLess(pictures[0].difference(pictures[1]), MOST_NOISE)
                self.assertGreater(255 - self.lightness(pictures[0]), 15)
                self.assertAlmostEqual(self.lightness(pictures[0]), self.lightness(pictures[1]), delta=6)
                self.assertAlmostEqual(self.paper(pictures[0]), self.paper(pictures[1]), delta=0.1)

    def test_labels_do_not_overlap(self):
        """Each label stands on its own: where two overlapped, ids are left out."""
        self.browser.open(self.generate(1000, 1), "#show=ids")
        labels = self.labels()
        self.assertGreater(len(labels), 50)
        self.assertLess(len(labels), 1000)
        self.check_apart(labels)

    def labels(self):
        """What is written on the picture: text, left, bottom, width."""
        self.evaluate(WRITTEN)
        self.evaluate("kinetri.drawNow()")
        return self.evaluate("labels")

    def check_apart(self, labels):
        for i, (text, x, y, width) in enumerate(labels):
            for other, u, v, other_width in labels[:i]:
                apart = abs(y - v) >= 11 or x + width <= u or u + other_width <= x
                self.assertTrue(apart, f"{text} and {other}")

    def test_axes(self):
        """Each label stands where its number is, at a tick of round numbers, on any scale and any screen."""
        page = self.run_of("uniform").page
        for size in ((1000, 640), (360, 640)):
            self.browser.resize(*size)
            for at in ("30,30,90", "1e6,-2e5,3e5", "0.001,-0.002,0.0007", "523.25,77.5,1e-4", "0,0,1e-20", "-3,1e9,8e21"):
                with self.subTest(size=size, at=at):
                    self.browser.open(page, f"#show=axes&hide=ids&unit=km&at={at}")
                    left, top, right, bottom = self.picture_box()
                    labels = self.labels()
                    self.check_apart(labels)
                    self.assertIn("km", [text for text, *_ in labels])
                    axes = {"x": [], "y": []}
                    for text, x, y, width in labels:
                        self.assertTrue(x >= 0 and x + width <= right - left and y - 9 >= 0 and y <= bottom - top, text)
                        if text != "km":
                            axes["x" if y > bottom - top - 10 else "y"].append((text, x, y, width))
                    for axis, ticks in axes.items():
                        # Of numbers as long as that there is room for few on a phone.
                        self.assertGreaterEqual(len(ticks), 1 if at.startswith("523") and size[0] < 500 else 2)
                        numbers = [float(text.replace("\u2212", "-")) for text, *_ in ticks]
                        self.check_round(numbers)
                        for number, (text, x, y, width) in zip(numbers, ticks):
                            place = self.evaluate(f"kinetri.screen({number!r}, {number!r})")
                            if axis == "x":
                                self.assertAlmostEqual(place[0] - left, x + width / 2, delta=0.7, msg=text)
                            else:
                                self.assertAlmostEqual(place[1] - top, y - 4, delta=0.7, msg=text)

    def check_round(self, numbers):
        """The numbers are multiples of 1, 2 or 5 times a power of ten."""
        exact = [fractions.Fraction(repr(number)) for number in numbers]
        if len(exact) == 1:
            return
        step = exact[1] - exact[0]
        while step >= 10:
            step /= 10
        while step < 1:
            step *= 10
        self.assertIn(step, (1, 2, 5))
        self.assertEqual({b - a for a, b in zip(exact, exact[1:])}, {exact[1] - exact[0]})
        self.assertEqual(exact[0] % (exact[1] - exact[0]), 0)


class Without_webgl(Page):
    """A browser that has no WebGL."""

    without_webgl = True

    def test_the_canvas_is_used(self):
        self.open(self.run_of("uniform").page)
        self.assertTrue(self.evaluate(SCENE))
        self.assertGreater(len(self.look().counts()), 12)
        self.evaluate("void (location.hash = 'draw=webgl')")
        self.browser.settle()
        self.assertIn("draw: 'webgl' is not possible",
                      self.evaluate("document.getElementById('address-note').textContent"))
        self.assertGreater(len(self.look().counts()), 12)
