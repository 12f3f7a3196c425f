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


def table_of(kinds: str | Iterable[str] | None) -> _kinetri.EventTable:
    """A table that stores the events of these kinds; by default all."""
    if kinds is None:
        return _kinetri.EventTable([True] * len(event_kinds))
    expected = "one or more of " + ", ".join(map(repr, event_kinds))
    try:
        named = [kinds] if isinstance(kinds, str) else list(kinds)
    except TypeError:
        raise PreconditionError(f"kinds is {kinds!r}; expected {expected}") from None
    for kind in named:
        if kind not in event_kinds:
            raise PreconditionError(f"kinds has {kind!r}, which is not a kind of event; expected {expected}")
    return _kinetri.EventTable([kind in named for kind in event_kinds])


def take(table: _kinetri.EventTable) -> Events:
    """The rows of an EventTable, without a copy. The table is empty then."""
    return table.take(event_dtype)


def to_dataframe(events: Events) -> pd.DataFrame:
    """A table with a column for each number of the events.

    Parameters
    ----------
    events : array of `event_dtype`
        As `record` gives them.

    Returns
    -------
    pandas.DataFrame
        The columns of the program's event log but event and instant: kind, time, time_lo, time_hi,
        removed_a, removed_b, added_a, added_b, point_a, point_b. Ids are of the type UInt32, with <NA> where
        there is none.

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
    return pd.DataFrame(columns)
