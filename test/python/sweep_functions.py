# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions of sweeps, which the processes import: without anything that only tests need."""
import os
import pathlib
import signal

import numpy as np

import kinetri


def count_events(seed, points):
    events = kinetri.KineticDelaunay(*kinetri.scenario("uniform", points, seed=seed)).record(until=1)
    return {"events": len(events), "first": float(events["time"][0])}


def several_rows(n):
    return [{"row": i, "square": i * i} for i in range(n)]


def a_table(n):
    import pandas as pd

    return pd.DataFrame({"value": np.arange(n) / 2}, index=[7] * n)


def a_number(x):
    return 2 * x


def with_names_of_dask(key, workers, retries, pure):
    return {"sum": key + workers + retries + pure}


def fail_for_three(x):
    if x == 3:
        raise LookupError("not three")
    return x


def die_once(x, folder):
    """The process of the run 2 is killed, the first time that it runs."""
    mark = pathlib.Path(folder) / str(x)
    first = not mark.exists()
    mark.touch()
    if x == 2 and first:
        os.kill(os.getpid(), signal.SIGKILL)
    return {"process_was_killed": x == 2, "square": x * x}


def die(x):
    os.kill(os.getpid(), signal.SIGKILL)
