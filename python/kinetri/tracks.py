# SPDX-License-Identifier: GPL-3.0-or-later
"""Recorded tracks: things that appear, move from observation to observation, and leave."""
from __future__ import annotations

import datetime
import math
import re
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _arrays, _kinetri
from ._moving import Simulation
from ._response import engine_response
from ._track_answers import TrackAnswers
from ._types import ArrayLike, Collisions, Events, Floats, Path, Progress
from .errors import InputError, PreconditionError

if TYPE_CHECKING:
    import pandas as pd


class Tracks(TrackAnswers):
    """Observations of things at times: where each was, and when.

    Between two observations a thing moves along a straight line with constant velocity. After a gap
    longer than `max_gap` it leaves, and comes again at its next observation. Each such stay is one point
    of the simulation, and `stays` says whose.

    Use `from_dataframe`, `from_arrays` or `read` to make one.

    Methods that answer a question about the whole time, such as `encounters`, run a `simulation` from
    `start` to `until`, with discs of `radius` where they have that, and show `progress` as
    `Simulation.advance_to` does. They give the table of the method of the same name of `Simulation`, with
    labels for ids. Where times are dates, there is a column of dates for each column of times: `date`,
    `begin_date` and so on.

    Attributes
    ----------
    labels : list
        The names of the things, in the order in which they first appear.
    origin : numpy.datetime64 or None
        The time 0, where times are dates: times are seconds since then.
    frame_rate : float or None
        Of a file whose times are numbers of frames: by which they were divided.
    walkable_area : str or None
        As Well-Known Text, of a file that has it, as JuPedSim's have: what `areas` and `mean_areas` take
        if nothing else is given.
    remarks : list of str
        How a file was read: units, rates, what was left out.
    """

    frame_rate: float | None = None
    remarks: list[str]

    def __init__(self, times: Floats, places: Floats, offsets: npt.NDArray[np.uint64], labels: list[Any],
                 radii: Floats | None, max_gap: float | None, origin: np.datetime64 | None) -> None:
        self._times = times
        self._places = places
        self._offsets = offsets
        self.labels = labels
        self._radii = radii
        self._max_gap = math.inf if max_gap is None else _arrays.one_number("max_gap", max_gap)
        if self._max_gap <= 0:
            raise PreconditionError(f"max_gap is {max_gap}; expected a time greater than 0")
        self.origin = origin
        self.remarks = []

    @classmethod
    def from_arrays(cls, t: ArrayLike, id: ArrayLike, x: ArrayLike, y: ArrayLike, *,
                    radius: ArrayLike | None = None, max_gap: float | None = None) -> Tracks:
        """Tracks of columns, one row for each observation, in any order.

        Parameters
        ----------
        t : array_like, shape (n,)
            Times: numbers; dates, as `datetime64`, `datetime.datetime` or `pandas.Timestamp`, which become
            seconds since the first one, those with an offset in UTC; or durations, which become seconds.
        id : array_like, shape (n,)
            What was observed: numbers or texts.
        x, y : array_like of float, shape (n,)
            Where it was.
        radius : array_like of float, shape (n,), optional
            Of the thing: the same in all of its rows.
        max_gap : float, optional
            The longest time between two observations in which a thing is there, in the unit of the
            times, or in seconds if these are dates.

        Returns
        -------
        Tracks

        Raises
        ------
        PreconditionError
            If a column has another length or a number is not finite.
        InputError
            If a thing is at two places at one time, or has two radii. Rows that repeat another one are
            left out.

        Examples
        --------
        >>> import kinetri
        >>> tracks = kinetri.Tracks.from_arrays([0, 1, 0, 1], ["a", "a", "b", "b"], [0, 1, 5, 4], [0, 0, 0, 0])
        >>> tracks
        <Tracks of 2 things, 4 observations, t = 0 to 1>
        """
        t, origin = _seconds(t)
        size = len(t)
        x = _arrays.float_array("x", x, (size,))
        y = _arrays.float_array("y", y, (size,))
        names = np.asarray(id)
        if names.shape != (size,):
            raise PreconditionError(f"id has the shape {names.shape}; expected ({size},)")
        labels, thing = _things(names, t)
        order = np.lexsort((t, thing))
        thing, times = thing[order], t[order]
        places = np.column_stack((x[order], y[order])) if size > 0 else np.empty((0, 2))
        sizes = None if radius is None else _arrays.column("radius", radius, size)[order]
        keep = np.ones(size, dtype=bool)
        same = (thing[1:] == thing[:-1]) & (times[1:] == times[:-1])
        differ = same & np.any(places[1:] != places[:-1], axis=1)
        if np.any(differ):
            i = int(np.argmax(differ))
            raise InputError(
                f"rows {order[i]} and {order[i + 1]}: {labels[thing[i]]!r} is at two places at "
                f"t = {times[i]}; expected one observation of a thing at a time")
        keep[1:] = ~same
        radii = None
        if sizes is not None:
            change = (thing[1:] == thing[:-1]) & (sizes[1:] != sizes[:-1])
            if np.any(change):
                i = int(np.argmax(change))
                raise InputError(
                    f"rows {order[i]} and {order[i + 1]}: {labels[thing[i]]!r} has the radii {sizes[i]} "
                    f"and {sizes[i + 1]}; expected one radius of a thing")
            if np.any(sizes < 0):
                i = int(np.argmax(sizes < 0))
                raise InputError(f"row {order[i]}: the radius is {sizes[i]}; expected at least 0")
            radii = sizes[np.searchsorted(thing, np.arange(len(labels)))]
        thing, times, places = thing[keep], times[keep], np.ascontiguousarray(places[keep])
        offsets = np.searchsorted(thing, np.arange(len(labels) + 1)).astype(np.uint64)
        return cls(times, places, offsets, labels, radii, max_gap, origin)

    @classmethod
    def from_dataframe(cls, df: pd.DataFrame, *, t: str = "t", id: str = "id", x: str = "x", y: str = "y",
                       radius: str | None = None, max_gap: float | None = None) -> Tracks:
        """Tracks of a table, one row for each observation, in any order.

        Parameters
        ----------
        df : pandas.DataFrame
            The table.
        t, id, x, y : str
            The columns, as in `from_arrays`.
        radius : str, optional
            The column of the radii.
        max_gap : float, optional
            As in `from_arrays`.

        Returns
        -------
        Tracks

        Raises
        ------
        PreconditionError
            If there is no such column; and as `from_arrays`.
        """
        if not hasattr(df, "columns"):
            raise PreconditionError(
                f"df is a {type(df).__name__}; expected a pandas.DataFrame, as pandas.DataFrame(df) makes of a "
                "dict of columns, or Tracks.from_arrays(t, id, x, y)")
        names = {"t": t, "id": id, "x": x, "y": y}
        if radius is not None:
            names["radius"] = radius
        columns = list(df.columns)
        for parameter, name in names.items():
            if columns.count(name) > 1:
                raise PreconditionError(
                    f"df has {columns.count(name)} columns {name!r}; expected one that is {parameter}, as in "
                    "df.loc[:, ~df.columns.duplicated()]")
            if name not in columns:
                raise PreconditionError(
                    f"{parameter} is {name!r}; expected one of the columns "
                    + ", ".join(repr(column) for column in columns))
        times = df[t]
        if getattr(times.dtype, "tz", None) is not None:
            times = times.dt.tz_convert("UTC").dt.tz_localize(None)
        return cls.from_arrays(_values(times), _values(df[id]), _values(df[x]), _values(df[y]),
                               radius=None if radius is None else _values(df[radius]), max_gap=max_gap)

    @classmethod
    def read(cls, path: Path, *, format: str = "auto", fps: float | None = None,
             columns: Mapping[str, str] | None = None, projection: str | None = None,
             date_format: str | None = None, duplicates: str | None = None, unwrap: str | None = None,
             max_gap: float | None = None) -> Tracks:
        """Tracks of a file, in the formats that the program reads.

        Parameters
        ----------
        path : str or path
            The file.
        format : str
            One of `auto` (what the content shows), `rows` (CSV with the columns t, id, x, y, and perhaps
            radius), `frames` (frame id x y), `ids` (id frame x y), `table` (see `columns`), `jupedsim`
            (SQLite), `sumo` (XML), `lammps`, `xyz`, `geojson`, `gpx` and `trackmate` (XML).
        fps : float, optional
            Frames per unit of time, where times are numbers of frames; by default the rate that the file
            gives, or 1.
        columns : dict, optional
            Which columns of a table with a header are `t`, `id`, `x`, `y` and perhaps `radius`, as in
            ``{"t": "time", "id": "name", "x": "E", "y": "N"}``; in a table without one, their numbers from
            1 on, as texts; in GeoJSON, which properties are `t` and `id`.
        projection : str, optional
            What becomes of degrees: `none` takes them as they are; `local` makes them metres about the
            middle of the data, `utm` those of a zone of UTM, and both are refused where distances can be
            off by more than 0.1 %. Without one, files with degrees are refused.
        date_format : str, optional
            The form of dates that are not ISO 8601, such as ``"%d/%m/%Y %H:%M:%S"``.
        duplicates : str, optional
            What is taken of several places of an id at one time: `first`, `last` or `mean`; or `refuse`.
            By default the first, but a file is refused where half of the times of an id or more have
            several.
        unwrap : str, optional
            `nearest` lets atoms that leave a periodic box go on to the nearest image of their next place.
        max_gap : float, optional
            As in `from_arrays`.

        Returns
        -------
        Tracks
            Dates in the file become seconds since `origin`.

        Raises
        ------
        InputError
            The message names file and line.
        PreconditionError
            If a format, column or projection is unknown, or `fps` is given for a file that has times.
        """
        file = _kinetri.read_tracks(str(path), format, None if fps is None else _arrays.one_number("fps", fps),
                                    dict(columns or {}), projection or "refused", date_format or "",
                                    duplicates or "automatic", unwrap or "refused")
        if fps is not None and file["frame_rate"] is None:
            raise PreconditionError(f"fps is {fps}, and {path} has times, not frames; expected no fps")
        # In nanoseconds, as the dates that come of it.
        date = re.sub(r"(\.\d{9})\d+", r"\1", file["origin"].removesuffix("Z"))
        tracks = cls(file["times"], file["places"], file["offsets"], file["ids"], file["radii"], max_gap,
                     np.datetime64(date) if date else None)
        tracks.frame_rate = file["frame_rate"]
        tracks.walkable_area = file["walkable_area"] or None
        tracks.remarks = file["remarks"]
        return tracks

    @property
    def start(self) -> float:
        """float: the time of the first observation; NaN if there is none."""
        return float(self._times.min()) if len(self._times) > 0 else math.nan

    @property
    def end(self) -> float:
        """float: the time of the last observation; NaN if there is none."""
        return float(self._times.max()) if len(self._times) > 0 else math.nan

    def __len__(self) -> int:
        """The number of things."""
        return len(self.labels)

    def __repr__(self) -> str:
        return (f"<Tracks of {len(self)} things, {len(self._times)} observations, "
                f"t = {self.start:g} to {self.end:g}>")

    def simulation(self, *, start: float | None = None, until: float | None = None,
                   box: ArrayLike | None = None, radius: float | None = None, rim: bool = False,
                   collisions: Collisions = None) -> TracksSimulation:
        """The things as moving points: a simulation in which each appears, turns and leaves.

        Parameters
        ----------
        start, until : float, optional
            Everything before and after is left out; by default the first and the last observation.
        box, rim, collisions
            As in `Simulation`.
        radius : float, optional
            Of all things, if the tracks have no radii.

        Returns
        -------
        TracksSimulation
            At the time `start`. Its `stays` says which thing each point is.

        Raises
        ------
        CoincidentTrajectoriesError
            By the call that advances time, if two things have the same trajectory for a while.
        """
        start = self.start if start is None else _arrays.one_number("start", start)
        until = self.end if until is None else _arrays.one_number("until", until)
        if math.isnan(start):
            start = until = 0.0
        if radius is not None and self._radii is not None:
            raise PreconditionError("radius is given, and the tracks have radii; expected one of the two")
        engine, stays = _kinetri.make_tracks(
            self._times, self._places, self._offsets, self._radii, start, until, self._max_gap,
            _arrays.box_tuple("box", box), bool(rim),
            0.0 if radius is None else _arrays.one_number("radius", radius), engine_response(collisions))
        return TracksSimulation._around(engine, collisions=collisions, tracks=self, end=until,
                                        stays=stays)

    def record(self, *, start: float | None = None, until: float | None = None,
               kinds: str | Iterable[str] | None = None, progress: Progress = False) -> Events:
        """The events of the whole time.

        Parameters
        ----------
        start, until : float, optional
            As in `simulation`.
        kinds : str or iterable of str, optional
            As in `Simulation.record`.
        progress : bool or callable
            As in `Simulation.advance_to`.

        Returns
        -------
        structured array of `event_dtype`
            The points are stays; see `TracksSimulation.label`.
        """
        simulation = self.simulation(start=start, until=until)
        return simulation.record(simulation.end, kinds=kinds, progress=progress)

    def dates(self, times: ArrayLike) -> npt.NDArray[np.datetime64]:
        """Times as dates.

        Parameters
        ----------
        times : array_like of float
            Seconds since `origin`.

        Returns
        -------
        array of datetime64[ns]
            Rounded to nanoseconds.

        Raises
        ------
        PreconditionError
            If the times of the tracks are no dates.
        """
        if self.origin is None:
            raise PreconditionError("the times of these tracks are numbers; expected tracks with dates")
        nanoseconds = np.rint(np.asarray(times, dtype=np.float64) * 1e9).astype("timedelta64[ns]")
        dates: npt.NDArray[np.datetime64] = self.origin.astype("datetime64[ns]") + nanoseconds
        return dates


