# SPDX-License-Identifier: GPL-3.0-or-later
"""A run in a sheared periodic box: the page beside the program's edges at the same times, and exact places."""
import csv
import fractions
import json
import math

import runs
from page import STEPS, Page

WIDTH, HEIGHT, TILT, SHEAR = 8, 10, 1, 0.75
UNTIL = 6
RANGE = 8.5  # more than the width: of images of one point too
POINTS = "x,y,vx,vy\n" + "".join(
    f"{(i * 37) % 83 / 4 - 6},{(i * 53) % 97 / 4 - 5},{(i * 7) % 11 / 8 - 0.5},{(i * 5) % 13 / 8 - 0.75}\n" for i in range(24))
BOX = ("--periodic", f"{WIDTH},{HEIGHT},{TILT}", "--shear", SHEAR)


def vectors(time):
    """The two vectors of the box, exactly."""
    return (fractions.Fraction(WIDTH), 0), (TILT + fractions.Fraction(SHEAR) * HEIGHT * fractions.Fraction(time), HEIGHT)


def edges_in(path):
    """[a, b, x, y] of each edge in a file of edges."""
    with open(path, newline="", encoding="utf-8") as file:
        return [[int(row["a"]), int(row["b"]), *map(int, row["offset"].split())] for row in csv.DictReader(file)]


