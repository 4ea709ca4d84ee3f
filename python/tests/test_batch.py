"""Batches: the events and exponents of single motions; the same bits for every number of lanes and threads; failures by run."""

import numpy as np
import pytest
import slapstick

OMEGA = (1.9, 2.5, 6)


def test_a_run_is_the_motion_of_its_values():
    found = slapstick.batch("vibro-impact", omega=OMEGA, transient=20, periods=10, points=4, events=True)
    assert found.end.shape == (4, 6) and found.points.shape == (4, 4, 6) and found.point_impacts.shape == (4, 6)
    assert np.array_equal(found.points[:, -1, :], found.end) and found.in_lanes.all() and found.done.all()
    for run, omega in enumerate(found.swept["omega"]):
        motion = slapstick.simulate("vibro-impact", periods=30, samples=0, omega=omega)
        assert np.allclose(found.end[:, run], motion.state, rtol=0, atol=1e-9)
        of = found.events.run == run
        last = motion.events.period >= 20
        assert found.events.kind[of].tolist() == motion.events.kind[last].tolist()
        assert found.events.contact[of].tolist() == motion.events.contact[last].tolist()
        assert np.allclose(found.events.t[of], motion.events.t[last], rtol=0, atol=1e-9)
        impacts = motion.events.w[last & (motion.events.kind == "impact")]
        assert found.impacts[run] == len(impacts) and np.isclose(found.speeds[run], impacts.sum(), rtol=1e-9)


def test_the_exponent_is_the_largest_of_lyapunov():
    # an overdamped oscillator far from its stop: sqrt(3) - 2 per unit of time
    values = {"damping_ratio": 2.0, "clearance": 50.0, "omega": [1.0, 2.0, 3.0]}
    found = slapstick.batch("impact-oscillator", **values, transient=30, periods=40, exponent=True)
    assert np.allclose(found.exponent, (np.sqrt(3) - 2) * 2 * np.pi / np.array([1.0, 2.0, 3.0]), rtol=0, atol=1e-12)
    assert np.isnan(slapstick.batch("impact-oscillator", periods=2).exponent).all()


def test_every_run_may_have_a_start_of_its_own():
    heights = np.array([0.3, 0.5, 0.9])
    named = slapstick.batch("bouncing-ball", start={"x": heights}, periods=1)
    whole = slapstick.batch("bouncing-ball", start=np.array([heights, np.zeros(3)]), periods=1)
    assert np.array_equal(named.end, whole.end) and len(named) == 3
    both = slapstick.batch("bouncing-ball", start={"x": heights}, periods=1, restitution=[0.4, 0.5, 0.6])
    assert len({*both.impacts.tolist()}) > 1 and len(both) == 3


def test_bits_do_not_depend_on_lanes_and_threads():
    plan = {"omega": (0.6, 5.0, 20), "transient": 3, "periods": 20, "exponent": True}
    one = slapstick.batch("vibro-impact", **plan, lanes=1, threads=1)
    many = slapstick.batch("vibro-impact", **plan, lanes=8, threads=2)
    assert one.end.tobytes() == many.end.tobytes() and one.exponent.tobytes() == many.exponent.tobytes()


def test_a_model_that_no_lane_can_run_is_run_all_the_same():
    found = slapstick.batch("falling-friction", periods=5)
    assert not found.in_lanes.any() and found.done.all() and found.lane_events.sum() == 0


def test_a_run_that_fails_says_why_and_ends_no_other():
    with pytest.warns(RuntimeWarning, match="1 of 2 runs failed, first run 1"):
        found = slapstick.batch("vibro-impact", start={"x1": [-0.5, 1.0]}, periods=3)
    assert found.done.tolist() == [True, False] and found.failures[0] == "" and "stop" in found.failures[1]
    assert np.isnan(found.end[:, 1]).all() and not np.isnan(found.end[:, 0]).any()


def test_tables():
    table = slapstick.batch("vibro-impact", omega=OMEGA, periods=3, events=True)
    assert table.to_pandas().columns.tolist()[:4] == ["omega", "impacts", "speeds", "exponent"]
    assert len(table.events.to_pandas()) == len(table.events)
    assert "6" in repr(table)


def test_bad_input_is_named():
    for options, name in (
        ({"periods": 0}, "periods"),
        ({"points": 3, "periods": 2}, "points"),
        ({"lanes": 3}, "1, 4 or 8"),
        ({"start": {"x1": [0.0, 0.1]}, "omega": [1.0, 2.0, 3.0]}, "start"),
        ({"omega": []}, "omega|start"),
        ({"start": {"y": [0.0, 0.1]}}, "y"),
    ):
        with pytest.raises(slapstick.InputError, match=name):
            slapstick.batch("vibro-impact", **options)


def test_a_start_behind_a_stop_is_the_failure_of_its_run_alone():
    for start in ([1.0, -0.5], [-0.5, 1.0]):
        with pytest.warns(RuntimeWarning, match="1 of 2 runs failed"):
            found = slapstick.batch("vibro-impact", start={"x1": start}, periods=3)
        assert [text != "" for text in found.failures] == [x > 0 for x in start]
    with pytest.raises(slapstick.InputError, match="stop"):
        slapstick.batch("vibro-impact", start={"x1": [1.0, 2.0]}, periods=3)
