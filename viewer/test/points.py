# SPDX-License-Identifier: GPL-3.0-or-later
"""Points that are selected, followed and searched; what they are colored by; filters of events."""
import math

import runs
from page import Page

LEAST_CHANGE = 0.0008  # share of the pixels


def clipped(polygon, normal, offset):
    """The part of a convex polygon in which normal * p <= offset."""
    value = lambda p: normal[0] * p[0] + normal[1] * p[1] - offset
    result = []
    for i, p in enumerate(polygon):
        q = polygon[(i + 1) % len(polygon)]
        if value(p) <= 0:
            result.append(p)
        if (value(p) <= 0) != (value(q) <= 0):
            share = value(p) / (value(p) - value(q))
            result.append(tuple(p[k] + share * (q[k] - p[k]) for k in (0, 1)))
    return result


def cell_area(points, i, box, weights=None):
    """By the bisectors with all other points; and whether the box cuts the cell."""
    x0, y0, x1, y1 = box
    weights = weights or [0] * len(points)
    cell = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    a = points[i]
    for j, b in enumerate(points):
        if j == i or not cell:
            continue
        normal = (2 * (b[0] - a[0]), 2 * (b[1] - a[1]))
        offset = b[0] ** 2 + b[1] ** 2 - weights[j] - a[0] ** 2 - a[1] ** 2 + weights[i]
        cell = clipped(cell, normal, offset)
    area = sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(cell, cell[1:] + cell[:1])) / 2
    return area, any(p[0] in (x0, x1) or p[1] in (y0, y1) for p in cell)


