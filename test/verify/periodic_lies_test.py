#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""False logs of runs in periodic boxes are refuted.

usage: periodic_lies_test.py KINETRI VERIFY FOLDER
"""
import collections
import itertools
import pickle
import random
import sys

from periodic_lies import LIES, TWICE
from periodic_runs import DISCS, FOLDER, KINDS, TIMES, runs


def number_of_runs(kind):
    """As many as it takes to tell each lie ten times."""
    return TIMES * (5 if kind in DISCS else 6 if kind == "weights" else 4)


def main():
    told, refuted = collections.Counter(), collections.Counter()
    for kind in (*KINDS, *DISCS):
        for seed, run in runs(kind, number_of_runs(kind), FOLDER / kind):
            true_run = pickle.dumps(run)  # many times faster to copy than by deepcopy
            for name, time in itertools.product(LIES, range(2)):
                if name not in TWICE and (time == 1 or (kind in DISCS and seed % 2 == 1)):
                    continue
                changed = pickle.loads(true_run)
                if not LIES[name](changed, random.Random(f"{kind} {seed} {name}" + " again" * time)):
                    continue
                told[name] += 1
                code, says = changed.verify()
                if code == 1 and says.startswith("refuted: "):
                    refuted[name] += 1
                else:
                    print(f"{name}, {kind} {seed}: {code}: {says.strip()}")
    for name in LIES:
        print(f"{name}: {told[name]} told, {refuted[name]} refuted")
    few = [name for name in LIES if told[name] < 10]
    if told != refuted or few:
        sys.exit(f"not all are refuted, or told often enough: {few}")


if __name__ == "__main__":
    main()
