#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of every kind, each verified by kinetri-verify (--verify): the corpus of degenerate points, points in
a box, accelerated points, discs of one size and of many with each response, growing discs, hidden points,
packings, tracks, and runs in parts.

usage: verified_runs_test.py PROGRAM corpus|runs
"""
import pathlib
import re
import shlex
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
from in_folder import In_folder  # noqa: E402

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
CORPUS = pathlib.Path(__file__).resolve().parents[2] / "data/degenerate"

FALLING = ("x,y,vx,vy,ax,ay,jx,jy\n"
           "1,1,2,0,0,-2,0,0\n4,1,-1,1,0,-2,0,0\n7.5,1.25,0,1,0,-2,0.1,0\n1,4,0,0,0,-2,0,0\n"
           "4,4.5,1,1,0,-2,0,0\n7,4,-2,0,0,-2,0,0.2\n1.5,7,1,0,0,-2,0,0\n4,7,0,-1,0,-2,0,0\n7,7,0.5,0,0,0,0,0\n")
ON_A_LATTICE = ("x,y,vx,vy,radius\n" + "".join(
    f"{5 + 6 * (i % 6)},{5 + 6 * (i // 6)},{i * 7 % 9 - 4},{i * 5 % 9 - 4},{2 if i % 5 == 0 else 1}\n"
    for i in range(36)))
# Two cross a square, one of them stops on the way, and a third one comes and goes. Some turn at one time.
CROWD = ("t,id,x,y\n"
         "0,a,0,0\n10,a,0.5,0\n0,b,9,0.3\n10,b,9,0\n0,c,0,9\n10,c,0,9.5\n0,d,9,8\n10,d,9,9\n"
         "1,p,1,1\n2,p,3,1\n4,p,3,1\n5,p,1,4\n1,q,8,8\n2,q,3.5,7\n4,q,3.5,3\n8,q,8,1\n2.5,r,5,5\n4,r,2,5\n7,r,2,2\n")


class Verified_runs(In_folder):
    def run_program(self, command, code=0):
        """What a run prints; command is split as by a shell."""
        result = subprocess.run([PROGRAM, *shlex.split(command)], cwd=self.folder, timeout=600, check=False,
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result.stdout

    def expect_verified(self, command, least=1, code=0):
        """A run that is verified, with so many events at least."""
        with self.subTest(command):
            answer = self.run_program(f"{command} --verify --quiet", code)
            found = re.fullmatch("verified: [0-9]+ points, ([0-9]+) events, [0-9]+ certificates\n", answer)
            self.assertTrue(found, answer)
            self.assertGreaterEqual(int(found[1]), least)

    def generate(self, arguments):
        self.run_program(f"generate {arguments} --output p.csv")


class Corpus(Verified_runs):
    def test_degenerate_points(self):
        files = sorted(CORPUS.glob("*.csv"))
        self.assertGreater(len(files), 80)
        for file in files:
            until = re.search("^# until: (.*)$", file.read_text(encoding="utf-8"), re.MULTILINE)
            self.expect_verified(f"simulate {shlex.quote(str(file))} --until {until[1] if until else 10}", 0)


class Runs(Verified_runs):
    def test_points(self):
        self.generate("uniform --points 60 --seed 3")
        self.expect_verified("simulate p.csv --until 10 --from -3", 100)
        self.expect_verified("simulate p.csv --until 10 --exact-only", 100)
        self.expect_verified("simulate p.csv --until 10 --max-events 50", 50, code=130)
        self.generate("lattice --points 49 --seed 4")
        self.expect_verified("simulate p.csv --until 8 --from -2", 100)

    def test_points_in_a_box(self):
        self.generate("uniform --points 40 --speed 5 --seed 3")
        self.expect_verified("simulate p.csv --until 10 --box 0,0,100,100", 100)
        self.generate("lattice --points 25 --seed 4")
        self.expect_verified("simulate p.csv --until 10 --box -5,-5,50,50", 50)

    def test_points_that_accelerate(self):
        self.write("p.csv", FALLING)
        self.expect_verified("simulate p.csv --until 4", 5)
        self.expect_verified("simulate p.csv --until 6 --box 0,0,9,9", 20)
        self.expect_verified("simulate p.csv --until 6 --box 0,0,9,9 --collisions elastic --radius 0.5 --rim", 20)
        self.expect_verified("simulate p.csv --until 3 --box 0,0,9,9 --collisions stop --radius 0.5 --growth 0.03125", 5)

    def test_discs_of_one_size(self):
        self.generate("lattice-jitter --points 49 --speed 5 --seed 2")
        for response in ("elastic", "swap", "stop", "remove", "log"):
            self.expect_verified(f"simulate p.csv --until 6 --box -6,-6,66,66 --collisions {response} --radius 3", 20)
            self.expect_verified(f"simulate p.csv --until 4 --collisions {response} --radius 3 --rim --box -6,-6,66,66", 20)
            self.expect_verified(f"simulate p.csv --until 2 --periodic 70,70,9 --shear 0.25 --collisions {response} --radius 3", 20)

    def test_discs_of_many_sizes(self):
        self.write("p.csv", ON_A_LATTICE)
        for response in ("elastic", "swap", "stop", "remove", "log"):
            self.expect_verified(f"simulate p.csv --until 4 --box 0,0,40,40 --rim --collisions {response}", 20)
        self.expect_verified("simulate p.csv --until 4 --box 0,0,40,40 --rim --collisions elastic --mass area "
                             "--growth 0.0625", 20)

    def test_discs_that_others_hide(self):
        self.write("p.csv", ON_A_LATTICE)
        self.expect_verified("simulate p.csv --until 6 --regular --growth 1.5", 50)
        self.generate("packing --points 40 --share 0.3 --sizes 5 --side 40 --speed 4 --growth 0.2 --seed 1")
        self.expect_verified("simulate p.csv --until 8 --regular", 50)
        self.expect_verified("simulate p.csv --until 3 --collisions log", 50)

    def test_packings(self):
        self.generate("uniform --points 40 --side 100 --speed 5 --seed 1")
        self.expect_verified("simulate p.csv --until-share 0.5 --box 0,0,100,100 --rim --collisions elastic "
                             "--growth 0.5", 50)
        self.generate("packing --points 30 --share 0.2 --sizes 3 --side 40 --speed 2 --growth 0.02 --seed 5")
        self.expect_verified("simulate p.csv --until 6 --box 0,0,40,40 --rim --collisions elastic", 50)

    def test_tracks(self):
        self.write("t.csv", CROWD)
        self.expect_verified("tracks t.csv --until 9", 10)
        self.expect_verified("tracks t.csv --from 1.5 --until 6 --max-gap 20", 5)
        self.expect_verified("tracks t.csv --until 9 --collisions log --radius 0.75", 12)

    def test_scenarios(self):
        self.expect_verified("wave --until 4", 20)
        self.expect_verified("experiment --single 50 --points 30 --until 4", 20)

    def test_runs_in_parts(self):
        self.generate("lattice-jitter --points 49 --speed 5 --seed 2")
        self.write("q.csv", FALLING)
        self.write("r.csv", ON_A_LATTICE)
        for command in ("simulate p.csv", "simulate p.csv --box -6,-6,66,66 --collisions elastic --radius 3",
                        "simulate q.csv --box 0,0,9,9", "simulate r.csv --regular --growth 1.5"):
            self.expect_verified(f"{command} --until 2.3 --checkpoint a")
            self.expect_verified("resume a --until 2.3 --checkpoint b", 0)
            self.expect_verified("resume b --until 5 --checkpoint c")
        # One that ends at no binary64 number.
        self.expect_verified("simulate p.csv --until 9 --max-events 20 --checkpoint a", code=130)
        self.expect_verified("resume a --until 3")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], sys.argv[2].capitalize()])
