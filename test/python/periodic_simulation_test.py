# SPDX-License-Identifier: GPL-3.0-or-later
"""Discs that collide in periodic boxes: contacts compared with those of all pairs of images, exactly."""
import copy
import itertools
import math
import pickle
import types

import numpy as np
import pytest

import kinetri

BOXES = [kinetri.Box((6, 5)), kinetri.Box.shear(5, 6, 0.25), kinetri.Box((5, 5), rates=(0.25, 0.5))]
RADIUS = 0.25
UNTIL = 2.0


def gas(box, seed, side=5, sizes="one", **options):
    """A disc in each unit square; numbers are multiples of 1/64. Of one radius, or of many, which may grow or shrink."""
    rng = np.random.default_rng(seed)
    places = np.array([(i, j) for i in range(side) for j in range(side)]) + rng.integers(0, 24, (side * side, 2)) / 64
    velocities = rng.integers(-128, 128, (side * side, 2)) / 64
    radius, growth = RADIUS, None
    if sizes != "one":
        radius = rng.choice([0, 2**-20, 0.125, 0.25, 0.3], side * side)
    if sizes == "growing":
        growth = np.where(radius == 0.3, -0.0625, rng.choice([0, 0.03125], side * side))
    return kinetri.Simulation(places, velocities, radius=radius, growth=growth, box=box, **options)


def contacts_of_passing_discs(sim):
    """The first contact of each pair and offset while discs move on straight lines: {(a, b, k, l): time}. All numbers
    are multiples of 2^-54, and computed with as integers."""
    def whole(numbers):
        scaled = np.asarray(numbers) * 2.0**54
        assert (scaled == np.rint(scaled)).all()
        return scaled.astype(int).tolist()

    (a_vector, b_vector), (a_rate, b_rate) = whole(sim.box.vectors), whole(sim.box.rates)
    motions = [sim.motion(i) for i in range(len(sim))]
    discs = list(zip(whole(sim.positions()), whole(sim.velocities()), *(
        whole([motion[name] for motion in motions]) for name in ("radius", "growth"))))
    found = {}
    for (a, b), k, l in itertools.product(itertools.combinations(range(len(discs)), 2), range(-4, 5), range(-4, 5)):
        (p, v, radius, growth), (q, w, other_radius, other_growth) = discs[a], discs[b]
        x, y = (q[i] - p[i] + k * a_vector[i] + l * b_vector[i] for i in (0, 1))
        vx, vy = (w[i] - v[i] + k * a_rate[i] + l * b_rate[i] for i in (0, 1))
        reach, growth = radius + other_radius, growth + other_growth
        square, half = vx * vx + vy * vy - growth * growth, x * vx + y * vy - reach * growth
        rest = x * x + y * y - reach * reach
        if rest >= 0 and (half < 0 or square < 0) and half * half > square * rest:
            # One of the roots, without cancellation.
            time = float(rest) / (-float(half) + math.sqrt(half * half - square * rest))
            if time <= UNTIL:
                assert max(abs(k), abs(l)) < 4
                found[a, b, k, l] = time
    return found


@pytest.mark.parametrize("sizes", ["one", "many", "growing"])
@pytest.mark.parametrize("box", BOXES)
def test_contacts_are_those_of_all_pairs_of_images(box, sizes):
    sim = gas(box, 1, sizes=sizes, collisions="log")
    expected = contacts_of_passing_discs(sim)
    events = sim.record(until=UNTIL, kinds="collision")
    assert events.dtype == kinetri.periodic_event_dtype
    found = {(*event["points"].tolist(), *event["added_offset"].tolist()): event["time"].item() for event in events}
    assert len(events) == len(found) and found.keys() == expected.keys()
    assert [found[key] for key in found] == pytest.approx([expected[key] for key in found], rel=1e-12)
    assert len(found) > 10 and sum(key[2:] != (0, 0) for key in found) > 5
    assert sim.audit()


def test_a_box_is_walls_or_periodic():
    places, velocities = [[1, 1], [3, 3]], [[1, 0], [0, 1]]
    freud = types.SimpleNamespace(Lx=8, Ly=8, xy=0, is2D=True)
    for box in (kinetri.Box((8, 8)), freud, types.SimpleNamespace(cell=np.diag([8, 8, 1]), pbc=[True, True, False])):
        sim = kinetri.Simulation(places, velocities, box=box)
        assert sim.box == kinetri.Box((8, 8)) and len(sim.edges()) == 6 == len(sim.edge_offsets())
    walls = kinetri.Simulation(places, velocities, box=(0, 0, 8, 8))
    assert walls.box == (0.0, 0.0, 8.0, 8.0) and kinetri.Simulation(places, velocities).box is None
    for sim in (walls, kinetri.Simulation(places, velocities)):
        with pytest.raises(kinetri.PreconditionError, match="expected an object in a periodic box"):
            sim.edge_offsets()
    for box in ((8, 8), [[8, 0], [0, 8]], (1, 2, 3), "wide", [1, [2, 3]]):
        with pytest.raises(kinetri.PreconditionError, match="box"):
            kinetri.Simulation(places, velocities, box=box)


