# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of programs, each in a folder of its own."""
import pathlib
import tempfile
import unittest


class In_folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
