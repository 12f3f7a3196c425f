# SPDX-License-Identifier: GPL-3.0-or-later
"""Sweeps: tables in the order of the parameters, on processes, also where these are killed."""
import numpy as np
import pandas as pd
import pytest
from pandas.testing import assert_frame_equal
from sweep_functions import (a_number, a_table, count_events, die, die_once, fail_for_three, several_rows)

import kinetri

def test_all_combinations_in_order():
    table = kinetri.sweep(count_events, {"seed": [3, 1, 2], "points": (20, 30)}, workers=2)
    assert list(table.columns) == ["seed", "points", "events", "first"]
    assert table["seed"].tolist() == [3, 3, 1, 1, 2, 2] and table["points"].tolist() == [20, 30] * 3
    expected = pd.DataFrame([{"seed": seed, "points": points, **count_events(seed, points)}
                             for seed in (3, 1, 2) for points in (20, 30)])
    assert_frame_equal(table, expected)
    one = kinetri.sweep(count_events, {"seed": [3, 1, 2], "points": (20, 30)}, workers=1)
    assert_frame_equal(one, table)


@pytest.fixture
def in_this_process(monkeypatch):
    """Runs tasks here, for tests that are about tables."""
    from kinetri import sweeps

    monkeypatch.setattr(sweeps, "map_on_processes",
                        lambda tasks, workers: [sweeps._call(task) for task in tasks])


def test_results_of_every_kind(in_this_process):
    table = kinetri.sweep(several_rows, {"n": [2, 0, 1]})
    assert table.to_dict("list") == {"n": [2, 2, 1], "row": [0, 1, 0], "square": [0, 1, 0]}
    table = kinetri.sweep(a_table, ({"n": n} for n in (2, 1)))
    assert table.to_dict("list") == {"n": [2, 2, 1], "value": [0, 0.5, 0]}
    assert table.index.tolist() == [0, 1, 2]
    assert kinetri.sweep(a_number, {"x": range(3)}).to_dict("list") == {"x": [0, 1, 2], "result": [0, 2, 4]}
    assert kinetri.sweep(a_number, []).shape == (0, 0) and kinetri.sweep(a_number, {"x": []}).shape == (0, 0)
    array = np.arange(3)
    table = kinetri.sweep(a_number, [{"x": array}])
    assert table["result"][0].tolist() == [0, 2, 4] and table["x"][0] is array


@pytest.mark.parametrize("parameters, message", [
    ({"x": 3}, "expected {'seed': range"), ([3], r"parameters\[0\] is 3; expected a dictionary"),
    ([{"x": 1}, ("x", 2)], r"parameters\[1\] is \('x', 2\)")])
def test_bad_parameters(parameters, message):
    with pytest.raises(kinetri.PreconditionError, match=message):
        kinetri.sweep(a_number, parameters)


def test_a_killed_worker_is_replaced_and_errors_come_out(tmp_path):
    table = kinetri.sweep(die_once, {"x": range(5), "folder": [str(tmp_path)]}, workers=2)
    assert table["x"].tolist() == [0, 1, 2, 3, 4] and table["square"].tolist() == [0, 1, 4, 9, 16]
    assert table["process_was_killed"].sum() == 1
    with pytest.raises(LookupError, match="not three"):
        kinetri.sweep(fail_for_three, {"x": range(5)}, workers=2)


def test_workers_that_are_killed_again_and_again():
    with pytest.raises(kinetri.WorkerError, match="1 of 1 runs ended without a result, 3 times"):
        kinetri.sweep(die, {"x": [1]}, workers=1)
