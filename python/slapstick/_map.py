"""map: what the motion is over two parameters."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core, _progress
from ._chart_plot import CURVE_STYLES, draw_classes, draw_inset
from ._core import InputError
from ._model import Model, Start, Values, given_to, model_of, number, numbers, start_of, stops_of
from ._obeys import obeys
from ._progress import Progress
from ._quantity import statistics_of
from ._result import Floats, Interrupted, Result, axes
from ._tables import words

Axis = tuple[str, float, float, int]
WORDS = ("label", "attractor", "chatter", "doubt")
OPTIONS = (
    *("level", "carry", "direction", "starts", "seed", "periods", "transient", "most_periods", "most_n"),
    *("exponent_periods", "of", "measured_periods", "stops", "start", "refine", "resume", "shard"),
)
NUMBERS = ("pixel", "n", "p", "starts", "exponent")


@dataclass(frozen=True)
class ChartCurve:
    """A bifurcation curve behind a boundary of a chart.

    type: 'PD', 'LP', ..; from_class, to_class: of the two pixels between which it was found; x, y: its points that are
    motions, shape (k,), NaN between pieces; edges: that it explains, and no curve before; differ, alike: places along
    the curve, a pixel apart, at which the pixels on both sides differ, or are alike.
    """

    type: str
    from_class: str
    to_class: str
    x: Floats
    y: Floats
    edges: int
    differ: int
    alike: int


@dataclass(frozen=True)
class ChartCurves:
    """The bifurcation curves of a chart, and what is left: edges of the whole chart with a cycle on one side at least,
    those explained by some curve, and those tried without one."""

    curves: list[ChartCurve]
    edges: int
    explained: int
    without: int

    def plot(self, ax: Any = None) -> Any:
        """Draws the curves, a style for each type as `slapstick map --curves` has it: on the axes of a chart, which
        `Map.plot` returns. Returns the axes."""
        ax = axes(ax)
        named: set[str] = set()
        for curve in self.curves:
            dash, colour = CURVE_STYLES.get(curve.type, ("-", "#0000aa"))
            ax.plot(curve.x, curve.y, color="white", linewidth=1.9, scalex=False, scaley=False)
            label = None if curve.type in named else curve.type
            ax.plot(curve.x, curve.y, dash, color=colour, linewidth=0.8, label=label, scalex=False, scaley=False)
            named.add(curve.type)
        return ax


class Map(Result):
    """What the motion is at every pixel of a chart, as columns of shape (k,): a row for each motion that was found.

    x_name, y_name: the parameters; x, y: their values along the axes, shapes (nx,) and (ny,). pixel: iy * nx + ix.
    label: '1-1-II', 'chaotic', ..; attractor, chatter, doubt: as of `Attractor`; n, p: of a cycle, else 0 and NaN;
    sticking; exponent: the largest, per period, NaN where none is known; multiplier: the largest of a cycle, complex;
    computed: False where a refined chart has filled in what the pixels around have in common, and numbers are NaN;
    starts: how many lead there; direction: 'up' or 'down', as the state was carried; measured: "Q:STAT" to its column.
    `grid(column)` is a column as a picture, shape (ny, nx).
    """

    def __init__(
        self,
        columns: dict[str, Any],
        model: Model,
        values: dict[str, float],
        options: dict[str, Any],
        core: _core.Map | None = None,
    ) -> None:
        super().__init__(model, values, options)
        (self.x_name, *x), (self.y_name, *y) = options["x"], options["y"]
        self._free = (self.x_name, self.y_name)
        #: Values along the axes, shapes (nx,) and (ny,).
        self.x, self.y = along(x), along(y)
        self._columns = columns
        self.failures: list[tuple[int, str]] = columns["failures"]
        self.complete: bool = columns["complete"]
        self.measured: dict[str, Floats] = columns["measured"]
        self.pixel: NDArray[np.int32] = columns["pixel"]
        self.label: NDArray[np.str_] = columns["label"]
        self.attractor: NDArray[np.str_] = columns["attractor"]
        self.chatter: NDArray[np.str_] = columns["chatter"]
        self.doubt: NDArray[np.str_] = columns["doubt"]
        self.direction: NDArray[np.str_] = columns["direction"]
        self.n: NDArray[np.int32] = columns["n"]
        self.p: Floats = columns["p"]
        self.starts: NDArray[np.int32] = columns["starts"]
        self.sticking: NDArray[np.bool_] = columns["sticking"]
        self.computed: NDArray[np.bool_] = columns["computed"]
        self._core = core
        self.exponent: Floats = columns["exponent"]
        self.multiplier: NDArray[np.complex128] = columns["multiplier"]

    def __len__(self) -> int:
        return len(self.pixel)

    @cached_property
    def _first(self) -> NDArray[np.intp]:
        """Of each direction and pixel the row with most starts."""
        place = self.pixel + (self.direction == "down") * (len(self.x) * len(self.y))
        return np.unique(place, return_index=True)[1]

    def grid(self, column: Any, direction: str = "") -> NDArray[Any]:
        """A column as shape (ny, nx): of several attractors of a pixel the one with most starts. What is missing is NaN,
        an empty word or 0. direction: of a chart that was carried both ways."""
        column = np.asarray(column)
        if column.shape != self.pixel.shape:
            raise InputError("grid: a column of the chart is wanted, as chart.label or chart.measured['x1:rms']; no name, and no part")
        rows = self._first
        rows = rows[self.direction[rows] == (direction or self.direction[0])] if len(rows) else rows
        empty: Any = np.nan if column.dtype.kind in "fc" else 0
        picture = np.full(len(self.x) * len(self.y), "" if column.dtype.kind == "U" else empty, dtype=column.dtype)
        picture[self.pixel[rows]] = column[rows]
        return picture.reshape(len(self.y), len(self.x))

    def curves(self, most: int = 10, progress: Progress = None) -> ChartCurves:
        """Up to `most` bifurcation curves over the chart, found from its own boundaries, as `slapstick map --curves`.

        Of a chart without carry and starts that `slapstick.map` has made. Raises InputError.
        """
        if self._core is None:
            raise InputError("curves: the chart must be of slapstick.map itself, not of slapstick.dask")
        found = _progress.run(self._core.curves, (int(most),), "curves", float(most), progress)
        names = ("type", "from_class", "to_class", "x", "y", "edges", "differ", "alike")
        curves = [ChartCurve(**{name: getattr(curve, name) for name in names}) for curve in found.curves]
        return ChartCurves(curves, found.edges, found.explained, found.without)

    def to_pandas(self) -> Any:
        """A DataFrame with the columns of `slapstick map`."""
        import pandas as pd

        table = {"x": self.x[self.pixel % len(self.x)], "y": self.y[self.pixel // len(self.x)], "class": self.label}
        table |= {"attractor": self.attractor, "n": self.n, "p": self.p, "chatter": self.chatter}
        table |= {"exponent": self.exponent, **self.measured}
        table |= {"multiplier_re": self.multiplier.real, "multiplier_im": self.multiplier.imag}
        table |= {"sticking": self.sticking.astype(float), "doubt": self.doubt}
        if self.options["direction"] == "both":
            table |= {"direction": self.direction}
        if self.options["starts"]:
            table |= {"starts": self.starts}
        if self.options.get("refine"):
            table |= {"computed": self.computed.astype(float)}
        return pd.DataFrame(table)

    def to_xarray(self) -> Any:
        """A Dataset over both parameters. A chart that was carried both ways has `direction` as a third dimension."""
        import xarray as xr

        columns: dict[str, Any] = {"class": self.label, "attractor": self.attractor, "n": self.n, "p": self.p}
        columns |= {"chatter": self.chatter, "exponent": self.exponent, "multiplier": np.abs(self.multiplier)}
        columns |= {"sticking": self.sticking, "computed": self.computed, **self.measured}
        ways = ["up", "down"] if self.options["direction"] == "both" else [self.options["direction"]]
        data = {
            name: (("direction", self.y_name, self.x_name), np.stack([self.grid(column, way) for way in ways]))
            for name, column in columns.items()
        }
        about = {"model": self.model.name, "version": self.version}
        found = xr.Dataset(data, coords={"direction": ways, self.y_name: self.y, self.x_name: self.x}, attrs=about)
        return found if len(ways) > 1 else found.isel(direction=0, drop=True)

    def plot(
        self, ax: Any = None, column: str = "class", direction: str = "", inset: Sequence[float] | None = None
    ) -> Any:
        """Draws 'class', 'exponent', 'multiplier' (its modulus), 'n', 'p' or a "Q:STAT" of `measured` over both parameters.
        inset: (x from, x to, y from, y to), which is shown enlarged in a corner that does not cover it; the axes have it
        as their last `child_axes`. Returns the axes. Raises InputError for another column, and for an inset that shows nothing."""
        ax = axes(ax)
        extent = (*edges(self.x), *edges(self.y))
        if column == "class":
            draw_classes(ax, self.grid(self.label, direction), extent)
        else:
            numbers = {"exponent": self.exponent, "multiplier": np.abs(self.multiplier), "p": self.p, **self.measured}
            numbers["n"] = np.where(self.n > 0, self.n, np.nan)
            if column not in numbers:
                raise InputError(f"column: {column!r} is not one of class, " + ", ".join(numbers))
            values = numbers[column]
            shown = ax.imshow(self.grid(values, direction), origin="lower", extent=extent, aspect="auto", cmap="cividis")
            ax.figure.colorbar(shown, ax=ax, label=column)
        ax.set_xlabel(self._with_unit(self.x_name))
        ax.set_ylabel(self._with_unit(self.y_name))
        if inset is not None:
            draw_inset(ax, inset)
        return ax

    def _with_unit(self, name: str) -> str:
        """The name of an axis, with the unit that the model states for that parameter."""
        units = {row[0]: row[2] for row in self.model.parameters._table()}
        return f"{name} [{units[name]}]" if units.get(name, "1") not in ("1", "") else name

    def _facts(self) -> list[tuple[str, str]]:
        names, areas = np.unique(self.label, return_counts=True)
        largest = sorted(zip(areas.tolist(), names.tolist()), reverse=True)[:3]
        facts = [("pixels", f"{len(self.x)} x {len(self.y)} of {self.x_name}, {self.y_name}")]
        facts += [("classes", ", ".join(f"{name} {area / max(len(self), 1):.0%}" for area, name in largest))]
        return facts + ([("failed", str(len(self.failures)))] if self.failures else [])


def along(axis: Sequence[Any]) -> Floats:
    begin, end, count = axis
    return np.array([_core.sweep_value(float(begin), float(end), int(count), i) for i in range(int(count))])


def edges(values: Floats) -> tuple[float, float]:
    half = (values[-1] - values[0]) / (2 * (len(values) - 1))
    return float(values[0] - half), float(values[-1] + half)


def axis_of(argument: str, axis: Any) -> Axis:
    """(NAME, A, B, COUNT) with A < B. Raises InputError."""
    if not isinstance(axis, (tuple, list)) or len(axis) != 4 or not isinstance(axis[0], str):
        raise InputError(f"{argument}: {axis!r} is not of the form (NAME, A, B, COUNT)")
    begin, end, count = (number(argument, value) for value in axis[1:])
    if count < 2 or count != int(count) or not begin < end:
        raise InputError(f"{argument}: {axis!r} is not of the form (NAME, A, B, COUNT) with A < B and COUNT at least 2")
    return axis[0], begin, end, int(count)


def columns_of(core: _core.Map, measured: list[str]) -> dict[str, Any]:
    """The columns that a Map is made of."""
    columns: dict[str, Any] = {name: getattr(core, name) for name in NUMBERS}
    columns |= {name: words(getattr(core, name + "_names"), getattr(core, name + "_codes")) for name in WORDS}
    columns |= {"direction": words(("up", "down"), core.direction_codes), "sticking": core.sticking.view(np.bool_)}
    columns |= {"computed": core.computed.view(np.bool_)}
    columns |= {"multiplier": core.multiplier_re + 1j * core.multiplier_im, "failures": core.failures}
    return columns | {"measured": {word: core.measured(k) for k, word in enumerate(measured)}, "complete": core.complete}


def merged(parts: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """The columns of shards, in any order, as those of the whole."""
    first = parts[0]
    plain = [name for name in first if name not in ("measured", "failures", "complete")]
    columns = {name: np.concatenate([part[name] for part in parts]) for name in plain}
    measured = {name: np.concatenate([part["measured"][name] for part in parts]) for name in first["measured"]}
    order = np.lexsort((columns["pixel"], columns["direction"] == "down"))
    whole: dict[str, Any] = {name: column[order] for name, column in columns.items()}
    whole |= {"measured": {name: column[order] for name, column in measured.items()}}
    failures = sorted(failure for part in parts for failure in part["failures"])
    return whole | {"failures": failures, "complete": all(part["complete"] for part in parts)}


@obeys("map", shard="")  # a shard may be kept elsewhere
def map(  # noqa: A001 (the verb is called so)
    model: Model | str | os.PathLike[str],
    x: Axis,
    y: Axis,
    *,
    level: str = "quick",
    carry: bool = False,
    direction: str = "up",
    starts: int = 0,
    seed: int = 1,
    periods: int = 300,
    transient: int = 500,
    most_periods: int = 20000,
    most_n: int = 64,
    exponent_periods: int = 4000,
    of: str | Sequence[str] = (),
    measured_periods: int = 100,
    stops: str | Sequence[str] = (),
    start: Start = None,
    refine: int = 0,
    store: str | os.PathLike[str] = "",
    resume: bool = False,
    shard: tuple[int, int] = (1, 1),
    threads: int = 0,
    progress: Progress = None,
    parameters: Values | None = None,
    **values: Any,
) -> Map:
    """A chart over two parameters: what the motion is at every pixel, on all cores.

    x, y: (NAME, A, B, COUNT), both ends included. level: 'quick', a cycle that Newton's method confirms in `periods`, or
    undecided; 'full', as `slapstick.classify`. carry: a pixel begins where its neighbour in the row ended up, in `direction`
    'up', 'down' or 'both'. starts: so many motions at every pixel, the first from the model's own start, the others random.
    of: "Q:STAT,..": statistics over the cycle, or where there is none over `measured_periods`. refine: N: every N-th pixel of
    every N-th row, and else only where classes differ; the others are filled in. store: a file that takes every tile as it is
    finished and that the program reads too; with `resume` what is there is not computed again. shard: (I, N): every N-th tile.

    Raises InputError before the work. A pixel that fails is labelled 'failed', in `failures`, and a RuntimeWarning.

    >>> import slapstick
    >>> chart = slapstick.map("vibro-impact", ("omega", 1.5, 2.5, 3), ("friction", 0.1, 0.2, 2))
    >>> chart.grid(chart.label).tolist()
    [['1-1-II', '1-1-I', '1-1-I'], ['1-1-II', '1-1-I', '1-1-I']]
    """
    options = options_of(locals())
    chosen = model_of(model)
    fixed = numbers(given_to(map, chosen, values, parameters))
    wish, measured = wish_of(options, chosen, fixed, threads)
    core = _progress.run(_core.map, (chosen._core, fixed, start_of(start), wish), "pixels", total_of(options), progress)
    return reported(Map(columns_of(core, measured), chosen, fixed, options, core))


def options_of(given: dict[str, Any]) -> dict[str, Any]:
    """What a Map keeps of its call. Raises InputError for an axis that is none."""
    axes_of = {name: axis_of(name, given[name]) for name in ("x", "y")}
    return {name: given[name] for name in OPTIONS} | axes_of | {"store": os.fspath(given["store"])}


def total_of(options: dict[str, Any]) -> float:
    """Pixels of all directions and of the shard."""
    both = 2 if options["direction"] == "both" else 1
    return float(options["x"][3] * options["y"][3] * both // options["shard"][1])


def wish_of(
    options: dict[str, Any], chosen: Model, fixed: dict[str, float], threads: int
) -> tuple[_core.MapWish, list[str]]:
    """What the extension is asked for, and the words of `of`. Raises InputError."""
    (x_name, *x), (y_name, *y) = options["x"], options["y"]
    if x_name == y_name or x_name in fixed or y_name in fixed:
        raise InputError(f"x, y: two different parameters that have no other value are wanted, not {x_name}, {y_name}")
    if options["carry"] and options["starts"]:
        raise InputError("starts: with carry=True a pixel has the start that it is handed")
    if options["direction"] != "up" and not options["carry"]:
        raise InputError("direction: only for carry=True")
    wanted = statistics_of("of", options["of"], chosen, fixed | {x_name: x[0], y_name: y[0]}) if options["of"] else []
    wish = _core.MapWish()
    wish.x_name, wish.y_name, wish.x, wish.y = x_name, y_name, tuple(x), tuple(y)
    wish.rule = "carry" if options["carry"] else "random" if options["starts"] else "reset"
    for name in ("level", "direction", "periods", "seed", "transient", "most_periods", "most_n", "exponent_periods"):
        setattr(wish, name, options[name])
    wish.measured_periods, wish.stops = options["measured_periods"], stops_of(options["stops"])
    wish.starts, wish.threads = options["starts"] or 2, threads
    wish.of, wish.statistics = [quantity for quantity, _ in wanted], [name for _, name in wanted]
    wish.refine, wish.store, wish.resume = options["refine"], options["store"], options["resume"]
    if options["resume"] and not options["store"]:
        raise InputError("resume: it needs store")
    wish.shard, wish.shards = options["shard"][0] - 1, options["shard"][1]
    return wish, [f"{quantity.name}:{name}" for quantity, name in wanted]


def reported(found: Map) -> Map:
    """Says what the columns cannot."""
    if not found.complete:
        raise Interrupted(found)
    if found.failures:
        pixel, why = found.failures[0]
        where = f"{found.x_name} = {found.x[pixel % len(found.x)]:g}, {found.y_name} = {found.y[pixel // len(found.x)]:g}"
        warnings.warn(f"{len(found.failures)} pixels failed, first {where}: {why}", RuntimeWarning, stacklevel=4)
    return found
