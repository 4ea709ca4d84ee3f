"""batch: many starts and parameter values at once, each a motion of its own."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core, _progress
from ._core import InputError
from ._model import Model, Start, Values, given_to, model_of, numbers, rows_of, start_of
from ._obeys import obeys
from ._progress import Progress
from ._result import Floats, Given, GivenTruths, GivenWords, Interrupted, Result
from ._tables import categorical


class BatchEvents:
    """The events of all runs, in the order of the runs and of time, as columns of shape (k,).

    run: the index of the run; t: time in the model's unit; w: relative velocity of the contact's pair just before;
    kind and contact: words.
    """

    def __init__(self, core: _core.Runs) -> None:
        self._core = core

    run = Given[NDArray[np.int32]]("Indices of the runs, shape (k,).", name="event_run")
    t = Given[Floats]("Time in the model's unit, shape (k,).", name="event_t")
    w = Given[Floats](
        "Relative velocity of the contact's pair just before, in the model's unit of speed, shape (k,).", name="event_w"
    )
    kind = GivenWords("'impact', 'stick', 'graze', .., shape (k,).", name="event_kind")
    contact = GivenWords("Names of the contacts, shape (k,).", name="event_contact")

    def __len__(self) -> int:
        return len(self.t)

    def to_pandas(self) -> Any:
        """A DataFrame with a row for each event."""
        import pandas as pd

        core = self._core
        kind = categorical(core.event_kind_names, core.event_kind_codes)
        contact = categorical(core.event_contact_names, core.event_contact_codes)
        return pd.DataFrame({"run": self.run, "time": self.t, "kind": kind, "contact": contact, "w": self.w})

    def __repr__(self) -> str:
        return f"<{len(self)} events of {len(np.unique(self.run))} runs>"


class Batch(Result):
    """What many motions have recorded: columns with an entry for each run.

    impacts, speeds: how many impacts the recording has, and the sum of their speeds, shape (runs,); end: states at the
    end, shape (2 n, runs); points: stroboscopic states, shape (2 n, points, runs); point_impacts: impacts in the period
    before each point, shape (points, runs); exponent: the largest Lyapunov exponent, per forcing period, NaN if it was not
    asked for; events: a `BatchEvents`. swept: the parameters that vary, by name.
    A run that failed has NaN, False in `done`, and its reason in `failures`.
    """

    def __init__(
        self,
        core: _core.Runs,
        model: Model,
        values: dict[str, float],
        swept: dict[str, Floats],
        options: dict[str, Any],
    ) -> None:
        super().__init__(model, values, options)
        self._core = core
        self._free = tuple(swept)
        self.swept = swept

    impacts = Given[NDArray[np.int64]]("Impacts of the recording, shape (runs,).")
    speeds = Given[Floats]("The sum of their speeds, in the model's unit of speed, shape (runs,).")
    exponent = Given[Floats]("The largest Lyapunov exponent, per forcing period, shape (runs,).")
    end = Given[Floats]("States at the end, in the model's units, shape (2 n, runs).")
    point_impacts = Given[NDArray[np.int64]]("Impacts in the period before each point, shape (points, runs).")
    lane_events = Given[NDArray[np.int64]]("Events that lanes have decided, from the start on, shape (runs,).")
    motion_events = Given[NDArray[np.int64]]("Events that were decided as `simulate` does, shape (runs,).")
    in_lanes = GivenTruths("Whether lanes can run the model, shape (runs,).")
    done = GivenTruths("False of a run that failed or was interrupted, shape (runs,).")
    failures = Given[list[str]]("Why runs failed; '' of those that did not.")
    kernel = Given[str]("Of the lanes: 'scalar', 'sse4', 'avx2', 'avx512'; all have the same bits.")
    complete = Given[bool]("False after Ctrl-C.")

    @cached_property
    def points(self) -> Floats:
        """Stroboscopic states, shape (2 n, points, runs): the last one is `end`."""
        rows: Floats = self._core.points
        size = len(self.model.state_names)
        return rows.reshape(len(rows) // size, size, len(self)).transpose(1, 0, 2)

    @cached_property
    def events(self) -> BatchEvents:
        """Every event of the recordings, if they were asked for."""
        return BatchEvents(self._core)

    def __len__(self) -> int:
        return len(self.impacts)

    def to_pandas(self) -> Any:
        """A DataFrame with a row for each run: what varies, impacts, speeds, exponent, the state at the end."""
        import pandas as pd

        columns = {**self.swept, "impacts": self.impacts, "speeds": self.speeds, "exponent": self.exponent}
        return pd.DataFrame(columns | dict(zip(self.model.state_names, self.end)))

    def _facts(self) -> list[tuple[str, str]]:
        facts = [("runs", str(len(self))), ("impacts", str(self.impacts.sum())), ("kernel", self.kernel)]
        failed = sum(map(bool, self.failures))
        return facts + ([("failed", str(failed))] if failed else [])


@obeys("map", periods="measured_periods", points="transient", lanes="transient")
def batch(
    model: Model | str | os.PathLike[str],
    *,
    transient: int = 0,
    periods: int = 100,
    points: int = 0,
    events: bool = False,
    exponent: bool = False,
    start: Start = None,
    lanes: int = 0,
    threads: int = 0,
    progress: Progress = None,
    parameters: Values | None = None,
    **values: Any,
) -> Batch:
    """Many motions at once: a run for each start and parameter value, up to eight in the registers of a core, on all cores.

    Parameters are keywords. Arrays of the same shape (k,), or tuples (A, B, k), give k runs. start: as of `simulate`, for
    every run; an array of shape (2 n, k), or names with arrays of shape (k,), give each run its own.
    transient: forcing periods before the recording; periods: of the recording; points: states at the ends of its last so
    many periods; events: all of its events; exponent: its largest Lyapunov exponent (`slapstick.lyapunov` has all, with
    errors). lanes: 1, 4 or 8, 0 for the most that the processor has; threads: 0 for all.

    The bits of a run depend on its model and start alone, not on lanes, threads or the processor. They are not those of
    `simulate`, from which a chaotic motion parts after some periods.

    Raises InputError before the work. A run that fails stands in `failures`, and is a RuntimeWarning.

    >>> import slapstick
    >>> b = slapstick.batch("vibro-impact", omega=(1.9, 2.5, 4), transient=100, periods=100, exponent=True)
    >>> b.impacts.tolist(), b.exponent.round(3).tolist()
    ([100, 100, 100, 100], [-0.166, -0.138, -0.114, -0.062])
    """
    chosen = model_of(model)
    given = given_to(batch, chosen, values, parameters)
    starts = starts_of(start)
    swept: dict[str, Floats] = {}
    if any(np.ndim(value) > 0 for value in given.values()):
        rows, swept = rows_of(given)
    else:
        rows = [numbers(given)] * len(starts)
    if not rows or len(starts) not in (1, len(rows)):
        raise InputError(f"start: {len(starts)} starts do not fit {len(rows)} values of the parameters")
    wish = _core.BatchWish()
    wish.transient, wish.periods, wish.points, wish.lanes, wish.threads = transient, periods, points, lanes, threads
    wish.events, wish.exponent = events, exponent
    core = _progress.run(_core.batch, (chosen._core, rows, starts, wish), "runs", len(rows), progress)
    options: dict[str, Any] = {"transient": transient, "periods": periods, "points": points, "events": events}
    options |= {"exponent": exponent, "start": start, "lanes": lanes}
    return reported(Batch(core, chosen, rows[0], swept, options))


def starts_of(start: Start) -> list[dict[str, float] | list[float] | None]:
    """One start for all runs, or one for each."""
    if isinstance(start, Mapping) and any(np.ndim(value) > 0 for value in start.values()):
        rows, _ = rows_of(start)
        return [*rows]
    if start is not None and not isinstance(start, Mapping) and np.ndim(start) > 1:
        return [start_of(column) for column in np.asarray(start).T]
    return [start_of(start)]


def reported(found: Batch) -> Batch:
    """Says what the columns cannot."""
    if not found.complete:
        raise Interrupted(found)
    failed = [(run, text) for run, text in enumerate(found.failures) if text]
    if failed:
        run, text = failed[0]
        warnings.warn(f"{len(failed)} of {len(found)} runs failed, first run {run}: {text}", RuntimeWarning, stacklevel=4)
    return found