class Periodic(Page):
    """The page of a run that nothing disturbs."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.folder.mkdir(parents=True, exist_ok=True)
        cls.points, cls.page = cls.folder / "periodic.csv", cls.folder / "periodic.html"
        cls.points.write_text(POINTS)
        cls.motions = [tuple(map(fractions.Fraction, line.split(","))) for line in POINTS.splitlines()[1:]]
        cls.simulate(UNTIL, "--html", cls.page, "--events", cls.folder / "events.csv")
        with open(cls.folder / "events.csv", newline="", encoding="utf-8") as file:
            cls.events = list(csv.DictReader(file))

    @classmethod
    def simulate(cls, until, *outputs):
        runs.execute(cls.program, "simulate", cls.points, "--until", until, *BOX, *outputs, "--quiet")

    def regular_points(self):
        """A file of the points as discs of three sizes."""
        rows = POINTS.splitlines()
        result = self.folder / "regular.csv"
        result.write_text(rows[0] + ",radius\n" + "".join(f"{row},{(0, 0.5, 2)[i % 3]}\n" for i, row in enumerate(rows[1:])))
        return result

    def setUp(self):
        super().setUp()
        self.open(self.page)

    def place(self, point, time, offset=(0, 0)):
        """The exact place of an image."""
        x, y, vx, vy = self.motions[point]
        (ux, uy), (wx, wy) = vectors(time)
        t = fractions.Fraction(time)
        return x + vx * t + offset[0] * ux + offset[1] * wx, y + vy * t + offset[0] * uy + offset[1] * wy

    def check_triangles(self, triangles, edges, time):
        """Triangles that turn left or are flat for a moment, whose sides are the edges, twice each, and that cover the
        box once."""
        sides, area = {}, 0
        for a, b, c, bx, by, cx, cy in triangles:
            corners = (a, 0, 0), (b, bx, by), (c, cx, cy)
            p, q, r = (self.place(i, time, offset) for i, *offset in corners)
            part = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
            self.assertGreaterEqual(part, 0)
            area += part
            for k in range(3):
                (i, x, y), (j, u, v) = corners[k], corners[(k + 1) % 3]
                side = max((i, j, u - x, v - y), (j, i, x - u, y - v), key=lambda s: (s[0] <= s[1], s[2:] if i == j else 0))
                sides[side] = sides.get(side, 0) + 1
        self.assertEqual(area, 2 * WIDTH * HEIGHT)
        self.assertEqual(sides, {tuple(edge): 2 for edge in edges})

    def test_edges_are_those_of_the_program(self):
        times = [0, 0.3, 1.75, 2.5, 4.125, UNTIL]
        for time in times + times[::-2]:
            self.simulate(time, "--edges", self.folder / "edges.csv")
            self.go_to(time)
            edges = self.evaluate("kinetri.edges()")
            self.assertEqual(edges, edges_in(self.folder / "edges.csv"), time)
            self.check_triangles(self.evaluate("kinetri.triangles()"), edges, time)

    def in_range(self, time):
        """[a, b, x, y] of each pair of images within range, exactly."""
        (ux, _), (wx, wy) = vectors(time)
        result = []
        for a in range(len(self.motions)):
            for b in range(a, len(self.motions)):
                dx, dy = (q - p for p, q in zip(self.place(a, time), self.place(b, time)))
                for l in range(math.ceil((-RANGE - dy) / wy), math.floor((RANGE - dy) / wy) + 1):
                    x = dx + l * wx
                    for k in range(math.ceil((-RANGE - x) / ux), math.floor((RANGE - x) / ux) + 1):
                        if (a < b or (k, l) > (0, 0)) and (x + k * ux) ** 2 + (dy + l * wy) ** 2 <= RANGE ** 2:
                            result.append([a, b, k, l])
        return sorted(result)

    def test_pairs_within_range_are_those_of_images(self):
        page = self.folder / "range.html"
        self.simulate(UNTIL, "--html", page, "--range", RANGE)
        self.open(page)
        most = 0
        for time in (0, 0.3, 4.125, 2.5, UNTIL, 1.75):
            self.go_to(time)
            expected = self.in_range(time)
            self.assertEqual(self.evaluate("kinetri.inRange()"), expected, time)
            self.assertEqual(self.evaluate("kinetri.components()"), [0] * len(self.motions))
            most = max(most, max(abs(number) for *_, x, y in expected for number in (x, y)))
        self.assertGreater(most, 2)
        shown = self.look()
        self.browser.key("y")
        self.assertGreater(shown.difference(self.look()), 0.004)
        self.evaluate("void (location.hash = 't=2.5&point=3')")
        self.browser.settle()
        partners = sum((a == 3) + (b == 3) for a, b, *_ in self.in_range(2.5))
        self.assertIn(f"In range\n{partners}: ", self.evaluate("document.getElementById('point-facts').innerText"))
        # kinetri render draws as many.
        target = self.folder / "range.svg"
        runs.execute(self.program, "render", page, "--at", 2.5, "--output", target)
        places = self.evaluate("kinetri.positions()")
        links = self.in_range(2.5)
        leaving = 0
        for a, b, k, l in links:
            p, q = self.place(a, 2.5), self.place(b, 2.5, (k, l))
            leaving += math.dist([places[a][axis] + float(q[axis] - p[axis]) for axis in (0, 1)], places[b]) > 1e-6
        drawn = target.read_text(encoding="utf-8").split('class="links"')[1:]
        self.assertEqual(sum(part[:part.index("/>")].count("M") for part in drawn), len(links) + leaving)

    def test_steps_forward_and_backward(self):
        forward = self.evaluate(STEPS.replace("DIRECTION", "stepForward"))
        backward = self.evaluate(STEPS.replace("DIRECTION", "stepBackward"))
        self.assertEqual(len(self.events), forward[-1][1])
        self.assertGreater(len(self.events), 100)
        self.assertEqual(forward, backward[::-1])
        for _, _, edges, triangles in forward:
            self.assertEqual((len(edges), len(triangles)), (3 * len(self.motions), 2 * len(self.motions)))

    def test_points_are_in_the_box(self):
        for time in (0, 1, 2.25, UNTIL):
            self.go_to(time)
            (ux, _), (vx, vy) = vectors(time)
            lean = vx - ux * round(vx / ux)
            for point, (x, y) in enumerate(self.evaluate("kinetri.positions()")):
                px, py = self.place(point, time)
                l = math.floor(py / vy)
                k = math.floor((px - l * vx - (py - l * vy) / vy * lean) / ux)
                self.assertAlmostEqual(y, float(py - l * vy), 9)
                self.assertAlmostEqual(x, float(px - l * vx - k * ux), 9)

    def test_areas_sum_to_that_of_the_box(self):
        for time in (0, 1.5, 5):
            self.go_to(time)
            self.assertAlmostEqual(sum(self.evaluate("kinetri.areas()")), WIDTH * HEIGHT, 9)
            # The panel of a point computes one cell by itself.
            self.browser.open(self.page, f"#t={time}&point=3")
            area = self.evaluate("kinetri.areas()[3]")
            said = self.evaluate("document.getElementById('point-facts').innerText")
            self.assertIn(f"Cell area\n{area:.6g}"[:16], said)

    def test_click_at_an_image_selects_its_point(self):
        self.go_to(1.0)
        places = self.evaluate("kinetri.positions()")
        left, top, right, bottom = self.picture_box()
        clicked = 0
        for a, b, k, l in self.evaluate("kinetri.edges()"):
            # Where the image of b is, beside the image of a in the box.
            p, q = self.place(a, 1), self.place(b, 1, (k, l))
            x, y = (places[a][axis] + float(q[axis] - p[axis]) for axis in (0, 1))
            if math.dist((x, y), places[b]) < 1e-6:
                continue
            sx, sy = self.evaluate(f"kinetri.screen({x}, {y})")
            if not (left + 8 < sx < right - 8 and top + 8 < sy < bottom - 8) or clicked == 4:
                continue
            self.browser.click(sx, sy)
            self.assertEqual(self.evaluate("kinetri.point"), b)
            self.browser.key("Escape")
            clicked += 1
        self.assertEqual(clicked, 4)

    def test_edge_that_leaves_is_selected_at_both_ends(self):
        self.go_to(1.0)
        places = self.evaluate("kinetri.positions()")
        edges = self.evaluate("kinetri.edges()")
        names = set()
        for a, b, k, l in edges:
            p, q = self.place(a, 1), self.place(b, 1, (k, l))
            dx, dy = (float(q[axis] - p[axis]) for axis in (0, 1))
            ends = [(places[a][0] + dx / 2, places[a][1] + dy / 2), (places[b][0] - dx / 2, places[b][1] - dy / 2)]
            if math.dist(*ends) < 1e-6:
                continue
            titles = []
            for x, y in ends:
                sx, sy = self.evaluate(f"kinetri.screen({x}, {y})")
                self.browser.click(sx, sy)
                titles.append(self.evaluate("document.getElementById('certificate-title').innerText"))
                self.browser.key("Escape")
            if titles[0] == titles[1]:
                names.add(titles[0])
        # In some middles other edges are nearer.
        self.assertGreater(len(names), 5)
        self.assertTrue(any("(" in name for name in names), names)

    def test_certificate_is_that_of_images(self):
        """It is zero when its edge is removed, whose time the log has."""
        checked = 0
        for event in self.events:
            if event["kind"] != "flip" or event["time_lo"] == event["time_hi"] or checked == 12:
                continue
            offset = event["removed_offset"].replace(" ", ",")
            before = math.nextafter(float(event["time_lo"]), -1)
            self.browser.open(self.page, f"#t={before!r}&edge={event['removed_a']}-{event['removed_b']},{offset}")
            facts = self.evaluate("document.getElementById('certificate-facts').innerText")
            self.assertIn("Fails\nbetween two consecutive binary64 numbers", facts, event)
            self.assertIn("positive at the lower one, negative at the upper one (exact)", facts, event)
            says = self.evaluate("document.getElementById('certificate-says').innerText")
            a, b = event["removed_a"], event["removed_b"]
            name = b if offset == "0,0" else f"{b} ({offset.replace(',', ', ')})"
            self.assertIn(f"in-circle({a}, {name}, ", says)
            checked += 1
        self.assertEqual(checked, 12)

    def test_every_switch_draws(self):
        self.go_to(2.0)
        before = self.look()
        for key in ("v", "c", "t", "a", "m", "i"):
            self.browser.key(key)
            if key == "c":
                left, top, right, bottom = self.picture_box()
                self.browser.move((left + right) / 2, (top + bottom) / 2)
            self.browser.settle()
            now = self.look()
            self.assertNotEqual(now, before, key)
            self.browser.key(key)
            self.browser.move(5, 5)
        for color in ("area", "density", "speed", "degree", "changes"):
            self.evaluate(f"void (location.hash = 't=2&color={color}')")
            self.browser.settle()
            self.assertEqual(self.evaluate("kinetri.colored().id"), color)
        self.assertFalse(self.evaluate("[...document.querySelectorAll('.switch, label')].some((e) => /Hull/.test(e.innerText))"))

    def test_picture_is_the_same_without_a_browser(self):
        """kinetri render draws as many edges, images and points."""
        target = self.folder / "periodic.svg"
        runs.execute(self.program, "render", self.page, "--at", 2, "--output", target)
        text = target.read_text(encoding="utf-8")
        self.go_to(2)
        places = self.evaluate("kinetri.positions()")
        leaving = 0
        for a, b, k, l in self.evaluate("kinetri.edges()"):
            p, q = self.place(a, 2), self.place(b, 2, (k, l))
            leaving += math.dist([places[a][axis] + float(q[axis] - p[axis]) for axis in (0, 1)], places[b]) > 1e-6
        drawn = text[text.index('class="leaving-edges"'):]
        self.assertEqual(drawn[:drawn.index("/>")].count("M"), 2 * leaving)

    def test_discs_have_images_that_reach_into_the_box(self):
        for x, y, expected in ((5, 5, []), (0.5, 4, [[10.5, 4]]), (9.5, 9.5, [[-0.5, -0.5], [-0.5, 9.5], [9.5, -0.5]])):
            found = self.evaluate(
                "(() => { const found = [], box = new DrawnBox({numbers: [0, 10, 0, 0, 0, 0, 0, 10, 0, 0]}, 0); "
                f"box.forEachDiscImage({x}, {y}, 1, (...place) => found.push(place)); return found; }})()")
            self.assertEqual(sorted(found), expected)

    def test_page_with_discs_draws(self):
        page = self.folder / "discs.html"
        self.simulate(2, "--collisions", "log", "--radius", 0.75, "--html", page)
        self.open(page)
        self.go_to(1)
        self.assertTrue(self.evaluate("kinetri.radii().every((radius) => radius === 0.75)"))

    def test_power_cells_of_discs_cover_the_box(self):
        """Of --regular: discs of three sizes, which hide others; the page has the program's edges, and cells of the
        others alone."""
        page, edges = self.folder / "regular.html", self.folder / "edges.csv"
        points = self.regular_points()
        hidden_points = set()
        runs.execute(self.program, "simulate", points, "--until", 2, *BOX, "--regular", "--html", page, "--quiet")
        for time in (0.5, 1.25, 2):
            runs.execute(self.program, "simulate", points, "--until", time, *BOX, "--regular", "--edges", edges, "--quiet")
            self.browser.open(page, f"#t={time}&show=voronoi,discs&color=area")
            expected = edges_in(edges)
            self.assertEqual(sorted(self.evaluate("kinetri.edges()")), sorted(expected))
            hidden = set(range(len(self.motions))) - {end for edge in expected for end in edge[:2]}
            hidden_points |= hidden
            areas = self.evaluate("kinetri.areas()")
            self.assertAlmostEqual(sum(area or 0 for area in areas), WIDTH * HEIGHT, 9)
            self.assertEqual({i for i, area in enumerate(areas) if not area}, hidden)
            # The panel of a point computes one cell by itself.
            point = min(set(range(len(areas))) - hidden)
            self.browser.open(page, f"#t={time}&point={point}")
            said = self.evaluate("document.getElementById('point-facts').innerText")
            self.assertIn(f"Cell area\n{areas[point]:.6g}"[:16], said)
        self.assertGreater(len(hidden_points), 3)

    def test_certificate_of_discs_is_that_of_images(self):
        page, events = self.folder / "regular.html", self.folder / "regular-events.csv"
        points = self.regular_points()
        runs.execute(self.program, "simulate", points, "--until", 2, *BOX, "--regular", "--html", page, "--events", events,
                     "--quiet")
        checked = 0
        with open(events, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        for event in rows:
            if event["kind"] != "flip" or event["time_lo"] == event["time_hi"] or checked == 6:
                continue
            before = math.nextafter(float(event["time_lo"]), -1)
            offset = event["removed_offset"].replace(" ", ",")
            self.browser.open(page, f"#t={before!r}&edge={event['removed_a']}-{event['removed_b']},{offset}")
            facts = self.evaluate("document.getElementById('certificate-facts').innerText")
            self.assertIn("positive at the lower one, negative at the upper one (exact)", facts, event)
            checked += 1
        self.assertEqual(checked, 6)

    def test_damaged(self):
        recording = runs.recording_of(self.page)
        target = self.folder / "damaged.html"

        def damage(expected, **members):
            runs.with_recording(self.page, json.dumps({**recording, **members}), target)
            self.browser.open(target)
            self.assertIn(expected, self.evaluate("document.getElementById('message').innerText"))

        damage("format is 2", format=2)
        damage("its periodic box is not ten numbers", periodic=[1, 2])
        triangles, events = recording["triangles"], recording["events"]
        damage("offsets of triangles at the start, not", triangles={**triangles, "initial_offsets": ""})
        damage("offset of event 0 is not there", events={**events, "offsets": ""})
        damage("offsets belong to no edge", events={**events, "offsets": "AAAA" * 4 + events["offsets"]})
        damage("which is not there then", triangles={**triangles, "initial_offsets": "A" * len(triangles["initial_offsets"])})
