"""basins: which attractor each start of a plane of initial values comes to."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core, _progress
from ._chart_plot import draw_classes
from ._core import InputError
from ._map import Axis, along, axis_of, edges
from ._model import Model, Start, Values, given_to, model_of, numbers, start_of, stops_of
from ._obeys import obeys
from ._progress import Progress
from ._result import Floats, Interrupted, Result, axes

OPTIONS = ("level", "periods", "transient", "most_periods", "most_n", "exponent_periods", "stops", "start", "box", "resume")
UNDECIDED, INADMISSIBLE, FAILED, MISSING = -1, -2, -3, -4
OUTSIDE = {UNDECIDED: "undecided", INADMISSIBLE: "not admissible", FAILED: "failed", MISSING: ""}


class Basin:
    """The starts that come to one attractor.

    name: its class, with a number where several attractors have it; label: '1-1-II', 'equilibrium', ..; attractor: as of
    `Attractor`; n, p: of a cycle, else 0 and NaN; exponent: the largest, per period; multipliers: complex, of a cycle;
    by_class: all that have this class, as what friction holds; state: on the attractor, at phase 0; starts: how many; share:
    of the admissible starts; share_from, share_to: where the share of independent starts lies with 95 % (Wilson).
    """

    def __init__(self, core: _core.Basin, name: str) -> None:
        self.name = name
        self.label: str = core.label
        self.attractor: str = core.attractor
        self.n: int = core.n
        self.p: float = core.p
        self.exponent: float = core.exponent
        self.multipliers: NDArray[np.complex128] = np.array(core.multipliers, dtype=np.complex128)
        self.state: Floats = np.array(core.state, dtype=np.float64)
        self.by_class: bool = core.by_class
        self.starts: int = core.starts
        self.share: float = core.share
        self.share_from: float = core.share_from
        self.share_to: float = core.share_to

    def __repr__(self) -> str:
        return f"Basin({self.name!r}, share={self.share:.4g})"


class Basins(Result):
    """Which attractor the motion from each start of a plane comes to.

    x_name, y_name: the numbers of the state along the axes; x, y: their values, shapes (nx,) and (ny,). basins: a `Basin`
    for each attractor, that with most starts first. of: shape (ny, nx), of each start the place of its basin in `basins`,
    or -1 undecided, -2 forbidden by a stop, -3 failed.
    entropy: the mean basin entropy of boxes of `box` starts a side, boundary_entropy: that of the boxes with several basins,
    NaN if there is none. boxes, boxes_on_boundary: how many there are.
    uncertain: the shares of pairs of starts, `distances` steps apart along an axis, that belong to different basins;
    uncertainty_exponent: the slope of their logarithms, with the standard error of the fit uncertainty_error; the boundary's dimension
    in the plane is 2 - uncertainty_exponent.
    """

    def __init__(self, core: _core.Basins, model: Model, values: dict[str, float], options: dict[str, Any]) -> None:
        super().__init__(model, values, options)
        (self.x_name, *x), (self.y_name, *y) = options["x"], options["y"]
        self.x, self.y = along(x), along(y)
        self.of: NDArray[np.int32] = np.array(core.of).reshape(len(self.y), len(self.x))
        labels = [basin.label for basin in core.basins]
        names = [
            f"{label} ({labels[: i + 1].count(label)})" if labels.count(label) > 1 else label for i, label in enumerate(labels)
        ]
        self.basins: list[Basin] = [Basin(basin, name) for basin, name in zip(core.basins, names)]
        self.box: int = core.box
        self.boxes: int = core.boxes
        self.boxes_on_boundary: int = core.boxes_on_boundary
        self.entropy: float = core.entropy
        self.boundary_entropy: float = core.boundary_entropy
        self.distances: NDArray[np.int64] = np.array(core.distances, dtype=np.int64)
        self.uncertain: Floats = np.array(core.uncertain, dtype=np.float64)
        self.uncertainty_exponent: float = core.uncertainty_exponent
        self.uncertainty_error: float = core.uncertainty_error
        self.failures: list[tuple[int, str]] = core.failures
        self.complete: bool = core.complete

    def __len__(self) -> int:
        return int(self.of.size)

    @property
    def names(self) -> NDArray[np.str_]:
        """The name of each start's basin, shape (ny, nx): 'undecided', 'not admissible' or 'failed' where it has none."""
        known = [OUTSIDE[-i] for i in range(len(OUTSIDE), 0, -1)] + [basin.name for basin in self.basins]
        return np.array(known)[self.of + len(OUTSIDE)]

    def to_pandas(self) -> Any:
        """A DataFrame with the columns of `slapstick basins --table`: a row for each start; basin 0 is none."""
        import pandas as pd

        words = ["not-computed", "failed", "not-admissible", "undecided"] + [basin.label for basin in self.basins]
        x, y = np.meshgrid(self.x, self.y)
        of = self.of.ravel()
        table = {"x": x.ravel(), "y": y.ravel(), "basin": np.maximum(of + 1.0, 0.0)}
        return pd.DataFrame(table | {"class": np.array(words)[of + len(OUTSIDE)]})

    def to_xarray(self) -> Any:
        """A Dataset over both initial values: `basin`, its place in `basins`, and `name`."""
        import xarray as xr

        over = (self.y_name, self.x_name)
        about = {"model": self.model.name, "version": self.version} | self.parameters
        data = {"basin": (over, self.of), "name": (over, self.names)}
        return xr.Dataset(data, coords={self.y_name: self.y, self.x_name: self.x}, attrs=about)

    def plot(self, ax: Any = None) -> Any:
        """Draws the basins with their shares of all starts, and where equilibria and cycles are on the plane. Returns the axes."""
        ax = axes(ax)
        draw_classes(ax, self.names, (*edges(self.x), *edges(self.y)))
        ax.set_xlabel(f"initial {self.x_name}")
        ax.set_ylabel(f"initial {self.y_name}")
        places = [self.model.state_names.index(name) for name in (self.x_name, self.y_name)]
        for basin, marker in zip(self.basins, "os^vD"):
            if basin.attractor in ("periodic", "equilibrium"):
                x, y = basin.state[places]
                ax.plot(x, y, marker, markersize=5, markerfacecolor="none", color="black", scalex=False, scaley=False)
        return ax

    def _facts(self) -> list[tuple[str, str]]:
        facts = [("starts", f"{len(self.x)} x {len(self.y)} of {self.x_name}, {self.y_name}")]
        facts += [("basins", ", ".join(f"{basin.name} {basin.share:.1%}" for basin in self.basins[:3]))]
        undecided = int(np.count_nonzero(self.of == UNDECIDED))
        return facts + ([("undecided", str(undecided))] if undecided else [])