class TracksSimulation(Simulation):
    """The simulation of tracks, which `Tracks.simulation` makes.

    Attributes
    ----------
    tracks : Tracks
        What it was made of.
    stays : array of uint64, shape (n, 3)
        By id: the thing (its place in `tracks.labels`), and its first and last observation in the stay.
    end : float
        The time of the end.
    """

    tracks: Tracks
    stays: npt.NDArray[np.uint64]
    end: float

    def label(self, id: int) -> Any:
        """The name of the thing that a point is.

        Parameters
        ----------
        id : int
            The point.

        Returns
        -------
        object
            One of `tracks.labels`.
        """
        id = _arrays.one_id("id", id)
        if id >= len(self.stays):
            raise PreconditionError(f"there is no point {id}; expected one of the {len(self.stays)} stays")
        return self.tracks.labels[self.stays[id, 0]]


def _values(column: Any) -> Any:
    """A column of pandas as an array: nullable numbers too, with NaN where there is none."""
    if getattr(column.dtype, "numpy_dtype", None) is None:
        return column.to_numpy()
    if column.isna().any():
        return column.to_numpy(dtype=np.float64, na_value=np.nan)
    return column.to_numpy(dtype=column.dtype.numpy_dtype)


def _seconds(t: ArrayLike) -> tuple[Floats, np.datetime64 | None]:
    """Times as numbers; and the date of 0, where they are dates."""
    array = np.asarray(t)
    if array.dtype.kind == "O":
        array = _times_of_objects(array)
    if array.dtype.kind in "US":
        example = array.flat[0] if array.size > 0 else ""
        raise PreconditionError(
            f"t has texts, such as {str(example)!r}; expected numbers, or dates, as "
            "pandas.to_datetime(t, utc=True) makes of texts in ISO 8601")
    if array.dtype.kind not in "mM":
        return _arrays.float_array("t", array, (None,)), None
    if np.any(np.isnat(array)):
        raise PreconditionError(f"t[{int(np.argmax(np.isnat(array)))}] is not a time; expected dates or durations")
    if np.datetime_data(array.dtype)[0] in "YM":  # which have no length
        if array.dtype.kind == "m":
            raise PreconditionError(f"t is an array of {array.dtype}, which have no length; expected seconds")
        array = array.astype("datetime64[s]")
    origin = array.min() if array.dtype.kind == "M" and array.size > 0 else None
    durations = array if array.dtype.kind == "m" else array - origin if origin is not None else array[:0] - array[:0]
    return _arrays.float_array("t", durations / np.timedelta64(1, "s"), (None,)), origin


