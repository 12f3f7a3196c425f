# SPDX-License-Identifier: GPL-3.0-or-later
"""Recorded tracks: things that appear, move from observation to observation, and leave."""
from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _arrays, _coincidence, _columns, _kinetri, _tables
from ._moving import Simulation
from ._response import Collisions, engine_response
from ._track_answers import TrackAnswers
from ._kinetri import Time
from ._types import ArrayLike, Events, Floats, Path, Progress, TimeLike
from .errors import CoincidentTrajectoriesError, InputError, PreconditionError

if TYPE_CHECKING:
    import pandas as pd

    from ._tables import SupportsToPandas


class Tracks(TrackAnswers):
    """Observed positions of things at times.

    Between two observations a thing moves along a straight line with constant velocity. In a gap longer than
    `max_gap` it is absent. Each stay between such gaps is one point of the simulation; `stays` maps points to
    things.

    Use `from_dataframe`, `from_arrays` or `read` to make one.

    Methods such as `encounters` run a `simulation` from `start` to `until`, with discs of `radius` if they have
    that parameter, and show `progress` as `Simulation.advance_to` does. They return the table of the method of
    the same name of `Simulation`, with labels for ids. If times are dates, there is a column of dates for each
    column of times: `date`, `begin_date` and so on.

    Attributes
    ----------
    labels : list
        The names of the things, in the order in which they first appear.
    origin : numpy.datetime64 or None
        The date of time 0 if times are dates; times are seconds since then.
    frame_rate : float or None
        The rate by which frame numbers of a file were divided to get times.
    walkable_area : str or None
        The walkable area in a file, such as JuPedSim's, as Well-Known Text: the default for `areas` and `mean_areas`.
    remarks : list of str
        How a file or table was read: units, rates, degrees, what was left out.
    """

    frame_rate: float | None = None
    remarks: list[str]

    def __init__(self, times: Floats, places: Floats, offsets: npt.NDArray[np.uint64], labels: list[Any],
                 radii: Floats | None, max_gap: float | None, origin: np.datetime64 | None,
                 coincident: str = "hide") -> None:
        self._times = times
        self._places = places
        self._offsets = offsets
        self.labels = labels
        self._radii = radii
        self._max_gap = math.inf if max_gap is None else _arrays.one_number("max_gap", max_gap)
        if self._max_gap <= 0:
            raise PreconditionError(f"max_gap is {max_gap}; expected a time greater than 0")
        self.origin = origin
        self._refuses_coincident = _coincidence.are_refused(coincident)
        self.remarks = []

    @classmethod
    def from_arrays(cls, t: ArrayLike, id: ArrayLike, x: ArrayLike, y: ArrayLike, *,
                    radius: ArrayLike | None = None, max_gap: float | None = None,
                    projection: str | None = None, duplicates: str | None = None,
                    coincident: str = "hide") -> Tracks:
        """Tracks of columns, one row for each observation, in any order.

        Parameters
        ----------
        t : array_like, shape (n,)
            Times: numbers; dates, as `datetime64`, `datetime.datetime` or `pandas.Timestamp`, which become
            seconds since the first one, those with an offset in UTC; or durations, which become seconds.
        id : array_like, shape (n,)
            The names of things: numbers or texts.
        x, y : array_like of float, shape (n,)
            The positions: x to the right, y up; in degrees, longitude and latitude.
        radius : array_like of float, shape (n,), optional
            The radius of the thing, the same in all of its rows.
        max_gap : float, optional
            The longest gap between two observations during which a thing exists, in the unit of the times, or
            in seconds if these are dates.
        projection : str, optional
            How degrees of longitude and latitude are converted: `none` takes them as they are; `local` converts
            to meters about the middle of the data, `utm` to meters in a zone of UTM. By default degrees are
            refused. Positions are degrees if the attribute `name` of x or y says so, as that of a
            `pandas.Series` may: `lon`, `location-lat`, `decimalLongitude`, `x (deg)`. Without such names,
            positions that look like degrees are refused: within 180 and 90, with four decimals, and hardly
            moving, if times are dates or seconds since 1970.
        duplicates : str, optional
            Which of several positions of an id at one time is used: `first`, `last` or `mean`; or `refuse`. By
            default the first, but rows are refused if half of the times of an id or more have several.
        coincident : {'hide', 'refuse'}
            What happens to things that coincide for some time, such as a rider and the bus: of their points the one
            with the least id hides the others meanwhile (see `MovingPoints`), or advancing to that time is an error.

        Returns
        -------
        Tracks
            Its `remarks` tell how degrees were treated, and the error of distances. Rows whose x and y are NaN
            are left out; in degrees also rows at the longitude 181 or the latitude 91, which mean an unknown
            position in AIS, and those at (0, 0) if all others are farther than a degree from there.

        Raises
        ------
        PreconditionError
            If a column has another length, a number is not finite, or a word is unknown.
        InputError
            If a thing is at two positions at one time, or has two radii (repeated rows are left out). If
            positions are degrees, or look like them, and there is no projection; if names say radians, or x is
            the latitude; if degrees are out of range; or if distances in the projection can be off by more than
            0.1 %.

        Examples
        --------
        >>> import kinetri
        >>> tracks = kinetri.Tracks.from_arrays([0, 1, 0, 1], ["a", "a", "b", "b"], [0, 1, 5, 4], [0, 0, 0, 0])
        >>> tracks
        <Tracks of 2 things, 4 observations, t = 0 to 1>
        >>> ships = kinetri.Tracks.from_arrays([0, 60], ["a", "a"], [12.0, 12.01], [55.0, 55.0], projection="utm")
        >>> ships.remarks
        ['places are in meters of UTM, zone 33 north (EPSG:32633); distances are off by at most 0.0052 %']
        """
        return cls._of_columns(t, id, x, y, radius, max_gap, projection, duplicates, coincident, "Tracks.from_arrays",
                               getattr(x, "name", None), getattr(y, "name", None))

    @classmethod
    def _of_columns(cls, t: ArrayLike, id: ArrayLike, x: ArrayLike, y: ArrayLike, radius: ArrayLike | None,
                    max_gap: float | None, projection: str | None, duplicates: str | None, coincident: str,
                    caller: str, x_name: Any, y_name: Any) -> Tracks:
        """As `from_arrays`, for `caller`, with the names of the columns, which may be None."""
        _coincidence.are_refused(coincident)
        t, origin = _columns.seconds_of(t)
        size = len(t)
        x, y, seen = _columns.seen_places(x, y, size)
        _arrays.expect_no_mask("id", id)
        names = np.asarray(id)
        if names.shape != (size,):
            raise PreconditionError(f"id has the shape {names.shape}; expected ({size},)")
        if radius is not None:
            radius = _arrays.column("radius", radius, size)[seen]
        without_place = size - len(seen)
        t, names, size = t[seen], names[seen], len(seen)
        labels, thing = _columns.things_of(names, t)
        order = np.lexsort((t, thing))
        rows = seen[order]
        thing, times = thing[order], t[order]
        places = np.column_stack((x[order], y[order])) if size > 0 else np.empty((0, 2))
        sizes = None if radius is None else np.asarray(radius)[order]
        keep, others = _columns.merged_places(thing, times, places, rows, labels, duplicates)
        radii = None
        if sizes is not None:
            change = (thing[1:] == thing[:-1]) & (sizes[1:] != sizes[:-1])
            if np.any(change):
                i = int(np.argmax(change))
                raise InputError(
                    f"rows {rows[i]} and {rows[i + 1]}: {labels[thing[i]]!r} has the radii {sizes[i]} "
                    f"and {sizes[i + 1]}; expected one radius of a thing")
            if np.any(sizes < 0):
                i = int(np.argmax(sizes < 0))
                raise InputError(f"row {rows[i]}: the radius is {sizes[i]}; expected at least 0")
            radii = sizes[np.searchsorted(thing, np.arange(len(labels)))]
        thing, times, places = thing[keep], times[keep], np.ascontiguousarray(places[keep])
        offsets = np.searchsorted(thing, np.arange(len(labels) + 1)).astype(np.uint64)
        x_name, y_name = ("" if name is None else str(name) for name in (x_name, y_name))
        file = _kinetri.project_tracks(
            times, places, offsets, (rows[keep] + 1).astype(np.uint64), "" if origin is None else str(origin), caller,
            x_name, y_name, _projection_word(projection), duplicates or "automatic", others)
        kept = [int(thing) for thing in file["ids"]]
        tracks = cls(file["times"], file["places"], file["offsets"], [labels[thing] for thing in kept],
                     None if radii is None else radii[kept], max_gap, origin, coincident)
        tracks.remarks = file["remarks"]
        if without_place > 0:
            tracks.remarks.append(f"{without_place} row{'' if without_place == 1 else 's'} left out, having NaN as place")
        return tracks

    @classmethod
    def from_dataframe(cls, df: pd.DataFrame | SupportsToPandas, *, t: str = "t", id: str = "id", x: str = "x",
                       y: str = "y", radius: str | None = None, max_gap: float | None = None,
                       projection: str | None = None, duplicates: str | None = None,
                       coincident: str = "hide") -> Tracks:
        """Tracks of a table, one row for each observation, in any order.

        Parameters
        ----------
        df : pandas.DataFrame, or an object with a method `to_pandas`, such as a pyarrow.Table
            The table.
        t, id, x, y : str
            The columns, as in `from_arrays`.
        radius : str, optional
            The column of the radii.
        max_gap : float, optional
            As in `from_arrays`.
        projection : str, optional
            As in `from_arrays`; the names of the columns x and y say whether positions are degrees.
        duplicates, coincident
            As in `from_arrays`.

        Returns
        -------
        Tracks
            Its `remarks` name the columns that are not used. There is a warning if one of these is a third
            coordinate, such as `z`, and varies.

        Raises
        ------
        PreconditionError
            If there is no such column, or pandas is needed and not installed; and as in `from_arrays`.
        InputError
            As in `from_arrays`.
        """
        df = _tables.frame_of(df)
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
        unused = [name for name in columns if name not in names.values()]
        _tables.warn_of_third_coordinates(df, unused, stacklevel=2)
        tracks = cls._of_columns(
            _columns.values_of(times), _columns.values_of(df[id]), _columns.values_of(df[x]), _columns.values_of(df[y]),
            None if radius is None else _columns.values_of(df[radius]), max_gap, projection, duplicates, coincident,
            "Tracks.from_dataframe", x, y)
        remark = _tables.remark_on(unused)
        tracks.remarks += [] if remark is None else [remark]
        return tracks

    @classmethod
    def read(cls, path: Path, *, format: str = "auto", fps: float | None = None,
             columns: Mapping[str, str] | None = None, projection: str | None = None,
             date_format: str | None = None, duplicates: str | None = None, unwrap: str | None = None,
             coincident: str = "hide", max_gap: float | None = None) -> Tracks:
        """Tracks of a file, in the formats that the program reads, or of Parquet, Feather or Arrow.

        Parquet, Feather and Arrow files (the last two with the same content) are read as the table that pandas
        exports from them as CSV is, if pandas and pyarrow are installed.

        Parameters
        ----------
        path : str or path
            The file.
        format : str
            One of `auto` (what the content shows), `rows` (CSV with the columns t, id, x, y, and perhaps
            radius), `frames` (frame id x y), `ids` (id frame x y), `table` (see `columns`), `jupedsim`
            (SQLite), `sumo` (XML), `lammps`, `xyz`, `geojson`, `gpx` and `trackmate` (XML).
        fps : float, optional
            Frames per unit of time, if times are numbers of frames; by default the rate in the file, or 1.
        columns : dict, optional
            Which columns of a table with a header are `t`, `id`, `x`, `y` and optionally `radius`, as in
            ``{"t": "time", "id": "name", "x": "E", "y": "N"}``; in a table without one, their numbers from
            1 on, as texts; in GeoJSON, which properties are `t` and `id`. Plus signs join several columns of a
            time, as in ``{"t": "date+time", ...}``.
        projection : str, optional
            How degrees are converted: `none` takes them as they are; `local` converts to meters about the
            middle of the data, `utm` to meters in a zone of UTM; both are refused if distances can be off by
            more than 0.1 %. By default files with degrees are refused.
        date_format : str, optional
            The form of dates that are not ISO 8601, such as ``"%d/%m/%Y %H:%M:%S"``; or of times of day, such as
            ``"%H:%M:%S"``, which become seconds since midnight, if they are of one day.
        duplicates : str, optional
            Which of several positions of an id at one time is used: `first`, `last` or `mean`; or `refuse`. By
            default the first, but a file is refused if half of the times of an id or more have several.
        unwrap : str, optional
            `nearest` lets atoms that leave a periodic box move to the nearest image of their next position.
        coincident : {'hide', 'refuse'}
            As in `from_arrays`.
        max_gap : float, optional
            As in `from_arrays`.

        Returns
        -------
        Tracks
            Dates in the file become seconds since `origin`.

        Raises
        ------
        InputError
            If the file cannot be used; the message names file and line (for Parquet, Feather and Arrow, of the
            CSV). If pandas or pyarrow is needed and not installed.
        PreconditionError
            If a format, column or word is unknown, or `fps` is given for a file that has times.
        """
        _coincidence.are_refused(coincident)
        name, text, unused = str(path), None, None
        columns = _names_of_columns(columns)
        arrow = _tables.arrow_format(name) if format in ("auto", "table") else None
        if arrow is not None:
            text, columns, unused = _tables.read_as_csv(name, arrow, columns)
            name, format = f"{name} as CSV", "table"
        file = _kinetri.read_tracks(name, text, format, None if fps is None else _arrays.one_number("fps", fps),
                                    columns, _projection_word(projection), date_format or "",
                                    duplicates or "automatic", unwrap or "refused")
        if fps is not None and file["frame_rate"] is None:
            raise PreconditionError(f"fps is {fps}, and {path} has times, not frames; expected no fps")
        # In nanoseconds, as the dates derived from it.
        date = re.sub(r"(\.\d{9})\d+", r"\1", file["origin"].removesuffix("Z"))
        tracks = cls(file["times"], file["places"], file["offsets"], file["ids"], file["radii"], max_gap,
                     np.datetime64(date) if date else None, coincident)
        tracks.frame_rate = file["frame_rate"]
        tracks.walkable_area = file["walkable_area"] or None
        tracks.remarks = file["remarks"] + ([] if unused is None else [unused])
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
        """A simulation of the things as moving points, which are inserted, change motions and are erased.

        Parameters
        ----------
        start, until : float, optional
            The interval of time; by default from the first to the last observation.
        box, rim, collisions
            As in `Simulation`.
        radius : float, optional
            The radius of all things, if the tracks have no radii.

        Returns
        -------
        TracksSimulation
            At the time `start`. Its `stays` says which thing each point is.

        Raises
        ------
        CoincidentTrajectoriesError
            If two things coincide for some time, now or when time advances, and the tracks were made with
            ``coincident="refuse"``. When time advances, the message names such pairs, up to ten.
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
            0.0 if radius is None else _arrays.one_number("radius", radius), engine_response(collisions),
            self._refuses_coincident)
        return TracksSimulation._around(engine, collisions=collisions, tracks=self, _start=start, end=until,
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
            Points are stays; see `TracksSimulation.label`. An exception on the way has the events before
            it as its attribute `events`.
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
            If the times of the tracks are not dates.
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
        The tracks of the simulation.
    stays : array of uint64, shape (n, 3)
        By id: the index of the thing in `tracks.labels`, and its first and last observation in the stay.
    end : float
        The time of the end.
    """

    tracks: Tracks
    stays: npt.NDArray[np.uint64]
    _start: float
    end: float

    def _go(self, until: Time, observer: _kinetri.Observer | None, show: Callable[[float], object] | None) -> int:
        try:
            return super()._go(until, observer, show)
        except CoincidentTrajectoriesError as error:
            raise self._named(error) from None

    def _step(self, until: TimeLike | None, observer: _kinetri.Observer | None) -> int:
        try:
            return super()._step(until, observer)
        except CoincidentTrajectoriesError as error:
            raise self._named(error) from None

    def _named(self, error: CoincidentTrajectoriesError) -> CoincidentTrajectoriesError:
        """The error with labels, unless its points are not stays."""
        if max(error.ids) >= len(self.stays):
            return error
        tracks = self.tracks
        pairs, are_all = _kinetri.shared_paths(tracks._times, tracks._places, tracks._offsets, tracks._radii,
                                                  self._start, self.end, tracks._max_gap)
        return _coincidence.named(error, [self.label(id) for id in range(len(self.stays))], pairs, are_all)

    def label(self, id: int) -> Any:
        """The name of the thing of a point.

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


def _names_of_columns(columns: Mapping[str, str] | None) -> dict[str, str]:
    if columns is None:
        return {}
    if not isinstance(columns, Mapping):
        raise PreconditionError(f"columns is a {type(columns).__name__}; expected a dict, as in {{'t': 'time', ...}}")
    for parameter, name in columns.items():
        if not isinstance(parameter, str) or not isinstance(name, str):
            raise PreconditionError(f"columns has {parameter!r}: {name!r}; expected texts, numbers of columns too, as in "
                                    "{'t': '1', ...}")
    return dict(columns)


def _projection_word(projection: str | None) -> str:
    return "refused" if projection is None else str(projection)