@obeys("basins")
def basins(
    model: Model | str | os.PathLike[str],
    x: Axis,
    y: Axis,
    *,
    level: str = "quick",
    periods: int = 300,
    transient: int = 500,
    most_periods: int = 20000,
    most_n: int = 64,
    exponent_periods: int = 4000,
    stops: str | Sequence[str] = (),
    start: Start = None,
    box: int = 5,
    store: str | os.PathLike[str] = "",
    resume: bool = False,
    threads: int = 0,
    progress: Progress = None,
    parameters: Values | None = None,
    **values: Any,
) -> Basins:
    """Basins of attraction: which attractor the motion from each start of a plane comes to, on all cores.

    x, y: (VAR, A, B, COUNT), numbers of the state, as 'x1' or 'v1', both ends included; the others are those of `start`.
    level: 'quick', a cycle that Newton's method confirms in `periods`, or undecided; 'full', as `slapstick.classify`.
    box: side in starts of the boxes of the entropy. store: a file that takes every start as it is finished and that the
    program reads too; with `resume` what is there is not computed again.

    Raises InputError before the work. A start that fails is in `failures`, and a RuntimeWarning. Source:
    docs/howto/basins.md.

    >>> import slapstick
    >>> found = slapstick.basins("vibro-impact", ("x1", -0.6, 0, 9), ("v1", -1, 1, 8), omega=2.82)
    >>> [(basin.name, basin.starts) for basin in found.basins]
    [('1-1-I', 44), ('4-3-II', 28)]
    """
    options = options_of(locals())
    chosen = model_of(model)
    fixed = numbers(given_to(basins, chosen, values, parameters))
    arguments = (chosen._core, fixed, start_of(start), wish_of(options, threads), int(box))
    total = float(options["x"][3] * options["y"][3])
    core = _progress.run(_core.basins, arguments, "starts", total, progress)
    return reported(Basins(core, chosen, fixed, options))


def options_of(given: dict[str, Any]) -> dict[str, Any]:
    """What a Basins keeps of its call. Raises InputError."""
    if given["box"] < 2:
        raise InputError(f"box: {given['box']!r} is below 2")
    if given["resume"] and not given["store"]:
        raise InputError("resume: it needs store")
    axes_of = {name: axis_of(name, given[name]) for name in ("x", "y")}
    return {name: given[name] for name in OPTIONS} | axes_of | {"store": os.fspath(given["store"])}


def wish_of(options: dict[str, Any], threads: int) -> _core.MapWish:
    """What the extension is asked for."""
    wish = _core.MapWish()
    (wish.x_name, *_), (wish.y_name, *_) = options["x"], options["y"]
    wish.x, wish.y = options["x"][1:], options["y"][1:]
    for name in ("level", "periods", "transient", "most_periods", "most_n", "exponent_periods", "store", "resume"):
        setattr(wish, name, options[name])
    wish.stops, wish.threads = stops_of(options["stops"]), threads
    return wish


def reported(found: Basins) -> Basins:
    """Says what the picture cannot."""
    if not found.complete:
        raise Interrupted(found)
    if np.all(found.of == INADMISSIBLE):
        raise InputError("x, y: the stops forbid every start of the plane")
    if found.failures:
        pixel, why = found.failures[0]
        where = f"{found.x_name} = {found.x[pixel % len(found.x)]:g}, {found.y_name} = {found.y[pixel // len(found.x)]:g}"
        warnings.warn(f"{len(found.failures)} starts failed, first {where}: {why}", RuntimeWarning, stacklevel=4)
    return found
