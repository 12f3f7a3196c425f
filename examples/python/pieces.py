# SPDX-License-Identifier: GPL-3.0-or-later
"""A long run in pieces of time: of given motions side by side, of a simulation one after another."""
import pathlib
import tempfile

import numpy as np

import kinetri


def given_motions():
    """Each piece begins with a triangulation of its own, on a process of its own."""
    positions, velocities = kinetri.scenario("uniform", 500, seed=3)
    events = kinetri.run_in_pieces(positions, velocities, until=8.0, pieces=4)
    whole = kinetri.KineticDelaunay(positions, velocities).record(until=8.0)
    print(len(events), "events in four pieces,", len(whole), "in one")
    print("the same bytes:", events.tobytes() == whole.tobytes())


def cocircular_points():
    """On a lattice, too: the diagonals of the squares do not depend on the past."""
    positions, velocities = kinetri.scenario("lattice", 25, seed=1, movers="one")
    events = kinetri.run_in_pieces(positions, velocities, until=12.0, pieces=2)
    whole = kinetri.KineticDelaunay(positions, velocities).record(until=12.0)
    print("the same bytes on a lattice:", events.tobytes() == whole.tobytes())


def simulation():
    """Contacts change motions: a simulation runs from checkpoint to checkpoint, each perhaps a job."""
    discs = kinetri.packing(100, share=0.5, seed=3)
    whole = kinetri.Simulation(**discs, rim=True, collisions="elastic").record(until=4.0)
    pieces = []
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "gas.kinetri")
        kinetri.Simulation(**discs, rim=True, collisions="elastic").save(file)
        for until in (1.0, 2.0, 3.0, 4.0):
            gas = kinetri.Simulation.load(file)
            pieces.append(gas.record(until))
            gas.save(file)
    print([len(piece) for piece in pieces], "events from checkpoint to checkpoint,", len(whole), "at once")
    print("the same bytes:", np.concatenate(pieces).tobytes() == whole.tobytes())


# The processes import this file and must not start the runs again.
if __name__ == "__main__":
    given_motions()
    cocircular_points()
    simulation()
