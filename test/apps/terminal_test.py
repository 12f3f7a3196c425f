#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the program does with terminals and pipes: colors on terminals only, and a silent end where
nobody reads standard output, with all outputs that are files.

usage: terminal_test.py PROGRAM
"""
import json
import os
import pathlib
import pty
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
POINTS = "x,y,vx,vy\n0,0,0,0\n4,0,0,0\n0,4,0,0\n3,3,1,1\n"
ESCAPE = "\x1b["
END = b"\0"
SIMULATE = ["simulate", "p.csv", "--until", "3"]


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "p.csv").write_text(POINTS, encoding="utf-8")


class Terminal(Program):
    def environment(self, changes):
        kept = {name: value for name, value in os.environ.items() if name != "NO_COLOR"}
        return {**kept, "TERM": "xterm", **changes}

    def on_terminal(self, arguments, **changes):
        """What the program writes to a terminal that is both of its outputs."""
        ours, its = pty.openpty()
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=its, stderr=its, env=self.environment(changes))
        self.addCleanup(process.kill)

        # Once nobody has the program's side open, Linux may give an error instead of what is still to be
        # read: so it stays open, and a character that the program never writes marks the end.
        def mark_end():
            try:
                process.wait(timeout=60)
            finally:
                os.write(its, END)

        waiting = threading.Thread(target=mark_end)
        waiting.start()
        text = b""
        while not text.endswith(END):
            text += os.read(ours, 4096)
        waiting.join()
        os.close(ours)
        os.close(its)
        self.assertIsNotNone(process.returncode, f"has not ended after a minute: {text}")
        return text.removesuffix(END).decode()

    def elsewhere(self, arguments):
        done = subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True,
                              check=False, env=self.environment({}))
        return done.stdout + done.stderr

    def test_headings_and_errors_are_colored_on_a_terminal(self):
        self.assertIn("\x1b[1;31mkinetri simulate:\x1b[0m POINTS is missing", self.on_terminal(["simulate"]))
        self.assertIn("\x1b[1;31mq.csv:\x1b[0m cannot be opened",
                      self.on_terminal(["simulate", "q.csv", "--until", "3"]))
        self.assertIn("\x1b[1mevents\x1b[0m       1 at 1 instant (1 flip)", self.on_terminal(SIMULATE))
        self.assertIn("\x1b[1mUsage:\x1b[0m kinetri", self.on_terminal(["--help"]))

    def test_nothing_is_colored_elsewhere(self):
        for arguments in (["simulate"], SIMULATE, ["--help"]):
            self.assertNotIn(ESCAPE, self.elsewhere(arguments))

    def test_no_color_and_dumb_terminals_are_honored(self):
        for arguments in (["simulate"], [*SIMULATE, "--progress", "never"], ["--help"]):
            self.assertNotIn(ESCAPE, self.on_terminal(arguments, NO_COLOR="1"))
            self.assertNotIn(ESCAPE, self.on_terminal(arguments, TERM="dumb"))
        # An empty variable is as good as none.
        self.assertIn(ESCAPE, self.on_terminal(["--help"], NO_COLOR=""))


class ClosedTerminal(Program):
    def test_a_run_in_it_stops_and_writes_what_it_has(self):
        subprocess.run([PROGRAM, "generate", "uniform", "--points", "3000", "-o", self.folder / "many.csv"],
                       check=True)
        arguments = ["simulate", "many.csv", "--until", "100000", "--events", "e.csv", "--checkpoint", "c"]
        process, ours = pty.fork()
        if process == 0:
            os.chdir(self.folder)
            signal.signal(signal.SIGHUP, signal.SIG_DFL)
            os.execv(PROGRAM, [PROGRAM, *arguments])
        text = b""
        while b"events/s" not in text:
            text += os.read(ours, 4096)
        os.close(ours)
        os.waitpid(process, 0)
        self.assertEqual(sorted(os.listdir(self.folder)), ["c", "e.csv", "many.csv", "p.csv"])
        resume = [PROGRAM, "resume", "c", "--until", "100000", "--max-events", "5", "--events", "f.csv", "--quiet"]
        self.assertEqual(subprocess.run(resume, cwd=self.folder, check=False, capture_output=True).returncode, 130)
        rows = (self.folder / "e.csv").read_text(encoding="utf-8").splitlines()
        self.assertGreater(len(rows), 1)
        first = (self.folder / "f.csv").read_text(encoding="utf-8").splitlines()[1]
        self.assertEqual(int(first.split(",")[0]), int(rows[-1].split(",")[0]) + 1)


class ClosedPipe(Program):
    def run_into_closed_pipe(self, arguments, lines=0):
        """(exit code, standard error) of a run whose output is read up to so many lines."""
        ours, its = os.pipe()
        if lines == 0:
            os.close(ours)
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=its, stderr=subprocess.PIPE)
        os.close(its)
        if lines > 0:
            with os.fdopen(ours) as output:
                for _ in range(lines):
                    output.readline()
        self.addCleanup(process.kill)
        error = process.communicate(timeout=60)[1].decode()
        return process.returncode, error

    def write_many_points(self):
        subprocess.run([PROGRAM, "generate", "uniform", "--points", "300", "-o", self.folder / "many.csv"],
                       check=True)

    def outputs(self):
        """What is in the files that a run has written, but for run times."""
        found = {path.relative_to(self.folder): path.read_bytes() for path in self.folder.rglob("*")
                 if path.is_file() and path.suffix != ".json"}
        stats = json.loads((self.folder / "stats.json").read_text(encoding="utf-8"))
        return found, stats["events"], stats["reached"]

    def test_the_program_ends_silently_when_its_only_output_is_not_read(self):
        self.write_many_points()
        before = sorted(os.listdir(self.folder))
        for output in ("--events", "--initial-edges"):
            # In a box a run to this time takes days.
            code, error = self.run_into_closed_pipe(
                ["simulate", "many.csv", "--until", "1e9", "--box", "-1,-1,200,200", output, "-"],
                lines=1 if output == "--events" else 0)
            self.assertEqual((code, error), (-signal.SIGPIPE, ""))
            self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_outputs_that_are_files_are_complete(self):
        self.write_many_points()
        run = ["simulate", "many.csv", "--until", "20", "--edges", "edges.csv", "--stats", "stats.json",
               "--frames", "frames", "--checkpoint", "run.kinetri", "--html", "run.html"]
        for output, lines in (("--events", 1), ("--events", 0), ("--initial-edges", 0)):
            subprocess.run([PROGRAM, *run, output, "/dev/null", "--quiet"], cwd=self.folder, check=True)
            usual = self.outputs()
            for path in usual[0]:
                if path.name not in ("p.csv", "many.csv"):
                    (self.folder / path).write_text("before", encoding="utf-8")
            shutil.rmtree(self.folder / "frames")
            code, error = self.run_into_closed_pipe([*run, output, "-"], lines)
            self.assertEqual((code, error), (-signal.SIGPIPE, ""))
            self.assertEqual(self.outputs(), usual)
            shutil.rmtree(self.folder / "frames")

    def test_files_of_every_command_that_runs_are_complete(self):
        subprocess.run([PROGRAM, "simulate", "p.csv", "--until", "0.5", "--checkpoint", "c", "--quiet"],
                       cwd=self.folder, check=True)
        edges = self.folder / "edges.csv"
        for run in (["resume", "c", "--until", "3"], ["wave", "--rows", "4", "--columns", "4"],
                    ["experiment", "--single", "50", "--points", "20"], SIMULATE):
            with self.subTest(run):
                subprocess.run([PROGRAM, *run, "--edges", "edges.csv", "--quiet"], cwd=self.folder,
                               check=True)
                usual = edges.read_bytes()
                edges.unlink()
                outcome = self.run_into_closed_pipe([*run, "--edges", "edges.csv", "--events", "-"])
                self.assertEqual(outcome, (-signal.SIGPIPE, ""))
                self.assertEqual(edges.read_bytes(), usual)

    def test_tracks_are_complete(self):
        (self.folder / "t.csv").write_text("t,id,x,y\n0,a,0,0\n0,b,9,0\n5,a,1,1\n5,b,9,1\n",
                                           encoding="utf-8")
        code, error = self.run_into_closed_pipe(["tracks", "t.csv", "--closest", "1", "--ids", "ids.csv"])
        self.assertEqual((code, error), (-signal.SIGPIPE, ""))
        self.assertEqual((self.folder / "ids.csv").read_text(encoding="utf-8"),
                         "point,id,first,last\n0,a,0,5\n1,b,0,5\n")

    def test_so_do_other_commands(self):
        for arguments in (["--help"], ["help", "simulate"], ["manual"], ["completion", "zsh"],
                          ["generate", "uniform", "--points", "100000"]):
            with self.subTest(arguments=arguments):
                self.assertEqual(self.run_into_closed_pipe(arguments), (-signal.SIGPIPE, ""))

    def test_another_output_that_fails_is_an_error(self):
        code, error = self.run_into_closed_pipe([*SIMULATE, "--events", "/dev/full"])
        self.assertEqual(code, 2)
        self.assertIn("/dev/full: writing failed: No space left on device", error)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
