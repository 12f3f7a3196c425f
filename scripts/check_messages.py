#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks docs/ERRORS.md against the sources: that it has every message with which something is
refused, and no row that no source has; and that every precondition's message is in a test.

usage: check_messages.py [ROOT]

Prints `FILE:LINE: what is wrong` for each violation; exit code 1 if there are any.
"""
import re
import sys

sys.dont_write_bytecode = True
import check_tree  # noqa: E402

LIST = "docs/ERRORS.md"

# Whose texts in parentheses are messages, in C++ and in the page's scripts.
CPP_CALLS = {"Usage_error", "Input_error", "Output_error", "Internal_error", "Error", "fail", "report"}
PAGE_CALLS = {"demand", "RecordingError", "TypeError", "push"}
# What the scripts and the build say.
SHELL_MESSAGE = re.compile(r'kinetri_(?:fail|misused) "((?:[^"\\]|\\.)*)"')
CMAKE_MESSAGE = re.compile(r'(?:FATAL_ERROR|APPEND kinetri_missing) "((?:[^"\\]|\\.)*)"')

CPP_TOKEN = re.compile(
    r'//[^\n]*|R"\((?:.|\n)*?\)"|(?P<text>"(?:[^"\\\n]|\\.)*")|\'(?:[^\'\\\n]|\\.)+\'|\w+|\S'
)
PAGE_TOKEN = re.compile(
    r"//[^\n]*|/\*(?:.|\n)*?\*/|(?P<text>`(?:[^`\\]|\\.)*`|'(?:[^'\\\n]|\\.)*')|\w+|\S"
)
# What differs from one message to the next: in a source, and in the list.
VARIABLE = re.compile(r"\$?\{[^{}]*\}|\$\w+")
PLACEHOLDER = re.compile(r"<[a-z]\w*>")
LEADING = re.compile(r"^(?:<\w+>[: ]*)+")
# A text without two words is a name, or a part of a message that has others.
WORDS = re.compile(r"\w[,;:]? \(?\w")

# Files without messages, or whose messages are one row of the list.
NO_MESSAGES = {
    "include/kinetri/triangulation/detail/audit_impl.h",  # findings of audits
    "src/io/event_log.cpp",
    "src/io/stats_file.cpp",
    "src/io/svg_frame.cpp",
    "src/io/viewer_page.cpp",
    "src/io/vtu_file.cpp",
}
# Texts that are in no row, by the reason.
NOT_LISTED = {
    "a table that operator<< writes": ["times of events", "most events at one time",
                                       "mean time between events"],
    "findings of audits, which are one row": [
        "the queue of contacts is out of order", "a contact has been missed",
        "have a contact but no edge", "a point that is not there has contacts",
        "the queue of contacts holds others than those of the points",
        "will have a contact that is not scheduled", "have a contact before a look",
        "have a contact at another time than scheduled, or none", "is outside of the box"],
    "the summary of a run": ["kinetri: {} points from t = {} to {}{}"],
    "a directive of the language": ["use strict"],
}
# Preconditions that no test breaks, by the reason.
NOT_TESTED = {
    "it would take 2^32 points or items": [
        "the queue is full", "too many items",
        "a scenario of too many points; expected fewer than 2^32 - 1"],
}


def texts(source, token, glue):
    """(line, text, names before the parentheses that are open) of each string literal; those with
    only `glue` in between are one."""
    found = []
    calls = []
    word = ""
    end = None
    for match in token.finditer(source):
        if match["text"]:
            text = match["text"][1:-1]
            if end is not None and re.fullmatch(glue, source[end : match.start()]):
                line, before, open_calls = found.pop()
                found.append((line, before + text, open_calls))
            else:
                line = source.count("\n", 0, match.start()) + 1
                found.append((line, text, [call for call in calls if call]))
            end = match.end()
        elif match.group() == "(":
            calls.append(word)
        elif match.group() == ")" and calls:
            calls.pop()
        word = match.group() if match.group()[0].isidentifier() else ""
    return found


def unescaped(text):
    return re.sub(r"\\(.)", lambda match: {"n": "\n"}.get(match[1], match[1]), text).strip()


def pattern(text, variable):
    """What finds the text, whatever stands for its variables."""
    return re.compile(".*".join(re.escape(part) for part in variable.split(text)))


def is_message(path, text, calls):
    if "KINETRI_ASSERT" in calls or not WORDS.search(VARIABLE.sub("", text)):
        return False
    if path.suffix == ".js":
        # What is wrong with the page as a whole is said where it begins.
        return bool(PAGE_CALLS.intersection(calls)) or path.name == "main.js"
    if path.parts[0] != "apps":  # The library has no texts but messages.
        return True
    return bool(CPP_CALLS.intersection(calls)) or "; expected " in text or "kinetri: " in text


def messages(root):
    """(path, line, text, whether it is that of a precondition) of each message in the sources."""
    for folder in ("include/kinetri", "src", "apps", "viewer"):
        for file in sorted((root / folder).rglob("*")):
            path = file.relative_to(root)
            if file.suffix not in (".h", ".cpp", ".js") or str(path) in NO_MESSAGES:
                continue
            page = file.suffix == ".js"
            token, glue = (PAGE_TOKEN, r"\s*\+?\s*") if page else (CPP_TOKEN, r"\s*")
            for line, text, calls in texts(file.read_text(encoding="utf-8"), token, glue):
                text = unescaped(text)
                if is_message(path, text, calls):
                    yield path, line, text, "KINETRI_PRECONDITION" in calls
    for folder, kind, message in (("scripts", "*.sh", SHELL_MESSAGE), ("cmake", "*.cmake", CMAKE_MESSAGE)):
        for file in sorted((root / folder).glob(kind)):
            source = file.read_text(encoding="utf-8")
            for match in message.finditer(source):
                line = source.count("\n", 0, match.start()) + 1
                yield file.relative_to(root), line, match[1].strip(), False


def rows(text):
    """(line, message, the other cells) of each row of the list's tables."""
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("| `"):
            cells = [cell.strip() for cell in line.strip("|").split(" | ")]
            yield number, " ".join(re.findall("`([^`]*)`", cells[0])), cells[1:]


