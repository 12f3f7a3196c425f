#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the program does where a standard stream is closed, full, or cannot be read: every command ends
as it does otherwise, with the same outputs, unless it is this stream that it cannot do without.

usage: streams_test.py PROGRAM FAULTY_PROGRAM
"""
import dataclasses
import functools
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, FAULTY_PROGRAM = (str(pathlib.Path(path).resolve()) for path in sys.argv[1:3])

POINTS = "x,y,vx,vy\n0,0,0,0\n4,0,0,0\n0,4,0,0\n3,3,1,1\n9,1,-1,0.5\n"
TRACKS = "t,id,x,y\n0,a,0,0\n0,b,9,0\n0,c,4,7\n5,a,1,1\n5,b,9,1\n5,c,4,-2\n"
HAS_GNUPLOT = shutil.which("gnuplot") is not None


@dataclasses.dataclass(frozen=True)
class Command:
    arguments: str
    writes_output: bool = False  # to standard output
    reads_input: str = ""  # the file that standard input is
    exit_code: int = 0
    fault: str = ""  # that the program has


# With --progress always, so that much is written to standard error.
LOUD = "--progress always"
RUN_OUTPUTS = f"--events e.csv --initial-edges i.csv --edges d.csv --stats s.json --html h.html {LOUD}"
COMMANDS = [
    Command("generate uniform --points 50 --output new.csv"),
    Command("generate lattice --points 50", writes_output=True),
    Command(f"simulate p.csv --until 3 {RUN_OUTPUTS} --checkpoint c --frames f --vtu v --audit events"),
    Command(f"simulate p.csv --until 3 --events - --edges d.csv --checkpoint c {LOUD}", writes_output=True),
    Command(f"simulate - --until 3 {RUN_OUTPUTS}", reads_input="p.csv"),
    Command(f"resume old.kinetri --until 4 {RUN_OUTPUTS} --checkpoint c"),
    Command(f"resume - --until 4 --stats s.json --edges - {LOUD}", reads_input="old.kinetri",
            writes_output=True),
    Command(f"tracks t.csv {RUN_OUTPUTS} --ids ids.csv --closest 2", writes_output=True),
    Command(f"tracks - --events e.csv {LOUD}", reads_input="t.csv"),
    Command(f"wave --rows 3 --columns 3 {RUN_OUTPUTS}"),
    Command(f"experiment --single 50 --points 20 {RUN_OUTPUTS}"),
    Command(f"experiment --output r --points 9 --until 1 --seeds 1 --compare --no-plots {LOUD}"),
    Command("completion zsh", writes_output=True),
    Command("manual", writes_output=True),
    Command("help simulate", writes_output=True),
    Command("--help", writes_output=True),
    Command("generate uniform --help", writes_output=True),
    Command("--version", writes_output=True),
    Command("simulate p.csv", exit_code=2),
    Command("simulate missing.csv --until 1 --events e.csv", exit_code=2),
    Command(f"simulate p.csv --until 3 --edges d.csv --audit events {LOUD}", exit_code=1,
            fault="audit"),
    Command(f"simulate p.csv --until 3 --edges d.csv --audit events {LOUD}", exit_code=3,
            fault="internal"),
]
if HAS_GNUPLOT:
    COMMANDS += [
        Command(f"simulate p.csv --until 3 --events e.csv --plot plot.svg {LOUD}"),
        Command(f"experiment --output r --points 9 --until 1 --seeds 1 {LOUD}"),
    ]


def comparable(name, content):
    """The content of an output without what differs from run to run."""
    if name == "s.json":
        stats = json.loads(content)
        return {key: value for key, value in stats.items() if key not in ("seconds", "peak_rss_bytes")}
    if name.endswith((".svg", ".png")) and name.startswith(("plot", "r/")):
        return len(content) > 0
    if name.startswith("r/"):
        rows = [row.split(",") for row in content.decode().splitlines()]
        timed = [i for i, column in enumerate(rows[0]) if "seconds" in column]
        return [[field for i, field in enumerate(row) if i not in timed] for row in rows]
    return content


class Streams(unittest.TestCase):
    maxDiff = 2000

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.inputs = pathlib.Path(folder.name)
        (cls.inputs / "p.csv").write_text(POINTS, encoding="utf-8")
        (cls.inputs / "t.csv").write_text(TRACKS, encoding="utf-8")
        subprocess.run([PROGRAM, "simulate", "p.csv", "--until", "2", "--checkpoint", "old.kinetri", "-q"],
                       cwd=cls.inputs, check=True)

    def run_command(self, command, redirections=""):
        """(exit code, standard output, standard error, outputs) where a shell redirects streams."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for path in self.inputs.iterdir():
                shutil.copy(path, folder)
            with open(folder / (command.reads_input or "/dev/null"), "rb") as standard_input:
                done = subprocess.run(
                    ["sh", "-c", f'exec "$0" {command.arguments} {redirections}',
                     FAULTY_PROGRAM if command.fault else PROGRAM],
                    cwd=folder, env={**os.environ, "KINETRI_TEST_FAULT": command.fault},
                    stdin=standard_input, capture_output=True, check=False, timeout=120)
            outputs = {}
            for path in sorted(folder.rglob("*")):
                relative = str(path.relative_to(folder))
                if path.is_file() and not (self.inputs / relative).exists():
                    outputs[relative] = comparable(relative, path.read_bytes())
            return done.returncode, done.stdout, done.stderr.decode(), outputs

    @functools.cache
    def usual_end(self, command):
        """(exit code, standard output, outputs)."""
        code, out, _, outputs = self.run_command(command)
        return code, out, outputs

    def expect_usual_end(self, redirections, commands):
        for command in commands:
            with self.subTest(command.arguments, redirections=redirections):
                code, out, _, outputs = self.run_command(command, redirections)
                usual_code, usual_out, usual_outputs = self.usual_end(command)
                self.assertEqual(usual_code, command.exit_code)
                self.assertEqual(code, usual_code)
                self.assertEqual(outputs.keys(), usual_outputs.keys())
                self.assertEqual(outputs, usual_outputs)
                self.assertEqual(out, usual_out)

    def expect_error(self, redirections, commands, message):
        for command in commands:
            with self.subTest(command.arguments, redirections=redirections):
                code, out, error, outputs = self.run_command(command, redirections)
                self.assertEqual((code, out, outputs), (2, b"", {}))
                self.assertIn(message, error)

    def test_standard_error_that_takes_nothing_changes_nothing(self):
        for redirection in ("2>&-", "2>/dev/full", "2</dev/null"):
            self.expect_usual_end(redirection, COMMANDS)

    def test_closed_streams_that_are_not_needed_change_nothing(self):
        neither = [c for c in COMMANDS if not c.writes_output and not c.reads_input]
        self.expect_usual_end("<&- >&- 2>&-", neither)
        self.expect_usual_end("<&-", [c for c in COMMANDS if not c.reads_input])
        self.expect_usual_end(">&-", [c for c in COMMANDS if not c.writes_output])

    def test_output_that_is_needed_and_closed_is_an_error_before_the_run(self):
        writers = [command for command in COMMANDS if command.writes_output]
        for redirections in (">&-", "<&- >&-", "1</dev/null"):
            self.expect_error(redirections, writers,
                              "standard output: is closed, or open for reading alone; expected it open "
                              "for writing\n")

    def test_output_that_is_full_is_an_error(self):
        self.expect_error(">/dev/full", [command for command in COMMANDS if command.writes_output],
                          "standard output: writing failed: No space left on device; expected a place "
                          "that takes all of it\n")

    def test_input_that_cannot_be_read_is_no_empty_file(self):
        readers = [command for command in COMMANDS if command.reads_input]
        for redirections in ("<&-", "0>/dev/null", "< ."):
            for command in readers:
                message = ("standard input: cannot be read to its end; expected a readable file\n"
                           if command.arguments.startswith("resume") else
                           "standard input:1: reading failed; expected a readable file of ")
                self.expect_error(redirections, [command], message)

    def test_file_that_grows_too_large_is_an_error(self):
        many = Command("generate uniform --points 2000 --output new.csv")
        code, out, error, outputs = self.run_command(many)
        self.assertEqual((code, out, error, list(outputs)), (0, b"", "", ["new.csv"]))
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(["sh", "-c", f'ulimit -f 8; exec "$0" {many.arguments}', PROGRAM],
                                  cwd=folder, capture_output=True, text=True, check=False)
            self.assertEqual(done.stderr, "new.csv: writing failed: File too large; expected a place that "
                                          "takes all of it\n")
            self.assertEqual((done.returncode, os.listdir(folder)), (2, []))

    @unittest.skipIf("KINETRI_SANITIZED" in os.environ, "AddressSanitizer reserves more address space")
    def test_input_without_line_ends_is_refused_in_little_memory(self):
        longest = "the line is longer than {} bytes; expected"
        first_line = "kinetri checkpoint 8\\n"
        for arguments, beginning, problem in (
                ("simulate {} --until 1", "x,y,vx,vy\\n", longest.format(1 << 20)),
                ("tracks {}", "t,id,x,y\\n", longest.format(1 << 20)),
                ("tracks {} --format frames", "0 a 1 2\\n", longest.format(1 << 20)),
                ("resume {} --until 1", first_line, longest.format(1 << 24)),
                ("resume {} --until 1", "", "is no checkpoint: it begins with '\\x00")):
            for line in ('exec "$0" ' + arguments.format("/dev/zero"),
                         f"(printf '{beginning}'; cat /dev/zero) | \"$0\" " + arguments.format("-")):
                if line.startswith("exec") and beginning == first_line:
                    continue  # Only a pipe begins so.
                with self.subTest(line):
                    # Of the limit, in units of 1024 bytes, most is for what the program itself takes.
                    done = subprocess.run(["sh", "-c", f"ulimit -v 600000; {line}", PROGRAM],
                                          stdin=subprocess.DEVNULL, capture_output=True, text=True,
                                          check=False, timeout=120)
                    self.assertIn(problem, done.stderr)
                    self.assertEqual((done.returncode, done.stdout), (2, ""))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
