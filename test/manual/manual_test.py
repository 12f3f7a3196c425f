#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The manual page and the completions agree with what --help says.

usage: manual_test.py page|bash|zsh|fish PROGRAM FOLDER

FOLDER holds NAME.1, NAME.bash, _NAME and NAME.fish, where NAME is that of the program. Exit code 77 where there is no such
shell, or no man.
"""
import os
import pathlib
import pty
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest

SKIPPED = 77
FILES = ["one", "one folder/"]  # What completes a file of `one`; a directory: the second.

# `  -n, --name TYPE   Description`, where the description may be on the next line.
OPTION = re.compile(r"^  ((?:-\S, )?(?:--\S+, )*--\S+|[A-Z]+)(?: (\S+))?(?: |$)")


class Command:
    """A command as its --help describes it."""

    def __init__(self, words):
        self.words = words
        text = run([PROGRAM, *words[1:], "--help"])
        self.commands, self.options, self.positional = [], {}, None
        section = None
        for line in text.splitlines():
            if re.fullmatch(r"[A-Z].*:", line):
                section = line
            elif not line.startswith("  ") or section == "Example:":
                section = None
            elif section == "Commands:":
                if not line.startswith("   "):
                    self.commands.append(line.split()[0])
            elif section and (found := OPTION.match(line)):
                names, kind = found.groups()
                if section == "Arguments:":
                    self.positional = (names, kind)
                else:
                    self.options.update((name, kind) for name in names.split(", "))

    @property
    def line(self):
        return " ".join(self.words)


def run(command, text="", **settings):
    done = subprocess.run(command, capture_output=True, text=True, input=text, check=False,
                          **settings)
    if done.returncode != 0 or done.stderr:
        raise AssertionError(f"{command} ended with {done.returncode}: {done.stderr}")
    return done.stdout


def all_commands(words=()):
    command = Command(list(words) or [NAME])
    yield command
    for name in command.commands:
        yield from all_commands([*command.words, name])


def values_of(kind):
    """What completes an empty value of this kind; `one` of a file."""
    if kind is not None and "|" in kind:
        return sorted(kind.split("|"))
    return {"FILE": FILES, "DIR": FILES[1:]}.get(kind, [])


def questions():
    """(command line, what completes its last word) for every command, option and value."""
    for command in all_commands():
        line = command.line
        if not command.commands:  # zsh completes `-` to `one-mover` too.
            yield line + " -", sorted(command.options)
        yield line + " --", sorted(name for name in command.options if name.startswith("--"))
        if command.commands:
            yield line + " ", sorted(command.commands)
        if command.positional:
            word = "one" if command.positional[1] == "FILE" else ""
            yield f"{line} {word}", values_of(command.positional[1])
        for name, kind in command.options.items():
            if kind is not None:
                word = "one" if kind in ("FILE", "DIR") else ""
                yield f"{line} {name} {word}", values_of(kind)
    if NAME == "kinetri-video":
        yield "kinetri-video encode --placement=", ["content", "grid"]
        yield "kinetri-video dec", ["decode"]
        return
    # The value of an option is no command, and what has been completed does not matter.
    yield "kinetri simulate --events generate --audit e", ["end", "events"]
    yield "kinetri simulate points.csv --audit e", ["end", "events"]
    yield "kinetri simulate --audit=e", ["end", "events"]
    yield "kinetri simulate --audit=", ["end", "events", "none"]
    yield "kinetri gen", ["generate"]
    yield "kinetri simulate --radius 2 --frames-", ["--frames-per-time"]
    yield "kinetri simulate --nonsense", []


class Documents(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "one").touch()
        (self.folder / "one folder").mkdir()

        self.asked = list(questions())
        self.lines = "".join(line + "\n" for line, _ in self.asked)

    def check(self, output, word_of=str):
        """`output`: for each question the words, a line each, as word_of reads it; then `.`."""
        answers = [set()]
        for line in output.splitlines():
            if line == ".":
                answers.append(set())
            elif line:
                answers[-1].add(word_of(line))
        self.assertGreater(len(self.asked), 30)
        self.assertEqual(len(answers), len(self.asked) + 1)
        for (line, expected), answer in zip(self.asked, answers):
            with self.subTest(line=line):
                self.assertEqual(sorted(answer), expected)


class Manual(Documents):
    def test_every_command_and_option_is_there(self):
        page = run(["man", "--warnings", "-E", "UTF-8", "-P", "cat", "-l", "-"],
                   (FOLDER / f"{NAME}.1").read_text(),
                   env={**os.environ, "MANWIDTH": "200", "LC_ALL": "C.UTF-8"})
        page = re.sub(r".\x08", "", page)
        self.assertRegex(page, rf"NAME\n +{NAME} - .*kinetic Delaunay")
        sections = re.split(rf"^   (?={NAME})", page, flags=re.MULTILINE)
        for command in all_commands():
            if len(command.words) == 1:
                section = sections[0]
            else:
                expected = re.compile(re.escape(command.line) + r"( [A-Z\[\]]+)*\n")
                section = next((text for text in sections if expected.match(text)), None)
                self.assertIsNotNone(section, command.line)
            for name, kind in command.options.items():
                if name in ("-h", "--help") and len(command.words) > 1:
                    continue
                value = "" if kind is None else " " + re.escape(kind)
                entry = rf"^ +(\S+, )*{name}(, \S+)*{value}( |$)"
                self.assertRegex(section, re.compile(entry, re.MULTILINE))


class Bash(Documents):
    def test_completes_what_help_lists(self):
        # Called as bash calls it, which splits words at `=`; compopt only works in a completion.
        script = """
            source "$1"
            [[ $(complete -p NAME) == 'complete -F _NAME NAME' ]] || exit 1
            compopt() { [[ $1 == -o ]] && asked=$2; }
            while IFS= read -r line; do
              read -ra COMP_WORDS <<<"${line//=/ = }"
              [[ $line != *[\\ =] ]] || COMP_WORDS+=("")
              [[ $line != *= ]] || unset 'COMP_WORDS[-1]'
              COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) asked= COMPREPLY=(wrong)
              _NAME NAME
              case $asked in
                default) mapfile -t COMPREPLY < <(compgen -f one) ;;
                dirnames) mapfile -t COMPREPLY < <(compgen -d one) ;;
              esac
              printf '%s\\n' "${COMPREPLY[@]}" .
            done <"$2"
        """.replace("NAME", NAME)
        questions_file = self.folder / "questions"
        questions_file.write_text(self.lines)
        output = run(["bash", "--norc", "-uc", script, "bash", FOLDER / f"{NAME}.bash",
                      questions_file], cwd=self.folder)
        self.check(output, lambda word: word + "/" if word == "one folder" else word)


class Fish(Documents):
    def test_completes_what_help_lists(self):
        script = """
            source $argv[1]
            while read line
              complete -C $line
              echo .
            end <$argv[2]
        """
        questions_file = self.folder / "questions"
        questions_file.write_text(self.lines)
        output = run(["fish", "--no-config", "-c", script, FOLDER / f"{NAME}.fish", questions_file],
                     cwd=self.folder, env={**os.environ, "HOME": str(self.folder)})
        # A word and its description; a value after `=` with its option.
        self.check(output, lambda line: re.sub(r"^--\w+=", "", line.split("\t")[0]))


class Zsh(Documents):
    def test_completes_what_help_lists(self):
        # The line editor itself completes each line, before the first prompt; what it would add is
        # written down.
        (self.folder / ".zshrc").write_text("""
            fpath=($KINETRI_FOLDER $fpath)
            autoload -Uz compinit
            compinit -u -D
            compadd() {
              if [[ ${argv[1,(i)(-|--)]} != *-[OAD]* ]]; then
                local -a found
                builtin compadd -A found "$@"
                print -rl -- $found >>answers
              fi
              builtin compadd "$@"
            }
            zle-line-init() {
              local line
              for line in "${(@f)$(<questions)}"; do
                BUFFER=$line
                CURSOR=$#BUFFER
                zle complete-word
                print . >>answers
              done
              exit 0
            }
            zle -N zle-line-init
        """)
        (self.folder / "questions").write_text(self.lines)
        ours, shells = pty.openpty()
        process = subprocess.Popen(
            ["zsh", "-d", "-i"], stdin=shells, stdout=shells, stderr=shells, cwd=self.folder,
            start_new_session=True, env={**os.environ, "ZDOTDIR": str(self.folder), "TERM": "vt100",
                                         "KINETRI_FOLDER": str(FOLDER)})
        os.close(shells)

        def drain():
            try:
                while os.read(ours, 4096):
                    pass
            except OSError:
                pass  # The shell has ended.

        reader = threading.Thread(target=drain)
        reader.start()
        process.wait()
        reader.join()
        os.close(ours)
        self.check((self.folder / "answers").read_text(),
                   lambda word: "one folder/" if word == r"one\ folder" else word)


TESTS = {"page": (Manual, "man"), "bash": (Bash, "bash"), "zsh": (Zsh, "zsh"),
         "fish": (Fish, "fish")}

if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[1] not in TESTS:
        sys.exit(__doc__)
    test, needed = TESTS[sys.argv[1]]
    PROGRAM, FOLDER = (pathlib.Path(argument).resolve() for argument in sys.argv[2:])
    NAME = PROGRAM.name
    if shutil.which(needed) is None:
        print(f"skipped: {needed} is not installed")
        sys.exit(SKIPPED)
    result = unittest.TextTestRunner().run(unittest.defaultTestLoader.loadTestsFromTestCase(test))
    sys.exit(not result.wasSuccessful())
