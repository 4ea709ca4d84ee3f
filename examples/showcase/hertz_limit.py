"""Speeds of ten beads behind their impact on a plate, by Hertz's law and the method of Runge and Kutta of fourth order.

    python3 hertz_limit.py [STEP]

An independent check of hertz-column.toml: the law itself, without corners, in the same units. The error falls with the
fourth power of the step, 0.01 by default.
"""

import sys

BEADS, PLATE, SPEED, DURATION = 10, 2**0.5, (2 * 0.05 * 9.81) ** 0.5, 40


def rate(state):
    """Velocities and accelerations; a contact pushes with depth^1.5, that of the plate with PLATE times as much."""
    x, v = state[:BEADS], state[BEADS:]
    depth = [below - above for below, above in zip([0.0] + x, x)]
    force = [d**1.5 if d > 0 else 0.0 for d in depth]
    force[0] *= PLATE
    return v + [from_below - from_above for from_below, from_above in zip(force, force[1:] + [0.0])]


def along(state, step, slope):
    return [y + step * k for y, k in zip(state, slope)]


def speeds(step):
    state = [0.0] * BEADS + [-SPEED] * BEADS
    for _ in range(round(DURATION / step)):
        a = rate(state)
        b = rate(along(state, step / 2, a))
        c = rate(along(state, step / 2, b))
        d = rate(along(state, step, c))
        state = along(state, step / 6, [p + 2 * q + 2 * r + s for p, q, r, s in zip(a, b, c, d)])
    return state[BEADS:]


print(*(f"{v:.6f}" for v in speeds(float(sys.argv[1]) if len(sys.argv) > 1 else 0.01)))
