#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures encounters, components and densities of a crowd beside programs that examine each frame.

Both sides get the same recorded positions. The frame-based programs use scipy: for each frame a k-d tree for
the pairs, connected components, and a Voronoi diagram. The table shows what they miss between frames. The
package is that on PYTHONPATH: build/release/python, for example.
"""
import argparse
import importlib
import statistics

from run_python import crowd, crowd_in_kinetri, crowd_in_scipy, seconds

BOX = (0, 0, 60, 20)
CORRIDOR = "POLYGON((0 0, 60 0, 60 20, 0 20, 0 0))"

EXAMPLES = """examples:
  PYTHONPATH=build/test/python bench/run_answers.py --frames 200
  PYTHONPATH=build/test/python bench/run_answers.py --people 700 --frames 5700
"""


def tracks_of(times, places):
    """The crowd as tracks: straight lines from frame to frame."""
    import numpy as np

    import kinetri

    frames, people = places.shape[:2]
    return kinetri.Tracks.from_arrays(np.repeat(times, people), np.tile(np.arange(people), frames),
                                      places[:, :, 0].ravel(), places[:, :, 1].ravel())


def encounters_by_frame(times, places, distance):
    """Of each pair the spans of frames in which it is near: [(a, b, begin, end, least distance)]."""
    import numpy as np
    from scipy.spatial import cKDTree

    current = {}
    result = []
    for frame, p in enumerate(places):
        pairs = cKDTree(p).query_pairs(distance, output_type="ndarray")
        gaps = np.hypot(*(p[pairs[:, 0]] - p[pairs[:, 1]]).T)
        now = {}
        for a, b, gap in zip(pairs[:, 0].tolist(), pairs[:, 1].tolist(), gaps.tolist()):
            begin, _, least = current.pop((a, b), (times[frame], None, gap))
            now[a, b] = (begin, times[frame], min(least, gap))
        result.extend((a, b, *span) for (a, b), span in current.items())
        current = now
    result.extend((a, b, *span) for (a, b), span in current.items())
    return result


def components_by_frame(places, distance):
    """The number of components in each frame."""
    import numpy as np
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    people = places.shape[1]
    result = []
    for p in places:
        pairs = cKDTree(p).query_pairs(distance, output_type="ndarray")
        graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), (people, people))
        result.append(connected_components(graph, directed=False)[0])
    return result


def missed_encounters(exact, seen):
    """How many encounters no frame shows, and the median of what begins are late by."""
    import bisect

    begins = {}
    for a, b, begin, end, _ in seen:
        begins.setdefault((a, b), []).append((begin, end))
    for spans in begins.values():
        spans.sort()
    missed = 0
    late = []
    for a, b, begin, end in zip(exact["a"].astype(int), exact["b"].astype(int), exact["begin"], exact["end"]):
        spans = begins.get((min(a, b), max(a, b)), [])
        at = bisect.bisect_left(spans, (begin,))
        if at < len(spans) and spans[at][0] <= end:
            late.append(spans[at][0] - begin)
        else:
            missed += 1
    return missed, statistics.median(late) if late else 0.0


def areas_of_frames(tracks, times, people):
    """The area of each cell in each frame but the last, at which the tracks end."""
    return tracks.areas(times[:-1], walkable=CORRIDOR)["area"].to_numpy().reshape(len(times) - 1, people)


def main():
    parser = argparse.ArgumentParser(description=__doc__, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--people", type=int, default=700, help="in the crowd (700)")
    parser.add_argument("--frames", type=int, default=5700, help="of the crowd (5700)")
    parser.add_argument("--range", type=float, default=2.0, help="what is near (2)")
    parser.add_argument("--seed", type=int, default=1, help="of all random numbers (1)")
    arguments = parser.parse_args()
    importlib.import_module("pandas")  # which the first table would need
    times, places = crowd(arguments.people, arguments.frames, arguments.seed)
    print(f"{arguments.people} people, {arguments.frames} frames, range {arguments.range}")

    def row(name, value):
        print(f"{name:60}  {value:10.4g}", flush=True)

    tracks = tracks_of(times, places)
    bare, _ = seconds(lambda: tracks.simulation().advance_to(tracks.end))
    row("the run alone, seconds", bare)

    exact_seconds, exact = seconds(lambda: tracks.encounters(arguments.range))
    frame_seconds, seen = seconds(lambda: encounters_by_frame(times, places, arguments.range))
    row("encounters, seconds", exact_seconds)
    row("encounters, scipy frame by frame, seconds", frame_seconds)
    row("encounters, exact", len(exact))
    row("encounters, seen in frames", len(seen))
    missed, late = missed_encounters(exact, seen)
    row("encounters that no frame shows", missed)
    row("begin seen late by, median", late)

    exact_seconds, exact = seconds(lambda: tracks.components(arguments.range))
    frame_seconds, numbers = seconds(lambda: components_by_frame(places, arguments.range))
    row("components, seconds", exact_seconds)
    row("components, scipy frame by frame, seconds", frame_seconds)
    changes = int((exact["kind"] != "start").sum())
    seen_changes = sum(abs(after - before) for before, after in zip(numbers, numbers[1:]))
    row("merges and splits, exact", changes)
    row("merges and splits, seen as another number at least", seen_changes)

    exact_seconds, exact = seconds(lambda: areas_of_frames(tracks, times, arguments.people))
    step_seconds, steps = seconds(lambda: crowd_in_kinetri(places, BOX))
    frame_seconds, areas = seconds(lambda: crowd_in_scipy(places, BOX))
    difference = max(abs(exact - areas[:-1]).max(), abs(steps - areas).max())
    if not difference < 1e-6:
        raise RuntimeError(f"areas of kinetri and scipy differ by {difference}")
    row("densities of each frame, seconds", exact_seconds)
    row("densities of each frame by set_positions, seconds", step_seconds)
    row("densities of each frame, scipy, seconds", frame_seconds)
    exact_seconds, exact = seconds(lambda: tracks.mean_areas(walkable=CORRIDOR))
    row("densities, mean over all times, seconds", exact_seconds)
    row("that mean area, stated error at most", exact["error"].max())
    row("that mean area, mean of the frames off by at most", abs(exact["area"] - areas.mean(axis=0)).max())


if __name__ == "__main__":
    main()