# The dtype of an array of them.
_TYPES_OF_TIMES: dict[str, tuple[type, ...]] = {
    "M8": (datetime.date, np.datetime64), "m8": (datetime.timedelta, np.timedelta64), "U": (str,)}


def _times_of_objects(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Objects of Python and pandas that are dates, in UTC, or durations; other objects as they are."""
    values = array.ravel().tolist()
    kinds = [next((dtype for dtype, types in _TYPES_OF_TIMES.items() if isinstance(value, types)), "")
             for value in values]
    if not any(kinds):
        return array
    if len(set(kinds)) > 1:
        i = next(i for i, kind in enumerate(kinds) if kind != kinds[0])
        raise PreconditionError(f"t[0] is {values[0]!r}, and t[{i}] {values[i]!r}; expected times of one kind, all "
                                "numbers, dates or durations")
    offsets = [getattr(value, "tzinfo", None) is not None for value in values]
    if any(offsets) and not all(offsets):
        i = offsets.index(not offsets[0])
        raise PreconditionError(
            f"t[0] is a date {'with' if offsets[0] else 'without'} an offset, and t[{i}] one "
            f"{'without' if offsets[0] else 'with'}; expected dates of one kind: all with an offset, such as UTC, or "
            "none")
    if any(offsets):
        values = [value.astimezone(datetime.timezone.utc).replace(tzinfo=None) for value in values]
    # Those of pandas have nanoseconds, which numpy does not take by itself.
    return np.asarray([value.to_numpy() if hasattr(value, "to_numpy") else value for value in values],
                      dtype=kinds[0]).reshape(array.shape)


def _is_missing(name: Any) -> bool:
    try:
        return name is None or bool(name != name)
    except TypeError:  # pandas.NA
        return True


def _things(names: npt.NDArray[Any], times: Floats) -> tuple[list[Any], npt.NDArray[np.int64]]:
    """The distinct names in the order of their first observation, and the index of each row's."""
    if names.dtype.kind in "fOmM":
        for i, name in enumerate(names):
            if _is_missing(name):
                raise PreconditionError(f"id[{i}] is {name}; expected a number or a text")
    try:
        distinct, thing = np.unique(names, return_inverse=True)
    except TypeError:
        raise PreconditionError("id has numbers and texts; expected one kind of name") from None
    first = np.full(len(distinct), np.inf)
    np.minimum.at(first, thing, times)
    order = np.lexsort((np.arange(len(distinct)), first))
    rank = np.empty(len(distinct), dtype=np.int64)
    rank[order] = np.arange(len(distinct))
    return [name.item() if hasattr(name, "item") else name for name in distinct[order]], rank[thing]
