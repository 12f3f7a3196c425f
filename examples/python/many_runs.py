# SPDX-License-Identifier: GPL-3.0-or-later
"""A parameter study: how often hard discs collide, by density, the mean of several seeds.

usage: many_runs.py [--dask]
"""
import math
import sys

import kinetri

PARAMETERS = {"share": [0.1, 0.3, 0.5], "seed": range(1, 5)}
TIME = 4


def study(share, seed):
    """One run: a row of the table."""
    packing = kinetri.packing(200, share=share, seed=seed)
    gas = kinetri.Simulation(**packing, rim=True, collisions="elastic")
    gas.advance_to(1)
    before = gas.statistics()["events"]
    gas.advance_to(1 + TIME)
    after = gas.statistics()["events"]
    # Enskog's theory, without walls: collisions of a disc in a unit of time.
    radius = packing["radius"][0]
    contact_value = (1 - 7 * share / 16) / (1 - share) ** 2
    temperature = gas.energy() / len(gas)
    theory = 4 * share * contact_value / (math.sqrt(math.pi) * radius) * math.sqrt(temperature)
    return {"collisions": 2 * (after["collision"] - before["collision"]) / len(gas) / TIME,
            "enskog": theory,
            "flips": (after["flip"] - before["flip"]) / len(gas) / TIME}


def print_table(table):
    print(table.round(4).to_string(index=False))
    means = table.groupby("share").agg(collisions=("collisions", "mean"), deviation=("collisions", "std"),
                                       enskog=("enskog", "mean"), flips=("flips", "mean"))
    print(means.round(3).reset_index().to_string(index=False))


def main():
    if "--dask" in sys.argv:
        from dask.distributed import Client

        with Client(n_workers=2, threads_per_worker=1, dashboard_address=":0") as client:
            table = kinetri.sweep(study, PARAMETERS, client)
    else:
        table = kinetri.sweep(study, PARAMETERS)
    print_table(table)


# The processes import this file and must not start the study again.
if __name__ == "__main__":
    main()
