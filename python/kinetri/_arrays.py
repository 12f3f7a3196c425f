# SPDX-License-Identifier: GPL-3.0-or-later
"""Arguments as contiguous arrays: they are checked, and never rounded silently."""
from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ._types import ArrayLike, Floats, Ids, Walls
from .errors import PreconditionError

#: The id that stands for no point.
NO_POINT = 2**32 - 1


def _shape_text(shape: Sequence[int | str]) -> str:
    return "(" + ", ".join(str(n) for n in shape) + ("," if len(shape) == 1 else "") + ")"


def expect_no_mask(name: str, value: Any) -> None:
    """Raises an error if an array of `numpy.ma` has masked values."""
    if isinstance(value, np.ma.MaskedArray) and np.any(value.mask):
        raise PreconditionError(
            f"{name} is masked at [{_first(np.asarray(value.mask))}]; expected no masked values")


def _as_array(name: str, value: ArrayLike, expected: str) -> npt.NDArray[Any]:
    expect_no_mask(name, value)
    try:
        return np.asarray(value)
    except (ValueError, TypeError):
        raise PreconditionError(f"{name} is no array of numbers; expected {expected}") from None


def _differs(array: npt.NDArray[Any], result: Floats) -> npt.NDArray[np.bool_]:
    """A mask of the numbers that float64 rounds."""
    differs: npt.NDArray[np.bool_] = result.astype(array.dtype) != array
    if array.dtype.kind == "f":
        differs &= ~np.isnan(result)
    else:
        # Beyond the range of the integers, a conversion back is undefined.
        info = np.iinfo(array.dtype)
        differs |= result >= 2.0 ** (info.bits - (info.min < 0))
    return differs


def _usual(array: npt.NDArray[Any], shape: tuple[int | None, ...]) -> Floats | None:
    """The array as float64, if it has that shape and its numbers are certainly exact in float64 and finite: then it
    needs no other checks."""
    if array.ndim != len(shape) or any(n is not None and n != m for n, m in zip(shape, array.shape)):
        return None
    if array.dtype == np.float64:
        return np.ascontiguousarray(array) if np.isfinite(array).all() else None
    if array.dtype.kind in "iu" and array.size > 0 and max(-int(array.min()), int(array.max())) <= 2**53:
        return np.ascontiguousarray(array, dtype=np.float64)
    return None


def float_array(name: str, value: ArrayLike, shape: tuple[int | None, ...]) -> Floats:
    """The numbers as float64, C-contiguous, of that shape; None in `shape` is any length.

    Integers and other floats are accepted if float64 represents them exactly.
    """
    shape_text = _shape_text(["n" if n is None else n for n in shape])
    array = _as_array(name, value, f"real numbers of shape {shape_text}")
    usual = _usual(array, shape)
    if usual is not None:
        return usual
    if array.dtype.kind not in "iuf" and array.size > 0:
        raise PreconditionError(
            f"{name} is an array of {array.dtype}; expected real numbers of shape {shape_text}")
    if array.shape == (0,) and shape in ((None, 2), (0, 2)):  # no rows, as a list
        array = np.empty((0, 2))
    if array.ndim != len(shape) or any(
            n is not None and n != m for n, m in zip(shape, array.shape)):
        raise PreconditionError(
            f"{name} has the shape {_shape_text(array.shape)}; expected {shape_text}")
    with np.errstate(over="ignore", invalid="ignore"):
        result = np.ascontiguousarray(array, dtype=np.float64)
        wrong = _differs(array, result) if array.dtype.kind in "iuf" and array.dtype != np.float64 \
            else np.zeros(array.shape, dtype=bool)
    if np.any(wrong):
        raise PreconditionError(
            f"{name}[{_first(wrong)}] is {str(array[tuple(np.argwhere(wrong)[0])])}, which float64 "
            "rounds; expected numbers that are exact in float64")
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


def rows(name: str, value: ArrayLike, size: int | None = None, copies: int = 1) -> Floats:
    """The same; two numbers are one row, which is repeated `copies` times."""
    array = _as_array(name, value, "real numbers of shape (n, 2)")
    if array.shape == (2,):
        array = np.broadcast_to(array, (copies, 2))
    return point_array(name, array, size)


def column(name: str, value: ArrayLike, size: int) -> Floats:
    """One number for each of `size` points; a single number is repeated."""
    if _is_number(name, value):
        return np.full(size, one_number(name, value))
    return float_array(name, value, (size,))


