"""A picture for every kind of special point: the branch through the point on the left, the orbits around the point on the right.

draw("PD") writes PD.png; draw() writes all of them. The models are knocker.toml, pair.toml and two built-in ones.
"""

import numpy as np
import slapstick
from matplotlib import pyplot as plt

BEFORE, AT, BEHIND = "#0072b2", "0.1", "#d55e00"


def branch_of(model, name, between, y, step=0.004, **how):
    return slapstick.continuation(model, name, between, y=y, step=step, **how)


def draw_branch(ax, branch, y, colour="0.1"):
    """The statistic y along a branch: solid where orbits are stable, dashed where they are not, with a gap where the class changes."""
    value, height = branch.value, branch.measured[y]
    new = np.flatnonzero((branch.label[1:] != branch.label[:-1]) | (branch.stable[1:] != branch.stable[:-1])) + 1
    for part in np.split(np.arange(len(value)), new):
        style = "-" if branch.stable[part[0]] else "--"
        ax.plot(value[part], height[part], style, color=colour, linewidth=1.6)
    ax.set_xlabel(branch.parameter)
    ax.set_ylabel(y)


def mark(ax, point, y):
    ax.plot(point.value, point.orbit.measure(y)[y], "o", color=AT, markersize=7, zorder=3)


def nearest(branch, value, after=0):
    """The orbit of the branch next to a value of the parameter, of the points from `after` on."""
    return branch[after + int(np.argmin(np.abs(branch.value[after:] - value)))]


def draw_orbit(ax, orbit, name, colour, label, style="-"):
    """One cycle of an orbit over the phase of the force."""
    cycle = slapstick.simulate(orbit.model, periods=orbit.n, samples=2000, start=orbit.state, parameters=orbit.parameters)
    ax.plot(cycle.t / orbit.cycle * orbit.n, cycle[name], style, color=colour, label=label, linewidth=1.4)
    ax.set_xlabel("t / T")
    ax.set_ylabel(name)


def three(ax, branch, point, distance, name, window=None, impacts=False):
    """The orbits before, at and behind a point; dotted lines at their impacts, if they are wanted."""
    for orbit, colour, label in (
        (nearest(branch, point.value - distance), BEFORE, "before"),
        (point.orbit, AT, "at the point"),
        (nearest(branch, point.value + distance), BEHIND, "behind"),
    ):
        draw_orbit(ax, orbit, name, colour, label)
        for event in np.flatnonzero(orbit.events.kind == "impact") if impacts else ():
            ax.axvline(orbit.events.t[event] / orbit.cycle * orbit.n, color=colour, linestyle=":", linewidth=1.2)
    ax.axhline(0, color="0.7", linewidth=0.8, zorder=0)
    if window:
        ax.set_xlim(window[:2])
        ax.set_ylim(window[2:])


def special(branch, kind, near):
    points = [point for point in branch.special if point.type == kind]
    return min(points, key=lambda point: abs(point.value - near))


def around(model, name, kind, near, between, y, distance, shown, window=None, impacts=False, **how):
    """A point at which events change: the branch, and the orbits around the point."""
    branch = branch_of(model, name, between, y, **how)
    point = special(branch, kind, near)
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
    draw_branch(left, branch, y)
    mark(left, point, y)
    three(right, branch, point, distance, shown, window, impacts)
    right.legend(frameon=False)
    return figure


def fold():
    m = slapstick.load("knocker.toml")
    branch = branch_of(m, "omega", (1.2, 1.3), "x:min", orbit="2-3", stable=True, omega=1.23)
    point = special(branch, "LP", 1.2658)
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
    draw_branch(left, branch, "x:min")
    mark(left, point, "x:min")
    draw_orbit(right, slapstick.orbit(m, "2-3", stable=True, omega=1.255), "x", BEFORE, "stable")
    draw_orbit(right, slapstick.orbit(m, "2-3", stable=False, omega=1.255), "x", BEHIND, "unstable", "--")
    right.legend(frameon=False)
    return figure


def doubling():
    m = slapstick.load("knocker.toml")
    branch = branch_of(m, "omega", (2.6, 2.74), "w:max", orbit="1-1", omega=2.65)
    point = special(branch, "PD", 2.6666)
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
    draw_branch(left, branch, "w:max")
    for y in ("w:max", "w:min"):
        doubled = point.born[0].continuation("omega", (2.6, 2.74), step=0.004)
        left.plot(doubled.value, doubled.measure(y)[y], color=BEHIND)
    mark(left, point, "w:max")
    left.set_ylabel("w of the impacts")
    draw_orbit(right, slapstick.orbit(m, "2-2", omega=2.73), "x", BEHIND, "2-2, stable")
    once = nearest(branch, 2.73)
    draw_orbit(right, once, "x", BEFORE, "1-1, unstable", "--")
    right.plot(once.t / once.cycle + 1, once.y[0], "--", color=BEFORE, linewidth=1.4)
    right.legend(frameon=False)
    return figure


