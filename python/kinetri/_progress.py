# SPDX-License-Identifier: GPL-3.0-or-later
"""The bar of a long run: tqdm's where that is installed, else a line of text."""
import contextlib
import sys


@contextlib.contextmanager
def progress_bar(progress, start, until):
    """Gives the function that is called with the present time, or None.

    Parameters
    ----------
    progress : bool or callable
        Whether there is a bar; or the function itself.
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
        def show(time):
            print(f"\rt = {time:.6g} of {until:.6g}", end="", file=sys.stderr, flush=True)

        yield show
        print(file=sys.stderr)
        return
    with tqdm(total=until - start, unit="t", leave=False) as bar:
        yield lambda time: bar.update(time - start - bar.n)
