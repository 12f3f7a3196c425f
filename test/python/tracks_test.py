# SPDX-License-Identifier: GPL-3.0-or-later
"""Recorded tracks: tables, dates, labels, gaps; the closest approaches against all pairs."""
import datetime
import itertools
import re
import sqlite3

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, strategies as st
from support import few, run_program

import kinetri
from kinetri import Tracks

COLUMNS = {"t": [0, 4, 0, 4], "id": ["a", "a", "b", "b"], "x": [0, 4, 4, 0], "y": [0, 0, 3, 3]}


def walks(things, steps, seed, **options):
    """Random walks with integer steps, all observed at the times 0, 1, ..."""
    rng = np.random.default_rng(seed)
    places = rng.integers(0, 40, (things, 1, 2)) + rng.integers(-4, 5, (things, steps, 2)).cumsum(axis=1)
    t, id = np.meshgrid(np.arange(steps), np.arange(things))
    return Tracks.from_arrays(t.ravel(), id.ravel(), places[:, :, 0].ravel(), places[:, :, 1].ravel(),
                              **options), places.astype(float)


def closest_of_all_pairs(places):
    """Of every pair: the least distance, and the first time of it; by the segments' own minima."""
    rows = []
    for a, b in itertools.combinations(range(len(places)), 2):
        difference = places[b] - places[a]
        p, v = difference[:-1], np.diff(difference, axis=0)
        speed = (v**2).sum(axis=1)
        s = np.clip(np.where(speed > 0, -(p * v).sum(axis=1) / np.where(speed > 0, speed, 1), 0), 0, 1)
        nearest = np.hypot(*(p + v * s[:, None]).T)
        i = int(np.argmin(nearest))
        rows.append((nearest[i], i + s[i], a, b))
    return sorted(rows)


@pytest.mark.parametrize("seed", range(5))
def test_the_closest_approaches_are_those_of_all_pairs(seed):
    tracks, places = walks(12, 8, seed)
    expected = closest_of_all_pairs(places)
    table = tracks.closest(66)
    assert list(table.columns)[:5] == ["a", "b", "time", "time_lo", "time_hi"]
    assert len(table) >= 10
    # Of each pair that was ever neighbors; the nearest of all is among them.
    by_pair = {(a, b): (distance, time) for distance, time, a, b in expected}
    for row in table.itertuples():
        distance, time = by_pair[min(row.a, row.b), max(row.a, row.b)]
        assert row.distance >= distance - 1e-9
        assert row.time_lo <= row.time <= row.time_hi
    assert np.isclose(table["distance"][0], expected[0][0], atol=1e-12)
    assert table["distance"].is_monotonic_increasing
    assert len({frozenset(pair) for pair in zip(table["a"], table["b"])}) == len(table)
    top = tracks.closest(3)
    assert top["distance"].tolist() == table["distance"][:3].tolist()


def test_few_pairs_are_all_neighbors_and_the_list_is_complete():
    # Three things: every pair is an edge of the triangle.
    for seed in range(10):
        tracks, places = walks(3, 5, seed)
        table = tracks.closest(10)
        expected = closest_of_all_pairs(places)
        assert len(table) >= 2
        by_pair = {(a, b): (distance, time) for distance, time, a, b in expected}
        for row in table.itertuples():
            distance, time = by_pair[min(row.a, row.b), max(row.a, row.b)]
            assert np.isclose(row.distance, distance, atol=1e-12)
            if distance > 0:
                assert np.isclose(row.time, time, atol=1e-9)


@few
@given(st.integers(0, 2**32 - 1))
def test_positions_are_between_the_observations(seed):
    rng = np.random.default_rng(seed)
    tracks, places = walks(5, 4, int(rng.integers(1000)))
    simulation = tracks.simulation()
    assert simulation.time == 0 and simulation.end == 3 and len(simulation) == 5
    assert [simulation.label(id) for id in range(5)] == tracks.labels == list(range(5))
    for time in (0.25, 1, 2.5):
        simulation.advance_to(time)
        i = int(time)
        expected = places[:, i] + (time - i) * (places[:, min(i + 1, 3)] - places[:, i])
        assert np.allclose(simulation.positions(), expected, atol=1e-12)
    assert simulation.audit()


