"""The height of the body of car.toml after 9.9 s without friction, by the method of Runge and Kutta of fourth order.

    python3 runge_kutta.py [STEPS]      steps between two points of the road, 320 by default

An independent check: it takes the road and the laws of car.toml, and neither events nor closed forms.
"""

import csv
import sys

with open("road.csv", encoding="utf-8") as file:
    ROAD = [(float(row["time"]), float(row["height"])) for row in csv.DictReader(file)]
BODY, WHEEL, TRAVEL = 300, 40, 0.03


def rate(state, height, slope):
    """Velocities and accelerations of body and wheel on a road of this height and slope in time."""
    body, wheel, v_body, v_wheel = state
    w = v_body - v_wheel
    strut = 20000 * (body - wheel) + (1800 if w > 0 else 600) * w
    depth = wheel - body - TRAVEL
    stop = max(150000 * depth - 300 * w, 0) if depth > 0 else 0
    tyre = 180000 * (wheel - height) + 150 * (v_wheel - slope)
    return v_body, v_wheel, (stop - strut) / BODY, (strut - stop - tyre) / WHEEL


def along(state, step, slope):
    return [y + step * k for y, k in zip(state, slope)]


def height_of_body(steps, end=9.9):
    state = [0.0] * 4
    for (begin, low), (finish, high) in zip(ROAD, ROAD[1:]):
        if begin >= end - 1e-9:
            break
        slope = (high - low) / (finish - begin)
        step = (finish - begin) / steps
        for i in range(steps):
            here, middle, there = (low + slope * step * (i + part) for part in (0, 0.5, 1))
            a = rate(state, here, slope)
            b = rate(along(state, step / 2, a), middle, slope)
            c = rate(along(state, step / 2, b), middle, slope)
            d = rate(along(state, step, c), there, slope)
            state = along(state, step / 6, [p + 2 * q + 2 * r + s for p, q, r, s in zip(a, b, c, d)])
    return state[0]


print(f"{height_of_body(int(sys.argv[1]) if len(sys.argv) > 1 else 320):.7f}")
