# SPDX-License-Identifier: GPL-3.0-or-later
"""The types of the package: that they reach a user's mypy, that the package keeps to them, and that the
stubs of the extension module are about what is in it."""
import ast
import os
import pathlib
import re
import subprocess
import sys
import typing

import pytest

import kinetri
from kinetri import _kinetri

pytest.importorskip("mypy")
PACKAGE = pathlib.Path(kinetri.__file__).absolute().parent
STUB = PACKAGE / "_kinetri.pyi"

# A program of a user, with what mypy says of the types in it.
PROGRAM = """
from fractions import Fraction

import numpy as np
import kinetri

rng = np.random.default_rng(1)
kd = kinetri.KineticDelaunay(rng.uniform(0, 100, (10, 2)), [[0, 0]] * 10, start=Fraction(1, 3))
events = kd.record(until=2)
reveal_type(events)  # numpy.ndarray[Any, numpy.dtype[numpy.void]]
reveal_type(kd.edges())  # numpy.ndarray[Any, numpy.dtype[numpy.unsignedinteger[numpy._typing._32Bit]]]
reveal_type(kd.positions()[0])  # Any
reveal_type(kd.time)  # kinetri._kinetri.Time
reveal_type(kd.time < 3)  # builtins.bool
reveal_type(kd.time.fraction)  # Union[fractions.Fraction, None]
reveal_type(kd.closest_pair())  # Union[Tuple[builtins.int, builtins.int], None]
for event in kd.events(until=kd.time):
    reveal_type(event.removed)  # Union[Tuple[builtins.int, builtins.int], None]
ids, distances = kd.nearest_neighbors(k=3)
kd.set_velocities(kd.velocities())
kd.set_velocities(velocities=(1, 2))
kd.set_velocities(slice(2, None, 3), (1, 2))
kd.erase(kd.positions()[:, 0] > 90)
flips = kd.record(until=3, kinds=kinetri.event_kinds[:1])
response: kinetri.ResponseName = "swap"
discs = kinetri.Simulation([[0, 0]], [[0, 0]], radius=1, collisions=response)
reveal_type(kd.locate((1, 2)).kind)  # builtins.str
reveal_type(kinetri.KineticRegular.load("file"))  # kinetri._moving.KineticRegular


def respond(contact: kinetri.Contact) -> kinetri.Response:
    reveal_type(contact.would_approach([0, 0], contact.velocity_b))  # builtins.bool
    return kinetri.respond("elastic", contact)


sim = kinetri.Simulation(**kinetri.packing(10, share=0.3), mass="area", collisions=respond)
reveal_type(sim.energy())  # builtins.float
reveal_type(sim.advance_to(2.5, progress=print))  # builtins.int
reveal_type(kinetri.scenario("uniform", 10)[1].tolist)  # def () -> Any
reveal_type(kinetri.sturm_sequence([1, 0.5, Fraction(1, 3)]).count(0, kd.time, closed="left"))  # builtins.int
reveal_type(kinetri.sturm_sequence([1]).roots()[0].value)  # kinetri._kinetri.Time
tracks = kinetri.Tracks.from_arrays([0, 1], ["a", "a"], [0, 1], [0, 0], max_gap=2.0)
reveal_type(tracks.simulation(collisions="elastic"))  # kinetri.tracks.TracksSimulation
try:
    kinetri.run_in_pieces([[0, 0]], [[1, 0]], until=1.0, pieces=2)
except kinetri.CoincidentTrajectoriesError as error:
    reveal_type(error.ids)  # Tuple[builtins.int, builtins.int]
"""

# Programs that are wrong, each with what mypy says.
WRONG = {
    "kinetri.KineticDelaunay([[0, 0]])": 'Missing positional argument "velocities"',
    "kinetri.KineticDelaunay([[0, 0]], [[0, 0]], radius=1)": 'Unexpected keyword argument "radius"',
    "kinetri.KineticDelaunay([[0, 0]], [[0, 0]]).advance_to('now')": 'incompatible type "str"',
    "kinetri.KineticDelaunay([[0, 0]], [[0, 0]]).time + 1": "Unsupported operand types for +",
    "kinetri.scenario('uniform', points='many')": 'incompatible type "str"; expected "int"',
    "kinetri.Simulation([[0, 0]], [[0, 0]], collisions=3)": 'incompatible type "Literal[3]"',
    "kinetri.Simulation([[0, 0]], [[0, 0]], collisions='bounce')": 'incompatible type "Literal[\'bounce\']"',
    "kinetri.Tracks.read('t').simulation(collisions='bounce')": 'incompatible type "Literal[\'bounce\']"',
    "kinetri.KineticDelaunay([[0, 0]], [[0, 0]]).set_velocities(ids=[0])": 'No overload variant',
}