def check_not_negative(name: str, values: Floats | None) -> None:
    """Raises an error if one of the numbers is less than 0."""
    if values is not None and np.any(values < 0):
        i = int(np.argmax(values < 0))
        raise PreconditionError(f"{name}[{i}] is {values[i]}; expected at least 0")


def rows_by_id(name: str, value: ArrayLike, is_there: npt.NDArray[np.bool_]) -> Floats:
    """The rows of existing points, from an array with a row of two numbers for each id.

    Rows of ids without a point must be NaN. Two numbers are one row for all points.
    """
    size = len(is_there)
    array = _as_array(name, value, f"real numbers of shape ({size}, 2)")
    if not is_there.all() and array.shape == (size, 2) and array.dtype.kind in "iuf":
        has_number = ~is_there[:, None] & ~np.isnan(array)
        if np.any(has_number):
            i = int(np.argwhere(has_number)[0, 0])
            raise PreconditionError(
                f"{name}[{_first(has_number)}] is {array[has_number][0]}, and there is no point {i}; expected "
                "NaN in the rows of ids without a point, or ids beside the rows")
        array = np.where(is_there[:, None], array, 0)
    return rows(name, array, size, copies=size)[is_there]


def id_slice(name: str, value: slice, next_id: int) -> npt.NDArray[np.intp]:
    """The ids less than `next_id` in the slice."""
    try:
        return np.arange(next_id)[value]
    except (TypeError, ValueError) as error:
        raise PreconditionError(f"{name} is {value!r}; expected a slice of ids: {error}") from None


def id_array(name: str, value: ArrayLike, next_id: int | None = None) -> Ids:
    """Ids as uint32, of shape (n,). A single id is an array of one; with `next_id`, a mask is accepted."""
    if (isinstance(value, np.ndarray) and value.dtype == np.uint32 and value.ndim == 1 and value.size > 0
            and value.max() < NO_POINT):
        return np.ascontiguousarray(value)
    array = np.atleast_1d(_as_array(name, value, "ids: integers of shape (n,)"))
    if array.dtype == np.bool_ and next_id is not None:
        if array.shape != (next_id,):
            raise PreconditionError(
                f"{name} is a mask of shape {_shape_text(array.shape)}; expected one bool for each id: shape "
                f"({next_id},)")
        return np.flatnonzero(array).astype(np.uint32)
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
        if isinstance(value, bool):
            raise TypeError
        result = operator.index(value)
    except TypeError:
        raise PreconditionError(f"{name} is {value!r}; expected the id of a point: an integer") from None
    if not 0 <= result < NO_POINT:
        raise PreconditionError(f"{name} is {result}; expected an id from 0 to {NO_POINT - 1}")
    return result


def count(name: str, value: Any) -> int:
    """A whole number from 0 on as an int."""
    try:
        result = operator.index(value)
    except TypeError:
        raise PreconditionError(f"{name} is {value!r}; expected a whole number") from None
    if not 0 <= result < 2**64:
        raise PreconditionError(f"{name} is {result}; expected a whole number from 0 on")
    return result


def _is_number(name: str, value: ArrayLike) -> bool:
    return _as_array(name, value, "a number").ndim == 0


def one_number(name: str, value: Any) -> float:
    """A finite number as a float that is the same number."""
    if not _is_number(name, value):
        raise PreconditionError(f"{name} is {value!r}; expected a number")
    return float(float_array(name, [value], (1,))[0])


def box_tuple(name: str, value: ArrayLike | None, instead: str = "") -> Walls | None:
    """A box (xmin, ymin, xmax, ymax), or None. A message about another shape ends with `instead`."""
    if value is None:
        return None
    if hasattr(value, "collapse_time"):
        raise PreconditionError(f"{name} is {value!r}, a periodic box, which is for a KineticDelaunay "
                                "or a Simulation; expected walls: "
                                "(xmin, ymin, xmax, ymax)")
    try:
        xmin, ymin, xmax, ymax = float_array(name, value, (4,)).tolist()
    except PreconditionError as error:
        raise PreconditionError(f"{error}: (xmin, ymin, xmax, ymax){instead}") from None
    if not (xmin < xmax and ymin < ymax):
        raise PreconditionError(
            f"{name} is {(xmin, ymin, xmax, ymax)}; expected (xmin, ymin, xmax, ymax) with "
            "xmin < xmax and ymin < ymax")
    return xmin, ymin, xmax, ymax