def test_rows_come_in_any_order_and_twice():
    expected = Tracks.from_arrays(**COLUMNS).record()
    table = pd.DataFrame(COLUMNS)
    shuffled = pd.concat([table, table]).sample(frac=1, random_state=1)
    tracks = Tracks.from_dataframe(shuffled)
    assert tracks.labels == ["a", "b"] and len(tracks) == 2 and (tracks.start, tracks.end) == (0, 4)
    assert tracks.record().tobytes() == expected.tobytes() and len(expected) > 0
    renamed = table.rename(columns={"t": "time", "x": "X", "id": "name"})
    tracks = Tracks.from_dataframe(renamed, t="time", x="X", id="name")
    assert tracks.record().tobytes() == expected.tobytes()


def test_tables_of_every_column_type():
    table = pd.DataFrame(COLUMNS).convert_dtypes()
    table["x"] = table["x"].astype("Float64")
    table["id"] = table["id"].astype("category")
    assert Tracks.from_dataframe(table).closest(1)["distance"].tolist() == [3]
    table["x"] = [0, None, 4, 0]
    with pytest.raises(kinetri.PreconditionError, match=r"x\[1\] is nan"):
        Tracks.from_dataframe(table.convert_dtypes())


def test_labels_are_what_was_given():
    rows = [(1, -5, 0, 0), (0, 30, 4, 0), (2, -5, 1, 1), (3, 30, 5, 5)]
    t, id, x, y = map(list, zip(*rows))
    tracks = Tracks.from_arrays(t, id, x, y)
    assert tracks.labels == [30, -5] and all(type(label) is int for label in tracks.labels)
    table = tracks.closest(1)
    assert {table["a"][0], table["b"][0]} == {-5, 30}
    texts = Tracks.from_arrays(t, ["a", "b", "a", "b"], x, y)
    assert texts.labels == ["b", "a"] and all(type(label) is str for label in texts.labels)
    simulation = texts.simulation()
    assert [simulation.label(id) for id in range(len(simulation.stays))] == ["b", "a"]
    with pytest.raises(kinetri.PreconditionError, match="no point 2"):
        simulation.label(2)


@pytest.mark.parametrize("unit", ["ns", "us", "ms", "s", "m", "h", "D"])
def test_dates(unit):
    begin = np.datetime64("2024-02-28T00:00:00", unit)
    days = np.timedelta64(1, "D")
    dates = begin + np.array([0, 4, 0, 4]) * days
    tracks = Tracks.from_arrays(dates, *list(COLUMNS.values())[1:])
    assert tracks.origin == begin and (tracks.start, tracks.end) == (0, 4 * 86400)
    table = tracks.closest(1)
    assert table["time"].tolist() == [2 * 86400]
    assert table["date"].tolist() == [pd.Timestamp("2024-03-01")]
    assert tracks.dates([0, 0.5]).tolist() == np.array(
        ["2024-02-28T00:00:00", "2024-02-28T00:00:00.5"], dtype="M8[ns]").tolist()
    with pytest.raises(kinetri.PreconditionError, match="expected tracks with dates"):
        Tracks.from_arrays(**COLUMNS).dates([0])


def test_dates_of_tables_and_time_zones():
    table = pd.DataFrame(COLUMNS)
    table["t"] = pd.Timestamp("2024-03-31T00:00", tz="Europe/Zurich") + pd.to_timedelta(table["t"], unit="h")
    tracks = Tracks.from_dataframe(table)
    assert tracks.origin == np.datetime64("2024-03-30T23:00") and tracks.end == 4 * 3600
    table.loc[1, "t"] = pd.NaT
    with pytest.raises(kinetri.PreconditionError, match=r"t\[1\] is not a time; expected dates"):
        Tracks.from_dataframe(table)
    months = np.array(["2024-01", "2024-03", "2024-01", "2024-03"], dtype="M8[M]")
    assert Tracks.from_arrays(months, *list(COLUMNS.values())[1:]).end == 60 * 86400


TWO_DAYS = [datetime.datetime(2024, 1, 1), datetime.datetime(2024, 1, 2)] * 2
HOUR = datetime.timedelta(hours=1)


