"""Charts: the program's numbers; shards, and tiles on a Dask cluster whose worker is killed, give the bits of one call."""

import os
import signal
from threading import Thread

import numpy as np
import pytest
import slapstick
from beside import wait_until
from test_same_as_program import assert_same_table

X, Y = ("omega", 1.2, 5.2, 12), ("friction", 0.1, 0.3, 7)
WORDS = ("--x", "omega=1.2:5.2:12", "--y", "friction=0.1:0.3:7")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({}, ()),
        ({"of": "x1:rms"}, ("--of", "x1:rms")),
        ({"level": "full", "most_periods": 2000}, ("--level", "full", "--most-periods", 2000)),
        ({"carry": True, "direction": "both"}, ("--start", "carry", "--direction", "both")),
        ({"starts": 3, "seed": 5}, ("--start", 3, "--seed", 5)),
    ],
)
def test_map_has_the_rows_of_the_program(program, tmp_path, options, words):
    ran = program("map", "vibro-impact", *WORDS, *words, "--out", tmp_path / "m.csv")
    assert ran.returncode == 0, ran.stderr
    chart = slapstick.map("vibro-impact", X, Y, **options)
    assert_same_table(chart.to_pandas(), program.table(tmp_path / "m.csv"))


def equal(one, other):
    assert one.label.tolist() == other.label.tolist()
    for name in ("pixel", "exponent", "multiplier", "n", "p"):
        assert np.array_equal(getattr(one, name), getattr(other, name), equal_nan=True), name


def test_shards_together_are_the_whole():
    from slapstick._map import merged

    whole = slapstick.map("vibro-impact", X, Y, of="x1:rms")
    parts = [slapstick.map("vibro-impact", X, Y, of="x1:rms", shard=(i, 3)) for i in (3, 1, 2)]
    assert sum(len(part) for part in parts) == len(whole) == 84
    columns = merged([part._columns for part in parts])
    assert np.array_equal(columns["measured"]["x1:rms"], whole.measured["x1:rms"])
    assert columns["label"].tolist() == whole.label.tolist()


def test_a_store_is_resumed_by_the_program_and_by_python(program, tmp_path):
    store = tmp_path / "a.db"
    whole = slapstick.map("vibro-impact", X, Y, of="x1:rms", store=store)
    equal(whole, slapstick.map("vibro-impact", X, Y, of="x1:rms"))
    words = ("map", "vibro-impact", *WORDS, "--of", "x1:rms")
    ran = program(*words, "--store", store, "--resume", "--out", tmp_path / "m.csv")
    assert ran.returncode == 0, ran.stderr
    assert_same_table(whole.to_pandas(), program.table(tmp_path / "m.csv"))
    equal(slapstick.map("vibro-impact", X, Y, of="x1:rms", store=store, resume=True), whole)
    with pytest.raises(slapstick.InputError, match="resume"):
        slapstick.map("vibro-impact", X, Y, of="x1:rms", store=store)
    with pytest.raises(slapstick.InputError, match="another run"):
        slapstick.map("vibro-impact", X, Y, of="x1:max", store=store, resume=True)


def test_a_refined_chart_marks_what_it_filled_in():
    x, y = ("omega", 1.3, 2.6, 49), ("friction", 0.1, 0.2, 33)
    whole, fine = slapstick.map("vibro-impact", x, y), slapstick.map("vibro-impact", x, y, refine=8)
    assert fine.grid(fine.label).tolist() == whole.grid(whole.label).tolist()
    assert 0 < fine.computed.sum() < len(fine) / 2 and whole.computed.all()
    assert np.isnan(fine.exponent[~fine.computed]).all()
    assert np.array_equal(fine.exponent[fine.computed], whole.exponent[fine.computed])


def test_the_curve_behind_a_boundary_is_where_the_linear_oscillator_grazes():
    x, y = ("omega", 0.5, 1.5, 24), ("clearance", 0.3, 1.0, 18)
    chart = slapstick.map("impact-oscillator", x, y, damping_ratio=0.8)
    found = chart.curves(1)
    (curve,) = found.curves
    assert curve.type == "GR" and curve.edges == found.explained > 30 and curve.differ > 10 * curve.alike
    there = ~np.isnan(curve.x)
    amplitude = 1 / np.hypot(1 - curve.x[there] ** 2, 1.6 * curve.x[there])
    assert np.allclose(curve.y[there], amplitude, rtol=1e-9, atol=0)


