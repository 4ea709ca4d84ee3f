"""Errors are the library's three kinds, with the text of the command line."""

import re

import numpy as np
import pytest
import slapstick


@pytest.mark.parametrize(
    ("words", "call"),
    [
        (["--set", "omega=-1"], lambda: slapstick.simulate("vibro-impact", omega=-1)),
        (["--set", "omga=1"], lambda: slapstick.simulate("vibro-impact", omga=1)),
        (["--set", "kinetic_friction=3"], lambda: slapstick.classify("vibro-impact", kinetic_friction=3)),
        (["--state", "x1=9"], lambda: slapstick.simulate("vibro-impact", start={"x1": 9})),
        (["--set", "omega=1e60"], lambda: slapstick.simulate("vibro-impact", omega=1e60)),
    ],
)
def test_a_mistake_in_a_value_has_the_text_of_the_command_line(program, words, call):
    with pytest.raises(slapstick.InputError) as caught:
        call()
    assert isinstance(caught.value, ValueError)
    assert "\n" not in str(caught.value)
    assert program.complaint("simulate", "vibro-impact", *words).endswith(str(caught.value))


def test_an_unknown_model_has_the_text_of_the_command_line(program):
    with pytest.raises(slapstick.InputError) as caught:
        slapstick.load("vibro-imp")
    assert str(caught.value) == program.complaint("show", "vibro-imp")


def test_a_file_that_is_not_there_is_a_storage_error(program, tmp_path):
    with pytest.raises(slapstick.StorageError) as caught:
        slapstick.load(tmp_path / "none.toml")
    assert str(caught.value) == program.complaint("show", tmp_path / "none.toml")
    assert isinstance(caught.value, OSError)


def test_a_mistake_in_a_model_file_names_its_line(program, tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text(
        slapstick.load("vibro-impact").to_toml().replace("mass_ratio]\nvalue = 10", "mass_ratio]\nvalue = -10")
    )
    with pytest.raises(slapstick.InputError) as caught:
        slapstick.load(path)
    assert str(caught.value) == program.complaint("show", path)
    assert ":" in str(caught.value)


def test_a_certificate_that_cannot_be_written_is_a_storage_error(program, tmp_path):
    path = tmp_path / "none" / "run.cert"
    with pytest.raises(slapstick.StorageError) as caught:
        slapstick.certify("vibro-impact", path, periods=1)
    assert str(caught.value) == program.complaint("simulate", "vibro-impact", "--periods", 1, "--certify", path)


def test_an_orbit_that_is_not_there_says_what_was_tried_and_leaves_no_thread():
    with pytest.raises(
        slapstick.NumericalError, match=r"no unstable 1-7 orbit: the motion settles on .*; a search tried 3 motions"
    ):
        slapstick.orbit("vibro-impact", "1-7", stable=False, starts=3, omega=2.2)


def test_an_orbit_that_is_no_orbit_is_refused():
    for text in ("x", "1-", "1-1-III", "0-1", "1-1-I-I"):
        with pytest.raises(slapstick.InputError, match="is not of the form N-P"):
            slapstick.orbit("vibro-impact", text)


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda: slapstick.simulate("vibro-impact", omega=[1, 2]), r"omega: \[1, 2\] is not a number"),
        (lambda: slapstick.simulate("vibro-impact", start=[1, 2, 3]), "state"),
        (lambda: slapstick.simulate("vibro-impact", periods=-1), "periods = -1 is outside"),
        (lambda: slapstick.simulate("vibro-impact", samples=-1), "samples = -1 is outside"),
        (lambda: slapstick.lyapunov("vibro-impact", periods=-1), "periods = -1 is outside"),
        (lambda: slapstick.lyapunov("vibro-impact", transient=-1), "transient = -1 is outside"),
        (lambda: slapstick.measure("vibro-impact", "x1:rms", periods=-1), "periods = -1 is outside"),
        (lambda: slapstick.poincare("belt"), "has no stop"),
        (lambda: slapstick.diagram("vibro-impact"), "one parameter varies"),
        (lambda: slapstick.diagram("vibro-impact", omega=(3, 2, 5)), "is not of the form"),
        (lambda: slapstick.continuation("vibro-impact", "omega", orbit="1-1"), "no finite range"),
        (lambda: slapstick.continuation("vibro-impact", "omega", (3, 4), omega=2.2), "is outside 3 to 4"),
        (lambda: slapstick.continuation("vibro-impact", "omega", (2, 4), step=0.5), "step"),
        (lambda: slapstick.orbit("vibro-impact", "free-1"), "is driven"),
        (lambda: slapstick.simulate("vibro-impact", start="carry"), "start: 'carry' is not a state"),
        (lambda: slapstick.map("vibro-impact", ("omega", 2, 3, 2), ("friction", 0.1, 0.2, 2), of="x1"), "of: 'x1' needs a statistic"),
    ],
)
def test_a_call_that_makes_no_sense_is_an_input_error(call, text):
    with pytest.raises(slapstick.InputError, match=text):
        call()


