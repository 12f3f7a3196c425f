# SPDX-License-Identifier: GPL-3.0-or-later
"""The programs in README.md run; and what the package imports."""
import os
import pathlib
import re
import subprocess
import sys

import pytest

README = pathlib.Path(os.environ["KINETRI_SOURCE_DIR"], "README.md")
PROGRAMS = re.findall(r"^```python\n(.*?)^```", README.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


def test_there_are_programs():
    assert PROGRAMS


@pytest.mark.parametrize("program", PROGRAMS, ids=range(len(PROGRAMS)))
def test_programs_run(program, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names = {}
    exec(program, names)
    assert len(names["events"]) > 1000 and len(names["ids"]) == 1000
    assert names["areas"].sum() == pytest.approx(100 * 100)
    assert (tmp_path / "run.html").read_bytes().endswith(b"</html>\n")
    assert "collision" in capsys.readouterr().out


def test_it_imports_what_is_optional_only_when_that_is_needed():
    text = subprocess.run([sys.executable, "-c", "import kinetri, sys; print(*sys.modules)"], check=True,
                          stdout=subprocess.PIPE, text=True).stdout
    imported = {name.split(".")[0] for name in text.split()}
    assert {"kinetri", "numpy"} <= imported
    assert not imported & {"cloudpickle", "dask", "distributed", "IPython", "matplotlib", "mypy", "pandas",
                           "scipy", "tqdm"}
