# SPDX-License-Identifier: GPL-3.0-or-later
"""Tracks of tables: degrees and projections; Parquet, Feather and Arrow; what messages name."""
import datetime
import re
import sys

import numpy as np
import pandas as pd
import pytest

import kinetri
from kinetri import Tracks

#: Degrees of longitude and latitude in meters, at 55.01 degrees north on the ellipsoid of WGS 84.
DEGREES = np.array([63978.21, 111323.71])
SHIPS = {"t": [0, 600, 0, 600], "id": ["a", "a", "b", "b"], "x": [12.0, 12.01, 12.02, 12.02],
         "y": [55.0, 55.0, 55.01, 55.02]}
WAY_OUT = ("expected projection='local', which makes them meters about the middle of the data, projection='utm', which "
           "makes them those of a zone of UTM, projection='none', which takes degrees as they are, or projected places")


def ways(x="x", y="y", **options):
    """The functions that make tracks of SHIPS with such names of columns."""
    frame = pd.DataFrame(SHIPS).rename(columns={"x": x, "y": y})
    return {"Tracks.from_dataframe": lambda: Tracks.from_dataframe(frame, x=x, y=y, **options),
            "Tracks.from_arrays": lambda: Tracks.from_arrays(frame["t"], frame["id"], frame[x], frame[y], **options)}


@pytest.mark.parametrize("x, y", [("lon", "lat"), ("location-long", "location-lat"), ("decimalLongitude", "N"),
                                  ("x (deg)", "y (deg)"), ("E", "GPSLatitude")])
def test_degrees_by_names(x, y):
    for name, make in ways(x, y).items():
        message = (f"{name}: the columns '{x}' and '{y}' are places in degrees of longitude and latitude, between which "
                   f"distances mean nothing; {WAY_OUT}")
        with pytest.raises(kinetri.InputError, match=re.escape(message)):
            make()
    for make in ways(x, y, projection="none").values():
        tracks = make()
        assert tracks.simulation().positions()[0].tolist() == [12, 55]
        assert tracks.remarks == [f"places are taken as they are, though the columns '{x}' and '{y}' are of angles"]
    for make in ways(x, y, projection="local").values():
        tracks = make()
        assert tracks.remarks[0] == f"places are degrees, as the columns '{x}' and '{y}' say"
        assert "(equirectangular projection of the ellipsoid of WGS 84); distances are off by at most" in tracks.remarks[1]
        ends = np.diff(tracks.simulation().positions(), axis=0)[0]
        assert np.allclose(ends, [0.02, 0.01] * DEGREES, rtol=1e-6)


def test_a_projection_without_names_and_its_meters():
    for make in ways(projection="utm").values():
        tracks = make()
        assert tracks.remarks == ["places are in meters of UTM, zone 33 north (EPSG:32633); distances are off by at most "
                                  "0.0052 %"]
        assert tracks.labels == ["a", "b"]
        # 1278.9 m along the parallel on the ellipsoid, and 1113.6 m along the meridian.
        first, second = tracks.simulation().positions()
        assert np.hypot(*(second - first)) == pytest.approx(np.hypot(1278.9, 1113.6), rel=0.001)
    for make in ways("lon_m", "lat_m").values():
        assert make().remarks == []
    # Arrays without names say nothing.
    assert Tracks.from_arrays(*SHIPS.values()).remarks == []


@pytest.mark.parametrize("x, y, options, message", [
    ("lat", "lon", {"projection": "utm"}, "x is the column 'lat', and y 'lon'; expected the longitude as x"),
    ("lon_rad", "lat_rad", {"projection": "utm"}, "are in radians; expected degrees, or projection='none', which"),
])
def test_names_that_contradict(x, y, options, message):
    for make in ways(x, y, **options).values():
        with pytest.raises(kinetri.InputError, match=re.escape(message)):
            make()


def test_what_looks_like_degrees():
    dates = [datetime.datetime(2024, 5, 1), datetime.datetime(2024, 5, 1, 1)]
    columns = {"t": dates, "id": [1, 1], "x": [8.12345, 8.12445], "y": [50.12345, 50.12345]}
    makes = (lambda **options: Tracks.from_arrays(*columns.values(), **options),
             lambda **options: Tracks.from_dataframe(pd.DataFrame(columns), **options))
    for make in makes:
        with pytest.raises(kinetri.InputError, match=r"nothing says what the places are, and they look like degrees: .*; "
                           r"expected projection='local' or projection='utm' if .*, or projection='none', which takes"):
            make()
        assert make(projection="none").remarks == []
        assert len(make(projection="local").remarks) == 1
    # Times that are numbers, and people who walk.
    assert len(Tracks.from_arrays(*(columns | {"t": [0, 3600]}).values())) == 1
    assert len(Tracks.from_arrays(*(columns | {"x": [8.12345, 58.12345]}).values())) == 1


