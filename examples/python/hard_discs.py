# SPDX-License-Identifier: GPL-3.0-or-later
"""A gas of hard discs: its speeds become those of a gas in equilibrium, and its pressure."""
import numpy as np

import kinetri


class Collisions:
    """A response: the discs collide elastically, and their momentum transfers are summed up."""

    def __init__(self):
        self.number = 0
        self.pushes = 0.0

    def __call__(self, contact):
        after = kinetri.respond("elastic", contact)
        change = np.subtract(after.velocity_b, contact.velocity_b)
        self.number += 1
        self.pushes += contact.mass_b * float(np.dot(contact.separation, change))
        return after


def speed_ratio(gas):
    """The mean of v^4 over the square of the mean of v^2: 2 in equilibrium (Maxwell, in the plane)."""
    squares = (gas.velocities() ** 2).sum(axis=1)
    return (squares**2).mean() / squares.mean() ** 2


def pressure(gas, collisions, time):
    """p A / (N k T) by the virial theorem, A being the area in which the centers can be."""
    return 1 + collisions.pushes / (2 * gas.energy() * time)


def henderson(share):
    """The same by Henderson's equation (1975), for a gas without walls."""
    return (1 + share**2 / 8) / (1 - share) ** 2


def main():
    print("share  collisions  v4 before  v4 after  pressure  Henderson")
    for share in (0.1, 0.3, 0.5):
        packing = kinetri.packing(400, share=share, seed=2, speed=5)
        collisions = Collisions()
        gas = kinetri.Simulation(**packing, rim=True, collisions=collisions)
        energy, before = gas.energy(), speed_ratio(gas)
        gas.advance_to(10)  # into equilibrium
        collisions.number, collisions.pushes = 0, 0.0
        gas.advance_to(30)
        print(f"{share:5.1f} {collisions.number:11d} {before:10.3f} {speed_ratio(gas):9.3f} "
              f"{pressure(gas, collisions, 20):9.3f} {henderson(share):10.3f}")
        assert abs(gas.energy() / energy - 1) < 1e-12  # conserved up to rounding


if __name__ == "__main__":
    main()
