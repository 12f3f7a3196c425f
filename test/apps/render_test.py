#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`kinetri render`: pictures and films of a recorded run, compared with what other runs, exact places and
areas by hand say. What needs rsvg-convert or ffmpeg is skipped where they are not.

usage: render_test.py PROGRAM
"""
import csv
import fractions
import math
import pathlib
import re
import shutil
import signal
import stat
import struct
import subprocess
import sys
import time
import unittest
import xml.etree.ElementTree as ElementTree

sys.dont_write_bytecode = True
from in_folder import In_folder  # noqa: E402

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
SVG = "{http://www.w3.org/2000/svg}"
HAS_RSVG = shutil.which("rsvg-convert") is not None
HAS_FFMPEG = shutil.which("ffmpeg") is not None and shutil.which("ffprobe") is not None
BEGIN = '<script type="application/json" id="recording">'

Fraction = fractions.Fraction
NUMBER = r"(-?[\d.]+(?:e-?\d+)?)"


class Picture:
    """An SVG picture of ours."""

    def __init__(self, text):
        self.root = ElementTree.fromstring(text)

    def all(self, name, tag):
        """The elements of the class, and those in groups of it."""
        found = [one for one in self.root.iter(SVG + tag) if one.get("class") == name]
        for group in self.root.iter(SVG + "g"):
            if group.get("class") == name:
                found += group.findall(SVG + tag)
        return found

    def circles(self, name):
        return [(float(c.get("cx")), float(c.get("cy")), float(c.get("r"))) for c in self.all(name, "circle")]

    def lines(self, name):
        """Pairs of places."""
        return [line for path in self.all(name, "path") for line in self.lines_of(path)]

    @staticmethod
    def lines_of(path):
        found = []
        for line in re.findall(f"M{NUMBER} {NUMBER}L{NUMBER} {NUMBER}", path.get("d")):
            x0, y0, x1, y1 = map(float, line)
            found.append(((x0, y0), (x1, y1)))
        return found

    def texts(self):
        return [text.text for text in self.root.iter(SVG + "text")]

    def fills(self, name, tag="path"):
        return [one.get("fill") for one in self.all(name, tag)]


class Rendering(In_folder):
    def run_(self, *arguments, expected=0, **more):
        done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              check=False, timeout=300, **more)
        self.assertEqual(done.returncode, expected, done.stderr)
        return done

    def picture(self, *arguments, page="run.html"):
        return Picture(self.run_("render", page, "--output", "-", *arguments).stdout)

    def uniform(self, *more):
        self.run_("generate", "uniform", "--points", 50, "--side", 60, "--seed", 4, "--output", "p.csv")
        self.run_("simulate", "p.csv", "--until", 6, "--html", "run.html", "--quiet", *more)

    def edges_at(self, when):
        """The edges of another run, which ends then."""
        self.run_("simulate", "p.csv", "--until", when, "--edges", "e.csv", "--quiet")
        with open(self.folder / "e.csv", encoding="utf-8", newline="") as table:
            return {tuple(sorted(map(int, row))) for row in list(csv.reader(table))[1:]}

    def edges_of(self, picture):
        """By the places of the points, whose circles are in the order of their ids."""
        ids = {}
        for point, (x, y, _) in enumerate(picture.circles("points")):
            self.assertNotIn((x, y), ids)
            ids[x, y] = point
        return {tuple(sorted((ids[a], ids[b]))) for a, b in picture.lines("edges")}


class Pictures(Rendering):
    def test_edges_are_those_of_the_run_at_each_time(self):
        self.uniform()
        seen = set()
        for when in (0, 1.25, 2.5, 3.7, 6):
            edges = self.edges_of(self.picture("--at", when))
            self.assertEqual(edges, self.edges_at(when), when)
            seen.add(frozenset(edges))
        self.assertEqual(len(seen), 5)

    def test_points_are_where_they_are(self):
        self.uniform()
        with open(self.folder / "p.csv", encoding="utf-8", newline="") as table:
            rows = [[float(row[key]) for key in ("x", "y", "vx", "vy")] for row in csv.DictReader(table)]
        when = 2.5
        circles = self.picture("--at", when).circles("points")
        places = [(x + vx * when, y + vy * when) for x, y, vx, vy in rows]
        self.assertEqual(len(circles), len(places))
        # One scale and one origin, y up in the plane and down in the picture.
        (x0, y0), other = places[0], places[1]
        scale = (circles[1][0] - circles[0][0]) / (other[0] - x0)
        self.assertGreater(scale, 0)
        for (x, y), (cx, cy, _) in zip(places, circles):
            self.assertAlmostEqual(cx - circles[0][0], scale * (x - x0), delta=0.2)
            self.assertAlmostEqual(circles[0][1] - cy, scale * (y - y0), delta=0.2)
            self.assertTrue(0 < cx < 960 and 0 < cy < 640)

    def test_layers_follow_the_words(self):
        self.uniform()
        names = {"edges": "delaunay", "hull": "hull", "voronoi": "voronoi", "trails": "trails", "arrows": "arrows",
                 "heat": "heat", "scale-bar": "scale"}
        nothing = self.picture("--at", 3, "--view", "hide=delaunay,hull,ids")
        for name, word in names.items():
            tag = "rect" if name == "heat" else "path"
            self.assertEqual(nothing.all(name, tag), [], name)
            only = self.picture("--at", 3, "--view", f"hide=delaunay,hull,ids&show={word}")
            self.assertNotEqual(only.all(name, tag), [], name)
        self.assertEqual(nothing.texts(), [])
        self.assertIn("7", self.picture("--view", "show=ids").texts())
        self.assertIn("t = 3.00", self.picture("--at", 3, "--time").texts())

    def test_voronoi_edges_have_equal_distances_to_the_ends_of_theirs(self):
        self.uniform()
        picture = self.picture("--at", 2, "--view", "show=voronoi")
        points = [(x, y) for x, y, _ in picture.circles("points")]
        lines = picture.lines("voronoi")
        self.assertGreater(len(lines), 80)
        for a, b in lines:
            middle = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
            if not (0 < middle[0] < 960 and 0 < middle[1] < 640) or math.dist(a, b) < 1:
                continue
            nearest = sorted(math.dist(middle, point) for point in points)
            self.assertAlmostEqual(nearest[0], nearest[1], delta=0.1)

    def test_the_view_of_the_page_is_the_first(self):
        self.uniform("--html-view", "t=2&theme=dark&hide=hull&color=degree")
        first = self.picture()
        self.assertEqual(first.fills("background", "rect"), ["#0e1217"])
        self.assertEqual(first.lines("hull"), [])
        self.assertEqual(first.circles("points"), self.picture("--at", 2).circles("points"))
        other = self.picture("--view", "theme=light&t=3&show=hull&color=none")
        self.assertEqual(other.fills("background", "rect"), ["#fdfdfe"])
        self.assertEqual(other.circles("points"), self.picture("--at", 3, "--view", "color=none").circles("points"))
        self.assertEqual(other.fills("colors"), [])
        self.assertNotEqual(other.lines("hull"), [])

    def test_an_event_is_marked_at_its_time(self):
        # At t = 1 the edge 0-3 becomes 1-2.
        self.write("p.csv", "x,y,vx,vy\n0,0,0,0\n4,0,0,0\n0,4,0,0\n3,3,1,1\n")
        self.run_("simulate", "p.csv", "--until", 2, "--html", "run.html", "--quiet")
        for words, marked in (("t=1", 1), ("event=1", 1), ("t=0.999", 0), ("t=1.001", 0), ("event=0", 0)):
            picture = self.picture("--view", words)
            self.assertEqual(len(picture.lines("removed")), marked, words)
            self.assertEqual(len(picture.lines("added")), marked, words)
        self.assertEqual(self.picture("--view", "t=1&kinds=wall").lines("added"), [])
        picture = self.picture("--view", "t=1&kinds=flip,wall")
        places = [(x, y) for x, y, _ in picture.circles("points")]
        self.assertEqual(set(picture.lines("added")[0]), {places[1], places[2]})
        self.assertEqual(set(picture.lines("removed")[0]), {places[0], places[3]})
        self.assertEqual(self.edges_of(picture), {(0, 1), (0, 2), (1, 2), (1, 3), (2, 3)})

    def test_selected_point_and_edge(self):
        self.uniform("--html-view", "hide=ids")
        picture = self.picture("--view", "point=7&t=1")
        edges = [edge for edge in self.edges_at(1) if 7 in edge]
        self.assertEqual(len(picture.lines("selected")), len(edges))
        self.assertEqual(len(picture.circles("neighbor")), len(edges))
        a, b = edges[0]
        picture = self.picture("--view", f"edge={b}-{a}&t=1")
        places = [(x, y) for x, y, _ in picture.circles("points")]
        self.assertEqual({place for line in picture.lines("selected") for place in line}, {places[a], places[b]})
        followed = self.picture("--view", "point=7&follow=on&t=1").circles("points")[7]
        self.assertEqual(followed[:2], (480, 320))

    def test_a_point_by_its_label(self):
        self.write("p.csv", "id,x,y,vx,vy\nann,0,0,0,0\nbob,2,1,0,0\n\"1\",4,2,0,1\n")
        self.run_("simulate", "p.csv", "--until", 1, "--html", "run.html", "--quiet")
        picture = self.picture("--at", 0.5, "--view", "point=bob&follow=on&show=ids")
        self.assertEqual(picture.circles("points")[1][:2], (480, 320))
        self.assertEqual({"ann", "bob", "1"} - set(picture.texts()), set())
        # A number is an id.
        same = self.picture("--at", 0.5, "--view", "point=1&follow=on&show=ids")
        self.assertEqual(same.circles("points"), picture.circles("points"))

    def test_discs_walls_and_hidden_points(self):
        # The disc of point 1 is within that of 0.
        self.write("p.csv", "x,y,vx,vy,radius\n0,0,0,0,4\n1,0,0,0,1\n9,0,0,0,2\n0,9,0,0,3\n")
        self.run_("simulate", "p.csv", "--until", 1, "--box=-5,-5,15,15", "--regular", "--html", "run.html", "--quiet")
        picture = self.picture("--at", 0)
        (xs, _), (xe, _) = picture.lines("box")[0]
        scale = (xe - xs) / 20
        self.assertEqual(len(picture.circles("hidden-points")), 1)
        radii = [r / scale for _, _, r in picture.circles("discs")]
        for radius, right in zip(radii, (4, 2, 3)):
            self.assertAlmostEqual(radius, right, delta=0.01)
        self.assertAlmostEqual(picture.circles("hidden-discs")[0][2] / scale, 1, delta=0.01)

    def test_points_that_coincide(self):
        # Points 1 and 3, discs of one size with --regular.
        points = "x,y,vx,vy,radius\n2,2,0,0,1\n8,2,0,1,2\n5,8,0,0,1\n8,2,0,1,2\n1,9,0,0,1\n"
        self.write("p.csv", points)
        for discs in ((), ("--regular",)):
            self.run_("simulate", "p.csv", "--until", 1, "--html", "run.html", "--quiet", *discs)
            picture = self.picture("--at", 0.5, "--view", "show=ids&legend=on")
            circles = picture.circles("points")
            self.assertEqual(len(circles), 4)
            (ring,) = picture.circles("coincident")
            self.assertEqual(ring[:2], circles[1][:2])
            self.assertGreater(ring[2], circles[1][2])
            self.assertEqual(picture.circles("hidden-points") + picture.circles("hidden-discs"), [])
            self.assertEqual(len(picture.circles("discs")), 4 if discs else 0)
            texts = picture.texts()
            self.assertIn("1 +1", texts)
            self.assertNotIn("3", texts)
            self.assertIn("points that coincide for a while", texts)

    def test_links_and_components(self):
        self.uniform("--range", 6, "--html-view", "hide=ids")
        self.run_("simulate", "p.csv", "--until", 3, "--range", 6, "--encounters", "n.csv", "--quiet")
        with open(self.folder / "n.csv", encoding="utf-8", newline="") as table:
            rows = [(int(row["a"]), int(row["b"]), float(row["begin_hi"]), float(row["end_lo"]))
                    for row in csv.DictReader(table)]
        when = 2.5
        pairs = {(a, b) for a, b, begin, end in rows if begin <= when <= end}
        self.assertGreater(len(pairs), 5)
        picture = self.picture("--at", when, "--view", "legend=on")
        places = [(x, y) for x, y, _ in picture.circles("points")]
        drawn = {frozenset(line) for line in picture.lines("links")}
        self.assertEqual(drawn, {frozenset((places[a], places[b])) for a, b in pairs})
        self.assertIn("in range: at most 6", picture.texts())
        self.assertEqual(self.picture("--at", when, "--view", "hide=links").lines("links"), [])
        self.assertIn("Points in the component", self.picture("--view", "color=members").texts())
        self.picture("--view", "color=component")

    def test_axes(self):
        self.uniform()
        picture = self.picture("--at", 1, "--view", "hide=ids&show=axes&unit=m&at=30,20,50")
        texts = [text for text in picture.texts() if text != "m"]
        self.assertIn("m", picture.texts())
        self.assertIn("20", texts)
        self.assertTrue(all(re.fullmatch(r"-?\d+(\.\d+)?", text) for text in texts), texts)
        # The tick of x = 30 is in the middle.
        self.assertTrue(any(a[0] == b[0] == 480 for a, b in picture.lines("axes")))
        # A picture of everything has all points beside the axes.
        picture = self.picture("--at", 1, "--view", "hide=ids&show=axes")
        left, bottom = next(b for a, b in picture.lines("axes") if a[1] == 0)
        self.assertEqual(len(picture.circles("points")), 50)
        for x, y, radius in picture.circles("points"):
            self.assertTrue(x - radius > left and y + radius < bottom, (x, y, left, bottom))

    def test_links_of_a_crowd_do_not_fill_it(self):
        """By the ink of the lines: a crowd has much less than each line of full strength would give it, and two who are
        alone have a line of full strength."""
        places = [(20 * (i * 37 % 101) / 101, 20 * (i * 53 % 103) / 103) for i in range(100)]
        rows = "".join(f"{x},{y},0,0\n" for x, y in places)
        pairs = "".join(f"200,{y},0,0\n220,{y + 4},0,0\n" for y in (0, 60))
        self.write("p.csv", f"x,y,vx,vy\n{rows}{pairs}")
        self.run_("simulate", "p.csv", "--until", 1, "--range", 40, "--html", "run.html", "--quiet")
        picture = self.picture("--at", 0.5, "--view", "at=100,40,260")
        ink = {}
        for path in picture.all("links", "path"):
            strength = float(path.get("stroke-width")) * float(path.get("stroke-opacity", 1))
            for a, b in Picture.lines_of(path):
                ink[frozenset((a, b))] = strength
        alone = [(x, y) for x, y, _ in picture.circles("points")][-2:]
        self.assertEqual(len(ink), 100 * 99 // 2 + 2)
        self.assertEqual(ink[frozenset(alone)], max(ink.values()))
        self.assertGreater(ink[frozenset(alone)], 1)
        crowd = [(x, y) for x, y, _ in picture.circles("points")][:-4]
        width, height = (max(place[k] for place in crowd) - min(place[k] for place in crowd) for k in (0, 1))
        cover = sum(strength * math.dist(*line) for line, strength in ink.items()) / (width * height)
        self.assertLess(cover, 0.8)
        self.assertGreater(cover, 0.1)

    def test_wave_and_its_flat_picture(self):
        self.run_("wave", "--columns", 6, "--rows", 5, "--html", "run.html", "--quiet")
        wave = self.picture("--at", 2.25)
        self.assertGreater(len(wave.all("wave", "path")), 30)
        self.assertEqual(wave.circles("points"), [])
        flat = self.picture("--at", 2.25, "--view", "hide=wave")
        self.assertEqual(len(flat.circles("points")), 30)

    def test_points_that_come_and_go_and_none_at_all(self):
        self.write("t.csv", "t,id,x,y\n0,a,0,0\n4,a,4,1\n1,b,9,0\n3,b,9,5\n0,c,3,7\n4,c,3,8\n")
        self.run_("tracks", "t.csv", "--html", "run.html", "--quiet")
        self.assertEqual(len(self.picture("--at", 0.5).circles("points")), 2)
        self.assertEqual(len(self.picture("--at", 2).circles("points")), 3)
        self.assertIn("b", self.picture("--at", 2, "--view", "show=ids").texts())
        self.write("p.csv", "x,y,vx,vy\n")
        self.run_("simulate", "p.csv", "--until", 1, "--html", "run.html", "--quiet")
        self.assertEqual(self.picture("--at", 0.5).circles("points"), [])

    def test_far_away_and_flat_runs_can_be_drawn(self):
        for rows in ("1e300,0,0,0\n-1e300,1,0,0\n0,1e-300,0,0\n", "0,0,0,0\n1,0,0,0\n2,0,0,0\n", "5,5,0,0\n",
                     "1e300,0,1e300,0\n-1e300,0,-1e300,0\n1,1,0,0\n"):
            self.write("p.csv", "x,y,vx,vy\n" + rows)
            self.run_("simulate", "p.csv", "--until", 1, "--html", "run.html", "--quiet")
            picture = self.picture("--at", 0.5, "--view", "show=voronoi,arrows,trails,scale&color=area")
            text = ElementTree.tostring(picture.root).decode()
            self.assertNotRegex(text, r"[ML\"' ](-?nan|-?inf)\b")

    def test_spans_that_overflow_can_be_drawn(self):
        self.write("p.csv", "x,y,vx,vy\n0,0,1,0\n3,0,-2,1\n0,4,5,-3\n5,5,-1,-1\n")
        for start in ("0", "-1e308"):
            self.run_("simulate", "p.csv", f"--from={start}", "--until", "1e308", "--html", "run.html", "--quiet")
            for words in ("show=heat,axes,scale,trails", "color=area", "color=speed&show=voronoi"):
                for when in (start, "1e308"):
                    self.assertEqual(self.picture(f"--at={when}", "--view", words).root.tag, SVG + "svg")

    def test_the_same_run_makes_the_same_bytes(self):
        self.uniform()
        one, two = (self.run_("render", "run.html", "--at", 2, "-o", "-").stdout for _ in range(2))
        self.assertEqual(one, two)


class Colors(Rendering):
    def test_areas_by_hand(self):
        # Three points in a row in a box of 9 x 3: bisectors at x = 2.5 and 6, areas 7.5, 10.5 and 9.
        self.write("p.csv", "x,y,vx,vy\n1,1.5,0,0\n4,1.5,0,0\n8,1.5,0,0\n")
        self.run_("simulate", "p.csv", "--until", 1, "--box", "0,0,9,3", "--html", "run.html", "--quiet")
        picture = self.picture("--view", "color=area&unit=m")
        # The ends of viridis; 9 is in the middle, the shade 32 of 0 to 63, which is 32/63 of the way from the
        # first of nine colors to the last: a share of 0.0635 from #21918c to #28ae80.
        self.assertEqual(picture.fills("colors"), ["#440154", "#fde725", "#21938b"])
        texts = picture.texts()
        self.assertIn("Cell area, in m\u00b2", texts)
        self.assertIn("7.5", texts)
        self.assertIn("10.5", texts)
        density = self.picture("--view", "color=density").fills("colors")
        self.assertEqual((density[0], density[1]), ("#fde725", "#440154"))
        for path, (left, right) in zip(picture.all("colors", "path"), ((0, 2.5), (2.5, 6), (6, 9))):
            xs = [float(x) for x in re.findall(f"[ML]{NUMBER} ", path.get("d"))]
            (x0, _), (x1, _) = picture.lines("box")[0]
            scale = (x1 - x0) / 9
            self.assertAlmostEqual((min(xs) - x0) / scale, left, delta=0.01)
            self.assertAlmostEqual((max(xs) - x0) / scale, right, delta=0.01)

    def test_areas_of_many_in_order(self):
        self.run_("generate", "uniform", "--points", 30, "--side", 20, "--speed", 0, "--seed", 3, "--output", "p.csv")
        self.run_("simulate", "p.csv", "--until", 1, "--box", "0,0,20,20", "--html", "run.html", "--quiet")
        with open(self.folder / "p.csv", encoding="utf-8", newline="") as table:
            points = [(Fraction(row["x"]), Fraction(row["y"])) for row in csv.DictReader(table)]
        areas = [area_of_cell(i, points, 20) for i in range(len(points))]
        self.assertEqual(sum(areas), 400)
        scale = {}
        for area, color in zip(areas, self.picture("--view", "color=area").fills("colors")):
            scale.setdefault(color, []).append(area)
        self.assertGreater(len(scale), 15)
        # The colors of viridis rise in lightness; each has areas of its own.
        spans = sorted(((luminance(color), min(own), max(own)) for color, own in scale.items()))
        for (_, _, most), (_, least, _) in zip(spans, spans[1:]):
            self.assertLess(most, least)

    def test_speed_degree_changes_size_kind(self):
        self.write("t.csv", "t,id,x,y\n0,cat1,0,0\n4,cat1,4,0\n0,cat2,9,0\n4,cat2,9,8\n0,dog1,3,7\n4,dog1,3,7\n")
        self.run_("tracks", "t.csv", "--html", "run.html", "--quiet")
        self.assertIn("dog", self.picture("--view", "color=kind").texts())
        self.write("p.csv", "x,y,vx,vy\n0,0,0,0\n4,0,3,4\n0,4,0,1\n3,3,0,2\n")
        self.run_("simulate", "p.csv", "--until", 0.1, "--box=-9,-9,9,9", "--html", "run.html", "--quiet")
        fills = self.picture("--view", "color=speed").fills("colors")
        self.assertEqual((fills[0], fills[1]), ("#440154", "#fde725"))
        self.assertEqual(sorted(fills, key=luminance), [fills[i] for i in (0, 2, 3, 1)])
        self.assertEqual(len(set(self.picture("--view", "color=degree").fills("colors"))), 2)
        self.write("p.csv", "x,y,vx,vy,radius\n0,0,0,0,1\n4,0,0,0,1\n0,4,0,0,2\n")
        self.run_("simulate", "p.csv", "--until", 1, "--regular", "--html", "run.html", "--quiet")
        self.assertEqual(self.picture("--view", "color=size").fills("colors", "circle"),
                         ["#440154", "#440154", "#fde725"])
        self.write("p.csv", "x,y,vx,vy\n0,0,0,0\n4,0,0,0\n0,4,0,0\n3,3,1,1\n")
        self.run_("simulate", "p.csv", "--until", 2, "--box=-9,-9,9,9", "--html", "run.html", "--quiet")
        for when, fills in ((0.5, {"#440154"}), (1.5, {"#fde725"})):
            self.assertEqual(set(self.picture("--at", when, "--view", "color=changes").fills("colors")), fills)


class Tools(Rendering):
    def setUp(self):
        super().setUp()
        self.uniform()

    def tool(self, name, text):
        """A program in place of a tool."""
        (self.folder / "bin").mkdir(exist_ok=True)
        path = self.folder / "bin" / name
        path.write_text(f"#!{sys.executable}\n{text}\n", encoding="utf-8")
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return {"PATH": str(self.folder / "bin")}

    @unittest.skipUnless(HAS_RSVG, "rsvg-convert is not there")
    def test_png_has_the_size_and_the_colors(self):
        self.run_("render", "run.html", "--at", 2, "--output", "a.png", "--width", 301, "--height", 200,
                  "--view", "theme=dark")
        data = (self.folder / "a.png").read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", data[16:24]), (301, 200))

    @unittest.skipUnless(HAS_RSVG and HAS_FFMPEG, "rsvg-convert or ffmpeg is not there")
    def test_films_have_their_frames(self):
        for name in ("a.gif", "a.webm", "a.mp4"):
            self.run_("render", "run.html", "--animate", name, "--from", 1, "--until", 2, "--fps", 10, "--speed", 0.5,
                      "--width", 160, "--height", 120)
            told = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-of", "csv=p=0", "-show_entries",
                                   "stream=width,height,nb_read_frames", self.folder / name],
                                  capture_output=True, text=True, check=True).stdout.strip()
            self.assertEqual(told, "160,120,21", name)
        self.run_("render", "run.html", "--animate", "a.webp", "--from", 1, "--until", 2, "--fps", 10, "--speed", 0.5,
                  "--width", 160, "--height", 120)
        frames = (self.folder / "a.webp").read_bytes()  # which ffprobe does not know
        self.assertEqual((frames[:4], frames[8:12], frames.count(b"ANMF")), (b"RIFF", b"WEBP", 21))
        first = (self.folder / "a.gif").read_bytes()
        self.run_("render", "run.html", "--animate", "b.gif", "--from", 1, "--until", 2, "--fps", 10, "--speed", 0.5,
                  "--width", 160, "--height", 120)
        self.assertEqual((self.folder / "b.gif").read_bytes(), first)

    def test_svg_needs_no_tool(self):
        self.run_("render", "run.html", "--output", "a.svg", env={"PATH": ""})
        self.assertTrue((self.folder / "a.svg").read_text(encoding="utf-8").startswith("<svg"))

    def test_without_tools(self):
        for output, tool in (("--output=a.png", "librsvg2-bin"), ("--animate=a.gif", "librsvg2-bin")):
            done = self.run_("render", "run.html", output, expected=2, env={"PATH": ""})
            self.assertIn(f"Debian: {tool}", done.stderr)
        done = self.run_("render", "run.html", "--animate=a.gif", expected=2, env=self.tool("rsvg-convert", ""))
        self.assertIn("Debian: ffmpeg", done.stderr)
        self.assertEqual({path.name for path in self.folder.iterdir()}, {"p.csv", "run.html", "bin"})

    def test_a_tool_that_fails_changes_nothing(self):
        fails = "import sys\nif '--version' not in sys.argv and '-version' not in sys.argv: sys.exit('no room')"
        passes = "import sys\nsys.stdout.write(sys.stdin.read())"
        self.write("a.png", "before")
        self.write("a.gif", "before")
        done = self.run_("render", "run.html", "--output", "a.png", expected=2, env=self.tool("rsvg-convert", fails))
        self.assertIn("it said: no room", done.stderr)
        self.tool("rsvg-convert", passes)
        done = self.run_("render", "run.html", "--output", "a.png", "--animate", "a.gif", "--until", 1, "--fps", 2,
                         expected=2, env=self.tool("ffmpeg", fails))
        self.assertIn("it said: no room", done.stderr)
        for name in ("a.png", "a.gif"):
            self.assertEqual((self.folder / name).read_text(encoding="utf-8"), "before")
        self.assertEqual(len(list(self.folder.iterdir())), 5)

    def test_interrupted_it_leaves_nothing(self):
        waits = ("import os, pathlib, sys, time\nif '--version' not in sys.argv:\n"
                 "  pathlib.Path('seen.part').write_text(str(os.getpid()))\n  os.rename('seen.part', 'seen')\n"
                 "  time.sleep(100)")
        self.tool("ffmpeg", "")
        process = subprocess.Popen([PROGRAM, "render", "run.html", "--animate", "a.gif"], cwd=self.folder,
                                   env=self.tool("rsvg-convert", waits), stderr=subprocess.PIPE)
        seen = self.folder / "seen"
        deadline = time.monotonic() + 60
        while not seen.exists():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertEqual({path.name for path in self.folder.iterdir()}, {"p.csv", "run.html", "bin", "seen"})
        child = pathlib.Path("/proc") / seen.read_text(encoding="utf-8")
        while child.exists() and child.joinpath("stat").read_text(encoding="utf-8").split(") ")[1][0] != "Z":
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)

    def test_progress_is_on_standard_error(self):
        self.tool("rsvg-convert", "import sys\nsys.stdout.write(sys.stdin.read())")
        writes = "import sys\nif '-version' not in sys.argv: open(sys.argv[-1][5:], 'w').write('film')"
        done = self.run_("render", "run.html", "--animate", "a.gif", "--progress", "always", "--fps", 2,
                         env=self.tool("ffmpeg", writes))
        self.assertEqual(done.stdout, "")
        self.assertRegex(done.stderr, r"frame \d+ of 13")
        self.assertEqual((self.folder / "a.gif").read_text(encoding="utf-8"), "film")


class Bad_input(Rendering):
    def setUp(self):
        super().setUp()
        self.uniform()

    def expect(self, message, *arguments):
        before = sorted(path.name for path in self.folder.iterdir())
        done = self.run_("render", *arguments, expected=2)
        self.assertIn(message, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), before)

    def test_command_lines(self):
        run = ("run.html", "-o", "a.svg")
        self.expect("there is nothing to write", "run.html")
        self.expect("--at: 7 is outside of the run; expected a time from 0 to 6", *run, "--at", "7")
        self.expect("--view: t: '7' is not possible; expected a time of the run, from 0 to 6", *run, "--view", "t=7")
        self.expect("--view: 'colour' is unknown; expected t, event", *run, "--view", "colour=area")
        self.expect("--view: color: 'red' is not possible; expected one of none, area", *run, "--view", "color=red")
        self.expect("--view: color: 'size' is not possible; expected one of none, area, density, speed, degree, "
                    "changes", *run, "--view", "color=size")
        self.expect("--view: show: 'discs' is not possible; expected of delaunay", *run, "--view", "show=hull,discs")
        self.expect("--view: point: '50' is not possible", *run, "--view", "point=50")
        self.expect("--view: edge: '1-77' is not possible; expected ids from 0 to 49", *run, "--view", "edge=77-1")
        self.expect("--output: a.jpg has an unknown ending; expected a name that ends with .svg or .png",
                    "run.html", "-o", "a.jpg")
        self.expect("--width: 8 is out of range; expected a number from 16 to 16384", *run, "--width", "8")
        shutil.copy(self.folder / "run.html", self.folder / "run.svg")
        self.expect("run.svg is the input; expected another file", "run.svg", "-o", "run.svg")

    def test_files(self):
        page = (self.folder / "run.html").read_text(encoding="utf-8")
        self.expect("none.html: cannot be opened: No such file or directory; expected a readable file of a run",
                    "none.html", "-o", "a.svg")
        self.write("p.html", "<html></html>")
        self.expect("p.html: has no recording; expected a page that --html has written", "p.html", "-o", "a.svg")
        self.write("p.html", page[: page.index(BEGIN) + 500])
        self.expect("p.html: ends within its recording", "p.html", "-o", "a.svg")
        self.write("p.html", page.replace('"format":2', '"format":3'))
        self.expect("p.html: recording.format is not 2", "p.html", "-o", "a.svg")
        self.expect("p.csv: has no recording", "p.csv", "-o", "a.svg")
        for path in ("/dev/zero", "/dev/null"):
            self.expect(f"{path}: has no recording", path, "-o", "a.svg")
        self.expect("/proc/self/mem: cannot be read to its end", "/proc/self/mem", "-o", "a.svg")
        done = subprocess.run([PROGRAM, "render", "-", "-o", "-"], cwd=self.folder, input=page, capture_output=True,
                              text=True, check=True)
        self.assertEqual(len(Picture(done.stdout).circles("points")), 50)


def luminance(color):
    red, green, blue = (int(color[i:i + 2], 16) for i in (1, 3, 5))
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def area_of_cell(i, points, side):
    """The exact area of a Voronoi cell in the square, by all bisectors."""
    polygon = [(Fraction(0), Fraction(0)), (Fraction(side), Fraction(0)), (Fraction(side), Fraction(side)),
               (Fraction(0), Fraction(side))]
    px, py = points[i]
    for k, (qx, qy) in enumerate(points):
        if k == i:
            continue

        def depth(place):
            return (place[0] - qx) ** 2 + (place[1] - qy) ** 2 - (place[0] - px) ** 2 - (place[1] - py) ** 2

        cut = []
        for a, b in zip(polygon, polygon[1:] + polygon[:1]):
            here, there = depth(a), depth(b)
            if here >= 0:
                cut.append(a)
            if (here >= 0) != (there >= 0):
                share = here / (here - there)
                cut.append((a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])))
        polygon = cut
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(polygon, polygon[1:] + polygon[:1]))) / 2


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
