# SPDX-License-Identifier: GPL-3.0-or-later
"""Each run is played event by event, forward and backward, and must show the edges of its logs."""
import math
import random

import runs
from page import STEPS, Page, edges
from points import cell_area


class Playing(Page):
    """With a test for each of RUNS."""

    def play(self, name):
        run = self.run_of(name)
        self.open(run.page)
        is_thinned = name == "thinned"
        self.assertEqual(self.evaluate("!document.getElementById('note').hidden"), is_thinned)
        if is_thinned:
            self.check_thinned(run)
        else:
            self.check_steps(run)
            self.check_times(run)
        self.check_ends(run)
        if run.motions is not None:
            self.check_positions(run, "remove" in runs.RUNS[name][2])
        self.check_picture()
        if name == "wave":
            self.check_wave()
        if name == "sizes":
            self.check_sizes(run)

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
        if run.motions is None or any(event.turns for event in run.events):
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

        self.check_thinned_areas(run)

    def check_thinned_areas(self, run):
        """Between two instants the panel has the area at the earlier one, and says so."""
        numbers = random.Random(3)
        area = "document.querySelector('#point-facts > dd:nth-of-type(4)').innerText"
        beside = 0
        for i in range(12):
            when = numbers.uniform(0.1 * run.until, 0.9 * run.until)
            self.evaluate(f"void (location.hash = 't={when!r}&point={i}&legend=on&show=voronoi')")
            self.browser.settle()
            text = self.evaluate(area)
            self.assertRegex(text, r"^[\d.]+ at t \u2248 [\d.]+, the last exact instant$")
            now = self.evaluate("kinetri.areas()")[i]
            beside += now is None or not math.isclose(now, float(text.split()[0]), rel_tol=1e-3)
            self.evaluate("void kinetri.stepBackward()")
            self.browser.settle()
            at, points = self.evaluate("[kinetri.time, kinetri.positions()]")
            self.assertAlmostEqual(at, float(text.split()[4].rstrip(",")), delta=1e-4)
            self.assertLess(at, when)
            wanted, _ = cell_area(points, i, (0, 0, 100, 100))
            self.assertTrue(math.isclose(float(text.split()[0]), wanted, rel_tol=1e-5), (text, wanted))
            self.assertEqual(self.evaluate(area), text.split()[0])
        self.assertGreater(beside, 6)
        self.assertIn("of the triangulation of the earlier one",
                      self.evaluate("document.getElementById('legend').innerText"))

    def check_ends(self, run):
        self.browser.key("End")
        self.assertEqual(edges(self.evaluate("kinetri.edges()")), run.last)
        self.assertEqual(self.evaluate("kinetri.time"), run.until)
        self.browser.key("Home")
        self.assertEqual(edges(self.evaluate("kinetri.edges()")), run.initial)
        self.assertEqual(self.evaluate("[kinetri.time, kinetri.event]"), [0, 0])

    def check_positions(self, run, contacts_remove):
        """Points that nothing turned are where they are by exact arithmetic, but for rounding; all
        that turned are in the box. Points that vanished are not there."""
        turned, gone = set(), set()
        for event in run.events:
            is_last = event.kind == "erase" or contacts_remove
            (gone if is_last else turned).update(event.turns)
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

    def check_sizes(self, run):
        """Discs are as large as they are, and points without an edge are hidden, which some are at
        some time; the picture shows both."""
        most_hidden = 0
        for when in [i * run.until / 8 for i in range(9)]:  # binary64 numbers with few digits
            self.go_to(when)
            found = self.evaluate("[kinetri.radii(), kinetri.hidden(), kinetri.edges()]")
            expected = [float(run.exact_radius(point, when)) for point in range(len(run.motions))]
            self.assertEqual(found[0], expected)
            vertices = {point for edge in found[2] for point in edge}
            self.assertEqual(found[1], sorted(set(range(len(run.motions))) - vertices))
            most_hidden = max(most_hidden, len(found[1]))
        self.assertGreater(most_hidden, 0)
        labels = self.evaluate("document.getElementById('switches').innerText")
        for label in ("Regular", "Power", "Power circle", "Discs"):
            self.assertIn(label, labels)
        before = self.look()
        for key in "vco":
            self.browser.key(key)
            after = self.look()
            if key != "c":  # which is of the triangle under the pointer
                self.assertNotEqual(after, before)
            before = after

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
        first = self.look()
        counts = first.counts()
        self.assertGreater(len(counts), 12, "hardly any colors in the picture")
        drawn = sum(counts.values()) - max(counts.values())
        self.assertGreater(drawn, 2000, "hardly anything is drawn")
        self.browser.key("End")
        self.assertNotEqual(self.look(), first, "the end looks like the start")

    def check_wave(self):
        """It begins tilted, can be turned, and laid flat and back."""
        self.browser.resize(1400, 700)  # so that all switches are in one row
        self.browser.settle()
        wave = self.look()
        for dx, dy in ((60, 0), (0, 40)):
            self.drag(dx, dy)
            self.assertNotEqual(self.look(), wave, "it does not turn")
            self.browser.key("f")
            self.assertEqual(self.look(), wave)
        self.browser.key("w")
        self.assertNotEqual(self.look(), wave, "it is not laid flat")
        self.browser.key("w")
        self.assertEqual(self.look(), wave)


# Of runs.RUNS, those that are played.
RUNS = ("uniform", "box", "discs", "vanishing", "accelerated", "sizes", "lattice", "tracks", "together", "wave",
        "thinned")
for run_name in RUNS:
    setattr(Playing, f"test_{run_name}", lambda self, name=run_name: self.play(name))
