#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program kinetri-video as users call it: files, pipes, messages, exit codes.

usage: program_test.py PROGRAM
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())


def clip(width=24, height=16, frames=6, color="420jpeg"):
    """Y4M video of a gradient that moves."""
    result = f"YUV4MPEG2 W{width} H{height} F25:1 C{color}\n".encode()
    samples = {"mono": 0, "444": 2 * width * height}.get(
        color, 2 * ((width + 1) // 2) * ((height + 1) // 2))
    for t in range(frames):
        luma = bytes((7 * x + 5 * y + 3 * t) % 256 for y in range(height) for x in range(width))
        result += b"FRAME\n" + luma + bytes([128]) * samples
    return result


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="kinetri-video-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_program(self, *arguments, data=None, code=0):
        done = subprocess.run([PROGRAM, *map(str, arguments)], input=data, capture_output=True,
                              cwd=self.folder, timeout=120)
        self.assertEqual(done.returncode, code, done.stderr.decode())
        return done

    def problem(self, *arguments, data=None):
        done = self.run_program(*arguments, data=data, code=2)
        self.assertEqual(done.stdout, b"")
        return done.stderr.decode()

    def names(self):
        return sorted(entry.name for entry in self.folder.iterdir())

    def test_files_and_pipes_give_the_same(self):
        (self.folder / "a.y4m").write_bytes(clip())
        self.assertIn(b"6 frames", self.run_program("encode", "a.y4m", "a.kvd", "--points", 30).stdout)
        piped = self.run_program("encode", "-", "-", "--points", 30, data=clip()).stdout
        self.assertEqual((self.folder / "a.kvd").read_bytes(), piped)
        self.run_program("decode", "a.kvd", "b.y4m")
        decoded = (self.folder / "b.y4m").read_bytes()
        self.assertEqual(self.run_program("decode", "-", "-", data=piped).stdout, decoded)
        self.assertEqual(len(decoded) - decoded.index(b"\n"), len(clip()) - clip().index(b"\n"))
        self.assertTrue(decoded.startswith(b"YUV4MPEG2 W24 H16 F25:1 Ip A0:0 C420jpeg\n"))
        self.assertIn(b"frames    6", self.run_program("info", "a.kvd").stdout)
        text = self.run_program("compare", "a.y4m", "a.kvd").stdout.decode()
        self.assertIn("PSNR", text)
        self.assertIn("per pixel", text)
        self.assertIn("PSNR inf", self.run_program("compare", "a.y4m", "a.y4m").stdout.decode())
        table = self.run_program("compare", "a.y4m", "a.kvd", "--csv", "-").stdout.decode()
        self.assertEqual(table.splitlines()[0], "frame,psnr_y,psnr_cb,psnr_cr,ssim_y,ssim_cb,ssim_cr")
        self.assertEqual(len(table.splitlines()), 7)

    def test_rates_sizes_and_folders(self):
        (self.folder / "a.y4m").write_bytes(clip())
        self.run_program("encode", "a.y4m", "a.kvd", "--points", 30)
        twice = self.run_program("decode", "a.kvd", "-", "--fps", "50", "--size", "48x10").stdout
        self.assertTrue(twice.startswith(b"YUV4MPEG2 W48 H10 F50:1 "))
        self.assertEqual(twice.count(b"FRAME\n"), 12)
        odd = self.run_program("decode", "a.kvd", "-", "--fps", "30000:1001", "--style", "smooth").stdout
        self.assertEqual(odd.count(b"FRAME\n"), 8)  # 0.24 s
        self.run_program("decode", "a.kvd", "frames/", "--style", "flat")
        self.assertEqual(len(list((self.folder / "frames").iterdir())), 6)
        self.run_program("encode", "frames", "b.kvd", "--points", 30, "--rate", "23.976")
        self.assertIn(b"2997:125", self.run_program("info", "b.kvd").stdout)

    def test_bad_input_says_what_is_wrong_and_leaves_nothing(self):
        self.assertIn("it is empty", self.problem("encode", "-", "a.kvd", data=b""))
        self.assertIn("cut off", self.problem("encode", "-", "a.kvd", data=clip()[:-1]))
        self.assertIn("No such file", self.problem("encode", "none.y4m", "a.kvd"))
        self.assertIn("more than 8 bits", self.problem(
            "encode", "-", "a.kvd", data=b"YUV4MPEG2 W2 H2 F25:1 C420p10\nFRAME\n"))
        self.assertIn("fewer than the picture has corners",
                      self.problem("encode", "-", "a.kvd", "--points", 3, data=clip()))
        self.assertIn("no power of two",
                      self.problem("encode", "-", "a.kvd", "--turn-every", 3, data=clip()))
        self.assertIn("does not begin as a stream", self.problem("decode", "-", "a.y4m", data=clip()))
        self.assertIn("--size", self.problem("decode", "-", "a.y4m", "--size", "big", data=b""))
        self.assertIn("--fps", self.problem("decode", "-", "a.y4m", "--fps", "0", data=b""))
        self.assertEqual(self.names(), [])

    def test_a_stream_that_is_cut_off_is_decoded_up_to_there(self):
        stream = self.run_program("encode", "-", "-", "--points", 30, "--turn-every", 2,
                                  data=clip(frames=9)).stdout
        done = self.run_program("decode", "-", "some.y4m", data=stream[:-40], code=2)
        self.assertIn("block 4, at byte", done.stderr.decode())
        self.assertIn("only what is before frame 6 can be decoded; 6 frames before it written",
                      done.stderr.decode())
        whole = self.run_program("decode", "-", "-", data=stream).stdout
        some = (self.folder / "some.y4m").read_bytes()
        self.assertEqual(some.count(b"FRAME\n"), 6)
        self.assertTrue(whole.startswith(some))
        damaged = stream[:90] + bytes([stream[90] ^ 1]) + stream[91:]
        self.assertIn("block 0, at byte 48: its checksum is wrong",
                      self.problem("decode", "-", "none.y4m", data=damaged))
        self.assertFalse((self.folder / "none.y4m").exists())

    def test_a_full_disk_is_an_error_and_a_closed_pipe_an_end(self):
        self.assertIn("/dev/full", self.problem("encode", "-", "/dev/full", "--points", 30, data=clip()))
        stream = self.run_program("encode", "-", "-", "--points", 30, data=clip(200, 150, 3)).stdout
        (self.folder / "a.kvd").write_bytes(stream)
        self.assertIn("/dev/full", self.problem("decode", "a.kvd", "/dev/full"))
        done = subprocess.run(f"'{PROGRAM}' decode a.kvd - --fps 1000 | head -c 100 | wc -c",
                              shell=True, capture_output=True, cwd=self.folder, timeout=120)
        self.assertEqual(done.stdout.strip(), b"100")
        self.assertEqual(done.stderr, b"")

    def test_help_manual_and_completions_name_all_commands(self):
        text = self.run_program("--help").stdout.decode()
        for command in ("encode", "decode", "play", "info", "compare"):
            self.assertIn(command, text)
            self.assertIn("Example", self.run_program(command, "--help").stdout.decode())
            self.assertIn(command, self.run_program("completion", "bash").stdout.decode())
        self.assertIn("kinetri-video", self.run_program("--version").stdout.decode())
        self.assertIn(".TH", self.run_program("manual").stdout.decode())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