@pytest.mark.parametrize("times, end, origin", [
    (TWO_DAYS, 86400, "2024-01-01"),
    ([day.date() for day in TWO_DAYS], 86400, "2024-01-01"),
    ([pd.Timestamp(day) + pd.Timedelta(7, "ns") for day in TWO_DAYS], 86400, "2024-01-01T00:00:00.000000007"),
    # The hour that comes twice when summer ends, with the offset of each.
    ([pd.Timestamp("2024-10-27 02:30+02:00"), pd.Timestamp("2024-10-27 02:30+01:00")] * 2, 3600, "2024-10-27T00:30"),
    ([day.replace(tzinfo=datetime.timezone(HOUR * 5.5)) for day in TWO_DAYS], 86400, "2023-12-31T18:30"),
    ([0 * HOUR, 2 * HOUR] * 2, 7200, None),
    (np.array([0, 1500, 0, 1500], dtype="timedelta64[ms]"), 1.5, None),
    (pd.to_timedelta([0, 1, 0, 1], unit="s"), 1, None),
])
def test_dates_and_durations_of_python_and_pandas(times, end, origin):
    columns = COLUMNS | {"t": times}
    for tracks in (Tracks.from_arrays(*columns.values()), Tracks.from_dataframe(pd.DataFrame(columns)),
                   Tracks.from_dataframe(pd.DataFrame(columns | {"t": pd.Series(list(times), dtype=object)}))):
        assert tracks.start == 0 and tracks.end == end
        assert tracks.origin == (None if origin is None else np.datetime64(origin))


@pytest.mark.parametrize("times, message", [
    (["2024-10-27T02:30:00", "2024-10-27T02:31:00"] * 2,
     "t has texts, such as '2024-10-27T02:30:00'; expected numbers, or dates, as pandas.to_datetime(t, utc=True)"),
    ([TWO_DAYS[0], "2024-10-27"] * 2, "and t[1] '2024-10-27'; expected times of one kind"),
    ([TWO_DAYS[0], 3.5] * 2, "and t[1] 3.5; expected times of one kind"),
    ([TWO_DAYS[0], TWO_DAYS[1].astimezone()] * 2, "t[0] is a date without an offset, and t[1] one with"),
    ([pd.NaT, pd.Timestamp(0)] * 2, "t[0] is not a time; expected dates"),
    (np.array([0, 1, 0, "NaT"], dtype="timedelta64[s]"), "t[3] is not a time; expected dates or durations"),
    (np.array([0, 1, 0, 1], dtype="timedelta64[M]"), "t is an array of timedelta64[M], which have no length"),
    ([object()] * 4, "t is an array of object; expected real numbers of shape (n,)"),
])
def test_times_that_are_none_say_what_to_do(times, message):
    for make in (lambda: Tracks.from_arrays(*(COLUMNS | {"t": times}).values()),
                 lambda: Tracks.from_dataframe(pd.DataFrame(COLUMNS | {"t": pd.Series(list(times), dtype=object)}))):
        if isinstance(times, np.ndarray) and make.__code__.co_names[0] == "pd":
            continue
        with pytest.raises(kinetri.PreconditionError, match=re.escape(message)):
            make()


def test_the_advice_about_texts_works():
    texts = pd.Series(["2024-10-27T02:30:00+02:00", "2024-10-27T02:30:00+01:00"] * 2)
    assert Tracks.from_arrays(*(COLUMNS | {"t": pd.to_datetime(texts, utc=True)}).values()).end == 3600


def test_what_is_no_table_is_an_error_with_the_way_out():
    frame = pd.DataFrame(COLUMNS)
    doubled = pd.concat([frame, frame[["x"]]], axis=1)
    with pytest.raises(kinetri.PreconditionError, match="df has 2 columns 'x'; expected one that is x"):
        Tracks.from_dataframe(doubled)
    assert len(Tracks.from_dataframe(doubled.loc[:, ~doubled.columns.duplicated()])) == 2
    with pytest.raises(kinetri.PreconditionError, match="df is a dict; expected a pandas.DataFrame"):
        Tracks.from_dataframe(COLUMNS)
    assert len(Tracks.from_dataframe(pd.DataFrame(COLUMNS))) == len(Tracks.from_arrays(**COLUMNS)) == 2


def test_a_gap_ends_a_stay():
    t, x = [0, 1, 10, 11, 0, 11], [0, 1, 10, 11, 0, 11]
    id, y = ["a"] * 4 + ["b"] * 2, [0] * 4 + [5] * 2
    tracks = Tracks.from_arrays(t, id, x, y, max_gap=11)
    assert tracks.simulation().stays.tolist() == [[0, 0, 3], [1, 0, 1]]
    tracks = Tracks.from_arrays(t, id, x, y, max_gap=5)
    simulation = tracks.simulation()
    stays = [(tracks.labels[thing], first, last) for thing, first, last in simulation.stays.tolist()]
    assert ("a", 0, 1) in stays and ("a", 2, 3) in stays
    simulation.advance_to(5)
    assert [simulation.label(id) for id in simulation.ids if simulation.label(id) == "a"] == []
    simulation.advance_to(10.5)
    assert [simulation.label(id) for id in simulation.ids.tolist()].count("a") == 1
    part = tracks.simulation(start=10, until=11)
    assert part.time == 10 and part.end == 11 and len(part) >= 1


