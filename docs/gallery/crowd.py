#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tracks of an invented crowd that leaves a room by a door of 1.2 m: each person is pushed towards the door, and
away from whom and what is near, as in the social force model (D. Helbing and P. Molnar, Social force model for
pedestrian dynamics, Physical Review E 51, 1995). Nobody was recorded.

usage: crowd.py > crowd.csv
"""
import numpy as np

PEOPLE = 150
RADIUS = 0.22  # meters, of a person
ROOM = (10.0, 8.0)
DOOR = 0.6  # half of its width; it is in the middle of the right wall
STEP, STEPS_A_FRAME, FRAMES = 0.02, 10, 101  # seconds; five frames a second


def wall_push(places):
    """Away from the walls, that with the door being open where the door is."""
    x, y = places.T
    push = np.zeros_like(places)
    push[:, 0] += np.exp((RADIUS - x) / 0.1)
    beside = np.abs(y - ROOM[1] / 2) > DOOR - RADIUS / 2
    push[:, 0] -= np.where(beside & (x < ROOM[0] + 0.3), np.exp((RADIUS - np.abs(ROOM[0] - x)) / 0.1), 0)
    inside = x < ROOM[0]
    push[:, 1] += np.where(inside, np.exp((RADIUS - y) / 0.1) - np.exp((RADIUS - ROOM[1] + y) / 0.1), 0)
    return push


def goal(places):
    """The direction to the door; behind it, straight on."""
    to = np.array([ROOM[0] + 0.4, ROOM[1] / 2]) - places
    to[:, 1] = np.where(np.abs(to[:, 1]) < DOOR / 2, 0, to[:, 1])
    to[places[:, 0] > ROOM[0] - 0.1] = (1, 0)
    return to / np.maximum(np.sqrt((to**2).sum(axis=1))[:, None], 1e-9)


def main():
    rng = np.random.default_rng(3)
    columns, rows = np.meshgrid(np.arange(15), np.arange(10))
    places = np.column_stack((0.5 + 0.5 * columns.ravel(), 0.8 + 0.72 * rows.ravel()))
    places += rng.uniform(-0.14, 0.14, places.shape)
    wish = rng.uniform(1.1, 1.5, PEOPLE)[:, None]
    velocities = np.zeros_like(places)
    print("t,id,x,y")
    for step in range(STEPS_A_FRAME * FRAMES):
        if step % STEPS_A_FRAME == 0:
            for person in np.flatnonzero(places[:, 0] < ROOM[0] + 4):
                x, y = places[person]
                print(f"{step * STEP:.1f},{person},{x:.3f},{y:.3f}")
        apart = places[:, None] - places[None]
        distance = np.sqrt((apart**2).sum(axis=2))
        np.fill_diagonal(distance, np.inf)
        push = (apart / distance[:, :, None] * np.exp((2 * RADIUS - distance) / 0.12)[:, :, None]).sum(axis=1)
        velocities += STEP * ((wish * goal(places) - velocities) / 0.3 + 6 * push + 8 * wall_push(places))
        speed = np.sqrt((velocities**2).sum(axis=1))[:, None]
        velocities *= np.minimum(1, 1.8 / np.maximum(speed, 1e-9))
        places = places + STEP * velocities


if __name__ == "__main__":
    main()
