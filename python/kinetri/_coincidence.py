# SPDX-License-Identifier: GPL-3.0-or-later
"""Things in tracks that coincide for some time: a rider and the bus, or two people on a bench."""
from __future__ import annotations

import math
from typing import Any

from . import _kinetri
from ._types import Floats
from .errors import CoincidentTrajectoriesError, PreconditionError

_MOST_NAMED = 10


def leaves_out(coincident: str | None) -> bool:
    """Whether the parameter `coincident` is 'leave-out'."""
    if coincident not in (None, "refuse", "leave-out"):
        raise PreconditionError(f"coincident is {coincident!r}; expected one of 'refuse', 'leave-out'")
    return coincident == "leave-out"


def kept_things(times: Floats, places: Floats, offsets: Any, radii: Floats | None, max_gap: float,
                labels: list[Any]) -> tuple[list[int], list[str]]:
    """The first thing of each group that coincides, and a remark on the others, if any."""
    first, _, _ = _kinetri.shared_paths(times, places, offsets, radii, -math.inf, math.inf, max_gap)
    kept = [thing for thing in range(len(labels)) if first[thing] == thing]
    others = [thing for thing in range(len(labels)) if first[thing] != thing]
    if not others:
        return kept, []
    named = ", ".join(f"{labels[thing]!r} with {labels[int(first[thing])]!r}" for thing in others[:_MOST_NAMED])
    more = " and others" if len(others) > _MOST_NAMED else ""
    return kept, [f"{len(others)} {'id' if len(others) == 1 else 'ids'} left out, being at one place with another for "
                  f"some time: {named}{more}"]


def named(error: CoincidentTrajectoriesError, labels: list[Any], paths: list[tuple[int, int, float]],
          are_all: bool) -> CoincidentTrajectoriesError:
    """The error with the labels of the points, by id, instead of their ids, and with the other pairs of `paths`."""
    pair = tuple(sorted(error.ids))

    def text(one: int, other: int, time: float) -> str:
        return f"{labels[one]!r} and {labels[other]!r} from t = {repr(time).removesuffix('.0')} on"

    found = [path for path in paths if path[:2] == pair]
    here = text(*found[0]) if found else f"{labels[pair[0]]!r} and {labels[pair[1]]!r}"
    others = [text(*path) for path in paths if path[:2] != pair]
    result = CoincidentTrajectoriesError(
        f"{here} go the same way" + (", and so do " + ", ".join(others) if others else "")
        + ("" if are_all else ", and more pairs")
        + "; expected different positions at one of two observations, or tracks that are made with "
        "coincident='leave-out', which leaves out all but the first of each such group")
    result.ids = error.ids
    return result
