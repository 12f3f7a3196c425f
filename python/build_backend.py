# SPDX-License-Identifier: GPL-3.0-or-later
"""What pip calls to build the package (PEP 517): setuptools, if this Python has what the build needs.

Without build isolation pip takes what the Python has, and where a package is missing setuptools ends with
a message such as "invalid command 'bdist_wheel'". So this is looked at first, and the message says what is
missing, and which commands work.
"""
import importlib
import importlib.metadata
import importlib.util
import pathlib
import re
import sys
import sysconfig

HOOKS = ("build_editable", "build_sdist", "build_wheel", "get_requires_for_build_editable",
         "get_requires_for_build_sdist", "get_requires_for_build_wheel", "prepare_metadata_for_build_editable",
         "prepare_metadata_for_build_wheel")

WAY_OUT = """
The build of kinetri runs with {python} (Python {version}),
which has no {missing}.

Debian's Python has them in packages. In the folder of the sources:

    sudo apt-get install pybind11-dev python3-dev python3-numpy python3-pip python3-setuptools python3-venv python3-wheel
    /usr/bin/python3 -m venv --system-site-packages ~/kinetri
    ~/kinetri/bin/pip install -v --no-build-isolation .
"""


def release(package):
    """The first two numbers of the version of an installed package."""
    numbers = re.findall(r"\d+", importlib.metadata.version(package))
    return tuple(map(int, numbers[:2]))


def missing():
    """What the build needs and this Python has not, in words."""
    result = []
    has_setuptools = importlib.util.find_spec("setuptools") is not None
    if not has_setuptools or release("setuptools") < (61, 0):
        result.append("setuptools 61 or newer")
    # Newer setuptools have the command bdist_wheel themselves.
    if importlib.util.find_spec("wheel") is None and not (has_setuptools and release("setuptools") >= (70, 1)):
        result.append("wheel")
    if importlib.util.find_spec("numpy") is None:
        result.append("NumPy")
    if not pathlib.Path(sysconfig.get_path("include"), "Python.h").is_file():
        result.append("the headers of Python")
    return result


def __getattr__(name):
    if name not in HOOKS:
        raise AttributeError(name)
    if lacking := missing():
        sys.exit(WAY_OUT.format(python=sys.executable, version=sys.version.split()[0],
                                missing=" and no ".join(lacking)))
    return getattr(importlib.import_module("setuptools.build_meta"), name)
