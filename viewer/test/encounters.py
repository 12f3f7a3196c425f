# SPDX-License-Identifier: GPL-3.0-or-later
"""Who is within range, and the components: the page beside exact distances."""
import fractions
import json
import math

import browser
import runs
from page import Page

TEXT = "document.getElementById('{}').innerText"


class Near(Page):
    """Of points of which some are at the range exactly, always or for one moment."""

    def setUp(self):
        super().setUp()
        self.run_ = self.run_of("near")
        self.open(self.run_.page)

    def in_range(self, time):
        """By the places at that time, in fractions."""
        t = fractions.Fraction(time)
        places = [tuple(fractions.Fraction(motion[axis]) + t * fractions.Fraction(motion["v" + axis]) for axis in "xy")
                  for motion in self.run_.motions]
        return [[a, b] for a, (x, y) in enumerate(places) for b, (u, v) in enumerate(places)
                if a < b and (x - u) ** 2 + (y - v) ** 2 <= runs.RANGE ** 2]

    def components(self, pairs):
        """The least id in the component of each point, by passing ids on until nothing changes."""
        least = list(range(len(self.run_.motions)))
        changes = True
        while changes:
            changes = False
            for a, b in pairs:
                if least[a] != least[b]:
                    least[a] = least[b] = min(least[a], least[b])
                    changes = True
        return least

    def test_at_all_times(self):
        """At the first and the last binary64 number of each encounter, and beside them; in an order in which
        the time goes forward, backward and far."""
        recorded = runs.recording_of(self.run_.page)["encounters"]
        self.assertEqual([recorded["range"], recorded["count"]], [runs.RANGE, recorded["in_all"]])
        ends = sorted({number for name in ("begin", "end") for number in runs.numbers(recorded[name])})
        self.assertGreater(len(ends), 40)
        self.assertTrue({4.0, 5.0, 7.0} <= set(ends))
        beside = {n for t in ends for n in (math.nextafter(t, -1), t, math.nextafter(t, 99))}
        times = sorted(t for t in beside if 0 <= t <= self.run_.until)
        order = times + times[::-7] + [times[i * 37 % len(times)] for i in range(len(times))]
        found = self.evaluate(f"{json.dumps(order)}.map((t) => "
                              "{ kinetri.goTo(t); return [kinetri.inRange(), kinetri.components()]; })")
        expected = {time: self.in_range(time) for time in times}
        for time, (pairs, components) in zip(order, found):
            self.assertEqual(pairs, expected[time], time)
            self.assertEqual(components, self.components(pairs), time)

    def test_links_are_drawn(self):
        self.go_to(7.5)
        shown = self.look()
        self.browser.key("y")
        self.assertGreater(shown.difference(self.look()), 0.0008)
        self.browser.key("y")
        self.assertEqual(shown, self.look())

    def test_links_of_a_crowd_do_not_fill_it(self):
        """What is between the links is seen, and the link of two that are alone is as strong as ever."""
        self.browser.open(self.run_of("crowd").page, "#t=0.5&hide=delaunay,hull,ids&theme=light&at=60,0,140")
        self.assertGreater(len(self.evaluate("kinetri.inRange()")), 25000)
        background, link = (0xfd, 0xfd, 0xfe), (0xa0, 0x40, 0x00)
        left, top = self.evaluate("kinetri.screen(5, 15)")
        right, bottom = self.evaluate("kinetri.screen(15, 5)")
        self.assertGreater(min(right - left, bottom - top), 30)
        crowd = self.seen(left, top, right, bottom).counts()
        # How far each pixel is on the way from the background to the color of links, by their blue.
        cover = sum(count * (background[2] - color[2]) / background[2] for color, count in crowd.items()) / sum(crowd.values())
        self.assertLess(cover, 0.6)
        self.assertGreater(cover, 0.1)
        (x0, y0), (x1, y1) = self.evaluate("[2, 3].map((point) => kinetri.screen(...kinetri.positions()[point]))")
        pair = self.seen((2 * x0 + x1) / 3, min(y0, y1) - 2, (x0 + 2 * x1) / 3, max(y0, y1) + 2).counts()
        self.assertTrue(any(max(abs(a - b) for a, b in zip(color, link)) < 48 for color in pair), pair)

    def seen(self, *box):
        return browser.Picture(self.browser, self.browser.screenshot(tuple(map(round, box))))

    def test_what_is_said(self):
        self.evaluate("void (location.hash = 't=7.5&point=0&legend=on&color=component&unit=m')")
        self.browser.settle()
        partners = [b if a == 0 else a for a, b in self.in_range(7.5) if 0 in (a, b)]
        self.assertIn(f"In range\n{len(partners)}: {' '.join(map(str, partners))}",
                      " ".join(self.evaluate(TEXT.format("point-facts")).split(" ")).replace(" \n", "\n"))
        legend = self.evaluate(TEXT.format("legend"))
        self.assertIn("in range: at most 3 m", legend)
        self.assertIn("points alone have no color", legend)
        shades = self.evaluate("kinetri.colored().shades")
        components = self.components(self.in_range(7.5))
        for a, b in self.in_range(7.5):
            self.assertEqual(shades[a], shades[b])
        self.assertGreater(len({shades[i] for i in range(len(shades)) if components.count(components[i]) > 1}), 2)
        self.evaluate("void (location.hash = 'color=members')")
        self.browser.settle()
        self.assertEqual(self.evaluate("kinetri.colored().least"), 1)

    def test_too_many_and_damaged(self):
        recording = runs.recording_of(self.run_.page)
        none = {"range": 3, "in_all": 500000, "count": 0, "ids": "", "begin": "", "end": ""}
        for encounters, viewer_is_there, where, text in (
                (none, True, "note", "The run had 500,000 encounters, too many for this page."),
                ({**recording["encounters"], "count": 5}, False, "message", "it has 5 encounters"),
                ({**recording["encounters"], "range": "3"}, False, "message", "encounters have no range")):
            target = self.folder / "other.html"
            runs.with_recording(self.run_.page, json.dumps({**recording, "encounters": encounters}), target)
            self.browser.open(target)
            self.assertEqual(self.evaluate("!document.getElementById('viewer').hidden"), viewer_is_there)
            self.assertIn(text, self.evaluate(TEXT.format(where)))
            self.assertIsNone(self.evaluate("document.getElementById('switch-links')"))
