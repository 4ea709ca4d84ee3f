"""Derivatives of statistics, and the example that fits by them."""

import runpy

import numpy as np
import pytest
import slapstick
from conftest import ROOT


def test_derivatives_are_those_of_differences():
    of, h = "x1:rms,x1:max,w:mean,impulse:mean,F_stop:mean,x1:crest", 1e-5
    found = slapstick.measure("vibro-impact", of, sensitivity="friction,omega", omega=2.6)
    assert found.jacobian.shape == (6, 2) and list(found.sensitivity) == ["friction", "omega"]
    for j, name in enumerate(found.sensitivity):
        at = {"friction": 0.15, "omega": 2.6}

        def values(by, at=at, name=name):
            return np.array(list(slapstick.measure("vibro-impact", of, parameters=at | {name: at[name] + by}).values()))

        assert np.allclose(found.jacobian[:, j], (values(h) - values(-h)) / (2 * h), rtol=1e-6, atol=1e-6)


def test_derivatives_of_an_unstable_orbit_and_those_that_are_refused():
    orbit = slapstick.orbit("vibro-impact", "1-1", starts=64, omega=2.9, stable=False)
    assert np.isfinite(orbit.measure("x1:rms", sensitivity=["restitution"]).jacobian).all()
    with pytest.raises(slapstick.InputError, match="sensitivity: .*restitutoin.*restitution"):
        orbit.measure("x1:rms", sensitivity="restitutoin")
    with pytest.raises(slapstick.InputError, match="only for a cycle"):
        slapstick.measure("vibro-impact", "x1:rms", periods=10, sensitivity="omega")


def test_the_example_finds_the_friction_and_the_restitution_of_its_record():
    pytest.importorskip("scipy")
    example = runpy.run_path(str(ROOT / "examples/fit/fit_friction.py"))
    values, deviations, calls = example["fit"](example["record"]())
    assert np.all(np.abs(values - example["TRUTH"]) < 4 * deviations + 1e-4)
    assert np.all(deviations < [0.01, 0.02]) and calls < 30
    exact, _, _ = example["fit"](example["measured"](np.array(example["TRUTH"]))[0])
    assert np.allclose(exact, example["TRUTH"], atol=1e-7)
