# SPDX-License-Identifier: GPL-3.0-or-later
"""Points that coincide for a while, such as a rider and the bus, or two people on a bench."""
from __future__ import annotations

from typing import Any

from .errors import CoincidentTrajectoriesError, PreconditionError


def are_refused(coincident: str) -> bool:
    """Whether the parameter `coincident` is 'refuse'."""
    if coincident not in ("hide", "refuse"):
        raise PreconditionError(f"coincident is {coincident!r}; expected 'hide' or 'refuse'")
    return coincident == "refuse"


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
        "coincident='hide'")
    result.ids = error.ids
    return result
