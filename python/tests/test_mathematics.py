"""Closed forms and second routes: what must hold whatever the program prints."""

import numpy as np
import pytest
import slapstick

BALL = slapstick.load("bouncing-ball")


def test_impacts_of_a_bouncing_ball_are_a_geometric_series():
    r = BALL.parameters["restitution"].value
    w = slapstick.poincare(BALL, transient=0, points=12).w
    assert np.allclose(w, w[0] * r ** np.arange(12), rtol=1e-14)


def test_stick_slip_on_a_belt_has_the_period_of_its_closed_form():
    D, speed = 0.5, 0.3
    period = 2 * np.pi - 2 * np.arctan(D / speed) + 2 * D / speed
    found = slapstick.classify("belt", belt_speed=speed)
    assert (found.label, found.n) == ("free-0-II", 1)
    assert np.isclose(found.cycle, period, rtol=1e-12)
    assert np.isclose(slapstick.orbit("belt", "1-0-II", starts=64, belt_speed=speed).cycle, period, rtol=1e-12)


def test_steady_sliding_is_a_rest_with_the_eigenvalues_of_its_slope():
    found = slapstick.classify("falling-friction", damping_ratio=0.3)
    assert found.attractor == "equilibrium"
    assert np.isclose(found.eigenvalues[0].real, -0.1, rtol=1e-12)


def test_multipliers_are_those_of_differences_of_the_return_map():
    orbit = slapstick.orbit("vibro-impact", "1-1", starts=64, omega=2.9, stable=False)
    step = 1e-6

    def image(state):
        return slapstick.simulate(orbit.model, periods=orbit.n, samples=0, start=state, omega=2.9).state

    columns = [(image(orbit.state + h) - image(orbit.state - h)) / (2 * step) for h in step * np.eye(4)]
    by_differences = np.linalg.eigvals(np.transpose(columns))
    assert np.allclose(np.sort_complex(by_differences), np.sort_complex(orbit.multipliers), atol=1e-7)


@pytest.mark.parametrize("omega", [1.2, 1.5, 2.2])
def test_the_energy_of_a_cycle_balances_and_its_states_return(omega):
    orbit = slapstick.orbit("vibro-impact", "1-1", starts=64, omega=omega)
    energy = orbit.energy
    sinks = energy["damping"] + sum(energy["friction"].values()) + sum(energy["impacts"].values())
    assert energy["input"] == pytest.approx(sinks, rel=1e-12)
    assert np.allclose(orbit.y[:, 0], orbit.y[:, -1], atol=1e-12)
    assert orbit.t[-1] == pytest.approx(2 * np.pi / omega, rel=1e-15)


def test_a_period_doubling_is_where_a_multiplier_is_minus_one_and_the_doubled_orbit_is_born_there():
    branch = slapstick.continuation("vibro-impact", "omega", (2.6, 2.9), orbit="1-1", omega=2.7)
    (doubling,) = branch.special
    assert min(abs(doubling.orbit.multipliers + 1)) < 1e-6
    doubled = doubling.born[0].continuation("omega", (2.6, 2.9))
    assert {orbit.n for orbit in doubled} == {2}
    settled = slapstick.classify("vibro-impact", omega=2.87)
    assert settled.n == 2


def test_a_branch_through_an_orbit_passes_through_the_orbit():
    orbit = slapstick.orbit("vibro-impact", "1-1", starts=64, omega=2.7)
    branch = orbit.continuation("omega", (2.6, 2.9))
    at = int(np.argmin(abs(branch.value - 2.7)))
    assert branch.value[at] == 2.7
    assert np.allclose(branch.y[:, at], orbit.state, atol=1e-13)


def test_laws_of_contact_give_back_what_their_closed_forms_say():
    for start, back in ((1.0, -np.sqrt(8 / 20)), (-1.0, 0.47435857876378)):  # two stiffnesses; a bounded bumper
        motion = slapstick.simulate("buffers", time=2, samples=0, start={"x": 0, "v": start}, amplitude=0, stiffness=0)
        assert motion.state[1] == pytest.approx(back, rel=1e-13)


def test_a_start_on_the_attractor_needs_no_transient():
    found = slapstick.classify("vibro-impact", omega=2.2)
    again = slapstick.simulate("vibro-impact", periods=1, samples=0, start=found.state, omega=2.2)
    assert np.allclose(again.state, found.state, atol=1e-10)


def test_exponents_of_a_cycle_are_the_logarithms_of_its_multipliers():
    cycle = slapstick.classify("vibro-impact", omega=2.2)
    (found,) = slapstick.lyapunov("vibro-impact", omega=[2.2], start=cycle.state, periods=4000)
    assert found.sum_rule_holds
    assert np.allclose(found.per_period, np.log(abs(cycle.multipliers)) / cycle.n, atol=2e-3)
    assert slapstick.lyapunov("vibro-impact", omega=1.5, periods=100).exponents[-1] == -np.inf


def test_a_cycle_beside_its_doubling_is_named_and_a_quick_look_agrees():
    assert slapstick.classify("vibro-impact", omega=6.629902).label == "3-1-I"
    assert slapstick.classify("vibro-impact", omega=6.629902, quick=600).label == "3-1-I"
    curve = slapstick.classify("vibro-impact", omega=4.805, quick=600)
    assert (curve.label, curve.doubt) == ("undecided", "not confirmed")