def test_degrees_that_no_projection_takes():
    with pytest.raises(kinetri.InputError, match="Tracks.from_arrays: observation 3: the longitude is 200, and the latitude 55"):
        Tracks.from_arrays(*(SHIPS | {"x": [12, 12, 200, 12]}).values(), projection="utm")
    with pytest.raises(kinetri.InputError, match="by projection='local' distances would be wrong by up to .*; expected "
                       "projection='utm', by which they are wrong by at most"):
        Tracks.from_arrays([0, 0, 0], [1, 2, 3], [10, 10.01, 10], [60, 60, 0], projection="local")
    for projection in ("mercator", "", 5):
        for make in ways(projection=projection).values():
            with pytest.raises(kinetri.PreconditionError, match=f"projection is '{projection}'; expected one of 'none', "):
                make()


def test_places_that_ais_does_not_know_are_left_out():
    frame = pd.DataFrame({"t": [0, 5, 9, 0], "id": ["a", "b", "b", "c"], "lon": [12, 181, 12, 0], "lat": [55, 91, 55, 91],
                          "radius": [1, 2, 2, 3]})
    tracks = Tracks.from_dataframe(frame, x="lon", y="lat", radius="radius", projection="local")
    assert tracks.labels == ["a", "b"] and (tracks.start, tracks.end) == (0, 9)
    assert "2 rows left out, having no place" in tracks.remarks
    tracks = Tracks.from_dataframe(frame[frame["id"] != "a"], x="lon", y="lat", radius="radius", projection="local")
    assert tracks.labels == ["b"] and len(tracks) == 1
    assert tracks._radii.tolist() == [2]


# ---- what pandas and pyarrow hold ----


class Table:
    """A stand-in for what has to_pandas, such as a pyarrow.Table, whose `columns` are no names."""

    columns = [object()]

    def __init__(self, result):
        self.result = result

    def to_pandas(self):
        if isinstance(self.result, Exception):
            raise self.result
        return self.result


def test_tables_that_have_to_pandas():
    frame = pd.DataFrame(SHIPS)
    assert Tracks.from_dataframe(Table(frame)).record().tobytes() == Tracks.from_dataframe(frame).record().tobytes()
    for result, message in (
            (ImportError("no pandas"), "df is a Table, whose to_pandas() says: no pandas; expected pandas to be installed"),
            (TypeError("nested"), "df is a Table, whose to_pandas() says: nested; expected a pandas.DataFrame"),
            (frame["x"], "df is a Series; expected a pandas.DataFrame")):
        with pytest.raises(kinetri.PreconditionError, match=re.escape(message)):
            Tracks.from_dataframe(Table(result) if not isinstance(result, pd.Series) else result)


def test_tables_of_pyarrow():
    pyarrow = pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    frame = pd.DataFrame(SHIPS)
    assert Tracks.from_dataframe(pyarrow.table(frame)).labels == ["a", "b"]


FRAME = pd.DataFrame({
    "when": pd.to_datetime(["2024-05-01 10:00:00.25+02:00", "2024-05-01 10:10+02:00", "2024-05-01 10:00:00.25+02:00", None,
                            "2024-05-01 10:10+02:00", "2024-05-01 10:10+02:00"], format="ISO8601" if pd.__version__ > "2"
                           else None, utc=True).tz_convert("Europe/Berlin"),
    "name": ["a, \"c\"", "a, \"c\"", " b", "a, \"c\"", " b", " b"],
    "E": np.array([0.1, 1 / 3, 5, np.nan, 1e-300, 7], dtype="float64"),
    "N": np.array([0.1, 2, 3, np.nan, 4, 5], dtype="float32"),
    "speed": [1, 2, 3, 4, 5, 6]})
COLUMNS = {"t": "when", "id": "name", "x": "E", "y": "N"}


