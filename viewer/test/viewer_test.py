#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the viewer page in Debian's chromium, without a window.

usage: viewer_test.py PROGRAM WORK_DIR TEST

TEST is the name of a run (runs.py): its page is opened from its file, played event by event, forward
and backward, and must show the edges of the program's own logs; or `interface`, `certificate`,
`small`, `damaged`. Exit code 77 where there is no chromium.
"""
import base64
import itertools
import json
import pathlib
import random
import sys
import time
import unittest

sys.dont_write_bytecode = True
import browser  # noqa: E402
import runs  # noqa: E402

PROGRAM = FOLDER = TEST = None
SKIPPED = 77
SWITCHES = 130  # pixels at the top of the picture that switches and buttons take
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


def cut(text, count):
    """The base64 text without its last bytes."""
    return base64.b64encode(base64.b64decode(text)[:-count]).decode()


class Page(unittest.TestCase):
    """A test with a browser, whose page must have had no problem at the end."""

    def setUp(self):
        self.maxDiff = 2000
        self.browser = browser.Browser(1000, 640, [("prefers-reduced-motion", "reduce")])
        self.addCleanup(self.browser.close)

    def tearDown(self):
        self.assertEqual(self.browser.problems, [])

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

    def look(self, skipped=0):
        """What is in the picture, but for the rows at the top, and for its edges: the round corners
        are not drawn alike each time."""
        left, top, right, bottom = self.picture_box()
        inside = (left + MARGIN, top + max(skipped, MARGIN), right - MARGIN, bottom - MARGIN)
        return browser.Picture(self.browser.screenshot(inside))


class Playing(Page):
    """Of each run."""

    def test_run(self):
        run = runs.Run(PROGRAM, FOLDER, TEST)
        self.open(run.page)
        is_thinned = TEST == "thinned"
        self.assertEqual(self.evaluate("!document.getElementById('note').hidden"), is_thinned)
        if is_thinned:
            self.check_thinned(run)
        else:
            self.check_steps(run)
            self.check_times(run)
        self.check_ends(run)
        if run.motions is not None:
            self.check_positions(run)
        self.check_picture()
        if TEST == "wave":
            self.check_wave()

    def check_steps(self, run):
        """Each instant of the log is a step, forward and backward, with the edges of the log."""
        instants = run.instants()
        self.assertGreater(len(instants), 8, "a run in which too little happens")
        expected = [(0.0, 0, run.initial)] + [(t[2], count, e) for t, count, e in instants]
        seen = self.evaluate(STEPS.replace("DIRECTION", "stepForward"))
        self.assertEqual([(t, n) for t, n, _, _ in seen], [(t, n) for t, n, _ in expected])
        for (_, number, found, triangles), (_, _, wanted) in zip(seen, expected):
            self.assertEqual(edges(found), wanted, f"forward, after {number} events")
            self.assertEqual(runs.check_combinatorics(wanted, triangles), "",
                             f"forward, after {number} events")
        forward = [triangles for _, _, _, triangles in seen]
        self.check_delaunay(run, forward)
        seen = self.evaluate(STEPS.replace("DIRECTION", "stepBackward"))
        self.assertEqual([n for _, n, _, _ in seen], [n for _, n, _ in reversed(expected)])
        for (_, number, found, _), (_, _, wanted) in zip(seen, reversed(expected)):
            self.assertEqual(edges(found), wanted, f"backward, after {number} events")
        self.assertEqual([triangles for _, _, _, triangles in seen], forward[::-1], "backward")

    def check_delaunay(self, run, triangles):
        """Of points that never turn: some triangulations are exactly Delaunay between the instants."""
        if run.motions is None or any(event.points != [None, None] for event in run.events):
            return
        before = [0.0] + [instant[0][2] for instant in run.instants()]
        after = [instant[0][1] for instant in run.instants()]
        steps = [i for i in range(len(after)) if before[i] < after[i]]
        for i in steps[::max(len(steps) // 12, 1)]:
            when = (runs.fractions.Fraction(before[i]) + runs.fractions.Fraction(after[i])) / 2
            self.assertTrue(runs.is_delaunay(run, triangles[i], when), f"at {float(when)!r}")

    def check_times(self, run):
        """goTo a time executes exactly the events that are not after it."""
        numbers = random.Random(1)
        instants = run.instants()
        times = [numbers.uniform(0, run.until) for _ in range(60)]
        times += [t for instant in numbers.sample(instants, min(20, len(instants)))
                  for t in instant[0][1:]]
        numbers.shuffle(times)
        for when in times:
            done = [instant for instant in instants if instant[0][2] <= when]
            expected = done[-1][2] if done else run.initial
            found = self.evaluate(f"kinetri.goTo({when!r}), [kinetri.time, kinetri.event, "
                                  "kinetri.edges()]")
            self.assertEqual(found[:2], [when, done[-1][1] if done else 0])
            self.assertEqual(edges(found[2]), expected, f"at {when!r}")

    def check_thinned(self, run):
        """The instants that are left show the edges that the whole log has at their times."""
        recording = runs.recording_of(run.page)
        self.assertEqual(recording["thinned"], {"events": len(run.events)})
        note = self.evaluate("document.getElementById('note').textContent")
        shown = self.evaluate("kinetri.counts.instants")
        self.assertIn(f"{len(run.events):,} events", note)
        self.assertIn(f"{shown:,} instants", note)
        # A note about the address does not take its place.
        self.evaluate("void (location.hash = 'speed=1')")
        self.browser.settle()
        both = self.evaluate("['note', 'address-note'].map((id) => document.getElementById(id))"
                             ".map((e) => e.checkVisibility() && e.textContent)")
        self.assertEqual(both[0], note)
        self.assertIn("'speed' is unknown", both[1])
        count = self.evaluate("kinetri.counts.rows")
        self.assertLess(count, len(run.events))
        instants = run.instants()
        numbers = random.Random(2)
        for when in [numbers.uniform(0, run.until) for _ in range(40)]:
            found = self.evaluate(f"kinetri.goTo({when!r}), kinetri.stepForward(), "
                                  "[kinetri.time, kinetri.edges(), kinetri.triangles()]")
            expected = [e for t, _, e in instants if t[2] <= found[0]][-1]
            self.assertEqual(edges(found[1]), expected, f"at {found[0]!r}")
            self.assertEqual(runs.check_combinatorics(expected, found[2]), "", f"at {found[0]!r}")

    def check_ends(self, run):
        self.browser.key("End")
        self.assertEqual(edges(self.evaluate("kinetri.edges()")), run.last)
        self.assertEqual(self.evaluate("kinetri.time"), run.until)
        self.browser.key("Home")
        self.assertEqual(edges(self.evaluate("kinetri.edges()")), run.initial)
        self.assertEqual(self.evaluate("[kinetri.time, kinetri.event]"), [0, 0])

    def check_positions(self, run):
        """Points that nothing turned are where they are by exact arithmetic, but for rounding; all
        that turned are in the box. Points that vanished are not there."""
        turned, gone = set(), set()
        for event in run.events:
            touched = {point for point in event.points if point is not None}
            (gone if event.kind == "erase" or "remove" in runs.RUNS[TEST][2] else turned).update(touched)
        box = runs.recording_of(run.page)["box"]
        for when in (0.0, run.until / 3, run.until / 2, float(run.until)):
            self.go_to(when)
            found = self.evaluate("kinetri.positions()")
            self.assertEqual(len(found), len(run.motions))
            for point, place in enumerate(found):
                if point in gone:
                    if when == run.until:
                        self.assertIsNone(place, f"point {point} is gone")
                elif point not in turned:
                    exact, bound = run.exact_position(point, when)
                    for k in (0, 1):
                        error = abs(runs.fractions.Fraction(place[k]) - exact[k])
                        self.assertLessEqual(error, bound[k], f"point {point} at {when}")
            if box is not None:
                self.check_inside(box, found)

    def check_inside(self, box, places):
        """What is exactly inside is so as it is shown, but for the evaluation: some ten operations
        with numbers that are no larger than 10000."""
        slack = 10 * 10000 * float(runs.HALF_ULP)
        for x, y in places:
            self.assertTrue(box[0] - slack <= x <= box[2] + slack, x)
            self.assertTrue(box[1] - slack <= y <= box[3] + slack, y)

    def check_picture(self):
        self.go_to(0.0)
        self.evaluate("kinetri.stepForward()")
        self.browser.settle()
        first = self.look(SWITCHES)
        counts = first.counts()
        self.assertGreater(len(counts), 12, "hardly any colours in the picture")
        drawn = sum(counts.values()) - max(counts.values())
        self.assertGreater(drawn, 2000, "hardly anything is drawn")
        self.browser.key("End")
        self.assertNotEqual(self.look(SWITCHES), first, "the end looks like the start")

    def check_wave(self):
        """It begins tilted, can be turned, and laid flat and back."""
        self.browser.resize(1400, 700)  # so that all switches are in one row
        self.browser.settle()
        wave = self.look(SWITCHES)
        for dx, dy in ((60, 0), (0, 40)):
            self.drag(dx, dy)
            self.assertNotEqual(self.look(SWITCHES), wave, "it does not turn")
            self.browser.key("f")
            self.assertEqual(self.look(SWITCHES), wave)
        self.browser.key("w")
        self.assertNotEqual(self.look(SWITCHES), wave, "it is not laid flat")
        self.browser.key("w")
        self.assertEqual(self.look(SWITCHES), wave)


class Interface(Page):
    """Of one page: switches, keys, light and dark, narrow."""

    def setUp(self):
        super().setUp()
        self.run_ = runs.Run(PROGRAM, FOLDER, "discs")
        self.open(self.run_.page)
        self.go_to(3.0)

    def test_each_switch_changes_the_picture_and_back(self):
        left, top, right, bottom = self.picture_box()
        for key, identifier in (("d", "delaunay"), ("h", "hull"), ("v", "voronoi"), ("o", "discs"),
                                ("c", "circle"), ("t", "trails"), ("i", "ids")):
            with self.subTest(switch=identifier):
                # The pointer stays, since it has a circumcircle of its own.
                middle = ((left + right) / 2, (top + bottom) / 2)
                self.browser.move(*middle)
                pressed = f"document.getElementById('switch-{identifier}').ariaPressed"
                was = self.evaluate(pressed)
                # The button itself looks other when it is on: look below it.
                before = self.look(SWITCHES)
                self.browser.key(key)
                self.assertNotEqual(self.evaluate(pressed), was)
                self.assertNotEqual(self.look(SWITCHES), before)
                self.browser.click_element(f"switch-{identifier}")
                self.browser.move(*middle)
                self.assertEqual(self.evaluate(pressed), was)
                self.assertEqual(self.look(SWITCHES), before)

    def test_voronoi_diagram_is_drawn(self):
        self.browser.key("v")
        self.assertGreater(self.look(SWITCHES).counts().get(bytes.fromhex("009e73"), 0), 500)

    def test_keys(self):
        state = "[kinetri.time, kinetri.event]"
        instants = self.run_.instants()
        at = [i for i, instant in enumerate(instants) if instant[0][2] <= 3.0][-1]
        self.browser.key("ArrowRight")
        self.assertEqual(self.evaluate(state), [instants[at + 1][0][2], instants[at + 1][1]])
        self.browser.key("ArrowLeft")
        self.assertEqual(self.evaluate(state), [instants[at][0][2], instants[at][1]])
        self.play(" ", 1)
        self.play("b", -1)
        scale = "kinetri.screen(1, 0)[0] - kinetri.screen(0, 0)[0]"
        was = self.evaluate(scale)
        self.browser.key("+")
        larger = self.evaluate(scale)
        self.assertGreater(larger, was)
        self.browser.key("-")
        self.browser.key("-")
        self.assertLess(self.evaluate(scale), was)
        self.browser.key("f")
        self.assertEqual(self.evaluate(scale), was)
        speed = "parseFloat(document.getElementById('speed').textContent)"
        slow = self.evaluate(speed)
        self.browser.key("ArrowUp")
        self.assertGreater(self.evaluate(speed), slow)
        self.browser.key("ArrowDown")
        self.assertEqual(self.evaluate(speed), slow)
        self.browser.key("?")
        self.assertTrue(self.evaluate("document.getElementById('help').open"))
        self.browser.key("Escape")
        self.assertFalse(self.evaluate("document.getElementById('help').open"))

    def play(self, key, direction):
        before = self.evaluate("kinetri.time")
        self.browser.key(key, code="Space" if key == " " else None)
        deadline = time.monotonic() + browser.SECONDS
        while (self.evaluate("kinetri.time") - before) * direction <= 0:
            self.assertLess(time.monotonic(), deadline, f"'{key}' does not play")
        self.browser.key(key)
        self.assertTrue((self.evaluate("kinetri.time") - before) * direction > 0)
        now = self.evaluate("kinetri.time")
        self.browser.settle()
        self.assertEqual(self.evaluate("kinetri.time"), now, f"'{key}' does not pause")
        self.assertEqual(edges(self.evaluate("kinetri.edges()")),
                         [e for t, _, e in self.run_.instants() if t[2] <= now][-1])

    def test_wheel_and_drag(self):
        left, top, right, bottom = self.picture_box()
        x, y = (left + right) // 2, (top + bottom) // 2
        place = "kinetri.screen(0, 0)"
        before = self.evaluate(place)
        self.drag(80, 40)
        after = self.evaluate(place)
        self.assertAlmostEqual(after[0] - before[0], 80, 6)
        self.assertAlmostEqual(after[1] - before[1], 40, 6)
        scale = "kinetri.screen(1, 0)[0] - kinetri.screen(0, 0)[0]"
        was = self.evaluate(scale)
        self.browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=-120)
        deadline = time.monotonic() + browser.SECONDS
        while self.evaluate(scale) <= was:
            self.assertLess(time.monotonic(), deadline, "the wheel does not zoom")

    def test_pinch(self):
        left, top, right, bottom = self.picture_box()
        x, y = (left + right) / 2, (top + bottom) / 2
        fingers = lambda apart: [{"x": x - apart, "y": y, "id": 1}, {"x": x + apart, "y": y, "id": 2}]
        scale = "kinetri.screen(1, 0)[0] - kinetri.screen(0, 0)[0]"
        was = self.evaluate(scale)
        self.browser.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
        touch = lambda kind, points: self.browser.call("Input.dispatchTouchEvent", type=kind,
                                                       touchPoints=points)
        touch("touchStart", fingers(50))
        for apart in range(55, 101, 5):
            touch("touchMove", fingers(apart))
        touch("touchEnd", [])
        self.browser.settle()
        # Twice as far apart, but for the first pixels, in which it might be a click.
        self.assertGreater(self.evaluate(scale), 1.5 * was)
        self.assertLess(self.evaluate(scale), 2.1 * was)

    def test_scrub_bar_and_list(self):
        self.evaluate("(() => { const bar = document.getElementById('scrub'); bar.value = 0.5;"
                      " bar.dispatchEvent(new Event('input')); })()")
        self.browser.settle()
        self.assertEqual(self.evaluate("kinetri.time"), self.run_.until / 2)
        here = self.evaluate("kinetri.event")
        row = self.evaluate("document.querySelector('.row.future:not([hidden])').dataset.row")
        self.assertEqual(int(row), here)
        self.evaluate("document.querySelector('.row.future:not([hidden])').click()")
        self.browser.settle()
        instant = next(instant for instant in self.run_.instants() if instant[1] > here)
        self.assertEqual(self.evaluate("[kinetri.time, kinetri.event]"), [instant[0][2], instant[1]])
        self.assertEqual(self.evaluate("document.querySelectorAll('.row.present:not([hidden])').length > 0"), True)

    def test_hover_says_where_a_point_is(self):
        place = self.evaluate("kinetri.positions()")[7]
        self.browser.move(*self.evaluate(f"kinetri.screen({place[0]!r}, {place[1]!r})"))
        text = self.evaluate("document.getElementById('tip').textContent")
        self.assertFalse(self.evaluate("document.getElementById('tip').hidden"))
        self.assertIn("Point 7", text)
        numbers = text.replace("\u2212", "-").split("position")[1].split("(")[1].split(")")[0].split(",")
        for found, wanted in zip(numbers, place):
            self.assertEqual(float(found), float(f"{wanted:.7g}"))

    def test_dark_and_light(self):
        light = self.look(SWITCHES)
        self.browser.media(("prefers-color-scheme", "dark"), ("prefers-reduced-motion", "reduce"))
        self.browser.settle()
        dark = self.look(SWITCHES)
        self.assertLess(max(dark.most_frequent()), 80)
        self.assertGreater(min(light.most_frequent()), 200)
        self.browser.click_element("button-theme")
        self.browser.move(5, 5)
        self.assertEqual(self.look(SWITCHES), light)

    def test_address(self):
        """A fragment of the address does what clicks and keys do, and reports what is not possible."""
        note = "document.getElementById('address-note')"

        def follow(fragment):
            self.evaluate(f"void (location.hash = '{fragment}')")
            self.browser.settle()
            return self.evaluate(f"{note}.hidden ? '' : {note}.textContent")

        self.browser.move(5, 5)
        start = self.look(SWITCHES)
        a, b = self.evaluate("kinetri.edges()")[7]
        self.assertEqual(follow(f"t=3&show=voronoi,trails&hide=hull&edge={b}-{a}&theme=dark"), "")
        self.assertEqual(self.evaluate("kinetri.time"), 3)
        switch = "document.getElementById('switch-%s').ariaPressed"
        self.assertEqual([self.evaluate(switch % name) for name in ("voronoi", "trails", "hull")],
                         ["true", "true", "false"])
        self.assertEqual(self.evaluate("document.getElementById('certificate-title').textContent"),
                         f"Edge {a}\u2013{b}")
        self.assertLess(max(self.look(SWITCHES).most_frequent()), 80)
        self.browser.click_element("button-close")
        self.assertEqual(follow("show=hull&hide=voronoi,trails&theme=light"), "")
        self.browser.move(5, 5)
        self.assertEqual(self.look(SWITCHES), start)
        for state in ("off", "on"):
            self.assertEqual(follow(f"list={state}"), "")
            self.assertEqual(self.evaluate("document.getElementById('events').hidden"),
                             state == "off")
        for number in (5, 0, len(self.run_.events)):
            self.assertEqual(follow(f"event={number}"), "")
            self.assertGreaterEqual(self.evaluate("kinetri.event"), number)
        count = self.evaluate("kinetri.counts.rows")
        switches = "of delaunay, hull, voronoi, circle, discs, trails, ids"
        edge = "the ids of two points that an edge joins at that time, as in 4-17"
        problems = {
            "t=x": "t: 'x' is not possible; expected a number",
            "t=": "t: '' is not possible; expected a number",
            "event=1000000":
                f"event: '1000000' is not possible; expected a whole number from 0 to {count}",
            "event=-1": f"event: '-1' is not possible; expected a whole number from 0 to {count}",
            "show=wave": f"show: 'wave' is not possible; expected {switches}",
            "hide=wave": f"hide: 'wave' is not possible; expected {switches}",
            "edge=0-0": f"edge: '0-0' is not possible; expected {edge}",
            "edge=x": f"edge: 'x' is not possible; expected {edge}",
            "theme=blue&list=maybe": "theme: 'blue' is not possible; expected light or dark, and "
                                     "list: 'maybe' is not possible; expected on or off",
            "speed=1": "'speed' is unknown; expected t, event, show, hide, edge, theme, list"}
        for wrong, problem in problems.items():
            self.assertEqual(follow(wrong),
                             "The address of this page asks for something that is not possible: "
                             f"{problem}.")
        self.assertEqual(follow("t=1"), "")

    def test_address_of_a_page_that_is_opened(self):
        self.browser.open(self.run_.page, "#t=2.25&show=trails")
        self.assertEqual(self.evaluate("kinetri.time"), 2.25)
        self.assertEqual(self.evaluate("document.getElementById('switch-trails').ariaPressed"), "true")

    def test_narrow_screens_have_room_for_everything(self):
        self.browser.resize(360, 640, 2)
        self.browser.settle()
        self.assertEqual(self.evaluate("[document.documentElement.scrollWidth, "
                                       "document.documentElement.scrollHeight]"), [360, 640])
        for button in ("play", "next", "previous", "faster", "help", "list", "fit"):
            box = self.evaluate(f"document.getElementById('button-{button}').getBoundingClientRect()"
                                ".toJSON()")
            self.assertTrue(0 <= box["left"] and box["right"] <= 360 and 0 <= box["top"] and
                            box["bottom"] <= 640, (button, box))
        self.assertGreater(self.evaluate("document.getElementById('picture').clientHeight"), 200)

    def test_controls_have_names(self):
        self.assertEqual(self.evaluate(
            "[...document.querySelectorAll('button, input, canvas:not([aria-hidden])')]"
            ".filter((e) => !e.hidden && !(e.ariaLabel || e.textContent.trim())"
            " && e.id !== 'plot').map((e) => e.outerHTML)"), [])


class Certificate(Page):
    """Clicks on edges that a flip, a hull event, or nothing removes."""

    def setUp(self):
        super().setUp()
        self.open_run("uniform")

    def open_run(self, name):
        self.run_ = runs.Run(PROGRAM, FOLDER, name)
        self.open(self.run_.page)

    def place_of(self, edge):
        places = self.evaluate("kinetri.positions().map((p) => kinetri.screen(...p))")
        (ax, ay), (bx, by) = places[edge[0]], places[edge[1]]
        return (ax + bx) / 2, (ay + by) / 2, places

    def is_clear(self, edge):
        """Whether the middle of the edge is nearer than all others to a click there."""
        x, y, places = self.place_of(edge)
        for other in self.evaluate("kinetri.edges()"):
            if tuple(other) == edge:
                continue
            (ax, ay), (bx, by) = places[other[0]], places[other[1]]
            length = max((bx - ax) ** 2 + (by - ay) ** 2, 1e-9)
            share = min(max(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length, 0), 1)
            if (ax + share * (bx - ax) - x) ** 2 + (ay + share * (by - ay) - y) ** 2 < 5 ** 2:
                return False
        return True

    def removals(self, kind):
        """Events of the kind with an edge that is removed and can be clicked some time before, and
        is in the end removed because that certificate fails; the page is there."""
        for i, event in enumerate(self.run_.events):
            if event.kind != kind:
                continue
            before = self.run_.events[i - 1].time[2] if i > 0 else 0.0
            for when in (before, event.time[0] - 0.2, event.time[0] - 0.6):
                self.go_to(max(when, 0.0))
                there = edges(self.evaluate("kinetri.edges()"))
                if event.removed in there and self.is_clear(event.removed):
                    self.click(event.removed)
                    if self.evaluate("document.getElementById('interval') !== null"):
                        yield event
                        break

    def click(self, edge):
        x, y, _ = self.place_of(edge)
        self.browser.click(x, y)
        self.assertFalse(self.evaluate("document.getElementById('certificate').hidden"))
        title = self.evaluate("document.getElementById('certificate-title').textContent")
        self.assertEqual(title, f"Edge {edge[0]}\u2013{edge[1]}")

    def check_removal(self, kind, degree, least):
        checked = 0
        for event in self.removals(kind):
            text = self.evaluate("document.getElementById('certificate-facts').innerText")
            interval = self.evaluate("document.getElementById('interval').textContent")
            found = [float(number) for number in interval.strip("[]").split(",")]
            self.assertEqual(found, sorted(set(event.time[1:])))
            self.assertIn(f"{kind.replace('_', ' ')} #{event.number}", text)
            self.assertIn("the certificate is zero there" if len(found) == 1 else
                          "positive at the lower one, negative at the upper one", text)
            self.assertLessEqual(int(text.split("Degree\n")[1].split()[0]), degree)
            checked += 1
            if checked == least:
                break
        self.assertGreaterEqual(checked, least, "too few edges that can be clicked")

    def test_flips(self):
        self.check_removal("flip", 4, 8)

    def test_coefficients(self):
        for name in ("uniform", "accelerated", "square"):
            self.open_run(name)
            for event in itertools.islice(self.removals("flip"), 4):
                says = self.evaluate("document.getElementById('certificate-says').textContent")
                corners = [int(id) for id in says.split("in-circle(")[1].split(")")[0].split(",")]
                self.assertEqual(set(corners[:2]), set(event.removed))
                self.assertEqual(set(corners[2:]), set(event.added))
                digits = self.evaluate("[...document.querySelectorAll('#certificate-facts .digits')]"
                                       ".slice(-2).map((e) => e.textContent)")
                found = [float(line.split()[1]) for line in digits[1].splitlines()]
                self.assertEqual(found,
                                 runs.delaunay_coefficients(self.run_, corners, float(digits[0])))

    def test_hull_edges(self):
        self.open_run("box")
        self.check_removal("hull_insert", 2, 3)

    def test_accelerated_points(self):
        self.open_run("accelerated")
        self.check_removal("flip", 12, 6)

    def test_times_that_are_numbers(self):
        self.open_run("square")
        self.assertEqual([event.time for event in self.run_.events], [(1.0, 1.0, 1.0)])
        self.check_removal("flip", 2, 1)

    def test_corners_that_change(self):
        """Of an edge that is removed after its corners have changed, the first change is named."""
        for i, event in enumerate(self.run_.events):
            self.go_to(max(event.time[0] - 1, 0.0))
            there = edges(self.evaluate("kinetri.edges()"))
            if event.kind != "flip" or event.removed not in there or not self.is_clear(event.removed):
                continue
            self.click(event.removed)
            text = self.evaluate("document.getElementById('certificate-facts').innerText")
            if "its corners change before it fails" not in text:
                continue
            change = text.split("before it fails, ")[1].split()
            number = int(next(word for word in change if word.startswith("#"))[1:])
            self.assertLess(number, event.number)
            self.assertIn(f"later, by flip #{event.number}", text)
            ends = set(event.removed)
            changed = self.run_.events[number]
            self.assertTrue(ends & set((changed.removed or ()) + (changed.added or ())))
            self.go_to(changed.time[2])  # to the next certificate
            text = self.evaluate("document.getElementById('certificate-facts').innerText")
            self.assertIn(f"its corners changed with {changed.kind.replace('_', ' ')} #{number}", text)
            return
        self.fail("no such edge")

    def test_it_follows_time_and_closes(self):
        event = next(self.removals("flip"))
        sign = "document.querySelector('#certificate-facts dd').textContent"
        self.assertTrue(self.evaluate(sign).startswith("positive"))
        self.go_to(event.time[2])
        self.assertTrue(self.evaluate(sign).startswith("negative"), self.evaluate(sign))
        self.assertIn("not there", self.evaluate("document.getElementById('certificate-says').textContent"))
        self.browser.key("Escape")
        self.assertTrue(self.evaluate("document.getElementById('certificate').hidden"))

    def test_the_plot_is_drawn(self):
        next(self.removals("flip"))  # clicks its edge
        box = self.evaluate("document.getElementById('plot').getBoundingClientRect().toJSON()")
        area = tuple(round(box[side]) for side in ("left", "top", "right", "bottom"))
        counts = browser.Picture(self.browser.screenshot(area)).counts()
        curve = bytes.fromhex("0072b2")
        self.assertGreater(counts.get(curve, 0), 100)


class Small(Page):
    """Recordings in which there is little, or nothing."""

    def check(self, name, points, until, count, *options):
        file = FOLDER / f"{name}.csv"
        FOLDER.mkdir(parents=True, exist_ok=True)
        file.write_text("x,y,vx,vy\n" + points)
        page = file.with_suffix(".html")
        runs.execute(PROGRAM, "simulate", file, "--until", until, "--html", page, "--quiet", *options)
        self.open(page)
        self.assertEqual(self.evaluate("kinetri.counts.points"), count)
        for key in "vctdhiofn":
            self.browser.key(key)
        self.assertTrue(self.evaluate("kinetri.screen(0, 0).every(Number.isFinite)"))
        left, top, right, bottom = self.picture_box()
        self.browser.click((left + right) / 2, (top + bottom) / 2)
        self.browser.key("End")
        self.browser.key("ArrowLeft")
        self.browser.key("Home")
        self.browser.key(" ")
        self.browser.settle()
        return self.evaluate("kinetri.edges()")

    def test_no_point(self):
        self.assertEqual(self.check("none", "", 1, 0), [])

    def test_one_point(self):
        self.assertEqual(self.check("one", "3,4,1,0\n", 1, 1), [])

    def test_two_points(self):
        self.assertEqual(self.check("two", "3,4,1,0\n5,6,0,1\n", 1, 2), [[0, 1]])

    def test_points_on_a_line(self):
        found = self.check("line", "0,0,1,1\n2,2,0,0\n4,4,-1,-1\n7,7,0,0\n", 1, 4)
        self.assertEqual(len(found), 3)

    def test_no_event(self):
        found = self.check("rest", "0,0,0,0\n4,0,0,0\n0,3,0,0\n9,9,0,0\n", 1, 4)
        self.assertEqual(len(found), 5)

    def test_no_time(self):
        self.assertEqual(len(self.check("instant", "0,0,1,0\n4,0,0,0\n0,3,0,1\n", 0, 3)), 3)

    def test_points_on_a_line_have_no_triangles(self):
        self.check("line", "0,0,1,1\n2,2,0,0\n4,4,-1,-1\n7,7,0,0\n", 1, 4)
        self.assertEqual(self.evaluate("kinetri.triangles()"), [])

    def test_triangles_that_change_without_an_event(self):
        """Points pass each other on the hull: no edge changes, but triangles do, at exactly t = 1."""
        run = runs.Run(PROGRAM, FOLDER, "passing")
        self.assertEqual(run.events, [])
        self.open(run.page)
        seen = self.evaluate(STEPS.replace("DIRECTION", "stepForward"))
        self.assertEqual([(t, n) for t, n, _, _ in seen], [(0, 0), (1, 1)])
        for (_, _, found, triangles), when in zip(seen, (0.5, 1.5)):
            self.assertEqual(edges(found), run.initial)
            self.assertEqual(runs.check_combinatorics(run.initial, triangles), "")
            self.assertTrue(runs.is_delaunay(run, triangles, when))
        self.assertNotEqual(seen[0][3], seen[1][3])
        self.assertEqual(self.evaluate("document.getElementById('row-0').innerText").split("\n"),
                         ["\u21bb", "rebuild", "triangles change, edges do not", "1", "row 0"])
        self.go_to(0.5)
        self.assertEqual(self.evaluate("kinetri.triangles()"), seen[0][3])
        # The triangle above the edge 0-1 is 0 1 2 until then, 0 1 3 afterwards.
        self.browser.open(run.page, "#t=0.5&edge=0-1")
        facts = "document.getElementById('certificate-facts').innerText"
        self.assertIn("its corners change before it fails, rebuild row 0", self.evaluate(facts))
        self.go_to(1.5)
        self.assertIn("its corners changed with rebuild row 0", self.evaluate(facts))

    def test_large_numbers(self):
        points = "-1e300,0,1,0\n1e300,0,0,0\n0,1e300,0,1\n0,-1e-300,0,0\n"
        self.assertEqual(len(self.check("large", points, 1, 4)), 5)


class Damaged(Page):
    """A damaged recording is named, and nothing else happens."""

    def setUp(self):
        super().setUp()
        self.page = runs.Run(PROGRAM, FOLDER, "uniform").page
        self.recording = runs.recording_of(self.page)

    def check(self, text, expected):
        target = FOLDER / "damaged.html"
        runs.with_recording(self.page, text, target)
        self.browser.open(target)
        self.assertTrue(self.evaluate("document.getElementById('viewer').hidden"))
        self.assertFalse(self.evaluate("document.getElementById('message').hidden"))
        message = self.evaluate("document.getElementById('message').innerText")
        self.assertIn("This recording is damaged", message)
        self.assertIn(expected, message)

    def damage(self, expected, **members):
        self.check(json.dumps({**self.recording, **members}), expected)

    def test_not_json(self):
        self.check("{", "not JSON")

    def test_cut_off(self):
        text = json.dumps(self.recording)
        self.check(text[:len(text) // 2], "not JSON")

    def test_other_format(self):
        self.damage("format is 1", format=1)

    def test_lists(self):
        events, motions = self.recording["events"], self.recording["motions"]
        self.damage("not base64", initial_edges="AAA*")
        self.damage("is not there", initial_edges=None)
        self.damage("events are not there", events=None)
        self.damage("times of them", events={**events, "time": cut(events["time"], 8)})
        self.damage("within a number", events={**events, "time": cut(events["time"], 1)})
        self.damage("the ids of event", events={**events, "ids": cut(events["ids"], 2)})
        self.damage("without a name", events={**events, "kinds": []})
        self.damage("places of them", motions={**motions, "data": cut(motions["data"], 40)})

    def test_wrong_edges(self):
        self.damage("the ids end with 3", points=4)
        there = self.recording["triangles"]["initial"]
        self.assertEqual(self.recording["initial_edges"], "", "an edge without a triangle")
        one_id, one_edge = (base64.b64encode(base64.b64decode(there)[:n]).decode() for n in (2, 4))
        self.damage("within an edge", initial_edges=one_id)
        self.damage("is twice", initial_edges=one_edge)
        self.damage("which is not there then", triangles={**self.recording["triangles"],
                                                          "initial": cut(there, 120)})

    def test_wrong_triangles(self):
        triangles = self.recording["triangles"]
        self.assertGreater(triangles["count"], 1)
        damage = lambda expected, **members: self.damage(expected, triangles={**triangles, **members})
        self.damage("triangles are not there", triangles=None)
        damage("within a triangle", initial=cut(triangles["initial"], 2))
        twice = base64.b64decode(triangles["initial"])
        twice = base64.b64encode(twice + twice[:6]).decode()
        damage("the start adds the triangle", initial=twice)
        damage("numbers of triangles of them", count=triangles["count"] + 1)
        damage("corners of", ids=cut(triangles["ids"], 6))
        ids = base64.b64decode(triangles["ids"])
        turned = base64.b64encode(ids[2:4] + ids[:2] + ids[4:]).decode()
        damage("triangle", ids=turned)
        rows = base64.b64decode(triangles["event"])
        damage("not in order", event=base64.b64encode(rows[4:8] + rows[:4] + rows[8:]).decode())
        last = (10 ** 6).to_bytes(4, "little")
        damage("triangle", event=base64.b64encode(rows[:-4] + last).decode())
        # Without the changes on the hull, a flip there does not fit.
        damage("not the other diagonal", count=0, event="", removed="", added="", ids="")

    def test_times(self):
        self.damage("not two numbers in order", until=-1)
        self.damage("not two numbers in order", until="soon")


def main():
    global PROGRAM, FOLDER, TEST
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    if browser.executable() is None:
        print("chromium is not installed; nothing tested (scripts/test.sh --browser installs it)")
        return SKIPPED
    PROGRAM, FOLDER, TEST = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]
    case = {"interface": Interface, "certificate": Certificate, "small": Small,
            "damaged": Damaged}.get(TEST, Playing)
    if case is Playing and TEST not in runs.RUNS:
        sys.exit(f"no such test: {TEST}")
    suite = unittest.defaultTestLoader.loadTestsFromTestCase(case)
    return 0 if unittest.TextTestRunner(verbosity=2).run(suite).wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
