"""Every call gives what the program prints for the same arguments, to the last bit of 17 digits."""

import numpy as np
import pytest
import slapstick


def same(column, printed):
    column = np.asarray(column)
    if printed.dtype.kind == "U":
        return column.astype(str).tolist() == printed.tolist()
    return np.array_equal(column, printed, equal_nan=True)


def assert_same_table(table, printed):
    """The DataFrame has the printed columns, in their order; contacts of a single stop besides."""
    assert list(table.columns)[: len(printed)] == list(printed)
    for name, column in printed.items():
        assert same(table[name], column), name


@pytest.mark.parametrize(
    ("model", "values", "periods"),
    [
        ("vibro-impact", {"omega": 1.5}, 50),
        ("vibro-impact", {"omega": 0.552}, 12),
        ("gear-pair", {}, 30),
        ("belt", {}, 40),
        ("buffers", {}, 30),
        ("mode-coupling-brake", {}, 40),
    ],
)
def test_simulate_has_the_events_and_samples_of_the_program(program, tmp_path, model, values, periods):
    sets = [word for name, value in values.items() for word in ("--set", f"{name}={value}")]
    tables = ["--events", tmp_path / "e.csv", "--trajectory", tmp_path / "t.csv"]
    summary = program.json("simulate", model, *sets, "--periods", periods, "--samples", 7, *tables)
    motion = slapstick.simulate(model, periods=periods, samples=7, **values)
    assert_same_table(motion.events.to_pandas(), program.table(tmp_path / "e.csv"))
    assert_same_table(motion.to_pandas(), program.table(tmp_path / "t.csv"))
    assert motion.work == summary["work"]
    assert motion.parameters == summary["parameters"]
    assert dict(zip(motion.model.state_names, motion.state)) == summary["end"]["state"]
    assert (motion.duration, motion.end_mode) == (summary["end"]["time"], summary["end"]["mode"])


def test_simulate_by_time_and_from_a_named_start(program, tmp_path):
    words = ("--time", 10.5, "--state", "x1=-0.7,v2=0.1", "--events", tmp_path / "e.csv")
    program.json("simulate", "vibro-impact", *words)
    motion = slapstick.simulate("vibro-impact", time=10.5, samples=0, start={"x1": -0.7, "v2": 0.1})
    assert_same_table(motion.events.to_pandas(), program.table(tmp_path / "e.csv"))


@pytest.mark.parametrize("omega", [0.552, 1.5, 2.2, 4.801, 4.805])
def test_classify_has_every_number_of_the_program(program, omega):
    printed = program.json("classify", "vibro-impact", "--set", f"omega={omega}")
    found = slapstick.classify("vibro-impact", omega=omega)
    assert (found.label, found.attractor, found.chatter) == (printed["class"], printed["attractor"], printed["chatter"])
    assert found.sticking == printed["sticking"]
    assert found.exponent == float(printed["exponent"])
    assert found.state.tolist() == list(printed["state"].values())
    if found.attractor == "periodic":
        assert (found.n, found.p) == (printed["n"], float(printed["p"]))
        assert [[mu.real, mu.imag] for mu in found.multipliers] == printed["multipliers"]
        assert found.impacts.w.tolist() == [impact["w"] for impact in printed["impacts"]]
    else:
        assert found.birkhoff_digits == printed["birkhoff_digits"]


def test_classes_of_an_array_are_those_of_its_values_on_any_number_of_threads():
    omega = np.linspace(0.8, 6, 9)
    one, two = (slapstick.classify("vibro-impact", omega=omega, threads=threads) for threads in (1, 2))
    alone = [slapstick.classify("vibro-impact", omega=value) for value in omega]
    assert one.label.tolist() == two.label.tolist() == [found.label for found in alone]
    assert one.exponent.tolist() == two.exponent.tolist() == [found.exponent for found in alone]
    assert one[3].state.tolist() == alone[3].state.tolist()


