# SPDX-License-Identifier: GPL-3.0-or-later
"""Arguments as arrays without gaps: what they hold is checked, and never rounded in silence."""
from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ._types import ArrayLike, Box, Floats, Ids
from .errors import PreconditionError

#: Where there is no point: the id of no point.
NO_POINT = 2**32 - 1


def _shape_text(shape: Sequence[int | str]) -> str:
    return "(" + ", ".join(str(n) for n in shape) + ("," if len(shape) == 1 else "") + ")"


def float_array(name: str, value: ArrayLike, shape: tuple[int | None, ...]) -> Floats:
    """The numbers as float64, C-contiguous, of that shape; None in `shape` is any length.

    Integers and other kinds of float are taken where float64 has the same number.
    """
    array = np.asarray(value)
    if array.dtype.kind not in "iuf" and array.size > 0:
        raise PreconditionError(
            f"{name} is an array of {array.dtype}; expected real numbers of shape "
            f"{_shape_text(['n' if n is None else n for n in shape])}")
    if array.size == 0 and 0 in [n for n in shape if n is not None] + [0] and array.ndim < len(shape):
        array = np.empty([0 if n is None else n for n in shape])
    if array.ndim != len(shape) or any(
            n is not None and n != m for n, m in zip(shape, array.shape)):
        raise PreconditionError(
            f"{name} has the shape {_shape_text(array.shape)}; expected "
            f"{_shape_text(['n' if n is None else n for n in shape])}")
    result = np.ascontiguousarray(array, dtype=np.float64)
    if array.dtype != np.float64:
        wrong = result.astype(array.dtype) != array if array.dtype.kind == "f" else (
            np.abs(result) > 2.0**53)
        wrong &= ~np.isnan(result)
        if np.any(wrong):
            raise PreconditionError(
                f"{name}[{_first(wrong)}] is {array[tuple(np.argwhere(wrong)[0])]}, which float64 may "
                "round; expected numbers that are exact in float64")
    if not np.all(np.isfinite(result)):
        wrong = ~np.isfinite(result)
        raise PreconditionError(
            f"{name}[{_first(wrong)}] is {result[tuple(np.argwhere(wrong)[0])]}; expected finite "
            "numbers")
    return result


def _first(wrong: npt.NDArray[np.bool_]) -> str:
    return ", ".join(str(i) for i in np.argwhere(wrong)[0])


def point_array(name: str, value: ArrayLike, size: int | None = None) -> Floats:
    """Vectors: an array of shape (n, 2)."""
    return float_array(name, value, (size, 2))


def column(name: str, value: ArrayLike, size: int) -> Floats:
    """One number for each of `size` points: a number is that of all."""
    if np.ndim(value) == 0:
        return np.full(size, float_array(name, np.asarray([value]), (1,))[0])
    return float_array(name, value, (size,))


def id_array(name: str, value: ArrayLike) -> Ids:
    """Ids as uint32, of shape (n,). A single id is an array of one."""
    array = np.atleast_1d(np.asarray(value))
    if array.size == 0:
        array = array.astype(np.uint32)
    if array.dtype.kind not in "iu" or array.ndim != 1:
        raise PreconditionError(
            f"{name} is an array of {array.dtype} of shape {_shape_text(array.shape)}; expected ids: "
            "integers of shape (n,)")
    wrong = (array < 0) | (array >= NO_POINT)
    if np.any(wrong):
        raise PreconditionError(
            f"{name}[{_first(wrong)}] is {array[np.argmax(wrong)]}; expected ids from 0 to {NO_POINT - 1}")
    return np.ascontiguousarray(array, dtype=np.uint32)


def one_id(name: str, value: Any) -> int:
    """An id as an int."""
    try:
        result = operator.index(value)
    except TypeError:
        raise PreconditionError(f"{name} is {value!r}; expected the id of a point: an integer") from None
    if not 0 <= result < NO_POINT:
        raise PreconditionError(f"{name} is {result}; expected an id from 0 to {NO_POINT - 1}")
    return result


def one_number(name: str, value: Any) -> float:
    """A finite number as a float that is the same number."""
    if np.ndim(value) != 0:
        raise PreconditionError(f"{name} is {value!r}; expected a number")
    return float(float_array(name, np.asarray([value]), (1,))[0])


def box_tuple(name: str, value: ArrayLike | None) -> Box | None:
    """A box (xmin, ymin, xmax, ymax), or None."""
    if value is None:
        return None
    xmin, ymin, xmax, ymax = float_array(name, value, (4,)).tolist()
    if not (xmin < xmax and ymin < ymax):
        raise PreconditionError(
            f"{name} is {(xmin, ymin, xmax, ymax)}; expected (xmin, ymin, xmax, ymax) with "
            "xmin < xmax and ymin < ymax")
    return xmin, ymin, xmax, ymax
