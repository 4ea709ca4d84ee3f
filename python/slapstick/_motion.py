"""simulate: one exact trajectory, with its events."""

from __future__ import annotations

import os
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core, _progress
from ._core import InputError
from ._model import Model, Start, Values, given_to, model_of, numbers, start_of
from ._obeys import obeys
from ._progress import Progress
from ._result import Floats, Given, GivenWords, Interrupted, Result, axes
from ._tables import categorical, state_columns, words


class Events:
    """The events of a motion, in order of time, as columns.

    t: time in the model's unit, shape (k,); period and phase: the same as whole forcing periods and the rest in
    [0, 1); w: relative velocity of the contact's pair just before; before: the state just before, shape (2 n, k);
    kind and contact: words, shape (k,).
    """

    def __init__(self, run: _core.Run, names: list[str]) -> None:
        self._core, self._names = run, names

    t = Given[Floats]("Time in the model's unit, shape (k,).", name="event_t")
    period = Given[NDArray[np.int64]]("The whole forcing periods of the time, shape (k,).", name="event_period")
    phase = Given[Floats]("The rest of the time in forcing periods, in [0, 1), shape (k,).", name="event_phase")
    w = Given[Floats](
        "Relative velocity of the contact's pair just before, in the model's unit of speed, shape (k,).", name="event_w"
    )
    before = Given[Floats]("States just before, in the model's units, shape (2 n, k).", name="event_before")
    kind = GivenWords("'impact', 'stick', 'graze', .., shape (k,).", name="event_kind")
    contact = GivenWords("Names of the contacts, shape (k,).", name="event_contact")

    def __len__(self) -> int:
        return len(self.t)

    def counts(self) -> dict[str, int]:
        """How many events of each kind there are."""
        kinds, counts = np.unique(self.kind, return_counts=True)
        return {str(kind): int(count) for kind, count in zip(kinds, counts)}

    def to_pandas(self) -> Any:
        """A DataFrame with the columns of `slapstick simulate --events`."""
        import pandas as pd

        run = self._core
        columns = {
            "time": self.t,
            "kind": categorical(run.event_kind_names, run.event_kind_codes),
            "contact": categorical(run.event_contact_names, run.event_contact_codes),
            "w": self.w,
        }
        return pd.DataFrame(columns | state_columns(self._names, self.before))

    def __repr__(self) -> str:
        return f"<{len(self)} events: " + ", ".join(f"{n} {kind}" for kind, n in self.counts().items()) + ">"

    def _repr_html_(self) -> str:
        html: str = self.to_pandas()._repr_html_()
        return html


