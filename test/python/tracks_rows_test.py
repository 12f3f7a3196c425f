# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of tracks that are merged or left out, and things that share a path."""
import re
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest

import kinetri
from kinetri import Tracks
from support import run_program

#: A and B come from two sides, rest on one bench from 5 to 10, and part; C is elsewhere.
BENCH = {"t": [0, 5, 10, 15] * 2 + [0, 15], "id": ["A"] * 4 + ["B"] * 4 + ["C"] * 2,
         "x": [-5, 0, 0, 5, 0, 0, 0, 0, 3, 3], "y": [0, 0, 0, 0, -5, 0, 0, 5, 3, 4]}
#: At t = 1 of three times a is at two places, and one of them twice.
DOUBLED = {"t": [0, 1, 1, 1, 2], "id": ["a"] * 5, "x": [0, 1, 3, 1, 4], "y": [0, 0, 2, 0, 4]}


def ways_to_make(columns, **options):
    return (lambda **more: Tracks.from_arrays(*columns.values(), **options, **more),
            lambda **more: Tracks.from_dataframe(pd.DataFrame(columns), **options, **more))


# ---- things that share a path ----


def test_things_that_share_a_path_are_named_by_their_labels():
    def steps(tracks):
        simulation = tracks.simulation()
        while simulation.step() > 0:
            pass

    for make in ways_to_make(BENCH):
        for go in (lambda tracks: tracks.simulation().advance_to(15), steps,
                   lambda tracks: list(tracks.simulation().events()), lambda tracks: tracks.record(),
                   lambda tracks: tracks.closest(1), lambda tracks: tracks.areas([0, 15], cutoff=3)):
            with pytest.raises(kinetri.CoincidentTrajectoriesError) as raised:
                go(make(coincident="refuse"))
            assert str(raised.value) == (
                "'A' and 'B' from t = 5 on go the same way; expected different positions at one of two observations, or "
                "tracks that are made with coincident='hide'")
            assert sorted(raised.value.ids) == [0, 1]


def test_of_things_that_share_a_path_the_first_hides_the_other(tmp_path):
    pd.DataFrame(BENCH).to_csv(tmp_path / "t.csv", index=False)
    run_program("tracks", "t.csv", "--events", "events.csv", directory=tmp_path)
    logged = pd.read_csv(tmp_path / "events.csv")
    for make in (*ways_to_make(BENCH), lambda **more: Tracks.read(tmp_path / "t.csv", **more)):
        for tracks in (make(), make(coincident="hide")):
            assert tracks.labels == ["A", "B", "C"] and tracks.remarks == []
            simulation = tracks.simulation()
            events = simulation.record(simulation.end)
            hidden = events[np.isin(events["kind"], ["hide", "reveal"])]
            assert hidden["kind"].tolist() == ["hide", "reveal"] and hidden["time"].tolist() == [5, 10]
            assert hidden["points"].tolist() == [[1, 0]] * 2
            assert events["kind"].tolist() == logged["kind"].tolist()
            assert events["time"].tolist() == logged["time"].tolist()
        with pytest.raises(kinetri.PreconditionError, match="^coincident is 'leave-out'; expected 'hide' or 'refuse'$"):
            make(coincident="leave-out")


def test_discs_of_two_sizes_share_no_path():
    for radii, expected in (([1] * 8 + [2] * 2, [[1], [0], []]), ([1] * 4 + [3] * 4 + [2] * 2, [[], [], []])):
        simulation = Tracks.from_arrays(*BENCH.values(), radius=radii).simulation()
        simulation.advance_to(7)
        assert [simulation.coincident_points(id).tolist() for id in range(3)] == expected
        # The larger disc hides the smaller one, which has an empty power cell.
        assert simulation.hidden_points().tolist() == [1 if radii[4] == 1 else 0]
        assert simulation.radii().tolist() == [radii[0], radii[4], radii[8]] and simulation.audit()


