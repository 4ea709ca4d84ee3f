"""diagram: the impacts of the attractor at many values of a parameter."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core, _progress
from ._core import InputError
from ._model import Model, Start, Values, given_to, model_of, numbers, start_of, stops_of, sweep_of
from ._obeys import obeys
from ._progress import Progress
from ._quantity import statistics_of, wanted_of
from ._result import Floats, Given, GivenWords, Interrupted, Result, axes
from ._tables import categorical, state_columns, words

LABELS = {"w": "w just before the impact", "flight": "flight / period", "sliding": "sliding / period", "phase": "phase"}


class Diagram(Result):
    """Impacts at many values of a parameter, as columns of shape (k,): a row for each impact.

    parameter: its name; value: its value; w: relative velocity just before the impact; flight and sliding: time
    since the impact before, and the part of it in slip, in forcing periods; phase: of the forcing, in [0, 1).
    direction: 'up' or 'down', as the state was carried; contact: the stop; y: the state just before, shape (2 n, k).

    With statistics of quantities in place of impacts the columns are empty but for value and direction, with a row for
    each value that did not fail, and `measured["F_stop:rms"]` is a column of these rows. With values of quantities at
    instants there is a row for each instant, and the column is `measured["x1"]`.
    """

    def __init__(
        self, core: _core.Diagram, parameter: str, model: Model, values: dict[str, float], options: dict[str, Any]
    ) -> None:
        super().__init__(model, values, options)
        self._core, self.parameter = core, parameter
        self._free = (parameter,)
        words_of: list[str] = options.get("measured", [])
        #: "Q:STAT", or "Q" at instants, to its column, shape (k,); empty of a diagram of impacts.
        self.measured: dict[str, Floats] = {word: core.measured(k) for k, word in enumerate(words_of)}

    @cached_property
    def value(self) -> Floats:
        """Of the parameter, shape (k,)."""
        return self._core.measured_at if self.measured else self._core.parameter

    w = Given[Floats]("Relative velocity just before the impact, in the model's unit of speed, shape (k,).")
    flight = Given[Floats]("Time since the impact before, in forcing periods, shape (k,).")
    sliding = Given[Floats]("The part of it in slip, in forcing periods, shape (k,).")
    phase = Given[Floats]("Of the forcing, in [0, 1), shape (k,).")
    y = Given[Floats]("States just before, in the model's units, shape (2 n, k).", name="state")

    @cached_property
    def direction(self) -> NDArray[np.str_]:
        column: NDArray[np.str_] = words(("up", "down"), self._direction_codes)
        return column

    @property
    def _direction_codes(self) -> NDArray[np.int32]:
        core = self._core
        codes: NDArray[np.int32] = core.measured_direction_codes if self.measured else core.direction_codes
        return codes

    contact = GivenWords("The stop that is hit, shape (k,).")
    failures = Given[list[tuple[float, str]]]("Values of the parameter that failed, and why.")
    notes = Given[list[tuple[float, str]]]("Values at which the carried state did not fit, and what was done.")
    complete = Given[bool]("False after Ctrl-C.")

    def __len__(self) -> int:
        return len(self.value)

    def _columns(self) -> dict[str, Any]:
        if self.measured:
            return {self.parameter: self.value, **self.measured}
        names = {self.parameter: self.value, "w": self.w, "flight": self.flight, "sliding": self.sliding}
        return names | {"phase": self.phase} | state_columns(self.model.state_names, self.y)

    def to_pandas(self) -> Any:
        """A DataFrame with the columns of `slapstick diagram`; of impacts also the contact."""
        import pandas as pd

        core = self._core
        table = pd.DataFrame(self._columns())
        table.insert(1, "direction", categorical(("up", "down"), self._direction_codes))
        if not self.measured:
            table["contact"] = categorical(core.contact_names, core.contact_codes)
        return table

    def to_xarray(self) -> Any:
        """A Dataset over `impact`, of measured quantities over `row`, with the same columns."""
        import xarray as xr

        columns = self._columns() | {"direction": self.direction}
        if not self.measured:
            columns |= {"contact": self.contact}
        about = {"model": self.model.name, "version": self.version}
        along = "row" if self.measured else "impact"
        return xr.Dataset({name: (along, column) for name, column in columns.items()}, attrs=about)

    def plot(self, ax: Any = None, y: str = "") -> Any:
        """Draws `y` over the parameter: 'w' (the default), 'flight', 'sliding' or 'phase' of every impact, or a column of
        `measured` (the first). Returns the axes."""
        ax = axes(ax)
        y = y or next(iter(self.measured), "w")
        column = self.measured[y] if self.measured else getattr(self, y)
        for code, colour, size in ((0, "#0072b2", 0.7), (1, "#d55e00", 0.35)):
            of = self._direction_codes == code
            if of.any():
                label = ("up", "down")[code]
                statistic = ":" in y
                size = 4 * size if statistic else size
                style = {"markersize": size, "markeredgewidth": 0, "rasterized": not statistic}
                ax.plot(self.value[of], column[of], "o", color=colour, label=label, **style)
        ax.set_xlabel(self.parameter)
        ax.set_ylabel(LABELS.get(y, y))
        ax.margins(x=0)
        if len(ax.lines) > 1:
            ax.legend(
                frameon=False, markerscale=8, ncols=2, loc="lower right", bbox_to_anchor=(1, 1), borderaxespad=0.2
            )
        return ax

    def _facts(self) -> list[tuple[str, str]]:
        values = self._core.values
        what = ("measured", ", ".join(self.measured)) if self.measured else ("impacts", str(len(self)))
        facts = [("values", f"{len(values)} of {self.parameter}"), what]
        return facts + ([("failed", str(len(self.failures)))] if self.failures else [])


@obeys("diagram")
def diagram(
    model: Model | str | os.PathLike[str],
    *,
    direction: str = "up",
    carry: bool = True,
    transient: float | None = None,
    impacts: int = 200,
    most_periods: int = 5000,
    stops: str | Sequence[str] = (),
    y: str | Sequence[str] = (),
    at: str = "",
    periods: int = 0,
    start: Start = None,
    threads: int = 0,
    progress: Progress = None,
    parameters: Values | None = None,
    **values: Any,
) -> Diagram:
    """A bifurcation diagram: the impacts of the attractor at many values of one parameter, on all cores.

    The parameter is a keyword: `omega=(0.5, 10, 2400)` are 2400 values, both ends included; an array or a list gives
    the values themselves, increasing. direction: 'up', 'down' or 'both', in which the state is carried; carry: False
    begins each value at the start. transient: forcing periods before recording (None: 500, or what comes before the
    record of a signal); impacts: how many; most_periods: the recording ends here if they are rare. stops: whose (all).
    y: "Q:STAT,.." or a list of such words: statistics over `periods` (0: 100, or the record) in place of impacts, as of
    `slapstick.measure`. "Q,..": values at `impacts` instants, `at`: 'impact', 'period' (phase 0) or an event as
    'stick:belt' (impact; without stops period). threads: 0 for all; the result is the same.

    Raises InputError for what can be known to be wrong before the work. A value that fails is left out, stands in
    `failures`, and is a RuntimeWarning.

    >>> import slapstick
    >>> d = slapstick.diagram("vibro-impact", omega=(2.6, 3.1, 6), impacts=4)
    >>> d.w.reshape(6, 4)[0].round(4).tolist()
    [0.5769, 0.5769, 0.5769, 0.5769]
    """
    chosen = model_of(model)
    given = given_to(diagram, chosen, values, parameters)
    name, grid = swept(given)
    fixed = numbers({key: value for key, value in given.items() if key != name})
    if not carry and direction == "both":
        raise InputError("direction: with carry=False, up and down are the same; choose one, or carry=True")
    options: dict[str, Any] = {"direction": direction, "carry": carry, "transient": transient, "impacts": impacts}
    options |= {"most_periods": most_periods, "stops": stops, "start": start, "y": y, "at": at, "periods": periods}
    options["measured"], measured = measure_of(y, chosen, fixed | {name: grid[0]}, periods, at)
    about = (chosen._core, fixed, name, grid, start_of(start), direction, "carry" if carry else "reset", transient)
    total = len(grid) * (2 if direction == "both" else 1)
    arguments = (*about, impacts, most_periods, stops_of(stops), threads, measured)
    core = _progress.run(_core.diagram, arguments, "values", total, progress)
    return reported(Diagram(core, name, chosen, fixed, options), total)


def measure_of(
    y: str | Sequence[str], chosen: Model, values: dict[str, float], periods: int, at: str
) -> tuple[list[str], _core.DiagramMeasure]:
    """The words of `y`, and what the extension is given."""
    wanted = wanted_of(y, chosen, values) if y else []
    of = [quantity for quantity, _ in wanted]
    if not any(statistic for _, statistic in wanted):
        return [quantity.name for quantity in of], _core.DiagramMeasure(of, [], periods, at)
    if at or not all(statistic for _, statistic in wanted):
        raise InputError("y: statistics, as 'x1:rms', or values at the instants of `at`, as 'x1': choose one")
    wanted = statistics_of("y", y, chosen, values)
    words = [f"{quantity.name}:{statistic}" for quantity, statistic in wanted]
    return words, _core.DiagramMeasure(of, [statistic for _, statistic in wanted], periods, at)


def swept(given: Values) -> tuple[str, list[float]]:
    """The one parameter that varies, and its values."""
    names = [name for name, value in given.items() if np.ndim(value) > 0]
    if len(names) != 1:
        raise InputError(
            "diagram: one parameter varies, as omega=(0.5, 10, 2400); given: " + (", ".join(names) or "none")
        )
    name, value = names[0], given[names[0]]
    grid = sweep_of(name, value)
    if grid.ndim != 1 or len(grid) < 2 or not np.all(np.diff(grid) > 0):
        raise InputError(f"{name}: two or more increasing values are wanted; direction='down' carries the state down")
    return name, grid.tolist()


def reported(found: Diagram, total: int) -> Diagram:
    """Says what the columns cannot."""
    noun = found.options["at"] or "impact"
    if not found.complete:
        raise Interrupted(found)
    for rows, words_of in (
        (found.failures, f"{len(found.failures)} of {total} values failed"),
        (found.notes, f"{len(found.notes)} values"),
        (found._core.empty, f"no {noun}s at {len(found._core.empty)} of the values"),
    ):
        if rows:
            value, text = rows[0]
            warnings.warn(f"{words_of}, first {found.parameter} = {value:g}: {text}", RuntimeWarning, stacklevel=4)
    return found
