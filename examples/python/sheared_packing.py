# SPDX-License-Identifier: GPL-3.0-or-later
"""A packing of discs is sheared: how often do they exchange neighbors, and where does the work go?"""
import kinetri

SIZE, SIDE, SHARE = 50, 7.0, 0.80
RATE, STEPS = 0.2, 16  # of the shear; intervals for each unit of the strain


def packing():
    """Discs of two sizes in a sheared box, which follow its flow; their thermal energy is 1 each."""
    made = kinetri.packing(SIZE, sizes=1.4, share=SHARE, side=SIDE, seed=4, periodic=True)
    box = kinetri.Box.shear(SIDE, SIDE, RATE)
    thermal = made["velocities"] - made["velocities"].mean(axis=0)
    discs = kinetri.Simulation(made["positions"], thermal + box.flow_at(made["positions"], 0), radius=made["radius"],
                               mass="area", collisions="elastic", box=box)
    discs.set_energy(SIZE)
    return discs


def main():
    discs = packing()
    exchanges = discs.watch("exchanges")
    area = discs.box.area(0)
    collisions, pressures, work, heat = 0, 0.0, 0.0, 0.0
    print("strain  exchanges  collisions  mean pressure  mean shear stress    work    heat")
    for step in range(1, 2 * STEPS + 1):
        strain = step / STEPS
        mean = discs.pressure([strain / RATE]).iloc[0]
        collisions += int(mean.collisions)
        pressures += mean.pressure
        work -= area * mean.xy / STEPS
        heat += mean.energy - SIZE
        discs.set_energy(SIZE)  # the thermostat
        if step % (STEPS // 4) == 0:
            # By an exchange (T1) two points gain a neighbor, and two lose one.
            number = exchanges.table()["gained"].sum() // 2
            print(f"{strain:6.2f} {number:10d} {collisions:11d} {pressures / step:14.1f} {work / area / strain:18.1f} "
                  f"{work:7.0f} {heat:7.0f}")
    print("audit passed:", bool(discs.audit()))


if __name__ == "__main__":
    main()