def test_radii():
    tracks = Tracks.from_arrays(**COLUMNS, radius=[1, 1, 2, 2])
    simulation = tracks.simulation(collisions="log")
    assert simulation.radii().tolist() == [1, 2]
    # 3^2 + (4 - 2 t)^2 <= 3^2 only at 2: a touch is no contact.
    assert (simulation.record(until=4)["kind"] == "collision").sum() == 0
    larger = Tracks.from_arrays(**COLUMNS, radius=[2, 2, 3, 3]).simulation(collisions="log")
    contacts = larger.record(until=4)
    contacts = contacts[contacts["kind"] == "collision"]
    assert contacts["time"].tolist() == [0] or contacts["time"].tolist() == []
    assert Tracks.from_arrays(**COLUMNS).simulation(radius=0.5).radii().tolist() == [0.5] * 2
    with pytest.raises(kinetri.PreconditionError, match="expected one of the two"):
        tracks.simulation(radius=1)
    with pytest.raises(kinetri.InputError, match=r"rows 2 and 3: 'b' has the radii 1.0 and 2.0"):
        Tracks.from_arrays(**COLUMNS, radius=[1, 1, 1, 2])
    with pytest.raises(kinetri.InputError, match="row 2: the radius is -1.0; expected at least 0"):
        Tracks.from_arrays(**COLUMNS, radius=[1, 1, -1, -1])


@pytest.mark.parametrize("change, error, message", [
    ({"t": [0, 0, 0, 4]}, "InputError", r"rows 0 and 1: 'a' is at two places at t = 0.0; expected one"),
    ({"t": [0, 1, 2]}, "PreconditionError", r"x has the shape \(4,\); expected \(3,\)"),
    ({"x": [0, np.nan, 1, 1]}, "PreconditionError", r"x\[1\] is nan; expected finite"),
    ({"t": ["0", "1", "2", "3"]}, "PreconditionError", "t has texts, such as '0'; expected numbers, or dates"),
    ({"id": ["a", "b"]}, "PreconditionError", r"id has the shape \(2,\); expected \(4,\)"),
    ({"id": ["a", 1, "b", 2]}, None, ""),
    ({"id": np.array(["a", None, "b", 2], dtype=object)}, "PreconditionError",
     r"id\[1\] is None; expected"),
    ({"id": [1, np.nan, 2, 2]}, "PreconditionError", r"id\[1\] is nan; expected"),
    ({"id": np.array(["a", 1, "b", 2], dtype=object)}, "PreconditionError", "id"),
    ({"max_gap": 0}, "PreconditionError", "max_gap is 0; expected a time greater than 0"),
    ({"max_gap": "x"}, "PreconditionError", "max_gap"),
])
def test_bad_columns(change, error, message):
    arguments = {**COLUMNS, **change}
    if error is None:
        assert len(Tracks.from_arrays(**arguments)) == 4
        return
    with pytest.raises(getattr(kinetri, error), match=message):
        Tracks.from_arrays(**arguments)


def test_a_column_that_is_not_there():
    with pytest.raises(kinetri.PreconditionError, match="x is 'X'; expected one of the columns 't', 'id'"):
        Tracks.from_dataframe(pd.DataFrame(COLUMNS), x="X")


def test_nothing_and_one_observation():
    tracks = Tracks.from_arrays([], [], [], [])
    assert len(tracks) == 0 and np.isnan(tracks.start) and len(tracks.record()) == 0
    assert tracks.closest(5).shape[0] == 0 and "0 things" in repr(tracks)
    one = Tracks.from_arrays([3], ["a"], [1], [2])
    assert (one.start, one.end) == (3, 3) and len(one.simulation()) <= 1
    assert Tracks.from_arrays(np.empty(0, "M8[s]"), [], [], []).labels == []


