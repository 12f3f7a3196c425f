# SPDX-License-Identifier: GPL-3.0-or-later
"""Events as structured arrays, and as tables of pandas."""
from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from . import _kinetri
from ._arrays import NO_POINT
from ._types import Events
from .errors import PreconditionError

if TYPE_CHECKING:
    import pandas as pd

#: The kinds of event, in the order in which simultaneous ones are executed.
event_kinds = _kinetri.event_kinds

#: The color of each kind, as ``#rrggbb``: that of the viewer's page and of the program's plots.
event_colors = _kinetri.event_colors

#: The fields of an array of events.
#:
#: kind : str
#:     One of `event_kinds`.
#: time, time_lo, time_hi : float64
#:     The exact time rounded to nearest, and its tightest bounds.
#: removed, added : two uint32
#:     The ids of the ends of the removed edge, and of the added one, the smaller first; `NO_POINT` twice if
#:     there is none.
#: points : two uint32
#:     The points concerned: the second, or both, may be `NO_POINT`. Of `hide` and `reveal` of a point that
#:     coincides with another for a while, the second is that other, which hides, or hid, the first.
event_dtype: np.dtype[np.void] = np.dtype(_kinetri.event_fields)

#: The fields of an array of events in a periodic box: those of `event_dtype`, and two more.
#:
#: removed_offset, added_offset : two int32
#:     Which image of the second end of the removed edge, and of the added one, is meant: how often each lattice
#:     vector is added to it; 0 if there is no edge. Of a collision `added_offset` is that of the image of the second
#:     point which the first one touches.
periodic_event_dtype: np.dtype[np.void] = np.dtype(_kinetri.periodic_event_fields)


def table_of(kinds: str | Iterable[str] | None, is_periodic: bool) -> _kinetri.EventTable | _kinetri.PeriodicEventTable:
    """A table that stores the events of these kinds, by default all, with offsets if there is a periodic box."""
    if kinds is None:
        return _empty_table([True] * len(event_kinds), is_periodic)
    expected = "one or more of " + ", ".join(map(repr, event_kinds))
    try:
        named = [kinds] if isinstance(kinds, str) else list(kinds)
    except TypeError:
        raise PreconditionError(f"kinds is {kinds!r}; expected {expected}") from None
    for kind in named:
        if kind not in event_kinds:
            raise PreconditionError(f"kinds has {kind!r}, which is not a kind of event; expected {expected}")
    return _empty_table([kind in named for kind in event_kinds], is_periodic)


def _empty_table(kept: list[bool], is_periodic: bool) -> _kinetri.EventTable | _kinetri.PeriodicEventTable:
    return _kinetri.PeriodicEventTable(kept) if is_periodic else _kinetri.EventTable(kept)


def take(table: _kinetri.EventTable | _kinetri.PeriodicEventTable) -> Events:
    """The rows of a table, without a copy. The table is empty then."""
    return table.take(periodic_event_dtype if isinstance(table, _kinetri.PeriodicEventTable) else event_dtype)


def to_dataframe(events: Events) -> pd.DataFrame:
    """A table with a column for each number of the events.

    Parameters
    ----------
    events : array of `event_dtype` or `periodic_event_dtype`
        As `record` gives them.

    Returns
    -------
    pandas.DataFrame
        The columns of the program's event log but event and instant: kind, time, time_lo, time_hi,
        removed_a, removed_b, added_a, added_b, point_a, point_b. Ids are of the type UInt32, with <NA> where
        there is none. In a periodic box also removed_k, removed_l, added_k, added_l of the type Int32: the offsets.

    Examples
    --------
    >>> import kinetri
    >>> kd = kinetri.KineticDelaunay([[0, 0], [2, 0], [1, 2], [1, -3]], [[0, 0], [0, 0], [0, 0], [0, 1]])
    >>> kinetri.to_dataframe(kd.record(until=2.75))[["kind", "time", "removed_a", "removed_b"]]
       kind  time  removed_a  removed_b
    0  flip   2.5          0          1
    """
    import pandas as pd

    columns = {name: events[name] for name in ("kind", "time", "time_lo", "time_hi")}
    for field, names in (("removed", ("removed_a", "removed_b")), ("added", ("added_a", "added_b")),
                         ("points", ("point_a", "point_b"))):
        for i, name in enumerate(names):
            ids = events[field][:, i]
            columns[name] = pd.arrays.IntegerArray(ids.copy(), ids == NO_POINT)
    if events.dtype == periodic_event_dtype:
        for edge in ("removed", "added"):
            has_none = events[edge][:, 0] == NO_POINT
            if edge == "added":
                has_none &= events["kind"] != "collision"
            for i, name in enumerate("kl"):
                columns[f"{edge}_{name}"] = pd.arrays.IntegerArray(events[f"{edge}_offset"][:, i].copy(), has_none.copy())
    return pd.DataFrame(columns)
