# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests of the program in periodic boxes share: runs, logs and edges with offsets, discs that are apart."""
import csv
import io
import pathlib
import random
import subprocess
import sys

from in_folder import In_folder

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())


def pair(text):
    """The offset of a field such as `1 -2`."""
    x, y = text.split(" ")
    return int(x), int(y)


def edge_of(row, what):
    """The edge (a, b, offset) that a row of the log has removed or added; None if there is none."""
    if row[what + "_a"] == "":
        assert row[what + "_b"] == row[what + "_offset"] == ""
        return None
    return int(row[what + "_a"]), int(row[what + "_b"]), pair(row[what + "_offset"])


def edges_in(text):
    rows = list(csv.reader(io.StringIO(text)))
    assert rows[0] == ["a", "b", "offset"]
    return [(int(a), int(b), pair(offset)) for a, b, offset in rows[1:]]


class Program_in_box(In_folder):
    def run_program(self, command, points=None, code=0):
        if points is not None:
            self.write("p.csv", points)
        done = subprocess.run([PROGRAM, *command.split()], cwd=self.folder, text=True, capture_output=True,
                              stdin=subprocess.DEVNULL, timeout=300, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def read(self, name):
        return (self.folder / name).read_text(encoding="utf-8")

    def rows(self, name="e.csv"):
        return list(csv.DictReader(io.StringIO(self.read(name))))

    def discs(self, columns, rows):
        """One in each square of side 2 of a box of side 10, in it or an image of it, moving in eighths."""
        generator = random.Random(3)
        text = "x,y,vx,vy" + columns + "\n"
        for i in range(5):
            for j in range(5):
                x, y = 2 * i + 10 * generator.randint(-1, 1) + generator.random() / 4, 2 * j + generator.random() / 4
                v, w = generator.randint(-16, 16) / 8, generator.randint(-16, 16) / 8
                text += ",".join(map(repr, (x, y, v, w))) + rows(generator) + "\n"
        return text