@pytest.fixture(scope="module")
def said(tmp_path_factory):
    """What mypy says of both programs and of the package. One run: reading NumPy's types takes most of its time."""
    folder = tmp_path_factory.mktemp("types")
    (folder / "program.py").write_text(PROGRAM)
    (folder / "wrong.py").write_text("\n".join(["import kinetri", *WRONG]))
    # Dask and all that it imports take six times as long as the rest, and the package uses one exception class of it.
    (folder / "mypy.ini").write_text("[mypy]\n[mypy-distributed.*]\nfollow_imports = skip\n")
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--package", "kinetri", "--module", "program",
         "--module", "wrong"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        env={**os.environ, "PYTHONPATH": str(PACKAGE.parent), "MYPY_CACHE_DIR": os.devnull})
    return done.stdout


def test_they_reach_the_programs_of_users(said):
    found = dict(re.findall(r'^program.py:(\d+): note: Revealed type is "(.*)"$', said, re.MULTILINE))
    expected = {str(number): line.split("  # ")[1] for number, line in enumerate(PROGRAM.split("\n"), 1)
                if "reveal_type" in line}
    assert found == expected, said


def test_they_report_what_is_wrong(said):
    for number, (line, message) in enumerate(WRONG.items(), 2):
        assert re.search(rf"^wrong.py:{number}: error: .*{re.escape(message)}", said, re.MULTILINE), line + said


def test_the_package_and_the_program_keep_to_them(said):
    modules = len([*PACKAGE.glob("*.py"), STUB])
    assert f"Found {len(WRONG)} errors in 1 file (checked {modules + 2} source files)" in said, said
    assert set(re.findall(r"^(\S+):\d+: error: ", said, re.MULTILINE)) == {"wrong.py"}, said


def test_names_of_responses_are_those_that_there_are():
    with pytest.raises(kinetri.PreconditionError) as raised:
        kinetri.Simulation([[0, 0]], [[0, 0]], collisions="bounce")
    expected = re.findall(r"'(\w+)'", str(raised.value).split("; expected ")[1])
    assert expected == ["none", *typing.get_args(kinetri.ResponseName)]


def named(value):
    """The names that are defined in a class of the module, or in the module, without special ones."""
    return {name for name in vars(value) if not name.startswith("_")}


def stubbed(body):
    """The definitions of a part of the stubs, by name."""
    return {getattr(node, "name", None) or node.target.id: node for node in body
            if isinstance(node, (ast.FunctionDef, ast.ClassDef, ast.AnnAssign))}


def test_stubs_name_what_is_in_the_module():
    stubs = stubbed(ast.parse(STUB.read_text()).body)
    assert named(_kinetri) | {"__version__"} == set(stubs)
    for name, stub in stubs.items():
        if not isinstance(stub, ast.ClassDef):
            continue
        value, members = getattr(_kinetri, name), stubbed(stub.body)
        assert named(value) <= set(members) <= set(vars(value)), name
        for member, node in members.items():
            is_property = bool(getattr(node, "decorator_list", []))
            assert isinstance(vars(value).get(member), property) == is_property, f"{name}.{member}"


def parameters(signature):
    """How many parameters there are between the parentheses after the name."""
    depth, count = 0, 0
    for character in signature[signature.index("("):]:
        depth += (character in "([{") - (character in ")]}")
        if depth == 0:
            return count
        count += 1 if character == "," and depth == 1 or count == 0 and character not in "( " else 0
    raise AssertionError(signature)


def stubbed_functions():
    """Each function of the stubs that is a method, or one of the module, and is documented by pybind11."""
    for node in ast.parse(STUB.read_text()).body:
        owner, members = (getattr(_kinetri, node.name), node.body) if isinstance(node, ast.ClassDef) else (
            _kinetri, [node])
        for member in members:
            if isinstance(member, ast.FunctionDef) and not member.decorator_list:
                text = getattr(owner, member.name).__doc__ or ""
                if text.startswith(member.name + "("):
                    yield f"{owner.__name__}.{member.name}", member.args, text.split("\n")[0]


def test_stubs_have_as_many_parameters_as_the_functions():
    functions = list(stubbed_functions())
    assert len(functions) > 50
    for name, arguments, signature in functions:
        assert len(arguments.posonlyargs) + len(arguments.args) == parameters(signature), (name, signature)
