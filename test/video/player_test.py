#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the page that `kinetri-video play` writes, in Debian's chromium, without a window.

usage: player_test.py PROGRAM VIEWER_TESTS

VIEWER_TESTS is the folder of chromium.py. The page must show what `kinetri-video decode` draws, at any
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
from chromium import Chromium  # noqa: E402

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

    def open_clip(self, chromium, clip):
        """Opens the page of a clip, in its own size."""
        stream, page = self.folder / "clip.kvd", self.folder / "clip.html"
        self.run_program("encode", clip, stream, "--points", 200, "--turn-every", 4, "--scene-cut")
        self.run_program("play", stream, "--html", page)
        chromium.open(page)
        chromium.evaluate(f"player.canvas.style.width = '{WIDTH}px', player.show()")
        return stream

    def test_colors_are_those_that_decode_draws(self):
        clip = self.folder / "clip.y4m"
        with open(clip, "wb") as out:
            out.write(f"YUV4MPEG2 W{WIDTH} H{HEIGHT} F25:1 C444\n".encode())
            for t in range(5):
                planes = [[16 + 0.8 * brightness(x - t, y) for y in range(HEIGHT) for x in range(WIDTH)],
                          [90 + x / 2 for y in range(HEIGHT) for x in range(WIDTH)],
                          [170 - y / 2 - t for y in range(HEIGHT) for x in range(WIDTH)]]
                out.write(b"FRAME\n" + b"".join(bytes(int(value) for value in plane) for plane in planes))
        with Chromium() as chromium:
            stream = self.open_clip(chromium, clip)
            self.run_program("decode", stream, self.folder / "decoded.y4m")
            data = (self.folder / "decoded.y4m").read_bytes()
            size = WIDTH * HEIGHT
            for frame in (0, 3, 1):
                at = data.index(b"\n") + 1 + frame * (6 + 3 * size) + 6
                y, cb, cr = (data[at + k * size:at + (k + 1) * size] for k in range(3))
                shown = json.loads(chromium.evaluate(
                    f"player.time = {frame}, player.show(),"
                    "JSON.stringify(Array.from(player.painter.image.data))"))
                wrong = 0
                for i in range(size):
                    # ITU-R BT.601 in limited range.
                    luma, blue, red = 255 / 219 * (y[i] - 16), 255 / 224 * (cb[i] - 128), 255 / 224 * (cr[i] - 128)
                    expected = (luma + 1.402 * red, luma - 0.344136 * blue - 0.714136 * red,
                                luma + 1.772 * blue)
                    wrong += any(abs(min(max(value, 0), 255) - shown[4 * i + k]) > 4
                                 for k, value in enumerate(expected))
                self.assertLessEqual(wrong, size // 500, f"frame {frame}")
            self.assertEqual(chromium.problems, [])

    def test_mesh_is_the_edges_of_the_triangles(self):
        clip = self.folder / "clip.y4m"
        write_clip(clip)
        with Chromium() as chromium:
            self.open_clip(chromium, clip)
            pixels = ("JSON.stringify(Array.from(player.canvas.getContext('2d').getImageData("
                      f"0, 0, {WIDTH}, {HEIGHT}).data.filter((_, i) => i % 4 === 0)))")
            before = json.loads(chromium.evaluate(pixels))
            chromium.evaluate("document.getElementById('mesh').click()")
            after = json.loads(chromium.evaluate(pixels))
            # At time 0 points are where their group begins.
            key = json.loads(chromium.evaluate(
                "JSON.stringify([Array.from(player.segments[0].group.ids),"
                "Array.from(player.segments[0].group.places), player.json.unit,"
                "Array.from(player.segments[0].triangles.values())])"))
            ids, places, unit, triangles = key
            at = {ids[i]: (unit * places[4 * i], unit * places[4 * i + 1]) for i in range(len(ids))}
            edges = {tuple(sorted((a, b))) for t in triangles for a, b in zip(t, t[1:] + t[:1])}
            self.assertGreater(len(edges), 300)
            changed = {(i % WIDTH, i // WIDTH) for i in range(len(after)) if after[i] != before[i]}
            self.assertGreater(len(changed), 1000)

            def distance(x, y, a, b):
                (ax, ay), (bx, by) = at[a], at[b]
                length = (bx - ax) ** 2 + (by - ay) ** 2
                share = min(max(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length, 0), 1)
                return math.hypot(ax + share * (bx - ax) - x, ay + share * (by - ay) - y)

            for x, y in sorted(changed)[::7]:
                self.assertLess(min(distance(x + 0.5, y + 0.5, a, b) for a, b in edges), 1.5)
            for a, b in edges:
                x, y = (at[a][0] + at[b][0]) / 2, (at[a][1] + at[b][1]) / 2
                if 1 <= x < WIDTH - 1 and 1 <= y < HEIGHT - 1:
                    around = {(int(x) + i, int(y) + j) for i in (-1, 0, 1) for j in (-1, 0, 1)}
                    self.assertTrue(changed & around, (a, b))

    def test_plays_at_any_speed_forward_and_backward(self):
        clip, decoded = self.folder / "clip.y4m", self.folder / "decoded.y4m"
        write_clip(clip)
        with Chromium() as chromium:
            stream = self.open_clip(chromium, clip)
            self.run_program("decode", stream, decoded, "--fps", 50)
            expected = frames_of(decoded)
            # (speed, time before, milliseconds that go by, time after)
            for speed, before, span, after in ((1, 2, 120, 5), (-2, 10, 80, 6), (0.5, 6, 200, 8.5),
                                               (-0.5, 9.5, 40, 9), (2, 12, 40, 1), (-1, 1, 80, 12),
                                               (0, 4, 500, 4)):
                found, shown = json.loads(chromium.evaluate(
                    f"document.getElementById('speed').value = {speed},"
                    "document.getElementById('speed').dispatchEvent(new Event('input')),"
                    f"player.time = {before}, player.last = 0, player.plays = true,"
                    f"player.animate({span}), player.plays = false, JSON.stringify([player.time,"
                    "Array.from(player.painter.image.data.filter((_, i) => i % 4 === 0))])"))
                self.assertAlmostEqual(found, after, places=9)
                wrong = sum(abs(a - b) > 2 for a, b in zip(shown, expected[round(2 * after)]))
                self.assertLessEqual(wrong, WIDTH * HEIGHT // 500, f"speed {speed}")
            chromium.evaluate("document.getElementById('play').click()")
            self.assertEqual(chromium.evaluate("document.getElementById('play').textContent"), "Pause")
            chromium.evaluate("document.getElementById('play').click()")
            self.assertEqual(chromium.evaluate("player.plays"), False)
            self.assertEqual(chromium.problems, [])

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
        with Chromium() as chromium:
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
    if Chromium.executable() is None:
        print("chromium-headless-shell is not installed; nothing tested (scripts/test.sh --browser installs it)")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
