"""Multipliers of the driven three-level oscillator with 40 digits: an event simulation that shares no code with slapstick.

    python3 three_level_check.py MODEL NAME=VALUE.. --orbit N     (needs mpmath, and slapstick on the PATH)

slapstick gives the orbit's state; Newton's method corrects it here, and differences of 1e-13 with 40 digits give the
multipliers. Within a level x is its forced motion plus a damped one, both in closed form; an edge is found by steps,
bisection and Newton's method.
"""

import json
import subprocess
import sys

from mpmath import cos, cosh, exp, lu_solve, matrix, mp, mpf, nstr, pi, sin, sinh, sqrt

mp.dps = 40
STEP, NEAR, SMALL = mpf(1) / 40, mpf(10) ** -30, mpf(10) ** -13


class Oscillator:
    """x'' + 2 zeta(|x|) x' + x = amplitude cos(omega t)."""

    def __init__(self, levels, edges, amplitude, omega):
        self.levels, self.edges, self.omega = levels, edges, omega
        self.forced = []  # of each level: the factors of cos(omega t) and sin(omega t)
        for zeta in levels:
            size = (1 - omega**2) ** 2 + (2 * zeta * omega) ** 2
            self.forced.append((amplitude * (1 - omega**2) / size, amplitude * 2 * zeta * omega / size))

    def flow(self, level, start, x, v, time):
        """The state `time` after the state (x, v) at `start`, if the level never changed."""
        zeta, (a, b), omega = self.levels[level], self.forced[level], self.omega

        def forced(t):
            return a * cos(omega * t) + b * sin(omega * t), omega * (b * cos(omega * t) - a * sin(omega * t))

        before, behind = forced(start), forced(start + time)
        u, w = x - before[0], v - before[1]
        root = sqrt(abs(1 - zeta**2))
        c, s = (cos, sin) if abs(zeta) < 1 else (cosh, sinh)
        c, s, decay = c(root * time), s(root * time) / root, exp(-zeta * time)
        return decay * (u * (c + zeta * s) + w * s) + behind[0], decay * (w * (c - zeta * s) - u * s) + behind[1]

    def level_at(self, x, v):
        return sum(abs(x) > edge + NEAR or (abs(abs(x) - edge) <= NEAR and x * v > 0) for edge in self.edges)

    def crossing(self, level, start, x, v, low, high, edge):
        """When x is at the edge, between the times `low` and `high` after the start."""
        beyond = self.flow(level, start, x, v, high)[0] > edge
        for _ in range(8):
            middle = (low + high) / 2
            low, high = (low, middle) if (self.flow(level, start, x, v, middle)[0] > edge) == beyond else (middle, high)
        time = (low + high) / 2
        for _ in range(7):
            at, speed = self.flow(level, start, x, v, time)
            time -= (at - edge) / speed
        return time

    def run(self, x, v, duration):
        """The state a duration after the state (x, v) at the time 0."""
        start = mpf(0)
        while True:
            level, time = self.level_at(x, v), mpf(0)
            inner = self.edges[level - 1] if level else mpf(-1)
            outer = self.edges[level] if level < len(self.edges) else mpf(10) ** 9
            while True:
                step = min(STEP, duration - start - time)
                now = self.flow(level, start, x, v, time + step)
                if not inner <= abs(now[0]) <= outer:
                    break
                time += step
                if start + time >= duration:
                    return now
            edge = outer if now[0] > outer else -outer if now[0] < -outer else inner if x > 0 else -inner
            met = self.crossing(level, start, x, v, max(time, NEAR), time + step, edge)
            x, v, start = edge, self.flow(level, start, x, v, met)[1], start + met


def corrected(oscillator, x, v, periods):
    """The cycle near (x, v) and the matrix of its map, by Newton's method."""
    duration = periods * 2 * pi / oscillator.omega
    while True:
        end = oscillator.run(x, v, duration)
        beside = oscillator.run(x + SMALL, v, duration), oscillator.run(x, v + SMALL, duration)
        jacobian = matrix(2)
        for column in range(2):
            for row in range(2):
                jacobian[row, column] = (beside[column][row] - end[row]) / SMALL
        change = lu_solve(jacobian - mp.eye(2), matrix([x - end[0], v - end[1]]))
        x, v = x + change[0], v + change[1]
        if mp.norm(change) < mpf(10) ** -16:
            return x, v, jacobian


def main():
    model, at = sys.argv[1], sys.argv.index("--orbit")
    settings = [word for pair in sys.argv[2:at] for word in ("--set", pair)]
    done = subprocess.run(["slapstick", "orbit", model, *settings, *sys.argv[at:]], stdout=subprocess.PIPE, check=True)
    orbit = json.loads(done.stdout)
    given = dict(pair.split("=") for pair in sys.argv[2:at])  # as decimal numbers, not as doubles

    def value(name):
        return mpf(given[name]) if name in given else mpf(repr(orbit["parameters"][name]))

    omega = value("omega") if "omega" in given else value("ratio") * 2 * pi / mpf("6.6633")
    levels = [value(name) for name in ("core", "band", "outside")]
    oscillator = Oscillator(levels, [value(name) for name in ("inner", "outer")], value("amplitude"), omega)
    x, v, jacobian = corrected(oscillator, mpf(orbit["state"]["x"]), mpf(orbit["state"]["v"]), orbit["n"])
    print("state", nstr(x, 20), nstr(v, 20), "distance", nstr(abs(x - mpf(orbit["state"]["x"])), 2))
    print("multipliers", *(nstr(mu, 12) for mu in mp.eig(jacobian)[0]), "slapstick", orbit["multipliers"])


main()