def test_other_pairs_are_named():
    columns = {name: np.concatenate([values, values]) for name, values in BENCH.items()}
    columns["id"] = ["A"] * 4 + ["B"] * 4 + ["C"] * 2 + ["D"] * 4 + ["E"] * 4 + ["F"] * 2
    columns["x"][10:] += 100
    with pytest.raises(kinetri.CoincidentTrajectoriesError, match="^'A' and 'B' from t = 5 on go the same way, and so do 'D' "
                       "and 'E' from t = 5 on; expected"):
        Tracks.from_arrays(*columns.values(), coincident="refuse").record()


# ---- several places at one time ----


@pytest.mark.parametrize("duplicates, place", [(None, [1, 0]), ("first", [1, 0]), ("last", [1, 0]), ("mean", [2, 1])])
def test_one_of_several_places_is_taken(tmp_path, duplicates, place):
    pd.DataFrame(DOUBLED).to_csv(tmp_path / "t.csv", index=False)
    for make in ways_to_make(DOUBLED):
        tracks = make(duplicates=duplicates)
        assert tracks._places.tolist() == [[0, 0], place, [4, 4]]
        of_file = Tracks.read(tmp_path / "t.csv", duplicates=duplicates)
        assert of_file._places.tolist() == tracks._places.tolist()
        assert tracks.remarks[0] in of_file.remarks and "of the same id at the same time" in tracks.remarks[0]


def test_last_is_the_last_of_the_rows():
    columns = DOUBLED | {"x": [0, 1, 3, 5, 4]}
    assert Tracks.from_arrays(*columns.values(), duplicates="last")._places.tolist()[1] == [5, 0]
    # The mean of all three, from left to right.
    assert Tracks.from_arrays(*columns.values(), duplicates="mean")._places.tolist()[1] == pytest.approx([3, 2 / 3])


def test_several_places_are_refused_as_the_advice_says():
    message = ("rows 1 and 2: 'a' is at two places at t = 1.0; expected one observation of a thing at a time, or "
               "duplicates='first', 'last' or 'mean', which says what to take")
    for make in ways_to_make(DOUBLED):
        with pytest.raises(kinetri.InputError, match=re.escape(message)):
            make(duplicates="refuse")
        with pytest.raises(kinetri.PreconditionError, match="duplicates is 'all'; expected one of 'first', 'last', 'mean'"):
            make(duplicates="all")
    # Of two times one: the name may be that of several things.
    half = {name: values[:4] for name, values in DOUBLED.items()}
    with pytest.raises(kinetri.InputError, match=re.escape(message)):
        Tracks.from_arrays(*half.values())
    assert len(Tracks.from_arrays(*half.values(), duplicates="first")) == 1


# ---- columns and rows that are left out ----


def test_columns_that_are_not_used_are_named_and_heights_are_warned_of():
    frame = pd.DataFrame(BENCH).assign(z=[0.0, 1.0] * 5, speed=3)
    with pytest.warns(UserWarning, match=r"the columns 'z' vary, and are left out: tracks are in the plane of x and y"):
        tracks = Tracks.from_dataframe(frame)
    assert tracks.remarks == ["columns that are not used: 'z', 'speed'"]
    tracks = Tracks.from_dataframe(frame.assign(z=2.0))  # which is no warning: pytest makes errors of those
    assert tracks.remarks == ["columns that are not used: 'z', 'speed'"]


def test_rows_without_a_place_are_no_observations():
    columns = {"t": [0, 1, 2, 3], "id": ["a", "a", "a", "b"], "x": [0.0, np.nan, 4.0, np.nan], "y": [0.0, np.nan, 0.0, np.nan]}
    for make in ways_to_make(columns):
        tracks = make()
        assert tracks.labels == ["a"] and tracks._places.tolist() == [[0, 0], [4, 0]]
        assert tracks.remarks == ["2 rows left out, having NaN as place"]
    columns["y"] = [0.0, 1.0, 0.0, np.nan]
    with pytest.raises(kinetri.PreconditionError, match=r"x\[1\] is nan; expected finite numbers"):
        Tracks.from_arrays(*columns.values())