@pytest.fixture
def arrow(tmp_path, monkeypatch):
    """A function that makes a file which begins as one of a format does, and which pandas reads as `result`."""
    def make(result, name="ships.parquet", magic=b"PAR1", function="read_parquet"):
        (tmp_path / name).write_bytes(magic + b"\x00" * 20)

        def read(path):
            assert path == str(tmp_path / name)
            if isinstance(result, Exception):
                raise result
            return result

        monkeypatch.setattr(pd, function, read)
        return tmp_path / name

    return make


@pytest.mark.parametrize("name, magic, function", [
    ("ships.parquet", b"PAR1", "read_parquet"), ("ships.arrow", b"ARROW1", "read_feather"),
    ("ships.feather", b"FEA1", "read_feather"), ("any name", b"PAR1", "read_parquet")])
def test_files_of_arrow_are_read_as_the_table_that_they_hold(arrow, name, magic, function):
    path = arrow(FRAME.drop(index=[3, 5]), name, magic, function)
    tracks = Tracks.read(path, columns=COLUMNS)
    assert tracks.labels == ['a, "c"', " b"] and tracks.origin == np.datetime64("2024-05-01T08:00:00.250")
    assert tracks.end == 599.75
    # Numbers to the last digit; those of float32 as float64.
    assert tracks.simulation().positions().tolist() == [[0.1, float(np.float32(0.1))], [5, 3]]
    simulation = tracks.simulation()
    simulation.advance_to(tracks.end)
    assert tracks._places.tolist() == [[0.1, float(np.float32(0.1))], [1 / 3, 2], [5, 3], [1e-300, 4]]
    assert tracks.remarks[-1] == "columns that are not used: 'speed'"


def test_files_of_arrow_take_the_options_of_tables(arrow):
    with pytest.raises(kinetri.InputError, match=r"ships.parquet as CSV:5: the column when is empty"):
        Tracks.read(arrow(FRAME.assign(E=1.0)), columns=COLUMNS)
    path = arrow(FRAME.assign(when=FRAME["when"].ffill()))
    with pytest.raises(kinetri.InputError, match="two places.*duplicates='first', 'last' or 'mean', which says what to take"):
        Tracks.read(path, columns=COLUMNS, duplicates="refuse")
    tracks = Tracks.read(path, columns=COLUMNS, duplicates="last")
    assert tracks._places.tolist()[-1] == [7, 5]
    assert "1 row left out, having no place" in tracks.remarks
    # Frames, texts, durations, columns by default, an index with a name.
    plain = pd.DataFrame({"t": [0, 25], "id": [7, 7], "x": [0, 1], "y": [0, 0], "radius": [2, 2]})
    tracks = Tracks.read(arrow(plain), fps=25)
    assert tracks.end == 1 and tracks.labels == ["7"] and tracks._radii.tolist() == [2] and tracks.remarks == []
    assert Tracks.read(arrow(plain.set_index("t"))).end == 25
    assert Tracks.read(arrow(plain.assign(t=pd.to_timedelta([0, 90], unit="s")))).end == 90
    texts = plain.assign(t=["1.5.2024 10:00", "1.5.2024 10:01"])
    assert Tracks.read(arrow(texts), date_format="%d.%m.%Y %H:%M").end == 60
    days = plain.assign(date=["2024-05-01", "2024-05-02"], time=["23:59", "00:01"])
    assert Tracks.read(arrow(days), columns={"t": "date+time", "id": "id", "x": "x", "y": "y"}).end == 120
    with pytest.raises(kinetri.InputError, match="are places in degrees.*projection='local'"):
        Tracks.read(arrow(plain.rename(columns={"x": "lon", "y": "lat"})), columns={"t": "t", "id": "id", "x": "lon",
                                                                                   "y": "lat"})


def test_files_of_arrow_that_cannot_be_read(arrow, monkeypatch):
    for result, columns, message in (
            (ImportError("Unable to find a usable engine"), None,
             "is a file of Parquet, which cannot be read here: Unable to find a usable engine; expected pandas and pyarrow "
             "to be installed, as by pip install pandas pyarrow, or a table exported as CSV"),
            (OSError("footer"), None, "is a file of Parquet, of which pandas.read_parquet says: footer; expected one that"),
            (FRAME, None, "the column 't' is missing; expected one of 'when', 'name', 'E', 'N', 'speed'"),
            (FRAME, COLUMNS | {"t": "day+hour"}, "the column 'day' is missing; expected one of 'when'"),
            (FRAME.set_axis(list("12345"), axis=1), {"t": "1", "id": "2", "x": "3", "y": "4"},
             "the columns have numbers as names, '1', '2', '3', '4'; expected names")):
        with pytest.raises(kinetri.InputError, match="ships.parquet: " + re.escape(message)):
            Tracks.read(arrow(result), columns=columns)
    path = arrow(FRAME)
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(kinetri.InputError, match="which cannot be read here: .*pandas.*; expected pandas and pyarrow"):
        Tracks.read(path, columns=COLUMNS)


