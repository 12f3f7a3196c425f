# SPDX-License-Identifier: GPL-3.0-or-later
"""Every example of the docstrings, and that every public name has a docstring with its sections."""
import doctest
import importlib
import inspect
import pkgutil

import pytest

import kinetri

MODULES = [module.name for module in pkgutil.iter_modules(kinetri.__path__) if module.name != "_kinetri"]


@pytest.mark.parametrize("name", MODULES)
def test_examples(name):
    module = importlib.import_module(f"kinetri.{name}")
    assert doctest.testmod(module, optionflags=doctest.NORMALIZE_WHITESPACE).failed == 0


def test_there_are_examples():
    found = [test for name in MODULES
             for test in doctest.DocTestFinder().find(importlib.import_module(f"kinetri.{name}"))
             if test.examples]
    assert len(found) >= 9


def public_callables():
    for name in kinetri.__all__:
        value = getattr(kinetri, name)
        if inspect.isfunction(value):
            yield name, value
        elif inspect.isclass(value) and value.__module__.startswith("kinetri."):
            for member, function in inspect.getmembers(value, inspect.isfunction):
                if not member.startswith("_"):
                    yield f"{name}.{member}", function


@pytest.mark.parametrize("name, function", list(public_callables()))
def test_docstrings_name_every_parameter(name, function):
    text = inspect.getdoc(function)
    assert text, f"{name} has no docstring"
    if "; see `" in text.split("\n")[0]:
        return
    for parameter in inspect.signature(function).parameters.values():
        if parameter.name in ("self", "cls"):
            continue
        assert parameter.name in text, f"{name} says nothing of {parameter.name}"
