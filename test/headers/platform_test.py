#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A compiler setting, or a platform, with which results would be wrong is refused with one clear error.

usage: platform_test.py COMPILER INCLUDE_FOLDER
"""
import subprocess
import sys
import unittest

COMPILER, INCLUDE = sys.argv[1:3]

# Options, and words that the error must have.
REFUSED = [
    ("-std=c++17", "C++20"),
    ("-ffast-math", "-ffast-math"),
    ("-Ofast", "-ffast-math"),
    ("-ffinite-math-only", "-ffast-math"),
    ("-U__FLT_EVAL_METHOD__ -D__FLT_EVAL_METHOD__=2", "-msse2"),
    ("-U__DBL_MANT_DIG__ -D__DBL_MANT_DIG__=24", "IEEE 754"),
    ("-U__BYTE_ORDER__ -D__BYTE_ORDER__=__ORDER_BIG_ENDIAN__", "big-endian"),
    ("-D__wasm__", "-DCGAL_ALWAYS_ROUND_TO_NEAREST"),
]
if "clang" not in subprocess.run([COMPILER, "--version"], capture_output=True, text=True, check=True).stdout:
    # Clang says of this part of -ffast-math nothing to the preprocessor.
    REFUSED.append(("-funsafe-math-optimizations", "-ffast-math"))
ACCEPTED = ["", "-O3", "-std=c++2b", "-D__wasm__ -DCGAL_ALWAYS_ROUND_TO_NEAREST"]


def errors_of(options):
    command = [COMPILER, "-std=c++20", *options.split(), "-I", INCLUDE, "-fsyntax-only", "-x", "c++", "-"]
    done = subprocess.run(command, input="#include <kinetri/base/platform.h>\n", capture_output=True, text=True,
                          check=False)
    return done.returncode, [line for line in done.stderr.splitlines() if "error:" in line]


class Platform(unittest.TestCase):
    def test_what_would_give_wrong_results_is_refused(self):
        for options, words in REFUSED:
            with self.subTest(options):
                code, errors = errors_of(options)
                self.assertNotEqual(code, 0)
                # The second one is that of the header that does not exist, which ends the compilation.
                self.assertEqual(len(errors), 2, errors)
                self.assertIn(words, errors[0])
                self.assertIn("kinetri_needs", errors[1])

    def test_what_is_right_is_accepted(self):
        for options in ACCEPTED:
            with self.subTest(options):
                self.assertEqual(errors_of(options), (0, []))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
