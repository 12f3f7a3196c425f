#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The option --verify: what kinetri gives to kinetri-verify, and what it makes of the answer. Mostly with a
program in its place that writes down what it gets.

usage: verification_test.py PROGRAM VERIFY
"""
import functools
import json
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, VERIFY = (str(pathlib.Path(path).resolve()) for path in sys.argv[1:3])

# Writes down its arguments and the files among them, and answers as the file `answer` says.
WITNESS = """#!{python}
import json, os, pathlib, sys, time
here = pathlib.Path(__file__).resolve().parent
files = [word for word in sys.argv[1:] if os.path.exists(word)]
(here / "seen").write_text(json.dumps({{
    "pid": os.getpid(), "arguments": sys.argv[1:],
    "files": {{path: pathlib.Path(path).read_text() for path in files}}}}))
answer = json.loads((here / "answer").read_text())
print(answer["says"])
sys.stdout.flush()
time.sleep(answer.get("sleeps", 0))
os.abort() if answer["code"] < 0 else sys.exit(answer["code"])
"""

POINTS = "x,y,vx,vy\n1,1,3,1\n9,2,-2,1\n2,8,1,-3\n8,8.5,-1,-2\n5,4,0.5,0.25\n"
TRACKS = "t,id,x,y\n0,a,0,0\n9,a,1,0\n0,b,9,0\n9,b,9,1\n0,c,0,9\n9,c,0,8\n2,d,1,1\n4,d,3,2\n6,d,2,2\n"
DISCS = "--box 0,0,10,10 --rim --collisions elastic --radius 0.5"


class Verification(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.bin = self.folder / "bin"
        self.bin.mkdir()
        shutil.copy(PROGRAM, self.bin / "kinetri")
        self.write("p.csv", POINTS)
        self.write("t.csv", TRACKS)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def read(self, name):
        return (self.folder / name).read_text(encoding="utf-8")

    def place_witness(self, says="verified: all", code=0, **more):
        witness = self.bin / "kinetri-verify"
        witness.write_text(WITNESS.format(python=sys.executable), encoding="utf-8")
        witness.chmod(0o755)
        (self.bin / "answer").write_text(json.dumps({"says": says, "code": code, **more}), encoding="utf-8")

    def start(self, command, **more):
        return subprocess.Popen([self.bin / "kinetri", *command.split()], cwd=self.folder, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, **more)

    def run_program(self, command, code=0, **more):
        process = self.start(command, **more)
        out, error = process.communicate(timeout=120)
        self.assertEqual(process.returncode, code, error)
        return out, error

    def seen(self):
        return json.loads((self.bin / "seen").read_text(encoding="utf-8"))

    def options_seen(self):
        """By name; the first two arguments are POINTS and EVENTS."""
        words = self.seen()["arguments"]
        result = {"POINTS": words[0], "EVENTS": words[1]}
        name = None
        for word in words[2:]:
            if word.startswith("--"):
                name = word
                result[name] = True
            else:
                result[name] = word
        return result

    # ---- what kinetri-verify gets ----

    def expect_files(self, command, **expected):
        """That it gets the logs as they are written, the options of the run, and `expected`."""
        self.place_witness()
        self.run_program(f"{command} --events e --motions m --initial-edges i --edges d --quiet")
        logs = {name: self.read(file) for name, file in
                (("EVENTS", "e"), ("--motions", "m"), ("--initial-edges", "i"), ("--edges", "d"))}
        out, error = self.run_program(f"{command} --verify --quiet")
        self.assertEqual((out, error), ("verified: all\n", ""))
        options = self.options_seen()
        files = self.seen()["files"]
        if expected.pop("is_plain", False):
            self.assertNotIn("--motions", options)
            del logs["--motions"]
        for name, text in logs.items():
            self.assertEqual(files[options.pop(name)], text, name)
        points = options.pop("POINTS")
        if "points" in expected:
            self.assertEqual(points, expected.pop("points"))
        else:
            self.assertEqual(files[points], logs["--motions"])
        expected.setdefault("collisions", "none")
        self.assertEqual(options, {"--" + name: value for name, value in expected.items()})

    def test_gets_the_points_the_logs_and_the_options(self):
        self.expect_files("simulate p.csv --until 3 --from 0.5", points="p.csv", **{"from": "0.5"}, until="3",
                          is_plain=True)
        self.expect_files(f"simulate p.csv --until 3 {DISCS}", points="p.csv", **{"from": "0"}, until="3",
                          box="0,0,10,10", rim=True, collisions="elastic")
        self.expect_files("simulate p.csv --until 3 --box -1e-7,0,10,0x1p4", points="p.csv", **{"from": "0"}, until="3",
                          box="-1e-07,0,10,16")

    def test_gets_the_motions_in_place_of_points_where_there_is_no_such_file(self):
        self.expect_files("tracks t.csv --until 5", **{"from": "0"}, until="5")
        self.expect_files("tracks t.csv --collisions log --radius 2", **{"from": "0"}, until="9", collisions="log")
        self.expect_files("wave --until 0.5", **{"from": "0"}, until="0.5", box="-5,-5,295,295", collisions="swap")
        self.run_program(f"simulate p.csv --until 1.5 {DISCS} --checkpoint c --quiet")
        self.expect_files("resume c --until 4", **{"from": "1.5"}, until="4", box="0,0,10,10", rim=True,
                          collisions="elastic")

    def test_gets_the_motions_where_the_points_came_from_a_pipe(self):
        self.place_witness()
        with open(self.folder / "p.csv", encoding="utf-8") as points:
            self.run_program("simulate - --until 3 --motions m --verify --quiet", stdin=points)
        self.assertEqual(self.options_seen()["POINTS"], "m")

    def test_reads_the_outputs_of_the_run_where_they_are_files(self):
        self.place_witness()
        self.run_program("simulate p.csv --until 3 --events e --edges /dev/null --initial-edges - --verify --quiet")
        options = self.options_seen()
        self.assertEqual(options["EVENTS"], "e")
        files = self.seen()["files"]
        self.assertEqual(files["e"], self.read("e"))
        for name in ("--edges", "--initial-edges"):
            self.assertTrue(files[options[name]].startswith("a,b\n0,"), name)

    # Of a run that ends at no binary64 number, the next one after its end.
    def test_gets_the_time_that_the_run_has_come_to(self):
        self.place_witness()
        _, error = self.run_program("simulate p.csv --until 9 --max-events 1 --verify --events e", 130)
        self.assertIn("more than 1 events", error)
        times = [line.split(",")[4] for line in self.read("e").splitlines()[1:]]
        self.assertEqual(self.options_seen()["--until"], times[-1])

    # ---- the answer ----

    def test_answer_goes_to_standard_output_unless_an_output_does(self):
        self.place_witness("verified: 5 points")
        out, error = self.run_program("simulate p.csv --until 3 --verify")
        self.assertEqual(out, "verified: 5 points\n")
        self.assertIn("5 points from t = 0 to 3", error)
        self.assertNotIn("/dev/fd", error)
        out, error = self.run_program("simulate p.csv --until 3 --edges - --verify --quiet")
        self.assertTrue(out.startswith("a,b\n"))
        self.assertNotIn("verified", out)
        self.assertEqual(error, "verified: 5 points\n")

    def test_exit_code_is_that_of_the_answer(self):
        for code in (0, 1, 2):
            self.place_witness("some answer", code)
            out, error = self.run_program("simulate p.csv --until 3 --edges d --verify --quiet", code)
            self.assertEqual((out, error), ("some answer\n", ""))
            self.assertTrue(self.read("d").startswith("a,b\n"))

    def test_no_answer_is_an_internal_error(self):
        for code in (3, -1):
            self.place_witness("", code)
            _, error = self.run_program("simulate p.csv --until 3 --verify --quiet", 3)
            self.assertEqual(error, f"kinetri: {self.bin}/kinetri-verify ended without an answer; expected that it "
                                    "verifies the run, or says what is wrong\n")

    def test_a_verifier_that_is_not_there_is_named_before_the_run(self):
        _, error = self.run_program("simulate p.csv --until 3 --edges d --verify", 2)
        self.assertEqual(error, f"kinetri simulate: --verify: {self.bin}/kinetri-verify cannot be executed; "
                                "expected the program kinetri-verify, which is built and installed with kinetri\n"
                                "Run 'kinetri simulate --help' for what is possible.\n")
        self.assertFalse((self.folder / "d").exists())

    def test_logs_for_which_there_is_no_room_are_an_error(self):
        self.place_witness()
        limit = functools.partial(resource.setrlimit, resource.RLIMIT_FSIZE, (100, 100))
        _, error = self.run_program("simulate p.csv --until 3 --edges d --verify --quiet", 2, preexec_fn=limit)
        self.assertEqual(error, "/tmp: writing a temporary file for --verify failed: File too large; expected space for the logs, or --events, --motions, --initial-edges and --edges with files elsewhere\n")
        self.assertFalse((self.folder / "d").exists())
        self.assertFalse((self.bin / "seen").exists())

    def test_a_signal_ends_the_verification(self):
        self.place_witness(sleeps=100)
        process = self.start("simulate p.csv --until 3 --edges d --verify --quiet")
        self.assertEqual(process.stdout.readline(), "verified: all\n")
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        for _ in range(600):
            if not is_running(self.seen()["pid"]):
                break
            time.sleep(0.1)
        self.assertFalse(is_running(self.seen()["pid"]))
        self.assertTrue(self.read("d").startswith("a,b\n"))

    # ---- with kinetri-verify itself ----

    def test_runs_are_verified(self):
        shutil.copy(VERIFY, self.bin / "kinetri-verify")
        out, error = self.run_program("simulate p.csv --until 9 --verify --quiet")
        self.assertRegex(out, "^verified: 5 points, [0-9]+ events, [0-9]+ certificates\n$")
        self.assertEqual(error, "")


def is_running(process):
    """Whether the process is there and no zombie."""
    try:
        state = pathlib.Path(f"/proc/{process}/stat").read_text(encoding="utf-8")
    except FileNotFoundError:
        return False
    return state.rsplit(")", 1)[1].split()[0] != "Z"


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
