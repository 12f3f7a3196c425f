# SPDX-License-Identifier: GPL-3.0-or-later
"""A boat sails through a field of buoys, and its neighbors change."""
from fractions import Fraction

import kinetri


def text(edges):
    return " ".join(f"{a}-{b}" for a, b in edges.tolist())


# Points 0 to 3 are buoys and rest; point 4 is the boat.
positions = [[0, 0], [6, 0], [6, 4], [0, 5], [2, -3]]
velocities = [[0, 0], [0, 0], [0, 0], [0, 0], [0.5, 1]]

kd = kinetri.KineticDelaunay(positions, velocities)
print("t = 0:", text(kd.edges()))

# From event to event, up to and including time 10.
while events := kd.step(until=10):
    print(f"t = {float(kd.time):.6g}, events {events}: {text(kd.edges())}")
kd.advance_to(10)  # no event is left; this advances the clock

print("next event:", kd.next_event_time())
print("at t = 10 the boat is at", kd.positions()[4].tolist())
print("its neighbors:", kd.neighbors(4).tolist())
print("audit passed:", bool(kd.audit()))

# The same run again, as a table; <NA> if no edge is removed or added.
kd = kinetri.KineticDelaunay(positions, velocities)
events = kd.record(until=10)
print(kinetri.to_dataframe(events).drop(columns=["time_lo", "time_hi", "point_a", "point_b"]))

# Times are exact. At 92/13, which no float is, the boat crosses the line through buoys 2 and 3.
crossing = list(kinetri.KineticDelaunay(positions, velocities).events(until=10))[3].time
print(repr(crossing))
print(crossing == Fraction(92, 13), crossing == 92 / 13)