class Motion(Result):
    """A trajectory.

    t: instants of the samples, shape (k,), in the model's unit of time; y: states, shape (2 n, k), in the order of
    `model.state_names`; just before an event that falls on a sample. events: an `Events`.
    Arrays are views of the result: they are not copied.
    """

    def __init__(self, run: _core.Run, model: Model, values: dict[str, float], options: dict[str, Any]) -> None:
        super().__init__(model, values, options)
        self._core = run

    t = Given[Floats]("Instants of the samples, shape (k,), in the model's unit of time.")
    y = Given[Floats]("States at the samples, shape (2 n, k).")

    @cached_property
    def events(self) -> Events:
        """Every event: impacts, reversals, sticks, releases, grazes, chatters."""
        return Events(self._core, self.model.state_names)

    mode = GivenWords("The contacts' states at the samples: 'slip+', 'stick', 'free|closed', .., shape (k,).")

    @cached_property
    def observables(self) -> dict[str, NDArray[np.float64]]:
        """The model's observables at the samples, by name."""
        return state_columns(self.model._core.observables, self._core.observables)

    start = Given[Floats]("The state at time 0, shape (2 n,).")
    state = Given[Floats]("The state at the end, shape (2 n,).", name="end")
    end_mode = Given[str]("The contacts' states at the end.")
    duration = Given[float]("The time at the end, in the model's unit.")
    period = Given[float]("The forcing period in the model's unit of time; 1 without forcing.")
    work = Given[dict[str, int]]("What the run cost: segments, windows, evaluations.")
    complete = Given[bool]("False after Ctrl-C.")

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """One number of the state, or an observable, at the samples: `motion["x1"]`, shape (k,). Raises InputError."""
        if name in self.observables:
            return self.observables[name]
        if name not in self.model.state_names:
            known = ", ".join([*self.model.state_names, *self.observables])
            raise InputError(f"{name}: neither a number of the state nor an observable ({known})")
        column: NDArray[np.float64] = self.y[self.model.state_names.index(name)]
        return column

    def to_pandas(self) -> Any:
        """A DataFrame with the columns of `slapstick simulate --trajectory`."""
        import pandas as pd

        mode = {"mode": categorical(self._core.mode_names, self._core.mode_codes)}
        states = state_columns(self.model.state_names, self.y)
        return pd.DataFrame({"time": self.t} | states | mode | self.observables)

    def to_xarray(self) -> Any:
        """A Dataset over `time`: a variable for each number of the state and each observable, and the mode."""
        import xarray as xr

        columns = state_columns(self.model.state_names, self.y) | {"mode": self.mode} | self.observables
        about = {"model": self.model.name, "version": self.version} | self.parameters
        return xr.Dataset({name: ("time", column) for name, column in columns.items()}, {"time": self.t}, about)

    def plot(self, ax: Any = None) -> Any:
        """Draws the displacements over time, and a tick for every impact. Returns the axes."""
        ax = axes(ax)
        for name, column in zip(self.model.state_names[::2], self.y[::2]):
            ax.plot(self.t, column, label=name, linewidth=1)
        hit = np.isin(self.events.kind, ("impact", "engage"))
        ax.plot(self.events.t[hit], np.full(hit.sum(), 0.02), "|", color="0.3", transform=ax.get_xaxis_transform())
        ax.set_xlabel("time")
        ax.set_ylabel("displacement")
        ax.margins(x=0)
        ax.legend(frameon=False, ncols=4, loc="lower left", bbox_to_anchor=(0, 1), borderaxespad=0.2)
        return ax

    def _facts(self) -> list[tuple[str, str]]:
        counts = ", ".join(f"{count} {kind}" for kind, count in self.events.counts().items())
        return [
            ("time", f"{self.duration:g}"),
            ("samples", str(len(self.t))),
            ("events", f"{len(self.events)} ({counts})" if counts else "0"),
            ("mode at the end", self.end_mode),
        ] + ([] if self.complete else [("complete", "no")])


@obeys("simulate", {"samples": 0})
def simulate(
    model: Model | str | os.PathLike[str],
    *,
    periods: float | None = None,
    time: float | None = None,
    samples: int = 100,
    start: Start = None,
    progress: Progress = None,
    parameters: Values | None = None,
    **values: float,
) -> Motion:
    """One exact trajectory.

    periods: its length in forcing periods (units of time without forcing), 100 if nothing is said; time: its length in
    the model's unit of time, instead. samples: for each period, from its start on, at most 1e9 in all; 0 for events
    only. They change nothing in the motion.
    start: numbers by name in place of the model's own start, or all 2 n of them.
    Parameters are keywords; `parameters` takes those whose name is an option's.

    Raises InputError for a value out of range or a start behind a stop, NumericalError if the motion cannot go on,
    Interrupted (a KeyboardInterrupt with `result`) after Ctrl-C.

    >>> import slapstick
    >>> ball = slapstick.simulate("bouncing-ball", periods=3)
    >>> ball.y.shape, ball.events.kind[0]
    ((2, 301), np.str_('impact'))
    """
    chosen = model_of(model)
    given = numbers(given_to(simulate, chosen, values, parameters))
    periods = 100 if periods is None else periods
    if time is None and periods * samples > 1e9:
        raise InputError(f"samples: {periods * samples:g} samples in all are more than 1e9; samples=0 keeps events only")
    options = {"periods": periods, "time": time, "samples": samples, "start": start}
    arguments = (chosen._core, given, start_of(start), periods, time, samples)
    run = _progress.run(_core.simulate, arguments, "periods", periods, progress)
    motion = Motion(run, chosen, given, options)
    if not run.complete:
        raise Interrupted(motion)
    return motion