def test_elastic_collisions_conserve_momentum_and_energy():
    mass = np.arange(1, 26) / 8
    sim = gas(BOXES[0], 2, collisions="elastic", mass=mass)
    momentum, energy = mass @ sim.velocities(), sim.energy()
    assert np.count_nonzero(sim.record(until=5.0)["kind"] == "collision") > 80
    assert mass @ sim.velocities() == pytest.approx(momentum, abs=1e-12) and sim.energy() == pytest.approx(energy)
    assert sim.audit() and sim.masses().tolist() == mass.tolist() and sim.radii().tolist() == [RADIUS] * 25


@pytest.mark.parametrize("sizes", ["one", "growing"])
@pytest.mark.parametrize("name", ["swap", "elastic", "stop"])
def test_a_function_may_respond_as_the_named_responses_do(name, sizes):
    box = BOXES[1] if name != "stop" else BOXES[0]
    seen = []

    def respond(contact):
        seen.append(contact.ids)
        return kinetri.respond(name, contact)

    named, own = gas(box, 3, sizes=sizes, collisions=name), gas(box, 3, sizes=sizes, collisions=respond)
    assert named.record(until=UNTIL).tobytes() == own.record(until=UNTIL).tobytes()
    assert named.positions().tolist() == own.positions().tolist() and len(seen) > 8


def test_changes_at_the_present_and_scheduled():
    sim = kinetri.Simulation([[1, 1], [4, 1]], [[0, 0], [1, 0]], radius=0.5, collisions="elastic", box=kinetri.Box((8, 8)))
    sim.schedule_insert(1.0, [1, 5], [0, -1])
    sim.schedule_erase(4.5, 0)
    contacts = sim.record(until=4.25, kinds="collision")
    assert contacts["time"].tolist() == [4, 4] and contacts["points"].tolist() == [[0, 1], [0, 2]]
    assert contacts["added_offset"].tolist() == [[-1, 0], [0, 0]]
    assert sim.velocities().tolist() == [[1, -1], [0, 0], [0, 0]]
    sim.advance_to(5)
    assert 0 not in sim and len(sim) == 2
    sim.set_velocities(1, [0, 0])
    ids = sim.insert([5, 5], [0, 0])
    assert ids.tolist() == [3] and sim.audit()
    with pytest.raises(kinetri.PreconditionError, match="no radii of their own"):
        sim.insert([6, 6], [0, 0], radius=1)


def test_a_disc_that_meets_its_own_image_ends_the_run():
    """The upper vector is (7 - 3 t, 3), and the diameter 5."""
    box = kinetri.Box([[16, 0], [7, 3]], rates=[[0, 0], [-3, 0]])
    sim = kinetri.Simulation([[0, 0]], [[0, 0]], radius=2.5, collisions="elastic", box=box)
    message = r"disc 0 meets its own image \(0, 1\) at t = 1; expected lattice vectors that stay longer than the diameter"
    with pytest.raises(kinetri.OwnImageError, match=message) as raised:
        sim.record(until=2.0)
    assert (raised.value.id, raised.value.offset, raised.value.time) == (0, (0, 1), 1)
    assert raised.value.events.dtype == kinetri.periodic_event_dtype
    assert sim.time == 1 and sim.audit()  # the state before the contact
    sim.erase(0)
    sim.advance_to(2.0)
    with pytest.raises(kinetri.OwnImageError, match=r"disc 0 meets its own image \(1, 0\) at t = 0"):
        kinetri.Simulation([[0, 0]], [[0, 0]], radius=2.5, collisions="log", box=kinetri.Box((4, 8)))