def torus():
    m = slapstick.load("vibro-impact")
    branch = branch_of(m, "omega", (4.78, 4.81), "w:max", orbit="4-2", omega=4.79)
    point = special(branch, "NS", 4.8015)
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
    draw_branch(left, branch, "w:max")
    mark(left, point, "w:max")
    for omega, colour, label in ((point.value - 0.001, BEFORE, "before: 4-2"), (point.value + 0.003, BEHIND, "behind: a torus")):
        section = slapstick.poincare(m, section="stroboscopic", omega=omega, transient=8000, points=2000)
        right.plot(section.y[0], section.y[1], ".", color=colour, markersize=5 if colour == BEFORE else 1.5, label=label)
    right.set(xlim=(-0.201, -0.178), ylim=(-0.1, -0.078), xlabel="x1 once in four periods", ylabel="v1 once in four periods")
    right.legend(frameon=False)
    return figure


def crossing():
    m = slapstick.load("two-sided-rattle")
    branch = branch_of(m, "omega", (1.0, 1.6), "x:mean", orbit="1-2", symmetric=True, omega=1.4)
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
    draw_branch(left, branch, "x:mean")
    point = special(branch, "BP", 1.4742)
    for orbit in point.born:
        side = orbit.continuation("omega", (1.0, 1.6), step=0.004)
        for sign in (1, -1):
            left.plot(side.value, sign * side.measure("x:mean")["x:mean"], color=BEHIND)
    mark(left, point, "x:mean")
    draw_orbit(right, slapstick.orbit(m, "1-2", symmetric=True, omega=1.4), "x", BEFORE, "symmetric, unstable", "--")
    tilted = slapstick.orbit(m, "1-2", stable=True, omega=1.4)
    draw_orbit(right, tilted, "x", BEHIND, "asymmetric, stable")
    turns = (tilted.t / tilted.cycle + 0.5) % 1
    order = np.argsort(turns)
    right.plot(turns[order], -tilted.y[0][order], color=BEHIND, alpha=0.5, label="its image")
    right.legend(frameon=False)
    return figure


PICTURES = {
    "LP": fold,
    "PD": doubling,
    "NS": torus,
    "BP": crossing,
    "GR": lambda: around(
        "knocker.toml", "omega", "GR", 1.0309, (1.0, 1.06), "w:min", 0.0005, "x", (0.55, 0.75, -0.03, 0.003), orbit="1-2", omega=1.02
    ),
    "SL-crossing": lambda: around(
        "knocker.toml", "omega", "SL", 1.421, (1.40, 1.44), "v:max", 0.006, "v", (0.53, 0.63, -0.02, 0.012), orbit="1-1", omega=1.41
    ),
    "SL-grazing": lambda: around(
        "knocker.toml", "omega", "SL", 1.4329, (1.42, 1.45), "v:max", 0.002, "v", (0.53, 0.63, -0.02, 0.004), orbit="1-1", omega=1.44
    ),
    "SL-switching": lambda: around(
        "knocker.toml", "omega", "SL", 1.4299, (1.42, 1.45), "v:max", 0.0025, "v", (0.55, 0.62, -0.008, 0.002), orbit="1-1", omega=1.44
    ),
    "SL-adding": lambda: around(
        "pair.toml", "omega", "SL", 1.3035, (1.29, 1.32), "v2:max", 0.005, "v2", (0.5, 0.95, -0.002, 0.003), orbit="1-1", omega=1.31
    ),
    "CH": lambda: around(
        "knocker.toml", "omega", "CH", 0.47138, (0.465, 0.485), "w:min", 0.004, "x", (0.36, 0.54, -0.012, 0.001), step=0.02, orbit="1-inf", omega=0.468
    ),
    "CO": lambda: around(
        "pair.toml", "friction", "CO", 0.0164, (0, 0.05), "x2:max", 0.012, "v2", (0.4, 0.6, -0.15, 0.15), True, orbit="1-1", friction=0.03
    ),
}


def draw(kind=""):
    for name, picture in PICTURES.items():
        if kind in ("", name):
            figure = picture()
            figure.savefig(f"{name}.png", dpi=110)
            plt.close(figure)
