# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the Python package that use pip have in common."""
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys

SKIPPED = 77
# What a program says that finds its way with the package.
USE = """if True:
    import kinetri
    kd = kinetri.KineticDelaunay(*kinetri.scenario("uniform", 50, seed=1))
    print(kinetri.__file__, kinetri.__version__, len(kd.record(1)) > 5, bool(kd.audit()))"""


def run(*command, **settings):
    """What the command prints. It reads no code but that in its working directory."""
    settings.setdefault("env", environment())
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, **settings)
    if done.returncode != 0:
        raise AssertionError(f"{command} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def environment(**more):
    """That of a user, with more variables."""
    kept = {name: value for name, value in os.environ.items()
            if not name.startswith(("PYTHON", "LD_", "KINETRI_", "CMAKE_"))}
    return {**kept, "PYTHONDONTWRITEBYTECODE": "1", **more}


def checkout_of(source, folder):
    """A copy of the sources, since setuptools writes beside them: without what is not of the project, and
    without the largest folders of what the package does not need."""
    checkout = folder / "checkout"
    shutil.copytree(source, checkout, ignore=lambda place, names: [
        name for name in names if name.startswith(".") or name == "__pycache__" or (
            pathlib.Path(place) == source
            and (name.startswith("build") or name in ("bench", "data", "out", "test")))])
    return checkout


def skip_without_tools():
    """Ends the test where the tools that make wheels are not installed."""
    missing = [name for name in ("pip", "setuptools", "wheel", "venv") if not importlib.util.find_spec(name)]
    if missing:
        print(f"skipped: {', '.join(missing)} not installed (Debian: python3-pip, python3-setuptools, "
              "python3-wheel, python3-venv)")
        sys.exit(SKIPPED)
