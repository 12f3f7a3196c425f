#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the page that `kinetri-video play` writes, in Debian's chromium, without a window.

usage: player_test.py PROGRAM VIEWER_TESTS

VIEWER_TESTS is the folder of browser.py. The page must show what `kinetri-video decode` draws, at any
time, in either direction. Exit code 77 where there is no chromium.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[2])
import browser  # noqa: E402

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
SKIPPED = 77
WIDTH, HEIGHT, FRAMES = 96, 72, 13


def brightness(x, y):
    return 128 + 50 * math.sin(0.35 * x + 0.1 * y) + 40 * math.sin(0.3 * y - 0.15 * x)


def write_clip(path):
    """A texture that goes to the right; at frame 9 another one, at rest, begins."""
    with open(path, "wb") as out:
        out.write(f"YUV4MPEG2 W{WIDTH} H{HEIGHT} F25:1 Cmono XCOLORRANGE=FULL\n".encode())
        for t in range(FRAMES):
            out.write(b"FRAME\n")
            for y in range(HEIGHT):
                row = [brightness(x - 1.5 * t, y) if t < 9 else 250 - x - y for x in range(WIDTH)]
                out.write(bytes(int(min(max(value, 0), 255)) for value in row))


def frames_of(path):
    data = pathlib.Path(path).read_bytes()
    at = data.index(b"\n") + 1
    frames = []
    while at < len(data):
        at = data.index(b"\n", at) + 1
        frames.append(data[at:at + WIDTH * HEIGHT])
        at += WIDTH * HEIGHT
    return frames


class Player(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="kinetri-player-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_program(self, *arguments):
        subprocess.run([PROGRAM, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)

    def test_page_shows_what_decode_draws(self):
        clip, stream = self.folder / "clip.y4m", self.folder / "clip.kvd"
        page, decoded = self.folder / "clip.html", self.folder / "decoded.y4m"
        write_clip(clip)
        self.run_program("encode", clip, stream, "--points", 200, "--turn-every", 4,
                         "--scene-cut")
        self.run_program("play", stream, "--html", page)
        # Times between those of the frames, too.
        self.run_program("decode", stream, decoded, "--fps", 50)
        expected = frames_of(decoded)
        with browser.Browser() as chromium:
            chromium.open(page)
            shape = chromium.evaluate(
                f"player.canvas.style.width = '{WIDTH}px', player.show(),"
                "[player.canvas.width, player.canvas.height, player.segments.length]")
            self.assertEqual(shape, [WIDTH, HEIGHT, 2])
            order = [0, 1, 5, 8, 15, 16, 17, 18, 21, 25, 20, 18, 17, 9, 3, 0]
            for i in order:
                shown = chromium.evaluate(
                    f"player.time = {i} / 2, player.show(), JSON.stringify(Array.from("
                    f"player.painter.image.data.filter((_, i) => i % 4 === 0)))")
                wrong = sum(abs(a - b) > 2 for a, b in zip(json.loads(shown), expected[i]))
                self.assertEqual(len(json.loads(shown)), WIDTH * HEIGHT)
                # Centers on an edge may be drawn with either triangle.
                self.assertLessEqual(wrong, WIDTH * HEIGHT // 500, f"frame {i}")
            before = chromium.evaluate("player.canvas.toDataURL()")
            chromium.evaluate("document.getElementById('mesh').click()")
            self.assertNotEqual(chromium.evaluate("player.canvas.toDataURL()"), before)
            self.assertEqual(chromium.problems, [])


if __name__ == "__main__":
    if browser.executable() is None:
        print("chromium is not installed; nothing tested (scripts/test.sh --browser installs it)")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