class Points(Page):
    def setUp(self):
        super().setUp()
        self.run_ = self.run_of("discs")
        self.open(self.run_.page)
        self.go_to(3.0)

    def text(self, identifier):
        return self.evaluate(f"document.getElementById('{identifier}').innerText")

    def place_of(self, point):
        x, y = self.evaluate("kinetri.positions()")[point]
        return self.evaluate(f"kinetri.screen({x!r}, {y!r})")

    def neighbors(self, point):
        return sorted(b if a == point else a for a, b in self.evaluate("kinetri.edges()") if point in (a, b))

    def test_a_click_selects_a_point(self):
        before = self.look()
        left, top, right, bottom = self.picture_box()
        free = [point for point in range(25) if left + 60 < self.place_of(point)[0] < right - 60 and
                top + 20 < self.place_of(point)[1] < bottom - 60]
        for point in free[::3]:
            self.browser.click(*self.place_of(point))
            self.assertEqual(self.evaluate("kinetri.point"), point)
            self.assertEqual(self.text("point-title"), f"Point {point}")
        facts = self.text("point-facts")
        found = facts.split("Neighbors\n")[1].split("\n")[0]
        self.assertEqual([int(word) for word in found.split(":")[1].split()], self.neighbors(point))
        self.assertTrue(self.evaluate("document.getElementById('certificate').hidden"))
        rows = [event for event in self.run_.events
                if point in (event.removed or ()) + (event.added or ()) + tuple(event.points)]
        done = sum(event.time[2] <= 3.0 for event in rows)
        self.assertIn(f"{len(rows)}, {done} so far", facts)
        self.browser.move(5, 5)
        self.assertGreater(before.difference(self.look()), LEAST_CHANGE)
        self.browser.key("Escape")
        self.assertIsNone(self.evaluate("kinetri.point"))
        self.assertEqual(self.look(), before)

    def test_neighbors_and_events_are_links(self):
        self.browser.click(*self.place_of(12))
        other = self.neighbors(12)[0]
        self.evaluate(f"document.querySelector('#point-facts [data-point=\"{other}\"]').click()")
        self.browser.settle()
        self.assertEqual(self.evaluate("kinetri.point"), other)
        row = int(self.evaluate("document.querySelector('#point-facts [data-row]').dataset.row"))
        self.evaluate("document.querySelector('#point-facts [data-row]').click()")
        self.browser.settle()
        self.assertEqual(self.evaluate("kinetri.time"), self.run_.events[row].time[2])

    def test_keys_select_points(self):
        self.browser.key("p")
        first = self.evaluate("kinetri.point")
        self.browser.key("]")
        self.assertEqual(self.evaluate("kinetri.point"), (first + 1) % 25)
        self.browser.key("[")
        self.browser.key("[")
        self.assertEqual(self.evaluate("kinetri.point"), (first - 1) % 25)
        before = self.look()
        self.browser.key("r")
        self.assertGreater(before.difference(self.look(), 24), LEAST_CHANGE / 4)
        where = "kinetri.screen(0, 0)"
        left, top = self.evaluate(where)
        self.browser.key("ArrowLeft", modifiers=8)  # Shift
        self.assertGreater(self.evaluate(where)[0], left)
        self.assertEqual(self.evaluate("kinetri.time"), 3.0)
        self.assertEqual(self.evaluate(where)[1], top)

    def test_the_camera_follows(self):
        self.browser.key("p")
        self.browser.key("j")
        left, top, right, bottom = self.evaluate(
            "(() => { const r = document.getElementById('picture').getBoundingClientRect();"
            " return [r.left, r.top, r.right, r.bottom]; })()")
        for when in (3.0, 4.5, 1.0):
            self.go_to(when)
            x, y = self.place_of(self.evaluate("kinetri.point"))
            self.assertAlmostEqual(x, (left + right) / 2, 3)
            self.assertAlmostEqual(y, (top + bottom) / 2, 3)
        self.drag(40, 0)
        place = self.place_of(self.evaluate("kinetri.point"))
        self.assertAlmostEqual(place[0], (left + right) / 2 + 40, 3)

    def test_search(self):
        self.browser.key("/")
        for key in "17":
            self.browser.key(key)
        self.browser.key("Enter", text="\r")
        self.assertEqual(self.evaluate("kinetri.point"), 17)
        self.assertIn("Point 17", self.text("status") or "Point 17")
        self.browser.key("/")
        for key in "99":
            self.browser.key(key)
        self.browser.key("Enter", text="\r")
        self.assertEqual(self.evaluate("kinetri.point"), 17)
        self.assertIn("no point '99'", self.text("status"))
        # By name.
        self.browser.open(self.run_of("tracks").page)
        self.evaluate("void (location.hash = 'point=cid')")
        self.browser.settle()
        self.assertEqual(self.text("point-title"), "cid, point 2")

    def test_areas(self):
        """The areas of the cells are those that the bisectors of all points give."""
        for name, when in (("discs", 3.0), ("uniform", 2.5), ("sizes", 1.75), ("box", 4.0)):
            run = self.run_of(name)
            self.open(run.page)
            self.go_to(when)
            points, found, hidden, radii = self.evaluate(
                "[kinetri.positions(), kinetri.areas(), kinetri.hidden(), kinetri.radii()]")
            box = runs.recording_of(run.page)["box"]
            weights = [r * r for r in radii] if name == "sizes" else None
            some = 0
            for i, area in enumerate(found):
                if i in hidden:
                    self.assertIsNone(area)
                    continue
                wanted, is_cut = cell_area(points, i, box or [-1e5, -1e5, 1e5, 1e5], weights)
                if box is None and is_cut:
                    self.assertIsNone(area, f"point {i} of {name}")
                else:
                    self.assertTrue(math.isclose(area, wanted, rel_tol=1e-7), (name, i, area, wanted))
                    some += 1
            self.assertGreater(some, 5)
            if box is not None:
                self.assertTrue(math.isclose(sum(found), (box[2] - box[0]) * (box[3] - box[1]), rel_tol=1e-9))

    def test_points_that_coincide(self):
        """One of them is shown, and has the cell, which they share; panel, tip and list name the others."""
        self.open(self.run_of("together").page)
        state = "[kinetri.hidden(), kinetri.edges().flat()]"
        for when, hidden in ((1.0, []), (2.0, [1, 2]), (3.0, [1, 2]), (4.0, [2]), (5.0, [2]), (6.0, []), (7.0, []),
                             (5.5, [2]), (2.5, [1, 2]), (0.0, [])):
            self.go_to(when)
            found, ends = self.evaluate(state)
            self.assertEqual(found, hidden, when)
            self.assertEqual(sorted(set(ends)), [i for i in range(6) if i not in hidden], when)
        self.go_to(3.0)
        points, areas = self.evaluate("[kinetri.positions(), kinetri.areas()]")
        self.assertEqual(points[0], points[1])
        whole, is_cut = cell_area([points[0], *points[3:]], 0, [-1e5, -1e5, 1e5, 1e5])
        self.assertFalse(is_cut)
        for area in areas[:3]:
            self.assertTrue(math.isclose(area, whole / 3, rel_tol=1e-9), (area, whole))
        self.browser.move(*self.place_of(1))
        self.assertIn("same place  ben, cas", self.text("tip"))
        self.browser.click(*self.place_of(1))
        self.assertEqual(self.evaluate("kinetri.point"), 0)
        self.assertEqual(self.text("point-says"), "")
        facts = self.text("point-facts")
        self.assertIn("Same place\n2: ben cas", facts)
        self.assertIn("Neighbors\n5: ben cas dot eve fin", facts)
        self.evaluate("document.querySelector('#point-facts [data-point=\"1\"]').click()")
        self.browser.settle()
        self.assertEqual(self.text("point-says"), "ann hides this point: they coincide for a while.")
        facts = self.text("point-facts")
        self.assertIn("Same place\n2: ann cas", facts)
        self.assertIn("Neighbors\n1: ann", facts)
        self.assertIn(f"Cell area\n{whole / 3:.4f}"[:-1], facts)
        self.browser.key("Escape")
        self.browser.key("g")
        self.assertIn("points that coincide for a while", self.text("legend"))
        self.browser.key("g")
        self.evaluate("void (location.hash = 'kinds=hide,reveal')")
        self.browser.settle()
        rows = self.evaluate("[...document.querySelectorAll('.row:not([hidden]) .change')].map((r) => r.innerText)")
        self.assertEqual(rows, ["point ben is hidden by ann", "point cas is hidden by ann",
                                "point ben is no longer hidden by ann", "point cas is no longer hidden by ben"])

    def test_colors(self):
        """Each quantity colors points by what it is, and the legend says which."""
        plain = self.look()
        self.browser.key("o")  # no discs, but cells
        speeds = [math.hypot(*v) for v in self.evaluate(
            "kinetri.positions().map((_, i) => kinetri.velocity(i))")]
        for quantity, label in (("area", "Cell area"), ("density", "Density"), ("speed", "Speed"),
                                ("degree", "Neighbors"), ("changes", "Changes so far")):
            with self.subTest(quantity=quantity):
                # The legend takes room of the picture.
                self.evaluate(f"void (location.hash = 'color={quantity}&legend=off')")
                self.browser.settle()
                self.assertGreater(plain.difference(self.look()), 0.1)
                self.browser.key("g")
                self.assertIn(label, self.text("legend"))
                colored = self.evaluate("kinetri.colored()")
                numbers = {
                    "area": self.evaluate("kinetri.areas()"), "speed": speeds,
                    "density": [1 / a for a in self.evaluate("kinetri.areas()")],
                    "degree": [len(self.neighbors(i)) for i in range(25)],
                    "changes": [sum((i in (e.removed or ())) + (i in (e.added or ()))
                                    for e in self.run_.events if e.time[2] <= 3.0) for i in range(25)],
                }[quantity]
                order = sorted(range(25), key=lambda i: numbers[i])
                shades = [colored["shades"][i] for i in order]
                self.assertEqual(shades, sorted(shades))
                self.assertGreater(len(set(shades)), 3)
        self.evaluate("void (location.hash = 'color=none&show=discs&legend=off')")
        self.browser.settle()
        self.browser.move(5, 5)
        self.assertEqual(self.look(), plain)

    def test_the_scale_is_even(self):
        """The lightness (CIELAB) of the scale rises by about the same with each step."""
        colors = self.evaluate("kinetri.scale()")
        lightness = []
        for color in colors:
            channels = [int(c) / 255 for c in color[4:-1].split()]
            linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
            y = 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
            lightness.append(116 * y ** (1 / 3) - 16 if y > 0.008856 else 903.3 * y)
        steps = [b - a for a, b in zip(lightness, lightness[1:])]
        self.assertGreater(min(steps), 0.3 * sum(steps) / len(steps))
        self.assertLess(max(steps), 2 * sum(steps) / len(steps))

    def test_filters(self):
        kinds = {event.kind for event in self.run_.events}
        self.assertGreater(len(kinds), 2)
        count = len(self.run_.events)
        self.evaluate("void (location.hash = 'kinds=flip')")
        self.browser.settle()
        flips = sum(event.kind == "flip" for event in self.run_.events)
        self.assertEqual(self.text("events-count"), f"{flips} of {count}")
        shown = self.evaluate("[...document.querySelectorAll('.row:not([hidden])')].map((r) => Number(r.dataset.row))")
        self.assertGreater(len(shown), 3)
        self.assertEqual({self.run_.events[row].kind for row in shown}, {"flip"})
        self.browser.key("p")
        point = self.evaluate("kinetri.point")
        self.browser.click_element("point-only")
        here = [i for i, e in enumerate(self.run_.events) if e.kind == "flip" and point in e.removed + e.added]
        self.assertEqual(self.text("events-count"), f"{len(here)} of {count}")
        self.browser.key("Escape")
        self.assertEqual(self.text("events-count"), f"{flips} of {count}")

    def test_a_click_on_a_cell_selects_its_point(self):
        self.evaluate("void (location.hash = 'show=voronoi&hide=delaunay')")
        self.browser.settle()
        x, y = self.place_of(12)
        for dx, dy in ((18, 9), (-17, 12), (3, -21)):
            places = self.evaluate("kinetri.positions().map((p) => kinetri.screen(...p))")
            owner = min(range(25), key=lambda i: math.dist(places[i], (x + dx, y + dy)))
            self.browser.click(x + dx, y + dy)
            self.assertEqual(self.evaluate("kinetri.point"), owner)
