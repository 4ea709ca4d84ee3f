"""continuation: orbits followed in a parameter, with every point at which something changes."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core, _progress
from ._core import InputError
from ._followed import Followed, finished
from ._model import Model, Start, Values, given_to, model_of, numbers, start_of
from ._obeys import obeys
from ._orbit import Orbit, wish_of
from ._progress import Progress
from ._quantity import Measured, statistics_of
from ._result import Floats, Given, GivenTruths, axes
from ._special import SpecialPoint
from ._tables import html_table

COLOURS = {"LP": "#d55e00", "PD": "#cc79a7", "NS": "#e69f00", "BP": "#000000"}


class Branch(Followed):
    """Orbits along a branch, as columns of shape (k,).

    parameter: its name; value: its value; cycle: the period of the orbit; label: its class; stable, is_motion: bool.
    y: states at phase 0, shape (2 n, k). multipliers: a list of k arrays. special: the special points.
    ended: why the branch ends at either side, in words; failed: whether what is beyond is not known.
    `branch[i]` is the orbit of a point.
    """

    def __init__(self, core: _core.Branch, model: Model, values: dict[str, float], options: dict[str, Any]) -> None:
        super().__init__(core, model, values, options)
        self._free = (core.parameter,)

    _core: _core.Branch
    parameter = Given[str]("The name of the parameter.")
    value = Given[Floats]("Of the parameter, shape (k,).")
    cycle = Given[Floats]("The period of the orbit in the model's unit of time, shape (k,).")
    stable = GivenTruths("Shape (k,).")

    @cached_property
    def label(self) -> NDArray[np.str_]:
        return np.array(self._core.labels, dtype=np.str_)

    y = Given[Floats]("States at phase 0, in the model's units, shape (2 n, k).", name="state")

    def measure(self, of: str | Sequence[str]) -> dict[str, Floats]:
        """Statistics over the cycle of each orbit, stable or not: "Q:STAT" to a column of shape (k,).

        of: "Q[:STAT],.." or a list of such words, as of `slapstick.measure`.
        """
        rows: list[Measured] = [self[i].measure(of) for i in range(len(self))]
        return {name: np.array([row[name] for row in rows]) for name in (rows[0] if rows else ())}

    @cached_property
    def measured(self) -> dict[str, Floats]:
        """What `y` of `continuation` asked for, as of `measure`; empty if it was not given."""
        return self.measure(self.options["y"]) if self.options.get("y") else {}

    @cached_property
    def multipliers(self) -> list[NDArray[np.complex128]]:
        return [np.array(point, dtype=np.complex128) for point in self._core.multipliers]

    @cached_property
    def special(self) -> list[SpecialPoint]:
        between = (self._core.begin, self._core.end)
        specials = (self._core.special(i) for i in range(self._core.special_count))
        return [SpecialPoint(core, self.parameter, between, self.model) for core in specials]

    def to_pandas(self) -> Any:
        """A DataFrame: a row for each point, with its class, period, stability and state at phase 0."""
        import pandas as pd

        names = {self.parameter: self.value, "class": self.label, "period": self.cycle, "stable": self.stable}
        names |= {"is_motion": self.is_motion} | dict(zip(self.model.state_names, self.y))
        return pd.DataFrame(names | self.measured)

    def to_xarray(self) -> Any:
        """A Dataset over `point` with the same columns."""
        import xarray as xr

        table = self.to_pandas()
        about = {"model": self.model.name, "version": self.version, "ended": self.ended}
        return xr.Dataset({name: ("point", table[name].to_numpy()) for name in table}, attrs=about)

    def plot(self, ax: Any = None) -> Any:
        """Draws the first statistic of `y` along the branch, or without one the impact speeds. Returns the axes.

        Stable orbits are solid, and special points are marked.
        """
        ax = axes(ax)
        name, column = next(iter(self.measured.items()), ("", np.array([])))
        for of, speeds in self._pieces():
            stable = bool(self.stable[of[0]])
            style = {"color": "0.1" if stable else "0.5", "linestyle": "-" if stable else "--", "linewidth": 1.2}
            ax.plot(self.value[of], column[of] if name else speeds, **style)
        near = 0.04 * (self._core.end - self._core.begin)  # labels so close to one another are stacked
        last, height = float("-inf"), 0
        for special in sorted(self.special, key=lambda point: point.value):
            height = height + 1 if special.value - last < near else 0
            last = special.value
            self._mark(ax, special, name, 5 + 10 * height)
        ax.set_xlabel(self.parameter)
        ax.set_ylabel(name or "w just before the impact")
        return ax

    def _pieces(self) -> Iterator[tuple[NDArray[np.int64], NDArray[np.float64]]]:
        """Runs of points with the same stability and number of impacts, and their speeds (points x impacts)."""
        point, w, _ = self._core.impacts
        first = np.searchsorted(point, np.arange(len(self) + 1))
        kinds = [(bool(s), int(n), str(c)) for s, n, c in zip(self.stable, np.diff(first), self.label)]
        begin = 0
        for i in range(1, len(self) + 1):
            if i < len(self) and kinds[i] == kinds[begin]:
                continue
            # A change of stability alone leaves no gap: the next point ends this piece too.
            end = i + 1 if i < len(self) and kinds[i][1:] == kinds[begin][1:] else i
            of = np.arange(begin, end)
            yield of, w[first[begin] : first[end]].reshape(end - begin, kinds[begin][1])
            begin = i

    def _mark(self, ax: Any, special: SpecialPoint, name: str, above: int) -> None:
        events = special.orbit.events
        w = events.w[np.isin(events.kind, ("impact", "engage"))]
        if name:
            w = np.array([special.orbit.measure(name)[name]])
        if len(w) == 0:
            return
        colour = COLOURS.get(special.type, "#0072b2")
        ax.plot([special.value], [w.max()], "o", color=colour, markersize=4, zorder=3)
        style = {"textcoords": "offset points", "ha": "center", "color": colour, "fontsize": "small"}
        ax.annotate(special.type, (special.value, w.max()), (0, above), **style)

    def _facts(self) -> list[tuple[str, str]]:
        kinds = ", ".join(f"{point.type} {point.value:.8g}" for point in self.special[:12])
        more = f" and {len(self.special) - 12} more" if len(self.special) > 12 else ""
        return [("points", str(len(self))), ("special", (kinds or "none") + more), ("ended", self.ended)]

    def _repr_html_(self) -> str:
        rows = [(point.type, f"{point.value:.10g}", point.what, point.outcome) for point in self.special]
        return super()._repr_html_() + html_table(("type", self.parameter, "what", "outcome"), rows)


@obeys("continue")
def continuation(
    model: Model | str | os.PathLike[str],
    parameter: str,
    between: tuple[float, float] | None = None,
    *,
    orbit: str = "",
    step: float = 0.01,
    points: int = 2000,
    same_events: bool = False,
    y: str | Sequence[str] = (),
    stable: bool | None = None,
    symmetric: bool | None = None,
    nearest: bool = False,
    transient: int = 500,
    starts: int = 0,
    seconds: float = 0.0,
    seed: int = 1,
    start: Start = None,
    progress: Progress = None,
    parameters: Values | None = None,
    **values: float,
) -> Branch:
    """The branch of periodic orbits through one orbit, followed both ways in a parameter or group.

    between: the range of the parameter; left out, the range that the model gives. The first orbit is sought at the
    parameter's present value (`omega=2.2`), as by `slapstick.orbit`, whose options these are.
    step: the longest step, as a part of the range; points: most points each way; same_events: the branch ends where
    the sequence of events changes. y: "Q:STAT,..", statistics of the cycle of each orbit (`Branch.measured`).

    Raises InputError for a range that the value is outside of, NumericalError if there is no first orbit. A branch
    whose end is not understood is a RuntimeWarning.

    >>> import slapstick
    >>> branch = slapstick.continuation("vibro-impact", "omega", (2.6, 2.9), orbit="1-1", omega=2.7)
    >>> [(point.type, round(point.value, 8)) for point in branch.special]
    [('PD', 2.8459563)]
    """
    chosen = model_of(model)
    fixed = numbers(given_to(continuation, chosen, values, parameters))
    options: dict[str, Any] = {"orbit": orbit, "stable": stable, "symmetric": symmetric, "nearest": nearest}
    options |= {"transient": transient, "starts": starts, "seconds": seconds, "seed": seed, "start": start}
    wish = wish_of(options)
    begin, end = range_of(chosen, parameter, between)
    options |= {"parameter": parameter, "between": (begin, end), "step": step, "points": points}
    options |= {"same_events": same_events, "y": y}
    if y:
        statistics_of("y", y, chosen, fixed)
    arguments = (chosen._core, fixed, parameter, begin, end, start_of(start), wish, step, points, same_events)
    core = _progress.run(_core.continuation, arguments, "points at most", 2 * points, progress)
    return finished(Branch(core, chosen, fixed, options), "continuation", 4)


def continue_orbit(
    first: Orbit,
    parameter: str,
    between: tuple[float, float] | None = None,
    *,
    step: float = 0.01,
    points: int = 2000,
    same_events: bool = False,
    progress: Progress = None,
) -> Branch:
    begin, end = range_of(first.model, parameter, between)
    options: dict[str, Any] = {"parameter": parameter, "between": (begin, end), "step": step, "points": points}
    options |= {"same_events": same_events}
    arguments = (first._core, parameter, begin, end, step, points, same_events)
    core = _progress.run(_core.continue_orbit, arguments, "points at most", 2 * points, progress)
    return finished(Branch(core, first.model, first._values, options), "continuation", 4)


def range_of(model: Model, parameter: str, between: tuple[float, float] | None) -> tuple[float, float]:
    """The range asked for, or the one that the model gives."""
    if between is not None:
        try:
            begin, end = (float(value) for value in between)
        except (TypeError, ValueError):
            raise InputError(f"{parameter}: the range {between!r} is not of the form (A, B)") from None
        return begin, end
    table = model.parameters
    if parameter in table and np.isfinite([table[parameter].min, table[parameter].max]).all():
        return table[parameter].min, table[parameter].max
    model.values(**({} if parameter in model.groups else {parameter: 1.0}))  # names the nearest of an unknown one
    raise InputError(f"{parameter}: the model gives no finite range; say between which values")

