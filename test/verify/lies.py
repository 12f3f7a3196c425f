# SPDX-License-Identifier: GPL-3.0-or-later
"""Lies about a run: each changes its files, and returns the row at which that is to be noticed (-1
is the start, the number of rows is the end), or None if there is nothing that it could change.

A table has the lies about one kind of run, by name. The modules enter their lies into the tables, in this order."""
from lies_about_rows import BOX, PLAIN, TRACKS, WEIGHTS
from lies_about_contacts import LOG, NONE, RIM
from lies_about_points import TWINS

__all__ = ["BOX", "LOG", "NONE", "PLAIN", "RIM", "TRACKS", "TWINS", "WEIGHTS"]
