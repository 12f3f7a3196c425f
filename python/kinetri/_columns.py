# SPDX-License-Identifier: GPL-3.0-or-later
"""Columns of tables of tracks: times, names of things, columns of pandas."""
from __future__ import annotations

import datetime
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _arrays
from ._types import ArrayLike, Floats
from .errors import InputError, PreconditionError


def values_of(column: Any) -> Any:
    """A column of pandas as an array; missing numbers become NaN."""
    if getattr(column.dtype, "numpy_dtype", None) is None:
        return column.to_numpy()
    if column.isna().any():
        return column.to_numpy(dtype=np.float64, na_value=np.nan)
    return column.to_numpy(dtype=column.dtype.numpy_dtype)


def seconds_of(t: ArrayLike) -> tuple[Floats, np.datetime64 | None]:
    """Times as numbers; and the date of time 0, if they are dates."""
    _arrays.expect_no_mask("t", t)
    array = np.asarray(t)
    if array.dtype.kind == "O":
        array = _times_of_objects(array)
    if array.dtype.kind in "US":
        example = array.flat[0] if array.size > 0 else ""
        raise PreconditionError(
            f"t has texts, such as {str(example)!r}; expected numbers, or dates, as "
            "pandas.to_datetime(t, utc=True) makes of texts in ISO 8601, and of others with format=, such as "
            "'%d/%m/%Y %H:%M'")
    if array.dtype.kind not in "mM":
        numbers = _arrays.float_array("t", array, (None,))
        _expect_no_dates_of_digits(numbers)
        return numbers, None
    if np.any(np.isnat(array)):
        raise PreconditionError(f"t[{int(np.argmax(np.isnat(array)))}] is not a time; expected dates or durations")
    if np.datetime_data(array.dtype)[0] in "YM":  # which have no length
        if array.dtype.kind == "m":
            raise PreconditionError(f"t is an array of {array.dtype}, which have no length; expected seconds")
        array = array.astype("datetime64[s]")
    origin = array.min() if array.dtype.kind == "M" and array.size > 0 else None
    durations = array if array.dtype.kind == "m" else array - origin if origin is not None else array[:0] - array[:0]
    return _arrays.float_array("t", durations / np.timedelta64(1, "s"), (None,)), origin


# Formats of dates that are written as numbers, by the number of digits.
_FORMS_OF_DIGITS = {8: "%Y%m%d", 10: "%Y%m%d%H", 12: "%Y%m%d%H%M", 14: "%Y%m%d%H%M%S"}


def _expect_no_dates_of_digits(numbers: Floats) -> None:
    """Raises an error if all numbers look like dates, such as 20200131, whose differences are not seconds."""
    if len(numbers) == 0 or not np.all((numbers >= 1e7) & (numbers < 1e14) & (numbers == np.floor(numbers))):
        return
    texts = [str(int(number)) for number in np.unique(numbers)]
    form = _FORMS_OF_DIGITS.get(len(texts[0]))
    for text in texts:
        if form is None or len(text) != len(texts[0]) or text[:2] not in ("19", "20"):
            return
        try:
            datetime.datetime.strptime(text, form)
        except ValueError:
            return
    raise PreconditionError(
        f"t has numbers that look like dates, such as {int(numbers[0])}; expected pandas.to_datetime(t, format={form!r}) "
        "if they are, or smaller numbers, as t - t.min()")


# The dtype of an array of them.
_TYPES_OF_TIMES: dict[str, tuple[type, ...]] = {
    "M8": (datetime.date, np.datetime64), "m8": (datetime.timedelta, np.timedelta64), "U": (str,)}


def _times_of_objects(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Dates of Python and pandas in UTC, and durations; other objects unchanged."""
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
    # numpy would drop the nanoseconds of pandas' dates.
    return np.asarray([value.to_numpy() if hasattr(value, "to_numpy") else value for value in values],
                      dtype=kinds[0]).reshape(array.shape)


def _is_missing(name: Any) -> bool:
    try:
        return name is None or bool(name != name)
    except TypeError:  # pandas.NA
        return True


def things_of(names: npt.NDArray[Any], times: Floats) -> tuple[list[Any], npt.NDArray[np.int64]]:
    """The distinct names in the order of their first observation, and the index of each row's name."""
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


def merged_places(thing: npt.NDArray[np.int64], times: Floats, places: Floats, rows: npt.NDArray[np.int64],
                  labels: list[Any], duplicates: str | None) -> tuple[npt.NDArray[np.bool_], int]:
    """Which of the sorted observations are kept, and how many others had another position at the same time.

    The kept ones get the position that `duplicates` selects. `rows` are their numbers in messages.
    """
    if duplicates not in (None, "first", "last", "mean", "refuse"):
        raise PreconditionError(f"duplicates is {duplicates!r}; expected one of 'first', 'last', 'mean', 'refuse'")
    same = (thing[1:] == thing[:-1]) & (times[1:] == times[:-1])
    keep = np.ones(len(times), dtype=bool)
    keep[1:] = ~same
    differ = np.flatnonzero(same & np.any(places[1:] != places[:-1], axis=1)) + 1
    if len(differ) == 0:
        return keep, 0
    begins = np.flatnonzero(keep)
    ends = np.append(begins[1:], len(times))
    groups = np.unique(np.searchsorted(begins, differ, side="right") - 1)
    # A few may be due to rounded times; many, to several things with one name.
    conflicts = np.bincount(thing[begins[groups]], minlength=len(labels))
    is_refused = conflicts > 0
    if duplicates is None:
        is_refused &= 2 * conflicts >= np.bincount(thing[keep], minlength=len(labels))
    if duplicates in (None, "refuse") and np.any(is_refused):
        i = next(int(i) for i in differ if is_refused[thing[i]])
        raise InputError(
            f"rows {rows[i - 1]} and {rows[i]}: {labels[thing[i]]!r} is at two places at t = {times[i]}; expected one "
            "observation of a thing at a time, or duplicates='first', 'last' or 'mean', which says what to take")
    others = 0
    for begin, end in zip(begins[groups].tolist(), ends[groups].tolist()):
        distinct = list(dict.fromkeys(map(tuple, places[begin:end].tolist())))
        others += len(distinct) - 1
        if duplicates == "last":
            places[begin] = places[end - 1]
        elif duplicates == "mean":
            for number, place in enumerate(distinct[1:], start=2):
                places[begin] += np.array(place) / number - places[begin] / number
    return keep, others


def seen_places(x: ArrayLike, y: ArrayLike, size: int) -> tuple[Floats, Floats, npt.NDArray[np.int64]]:
    """The coordinates of rows whose x and y are not both NaN, and the numbers of these rows."""
    for name, column in (("x", x), ("y", y)):
        _arrays.expect_no_mask(name, column)
    columns = [np.asarray(column) for column in (x, y)]
    if all(column.dtype.kind == "f" and column.shape == (size,) for column in columns):
        is_missing = np.isnan(columns[0]) & np.isnan(columns[1])
        if np.any(is_missing):
            x, y = (np.where(is_missing, 0, column) for column in columns)
    else:
        is_missing = np.zeros(size, dtype=bool)
    x, y = _arrays.float_array("x", x, (size,)), _arrays.float_array("y", y, (size,))
    seen = np.flatnonzero(~is_missing)
    return x[seen], y[seen], seen
