# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects: references and memory, threads, Ctrl-C, copies, pickles, and processes."""
import copy
import gc
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import weakref

import numpy as np
import pytest
from support import uniform

import kinetri

MAKERS = {
    "delaunay": lambda: kinetri.KineticDelaunay(*uniform(40, 1)),
    "polynomial": lambda: kinetri.KineticDelaunay(*uniform(40, 1), acceleration=uniform(40, 2)[1]),
    "regular": lambda: kinetri.KineticRegular(*uniform(40, 1), radius=np.arange(40.0)),
    "simulation": lambda: kinetri.Simulation(*uniform(40, 1), radius=0.5, collisions="elastic",
                                             box=(0, 0, 100, 100)),
    "discs": lambda: kinetri.Simulation(*uniform(20, 1, side=500), radius=np.arange(1, 21) / 20,
                                        growth=0.5, mass="area", collisions="swap"),
    "tracks": lambda: kinetri.Tracks.from_arrays(
        [0, 4, 0, 4, 1, 3], ["a", "a", "b", "b", "c", "c"], [0, 4, 4, 0, 1, 2],
        [0, 0, 3, 3, 7, 8]).simulation(),
}


def resident_bytes():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


# ---- references and memory ----

def use_once(make):
    points = make()
    events = points.record(until=0.25)
    views = events["kind"], points.positions()[1:3], points.edges().T
    exact = [event.time for event in points.events(until=0.5)]
    snapshot = points.snapshot()
    snapshot.restore().step()
    try:
        points.advance_to(-1)
    except kinetri.PreconditionError:
        pass
    points.voronoi_cell(0), points.statistics(), points.motion(0), points.locate([0, 0])
    return views, exact


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="memory is read from /proc")
@pytest.mark.parametrize("kind", ["delaunay", "discs"])
def test_ten_thousand_objects_leave_no_memory_behind(kind):
    rounds = {"delaunay": lambda: kinetri.KineticDelaunay(*uniform(5, 1)),
              "discs": lambda: kinetri.Simulation(
                  *uniform(5, 1), radius=[1, 2, 3, 4, 5], collisions=lambda contact: None)}
    for _ in range(300):
        use_once(rounds[kind])
    gc.collect()
    counted = len(gc.get_objects())
    before = resident_bytes()
    for _ in range(1000):
        use_once(rounds[kind])
    for _ in range(9000):
        rounds[kind]()
    gc.collect()
    # An object of five points has several kB: a leak of each one would be tens of MB.
    assert resident_bytes() - before < 4 * 2**20
    assert len(gc.get_objects()) - counted < 100


def test_references_are_released():
    class Response:
        def __call__(self, contact):
            self.contact = contact
            return None

    class Progress:
        def __call__(self, time):
            pass

    response, progress = Response(), Progress()
    references = [weakref.ref(response), weakref.ref(progress)]
    sim = kinetri.Simulation([[0, 0], [10, 0]], [[1, 0], [-1, 0]], radius=1, collisions=response)
    sim.advance_to(5, progress=progress)
    contact = response.contact
    assert contact.ids == (0, 1) and contact.time == 4
    with pytest.raises(kinetri.PreconditionError, match="contact is over"):
        contact.would_approach([1, 0], [0, 0])
    snapshot = sim.snapshot()
    del response, progress
    assert references[0]() is not None and references[1]() is None
    del sim, contact
    assert references[0]() is not None
    del snapshot
    gc.collect()
    assert references[0]() is None


@pytest.mark.parametrize("name", ["None", "True", "event_dtype", "numbers"])
def test_reference_counts_stay(name):
    values = {"None": None, "True": True, "event_dtype": kinetri.event_dtype, "numbers": uniform(6, 1)[0]}
    value = values[name]
    positions, velocities = values["numbers"], uniform(6, 1)[1]
    before = sys.getrefcount(value)
    for _ in range(2000):
        kd = kinetri.KineticDelaunay(positions, velocities)
        kd.record(until=0.1)
        kd.nearest_vertex([0, 0])
        kd.next_event_time()
        kd.time < 3
    del kd
    assert sys.getrefcount(value) - before < 50


def test_arrays_outlive_the_object():
    kd = kinetri.KineticDelaunay(*uniform(50, 3))
    events, edges, places = kd.record(until=1), kd.edges(), kd.positions()
    time = kd.next_event_time()
    expected = events.tobytes(), edges.tolist(), places.tolist(), repr(time)
    iterator = kd.events()
    event = next(iterator)
    del kd, iterator
    gc.collect()
    [np.empty(1000) for _ in range(100)]
    assert expected == (events.tobytes(), edges.tolist(), places.tolist(), repr(time))
    assert event.time == time and event.kind in kinetri.event_kinds and "Event" in repr(event)


# ---- copies ----

@pytest.mark.parametrize("kind", MAKERS)
@pytest.mark.parametrize("duplicate", [copy.copy, copy.deepcopy, lambda o: pickle.loads(pickle.dumps(o)),
                                       lambda o: o.snapshot().restore(),
                                       lambda o: pickle.loads(pickle.dumps(o.snapshot(), 2)).restore()])
