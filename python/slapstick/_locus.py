"""locus: a special point followed in two parameters."""

from __future__ import annotations

import os
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core, _progress
from ._branch import continuation, range_of
from ._core import InputError, NumericalError
from ._followed import Followed, finished
from ._model import Model
from ._obeys import obeys
from ._progress import Progress
from ._result import Given, axes
from ._special import SpecialPoint

BRANCH_STEP, BRANCH_POINTS = 0.02, 1000  # of the branch on which `slapstick curve` seeks its point


class Meeting(NamedTuple):
    """What else happens at a point of a locus: a point of codimension two."""

    type: str
    values: tuple[float, float]
    what: str
    after: int


class Locus(Followed):
    """A curve of special points in two parameters.

    type: of the points; names: of both parameters; x, y: their values, shape (k,); is_motion: where the orbit is a
    motion, shape (k,). met: the points of codimension two on the way. ended: why, in words.
    `locus[i]` is the orbit of a point.
    """

    def __init__(
        self, core: _core.Locus, kind: str, model: Model, values: dict[str, float], options: dict[str, Any]
    ) -> None:
        super().__init__(core, model, values, options)
        self.type = kind
        self._free = tuple(core.parameters)

    _core: _core.Locus
    names = Given[list[str]]("Of both parameters.", name="parameters")

    @cached_property
    def x(self) -> NDArray[np.float64]:
        return self._core.values(0)

    @cached_property
    def y(self) -> NDArray[np.float64]:
        return self._core.values(1)

    @property
    def met(self) -> list[Meeting]:
        return [Meeting(kind, (x, y), what, after) for kind, x, y, what, after in self._core.met]

    def to_pandas(self) -> Any:
        """A DataFrame: both parameters and is_motion, a row for each point."""
        import pandas as pd

        return pd.DataFrame({self.names[0]: self.x, self.names[1]: self.y, "is_motion": self.is_motion})

    def to_xarray(self) -> Any:
        """A Dataset over `point` with the same columns."""
        import xarray as xr

        about = {"model": self.model.name, "version": self.version, "type": self.type, "ended": self.ended}
        columns = {self.names[0]: self.x, self.names[1]: self.y, "is_motion": self.is_motion}
        return xr.Dataset({name: ("point", column) for name, column in columns.items()}, attrs=about)

    def plot(self, ax: Any = None) -> Any:
        """Draws the curve where the orbit is a motion, and names what is met on it. Returns the axes."""
        ax = axes(ax)
        ax.plot(np.where(self.is_motion, self.x, np.nan), self.y, color="0.1", linewidth=1.2, label=self.type)
        for met in self.met:
            if not self.is_motion[met.after]:
                continue
            ax.plot(*met.values, "o", color="#d55e00", markersize=4)
            ax.annotate(met.type, met.values, (4, 4), textcoords="offset points", color="#d55e00")
        ax.set_xlabel(self.names[0])
        ax.set_ylabel(self.names[1])
        ax.legend(frameon=False)
        return ax

    def _facts(self) -> list[tuple[str, str]]:
        met = ", ".join(f"{met.type} ({met.values[0]:.6g}, {met.values[1]:.6g})" for met in self.met)
        return [("type", self.type), ("points", str(len(self))), ("met", met or "nothing"), ("ended", self.ended)]


TYPES = ("LP", "PD", "NS", "BP", "GR", "SL", "CH", "CO")


@obeys("curve")
def locus(
    model: Model | str | os.PathLike[str],
    first: str,
    second: str,
    between: tuple[float, float] | None = None,
    second_between: tuple[float, float] | None = None,
    *,
    type: str = "PD",
    which: int = 1,
    step: float = 0.01,
    points: int = 500,
    progress: Progress = None,
    **options: Any,
) -> Locus:
    """The locus of a special point: found along the first parameter as by `continuation`, then followed in both.

    type, which: the K-th point of that type along the branch. step: the longest step, as a part of the ranges; points:
    most points each way. The other options and the parameters are those of `continuation`.
    `branch.special[i].locus(...)` does the same from a branch that is there already.

    Raises NumericalError if the branch has no such point.

    >>> import slapstick
    >>> curve = slapstick.locus("vibro-impact", "omega", "friction", (2.6, 3), (0.1, 0.2), orbit="1-1", omega=2.7)
    >>> len(curve) > 10, curve.ended
    (True, 'down: range; up: range')
    """
    for name in ("same_events", "y"):
        if name in options:
            raise InputError(f"{name}: not an option of locus")
    if type not in TYPES:
        raise InputError(f"type = {type!r} is not one of " + ", ".join(TYPES))
    branch = continuation(model, first, between, step=BRANCH_STEP, points=BRANCH_POINTS, progress=progress, **options)
    points_of_type = [point for point in branch.special if point.type == type]
    if len(points_of_type) < which:
        seen = ", ".join(f"{point.type} at {point.value:g}" for point in branch.special)
        raise NumericalError(f"locus: no {type} on the branch in {first} (found: {seen or 'none'}; {branch.ended})")
    return follow_special(
        points_of_type[which - 1],
        second,
        (branch._core.begin, branch._core.end),
        second_between,
        step=step,
        points=points,
        progress=progress,
    )


def follow_special(
    special: SpecialPoint,
    second: str,
    between: tuple[float, float],
    second_between: tuple[float, float] | None,
    *,
    step: float = 0.01,
    points: int = 500,
    progress: Progress = None,
) -> Locus:
    begin, end = range_of(special.model, special.parameter, between)
    lower, upper = range_of(special.model, second, second_between)
    options: dict[str, Any] = {
        "parameters": (special.parameter, second),
        "between": (begin, end),
        "second_between": (lower, upper),
    }
    options |= {"step": step, "points": points}
    arguments = (special._core, second, begin, end, lower, upper, step, points)
    core = _progress.run(_core.locus, arguments, "points at most", 2 * points, progress)
    return finished(Locus(core, special.type, special.model, special.orbit._values, options), "locus", 4)