def test_texts(root):
    found = []
    for file in sorted((root / "test").rglob("*.cpp")):
        source = file.read_text(encoding="utf-8")
        found += [unescaped(text) for _, text, _ in texts(source, CPP_TOKEN, r"\s*")]
    return "\n".join(found)


def check(root):
    """(number of messages, the violations) below `root`."""
    root = root.resolve()
    text = (root / LIST).read_text(encoding="utf-8")
    listed = {line: message for line, message, _ in rows(text)}
    patterns = {line: pattern(LEADING.sub("", message), PLACEHOLDER)
                for line, message in listed.items()}
    tests = test_texts(root)
    unlisted = [part for parts in NOT_LISTED.values() for part in parts]
    untested = [part for parts in NOT_TESTED.values() for part in parts]
    violations = []
    count = 0
    seen = set()
    for path, line, message, is_precondition in messages(root):
        count += 1
        wanted = pattern(message, VARIABLE)
        found = {row for row in listed
                 if wanted.search(listed[row]) or patterns[row].search(message)}
        seen |= found
        if not found and message not in unlisted and not wanted.search(text):
            violations.append(f'{path}:{line}: "{message}" is not in {LIST}; add a row')
        if is_precondition and message not in untested and not wanted.search(tests):
            violations.append(f'{path}:{line}: "{message}" is in no test; break it in one')
    # Those with an exit code are brought about by test/apps/messages_test.py.
    seen |= {line for line, _, cells in rows(text) if cells and cells[0].isdigit()}
    for row in sorted(listed.keys() - seen):
        violations.append(f'{LIST}:{row}: no source says "{listed[row]}"; remove the row')
    return count, violations


if __name__ == "__main__":
    check_tree.run(check, "messages", "messages", __doc__)