def test_a_copy_goes_on_as_the_object_would(kind, duplicate):
    points = MAKERS[kind]()
    points.advance_to(0.5)
    copied = duplicate(points)
    assert type(copied) is type(points) and copied is not points
    assert copied.time == points.time and np.array_equal(copied.edges(), points.edges())
    before = copied.edges()
    expected = points.record(until=3)
    assert len(expected) > 0
    assert np.array_equal(copied.edges(), before)
    assert copied.record(until=3).tobytes() == expected.tobytes()
    if kind == "tracks":
        assert [copied.label(id) for id in range(3)] == ["a", "b", "c"] and copied.end == 4
    if isinstance(points, kinetri.Simulation):
        assert copied.collisions == points.collisions and copied.masses().tolist() == points.masses().tolist()


def test_a_subclass_keeps_its_attributes():
    kd = Named(*uniform(9, 1))
    kd.name = "nine"
    copied = pickle.loads(pickle.dumps(kd))
    assert type(copied) is Named and copied.name == "nine" and len(copied) == 9


class Named(kinetri.KineticDelaunay):
    pass


def respond_elastically(contact):
    return kinetri.respond("elastic", contact)


def test_a_response_is_pickled_with_the_simulation():
    sim = kinetri.Simulation([[0, 0], [10, 0]], [[1, 0], [-1, 0]], radius=1,
                             collisions=respond_elastically)
    copied = pickle.loads(pickle.dumps(sim))
    assert copied.collisions is respond_elastically
    assert copied.record(until=5).tobytes() == sim.record(until=5).tobytes()
    assert copied.velocities().tolist() == [[-1, 0], [1, 0]]
    with pytest.raises((pickle.PicklingError, AttributeError)):
        pickle.dumps(kinetri.Simulation(*uniform(3, 1), radius=1, collisions=lambda contact: None))


def test_snapshots_are_equal_where_the_states_are():
    kd = kinetri.KineticDelaunay(*uniform(20, 1))
    snapshot = kd.snapshot()
    assert snapshot == kd.snapshot() and hash(snapshot) == hash(kd.snapshot())
    assert snapshot == pickle.loads(pickle.dumps(snapshot)) and snapshot != "snapshot"
    kd.advance_to(1)
    assert snapshot != kd.snapshot()
    assert snapshot != kinetri.Simulation(*uniform(20, 1)).snapshot()
    assert repr(snapshot).startswith("<Snapshot KineticDelaunay ")


def test_a_damaged_snapshot_is_refused():
    snapshot = kinetri.KineticDelaunay(*uniform(20, 1)).snapshot()
    for state in (b"", b"x" * 100, snapshot.state[:-5], snapshot.state + b"x"):
        snapshot.state = state
        with pytest.raises(kinetri.Error):
            snapshot.restore()


# ---- threads ----

def test_two_objects_advance_in_two_threads():
    made = [kinetri.KineticDelaunay(*uniform(150, seed)) for seed in range(4)]
    expected = [points.snapshot().restore().record(until=2).tobytes() for points in made]
    results = {}

    def work(i):
        results[i] = made[i].record(until=2).tobytes()

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [results[i] for i in range(4)] == expected


def test_the_interpreter_runs_while_time_advances():
    # The main thread can only count if the other one does not hold the interpreter.
    kd = kinetri.KineticDelaunay(*uniform(400, 1))
    thread = threading.Thread(target=lambda: kd.advance_to(40))
    thread.start()
    count = 0
    refused = 0
    while thread.is_alive():
        count += 1
        try:
            kd.edges()
        except kinetri.PreconditionError as error:
            assert "in use" in str(error)
            refused += 1
    thread.join()
    assert count > 10 and refused > 0
    assert kd.audit("delaunay")


def test_times_are_shared_by_threads():
    kd = kinetri.KineticDelaunay(*uniform(60, 5), acceleration=uniform(60, 6)[1])
    times = [event.time for event in kd.events(until=1)]
    assert len(times) > 20
    wrong = []

    def compare(step):
        for _ in range(5):
            for i in range(len(times) - 1):
                j = (i * step + 1) % len(times)
                if (times[i] < times[j]) != (i < j) or (times[i] == times[j]) != (i == j):
                    wrong.append((i, j))
            times[0].fraction, hash(times[-1]), times[step].lower

    threads = [threading.Thread(target=compare, args=(step,)) for step in (1, 3, 5, 7)]
    threads.append(threading.Thread(target=lambda: kd.advance_to(2)))
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == []


def test_a_call_within_a_call_is_refused():
    seen = []

    def ask(time):
        with pytest.raises(kinetri.PreconditionError, match="in use"):
            kd.edges()
        seen.append(repr(kd))

    kd = kinetri.KineticDelaunay(*uniform(30, 1))
    kd.advance_to(1, progress=ask)
    assert len(seen) > 0 and "in use" in seen[0]
    assert kd.edges().shape[1] == 2


