"""poincare: points of a section of a motion."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core, _progress
from ._core import InputError, NumericalError
from ._model import Model, Start, Values, given_to, model_of, numbers, start_of, stops_of
from ._obeys import obeys
from ._progress import Progress
from ._quantity import wanted_of
from ._result import Floats, Given, GivenWords, Interrupted, Result, axes
from ._tables import categorical, state_columns, words

PATIENCE = 10_000  # forcing periods without a point, after which none is expected
MOST_PERIODS = 1_000_000


class Section(Result):
    """Points of a section, as columns.

    t: instants in the model's unit of time, shape (k,); y: states, shape (2 n, k): just before an impact or event.
    phase: of the forcing, in [0, 1). Impacts: w, flight and sliding (in forcing periods), contact. Stroboscopic: mode.
    Events: return_time (time since the point before), w, contact. The columns of other sections are empty.
    of: a column of each quantity that was asked for, `of["F_stop"]`.
    """

    def __init__(self, core: _core.Section, model: Model, values: dict[str, float], options: dict[str, Any]) -> None:
        super().__init__(model, values, options)
        self._core = core
        #: The name of each quantity that was asked for, to its column, shape (k,): before an impact or event.
        self.of: dict[str, Floats] = {name: core.of(k) for k, name in enumerate(options.get("names", []))}

    t = Given[Floats]("Instants in the model's unit of time, shape (k,).")
    y = Given[Floats]("States, in the model's units, shape (2 n, k).", name="state")
    phase = Given[Floats]("Of the forcing, in [0, 1), shape (k,).")
    w = Given[Floats](
        "Relative velocity just before, in the model's unit of speed, shape (k,); empty for the stroboscopic section."
    )
    flight = Given[Floats]("Of impacts: time since the one before, in forcing periods, shape (k,).")
    sliding = Given[Floats]("Of impacts: the part of the flight in slip, in forcing periods, shape (k,).")
    return_time = Given[Floats]("Of events: time since the point before, in the model's unit, shape (k,).")
    contact = GivenWords("Names of the contacts, shape (k,); empty for the stroboscopic section.")
    mode = GivenWords("Of stroboscopic points: the contacts' states, shape (k,).")
    complete = Given[bool]("False after Ctrl-C.")

    def __len__(self) -> int:
        return len(self.t)

    def _columns(self) -> dict[str, Any]:
        columns = {
            "time": self.t,
            "phase": self.phase,
            "return_time": self.return_time,
            "w": self.w,
            "flight": self.flight,
            "sliding": self.sliding,
        }
        return {name: column for name, column in columns.items() if len(column) == len(self)}

    def to_pandas(self) -> Any:
        """A DataFrame with the columns of `slapstick poincare`, and the contact of every point that has one."""
        import pandas as pd

        core, columns = self._core, self._columns() | state_columns(self.model.state_names, self.y) | self.of
        if len(core.mode_codes):
            columns["mode"] = categorical(core.mode_names, core.mode_codes)
        if len(core.contact_codes):
            columns["contact"] = categorical(core.contact_names, core.contact_codes)
        return pd.DataFrame(columns)

    def to_xarray(self) -> Any:
        """A Dataset over `point` with the same columns."""
        import xarray as xr

        columns = self._columns() | state_columns(self.model.state_names, self.y) | self.of
        about = {"model": self.model.name, "version": self.version} | self.parameters
        return xr.Dataset({name: ("point", column) for name, column in columns.items()}, attrs=about)

    def plot(self, ax: Any = None) -> Any:
        """Draws the first two quantities of `of`; without them w over the phase of impacts, the phase plane at
        stroboscopic points, or a return map."""
        ax = axes(ax)
        kind = self.options["section"]
        labels: tuple[str, ...]
        if len(self.of) > 1:
            labels = tuple(self.of)[:2]
            x, y = (self.of[name] for name in labels)
        elif kind == "impact" and self.model._core.forced:
            x, y, labels = self.phase, self.w, ("phase of the forcing", "w just before the impact")
        elif kind == "stroboscopic":
            x, y, labels = self.y[0], self.y[1], tuple(self.model.state_names[:2])
        else:
            column, name = (self.w, "w") if np.any(self.w) else (self.return_time[1:], "return time")
            x, y, labels = column[:-1], column[1:], (f"{name} of point k", f"{name} of point k + 1")
        ax.plot(x, y, ".", markersize=2, color="tab:blue", rasterized=len(x) > 5000)
        ax.set_xlabel(labels[0])
        ax.set_ylabel(labels[1])
        return ax

    def _facts(self) -> list[tuple[str, str]]:
        return [("section", self.options["section"]), ("points", str(len(self)))]


@obeys("poincare")
def poincare(
    model: Model | str | os.PathLike[str],
    *,
    section: str = "impact",
    event: str = "",
    phase: float = 0.0,
    transient: int = 500,
    points: int = 1000,
    most_periods: int | None = None,
    stops: str | Sequence[str] = (),
    of: str | Sequence[str] = (),
    start: Start = None,
    progress: Progress = None,
    parameters: Values | None = None,
    **values: float,
) -> Section:
    """Points of a section: just before every impact, once in a forcing period, or just before every event of a kind.

    section: 'impact', 'stroboscopic' or 'event'. event: 'stick', 'release:belt', .. of the event section. phase: of the
    stroboscopic section, in [0, 1). transient: forcing periods that are left out. points: how many.
    most_periods: the impact or event section ends here if points are rare (1e6, and after 1e4 without a point). stops:
    whose impacts are points (all). of: "Q,.." or a list of words: quantities as further columns.

    Raises InputError for an option or value that makes no sense, NumericalError if there is no point. Fewer points
    than asked for are a RuntimeWarning.

    >>> import slapstick
    >>> ball = slapstick.poincare("bouncing-ball", transient=0, points=3)
    >>> ball.w.round(6).tolist()
    [4.429447, 3.543558, 2.834846]
    """
    chosen = model_of(model)
    fixed = numbers(given_to(poincare, chosen, values, parameters))
    wanted = read_of(of, chosen, fixed)
    options = {"section": section, "event": event, "phase": phase, "transient": transient, "points": points}
    options |= {"most_periods": most_periods, "stops": stops, "start": start, "of": of, "names": [q.name for q in wanted]}
    begin = (chosen._core, fixed, start_of(start), transient, points)
    limits = (MOST_PERIODS, PATIENCE) if most_periods is None else (most_periods, most_periods)
    if (section == "event") != bool(event):
        raise InputError("event belongs to section='event', and that section needs one: event='stick'")
    sections: dict[str, tuple[Callable[..., _core.Section], tuple[Any, ...]]] = {
        "impact": (_core.impact_section, (*begin, *limits, stops_of(stops), wanted)),
        "stroboscopic": (_core.strobe_section, (*begin, phase, wanted)),
        "event": (_core.event_section, (*begin, *limits, event, wanted)),
    }
    if section not in sections:
        raise InputError(f"section: {section!r} is none of {', '.join(sections)}")
    core = _progress.run(*sections[section], "points", points, progress)
    found = Section(core, chosen, fixed, options)
    return finished(found)


def read_of(of: str | Sequence[str], chosen: Model, values: dict[str, float]) -> list[_core.Quantity]:
    """The quantities of `of`, which are read at instants."""
    wanted = wanted_of(of, chosen, values) if of else []
    for quantity, statistic in wanted:
        if statistic:
            raise InputError(f"of: '{quantity.name}:{statistic}': values are wanted, not statistics")
    return [quantity for quantity, _ in wanted]


def finished(found: Section) -> Section:
    """Says if there are fewer points than were asked for."""
    if not found.complete:
        raise Interrupted(found)
    if found._core.whole or found.options["section"] == "stroboscopic":
        return found
    what = "impacts" if found.options["section"] == "impact" else "events"
    where = f"in {found._core.periods:g} periods after the transient"
    if len(found) == 0:
        raise NumericalError(f"no {what} {where}: try other parameters, another start or a longer most_periods")
    warnings.warn(f"only {len(found)} {what} {where} (see most_periods)", RuntimeWarning, stacklevel=4)
    return found
