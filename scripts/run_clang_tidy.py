#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs clang-tidy on sources of the project and prints each finding once.

usage: run_clang_tidy.py [--fix] [--jobs N] BUILD_DIR FILE...

BUILD_DIR has a compile_commands.json. Where a source is compiled more than once, it is looked at as
in the first of these; a header by way of the source of its name, or of the first that includes it.
Exit code 1 if anything was found.
"""
import argparse
import concurrent.futures
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
FINDING = re.compile(r"^(/\S+):(\d+):(\d+): (?:warning|error): ")


def compilations(build_dir):
    """The first compilation of each source of the project, by its path relative to the root."""
    found = {}
    with open(build_dir / "compile_commands.json", encoding="utf-8") as commands:
        for entry in json.load(commands):
            file = pathlib.Path(entry["directory"], entry["file"]).resolve()
            if file.is_relative_to(ROOT) and not file.is_relative_to(build_dir):
                found.setdefault(str(file.relative_to(ROOT)), entry)
    return found


def included(path):
    """The files of the project that `path` includes, itself or through others."""
    found, open_ends = set(), [ROOT / path]
    while open_ends:
        file = open_ends.pop()
        folders = [file.parent, ROOT / "include", ROOT / "src", ROOT / "test", ROOT / "apps/kinetri"]
        for name in INCLUDE.findall(file.read_text(encoding="utf-8")):
            target = next((f / name for f in folders if (f / name).is_file()), None)
            if target and target.resolve() not in found:
                found.add(target.resolve())
                open_ends.append(target.resolve())
    return found


def sources_for(files, sources):
    """Sources through which clang-tidy sees each of the files; the files that none of them has."""
    chosen, rest = {f for f in files if f in sources}, []
    headers = [f for f in files if f.endswith(".h")]
    if not headers:
        return sorted(chosen), rest
    includes = {source: included(source) for source in sorted(sources)}
    for header in headers:
        users = [s for s in includes if (ROOT / header).resolve() in includes[s]]
        stem = pathlib.PurePath(header).stem.removesuffix("_impl")
        users.sort(key=lambda s: (s not in chosen, pathlib.PurePath(s).stem != stem))
        if users:
            chosen.add(users[0])
        else:
            rest.append(header)
    return sorted(chosen), rest


def findings(text):
    """(where and what, the finding with the lines that belong to it) of clang-tidy's output."""
    current = None
    for line in text.splitlines():
        if FINDING.match(line):
            if current:
                yield current[0], "\n".join(current)
            current = [line.removeprefix(f"{ROOT}/")]
        elif current:
            current.append(line.replace(f"{ROOT}/", ""))
    if current:
        yield current[0], "\n".join(current)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--fix", action="store_true")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("build_dir", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("files", nargs="+")
    options = parser.parse_args()

    entries = compilations(options.build_dir)
    sources, rest = sources_for(options.files, entries)
    for header in rest:
        print(f"{header}: no source includes it; not checked")
    seen, failed = set(), False
    with tempfile.TemporaryDirectory() as folder:
        database = pathlib.Path(folder, "compile_commands.json")
        database.write_text(json.dumps(list(entries.values())), encoding="utf-8")
        command = ["clang-tidy-14", "--quiet", f"-p={folder}"] + ["--fix"] * options.fix

        def check(source):
            return source, subprocess.run(command + [str(ROOT / source)], text=True, check=False,
                                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)

        # Two at once would both change a header that both include.
        jobs = 1 if options.fix else options.jobs
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            for source, result in pool.map(check, sources):
                found = list(findings(result.stdout))
                for key, text in found:
                    if key not in seen:
                        print(text, flush=True)
                        seen.add(key)
                if result.returncode and not found:
                    print(f"{source}: clang-tidy failed:\n{result.stderr}", flush=True)
                failed = failed or bool(found) or result.returncode != 0
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
