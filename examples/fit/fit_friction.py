"""Fits a friction and a restitution to a record: least squares with exact derivatives.

The record is what a bench would give at three frequencies: samples of both displacements with noise, and the press of
the stop by its speed at impacts. What is compared are statistics: they need no common clock, and `measure` gives those
of the model's 1-1 orbit exactly, with the derivative by each parameter. The orbit is there on the way of the fit too,
where the motion might settle on something else.

    python examples/fit/fit_friction.py
"""

from __future__ import annotations

import numpy as np
import slapstick
from numpy.typing import NDArray
from scipy.optimize import least_squares

MODEL = slapstick.load("vibro-impact")
FREQUENCIES = (1.8, 2.2, 2.6)
STATISTICS = ("x1:rms", "x2:rms", "x1-x2:mean", "w:mean")
UNKNOWN = ("friction", "restitution")
TRUTH = (0.15, 0.7)


def record(noise: float = 0.002, seed: int = 1) -> NDArray[np.float64]:
    """The statistics of sampled motions with the true values. `noise`: of each sample, relative to the clearance."""
    random = np.random.default_rng(seed)
    rows = []
    for omega in FREQUENCIES:
        values = dict(zip(UNKNOWN, TRUTH)) | {"omega": omega}
        settled = slapstick.simulate(MODEL, periods=400, samples=1, parameters=values)
        motion = slapstick.simulate(MODEL, periods=60, samples=200, start=settled.y[:, -1], parameters=values)
        x1, x2 = (motion[name][:-1] + noise * random.standard_normal(motion.t.size - 1) for name in ("x1", "x2"))
        w = motion.events.w[motion.events.kind == "impact"]
        w = w * (1 + noise * random.standard_normal(w.size))
        rows.append([np.sqrt(np.mean(x1**2) - noise**2), np.sqrt(np.mean(x2**2) - noise**2), np.mean(x1 - x2), np.mean(w)])
    return np.ravel(rows)


def measured(values: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The model's statistics, and their derivatives by the unknown parameters."""
    fixed = dict(zip(UNKNOWN, map(float, values)))
    found = [
        slapstick.orbit(MODEL, "1-1", parameters=fixed | {"omega": omega}).measure(STATISTICS, sensitivity=UNKNOWN)
        for omega in FREQUENCIES
    ]
    return np.concatenate([list(one.values()) for one in found]), np.vstack([one.jacobian for one in found])


def fit(target: NDArray[np.float64], guess: tuple[float, float] = (0.08, 0.55)):
    """Values, their standard deviations, and how often the model was measured."""
    answer = least_squares(
        lambda values: measured(values)[0] - target, guess, jac=lambda values: measured(values)[1], bounds=([0, 0], [0.5, 1])
    )
    variance = 2 * answer.cost / (target.size - len(UNKNOWN))
    deviations = np.sqrt(np.diag(np.linalg.inv(answer.jac.T @ answer.jac)) * variance)
    return answer.x, deviations, answer.nfev


if __name__ == "__main__":
    values, deviations, calls = fit(record())
    for name, value, deviation, true in zip(UNKNOWN, values, deviations, TRUTH):
        print(f"{name} = {value:.5f} +- {deviation:.5f} (true {true})")
    print(f"{calls} evaluations")