# ---- times ----


@pytest.mark.parametrize("times, form", [([20200131, 20200201], "%Y%m%d"), ([2020013123, 2020020100], "%Y%m%d%H"),
                                         ([202001312359, 202002010001], "%Y%m%d%H%M"),
                                         ([20200131235959, 20200201000001], "%Y%m%d%H%M%S")])
def test_numbers_that_are_dates_are_refused(times, form):
    columns = {"t": times, "id": [1, 1], "x": [0, 1], "y": [0, 0]}
    for make in ways_to_make(columns):
        with pytest.raises(kinetri.PreconditionError, match=re.escape(
                f"t has numbers that look like dates, such as {times[0]}; expected pandas.to_datetime(t, format='{form}') if "
                "they are, or smaller numbers, as t - t.min()")):
            make()
    t = np.array(times)
    assert Tracks.from_arrays(pd.to_datetime(t, format=form), [1, 1], [0, 1], [0, 0]).origin is not None
    assert Tracks.from_arrays(t - t.min(), [1, 1], [0, 1], [0, 0]).end == times[1] - times[0]
    # One of them is no date.
    assert Tracks.from_arrays([times[0], times[0] * 1.5], [1, 1], [0, 1], [0, 0]).start == times[0]


# ---- files ----


def test_decimal_commas_are_read_as_the_messages_advise(tmp_path):
    columns = {"t": "t", "id": "id", "x": "x", "y": "y"}
    for text in ("t;id;x;y\n0;a;1,5;0\n1;a;2,5;0\n", "t,id,x,y\n0,a,\"1,5\",0\n1,a,\"2,5\",0\n",
                 "t;id;x;y\n0;a;1.001,5;0\n1;a;1.002,5;0\n", "t\tid\tx\ty\n0,5\ta\t1\t0\n1\ta\t2,5\t0\n"):
        (tmp_path / "FILE").write_text(text, encoding="utf-8")
        with pytest.raises(kinetri.InputError) as raised:
            Tracks.read(tmp_path / "FILE", columns=columns)
        message = str(raised.value)
        advice = re.search(r"as (sed .* FILE|python3 -c .*\)\") makes", message)
        assert advice and "has a decimal comma; expected a decimal point" in message, message
        command = re.sub("^python3", sys.executable, advice[1])
        out = subprocess.run(command, shell=True, cwd=tmp_path, capture_output=True, text=True, check=True).stdout
        if advice[1].startswith("sed"):
            (tmp_path / "FILE.csv").write_text(out, encoding="utf-8")
        assert len(Tracks.read(tmp_path / "FILE.csv", columns=columns)) == 1


def test_xml_in_other_encodings_is_read_as_the_messages_advise(tmp_path):
    gpx = ("<gpx><trk><name>Å-ö</name><trkseg><trkpt lat='55' lon='12'><time>2024-05-01T00:00:00Z</time></trkpt>"
           "<trkpt lat='55.001' lon='12'><time>2024-05-01T00:01:00Z</time></trkpt></trkseg></trk></gpx>")
    for encoding in ("windows-1252", "ISO-8859-15", "macintosh", None):
        begin = f"<?xml version=\"1.0\" encoding='{encoding}'?>\n" if encoding else ""
        body = (begin + gpx).encode({"macintosh": "mac-roman", None: "cp1252"}.get(encoding, encoding))
        (tmp_path / "FILE").write_bytes(body)
        with pytest.raises(kinetri.InputError) as raised:
            Tracks.read(tmp_path / "FILE", projection="utm")
        advice = re.search(r"expected UTF-8, as (iconv .* FILE(?: \| sed '.*')?) makes", str(raised.value))
        assert advice, str(raised.value)
        out = subprocess.run(advice[1], shell=True, cwd=tmp_path, capture_output=True, check=True).stdout
        (tmp_path / "utf8.gpx").write_bytes(out)
        assert Tracks.read(tmp_path / "utf8.gpx", projection="utm").labels == ["Å-ö"]