def test_two_things_on_one_track_are_named():
    tracks = Tracks.from_arrays([0, 2, 1, 3], ["a", "a", "b", "b"], [0, 2, 1, 3], [0, 0, 0, 0], coincident="refuse")
    with pytest.raises(kinetri.CoincidentTrajectoriesError) as raised:
        tracks.record()
    assert raised.value.ids == (0, 1)
    # Those before it: the second thing comes at t = 1.
    assert raised.value.events.dtype == kinetri.event_dtype and len(raised.value.events) == 0


def test_files_and_the_program(tmp_path):
    rng = np.random.default_rng(4)
    with open(tmp_path / "tracks.csv", "w", encoding="utf-8") as file:
        file.write("t,id,x,y\n")
        for thing in range(10):
            for time, (x, y) in enumerate(rng.uniform(0, 20, (6, 2)).tolist()):
                file.write(f"{time},w{thing},{x!r},{y!r}\n")
    run_program("tracks", "tracks.csv", "--events", "events.csv", directory=tmp_path)
    tracks = Tracks.read(tmp_path / "tracks.csv")
    assert tracks.labels == [f"w{i}" for i in range(10)]
    events = tracks.record()
    logged = pd.read_csv(tmp_path / "events.csv", float_precision="round_trip")
    assert len(logged) == len(events) > 20
    assert logged["kind"].tolist() == events["kind"].tolist()
    assert logged["time"].tolist() == events["time"].tolist()
    assert logged["removed_a"].fillna(kinetri.NO_POINT).tolist() == events["removed"][:, 0].tolist()
    same = Tracks.from_dataframe(pd.read_csv(tmp_path / "tracks.csv", float_precision="round_trip"))
    assert same.record().tobytes() == events.tobytes()
    (tmp_path / "frames.txt").write_text("0 1 0 0\n5 1 5 0\n0 2 9 9\n5 2 9 8\n", encoding="utf-8")
    frames = Tracks.read(tmp_path / "frames.txt", format="frames", fps=5)
    assert frames.end == 1 and frames.labels == ["1", "2"]
    (tmp_path / "bad.csv").write_text("t,id,x,y\n0,a,0,0\n1,a,b,0\n", encoding="utf-8")
    with pytest.raises(kinetri.InputError, match="bad.csv:3: "):
        Tracks.read(tmp_path / "bad.csv")


def test_files_of_other_formats(tmp_path):
    def read(text, **options):
        (tmp_path / "tracks").write_text(text, encoding="utf-8")
        return Tracks.read(tmp_path / "tracks", **options)

    expected = "<Tracks of 2 things, 4 observations, t = 0 to 1>"
    people = read("# framerate: 5\n# id frame x/cm y/cm\n1 0 0 0\n1 5 500 0\n2 0 900 900\n2 5 900 800\n")
    assert repr(people) == expected and people.frame_rate == 5 and people.origin is None
    assert people.remarks == ["5 frames a second, as the file says",
                              "places are in meters; the file has centimeters"]
    table = read("when;who;E;N\n2024-05-01T00:00:00.25Z;1;0;0\n2024-05-01T00:00:01.25Z;1;5;0\n"
                 "2024-05-01T00:00:00.25Z;2;9;9\n2024-05-01T00:00:01.25Z;2;9;8\n",
                 columns={"t": "when", "id": "who", "x": "E", "y": "N"})
    assert repr(table) == expected and table.origin == np.datetime64("2024-05-01T00:00:00.25")
    assert table.frame_rate is None and table.walkable_area is None
    assert table.dates(1) == np.datetime64("2024-05-01T00:00:01.25")
    same = read("2\n\nA 0 0 0\nB 9 9 0\n2\n\nA 5 0 0\nB 9 8 0\n")
    assert repr(same) == expected and same.labels == ["0", "1"]
    assert same.record()["time"].tolist() == people.record()["time"].tolist() == table.record()["time"].tolist()
    database = sqlite3.connect(tmp_path / "people.sqlite")
    database.executescript("""
        CREATE TABLE trajectory_data (frame INTEGER, id INTEGER, pos_x REAL, pos_y REAL);
        INSERT INTO trajectory_data VALUES (0, 1, 0, 0), (5, 1, 5, 0), (0, 2, 9, 9), (5, 2, 9, 8);
        CREATE TABLE metadata (key TEXT, value TEXT); INSERT INTO metadata VALUES ('fps', '5');
        CREATE TABLE geometry (wkt TEXT); INSERT INTO geometry VALUES ('POLYGON ((0 0, 9 0, 9 9, 0 0))');
        """)
    database.close()
    people = Tracks.read(tmp_path / "people.sqlite")
    assert repr(people) == expected and people.walkable_area == "POLYGON ((0 0, 9 0, 9 9, 0 0))"


