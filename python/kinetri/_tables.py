# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables that pandas and pyarrow hold or read."""
from __future__ import annotations

import csv
import os
import warnings
from typing import Any, Protocol

from .errors import InputError, PreconditionError

# Names of columns of heights, in lower case.
_THIRD_COORDINATES = ("z", "zu", "pos_z", "position_z", "z_position", "zpos", "altitude", "alt", "elevation", "ele",
                      "height", "depth")


class SupportsToPandas(Protocol):
    """A table that can be converted to pandas, such as a pyarrow.Table."""

    def to_pandas(self) -> Any: ...


# The format of a file by its first bytes, and the function of pandas that reads it.
_FORMATS = {b"PAR1": ("Parquet", "read_parquet"), b"ARROW1": ("Arrow", "read_feather"),
            b"FEA1": ("Feather", "read_feather")}


def frame_of(table: Any) -> Any:
    """A table as a pandas.DataFrame."""
    expected = ("expected a pandas.DataFrame, as pandas.DataFrame(df) makes of a dict of columns, or "
                "Tracks.from_arrays(t, id, x, y)")
    kind = type(table).__name__
    if hasattr(table, "to_pandas"):
        try:
            table = table.to_pandas()
        except ImportError as error:
            raise PreconditionError(
                f"df is a {kind}, whose to_pandas() says: {error}; expected pandas to be installed, as by pip install "
                "pandas, or Tracks.from_arrays(t, id, x, y)") from error
        except Exception as error:
            raise PreconditionError(f"df is a {kind}, whose to_pandas() says: {error}; {expected}") from error
    if not hasattr(table, "columns"):
        raise PreconditionError(f"df is a {kind}; {expected}")
    return table


def arrow_format(path: str) -> tuple[str, str] | None:
    """The format of a file, and the function of pandas to read it, if needed."""
    if not os.path.isfile(path):  # other files, such as pipes, could not be read again
        return None
    try:
        with open(path, "rb") as file:
            head = file.read(8)
    except OSError:
        return None  # the library reports why
    return next((found for magic, found in _FORMATS.items() if head.startswith(magic)), None)


def read_as_csv(path: str, arrow: tuple[str, str], columns: dict[str, str],
                ) -> tuple[str, dict[str, str], str | None]:
    """The wanted columns of such a file as CSV, by default t, id, x, y and radius; their names; a remark on the others."""
    df = _read(path, *arrow)
    if not columns:
        columns = {name: name for name in ("t", "id", "x", "y", "radius") if name != "radius" or name in df.columns}
    there = list(df.columns)
    wanted: list[str] = []
    for parameter, name in columns.items():
        parts = [name] if parameter != "t" or name in there else name.split("+")
        wanted += [part for part in parts if part not in wanted]
    for name in wanted:
        if name not in there:
            raise InputError(f"{path}: the column {name!r} is missing; expected one of " + _list_of(there))
    if all(name.isdigit() for name in wanted):
        raise InputError(f"{path}: the columns have numbers as names, {_list_of(wanted)}; expected names, as "
                         "Tracks.from_dataframe takes after df.rename")
    others = [name for name in there if name not in wanted]
    df = df[wanted].copy()
    for name in wanted:
        df[name] = _as_text(df[name])
    # Quoting preserves blanks at the ends of texts, and the digits of numbers.
    text: str = df.to_csv(index=False, quoting=csv.QUOTE_NONNUMERIC)
    return text, columns, remark_on(others)


def remark_on(unused: list[Any]) -> str | None:
    """A remark on columns that are not used, if there are any."""
    return f"columns that are not used: {_list_of(unused)}" if unused else None


def warn_of_third_coordinates(df: Any, unused: list[Any], stacklevel: int) -> None:
    """Warns of unused columns whose names are those of third coordinates, if they vary."""
    varying = [name for name in unused if str(name).lower() in _THIRD_COORDINATES and df[name].nunique(dropna=True) > 1]
    if varying:
        warnings.warn(f"the columns {_list_of(varying)} vary, and are left out: tracks are in the plane of x and y",
                      stacklevel=stacklevel + 1)


def _read(path: str, name: str, function: str) -> Any:
    """The file as a DataFrame, in which a named index becomes columns."""
    try:
        import pandas as pd

        df = getattr(pd, function)(path)
    except ImportError as error:
        raise InputError(
            f"{path}: is a file of {name}, which cannot be read here: {error}; expected pandas and pyarrow to be "
            "installed, as by pip install pandas pyarrow, or a table exported as CSV") from error
    except Exception as error:
        raise InputError(f"{path}: is a file of {name}, of which pandas.{function} says: {error}; expected one that it "
                         "reads") from error
    return df.reset_index() if any(index is not None for index in df.index.names) else df


def _list_of(names: list[Any]) -> str:
    shown = ", ".join(repr(name) for name in names[:20])
    return shown if len(names) <= 20 else f"{shown} and {len(names) - 20} others"


def _as_text(column: Any) -> Any:
    """The column with dates in UTC and durations in seconds, for CSV."""
    if getattr(column.dtype, "tz", None) is not None:
        return column.dt.tz_convert("UTC").dt.tz_localize(None)
    if getattr(column.dtype, "kind", None) == "m":
        return column.dt.total_seconds()
    return column