def test_files_that_pyarrow_writes(tmp_path):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    FRAME.drop(index=[3, 5]).reset_index(drop=True).to_parquet(tmp_path / "a.parquet")
    FRAME.drop(index=[3, 5]).reset_index(drop=True).to_feather(tmp_path / "a.feather")
    for name in ("a.parquet", "a.feather"):
        assert len(Tracks.read(tmp_path / name, columns=COLUMNS)) == 2


# ---- files ----


def test_dates_and_times_in_two_columns(tmp_path):
    (tmp_path / "t.csv").write_text("date,time,id,x,y\n2024-05-01,23:59:59.5,a,1,2\n2024-05-02,00:00,a,3,4\n",
                                    encoding="utf-8")
    tracks = Tracks.read(tmp_path / "t.csv", columns={"t": "date+time", "id": "id", "x": "x", "y": "y"})
    assert tracks.origin == np.datetime64("2024-05-01T23:59:59.5") and tracks.end == 0.5
    (tmp_path / "n.txt").write_text("01/05/2024;10:00;a;1;2\n01/05/2024;10:01;a;1;2\n", encoding="utf-8")
    tracks = Tracks.read(tmp_path / "n.txt", columns={"t": "1+2", "id": "3", "x": "4", "y": "5"},
                         date_format="%d/%m/%Y %H:%M")
    assert tracks.end == 60


@pytest.mark.parametrize("text, options, message", [
    ("t,id,lon,lat\n0,a,12,55\n", {"columns": {"t": "t", "id": "id", "x": "lon", "y": "lat"}}, WAY_OUT),
    ("1 2 3 4 5\n", {}, "expected format='table', columns={'t': 'N', 'id': 'N', 'x': 'N', 'y': 'N'}, with the number of"),
    ("0 1 0 0\n5 1 5 0\n", {"fps": 5}, "mean either of two things: with format='frames', the order frame id x y"),
    ("when,id,x,y\n", {}, "or columns={'t': 'NAME', 'id': 'NAME', 'x': 'NAME', 'y': 'NAME'} for the names in another"),
    ("t,id,x,y\n1/5/2024 10:00:00,a,1,2\n", {}, "or date_format='%d/%m/%Y %H:%M:%S' or date_format='%m/%d/%Y %H:%M:%S'"),
    ("t,id,x,y\n0,a,1,2\n0,a,3,4\n", {"duplicates": "refuse"},
     "expected one, or duplicates='first', 'last' or 'mean', which says what to take"),
    ("t,id,x,y\n0,a,1,2\n", {"unwrap": "nearest"}, "has no periodic box; expected no unwrap"),
    # What comes from the file stays as it is.
    ("t,id,x,y\n0,a,--projection local,2\n", {}, "the column x is '--projection local', which is not a number"),
    ("t,id,x,y\n0,a,it's --fps 5,2\n", {}, "the column x is 'it's --fps 5', which is not a number"),
])
def test_messages_name_parameters(tmp_path, text, options, message):
    path = tmp_path / "t.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(kinetri.InputError, match=re.escape(message)) as raised:
        Tracks.read(path, **options)
    assert "--" not in re.sub(r"'[^,;]*'", "", str(raised.value))


def test_remarks_name_parameters(tmp_path):
    (tmp_path / "t.csv").write_text("t,id,x,y\n0,a,1,2\n1,a,1,2\n2,a,1,2\n2,a,1,3\n", encoding="utf-8")
    assert Tracks.read(tmp_path / "t.csv").remarks == [
        "1 row left out for an earlier one with another place of the same id at the same time (duplicates='first', "
        "'last', 'mean' or 'refuse')"]
    (tmp_path / "f.txt").write_text("# frame id x y\n0 1 0 0\n", encoding="utf-8")
    assert "times are numbers of frames, since the file has no rate of them and fps gives none" in Tracks.read(
        tmp_path / "f.txt").remarks