def test_a_response_runs_in_the_thread_that_advances():
    names = []

    def response(contact):
        names.append(threading.current_thread().name)

    sims = [kinetri.Simulation(*uniform(40, seed), radius=2, collisions=response) for seed in (1, 2)]
    threads = [threading.Thread(target=sim.advance_to, args=(2,), name=f"t{i}") for i, sim in enumerate(sims)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert set(names) == {"t0", "t1"}


# ---- Ctrl-C ----

def interrupt_when_running():
    """Sends the signal of Ctrl-C to this process a little later."""
    timer = threading.Timer(0.15, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    return timer


@pytest.mark.parametrize("call", ["advance_to", "record", "play"])
def test_ctrl_c_stops_at_an_event(call):
    kd = kinetri.KineticDelaunay(*uniform(4000, 1))
    again = kd.snapshot().restore()
    timer = interrupt_when_running()
    with pytest.raises(KeyboardInterrupt) as raised:
        getattr(kd, call)(10**6)
    timer.join()
    reached = kd.time
    assert 0 < reached < 10**6 and kd.audit("delaunay")
    expected = again.record(until=reached)
    assert np.array_equal(again.edges(), kd.edges())
    if call == "record":
        assert raised.value.events.tobytes() == expected.tobytes()
    after = again.next_event_time()
    if after is not None:
        assert kd.record(until=after).tobytes() == again.record(until=after).tobytes()


def test_ctrl_c_within_a_response_stops_after_the_contact():
    calls = []

    def response(contact):
        calls.append(contact.time)
        if len(calls) == 5:
            signal.raise_signal(signal.SIGINT)
        return kinetri.respond("elastic", contact)

    def make(collisions):
        return kinetri.Simulation(*uniform(30, 7), radius=1, box=(0, 0, 100, 100), collisions=collisions)

    sim, again = make(response), make("elastic")
    with pytest.raises(KeyboardInterrupt):
        sim.advance_to(20)
    assert sim.time >= calls[4] * (1 - 1e-12) and sim.audit()
    sim.advance_to(20)
    again.advance_to(20)
    assert sim.snapshot().restore().positions().tolist() == again.positions().tolist()


def test_an_error_of_progress_stops_at_an_event():
    kd = kinetri.KineticDelaunay(*uniform(60, 3))
    expected = kd.snapshot().restore().record(until=3)

    def stop(time):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough") as raised:
        kd.record(until=3, progress=stop)
    rest = kd.record(until=3)
    assert np.concatenate([raised.value.events, rest]).tobytes() == expected.tobytes()


# ---- processes ----

def run_in_child(points, until, queue):
    queue.put((points.record(until=until).tobytes(), float(points.time)))


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_objects_go_to_other_processes(method):
    context = multiprocessing.get_context(method)
    queue = context.Queue()
    # Before, threads of the library have computed the first certificates of a large object.
    points = kinetri.KineticDelaunay(*uniform(2000, 4))
    process = context.Process(target=run_in_child, args=(points, 0.02, queue))
    process.start()
    result, time = queue.get(timeout=60)
    process.join(60)
    assert process.exitcode == 0
    expected = points.record(until=0.02)
    assert len(expected) > 20 and result == expected.tobytes() and time == 0.02


def test_objects_are_made_in_a_forked_process():
    kinetri.KineticDelaunay(*uniform(5000, 5)).advance_to(0.001)
    child = os.fork()
    if child == 0:
        # Not to return from here: the tests would run twice.
        try:
            kd = kinetri.KineticDelaunay(*uniform(5000, 6))
            kd.advance_to(0.001)
            os._exit(0 if kd.audit("delaunay") else 3)
        finally:
            os._exit(4)
    timer = threading.Timer(60, lambda: os.kill(child, signal.SIGKILL))
    timer.start()
    _, status = os.waitpid(child, 0)
    timer.cancel()
    assert os.waitstatus_to_exitcode(status) == 0


def test_an_interpreter_ends_while_objects_live():
    code = ("import kinetri, threading\n"
            "kd = kinetri.KineticDelaunay(*kinetri.scenario('uniform', 300))\n"
            "sim = kinetri.Simulation([[0, 0], [9, 0]], [[1, 0], [-1, 0]], radius=1,"
            " collisions=lambda contact: None)\n"
            "events = kd.events(); kept = next(events); sim.keep = sim\n"
            "thread = threading.Thread(target=kd.advance_to, args=(3,), daemon=True); thread.start()\n")
    for _ in range(3):
        result = subprocess.run([sys.executable, "-W", "error", "-c", code], timeout=60,
                                capture_output=True, text=True)
        assert (result.returncode, result.stderr) == (0, "")


def test_warnings_of_the_import_are_errors_and_there_are_none():
    subprocess.run([sys.executable, "-W", "error", "-c", "import kinetri"], check=True, timeout=60)
