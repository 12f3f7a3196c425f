# SPDX-License-Identifier: GPL-3.0-or-later
"""`threads`: how many threads work together while time advances, with the same results for any number."""
import copy
import os
import signal
import threading

import numpy as np
import pytest
from support import uniform

import kinetri

# So many that several threads share their events, as they do from 50 000 on.
MANY = 60_000


def many():
    return uniform(MANY, 4, side=2500)


def test_threads_are_all_unless_they_are_set():
    kd = kinetri.KineticDelaunay(*uniform(20, 1))
    assert kd.threads == 0
    kd.threads = np.int64(3)
    assert kd.threads == 3
    assert copy.copy(kd).threads == 0
    kd.advance_to(1)
    assert kd.audit()


@pytest.mark.parametrize("number, message", [
    (-1, "threads is -1; expected a whole number from 0 on"),
    (1025, "threads is 1025; expected a whole number from 0 to 1024"),
    (1.5, "threads is 1.5; expected a whole number"),
    ("x", "threads is 'x'; expected a whole number"),
])
def test_a_number_that_is_none_is_refused(number, message):
    kd = kinetri.KineticDelaunay(*uniform(20, 1))
    with pytest.raises(kinetri.PreconditionError, match=message):
        kd.threads = number
    assert kd.threads == 0


@pytest.mark.parametrize("kind", [kinetri.KineticDelaunay, kinetri.Simulation])
@pytest.mark.parametrize("box", [None, kinetri.Box((2500, 2500), rates=((0, 0), (5, 0)))])
def test_results_are_the_same_for_any_number(kind, box):
    states = []
    logs = []
    made = []
    for threads in (1, 2):
        moving = kind(*many(), box=box) if box else kind(*many())
        moving.threads = threads
        watch = moving.watch("encounters", range=0.01)
        times = []
        logs.append(moving.record(until=2, progress=times.append).tobytes())
        assert times == sorted(times) and times[-1] == 2 and len(times) > 1
        states.append((moving.snapshot().state, moving.edges().tobytes(), watch.table().to_csv()))
        made.append(moving.statistics()["certificates"]["created"])
    assert len(logs[0]) > 0
    assert logs[0] == logs[1]
    assert states[0] == states[1]
    assert made[0] != made[1]  # by regions others are made


def test_ctrl_c_stops_several_threads_at_an_event():
    kd = kinetri.KineticDelaunay(*many())
    again = kinetri.KineticDelaunay(*many())
    kd.threads = 2
    timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt) as raised:
        kd.record(until=100)
    timer.join()
    reached = kd.time
    assert 0 < reached < 100
    again.threads = 1
    assert again.record(until=reached).tobytes() == raised.value.events.tobytes()
    assert np.array_equal(again.edges(), kd.edges())
    later = float(reached) + 0.01
    assert kd.record(until=later).tobytes() == again.record(until=later).tobytes()


def test_an_error_of_progress_stops_several_threads_at_an_event():
    kd = kinetri.KineticDelaunay(*many())
    kd.threads = 2
    calls = []

    def stop(time):
        calls.append(time)
        if len(calls) == 5:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough") as raised:
        kd.record(until=100, progress=stop)
    assert float(kd.time) == calls[-1]
    kd.threads = 1
    again = kinetri.KineticDelaunay(*many())
    again.threads = 1
    assert again.record(until=kd.time).tobytes() == raised.value.events.tobytes()
    assert again.snapshot() == kd.snapshot()
