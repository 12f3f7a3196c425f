# SPDX-License-Identifier: GPL-3.0-or-later
"""The progress bar of a long run: that of tqdm if installed, else a line of text."""
from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator

from ._types import Progress


@contextlib.contextmanager
def progress_bar(progress: Progress, start: float,
                 until: float) -> Iterator[Callable[[float], object] | None]:
    """Returns the function to be called with the present time, or None.

    Parameters
    ----------
    progress : bool or callable
        Whether to show a bar; or the function itself.
    start, until : float
        The times at which the bar is empty and full.
    """
    if not progress:
        yield None
        return
    if callable(progress):
        yield progress
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        def show(time: float) -> None:
            print(f"\rt = {time:.6g} of {until:.6g}", end="", file=sys.stderr, flush=True)

        yield show
        print(file=sys.stderr)
        return
    with tqdm(total=until - start, unit="t", leave=False) as bar:
        yield lambda time: bar.update(time - start - bar.n)