def test_files_as_others_write_them(tmp_path):
    (tmp_path / "ships.csv").write_text(
        "# Timestamp,MMSI,Latitude,Longitude\n05/03/2023 00:00:00,1,55.0,12.0\n05/03/2023 00:10:00,1,55.02,12.0\n"
        "05/03/2023 00:10:00,1,55.03,12.0\n05/03/2023 00:20:00,1,55.04,12.0\n05/03/2023 00:30:00,1,,\n",
        encoding="utf-8")
    ships = Tracks.read(tmp_path / "ships.csv", projection="utm", date_format="%d/%m/%Y %H:%M:%S", duplicates="last",
                        columns={"t": "Timestamp", "id": "MMSI", "x": "Longitude", "y": "Latitude"})
    assert ships.origin == np.datetime64("2023-03-05T00:00:00") and ships.end == 1200
    assert "1 row left out, having no place" in ships.remarks
    assert any("UTM, zone 33 north" in remark for remark in ships.remarks)
    assert any("left out for a later one with another place" in remark for remark in ships.remarks)
    (tmp_path / "gt.txt").write_text("1,1,10,20,5\n2,1,11,20,5\n", encoding="utf-8")
    boxes = Tracks.read(tmp_path / "gt.txt", columns={"t": "1", "id": "2", "x": "3", "y": "4"})
    assert repr(boxes) == "<Tracks of 1 things, 2 observations, t = 1 to 2>"


def test_files_that_are_read_with_wrong_options(tmp_path):
    (tmp_path / "t.csv").write_text("t,id,x,y\n0,a,0,0\n1,a,1,0\n", encoding="utf-8")
    (tmp_path / "f.txt").write_text("0 1 0 0\n5 1 5 0\n", encoding="utf-8")
    for file, options, message in (
            ("t.csv", {"fps": 5}, "has times, not frames; expected no fps"),
            ("t.csv", {"fps": 0}, "the number of frames a second is not a finite number greater than 0"),
            ("t.csv", {"format": "csv"}, "the format is 'csv'; expected one of 'auto', 'rows', "),
            ("t.csv", {"columns": ["t", "id"]}, "columns is a list; expected a dict, as in {'t': 'time', ...}"),
            ("t.csv", {"columns": {"t": 1}}, "columns has 't': 1; expected texts, numbers of columns too, as in {'t': '1'"),
            ("t.csv", {"columns": {"z": "z"}}, "columns has 'z'; expected 't', 'id', 'x', 'y' and 'radius'"),
            ("t.csv", {"projection": "mercator"}, "projection is 'mercator'; expected one of 'none', 'local', 'utm'"),
            ("t.csv", {"duplicates": "all"}, "duplicates is 'all'; expected one of 'first', 'last', 'mean', 'refuse'"),
            ("t.csv", {"date_format": "%m"}, "date_format is '%m', which has no day"),
            ("t.csv", {"unwrap": "all"}, "unwrap is 'all'; expected 'nearest'")):
        with pytest.raises(kinetri.PreconditionError, match=message):
            Tracks.read(tmp_path / file, **options)
    with pytest.raises(kinetri.InputError, match="with format='frames', the order frame id x y"):
        Tracks.read(tmp_path / "f.txt", fps=5)


@pytest.mark.parametrize("column", ["t", "id", "x", "y"])
def test_masked_columns_are_refused(column):
    columns = {"t": [0.0, 1.0], "id": [1, 1], "x": [0.0, 1.0], "y": [0.0, 1.0]}
    columns[column] = np.ma.array(columns[column], mask=[False, True])
    with pytest.raises(kinetri.PreconditionError) as raised:
        Tracks.from_arrays(**columns)
    assert str(raised.value) == f"{column} is masked at [1]; expected no masked values"


def test_bytes_that_are_no_utf8_stay_in_labels_and_messages(tmp_path):
    path = tmp_path / "latin.csv"
    path.write_bytes("t,id,x,y\n0,J\u00f6rg,0,0\n1,J\u00f6rg,1,0\n".encode("latin-1"))
    assert Tracks.read(path).labels == ["J\udcf6rg"]
    path.write_bytes("t,id,x,y\n0,a,J\u00f6rg,0\n".encode("latin-1"))
    with pytest.raises(kinetri.InputError, match="J\udcf6rg"):
        Tracks.read(path)