@pytest.mark.parametrize(
    ("model", "words", "options"),
    [
        ("vibro-impact", ["--points", 300], {"points": 300}),
        ("two-sided-rattle", ["--points", 50, "--stop", "stop_upper"], {"points": 50, "stops": ["stop_upper"]}),
        (
            "vibro-impact",
            ["--section", "stroboscopic", "--phase", 0.25, "--points", 40, "--transient", 3],
            {"section": "stroboscopic", "phase": 0.25, "points": 40, "transient": 3},
        ),
        (
            "belt",
            ["--section", "event", "--event", "stick:belt", "--transient", 0, "--points", 5],
            {"section": "event", "event": "stick:belt", "transient": 0, "points": 5},
        ),
    ],
)
def test_poincare_has_the_points_of_the_program(program, model, words, options):
    ran = program("poincare", model, *words)
    assert ran.returncode == 0, ran.stderr
    assert_same_table(slapstick.poincare(model, **options).to_pandas(), program.table(ran.stdout))


@pytest.mark.parametrize(
    ("model", "words", "options"),
    [
        ("vibro-impact", [], {}),
        ("gear-rattle", [], {}),
        ("vibro-impact", ["--stuck", "friction", "--closed", "stop"], {"stuck": "friction", "closed": ["stop"]}),
        ("mode-coupling-brake", ["--closed", "belt", "--set", "friction=0.3"], {"closed": ["belt"], "friction": 0.3}),
    ],
)
def test_modes_have_the_rows_of_the_program(program, model, words, options):
    ran = program("modes", model, *words)
    assert ran.returncode == 0, ran.stderr
    assert_same_table(slapstick.modes(model, **options).to_pandas(), program.table(ran.stdout))


def test_modes_over_a_parameter_are_those_of_its_values(program):
    ran = program("modes", "mode-coupling-brake", "--closed", "belt", "--sweep", "friction=0.1:0.6:3")
    found = slapstick.modes("mode-coupling-brake", closed="belt", friction=(0.1, 0.6, 3))
    assert program.table(ran.stdout)["decay"].tolist() == [decay for one in found for decay in one.decay]


@pytest.mark.parametrize("direction", ["up", "down", "both"])
def test_diagram_has_the_rows_of_the_program(program, direction):
    ran = program("diagram", "vibro-impact", "--sweep", "omega=2.6:5.3:7", "--direction", direction, "--impacts", 20)
    found = slapstick.diagram("vibro-impact", omega=(2.6, 5.3, 7), direction=direction, impacts=20)
    assert_same_table(found.to_pandas(), program.table(ran.stdout))


@pytest.mark.parametrize("count", [50, 99, 1000])
def test_no_value_of_a_long_sweep_is_run_twice_or_left_out(program, count):
    words = ("--sweep", f"omega=0.5:10:{count}", "--transient", 0, "--impacts", 1, "--start", "reset")
    printed = program.table(program("diagram", "vibro-impact", *words).stdout)
    found = slapstick.diagram("vibro-impact", omega=(0.5, 10, count), transient=0, impacts=1, carry=False)
    assert found.value.tolist() == printed["omega"].tolist()
    assert found.w.tolist() == printed["w"].tolist()


def test_a_diagram_of_values_that_are_not_equidistant_is_that_of_each_value():
    values = [2.6, 2.7, 3.3]
    whole = slapstick.diagram("vibro-impact", omega=values, carry=False, impacts=15)
    for value in values:
        alone = slapstick.diagram("vibro-impact", omega=[value, 8.0], carry=False, impacts=15)
        assert whole.w[whole.value == value].tolist() == alone.w[alone.value == value].tolist()


def test_orbit_has_every_number_of_the_program(program):
    words = ("orbit", "vibro-impact", "--set", "omega=2.9", "--orbit", "1-1", "--unstable")
    printed, found = program.json(*words), slapstick.orbit("vibro-impact", "1-1", starts=64, stable=False, omega=2.9)
    assert (found.label, found.n, found.p, found.stable) == (printed["class"], 1, printed["p"], False)
    assert [[mu.real, mu.imag] for mu in found.multipliers] == printed["multipliers"]
    assert found.state.tolist() == list(printed["state"].values())
    assert found.energy == printed["energy"]
    assert found.events.t.tolist() == [event["time"] for event in printed["events"]]
    assert found.events.mode.tolist() == [event["mode_after"] for event in printed["events"]]
    assert [list(row) for row in found.margins] == [list(row.values()) for row in printed["margins"]]
    assert {k: {"min": v[0], "max": v[1]} for k, v in found.extremes.items()} == printed["extremes"]


