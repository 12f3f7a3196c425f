# SPDX-License-Identifier: GPL-3.0-or-later
"""Types in the signatures of the package."""
from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Literal, Union

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from ._kinetri import Time

#: Numbers that are not rounded: lists of lists, arrays of any kind, tables.
ArrayLike = npt.ArrayLike
Floats = npt.NDArray[np.float64]
Ids = npt.NDArray[np.uint32]
#: How often each lattice vector of a periodic box is added.
Offsets = npt.NDArray[np.int32]
#: Points: ids, a slice of the ids, or a mask with one bool for each id.
IdsLike = Union[npt.ArrayLike, slice]
#: Rows of `event_dtype`.
Events = npt.NDArray[np.void]
Vector = Union[Sequence[float], Floats]
#: xmin, ymin, xmax, ymax
Walls = tuple[float, float, float, float]
#: Of a periodic box: two vectors, the two rates, and the epoch.
Lattice = tuple[float, float, float, float, float, float, float, float, float]
Path = Union[str, "os.PathLike[str]"]
TimeLike = Union[float, Fraction, "np.integer[Any]", "np.floating[Any]", "Time"]
#: Whether to show a progress bar, or a function of the present time.
Progress = Union[bool, Callable[[float], object]]
#: The built-in responses of discs that touch.
ResponseName = Literal["log", "swap", "elastic", "stop", "remove"]
