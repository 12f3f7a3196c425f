# SPDX-License-Identifier: GPL-3.0-or-later
"""Sweeps and pieces on a dask cluster of this machine, also where workers are killed."""
import warnings

import pandas as pd
import pytest
from pandas.testing import assert_frame_equal
from sweep_functions import a_number, count_events, die, die_once, fail_for_three, with_names_of_dask

import kinetri


@pytest.fixture(scope="module")
def client():
    distributed = pytest.importorskip("distributed")
    import dask

    dask.config.set({"distributed.scheduler.allowed-failures": 2})
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True,
                                      dashboard_address=":0") as cluster:
            with distributed.Client(cluster) as client:
                yield client


def test_dask_gives_the_same_tables(client):
    parameters = {"seed": [3, 1, 2], "points": (20, 30)}
    table = kinetri.sweep(count_events, parameters, client)
    expected = pd.DataFrame([{"seed": seed, "points": points, **count_events(seed, points)}
                             for seed in (3, 1, 2) for points in (20, 30)])
    assert_frame_equal(table, expected)
    # Equal runs are runs, too.
    assert kinetri.sweep(a_number, [{"x": 1}, {"x": 1}], client)["result"].tolist() == [2, 2]
    names = {"key": [1], "workers": [2], "retries": [3], "pure": [4]}
    assert kinetri.sweep(with_names_of_dask, names, client=client)["sum"].tolist() == [10]
    with pytest.raises(LookupError, match="not three"):
        kinetri.sweep(fail_for_three, {"x": range(5)}, client)
    offset = 5
    assert kinetri.sweep(lambda x: x + offset, {"x": [1, 2]}, client)["result"].tolist() == [6, 7]


def test_pieces_run_on_dask(client):
    positions, velocities = kinetri.scenario("uniform", 100, seed=4)
    expected = kinetri.KineticDelaunay(positions, velocities).record(until=2)
    events = kinetri.run_in_pieces(positions, velocities, 2, 5, client)
    assert len(expected) > 100 and events.tobytes() == expected.tobytes()


def test_dask_replaces_a_killed_worker(client, tmp_path):
    table = kinetri.sweep(die_once, {"x": range(5), "folder": [str(tmp_path)]}, client)
    assert table["square"].tolist() == [0, 1, 4, 9, 16]
    with pytest.raises(kinetri.WorkerError, match="memory"):
        kinetri.sweep(die, {"x": [1]}, client)