def test_all_orbits_are_those_of_the_program(program):
    words = ("--set", "omega=2.9", "--all", "--max-n", 2, "--starts", 12)
    printed = program.json("orbit", "vibro-impact", *words)["orbits"]
    found = slapstick.orbits("vibro-impact", most_n=2, starts=12, omega=2.9)
    assert [orbit.label for orbit in found] == [orbit["class"] for orbit in printed]
    assert [orbit.state.tolist() for orbit in found] == [list(orbit["state"].values()) for orbit in printed]


def test_branch_has_every_point_and_special_point_of_the_program(program):
    words = ("--set", "omega=2.2", "--orbit", "1-1", "--param", "omega", "--range", "1:3", "--step", 0.02)
    printed = program.json("continue", "vibro-impact", *words, "--sensitivity", "friction")
    branch = slapstick.continuation("vibro-impact", "omega", (1, 3), orbit="1-1", omega=2.2, step=0.02)
    points = printed["points"]
    assert branch.value.tolist() == [point["param"] for point in points]
    assert branch.cycle.tolist() == [point["period"] for point in points]
    assert branch.label.tolist() == [point["class"] for point in points]
    assert branch.stable.tolist() == [point["stable"] for point in points]
    assert branch.y.T.tolist() == [list(point["state"].values()) for point in points]
    assert branch.ended == printed["ended"]
    assert len(branch.special) == len(printed["special"]) > 3
    for special, of in zip(branch.special, printed["special"]):
        assert (special.type, special.value, special.error) == (of["type"], of["param"], of["error"])
        assert (special.occurrence, special.passage) == (of["occurrence"], of["passage"])
        assert (special.what, special.outcome) == (of["what"], of.get("outcome", ""))
        assert special.coefficient == of.get("coefficient")
        assert special.sensitivity("friction") == of["sensitivity"]["friction"]


def test_locus_has_every_point_of_the_program(program):
    ranges = ("--range", "omega=2.6:3", "--range", "friction=0.1:0.2")
    words = ("--set", "omega=2.7", "--orbit", "1-1", "--params", "omega,friction", *ranges)
    printed = program.json("curve", "vibro-impact", *words)
    curve = slapstick.locus("vibro-impact", "omega", "friction", (2.6, 3), (0.1, 0.2), orbit="1-1", omega=2.7)
    branch = slapstick.continuation("vibro-impact", "omega", (2.6, 3), orbit="1-1", omega=2.7, step=0.02)
    other = branch.special[0].locus("friction", "omega", (0.1, 0.2))
    assert curve.x.tolist() == other.x.tolist() == [point["omega"] for point in printed["points"]]
    assert curve.y.tolist() == [point["friction"] for point in printed["points"]]
    assert curve.ended == printed["ended"]
    assert [met.what for met in curve.met] == [met["what"] for met in printed["met"]]


def test_certificate_is_the_file_of_the_program_and_the_verifier_takes_it(program, tmp_path):
    words = ("simulate", "vibro-impact", "--set", "omega=1.5", "--periods", 20, "--certify", tmp_path / "program.cert")
    printed = program.json(*words)["certificate"]
    found = slapstick.certify("vibro-impact", tmp_path / "python.cert", periods=20, omega=1.5)
    assert (tmp_path / "python.cert").read_bytes() == (tmp_path / "program.cert").read_bytes()
    assert {name: getattr(found, name) for name in printed} == printed
    assert sorted(path.name for path in tmp_path.iterdir()) == ["program.cert", "python.cert"]