def test_a_chart_is_seen_as_a_picture():
    chart = slapstick.map("vibro-impact", X, Y, carry=True, direction="both")
    up, down = chart.grid(chart.label, "up"), chart.grid(chart.label, "down")
    assert up.shape == down.shape == (7, 12) and up[0, 0] == chart.label[0]
    data = chart.to_xarray()
    assert data["class"].dims == ("direction", "friction", "omega")
    assert data["class"].sel(direction="down").values.tolist() == down.tolist()
    assert slapstick.map("vibro-impact", X, Y).plot().get_xlabel() == "omega"


def test_curves_are_drawn_over_a_chart_whose_axes_stay():
    pytest.importorskip("matplotlib")
    chart = slapstick.map("impact-oscillator", ("omega", 0.5, 1.5, 24), ("clearance", 0.3, 1, 18), damping_ratio=0.8)
    found = chart.curves(1)
    ax = chart.plot()
    limits = ax.get_xlim(), ax.get_ylim()
    assert found.plot(ax) is ax and (ax.get_xlim(), ax.get_ylim()) == limits
    assert len(ax.lines) == 2 * len(found.curves) == 2
    assert ax.lines[1].get_label() == found.curves[0].type == "GR"


def test_an_inset_shows_its_part_of_the_chart_and_covers_it_nowhere():
    pytest.importorskip("matplotlib")
    chart = slapstick.map("vibro-impact", ("omega", 1.5, 2.5, 12), ("friction", 0.1, 0.2, 9))
    for x, y in ((1.6, 0.11), (2.3, 0.11), (1.6, 0.18), (2.3, 0.18), (1.95, 0.15)):
        ax = chart.plot(inset=(x, x + 0.1, y, y + 0.01))
        (part,) = ax.child_axes
        assert part.get_xlim() == (x, x + 0.1) and part.get_ylim() == (y, y + 0.01)
        box = part.get_position().transformed(ax.figure.transFigure).transformed(ax.transData.inverted())
        assert box.x0 > x + 0.1 or box.x1 < x or box.y0 > y + 0.01 or box.y1 < y
    for wrong in ((1, 2, 0.1, 0.2), (1.6, 1.7, 0.1), (1.7, 1.6, 0.1, 0.2), (1.5, 2.5, 0.1, 0.2)):
        with pytest.raises(slapstick.InputError, match="inset"):
            chart.plot(inset=wrong)


def test_the_legend_of_a_chart_names_the_whole_area():
    pytest.importorskip("matplotlib")
    chart = slapstick.map("vibro-impact", ("omega", 1, 6, 60), ("friction", 0.05, 0.3, 40))
    texts = [text.get_text() for text in chart.plot().get_legend().get_texts()]
    assert any(" others " in text for text in texts), texts
    assert abs(sum(float(text.split()[-1].rstrip("%")) for text in texts) - 100) < 0.1 * len(texts)
    assert chart.plot(column="p").get_ylabel() == "friction"
    with pytest.raises(slapstick.InputError, match="column: 'q' is not one of class, exponent"):
        chart.plot(column="q")


def test_bad_input_is_named():
    for options, name in (
        ({"x": ("omega", 2, 1, 3)}, "x"),
        ({"y": ("omega", 1, 2, 3)}, "x, y"),
        ({"level": "deep"}, "level"),
        ({"direction": "down"}, "direction"),
        ({"of": "x1"}, "x1"),
        ({"carry": True, "starts": 3}, "starts"),
        ({"starts": 1}, "starts"),
        ({"shard": (3, 2)}, "shard"),
        ({"omega": 3.0}, "omega"),
    ):
        with pytest.raises(slapstick.InputError, match=name):
            slapstick.map("vibro-impact", **({"x": X, "y": Y} | options))


def test_dask_gives_the_same_bits_also_where_a_worker_is_killed():
    from dask.distributed import Client, LocalCluster

    import slapstick.dask

    x, y = ("omega", 1.0, 6.0, 60), ("friction", 0.05, 0.3, 40)
    whole = slapstick.map("vibro-impact", x, y)
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        workers = list(client.scheduler_info()["workers"])
        pids = client.run(os.getpid)
        equal(slapstick.dask.map(client, "vibro-impact", x, y), whole)

        def kill_in_the_middle():  # a part is done, and the worker is at another
            states = cluster.scheduler.tasks
            worker = cluster.scheduler.workers[workers[0]]
            wait_until(lambda: any(task.state == "memory" for task in list(states.values())) and worker.processing)
            os.kill(pids[workers[0]], signal.SIGKILL)

        killer = Thread(target=kill_in_the_middle)
        killer.start()
        equal(slapstick.dask.map(client, "vibro-impact", x, y, tasks=24), whole)
        killer.join()
        assert pids[workers[0]] not in client.run(os.getpid).values()
        with pytest.raises(slapstick.InputError, match="shard"):
            slapstick.dask.map(client, "vibro-impact", x, y, shard=(1, 2))
