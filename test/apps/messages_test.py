#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Brings about every message of the program, which messages.txt lists: each case runs the program on
something that is wrong, and expects exactly one listed message, byte for byte, its exit code, nothing on
standard output, and a directory as it was before. Every listed message has a case.

usage: messages_test.py PROGRAM FAULTY_PROGRAM
"""
import dataclasses
import itertools
import os
import pathlib
import re
import resource
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True
import input_messages  # noqa: E402
import render_messages  # noqa: E402
import run_messages  # noqa: E402
from message_case import FAULTY_PROGRAM, FILES, ONE_FLIP, PROGRAM  # noqa: E402

LIST = pathlib.Path(__file__).with_name("messages.txt")
SECTION = re.compile(r"\[exit code (\d+)(, usage)?\]")
PLACEHOLDER = re.compile(r"<[a-z]\w*>")

# Listed messages that are not brought about, by the reason.
WITHOUT_CASE = {
    "only where the system has an empty mounted directory": [
        "<path>: is where a file system is mounted; expected a directory in it"],
    "main_test.cpp brings it about": [
        "kinetri: interrupted within an instant, or another step that is long; nothing written"],
    "verification_test.py brings it about": [
        "--verify: <path> cannot be executed; expected the program kinetri-verify, which is built and installed with kinetri",
        "/tmp: writing a temporary file for --verify failed: <reason>; expected space for the logs, or --events, "
        "--motions, --initial-edges and --edges with files elsewhere",
        "kinetri: <path> ended without an answer; expected that it verifies the run, or says what is wrong"],
    "only where the module has not been built": [
        "kinetri: this kinetri has been built without the module of live pages; build it with scripts/platform.sh wasm, "
        "then build kinetri again"],
    "it would take a file of many gigabytes": [
        "<file>:<line>: there are too many points; expected at most 4294967294"],
}
if "KINETRI_SANITIZED" in os.environ:
    WITHOUT_CASE["UndefinedBehaviorSanitizer opens files itself"] = [
        "/tmp: no temporary file can be made: <reason>; expected a directory in which files can be created"]


# ---- the list ----

@dataclasses.dataclass(frozen=True)
class Row:
    message: str
    exit_code: int
    is_usage: bool  # printed with the command's name, and a line about --help

    def filled(self, case):
        """What is printed if the row's placeholders are the case's values; None if they are not."""
        if {name[1:-1] for name in PLACEHOLDER.findall(self.message)} != set(case.values):
            return None
        text = PLACEHOLDER.sub(lambda match: case.values[match[0][1:-1]], self.message)
        if not self.is_usage:
            return text + "\n"
        name = command(case.arguments)
        return f"{name}: {text}\nRun '{name} --help' for what is possible.\n"


def command(arguments):
    """The full name of the command that the arguments choose."""
    name = "kinetri"
    commands = input_messages.COMMANDS
    for word in arguments.split():
        if word in re.split(", | or ", commands):
            name += " " + word
            commands = input_messages.SCENARIOS if word == "generate" else ""
    return name


def rows():
    found = []
    for line in LIST.read_text(encoding="utf-8").splitlines():
        if section := SECTION.fullmatch(line):
            exit_code, is_usage = int(section[1]), bool(section[2])
        elif line and not line.startswith("#"):
            found.append(Row(line, exit_code, is_usage))
    return found


# ---- running ----

def contents(directory, *, is_running=False):
    """What is in the directory: the text of each file, the kind of everything else.

    While a program runs, without its temporary files, which may vanish at any moment.
    """
    found = {}
    for path in sorted(directory.rglob("*")):
        name = str(path.relative_to(directory))
        if is_running and ".kinetri-" in name:
            continue
        try:
            found[name] = path.read_bytes() if path.is_file() else path.is_dir()
        except PermissionError:
            found[name] = "unreadable"
    return found


def limits(case):
    """What is to be done in the new process."""
    def apply():
        if case.closes_output:
            os.close(1)
        if case.limit_files:
            resource.setrlimit(resource.RLIMIT_NOFILE, (case.limit_files, case.limit_files))
        if case.unprivileged and os.geteuid() == 0:
            os.setgroups([])
            os.setgid(65534)
            os.setuid(65534)

    return apply


def opened_pipe(path, process):
    """The pipe, when the process has opened it; None if the process ends without."""
    while process.poll() is None:
        try:
            return os.fdopen(os.open(path, os.O_WRONLY | os.O_NONBLOCK), "w")
        except OSError:
            time.sleep(0.001)
    return None


class Messages(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        # Where a user without permissions can run it.
        cls.copy = shutil.copy(PROGRAM, folder.name)
        pathlib.Path(folder.name).chmod(0o755)

    def run_case(self, case):
        """(exit code, standard output, standard error)."""
        with tempfile.TemporaryDirectory() as folder:
            directory = pathlib.Path(folder)
            directory.chmod(0o777)
            for name, text in {**FILES, **case.files}.items():
                (directory / name).write_text(text, encoding="utf-8")
            if case.below:
                (directory / case.below).mkdir()
            if case.meanwhile:
                (directory / "p.csv").unlink()
                os.mkfifo(directory / "p.csv")
            if case.prepare:
                case.prepare(directory)
            before = contents(directory)
            program = FAULTY_PROGRAM if case.faulty else self.copy if case.unprivileged else PROGRAM
            output = case.output if case.output == subprocess.PIPE else open(case.output, "wb")
            environment = {**os.environ, "LC_ALL": "C", **case.environment}
            process = subprocess.Popen(
                [program, *shlex.split(case.arguments)], cwd=directory / case.below, env=environment,
                stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.PIPE,
                preexec_fn=limits(case))
            if case.meanwhile:
                pipe = opened_pipe(directory / "p.csv", process)
                case.meanwhile(directory, process)
                before = contents(directory, is_running=True)
                try:
                    pipe.write(ONE_FLIP)
                    pipe.close()
                except BrokenPipeError:
                    pass
            out, err = process.communicate(timeout=60)
            if case.output != subprocess.PIPE:
                output.close()
            if not case.writes:
                self.assertEqual(contents(directory), before)
            return process.returncode, out or b"", err.decode()

    def check(self, case, all_rows):
        """The row that the case brings about."""
        code, out, err = self.run_case(case)
        self.assertEqual(out, b"", err)
        is_right = (lambda text: text in err) if case.writes else (lambda text: text == err.removeprefix("\n"))
        found = [row for row in all_rows if (text := row.filled(case)) and is_right(text)]
        self.assertEqual(len(found), 1, f"not in {LIST.name} with these values: {err}")
        self.assertEqual(code, found[0].exit_code, err)
        return found[0]

    def test_every_message_is_as_listed(self):
        all_rows = rows()
        self.assertGreater(len(all_rows), 100)
        seen = set()
        for case in itertools.chain(input_messages.cases(), run_messages.cases(), render_messages.cases()):
            if case.limit_files and "KINETRI_SANITIZED" in os.environ:
                continue
            with self.subTest(case.arguments, **case.values):
                seen.add(self.check(case, all_rows))
        without = {message for messages in WITHOUT_CASE.values() for message in messages}
        missing = [row.message for row in all_rows if row not in seen and row.message not in without]
        self.assertEqual(missing, [], "no case brings these about")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
