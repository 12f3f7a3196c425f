#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a file of tests by pytest; exit code 77, skipped, where there is no pytest or no hypothesis.

usage: run_tests.py FILE
"""
import importlib.util
import sys



def main():
    missing = [name for name in ("pytest", "hypothesis", "pandas", "scipy")
               if importlib.util.find_spec(name) is None]
    if missing:
        print("skipped: not installed:", ", ".join(missing))
        return 77
    import pytest

    return pytest.main(["-q", "-p", "no:cacheprovider", "-W", "error", *sys.argv[1:]])


# Processes that tests start import this file.
if __name__ == "__main__":
    sys.exit(main())