def test_radii_may_differ_and_grow():
    box = kinetri.Box((8, 8))
    sim = kinetri.Simulation([[0, 0], [5, 0], [0, 4]], [[0, 0], [1, 0], [0, 0]], radius=[1, 0.5, 0], growth=[0, 0, 0.125],
                             mass=[1, 0.25, 1], collisions="elastic", box=box)
    assert sim.radii().tolist() == [1, 0.5, 0]
    event = sim.record(until=2.0, kinds="collision")[0]
    assert (event["time"], event["points"].tolist(), event["added_offset"].tolist()) == (1.5, [0, 1], [-1, 0])
    # 4 t / 5 of the velocity 1 of the mass 1/4 to the mass 1.
    assert sim.velocities()[:2] == pytest.approx(np.array([[0.4, 0], [-0.6, 0]]), abs=1e-15)
    assert sim.radii().tolist() == [1, 0.5, 0.25] and sim.audit()
    assert sim.insert([3, 6], [0, 0], radius=0.25).tolist() == [3]
    sim.set_motions(3, [4, 6], [0, 0], radius=0.5, growth=-0.125)
    assert sim.motion(3)["radius"] == 0.5 and sim.audit()
    with pytest.raises(kinetri.OverlappingDiscsError):
        sim.insert([12, 6.75], [0, 0], radius=0.5)
    for change in (lambda: sim.insert([3, 3], [0, 0], radius=4.5), lambda: sim.set_motions(3, [4, 6], [0, 0], radius=4.5)):
        with pytest.raises(kinetri.OwnImageError, match="meets its own image"):
            change()
    with pytest.raises(kinetri.NegativeRadiusError):
        sim.advance_to(8.0)
    with pytest.raises(kinetri.PreconditionError, match="do not know which points are nearest"):
        sim.nearest_neighbors()


def test_a_small_disc_within_a_large_one_is_hidden():
    sim = kinetri.Simulation([[0, 0], [1, 8]], [[0, 0], [1, 0]], radius=[3, 0.5], collisions="log", box=kinetri.Box((8, 8)))
    assert sim.hidden_points().tolist() == [1] and len(sim.edges()) == 3
    event = sim.record(until=8.0, kinds="collision")[0]
    assert (event["time"], event["added_offset"].tolist()) == (3.5, [-1, -1])


def test_a_box_without_area_is_refused_at_once():
    box = kinetri.Box((4, 4), rates=[[-1, 0], [0, 0]])
    places, velocities = [[1, 1], [1.5, 3]], [[1, 0], [0, 1]]
    for sim in (kinetri.Simulation(places, velocities, box=box), kinetri.KineticDelaunay(places, velocities, box=box)):
        with pytest.raises(kinetri.PeriodicBoxError, match="has no area at time 4"):
            sim.advance_to(4)
        sim.advance_to(3.9)
        assert sim.audit()
    with pytest.raises(kinetri.OwnImageError):
        kinetri.Simulation(places, velocities, radius=0.25, collisions="log", box=box).advance_to(4)


def test_a_disc_that_grows_ends_the_run_at_its_own_image():
    sim = kinetri.Simulation([[0, 0], [4, 4]], [[0, 0]] * 2, radius=[1, 0.5], growth=[0, 0.5], collisions="log",
                             box=kinetri.Box((16, 8)))
    with pytest.raises(kinetri.OwnImageError, match=r"disc 1 meets its own image \(0, 1\) at t = 7") as raised:
        sim.advance_to(9.0)
    assert (raised.value.id, raised.value.offset, raised.value.time) == (1, (0, 1), 7)


@pytest.mark.parametrize("options, message", [
    ({"radius": 1, "rim": True}, "a periodic box has no walls; expected rim=False"),
    ({"radius": 1, "acceleration": [[0, 1], [0, 0]]}, "acceleration and jerk are not possible in a periodic box"),
    ({}, "collisions of discs need a radius|radius"),
])
def test_what_is_refused(options, message):
    with pytest.raises(kinetri.PreconditionError, match=message):
        kinetri.Simulation([[0, 0], [4, 4]], [[0, 0]] * 2, collisions="elastic", box=kinetri.Box((8, 8)), **options)


def test_points_that_coincide_are_refused_with_collisions():
    places, velocities = [[0, 0], [8, 16]], [[1, 1]] * 2
    with pytest.raises(kinetri.CoincidentTrajectoriesError):
        kinetri.Simulation(places, velocities, radius=1, collisions="log", box=kinetri.Box((8, 8)))
    assert kinetri.Simulation(places, velocities, box=kinetri.Box((8, 8))).hidden_points().tolist() == [1]


@pytest.mark.parametrize("call", [lambda sim: sim.hull(), lambda sim: sim.play(1.0)])
def test_what_is_not_possible_in_a_box_says_so(call):
    sim = gas(BOXES[0], 4, collisions="elastic")
    with pytest.raises(kinetri.PreconditionError, match="(is|are) not possible in a periodic box"):
        call(sim)
    sim.advance_to(1.0)
    assert sim.audit()