AXES = (("omega", 2, 3, 2), ("friction", 0.1, 0.2, 2))


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda: slapstick.classify("belt", most_n=0), r"most_n = 0 is outside [1, 4096]"),
        (lambda: slapstick.classify("belt", quick=20, transient=5), "quick: not with transient"),
        (lambda: slapstick.classify("belt", most_n=2.5), "most_n = 2.5 is not a whole number"),
        (lambda: slapstick.classify("belt", most_n=True), "most_n = True is not a whole number"),
        (lambda: slapstick.classify("belt", most_n="7"), "most_n = '7' is not a whole number"),
        (lambda: slapstick.classify("vibro-impact", omega=[1, 2], threads=10**9), "threads = 1000000000 is outside"),
        (lambda: slapstick.lyapunov("belt", error=float("inf")), "error = inf is outside (0, inf)"),
        (lambda: slapstick.lyapunov("belt", error=float("nan")), "error = nan is not a number"),
        (lambda: slapstick.orbit("vibro-impact", "1-1", starts=-1), "starts = -1 is outside"),
        (lambda: slapstick.orbits("vibro-impact", most_n=-1), "most_n = -1 is outside [1, 64]"),
        (lambda: slapstick.continuation("vibro-impact", "omega", (2, 3), points=-1), "points = -1 is outside"),
        (lambda: slapstick.locus("vibro-impact", "omega", "friction", (2, 3), (0.1, 0.2), which=0), "which = 0 is outside"),
        (lambda: slapstick.locus("vibro-impact", "omega", "friction", (2, 3), (0.1, 0.2), type="gr"), "type = 'gr' is not one of"),
        (lambda: slapstick.map("vibro-impact", *AXES, measured_periods=5), "measured_periods: only with of"),
        (lambda: slapstick.map("vibro-impact", *AXES, level="full", periods=50), "periods: only with level = 'quick'"),
        (lambda: slapstick.basins("vibro-impact", transient=5), "transient: only with level = 'full'"),
        (lambda: slapstick.poincare("vibro-impact", phase=0.5), "phase: only with section = 'stroboscopic'"),
        (lambda: slapstick.spectrum("belt", "x:rms", orders=float("inf")), "orders = inf is outside"),
    ],
)
def test_what_the_command_line_refuses_is_refused(call, text):
    with pytest.raises(slapstick.InputError, match=re.escape(text)):
        call()


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda: slapstick.simulate("vibro-impact", omega=1, parameters={"omega": 2}), "omega is set twice"),
        (lambda: slapstick.continuation("vibro-impact", "omega", (2, 3), omega=2.5, y="x1:mx"), "mx"),
        (lambda: slapstick.simulate("vibro-impact", periods=1)["F_stop"], "F_stop: neither a number of the state"),
    ],
)
def test_a_mistake_is_told_before_the_work(call, text):
    with pytest.raises(slapstick.InputError, match=text):
        call()


def test_a_whole_number_may_be_a_float():
    assert slapstick.classify("vibro-impact", omega=1.5, most_n=8.0, transient=np.int64(400)).label == "1-1-II"


def test_few_points_are_a_warning_and_none_an_error():
    with pytest.warns(RuntimeWarning, match="only .* impacts in"):
        slapstick.poincare("vibro-impact", points=100, most_periods=20)
    with pytest.raises(slapstick.NumericalError, match="no impacts in"):
        slapstick.poincare("impact-oscillator", points=5, most_periods=50, clearance=100)


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda: slapstick.simulate("vibro-impact", period=5), "did you mean the option periods?"),
        (lambda: slapstick.classify("vibro-impact", transients=5), "did you mean the option transient?"),
        (lambda: slapstick.orbit("vibro-impact", "1-1", symetric=True), "did you mean the option symmetric?"),
        (lambda: slapstick.simulate("vibro-impact", rtol=1e-6), "there is no tolerance"),
        (lambda: slapstick.simulate("vibro-impact", periods=1, time=1), "time: not with periods"),
        (lambda: slapstick.simulate("vibro-impact", periods=1e9, samples=1000), "samples=0 keeps events only"),
    ],
)
def test_a_mistyped_option_is_not_called_a_parameter(call, text):
    with pytest.raises(slapstick.InputError, match=text.replace("?", "[?]")):
        call()


def test_a_row_that_fails_is_not_taken_for_a_class():
    with pytest.warns(RuntimeWarning, match="1 of 2 values failed"):
        found = slapstick.classify("vibro-impact", omega=np.array([2.2, -1.0]))
    assert found.label.tolist() == ["1-1-I", "failed"]
    assert np.isnan(found.exponent).tolist() == [False, True]
    assert "omega" in found.to_pandas()["failure"][1]
