"""Results remember where they come from, show themselves, and share their memory."""

import gc
import math
import pickle

import numpy as np
import pytest
import slapstick

MODEL = slapstick.load("vibro-impact")


@pytest.fixture(scope="module")
def results():
    branch = slapstick.continuation(MODEL, "omega", (2.6, 3), orbit="1-1", omega=2.7)
    return {
        "motion": slapstick.simulate(MODEL, periods=20, omega=1.5),
        "attractor": slapstick.classify(MODEL, omega=1.5),
        "section": slapstick.poincare(MODEL, points=20, omega=1.5),
        "diagram": slapstick.diagram(MODEL, omega=(2, 3, 5), impacts=5),
        "modes": slapstick.modes(MODEL, omega=1.5),
        "basins": slapstick.basins(MODEL, ("x1", -0.6, 0, 4), ("v1", -1, 1, 3), omega=2.82),
        "orbit": slapstick.orbit(MODEL, "1-1", starts=64, omega=2.2),
        "branch": branch,
        "locus": branch.special[0].locus("omega", "friction", (2.6, 3), (0.1, 0.2)),
    }


NAMES = ["motion", "attractor", "section", "diagram", "modes", "basins", "orbit", "branch", "locus"]


@pytest.mark.parametrize("name", NAMES)
def test_a_result_remembers_model_parameters_options_and_version(results, name):
    result = results[name]
    assert result.model is MODEL
    assert result.version == slapstick.__version__
    assert result.parameters["restitution"] == 0.8
    assert isinstance(result.options, dict)
    assert result.options or name in ("orbit",)


@pytest.mark.parametrize("name", NAMES)
def test_a_result_shows_itself_in_a_line_and_in_a_notebook(results, name):
    text = repr(results[name])
    assert "\n" not in text and "vibro-impact" in text
    assert "<table>" in results[name]._repr_html_()


@pytest.mark.parametrize("name", [name for name in NAMES if name != "attractor"])
def test_tables_and_datasets_have_a_row_for_every_entry(results, name):
    result = results[name]
    rows = len(result.t) if hasattr(result, "t") else len(result)
    table, data = result.to_pandas(), result.to_xarray()
    assert len(table) == rows > 0
    sizes = list(data.sizes.values())
    assert rows in (*sizes, math.prod(sizes))  # of a plane all starts


@pytest.mark.parametrize("name", [name for name in NAMES if name != "attractor"])
def test_a_plot_draws_into_the_axes_that_are_given(results, name):
    from matplotlib import pyplot

    figure, ax = pyplot.subplots()
    assert results[name].plot(ax) is ax
    assert ax.lines and ax.get_xlabel()
    figure.canvas.draw()
    pyplot.close(figure)


def test_arrays_are_not_copied_and_outlive_their_result():
    motion = slapstick.simulate(MODEL, periods=50, omega=1.5)
    assert np.shares_memory(motion.y, motion._core.y)
    assert np.shares_memory(motion.events.w, motion._core.event_w)
    y, w, kept = motion.y, motion.events.w, motion.y.copy()
    speeds = w.copy()
    del motion
    gc.collect()
    trash = [np.full(y.size, np.nan) for _ in range(20)]
    assert np.array_equal(y, kept) and np.array_equal(w, speeds), len(trash)


def test_samples_change_nothing_in_the_motion():
    few, many = (slapstick.simulate(MODEL, periods=30, samples=k, omega=0.552) for k in (0, 333))
    assert few.events.t.tolist() == many.events.t.tolist()
    assert few.t.shape == (0,) and few.y.shape == (4, 0)


def test_a_model_survives_pickling_with_its_defaults():
    copy = pickle.loads(pickle.dumps(slapstick.Model.from_toml(MODEL.to_toml(omega=3.25))))
    assert copy.values()["omega"] == 3.25
    assert copy.name == "vibro-impact"


def test_html_escapes_what_a_model_file_says():
    text = MODEL.to_toml().replace("forcing frequency", "<script>alert(1)</script>")
    assert "<script>" not in slapstick.Model.from_toml(text)._repr_html_()


def test_a_parameter_whose_name_is_an_options_is_given_by_the_table():
    text = MODEL.to_toml().replace("[parameters.restitution]", "[parameters.samples]")
    text = text.replace('= "restitution"', '= "samples"')
    model = slapstick.Model.from_toml(text)
    motion = slapstick.simulate(model, periods=10, samples=3, omega=1.5, parameters={"samples": 0.5})
    other = slapstick.simulate(MODEL, periods=10, samples=3, omega=1.5, restitution=0.5)
    assert motion.parameters["samples"] == 0.5
    assert motion.y.tolist() == other.y.tolist()


def test_all_public_names_have_a_docstring():
    for name in slapstick.__all__:
        assert name == "__version__" or getattr(slapstick, name).__doc__, name


def test_a_range_means_the_same_to_every_verb():
    classes = slapstick.classify("vibro-impact", omega=(2.0, 3.0, 3))
    drawn = slapstick.diagram("vibro-impact", omega=(2.0, 3.0, 3), impacts=1)
    assert classes.swept["omega"].tolist() == sorted(set(drawn.value.tolist())) == [2.0, 2.5, 3.0]


def test_a_parameter_that_varies_has_no_value():
    drawn = slapstick.diagram("vibro-impact", omega=(2.0, 2.2, 2), impacts=1, restitution=0.7)
    assert "omega" not in drawn.parameters and drawn.parameters["restitution"] == 0.7
    assert "omega =" not in repr(drawn)
    branch = slapstick.continuation("vibro-impact", "omega", (2.19, 2.21), orbit="1-1", omega=2.2)
    assert "omega" not in branch.parameters


def test_a_stop_may_stand_by_itself():
    one, many = (slapstick.classify("vibro-impact", omega=2.2, stops=stops) for stops in ("stop", ["stop"]))
    assert one.label == many.label
