# SPDX-License-Identifier: GPL-3.0-or-later
"""The package against the program: the same points give the files that the program writes."""
import csv
import json
import sqlite3
import subprocess

import numpy as np
import pytest
from support import run_program, uniform, write_points

import kinetri


def rounded(text):
    return np.nan if text == "" else float(text)


def read_events(path):
    """The rows of an event log, in the form of `to_dataframe`."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def read_edges(path):
    return np.loadtxt(path, delimiter=",", skiprows=1, dtype=np.uint32, ndmin=2).reshape(-1, 2)


def as_rows(events):
    """The events as the log has them."""
    names = {"removed_a": ("removed", 0), "removed_b": ("removed", 1), "added_a": ("added", 0),
             "added_b": ("added", 1), "point_a": ("points", 0), "point_b": ("points", 1)}
    rows = []
    for i, event in enumerate(events):
        row = {"event": str(i), "kind": str(event["kind"])}
        for name in ("time", "time_lo", "time_hi"):
            row[name] = float(event[name])
        for name, (field, j) in names.items():
            id = int(event[field][j])
            row[name] = "" if id == kinetri.NO_POINT else str(id)
        rows.append(row)
    return rows


def assert_same_events(events, path):
    logged = read_events(path)
    assert len(logged) == len(events)
    for row, expected in zip(as_rows(events), logged):
        del expected["instant"]  # the array has no such field
        for name in ("time", "time_lo", "time_hi"):
            expected[name] = rounded(expected[name])
        # The log has the tightest bounds where a time is no float64, as the array.
        assert row == expected


def discs(seed, n=60):
    rng = np.random.default_rng(seed)
    places = np.stack(np.meshgrid(np.arange(8), np.arange(8)), -1).reshape(-1, 2)[:n] * 10.0 + 10
    return {"positions": places, "velocities": rng.uniform(-8, 8, (n, 2)),
            "radius": rng.uniform(0.5, 3, n), "mass": rng.uniform(0.1, 9, n)}


def together(columns):
    """The columns, with the first ten motions once more."""
    return {name: np.concatenate([values, values[:10]]) for name, values in columns.items()}


BOX = (0, 0, 90, 90)


def test_cells_of_people_end_at_the_area_that_their_file_has(tmp_path):
    database = sqlite3.connect(tmp_path / "people.sqlite")
    database.executescript("""
        CREATE TABLE trajectory_data (frame INTEGER, id INTEGER, pos_x REAL, pos_y REAL);
        INSERT INTO trajectory_data VALUES (0, 7, 0.5, 2), (2, 7, 0.5, 2), (0, 8, 1.5, 2), (2, 8, 3.5, 2);
        CREATE TABLE metadata (key TEXT, value TEXT); INSERT INTO metadata VALUES ('fps', '1');
        CREATE TABLE geometry (wkt TEXT);
        INSERT INTO geometry VALUES ('GEOMETRYCOLLECTION (POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0)))');
        """)
    database.close()
    (tmp_path / "half.wkt").write_text("POLYGON ((0 0, 4 0, 4 2.5, 0 2.5, 0 0))", encoding="utf-8")
    people = kinetri.Tracks.read(tmp_path / "people.sqlite")
    half = (tmp_path / "half.wkt").read_text(encoding="utf-8")
    # Until they leave at t = 2, the line between the two goes from x = 1 to x = 2.
    for limits, arguments, height in ((("--walkable", "half.wkt"), {"walkable": half}, 2.5), ((), {}, 4),
                                      (("--cutoff", "9"), {"cutoff": 9}, 4)):
        outcome = run_program("tracks", "people.sqlite", "--areas", "areas.csv", "--mean-areas", "means.csv",
                              *limits, directory=tmp_path)
        assert ("within the walkable area" in outcome.stderr) == (height == 4)
        table = np.loadtxt(tmp_path / "areas.csv", delimiter=",", skiprows=1)
        assert table[:, :3].tolist() == [[0, 0, height], [0, 1, 3 * height],
                                         [1, 0, 1.5 * height], [1, 1, 2.5 * height]]
        areas = people.areas(fps=1, **arguments)
        assert areas["area"].tolist() == table[:, 2].tolist() and areas["id"].tolist() == ["7", "8"] * 2
        means = np.loadtxt(tmp_path / "means.csv", delimiter=",", skiprows=1)
        np.testing.assert_allclose(means[:, 3], [1.5 * height, 2.5 * height], rtol=1e-9)
        assert people.mean_areas(**arguments)["area"].tolist() == means[:, 3].tolist()
    database = sqlite3.connect(tmp_path / "people.sqlite")
    database.executescript("UPDATE geometry SET wkt = 'POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))'")
    database.close()
    with pytest.raises(subprocess.CalledProcessError) as refused:
        run_program("tracks", "people.sqlite", "--areas", "other.csv", directory=tmp_path)
    assert "people.sqlite (its walkable area): polygon 1: the edge from" in refused.value.stderr
    assert not (tmp_path / "other.csv").exists()

CASES = {
    "points": (kinetri.KineticDelaunay, dict(zip(("positions", "velocities"), uniform(120, 1))), {}, []),
    "lattice": (kinetri.KineticDelaunay, dict(zip(("positions", "velocities"), kinetri.scenario(
        "lattice", 49, seed=2))), {}, []),
    "accelerated": (kinetri.KineticDelaunay, dict(zip(
        ("positions", "velocities", "acceleration", "jerk"),
        (*uniform(60, 3), uniform(60, 4)[1], uniform(60, 5)[1] / 4))), {}, []),
    "regular": (kinetri.KineticRegular, {
        **dict(zip(("positions", "velocities"), uniform(60, 6))),
        "radius": np.random.default_rng(7).uniform(0, 12, 60),
        "growth": np.random.default_rng(8).uniform(0, 1, 60)}, {}, ["--regular"]),
    "walls": (kinetri.Simulation, dict(zip(("positions", "velocities"), uniform(60, 9, side=89))),
              {"box": BOX}, ["--box", "0,0,90,90"]),
    "coincident": (kinetri.KineticDelaunay, together(dict(zip(("positions", "velocities"), uniform(60, 17)))), {}, []),
    "coincident, walls": (kinetri.Simulation, together(dict(zip(
        ("positions", "velocities"), uniform(60, 18, side=89)))), {"box": BOX}, ["--box", "0,0,90,90"]),
    "coincident, log": (kinetri.Simulation, together(discs(19)), {"collisions": "log"}, ["--collisions", "log"]),
    "elastic": (kinetri.Simulation, discs(10), {"box": BOX, "rim": True, "collisions": "elastic"},
                ["--box", "0,0,90,90", "--rim", "--collisions", "elastic"]),
    "elastic, equal": (kinetri.Simulation, {**discs(11), "radius": np.full(60, 2.5)},
                       {"box": BOX, "collisions": "elastic"},
                       ["--box", "0,0,90,90", "--collisions", "elastic"]),
    "growing": (kinetri.Simulation, {**discs(12), "growth": np.full(60, 0.25)},
                {"box": BOX, "rim": True, "collisions": "elastic", "mass": "area"},
                ["--box", "0,0,90,90", "--rim", "--collisions", "elastic", "--mass", "area"]),
    "log": (kinetri.Simulation, discs(13), {"collisions": "log"}, ["--collisions", "log"]),
    "swap": (kinetri.Simulation, discs(14), {"collisions": "swap"}, ["--collisions", "swap"]),
    "stop": (kinetri.Simulation, discs(15), {"collisions": "stop"}, ["--collisions", "stop"]),
    "remove": (kinetri.Simulation, discs(16), {"collisions": "remove"}, ["--collisions", "remove"]),
}


def file_columns(columns):
    names = {"positions": ("x", "y"), "velocities": ("vx", "vy"), "acceleration": ("ax", "ay"),
             "jerk": ("jx", "jy")}
    result = {}
    for name, values in columns.items():
        if name in names:
            result.update(zip(names[name], np.asarray(values).T))
        else:
            result[name] = values
    return result


def make(case):
    cls, columns, options, _ = CASES[case]
    return cls(**{**columns, **options})


@pytest.mark.parametrize("case", CASES)
def test_events_and_edges_are_those_of_the_program(case, tmp_path):
    _, columns, _, arguments = CASES[case]
    write_points(tmp_path / "points.csv", **file_columns(columns))
    run_program("simulate", "points.csv", "--until", "2.5", "--events", "events.csv",
                "--initial-edges", "first.csv", "--edges", "last.csv", "--stats", "stats.json",
                *arguments, directory=tmp_path)
    points = make(case)
    assert np.array_equal(points.edges(), read_edges(tmp_path / "first.csv"))
    events = points.record(until=2.5)
    assert len(events) > 30
    assert_same_events(events, tmp_path / "events.csv")
    assert np.array_equal(points.edges(), read_edges(tmp_path / "last.csv"))
    counts = json.loads((tmp_path / "stats.json").read_text())["events"]
    statistics = points.statistics()
    assert {kind: n for kind, n in statistics["events"].items() if n} == {
        kind: n for kind, n in counts.items() if n and kind in kinetri.event_kinds}
    assert sum(statistics["events"].values()) == len(events)
    assert points.audit()


@pytest.mark.parametrize("case", CASES)
def test_the_program_resumes_what_the_package_saves_and_the_other_way_round(case, tmp_path):
    _, columns, _, arguments = CASES[case]
    write_points(tmp_path / "points.csv", **file_columns(columns))
    points = make(case)
    points.advance_to(1)
    points.save(tmp_path / "package.kinetri")
    run_program("simulate", "points.csv", "--until", "1", "--checkpoint", "program.kinetri", *arguments,
                directory=tmp_path)
    run_program("resume", "package.kinetri", "--until", "2", "--edges", "edges.csv", "--events",
                "events.csv", directory=tmp_path)
    loaded = type(points).load(tmp_path / "program.kinetri")
    expected = points.record(until=2)
    assert len(expected) > 10
    assert np.array_equal(loaded.record(until=2), expected)
    assert np.array_equal(loaded.edges(), points.edges())
    assert np.array_equal(read_edges(tmp_path / "edges.csv"), points.edges())
    logged = read_events(tmp_path / "events.csv")
    assert [row["kind"] for row in logged] == expected["kind"].tolist()
    assert [float(row["time"]) for row in logged] == expected["time"].tolist()


def test_points_files_are_read_as_the_program_reads_them(tmp_path):
    (tmp_path / "points.csv").write_text(
        "# points\nvy,y,x,vx,id,radius,mass,growth,other\n"
        "0x1p-1,2,1,3,a,0.5,2,0.25,?\n\n1,0,7,-1,b c,1,3,0,\n",
        encoding="utf-8")
    columns = kinetri.read_points(tmp_path / "points.csv")
    assert columns["positions"].tolist() == [[1, 2], [7, 0]]
    assert columns["velocities"].tolist() == [[3, 0.5], [-1, 1]]
    assert columns["radius"].tolist() == [0.5, 1] and columns["mass"].tolist() == [2, 3]
    assert columns["growth"].tolist() == [0.25, 0] and columns.pop("label") == ["a", "b c"]
    sim = kinetri.Simulation(**columns, collisions="elastic")
    assert sim.radii().tolist() == [0.5, 1] and sim.masses().tolist() == [2, 3]
    write_points(tmp_path / "accelerated.csv", x=[1], y=[2], vx=[3], vy=[4], ax=[5], ay=[6], jx=[7], jy=[8])
    columns = kinetri.read_points(str(tmp_path / "accelerated.csv"))
    assert {name: values.tolist() for name, values in columns.items()} == {
        "positions": [[1, 2]], "velocities": [[3, 4]], "acceleration": [[5, 6]], "jerk": [[7, 8]]}


@pytest.mark.parametrize("content, message", [
    ("x,y,vx,vy\n1,2,3\n", ":2: "),
    ("x,y,vx,vy\n1,2,3,4\n1,nan,3,4\n", ":3: "),
    ("x,y,vx\n", ":1: "),
    ("", "points.csv"),
])
def test_a_bad_file_is_an_input_error_with_file_and_line(content, message, tmp_path):
    (tmp_path / "points.csv").write_text(content, encoding="utf-8")
    with pytest.raises(kinetri.InputError) as raised:
        kinetri.read_points(tmp_path / "points.csv")
    assert f"points.csv{message}" in str(raised.value) or message in str(raised.value)
    assert isinstance(raised.value, kinetri.Error)


def test_files_that_cannot_be_read_or_written(tmp_path):
    kd = kinetri.KineticDelaunay(*uniform(5, 1))
    for call in (lambda: kinetri.read_points(tmp_path / "none.csv"),
                 lambda: kinetri.Tracks.read(tmp_path / "none.csv"),
                 lambda: kinetri.KineticDelaunay.load(tmp_path / "none"),
                 lambda: kinetri.Simulation.load(tmp_path)):
        with pytest.raises(kinetri.InputError):
            call()
    (tmp_path / "text").write_text("x,y\n", encoding="utf-8")
    with pytest.raises(kinetri.InputError, match="text"):
        kinetri.Simulation.load(tmp_path / "text")
    for path in (tmp_path, tmp_path / "none" / "file"):
        with pytest.raises(kinetri.OutputError) as raised:
            kd.save(path)
        assert isinstance(raised.value, OSError)
    kd.save(tmp_path / "state")
    damaged = bytearray((tmp_path / "state").read_bytes())
    damaged[len(damaged) // 2] ^= 1
    (tmp_path / "state").write_bytes(damaged)
    with pytest.raises(kinetri.Error):
        kinetri.KineticDelaunay.load(tmp_path / "state")


def test_scenarios_are_those_of_generate(tmp_path):
    for kind in ("uniform", "gaussian", "constant-speed", "one-mover", "lattice", "lattice-jitter"):
        text = run_program("generate", kind, "--points", 64, "--seed", 5, directory=tmp_path).stdout
        (tmp_path / "points.csv").write_text(text, encoding="utf-8")
        columns = kinetri.read_points(tmp_path / "points.csv")
        positions, velocities = kinetri.scenario(kind, 64, seed=5)
        assert np.array_equal(columns["positions"], positions), kind
        assert np.array_equal(columns["velocities"], velocities), kind


def test_the_classes_of_files_are_kept_apart(tmp_path):
    points = uniform(9, 1)
    kinetri.KineticDelaunay(*points).save(tmp_path / "points")
    kinetri.KineticRegular(*points, radius=2).save(tmp_path / "discs")
    kinetri.Simulation(*points, radius=1, box=(0, 0, 100, 100)).save(tmp_path / "box")
    with pytest.raises(kinetri.SnapshotError, match="KineticRegular; expected that of a KineticDelaunay"):
        kinetri.KineticDelaunay.load(tmp_path / "discs")
    with pytest.raises(kinetri.SnapshotError, match="KineticDelaunay; expected that of a KineticRegular"):
        kinetri.KineticRegular.load(tmp_path / "points")
    with pytest.raises(kinetri.SnapshotError, match="restore it as a Simulation"):
        kinetri.KineticDelaunay.load(tmp_path / "box")
    assert kinetri.KineticRegular.load(tmp_path / "discs").radii().tolist() == [2] * 9
    assert kinetri.Simulation.load(tmp_path / "box").box == (0, 0, 100, 100)
    assert len(kinetri.Simulation.load(tmp_path / "points")) == 9
    kinetri.Simulation(*points, radius=1, collisions="swap").save(tmp_path / "swap")
    assert kinetri.Simulation.load(tmp_path / "swap").collisions == "swap"
    assert callable(kinetri.Simulation.load(tmp_path / "swap", collisions=lambda contact: None).collisions)
    with pytest.raises(kinetri.PreconditionError, match="response"):
        kinetri.Simulation.load(tmp_path / "points", collisions="swap")


def test_a_packing_is_that_of_generate(tmp_path):
    text = run_program("generate", "packing", "--points", 40, "--share", 0.6, "--sizes", 1.5, "--seed", 3,
                       directory=tmp_path).stdout
    (tmp_path / "points.csv").write_text(text, encoding="utf-8")
    columns = kinetri.read_points(tmp_path / "points.csv")
    packing = kinetri.packing(40, share=0.6, sizes=1.5, seed=3)
    for name in ("positions", "velocities", "radius"):
        assert np.array_equal(columns[name], packing[name]), name
    area = (packing["box"][2] - packing["box"][0]) * (packing["box"][3] - packing["box"][1])
    assert abs(np.pi * np.sum(packing["radius"] ** 2) / area - 0.6) < 1e-9
    with pytest.raises(kinetri.PackingError):
        kinetri.packing(2, share=0.95)
    with pytest.raises(kinetri.PreconditionError):
        kinetri.packing(40, share=0)


def test_a_packing_in_a_periodic_box_is_that_of_generate(tmp_path):
    run_program("generate", "packing", "--points", 40, "--share", 0.6, "--side", 9, "--periodic", "--output", "p.csv",
                directory=tmp_path)
    columns, packing = kinetri.read_points(tmp_path / "p.csv"), kinetri.packing(40, share=0.6, side=9, periodic=True)
    for name in ("positions", "velocities", "radius"):
        assert np.array_equal(columns[name], packing[name]), name
    assert packing["box"] == kinetri.Box((9, 9))
    sim = kinetri.Simulation(**packing, collisions="elastic", refuse_overlaps=True)
    assert sim.advance_to(1) > 0 and sim.audit()


def test_a_table_has_the_columns_of_the_log(tmp_path):
    positions, velocities = uniform(60, 20)
    write_points(tmp_path / "points.csv", **file_columns({"positions": positions, "velocities": velocities}))
    run_program("simulate", "points.csv", "--until", "1", "--events", "events.csv", directory=tmp_path)
    import pandas as pd

    logged = pd.read_csv(tmp_path / "events.csv", float_precision="round_trip").drop(columns=["event", "instant"])
    table = kinetri.to_dataframe(kinetri.KineticDelaunay(positions, velocities).record(until=1))
    assert list(table.columns) == list(logged.columns)
    for name in table.columns:
        assert table[name].astype(object).where(table[name].notna(), None).tolist() == logged[
            name].astype(object).where(logged[name].notna(), None).tolist(), name
    assert kinetri.to_dataframe(np.empty(0, kinetri.event_dtype)).shape == (0, 10)
