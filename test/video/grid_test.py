#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Points that move, beside as many points at rest on a grid, at no more bits: 320 x 240, 50 frames, 2000 points,
a texture that moves by 2.7 pixels a frame.

usage: grid_test.py PROGRAM CLIPS
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, CLIPS = (str(pathlib.Path(word).resolve()) for word in sys.argv[1:3])
GRID = ("--placement", "grid", "--no-motion")


class Grid(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="kinetri-video-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.run_program(CLIPS, "write", "translation", 320, 240, 50, "a.y4m")

    def run_program(self, *words):
        # Without PATH there is no ffmpeg, so that compare does not run x264.
        return subprocess.run([*map(str, words)], check=True, capture_output=True, text=True, cwd=self.folder,
                              env={"PATH": "/none"}).stdout

    def encode(self, name, *options):
        """The bytes of the stream."""
        self.run_program(PROGRAM, "encode", "a.y4m", name, "--points", 2000, *options)
        return (self.folder / name).stat().st_size

    def psnr(self, name):
        text = self.run_program(PROGRAM, "compare", "a.y4m", name)
        return float(re.search(r"^y +PSNR (\S+) dB", text, re.MULTILINE)[1])

    def test_moving_points_are_3_db_better_than_a_grid_at_rest_with_as_many_bits(self):
        size = self.encode("moving.kvd")
        # No grid whose colors turn at every second frame has as few bits: not even with the coarsest colors.
        self.assertGreater(self.encode("grid2.kvd", *GRID, "--turn-every", 2, "--color-step", 31.875), size)
        # One whose colors turn at every fourth frame has more bits here than the moving points.
        self.assertGreater(self.encode("grid4.kvd", *GRID, "--turn-every", 4), size)
        self.assertGreater(self.psnr("moving.kvd"), self.psnr("grid4.kvd") + 3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
