#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables about runs in periodic boxes from outside: lifetimes of edges against the log, areas against the box.

usage: periodic_answers_test.py PROGRAM
"""
import collections
import csv
import io
import pathlib
import random
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
from in_folder import In_folder  # noqa: E402

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
HEADER = "x,y,vx,vy\n"


def random_points(seed, number):
    """Multiples of 1/8, in the box or not."""
    generator = random.Random(seed)
    rows = [[generator.randint(-32, 64) / 8, generator.randint(-32, 64) / 8, generator.randint(-16, 16) / 8,
             generator.randint(-16, 16) / 8] for _ in range(number)]
    return HEADER + "".join(",".join(map(str, row)) + "\n" for row in rows)


class Periodic_answers(In_folder):
    def run_program(self, command, points, code=0):
        self.write("p.csv", points)
        done = subprocess.run([PROGRAM, *command.split(), "--quiet"], cwd=self.folder, text=True, capture_output=True,
                              stdin=subprocess.DEVNULL, timeout=300, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def table(self, name):
        text = (self.folder / name).read_text(encoding="utf-8")
        return list(csv.DictReader(io.StringIO(text)))

    def header(self, name):
        return (self.folder / name).read_text(encoding="utf-8").splitlines()[0]

    def lives_by_log(self, until):
        """The lifetimes by the edges at the start and the log; rows at one exact time have one instant."""
        present = {(r["a"], r["b"], r["offset"]): ("0", "0") for r in self.table("i.csv")}
        lives = []
        for rows in self.instants():
            change = collections.Counter()
            for row in rows:
                for what, count in (("removed", -1), ("added", 1)):
                    if row[what + "_a"]:
                        change[row[what + "_a"], row[what + "_b"], row[what + "_offset"]] += count
            time = rows[0]["time_lo"], rows[0]["time_hi"]
            for edge, count in change.items():
                if count < 0:
                    lives.append((*edge, *present.pop(edge), *time))
                if count > 0:
                    present[edge] = time
        lives += [(*edge, *begin, until, until) for edge, begin in present.items()]
        return sorted(life for life in lives if life[3:5] != life[5:7])

    def instants(self):
        rows = collections.defaultdict(list)
        for row in self.table("e.csv"):
            rows[int(row["instant"])].append(row)
        return [rows[instant] for instant in sorted(rows)]

    def test_neighbors_are_those_of_the_log(self):
        lives = exchanged = own = 0
        for seed in range(6):
            number = 1 + 3 * seed
            self.run_program("simulate p.csv --until 3 --periodic 4,5,1 --shear 0.5 --events e.csv "
                             "--initial-edges i.csv --neighbors n.csv --exchanges x.csv --ridge 0.5",
                             random_points(seed, number))
            self.assertEqual(self.header("n.csv"),
                             "a,b,offset,begin_lo,begin_hi,end_lo,end_hi,begins_by,ends_by,short")
            table = self.table("n.csv")
            columns = "a,b,offset,begin_lo,begin_hi,end_lo,end_hi".split(",")
            self.assertEqual(sorted(tuple(row[c] for c in columns) for row in table), self.lives_by_log("3"))
            gained, lost = collections.Counter(), collections.Counter()
            for row in table:
                own += row["a"] == row["b"]
                for id in (row["a"], row["b"]):
                    gained[id] += row["begins_by"] == "exchange"
                    lost[id] += row["ends_by"] == "exchange"
            for row in self.table("x.csv"):
                self.assertEqual((int(row["gained"]), int(row["lost"])), (gained[row["id"]], lost[row["id"]]))
                exchanged += int(row["gained"])
            lives += len(table)
        self.assertGreater(lives, 200)
        self.assertGreater(exchanged, 100)
        self.assertGreater(own, 5)

    def test_areas_have_the_sum_of_the_box(self):
        self.run_program("simulate p.csv --until 2 --periodic 4,5,1 --shear 0.5 --areas a.csv --fps 2 "
                         "--mean-areas m.csv", random_points(7, 9))
        sums = collections.Counter()
        for row in self.table("a.csv"):
            sums[row["t"]] += float(row["area"])
        self.assertEqual(len(sums), 5)
        for total in sums.values():
            self.assertAlmostEqual(total, 20, places=12)
        means = self.table("m.csv")
        self.assertAlmostEqual(sum(float(row["area"]) for row in means), 20,
                               delta=sum(float(row["error"]) for row in means))
        self.run_program("simulate p.csv --until 2 --periodic 4,5,1 --areas a.csv --cutoff 0.25", random_points(7, 2))
        self.assertTrue(all(float(row["area"]) < 0.19635 for row in self.table("a.csv")))

    def test_discs_have_power_cells_and_lives(self):
        points = "x,y,vx,vy,radius\n0,0,0,0,2\n4,0,0,0,1\n"
        self.run_program("simulate p.csv --until 1 --periodic 8,8 --collisions log --areas a.csv --fps 1 "
                         "--neighbors n.csv", points)
        self.assertEqual([float(row["area"]) for row in self.table("a.csv")], [38, 26, 38, 26])
        self.assertEqual(len(self.table("n.csv")), 6)

    def test_nearest_and_components_have_offsets(self):
        self.run_program("simulate p.csv --until 9 --periodic 10,10 --nearest n.csv --components c.csv --range 1",
                         HEADER + "9,5,1,0\n4,5,0,0\n")
        self.assertEqual(self.header("n.csv"), "time_lo,time_hi,id,before,before_offset,after,after_offset")
        first = self.table("n.csv")[0]
        self.assertEqual((first["before"], first["before_offset"], first["after"]), ("", "", "1"))
        self.assertEqual(self.header("c.csv"), "time_lo,time_hi,kind,a,b,offset,components,largest,wrapping")
        rows = [(r["kind"], r["a"], r["b"], r["offset"], r["time_lo"], r["wrapping"]) for r in self.table("c.csv")]
        self.assertEqual(rows, [("start", "", "", "", "0", "0"), ("merge", "0", "1", "1 0", "4", "0"),
                                ("split", "0", "1", "1 0", "6", "0")])
        self.run_program("simulate p.csv --until 3 --periodic 4,4 --components c.csv --range 3",
                         HEADER + "0,0,1,0\n2,0,0,0\n")
        self.assertIn("unwrap", [row["kind"] for row in self.table("c.csv")])

    def gas(self, seed, side=6):
        """A disc in each unit square of a box of this side, with its velocity."""
        generator = random.Random(seed)
        rows = [[i + generator.random() / 4, j + generator.random() / 4, generator.uniform(-1, 1), generator.uniform(-1, 1)]
                for i in range(side) for j in range(side)]
        return HEADER + "".join(",".join(map(repr, row)) + "\n" for row in rows)

    GAS = "simulate p.csv --periodic 6,6 --radius 0.3 --collisions elastic"

    def test_spanning_tree_has_offsets(self):
        self.run_program("simulate p.csv --until 12 --periodic 10,10 --spanning-tree s.csv",
                         HEADER + "1,2,0,0\n2,2,1,0\n")
        self.assertEqual(self.header("s.csv"), "time_lo,time_hi,kind,a,b,offset,length")
        rows = [(r["time_lo"], r["kind"], r["a"], r["b"], r["offset"], r["length"]) for r in self.table("s.csv")]
        self.assertEqual(rows, [("0", "start", "0", "1", "0 0", ""), ("0", "longest", "0", "1", "0 0", "1"),
                                ("4", "remove", "0", "1", "0 0", ""), ("4", "add", "0", "1", "-1 0", ""),
                                ("4", "longest", "0", "1", "-1 0", "5"), ("9", "least", "0", "1", "-1 0", "0"),
                                ("4", "greatest", "0", "1", "0 0", "5")])

    def test_closest_approaches_of_tracks_have_offsets(self):
        frames = []
        for step, places in ((0, ((1, 9), (2, 1))), (10, ((1, 4), (2, 6)))):
            atoms = "".join(f"{i + 1} 1 {x} {y} 0\n" for i, (x, y) in enumerate(places))
            frames.append(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 10\n0 10\n0 1\n"
                          f"ITEM: ATOMS id type x y z\n{atoms}")
        self.write("d.lammpstrj", "".join(frames))
        # The atoms go 5 apart from each other, or toward each other: both ways are half of the box.
        done = self.run_program("tracks d.lammpstrj --periodic --closest 2", "", code=2)
        self.assertIn("d.lammpstrj", done.stderr)
        self.write("d.lammpstrj", "".join(frames).replace("1 1 1 4 0", "1 1 1 5 0").replace("2 1 2 6 0", "2 1 2 5 0"))
        done = self.run_program("tracks d.lammpstrj --periodic --closest 2", "")
        rows = list(csv.DictReader(io.StringIO(done.stdout)))
        self.assertEqual(done.stdout.splitlines()[0], "id_a,id_b,offset,time,time_lo,time_hi,distance")
        self.assertEqual([(r["id_a"], r["id_b"], r["offset"], r["time"], r["distance"]) for r in rows[:2]],
                         [("1", "2", "0 0", "10", "1"), ("1", "2", "0 1", "0", "2.23606797749979")])

    def test_pressure_in_intervals(self):
        self.run_program(f"{self.GAS} --until 3 --pressure p.csv.out --fps 4 --events e.csv", self.gas(1))
        self.assertEqual(self.header("p.csv.out"), "from,until,collisions,energy,pressure,xx,xy,yy")
        rows = [{name: float(text) for name, text in row.items()} for row in self.table("p.csv.out")]
        self.assertEqual([row["until"] for row in rows], [k / 4 for k in range(1, 13)])
        self.assertEqual([row["from"] for row in rows], [k / 4 for k in range(12)])
        contacts = collections.Counter(float(row["time"]) // 0.25 for row in self.table("e.csv") if row["kind"] == "collision")
        self.assertEqual([row["collisions"] for row in rows], [contacts[k] for k in range(12)])
        for row in rows:
            self.assertAlmostEqual(row["energy"], rows[0]["energy"], places=9)  # the box is at rest
            self.assertAlmostEqual(row["pressure"], (row["xx"] + row["yy"]) / 2, places=12)
            self.assertGreater(row["pressure"] * 36, row["energy"])
        self.run_program(f"{self.GAS} --until 3 --pressure p.csv.out", self.gas(1))
        self.assertEqual(len(self.table("p.csv.out")), 100)
        for until, ends in (("2.5", ["1", "2", "2.5"]), ("0.5", ["0.5"]), ("0", [])):
            self.run_program(f"{self.GAS} --until {until} --pressure p.csv.out --fps 1", self.gas(1))
            self.assertEqual(self.header("p.csv.out"), "from,until,collisions,energy,pressure,xx,xy,yy")
            self.assertEqual([row["until"] for row in self.table("p.csv.out")], ends)

    def test_thermostat_keeps_the_energy(self):
        shear = f"{self.GAS} --shear 0.5"
        energies = []
        for more in ("", " --thermostat 8"):
            self.run_program(f"{shear} --until 4 --pressure p.csv.out --fps 8 --events e.csv --edges t.csv --motions m.csv "
                             f"--verify{more}", self.gas(2))
            energies.append([float(row["energy"]) for row in self.table("p.csv.out")])
        heated, kept = energies
        self.assertGreater(heated[-1], 1.3 * heated[0])
        start = self.energy(self.gas(2), 0.5)
        for energy in kept:
            self.assertAlmostEqual(energy, start, places=9)
        # In two parts, the second one with the energy of the first.
        whole = (self.folder / "e.csv").read_text(encoding="utf-8"), (self.folder / "t.csv").read_text(encoding="utf-8")
        self.run_program(f"{shear} --until 1.5 --thermostat 8 --events e.csv --checkpoint c", self.gas(2))
        first = (self.folder / "e.csv").read_text(encoding="utf-8")
        self.run_program(f"resume c --until 4 --thermostat 8,{start!r} --events f.csv --edges t.csv", self.gas(2))
        rest = (self.folder / "f.csv").read_text(encoding="utf-8").split("\n", 1)[1]
        self.assertEqual((first + rest, (self.folder / "t.csv").read_text(encoding="utf-8")), whole)

    def test_a_run_is_repeated(self):
        discs = self.gas(3).replace("vy\n", "vy,radius\n", 1)
        sizes = iter(["0.1", "0.2", "0.3"] * 12)
        discs = "\n".join(line if i == 0 else f"{line},{next(sizes)}" for i, line in enumerate(discs.splitlines())) + "\n"
        for points, options, more in (
                (self.gas(1), "--shear 0.5", ""), (self.gas(2), "--shear 0.3 --collisions elastic", "--radius 0.3"),
                (self.gas(2), "--shear 0.3 --collisions stop", "--radius 0.3"),
                (self.gas(4), "--shear -0.7 --collisions elastic", "--radius 0.3 --growth 0.001 --thermostat 8"),
                (discs, "--shear 0.1 --collisions elastic", "--mass area"), (discs, "--regular", "")):
            with self.subTest(options + more):
                self.run_program(f"simulate p.csv --until 3 --periodic 6,6,1 {options} {more} --events e.csv --motions m.csv",
                                 points)
                self.run_program(f"simulate m.csv --replay e.csv --until 3 --periodic 6,6,1 {options} --events f.csv "
                                 "--motions n.csv", points)
                for first, second in (("e.csv", "f.csv"), ("m.csv", "n.csv")):
                    self.assertEqual((self.folder / first).read_bytes(), (self.folder / second).read_bytes())
                self.assertGreater(len(self.table("e.csv")), 50)
        # The collisions of a box that moves have images that move.
        self.run_program("simulate p.csv --until 3 --periodic 6,6,1 --shear 0.3 --collisions elastic --radius 0.3 --events e.csv "
                         "--motions m.csv", self.gas(2))
        self.assertTrue(any(row["kind"] == "collision" and not row["added_offset"].endswith(" 0")
                            for row in self.table("e.csv")))
        self.run_program("simulate m.csv --replay e.csv --until 3 --periodic 6,6 --collisions elastic", "", code=2)

    def energy(self, points, rate):
        """The kinetic energy, with velocities relative to the flow of a sheared box."""
        rows = [{name: float(text) for name, text in row.items()} for row in csv.DictReader(io.StringIO(points))]
        return sum((row["vx"] - rate * row["y"]) ** 2 + row["vy"] ** 2 for row in rows) / 2

    def test_thermostat_in_the_plane(self):
        self.run_program("simulate p.csv --until 4 --thermostat 1,12.5 --motions m.csv --events e.csv",
                         HEADER + "0,0,3,0\n0,9,0,4\n9,0,0,0\n")
        self.assertEqual([row["kind"] for row in self.table("e.csv")].count("trajectory"), 0)  # nothing changes

    def test_tables_in_the_plane_have_no_offsets(self):
        self.run_program("simulate p.csv --until 1 --neighbors n.csv --nearest x.csv --components c.csv --range 1",
                         HEADER + "0,0,0,0\n4,0,0,0\n0,4,0,0\n3,3,1,1\n")
        self.assertEqual(self.header("n.csv"), "a,b,begin_lo,begin_hi,end_lo,end_hi,begins_by,ends_by,short")
        self.assertEqual(self.header("x.csv"), "time_lo,time_hi,id,before,after")
        self.assertEqual(self.header("c.csv"), "time_lo,time_hi,kind,a,b,components,largest")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
