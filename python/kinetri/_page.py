# SPDX-License-Identifier: GPL-3.0-or-later
"""The viewer's page: in a notebook, or as a file."""
from __future__ import annotations

import html
import os
import pathlib
import tempfile

from ._types import Path
from .errors import OutputError


class Page:
    """A recorded run as one HTML page that plays it.

    A notebook displays it. It needs no network.

    Parameters
    ----------
    content : bytes
        The page, UTF-8.
    height : int
        Of the frame in a notebook, in pixels.
    """

    def __init__(self, content: bytes, height: int = 640) -> None:
        self.content = content
        self.height = height

    def _repr_html_(self) -> str:
        page = html.escape(self.content.decode(), quote=True)
        return (f'<iframe srcdoc="{page}" width="100%" height="{self.height}" style="border: 0" '
                'sandbox="allow-scripts allow-downloads"></iframe>')

    def save(self, path: Path) -> None:
        """Writes the page to a file atomically.

        Parameters
        ----------
        path : str or path
            The file. An existing file is replaced.

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        path = pathlib.Path(path)
        try:
            handle, temporary = tempfile.mkstemp(dir=path.parent, prefix="." + path.name)
            try:
                with os.fdopen(handle, "wb") as file:
                    file.write(self.content)
                # With the permissions of a new file.
                mask = os.umask(0)
                os.umask(mask)
                os.chmod(temporary, 0o666 & ~mask)
                os.replace(temporary, path)
            except BaseException:
                os.unlink(temporary)
                raise
        except OSError as error:
            raise OutputError(f"{path}: {error.strerror}; expected a writable path") from error

    def __repr__(self) -> str:
        return f"<Page of {len(self.content)} bytes>"
