#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs in periodic boxes from outside: logs and edges with offsets, compared with copies of the points in the
plane, which other code triangulates; pictures and pages; runs in parts; what is said and refused; --verify.

usage: periodic_test.py PROGRAM
"""
import csv
import io
import itertools
import json
import math
import random
import re
import sys
import unittest

sys.dont_write_bytecode = True
from periodic_case import Program_in_box, edge_of, edges_in  # noqa: E402

HEADER = "x,y,vx,vy\n"


def text_of(points):
    return HEADER + "".join(",".join(map(repr, point)) + "\n" for point in points)


def random_points(generator, number, side):
    """Multiples of 1/8, in the box or not."""
    def coordinate(least, most):
        return generator.randint(8 * least, 8 * most) / 8

    return [(coordinate(-side, 2 * side), coordinate(-side, 2 * side), coordinate(-2, 2), coordinate(-2, 2))
            for _ in range(number)]


class Periodic(Program_in_box):
    def test_one_point_in_a_sheared_box(self):
        """The log is that of docs/guide/periodic_boxes.md."""
        run = "simulate p.csv --until 2 --periodic 1,1 --shear 1 --quiet "
        done = self.run_program(run + "--events e.csv --initial-edges i.csv --edges f.csv --audit events",
                                HEADER + "0.5,0.5,0,0\n")
        self.assertEqual((done.stdout, done.stderr), ("", ""))
        self.assertEqual(
            self.read("e.csv"),
            "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b,instant,"
            "removed_offset,added_offset\n"
            "0,flip,1,1,1,0,0,0,0,,,0,0 1,2 -1\n"
            "1,flip,2,2,2,0,0,0,0,,,1,1 -1,3 -1\n")
        self.assertEqual(self.read("i.csv"), "a,b,offset\n0,0,0 1\n0,0,1 -1\n0,0,1 0\n")
        self.assertEqual(self.read("f.csv"), "a,b,offset\n0,0,1 0\n0,0,2 -1\n0,0,3 -1\n")
        # The same box, by its vector at time 0.
        self.run_program("simulate p.csv --until 1 --from 0.5 --periodic 1,1,2 --shear=-1 --events e.csv")
        self.assertEqual([row["time"] for row in self.rows()], ["1"])

    def test_log_leads_from_the_first_edges_to_the_last(self):
        rows = 0
        for seed in range(6):
            generator = random.Random(seed)
            points = text_of(random_points(generator, 2 + 5 * seed, 4))
            shear = generator.choice([0, 0.25, -1])
            done = self.run_program(
                f"simulate p.csv --until 3 --periodic 4,5,1 --shear {shear} --events e.csv --initial-edges i.csv "
                "--edges f.csv --motions m.csv --audit events --verify", points)
            self.assertRegex(done.stdout, r"^verified: \d+ points, \d+ events, \d+ certificates\n$")
            edges = set(edges_in(self.read("i.csv")))
            self.assertEqual(len(edges), 3 * (2 + 5 * seed))
            for row in self.rows():
                rows += 1
                self.assertIn(row["kind"], ("flip", "rebuild"))
                removed, added = edge_of(row, "removed"), edge_of(row, "added")
                if removed:
                    edges.remove(removed)
                if added:
                    self.assertNotIn(added, edges)
                    edges.add(added)
            self.assertEqual(sorted(edges), edges_in(self.read("f.csv")))
            self.assertEqual(self.read("m.csv").count("\n"), 1 + 2 + 5 * seed)
        self.assertGreater(rows, 300)

    def test_edges_are_those_of_copies_in_the_plane(self):
        """The triangulation of many copies, far from their border."""
        reach = 3
        compared = 0
        for seed in range(3):
            generator = random.Random(seed)
            points = [(x % 8, y % 8, vx, vy) for x, y, vx, vy in random_points(generator, 5, 8)]
            shear = generator.choice([0.25, 0.5])
            offsets = list(itertools.product(range(-reach, reach + 1), repeat=2))
            copies = [(x + 8 * k, y + 8 * l, vx + shear * 8 * l, vy)
                      for x, y, vx, vy in points for k, l in offsets]
            self.write("copies.csv", text_of(copies))
            for until in (0.5, 1.25, 2):
                self.run_program(f"simulate p.csv --until {until} --periodic 8,8 --shear {shear} --edges f.csv",
                                 text_of(points))
                self.run_program(f"simulate copies.csv --until {until} --edges plane.csv")
                images = [(i, offset) for i in range(len(points)) for offset in offsets]
                expected = set()
                for row in csv.DictReader(io.StringIO(self.read("plane.csv"))):
                    (a, o), (b, p) = images[int(row["a"])], images[int(row["b"])]
                    if (0, 0) not in (o, p):
                        continue
                    offset = p[0] - o[0], p[1] - o[1]
                    reverse = -offset[0], -offset[1]
                    if a == b:
                        offset = max(offset, reverse)
                    expected.add((a, b, offset))
                self.assertEqual(edges_in(self.read("f.csv")), sorted(expected), (seed, until))
                compared += len(expected)
        self.assertEqual(compared, 3 * 3 * 15)

    def test_positions_need_not_be_in_the_box(self):
        """The image of a point has the same times; the offsets are against the position as it is given."""
        points = [(0.5, 1, 1, 0.5), (3, 2.25, -1, 0.25), (1, 3.5, 0.5, -1)]
        far = [(0.5 + 4 * 3, 1, 1, 0.5), (3 - 1 * 2, 2.25 + 5 * 2, -1, 0.25), points[2]]  # by (3, 0), (-1, 2)
        run = "simulate p.csv --until 4 --periodic 4,5,1 --quiet --edges f.csv --events e.csv"
        moves = [(3, 0), (-1, 2), (0, 0)]
        self.run_program(run, text_of(points))
        expected = sorted((a, b, (x - moves[b][0] + moves[a][0], y - moves[b][1] + moves[a][1]))
                          for a, b, (x, y) in edges_in(self.read("f.csv")))
        times = [row["time"] for row in self.rows()]
        self.assertGreater(len(times), 5)
        self.run_program(run, text_of(far))
        self.assertEqual(edges_in(self.read("f.csv")), expected)
        self.assertEqual([row["time"] for row in self.rows()], times)

    def test_points_that_are_images_of_others_are_hidden(self):
        points = HEADER + "0,0,0,0\n6,8,1,0\n1,1,0,0\n"  # 1 is 0, moved by (1, 2) of (4, 0) and (1 + t/2, 4)
        box = "--until 2 --periodic 4,4,1 --shear 0.125 --edges f.csv --verify"
        done = self.run_program(f"simulate p.csv {box}", points)
        self.assertIn("coincident   1 point at the start, the first is 1, with 0\n", done.stderr)
        self.assertIn("verified: 3 points", done.stdout)
        self.assertEqual({a for a, b, _ in edges_in(self.read("f.csv"))}, {0, 2})
        refused = self.run_program(f"simulate p.csv {box} --coincident refuse", code=2)
        self.assertIn("p.csv:3: the point is an image of the one in line 2 at all times", refused.stderr)

    def test_what_a_run_says(self):
        points = text_of(random_points(random.Random(7), 20, 4))
        done = self.run_program("simulate p.csv --until 3 --periodic 4,4 --stats s.json --audit end", points)
        self.assertIn("kinetri: 20 points from t = 0 to 3\n", done.stderr)
        self.assertIn("1 run, 0 failed\n", done.stderr)
        self.assertIn("written      s.json\n", done.stderr)
        stats = json.loads(self.read("s.json"))
        self.assertEqual((stats["points"], stats["until"], stats["reached"]), (20, 3, 3))
        self.assertEqual(stats["events_total"], stats["events"]["flip"] + stats["events"]["rebuild"])
        self.assertGreater(stats["events_total"], 10)
        exact = self.run_program("simulate p.csv --until 3 --periodic 4,4 --events - --quiet --exact-only")
        threads = self.run_program("simulate p.csv --until 3 --periodic 4,4 --events - --quiet --threads 1")
        self.assertEqual(exact.stdout, threads.stdout)
        # Without points there is nothing.
        self.run_program("simulate p.csv --until 3 --periodic 4,4 --edges f.csv --verify", HEADER)
        self.assertEqual(self.read("f.csv"), "a,b,offset\n")

    def test_runs_that_end_early(self):
        points = text_of(random_points(random.Random(7), 20, 4))
        run = "simulate p.csv --until 3 --periodic 4,4 --events e.csv --edges f.csv --verify --quiet"
        done = self.run_program(run + " --max-events 5", points, code=130)
        self.assertRegex(done.stderr, "^kinetri: more than 5 events, and the run ends at t = .* instead of 3; ")
        self.assertIn("verified: 20 points, 6 events", done.stdout)
        # A point leaves the offsets that are possible: nothing is written then.
        (self.folder / "e.csv").unlink()
        failed = self.run_program("simulate p.csv --until 2 --periodic 1,1 --events e.csv",
                                  HEADER + "0,0,0,0\n2147483000.5,0.25,1000,0\n", code=2)
        self.assertIn("vectors of the box; expected less than 2^31 of each", failed.stderr)
        self.assertFalse((self.folder / "e.csv").exists())

    def test_pictures_show_the_box_and_all_edges(self):
        points = text_of(random_points(random.Random(3), 12, 4))
        self.run_program("simulate p.csv --until 2 --periodic 4,5,1 --shear 0.5 --frames f --vtu v --frames-per-time 2 "
                         "--edges e.csv", points)
        self.assertEqual(sorted(path.name for path in (self.folder / "f").iterdir()),
                         [f"frame_00000{i}.svg" for i in range(5)])
        self.assertEqual(len(list((self.folder / "v").iterdir())), 6)
        for i in range(5):
            drawing = self.read(f"f/frame_00000{i}.svg")
            self.assertIn(f"<title>t = {i / 2:g}</title>", drawing)
            box, within, leaving = (re.search(f'<path class="{name}".*? d="([^"]*)"', drawing)[1]
                                    for name in ("box", "edges", "leaving-edges"))
            # An edge that leaves the box is there twice.
            self.assertEqual(2 * within.count("M") + leaving.count("M"), 2 * 3 * 12)
            self.assertGreater(leaving.count("M"), 4)
            # The second side leans by 1 + 0.5 * 5 t, less the width of the box as often as possible.
            corners = [tuple(map(float, corner.split(" "))) for corner in re.findall(r"[ML]([^MLZ]*)", box)]
            width, height = corners[1][0] - corners[0][0], corners[0][1] - corners[3][1]
            lean = (corners[3][0] - corners[0][0]) / height * 5
            self.assertAlmostEqual(height / width, 5 / 4, 3)
            tilt = 1 + 2.5 * i / 2
            self.assertAlmostEqual(lean, tilt - 4 * round(tilt / 4), 1)
            self.assertEqual(drawing.count("<circle "), 12 + leaving.count("M"))
            file = self.read(f"v/frame_00000{i}.vtu")
            self.assertIn('NumberOfCells="24"', file)

    def test_page_is_drawn_without_a_browser(self):
        points = text_of(random_points(random.Random(3), 12, 4))
        run = "simulate p.csv --until 2 --periodic 4,5,1 --shear 0.5 --html r.html --quiet"
        self.run_program(run, points)
        page = self.read("r.html")
        recording = json.loads(re.search('id="recording">(.*?)</script>', page)[1])
        self.assertEqual(recording["format"], 3)
        self.assertEqual(recording["periodic"], [0, 4, 0, 0, 0, 0, 1, 5, 2.5, 0])
        self.run_program("render r.html --at 1 --output p.svg --view show=voronoi,trails,arrows&color=area")
        drawing = self.read("p.svg")
        for name in ("box", "edges", "leaving-edges", "images", "voronoi", "trails", "arrows", "colors"):
            self.assertIn(f'class="{name}"', drawing)
        refused = self.run_program("render r.html --output p.svg --view show=hull", code=2)
        self.assertIn("show: 'hull' is not possible", refused.stderr)
        # The same run gives the same bytes.
        self.run_program(run)
        self.assertEqual(self.read("r.html"), page)

    def test_selected_edge_may_be_named_with_its_offset(self):
        """One point: its three edges differ by their offsets only."""
        self.run_program("simulate p.csv --until 0.5 --periodic 1,1 --shear 1 --html r.html --quiet",
                         HEADER + "0.5,0.5,0,0\n")
        drawn = set()
        for offset in ("0,1", "1,-1", "1,0"):
            self.run_program(f"render r.html --at 0 --output p.svg --view edge=0-0,{offset}")
            selected = re.findall(r'class="selected"[^>]* d="([^"]*)"', self.read("p.svg"))
            self.assertEqual(len(selected), 2)
            drawn.add(selected[0])
        self.assertEqual(len(drawn), 3)
        refused = self.run_program("render r.html --output p.svg --view edge=0-0,1", code=2)
        self.assertIn("edge: '0-0,1' is not possible", refused.stderr)

    def dump(self, points, times, columns="id x y", present=lambda i, t: True, name="d.lammpstrj"):
        """Writes a dump of the points, which move on straight lines, in a box of 8 and 10, tilted by 2. Numbers are
        exact."""
        lines = []
        for t in times:
            atoms = [i for i in range(len(points)) if present(i, t)]
            lines += ["ITEM: TIMESTEP", str(t), "ITEM: NUMBER OF ATOMS", str(len(atoms)),
                      "ITEM: BOX BOUNDS xy xz yz pp pp pp", "0 10 2", "0 10 0", "-1 1 0", f"ITEM: ATOMS {columns}"]
            for i in atoms:
                x, y, vx, vy = points[i]
                x, y = x + vx * t, y + vy * t
                l = math.floor(y / 10)
                k = math.floor((x - 2 * l - (y - 10 * l) / 5) / 8)
                values = {"id": i, "x": x - 8 * k - 2 * l, "y": y - 10 * l, "ix": k, "iy": l, "xu": x, "yu": y}
                lines.append(" ".join(str(values[column]) for column in columns.split()))
        self.write(name, "\n".join(lines) + "\n")

    def test_tracks_are_the_run_of_their_motions(self):
        """Straight motions, of which a dump has places: the same events and edges as those of the motions. All points
        begin in the box, so that offsets are against the same positions."""
        generator = random.Random(11)
        points = [(x % 5 + 2, y % 8 + 1, vx, vy) for x, y, vx, vy in random_points(generator, 15, 8)]
        outputs = "--events e.csv --edges f.csv --initial-edges i.csv --quiet --audit end"
        self.run_program(f"simulate p.csv --until 4 --periodic 8,10,2 {outputs}", text_of(points))
        flips = [(row["time"], edge_of(row, "removed"), edge_of(row, "added")) for row in self.rows() if row["kind"] == "flip"]
        edges, initial = edges_in(self.read("f.csv")), edges_in(self.read("i.csv"))
        self.assertGreater(len(flips), 30)
        for columns in ("id x y", "id x y ix iy", "id xu yu"):
            self.dump(points, range(6), columns)
            self.run_program(f"tracks d.lammpstrj --periodic --until 4 {outputs}")
            found = [(row["time"], edge_of(row, "removed"), edge_of(row, "added"))
                     for row in self.rows() if row["kind"] == "flip"]
            self.assertEqual([time for time, *_ in found], [time for time, *_ in flips], columns)
            self.assertEqual(found, flips, columns)
            self.assertEqual(edges_in(self.read("f.csv")), edges)
            self.assertEqual(edges_in(self.read("i.csv")), initial)
            # Motions go on as before at each frame, which the log says all the same.
            self.assertEqual(sum(row["kind"] == "trajectory" for row in self.rows()), 4 * len(points))

    def test_tracks_of_discs_have_the_contacts_of_their_motions(self):
        """At a frame a disc gets its motion again; discs that overlap and approach then have a contact at that time."""
        generator = random.Random(13)
        points = [(x % 5 + 2, y % 8 + 1, vx, vy) for x, y, vx, vy in random_points(generator, 12, 8)]
        self.dump(points, range(6))
        discs = "--collisions log --radius 0.75 --events e.csv --quiet --audit end --verify"

        def contacts():
            return [(row["time"], row["point_a"], row["point_b"], row["added_offset"]) for row in self.rows()
                    if row["kind"] == "collision"]

        self.run_program(f"simulate p.csv --until 4 --periodic 8,10,2 {discs}", text_of(points))
        expected = contacts()
        self.assertGreater(len(expected), 20)
        self.run_program(f"tracks d.lammpstrj --periodic --until 4 {discs}")
        found = contacts()
        self.assertEqual([row for row in found if float(row[0]) % 1 or row in expected], expected)
        wide = self.run_program("tracks d.lammpstrj --periodic --collisions log --radius 4.5", code=2)
        self.assertIn("meets its own image", wide.stderr)

    def test_tracks_that_come_and_go(self):
        generator = random.Random(12)
        points = [(x % 5 + 2, y % 8 + 1, vx, vy) for x, y, vx, vy in random_points(generator, 12, 8)]
        self.dump(points, range(6), present=lambda i, t: i % 3 == 0 or (t > 1 if i % 3 == 1 else t < 4))
        done = self.run_program("tracks d.lammpstrj --periodic --events e.csv --edges f.csv --ids n.csv --html r.html "
                                "--frames f --audit events --verify")
        self.assertIn("0 failed", done.stderr)
        self.assertIn("verified: ", done.stdout)
        kinds = [row["kind"] for row in self.rows()]
        self.assertEqual((kinds.count("insert"), kinds.count("erase")), (4, 12))
        self.assertEqual(edges_in(self.read("f.csv")), [])
        self.assertEqual(self.read("n.csv").splitlines()[0], "point,id,first,last")
        self.run_program("render r.html --at 2.5 --output p.svg")
        # From 2 on all twelve are there.
        self.run_program("tracks d.lammpstrj --periodic --until 2.5 --edges f.csv --quiet")
        self.assertEqual(len(edges_in(self.read("f.csv"))), 3 * 12)

    def test_tracks_without_one_periodic_box_are_refused(self):
        points = [(1, 1, 1, 0), (4, 4, 0, 1), (2, 7, 1, 1)]
        self.dump(points, range(3))
        text = self.read("d.lammpstrj")
        self.write("d.lammpstrj", text.replace("pp pp pp", "pp ff pp"))
        refused = self.run_program("tracks d.lammpstrj --periodic", code=2)
        self.assertIn("d.lammpstrj: has no box that is periodic in two directions of the plane", refused.stderr)
        at = text.rindex("0 10 2")
        self.write("d.lammpstrj", text[:at] + "0 11 2" + text[at + 6:])
        refused = self.run_program("tracks d.lammpstrj --periodic", code=2)
        self.assertRegex(refused.stderr, r"d.lammpstrj:\d+: the box differs from that of the frames before")
        self.write("t.csv", "t,id,x,y\n0,a,0,0\n1,a,1,1\n")
        refused = self.run_program("tracks t.csv --periodic", code=2)
        self.assertIn("t.csv: has no periodic box", refused.stderr)

    def test_a_run_in_parts_is_the_run_in_one(self):
        one_radius = self.discs("", lambda _: "")
        sizes = self.discs(",radius,growth", lambda generator: f",{generator.choice([0.125, 0.25, 0.5])},{generator.choice([0, 0.03125])}")
        free = text_of(random_points(random.Random(4), 20, 10))
        twice = free + "".join(f"{float(x) + 13},{float(y) + 10},{float(vx) + 0.5 * 10},{vy}\n"  # by (1, 1) vectors
                               for x, y, vx, vy in (line.split(",") for line in free.splitlines()[1:4]))
        box = "--periodic 10,10,3"
        rows = 0
        for points, options in ((free, box), (twice, box + " --shear 0.5"), (free, box + " --shear=-0.3"),
                                (one_radius, box + " --radius 0.5 --collisions elastic --shear 0.25"),
                                (one_radius, box + " --radius 0.75 --collisions log"),
                                (one_radius, box + " --radius 0.5 --collisions stop --shear 0.25"),
                                (one_radius, box + " --radius 0.5 --collisions remove"),
                                (sizes, box + " --collisions elastic --mass area --shear 0.1"),
                                (sizes, box + " --collisions log")):
            run = f"simulate p.csv --quiet {options}"
            self.run_program(f"{run} --until 3 --events whole.csv --motions wm.csv --edges edges.csv", points)
            self.run_program(f"{run} --until 0.9 --events one.csv --motions m.csv --checkpoint a")
            self.run_program("resume a --until 0.9 --events two.csv --checkpoint b --edges now.csv --quiet")
            self.run_program("resume b --until 1.8 --events three.csv --checkpoint c --audit end --quiet")
            self.run_program("resume c --until 3 --events four.csv --motions fm.csv --edges end.csv --exact-only --quiet")
            logs = [self.read(name).splitlines() for name in ("one.csv", "two.csv", "three.csv", "four.csv")]
            self.assertEqual(len({log[0] for log in logs}), 1)
            self.assertEqual(logs[1], logs[0][:1])
            self.assertGreater(min(len(logs[0]), len(logs[2]), len(logs[3])), 10, options)
            self.assertEqual([row for log in logs for row in log[1:]], self.read("whole.csv").splitlines()[1:], options)
            self.assertEqual(self.read("end.csv"), self.read("edges.csv"), options)
            last = [row for row in self.read("fm.csv").splitlines()[1:] if row[0] != ","]
            self.assertEqual(last, self.read("wm.csv").splitlines()[-len(last):] if last else [])
            rows += len(logs[3])
        self.assertGreater(rows, 500)

    def test_a_continued_run_is_verified_and_has_pictures(self):
        box = "--periodic 10,10,3 --shear 0.1"
        self.run_program(f"simulate p.csv --until 1 {box} --checkpoint a", text_of(random_points(random.Random(4), 20, 10)))
        done = self.run_program("resume a --until 2 --verify --html r.html --frames f --frames-per-time 1 --stats s.json")
        self.assertRegex(done.stdout, r"^verified: 20 points, \d+ events")
        self.assertGreater(json.loads(self.read("s.json"))["events_total"], int(done.stdout.split(" ")[3]))
        recording = json.loads(re.search('id="recording">(.*?)</script>', self.read("r.html"))[1])
        self.assertEqual(recording["periodic"], [0, 10, 0, 0, 0, 0, 3, 10, 1, 0])
        self.write("p.csv", self.discs(",radius", lambda generator: f",{generator.choice([0.25, 0.5])}"))
        self.run_program(f"simulate p.csv --until 1 {box} --checkpoint a --collisions elastic")
        done = self.run_program("resume a --until 2 --verify")
        self.assertRegex(done.stdout, r"^verified: 25 points, \d+ events")

    def test_a_run_that_has_ended_at_an_own_image_cannot_go_on(self):
        end = "the run ends at t = 1.75 instead of 3; results up to then are written; disc 0 meets its own image"
        done = self.run_program("simulate p.csv --until 3 --periodic 4,5 --collisions elastic --checkpoint a --quiet",
                                "x,y,vx,vy,radius,growth\n0,0,0,0,0.25,1\n2,2,0,0,0.125,0\n", code=130)
        self.assertIn(end, done.stderr)
        done = self.run_program("resume a --until 3 --events e.csv --quiet", code=130)
        self.assertIn(end, done.stderr)
        self.assertEqual(self.rows(), [])

    def test_logs_in_the_plane_have_no_offsets(self):
        self.run_program("simulate p.csv --until 3 --events e.csv --edges f.csv",
                         HEADER + "0,0,0,0\n4,0,0,0\n0,4,0,0\n3,3,1,1\n")
        self.assertEqual(self.read("e.csv").splitlines()[0],
                         "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b,instant")
        self.assertEqual(self.read("f.csv").splitlines()[0], "a,b")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
