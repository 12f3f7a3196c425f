# SPDX-License-Identifier: GPL-3.0-or-later
"""Animals with collars meet: who was near whom and for how long, and when the herd was one group."""
import numpy as np
import pandas as pd

import kinetri

NEAR = 50.0  # meters


def recording(animals=12, hours=24, seed=3):
    """An invented recording as a table: a fix of each collar every half hour, and some fixes are missing."""
    rng = np.random.default_rng(seed)
    times = pd.date_range("2026-06-01 06:00", periods=2 * hours, freq="30min")
    herd = np.cumsum(rng.normal(0, 60, (len(times), 2)), axis=0)
    rows = []
    for animal in range(animals):
        own = np.cumsum(rng.normal(0, 15, (len(times), 2)), axis=0) + rng.normal(0, 40, 2)
        seen = rng.uniform(size=len(times)) < 0.9
        x, y = (herd + own)[seen].T
        rows.append(pd.DataFrame({"time": times[seen], "animal": f"A{animal:02d}", "x": x, "y": y}))
    return pd.concat(rows, ignore_index=True)


def main():
    table = recording()
    tracks = kinetri.Tracks.from_dataframe(table, t="time", id="animal")
    print(tracks)

    encounters = tracks.encounters(NEAR)
    print(f"{len(encounters)} encounters; the first, with exact begin and end:")
    first = encounters[["a", "b", "begin_date", "end_date", "distance"]].head(3).round(2)
    first["begin_date"] = first["begin_date"].dt.floor("s")
    first["end_date"] = first["end_date"].dt.floor("s")
    print(first.to_string(index=False))

    encounters["hours"] = (encounters["end"] - encounters["begin"]) / 3600
    together = encounters.groupby(["a", "b"])["hours"].sum().nlargest(3).round(2).reset_index()
    print("most of the time together:")
    print(together.to_string(index=False))

    # Each row has the number of groups until the time of the next row.
    groups = tracks.components(NEAR)
    spans = groups["time"].diff().shift(-1).fillna(tracks.end - groups["time"].iloc[-1]) / 3600
    hours = spans.groupby(groups["components"]).sum().round(2).rename("hours").reset_index()
    print("hours with so many groups:")
    print(hours[hours["hours"] > 0].to_string(index=False))


if __name__ == "__main__":
    main()