def test_measure_and_quantities_have_every_number_of_the_program(program):
    listed = program.json("quantities", "vibro-impact")
    found = slapstick.quantities("vibro-impact")
    assert [(q.name, q.unit, q.kind, q.meaning) for q in found] == [tuple(one.values()) for one in listed]
    words = ("--set", "omega=2.2", "--of", "a1,F_stop,impulse:q50", "--transient", 300)
    printed = program.json("measure", "vibro-impact", *words)
    measured = slapstick.measure("vibro-impact", "a1,F_stop,impulse:q50", transient=300, omega=2.2)
    # repr: of an idle stop the crest factor is nan, and nan is no nan
    assert {name: repr(value) for name, value in measured.items()} == {
        name: repr(float(value)) for name, value in printed["values"].items()
    }
    assert (measured.label, measured.duration) == (printed["over"]["class"], printed["over"]["time"])
    assert len(measured.impacts["stop"].w) == printed["impacts"]["stop"]["number"]


@pytest.mark.parametrize("periods", [0, 256])
def test_spectrum_has_every_line_of_the_program(program, periods):
    words = ("--periods", periods) if periods else ()
    printed = program.json("spectrum", "vibro-impact", "--set", "omega=2.2", "--of", "a1", *words)
    found = slapstick.spectrum("vibro-impact", "a1", periods=periods, omega=2.2)
    rows = printed["points" if periods else "lines"]
    for name in rows[0]:
        assert getattr(found, name).tolist() == [row[name] for row in rows]
    assert found.of_cycle == (printed["kind"] == "lines")


def test_orbit_and_attractor_measure_what_the_program_does(program):
    of = "a1:rms,F_stop:mean,w:number"
    words = ("--set", "omega=2.9", "--of", of)
    printed = program.json("orbit", "vibro-impact", "--orbit", "1-1", "--unstable", *words)
    orbit = slapstick.orbit("vibro-impact", "1-1", starts=64, stable=False, omega=2.9)
    assert dict(orbit.measure(of)) == printed["values"]
    printed = program.json("classify", "vibro-impact", *words)
    assert dict(slapstick.classify("vibro-impact", omega=2.9).measure(of)) == printed["values"]


def test_diagram_of_statistics_has_every_number_of_the_program(program):
    y = "F_friction:rms,x:peak_to_peak"
    words = ("--sweep", "omega=0.5:1.5:5", "--direction", "both", "--y", y, "--periods", 50, "--transient", 100)
    columns = program.table(program("diagram", "coulomb-oscillator", *words).stdout)
    found = slapstick.diagram("coulomb-oscillator", omega=(0.5, 1.5, 5), direction="both", y=y, periods=50, transient=100)
    assert found.value.tolist() == columns["omega"].tolist()
    assert found.direction.tolist() == columns["direction"].tolist()
    assert list(found.measured) == y.split(",")
    for name, column in found.measured.items():
        assert column.tolist() == columns[name].tolist()
    assert list(found.to_pandas().columns) == ["omega", "direction", *y.split(",")]


@pytest.mark.parametrize(("model", "at", "y"), [("coulomb-oscillator", "", "x,F_friction"), ("vibro-impact", "", "x1,w"), ("vibro-impact", "slip+", "x1"),
                                                ("vibro-impact", "period", "v1,kinetic_energy")])
def test_diagram_of_values_at_instants_has_every_number_of_the_program(program, model, at, y):
    words = ["--sweep", "omega=0.5:1.5:5", "--direction", "both", "--y", y, "--impacts", 7, "--transient", 100]
    columns = program.table(program("diagram", model, *words, *(["--at", at] if at else [])).stdout)
    found = slapstick.diagram(model, omega=(0.5, 1.5, 5), direction="both", y=y, at=at, impacts=7, transient=100)
    assert found.value.tolist() == columns["omega"].tolist()
    assert found.direction.tolist() == columns["direction"].tolist()
    for name in y.split(","):
        assert found.measured[name].tolist() == columns[name].tolist()
    assert list(found.to_pandas().columns) == ["omega", "direction", *y.split(",")]