def test_harmonics_are_lines_of_the_spectrum_and_their_derivatives_are_differences():
    at = 2.9
    lines = slapstick.spectrum("vibro-impact", "x1", orders=3, omega=at)
    found = slapstick.measure("vibro-impact", "x1:h1,x1:h3,x1:h3:phase", sensitivity="omega", omega=at)
    for order in (1, 3):
        [line] = np.flatnonzero(np.isclose(lines.order, order))
        assert np.isclose(found[f"x1:h{order}"], lines.amplitude[line], rtol=1e-12)
    assert np.isclose(found["x1:h3:phase"], lines.phase[line], rtol=1e-12)
    beside = [slapstick.measure("vibro-impact", "x1:h1", omega=at + by)["x1:h1"] for by in (-1e-5, 1e-5)]
    assert np.isclose(found.sensitivity["omega"]["x1:h1"], np.diff(beside)[0] / 2e-5, rtol=1e-6)
    with pytest.raises(slapstick.InputError, match="a harmonic is of a cycle"):
        slapstick.diagram("vibro-impact", omega=[2.5, 2.9], y="x1:h1")
    with pytest.raises(slapstick.InputError, match="a harmonic is of a cycle"):
        slapstick.measure("vibro-impact", "x1:h1", periods=20, omega=at)


def test_a_kicked_oscillator_has_its_closed_form(tmp_path):
    model = tmp_path / "kicked.toml"
    model.write_text(
        'name = "kicked"\nomega = 2\n[[coordinate]]\nname = "x"\nmass = 1\n'
        '[[spring]]\nbetween = ["x", "ground"]\nstiffness = 1\n[[damper]]\nbetween = ["x", "ground"]\ncoefficient = 0.1\n'
        '[[impulse]]\nname = "hammer"\non = "x"\nmomentum = 0.8\nphase = 0\n'
    )
    found = slapstick.measure(model, "x:h1,x:mean,power_in:mean,power_damping:mean")
    # The force is 0.8 / pi (1/2 + sum cos n 2 t) 2: amplitude 1.6 / pi of each harmonic.
    assert np.isclose(found["x:h1"], 1.6 / np.pi / np.hypot(1 - 4, 0.2), rtol=1e-12)
    assert np.isclose(found["x:mean"], 0.8 / np.pi, rtol=1e-12)
    assert np.isclose(found["power_in:mean"], found["power_damping:mean"], rtol=1e-12)


def test_a_maxwell_element_responds_as_its_dynamic_stiffness_says():
    model = slapstick.Model.from_toml(
        'name = "zener"\nomega = 1.3\n[parameters]\nc = 4\n[[coordinate]]\nname = "x"\nmass = 2\n'
        '[[spring]]\nbetween = ["x", "ground"]\nstiffness = 5\n'
        '[[maxwell]]\nname = "mount"\nbetween = ["x", "ground"]\nstiffness = 3\ndamping = "c"\n'
        '[[force]]\non = "x"\namplitude = 0.8\n'
    )
    assert model.state_names == ["x", "v", "s_mount", "v_s_mount"]
    element = 3 * 1.3j * 4 / (3 + 1.3j * 4)
    x = 0.8 / (5 - 2 * 1.3**2 + element)
    found = slapstick.measure(model, "x:h1,F_mount:h1,power_mount:mean")
    assert np.isclose(found["x:h1"], abs(x), rtol=1e-12)
    assert np.isclose(found["F_mount:h1"], abs(element * x), rtol=1e-12)
    assert np.isclose(found["power_mount:mean"], 0.5 * 1.3 * element.imag * abs(x) ** 2, rtol=1e-12)
    assert len(slapstick.orbit(model).multipliers) == 3


def test_a_jenkins_element_has_the_describing_function_of_its_loop():
    """A body so heavy that it swings as a sine of amplitude a: an error of the order of 1 / m."""
    a, k, f, m, omega = 0.8, 3.0, 0.9, 1e9, 1.3
    model = slapstick.Model.from_toml(
        f'name = "pad"\nomega = {omega}\n[[coordinate]]\nname = "x"\nmass = {m}\n'
        f'[[spring]]\nbetween = ["x", "ground"]\nstiffness = {m}\n'
        f'[[jenkins]]\nname = "pad"\nbetween = ["x", "ground"]\nstiffness = {k}\nlimit = {f}\n'
        f'[[force]]\non = "x"\namplitude = {a * m * (omega**2 - 1)}\n'
    )
    assert model.state_names == ["x", "v", "s_pad", "v_s_pad"]
    start = {"v": -a * omega}
    found = slapstick.measure(model, "F_pad:h1,power_pad:mean,x:max", start=start, transient=2)
    turn = np.arccos(1 - 2 * f / (k * a))  # it slips from here to the turn
    in_phase = k * a / np.pi * (turn - 0.5 * np.sin(2 * turn))
    lost = 4 * f * (a - f / k)
    assert np.isclose(found["x:max"], a, rtol=1e-7)
    assert np.isclose(found["F_pad:h1"], np.hypot(in_phase, lost / (np.pi * a)), rtol=1e-7)
    assert np.isclose(found["power_pad:mean"], lost * omega / (2 * np.pi), rtol=1e-7)
