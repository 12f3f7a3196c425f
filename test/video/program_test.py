#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program kinetri-video as users call it: files, pipes, messages, exit codes.

usage: program_test.py PROGRAM
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())


def clip(width=24, height=16, frames=6, color="420jpeg"):
    """Y4M video of a gradient that moves."""
    result = f"YUV4MPEG2 W{width} H{height} F25:1 C{color}\n".encode()
    samples = {"mono": 0, "444": 2 * width * height, "422": 2 * ((width + 1) // 2) * height}.get(
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

    def test_the_output_cannot_be_the_input(self):
        (self.folder / "a.y4m").write_bytes(clip())
        self.run_program("encode", "a.y4m", "a.kvd", "--points", 30)
        (self.folder / "link").symlink_to("a.y4m")
        before = {name: (self.folder / name).read_bytes() for name in self.names()}
        for command in (("encode", "a.y4m", "./a.y4m"), ("encode", "a.y4m", "link"), ("decode", "a.kvd", "a.kvd"),
                        ("play", "a.kvd", "--html", "a.kvd"), ("compare", "a.y4m", "a.kvd", "--csv", "a.y4m"),
                        ("compare", "a.y4m", "a.kvd", "--csv", "a.kvd")):
            self.assertIn(" is the input; expected another file", self.problem(*command))
        self.assertEqual({name: (self.folder / name).read_bytes() for name in self.names()}, before)

    def test_files_of_other_kinds_are_named_as_such(self):
        (self.folder / "a.avi").write_bytes(bytes(range(32, 255)) * 100)
        self.assertIn("does not begin with YUV4MPEG2; expected such video (ffmpeg -i CLIP",
                      self.problem("encode", "a.avi", "a.kvd"))
        (self.folder / "a.y4m").write_bytes(clip())
        self.run_program("encode", "a.y4m", "a.stream", "--points", 30)
        for name in ("a.mp4", "a.png"):
            self.assertIn(f"OUT: {name}: no {name[1:]} is written; expected a name as clip.y4m, or as frames/",
                          self.problem("decode", "a.stream", name))
        self.assertIn("bits", self.run_program("compare", "a.y4m", "a.stream").stdout.decode())
        self.assertIn("A: a.stream is a stream; expected the source", self.problem("compare", "a.stream", "a.y4m"))
        (self.folder / "b.y4m").write_bytes(clip(color="444"))
        self.assertIn("b.y4m: it has 24 x 16 samples, 444, limited range; "
                      "expected 24 x 16 samples, 420jpeg, limited range, as a.y4m has",
                      self.problem("compare", "a.y4m", "b.y4m"))
        self.assertEqual(self.names(), ["a.avi", "a.stream", "a.y4m", "b.y4m"])

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

    def test_a_disk_that_is_full_leaves_nothing(self):
        if os.geteuid() != 0:
            self.skipTest("only root can mount a small disk")
        disk = self.folder / "disk"
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", disk], check=False,
                          capture_output=True).returncode != 0:
            self.skipTest("no small disk can be mounted here")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        stream = self.run_program("encode", "-", "-", "--points", 30, data=clip(120, 90, 40)).stdout
        for output in ("disk/a.y4m", "disk/frames/"):
            message = self.problem("decode", "-", output, "--size", "400x400", data=stream)
            self.assertIn("No space left", message)
        page = self.problem("play", "-", "--html", "disk/a.html", data=self.run_program(
            "encode", "-", "-", "--points", 2000, "--turn-every", 1, "--color-step", 0.125,
            data=clip(120, 90, 8)).stdout)
        self.assertIn("No space left", page)
        self.assertEqual(list(disk.iterdir()), [])

    def test_a_reader_that_goes_is_an_end_and_a_writer_that_goes_an_error(self):
        video = clip(200, 150, 12)
        (self.folder / "a.y4m").write_bytes(video)
        for command in (f"'{PROGRAM}' encode a.y4m - --points 30 --turn-every 1 | head -c 60 | wc -c",
                        f"'{PROGRAM}' encode a.y4m - | '{PROGRAM}' decode - - | head -c 60 | wc -c"):
            done = subprocess.run(command, shell=True, capture_output=True, cwd=self.folder, timeout=120)
            self.assertEqual(done.stdout.strip(), b"60")
            self.assertEqual(done.stderr, b"")
        for size in (0, 5, 40, len(video) // 2, len(video) - 1):
            message = self.problem("encode", "-", "b.kvd", "--points", 30, data=video[:size])
            self.assertRegex(message, "standard input: .*(empty|begin|cut off|header|no frame)")
        self.assertEqual(self.names(), ["a.y4m"])

    def test_clips_of_one_frame_and_of_odd_sizes_of_any_color(self):
        for color in ("mono", "420jpeg", "420mpeg2", "420paldv", "422", "444"):
            for size in ((1, 1), (3, 5), (17, 2)):
                for frames in (1, 2):
                    video = clip(*size, frames, color)
                    stream = self.run_program("encode", "-", "-", "--points", 9, data=video).stdout
                    decoded = self.run_program("decode", "-", "-", data=stream).stdout
                    self.assertEqual(decoded.count(b"FRAME\n"), frames)
                    self.assertEqual(len(decoded) - decoded.index(b"\n"), len(video) - video.index(b"\n"))
        self.assertIn("there is no frame", self.problem("encode", "-", "a.kvd", data=clip(4, 4, 0)))

    def test_frames_of_another_size_in_between_are_refused(self):
        begin, other = clip(24, 16, 2), clip(20, 16, 1)
        mixed = begin + other[other.index(b"\n") + 1:] + begin[begin.index(b"\n") + 1:]
        self.assertIn("frame 3 does not begin with FRAME; expected frames of 24 x 16",
                      self.problem("encode", "-", "a.kvd", data=mixed))
        for name, size in (("a/", (24, 16)), ("b/", (20, 16))):
            stream = self.run_program("encode", "-", "-", "--points", 9, data=clip(*size, 1)).stdout
            self.run_program("decode", "-", name, data=stream)
        (self.folder / "b/00000.png").rename(self.folder / "a/00001.png")
        self.assertIn("it has 20 x 16 pixels; expected 24 x 16", self.problem("encode", "a", "c.kvd"))

    def test_events_of_info_are_those_of_encode(self):
        text = self.run_program("encode", "-", "a.kvd", "--points", 60, "--turn-every", 2,
                                data=clip(60, 40, 12)).stdout.decode()
        events = re.search(r"(\d+) events?", text)[1]
        self.assertRegex(self.run_program("info", "a.kvd").stdout.decode(), rf"events +{events}\n")

    def test_compare_shows_x264_or_why_not(self):
        video = clip(64, 48, 8)
        (self.folder / "a.y4m").write_bytes(video)
        self.run_program("encode", "a.y4m", "a.kvd", "--points", 30)
        text = self.run_program("compare", "a.y4m", "a.kvd").stdout.decode()
        if shutil.which("ffmpeg"):
            self.assertRegex(text, r"x264 y +PSNR \d+\.\d+ dB|x264 +not compared: ffmpeg failed: [^\[]")
        else:
            self.assertIn("x264          not compared: ffmpeg is not installed", text)
        done = subprocess.run([PROGRAM, "compare", "a.y4m", "a.kvd"], capture_output=True, check=True,
                              cwd=self.folder, env={**os.environ, "PATH": "/none"})
        self.assertIn(b"not compared: ffmpeg is not installed", done.stdout)
        piped = self.run_program("compare", "-", "a.kvd", data=video).stdout
        self.assertIn(b"not compared: the source is a pipe", piped)

    def test_x264_keeps_the_range_of_samples(self):
        if not shutil.which("ffmpeg"):
            self.skipTest("ffmpeg is not installed")
        luma = (bytes([0]) * 32 + bytes([255]) * 32) * 48
        video = (b"YUV4MPEG2 W64 H48 F25:1 C444 XCOLORRANGE=FULL\n"
                 + (b"FRAME\n" + luma + bytes([128]) * (2 * len(luma))) * 8)
        (self.folder / "a.y4m").write_bytes(video)
        # With so many bits x264 meets every sample.
        self.run_program("encode", "a.y4m", "a.kvd", "--points", 300, "--turn-every", 1, "--color-step", 0.125)
        text = self.run_program("compare", "a.y4m", "a.kvd").stdout.decode()
        if "not compared: ffmpeg failed" in text:
            self.skipTest(text)  # it is without x264
        psnr = re.search(r"^x264 y +PSNR (\S+) dB", text, re.MULTILINE)
        self.assertTrue(psnr, text)
        # Samples of limited range are 16 to 235: 16 and 20 off here, which is 23 dB.
        self.assertGreater(float(psnr[1]), 40)

    def test_the_commands_of_the_lesson_work(self):
        root = pathlib.Path(__file__).resolve().parents[2]
        lesson = (root / "docs/guide/video.md").read_text(encoding="utf-8")
        commands = "".join(re.findall(r"```sh\n(.*?)```", lesson, re.DOTALL))
        self.assertEqual(len(commands.splitlines()), 7)
        commands = commands.replace("examples/python/", f"{sys.executable} '{root}'/examples/python/")
        subprocess.run(["bash", "-euc", commands], check=True, capture_output=True, cwd=self.folder, env={
            **os.environ, "PATH": f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}"})
        self.assertEqual(self.names(), ["frames", "slow.y4m", "wheel.html", "wheel.kvd", "wheel.y4m"])

    def test_help_manual_and_completions_name_all_commands(self):
        text = self.run_program("--help").stdout.decode()
        for command in ("encode", "decode", "play", "info", "compare"):
            self.assertIn(command, text)
            self.assertIn("Example", self.run_program(command, "--help").stdout.decode())
            self.assertIn(command, self.run_program("completion", "bash").stdout.decode())
        self.assertIn("kinetri-video", self.run_program("--version").stdout.decode())
        self.assertIn(".TH KINETRI", self.run_program("manual").stdout.decode())
        self.assertIn("complete -F _kinetri-video kinetri-video",
                      self.run_program("completion", "bash").stdout.decode())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
