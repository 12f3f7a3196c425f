#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is not supported in periodic boxes, and input that no run has: each is refused, or refuted.

usage: periodic_refusals_test.py KINETRI VERIFY FOLDER
"""
import copy
import re
import subprocess
import sys

from periodic_runs import FOLDER, KINETRI, VERIFY, runs


def check_own_image():
    """The run ends before a disc meets its own image. A log that goes on is false."""
    folder = FOLDER / "own"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "points.csv").write_text("x,y,vx,vy\n0,0,1,0\n2.25,0.25,0,0.25\n", encoding="utf-8")
    box = ["--periodic=4,1,2", "--shear=0.125", "--collisions=elastic"]
    done = subprocess.run([KINETRI, "simulate", "points.csv", "--until", "40", *box, "--radius", "0.53125", "--events",
                           "events.csv", "--motions", "motions.csv", "--initial-edges", "initial.csv"],
                          cwd=folder, text=True, capture_output=True, check=False)
    end = float(done.stderr.split("the run ends at t = ")[1].split(" ")[0])
    for until, expected in ((end - 2**-40, "verified"), (end + 2**-40, "refuted: the end: contact of ")):
        says = subprocess.run([VERIFY, "points.csv", "events.csv", "--until", repr(until), "--motions", "motions.csv",
                               "--initial-edges", "initial.csv", *box],
                              cwd=folder, text=True, capture_output=True, check=False).stdout
        if not says.startswith(expected) or (expected[0] == "r" and not re.search(r"of (\d) \1 \(1, -1\)", says)):
            sys.exit(f"until {until}: {says}")


def check_refusals():
    """What is not supported, and input that no run has."""
    _, run = next(runs("gas", 1, FOLDER / "refused"))
    i = next(i for i, row in enumerate(run.rows) if row[1] == "collision")

    def expect(code, words, change, **ways):
        changed = copy.deepcopy(run)
        change(changed)
        found, says = changed.verify(**ways)
        if found != code or words not in says:
            sys.exit(f"expected {code}: {words}; found {found}: {says}")

    def edit(table, k, column, field):
        def change(changed):
            (changed.rows if table == "rows" else changed.motions)[k][column] = field
        return change

    def double_a_point(changed):  # and its images
        changed.motions.append([str(len(changed.motions)), *changed.motions[0][1:]])
        changed.rows = []
        changed.until = changed.start

    def take_box(*options):
        def change(changed):
            changed.box_options = lambda: options
        return change

    no_area = "the area of the --periodic box is 0 or negative at a time of the run"
    expect(2, no_area, take_box("--periodic=1,2,2,4"))
    expect(2, no_area, take_box("--periodic=-1,2"))
    expect(2, no_area, take_box("--periodic=4,0,0,4", "--rates=-1,0,0,0"))  # at the end
    expect(2, "--rates needs --periodic AX,AY,BX,BY", take_box("--periodic=4,4", "--rates=1,0,0,0"))
    expect(2, "--epochs needs --periodic AX,AY,BX,BY", take_box("--periodic=4,4", "--epochs=1,0"))
    expect(2, "--epochs needs --periodic", take_box("--epochs=1,0"))
    expect(2, "--shear needs --periodic LX,LY", take_box("--periodic=1,0,0,1", "--shear=1"))
    expect(2, "expected 2 to 4 finite numbers", take_box("--periodic=1,0,0,1,1"))
    expect(2, "discs coincide in a periodic box", double_a_point, points="motions.csv", edges=["initial"],
           more=["--collisions", "log"])
    expect(2, "the column added_offset is ''; expected two whole numbers", edit("rows", i, -1, ""))
    expect(1, f"refuted: row {i}: it has an offset of no edge", edit("rows", i, -2, "0 0"))
    expect(1, f"refuted: row {i}: there is no wall in a periodic box", edit("rows", i, 1, "wall"))


def check_double_cover():
    """The edges of every other image of one point are those of a surface, and Delaunay."""
    _, run = next(runs("one", 1, FOLDER / "double"))
    run.points, run.box, run.start, run.until, run.rows = [(0, 0, 0, 0)], (1, 1, 0, 0), 0, 2, []
    says = []
    for diagonal in ("2 -1", "2 1"):
        run.initial = [("0", "0", "0 1"), *sorted([("0", "0", "2 0"), ("0", "0", diagonal)])]
        code, answer = run.verify(edges=["initial"])
        says.append(answer)
        if code != 1:
            sys.exit(f"edges that cover the box twice: {code}: {answer}")
    if not any("do not cover the box once, but 2 times" in answer for answer in says):
        sys.exit(f"no answer says that the box is covered twice: {says}")


def check_growth_from_nothing():
    """A square that has no area at 0 can be used from 1 on. One of its diagonals is an edge."""
    _, run = next(runs("one", 1, FOLDER / "growth"))
    run.points, run.start, run.until, run.rows = [(0, 0, 0, 0)], 1, 2, []
    run.box_options = lambda: ("--periodic=0,0,0,0", "--rates=1,0,0,1")
    codes = []
    for diagonal in ("1 -1", "1 1"):
        run.initial = sorted([("0", "0", "0 1"), ("0", "0", "1 0"), ("0", "0", diagonal)])
        codes.append(run.verify(edges=["initial"]))
    if sorted(code for code, _ in codes) != [0, 1]:
        sys.exit(f"a square that grows from nothing: {codes}")


if __name__ == "__main__":
    check_double_cover()
    check_growth_from_nothing()
    check_own_image()
    check_refusals()