@pytest.mark.parametrize(("section", "words"), [("impact", {}), ("stroboscopic", {"phase": 0.25}), ("event", {"event": "stick"})])
def test_points_have_the_quantities_of_the_program(program, section, words):
    options = [part for name, value in words.items() for part in (f"--{name}", value)]
    printed = program("poincare", "vibro-impact", "--set", "omega=1.5", "--section", section, *options, "--points", 20, "--of", "a1,F_friction")
    columns = program.table(printed.stdout)
    found = slapstick.poincare("vibro-impact", omega=1.5, section=section, points=20, of="a1,F_friction", **words)
    assert list(found.of) == ["a1", "F_friction"]
    for name, column in found.of.items():
        assert column.tolist() == columns[name].tolist() == found.to_pandas()[name].tolist()
    for wrong, said in (("w", "quantity at impacts"), ("a1:rms", "values are wanted")):
        with pytest.raises(slapstick.InputError, match=said):
            slapstick.poincare("vibro-impact", omega=1.5, section=section, of=wrong, **words)


def test_diagram_at_instants_says_what_is_wrong():
    sweep = {"omega": (0.5, 1.5, 3)}
    for y, at, said in (("x1,v1:rms", "", "y: statistics, as 'x1:rms', or values"), ("x1:rms", "stick", "y: statistics"), ("impulse", "", "y: 'impulse' is a quantity at"),
                        ("x1", "bang", "at: "), ("omega", "", "y: 'omega' is a parameter")):
        with pytest.raises(slapstick.InputError, match=said):
            slapstick.diagram("vibro-impact", y=y, at=at, **sweep)


def test_branch_of_statistics_has_every_number_of_the_program(program):
    words = ("--set", "omega=2.7", "--orbit", "1-1", "--param", "omega", "--range", "2.6:2.9", "--y", "F_stop:mean,a1:rms")
    printed = program.json("continue", "vibro-impact", *words)
    branch = slapstick.continuation("vibro-impact", "omega", (2.6, 2.9), orbit="1-1", y="F_stop:mean,a1:rms", omega=2.7)
    for name, column in branch.measured.items():
        assert column.tolist() == [point["values"][name] for point in printed["points"]]
    assert set(branch.measured) == {"F_stop:mean", "a1:rms"}
    assert {"F_stop:mean", "a1:rms"} <= set(branch.to_pandas().columns)
    ax = branch.plot()
    assert ax.get_ylabel() == "F_stop:mean"
    drawn = np.concatenate([line.get_ydata() for line in ax.lines if len(line.get_ydata()) > 1])
    assert set(drawn) == set(branch.measured["F_stop:mean"])


def test_order_map_has_the_table_of_the_program(program):
    words = ("--sweep", "omega=2:3", "--over", 40, "--hold", 8, "--settle", 3, "--of", "a1", "--orders", 4)
    printed = program.table(program("spectrum", "vibro-impact", *words).stdout)
    found = slapstick.order_map("vibro-impact", "a1", "omega", (2, 3), over=40, hold=8, settle=3, orders=4)
    for column, name in (
        (np.repeat(found.value, found.order.size), "omega"),
        (np.repeat(found.time, found.order.size), "time"),
        (found.frequency.T.ravel(), "frequency"),
        (found.amplitude.T.ravel(), "amplitude"),
    ):
        assert same(column, printed[name]), name


def test_derivatives_of_statistics_are_those_of_the_program(program):
    words = ("--set", "omega=2.6", "--of", "x1:rms,w:mean", "--sensitivity", "friction")
    printed = program.json("measure", "vibro-impact", *words)["sensitivity"]["friction"]["values"]
    assert slapstick.measure("vibro-impact", "x1:rms,w:mean", sensitivity="friction", omega=2.6).sensitivity["friction"] == printed


@pytest.mark.parametrize("name", ["vibro-impact", "falling-friction", "gear-rattle", "shaken-belt"])
def test_check_says_what_the_program_says(program, name):
    printed = program.json("check", name)
    del printed["parameters"], printed["units"]
    assert slapstick.load(name).check() == printed


def test_check_refuses_values_that_make_no_motion():
    with pytest.raises(slapstick.InputError, match="mass_ratio"):
        slapstick.load("vibro-impact").check(mass_ratio=-1.0)