@pytest.mark.parametrize("sizes", ["one", "many"])
def test_the_energy_of_a_sheared_gas_changes_by_the_work_of_its_box(sizes):
    box = kinetri.Box.shear(5, 5, 0.5)
    sim = gas(box, 6, sizes=sizes, collisions="elastic", mass=np.arange(1, 26) / 8)
    flow = box.flow_at(sim.positions(), 0)
    assert flow == pytest.approx(np.column_stack((0.5 * sim.positions()[:, 1], np.zeros(25))))
    sim.set_velocities(sim.ids, sim.velocities() + flow)
    energies = [sim.energy()]
    table = sim.pressure([0.5, 1.0, 3.0])
    energies += table["energy"].tolist()
    assert table["until"].tolist() == [0.5, 1, 3] and table["from"].tolist() == [0, 0.5, 1] and sim.time == 3
    work = -25 * 0.5 * table["xy"] * (table["until"] - table["from"])
    assert np.diff(energies) == pytest.approx(work.to_numpy(), rel=1e-9) and np.all(np.abs(work) > 0.01)
    assert table["pressure"].tolist() == pytest.approx(((table["xx"] + table["yy"]) / 2).tolist())
    assert table["collisions"].min() > 3
    sim.set_energy(energies[0])
    assert sim.energy() == pytest.approx(energies[0]) and sim.audit()


def test_a_thermostat_works_in_the_plane():
    sim = kinetri.Simulation([[0, 0], [9, 0]], [[3, 4], [0, 0]])
    sim.erase(sim.insert([5, 5], [1, 1]))
    sim.set_energy(2.0)
    assert sim.velocities()[:2] == pytest.approx(np.array([[1.2, 1.6], [0, 0]])) and sim.energy() == pytest.approx(2)
    sim.set_energy(0)
    fast = kinetri.Simulation([[0, 0], [9, 0]], [[1e200, 0], [0, 1]])
    with pytest.raises(kinetri.PreconditionError, match="the energy is inf, so that no factor makes it 1.0"):
        fast.set_energy(1)
    for energy, message in ((1, "the energy is 0.0, so that"), (-1, "expected 0 or more"), (np.nan, "energy")):
        with pytest.raises(kinetri.PreconditionError, match=message):
            sim.set_energy(energy)


def test_the_pressure_is_that_of_a_periodic_box():
    sim = gas(BOXES[0], 7, collisions="elastic")
    for times, message in (([0.0], "not after the time now, 0.0"), ([1, 1], r"times\[1\] is 1.0, not after times\[0\]")):
        with pytest.raises(kinetri.PreconditionError, match=message):
            sim.pressure(times)
    assert len(sim.pressure([])) == 0 and sim.time == 0
    for other in (kinetri.Simulation([[0, 0]], [[0, 0]]), kinetri.KineticDelaunay([[0, 0]], [[0, 0]], box=(4, 4))):
        with pytest.raises(kinetri.PreconditionError, match="the pressure is that of a Simulation in a periodic box"):
            other.watch("pressure")


@pytest.mark.parametrize("sizes", ["one", "many", "growing"])
@pytest.mark.parametrize("box", BOXES)
def test_copies_and_files_go_on_alike(tmp_path, box, sizes):
    sim = gas(box, 5, sizes=sizes, collisions="elastic")
    sim.advance_to(0.5)
    sim.save(tmp_path / "state")
    expected = sim.snapshot().restore().record(until=UNTIL)
    assert "collision" in kinetri.to_dataframe(expected)["kind"].tolist()
    for other in (copy.copy(sim), pickle.loads(pickle.dumps(sim)), kinetri.Simulation.load(tmp_path / "state")):
        assert other.box == box and other.collisions == "elastic" and other.snapshot() == sim.snapshot()
        assert other.record(until=UNTIL).tobytes() == expected.tobytes() and other.audit()
    assert sim.record(until=UNTIL).tobytes() == expected.tobytes()
    with pytest.raises(kinetri.SnapshotError, match="Simulation"):
        (kinetri.KineticDelaunay if sizes == "one" else kinetri.KineticRegular).load(tmp_path / "state")


def test_tables_and_pictures_have_the_images():
    sim = kinetri.Simulation([[0, 0], [4, 0]], [[0, 0], [1, 0]], radius=1, collisions="elastic", box=kinetri.Box((8, 8)))
    row = kinetri.to_dataframe(sim.record(until=2.0, kinds="collision")).iloc[0]
    assert row[["point_a", "point_b", "added_k", "added_l"]].tolist() == [0, 1, -1, 0]
    assert row[["removed_k", "removed_l", "added_a"]].isna().all()
    pytest.importorskip("matplotlib").use("Agg")
    from matplotlib import pyplot

    assert len(sim.plot(pyplot.figure().gca()).collections[0].get_segments()) == 6
