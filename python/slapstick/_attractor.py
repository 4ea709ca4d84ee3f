"""classify: what a motion is after its transient."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _progress
from ._model import Model, Start, Values, given_to, model_of, numbers, rows_of, start_of, stops_of
from ._obeys import obeys
from ._progress import Progress
from ._quantity import Measured, measure
from ._result import Floats, Given, Interrupted, Result
from ._tables import html_table, state_columns, words


class Impacts:
    """The impacts of one cycle, as columns.

    phase: in forcing periods, in [0, 1), shape (k,); w: relative velocity just before, shape (k,); before: the
    state just before, shape (2 n, k); contact: the stops that are hit, shape (k,).
    """

    def __init__(self, found: _core.Classified, names: list[str]) -> None:
        self.phase: NDArray[np.float64] = found.impact_phase
        self.w: NDArray[np.float64] = found.impact_w
        self.before: NDArray[np.float64] = found.impact_before
        self.contact: NDArray[np.str_] = words(found.contact_names, found.impact_contact_codes)
        self._names = names

    def __len__(self) -> int:
        return len(self.w)

    def to_pandas(self) -> Any:
        """A DataFrame of these columns."""
        import pandas as pd

        columns = {"phase": self.phase, "w": self.w, "contact": self.contact}
        return pd.DataFrame(columns | state_columns(self._names, self.before))

    def __repr__(self) -> str:
        return f"<{len(self)} impacts: w = " + ", ".join(f"{w:.6g}" for w in self.w) + ">"


class Attractor(Result):
    """What a motion is after its transient.

    label: '1-1-II', '1-inf-II', 'free-0-II', 'quasi-periodic', 'chaotic', 'one of a family', 'equilibrium', 'undecided'.
    attractor: 'periodic', 'quasi-periodic', 'chaotic', 'one of a family', 'equilibrium', 'undecided'.
    Periodic: n forcing periods and p impacts in a cycle (p is inf with complete chatter), multipliers of the
    n-period map (complex, largest first), impacts. state: on the attractor at phase 0, shape (2 n,).
    exponent: the largest Lyapunov exponent for each forcing period.
    A motion that nothing drives is free: it may come to rest (equilibrium, with eigenvalues per unit of time); n counts
    how often the rarest event of a cycle happens in it, cycle is its period, and exponents are per unit of time.
    """

    def __init__(
        self, found: _core.Classified, model: Model, values: dict[str, float], options: dict[str, Any]
    ) -> None:
        super().__init__(model, values, options)
        self._core = found

    label = Given[str]("'1-1-II', '1-inf-II', also of one of a family; 'quasi-periodic', 'chaotic', 'undecided'.")
    attractor = Given[str]("'periodic', 'quasi-periodic', 'chaotic', 'one of a family', 'equilibrium' or 'undecided'.")
    n = Given[int]("Forcing periods in a cycle, or of a free motion its rarest events; 0 if there is none.")
    cycle = Given[float]("The period of the cycle in the model's unit of time; 0 if there is none.")

    @property
    def p(self) -> float:
        """Impacts in a cycle; inf with complete chatter."""
        return float("inf") if self.chatter == "complete" else self._core.p

    sticking = Given[bool]("Whether there is a stick phase in the cycle, or in the recorded motion.")
    chatter = Given[str]("'none', 'incomplete' or 'complete'.")
    multipliers = Given[NDArray[np.complex128]](
        "Of the n-period map, complex, largest first, shape (k,); empty without a cycle."
    )
    eigenvalues = Given[NDArray[np.complex128]](
        "Equilibrium: of the linear motion about it, per unit of time, largest real part first, shape (k,); else empty."
    )
    return_distance = Given[float](
        "How far the state is from its image after n periods, relative to the size of the motion."
    )
    approach = Given[float](
        "How far the motion was from the cycle when it was recognised, relative to the size of the motion."
    )
    sticking_fraction = Given[float](
        "The share of the time at rest relative to each other, at any contact, from 0 to 1."
    )
    exponent = Given[float]("The largest Lyapunov exponent for each forcing period, by the multipliers for a cycle.")
    exponent_error = Given[float]("Its standard error; 0 for a cycle.")
    birkhoff_digits = Given[float]("Digits to which two averages of the impacts agree; not for cycles.", name="digits")
    drift = Given[Floats](
        "How far the motion moves along translations that nothing opposes, in the unit of each coordinate, shape (n,); or empty."
    )
    rotation = Given[float](
        "Quasi-periodic: turns of a closed curve in `curves` forcing periods, in (0, 0.5]; orientation is not told."
    )
    rotation_digits = Given[float]("Digits to which two halves of the run agree on the rotation number.")
    curves = Given[int]("Quasi-periodic: closed curves that the stroboscopic points lie on in turn.")
    family = Given[int]("Of a cycle: dimensions of the continuum of cycles that it is a member of; 0 if none.")
    doubt = Given[str](
        "Why there is no class: 'not confirmed', 'approach', 'long cycle', 'exponent', 'no return', 'growth'; 'none' if there is one."
    )
    option_that_decides = Given[str]("The option of `classify` that would decide; '' if there is a class.")
    periods_used = Given[int]("Forcing periods that the motion was followed.")
    state = Given[Floats]("On the attractor, at phase 0, in the model's units, shape (2 n,).")

    @cached_property
    def impacts(self) -> Impacts:
        return Impacts(self._core, self.model.state_names)

    def measure(self, of: str | Sequence[str]) -> Measured:
        """Statistics of quantities on the attractor: over its cycle, or where there is none over 1000 periods.

        of: "Q[:STAT],.." or a list of such words, as of `slapstick.measure`.

        >>> import slapstick
        >>> round(slapstick.classify("shaken-table").measure("F_table:mean")["F_table:mean"], 9)
        1.0
        """
        return measure(self.model, of, transient=0, start=self.state, parameters=self._values)

    failure = Given[str]("Of one among many: why there is no class; else ''.")

    def _facts(self) -> list[tuple[str, str]]:
        if self.failure:
            return [("failed", self.failure)]
        speeds = ", ".join(f"{w:.6g}" for w in self.impacts.w[:8]) + (", .." if len(self.impacts) > 8 else "")
        facts = [("class", self.label), ("exponent", f"{self.exponent:.4g}")]
        return facts + ([("w", speeds)] if speeds else [])


class Attractors(Sequence[Attractor]):
    """Classes at many values of parameters: a sequence of `Attractor`, and their columns.

    label, n, p, exponent, failure: shape (k,). An entry that failed has the label 'failed' and the exponent nan.
    An entry that Ctrl-C left undone is missing at the end.
    """

    def __init__(self, rows: list[Attractor], swept: dict[str, NDArray[np.float64]]) -> None:
        self._rows = rows
        self.swept = swept

    @overload
    def __getitem__(self, index: int) -> Attractor: ...
    @overload
    def __getitem__(self, index: slice) -> list[Attractor]: ...
    def __getitem__(self, index: int | slice) -> Attractor | list[Attractor]:
        return self._rows[index]

    def __len__(self) -> int:
        return len(self._rows)

    def __iter__(self) -> Iterator[Attractor]:
        return iter(self._rows)

    @property
    def label(self) -> NDArray[np.str_]:
        return np.array(["failed" if row.failure else row.label for row in self._rows], dtype=np.str_)

    @property
    def n(self) -> NDArray[np.int64]:
        return np.array([row.n for row in self._rows], dtype=np.int64)

    @property
    def p(self) -> NDArray[np.float64]:
        return np.array([row.p for row in self._rows], dtype=np.float64)

    @property
    def exponent(self) -> NDArray[np.float64]:
        return np.array([np.nan if row.failure else row.exponent for row in self._rows], dtype=np.float64)

    @property
    def failure(self) -> NDArray[np.str_]:
        """Why an entry has no class; else ''."""
        return np.array([row.failure for row in self._rows], dtype=np.str_)

    def to_pandas(self) -> Any:
        """A DataFrame: the values that vary, label, n, p, exponent, and failure if there is one."""
        import pandas as pd

        columns = {**self.swept, "label": self.label, "n": self.n, "p": self.p, "exponent": self.exponent}
        return pd.DataFrame(columns | ({"failure": self.failure} if any(self.failure) else {}))

    def plot(self, ax: Any = None) -> Any:
        """Draws the exponent over the first parameter that varies, a colour for each class. Returns the axes."""
        from ._result import axes

        ax = axes(ax)
        name, values = next(iter(self.swept.items()))
        for label in dict.fromkeys(self.label.tolist()):
            of = self.label == label
            ax.plot(values[of], self.exponent[of], ".", label=label)
        ax.set_xlabel(name)
        ax.set_ylabel("largest exponent per period")
        ax.legend(frameon=False)
        return ax

    def __repr__(self) -> str:
        return f"<{len(self)} attractors over {', '.join(self.swept)}: {', '.join(dict.fromkeys(self.label.tolist()))}>"

    def _repr_html_(self) -> str:
        head = (*self.swept, "class", "exponent")
        columns = [*self.swept.values(), self.label, self.exponent]
        cells = ([f"{cell:.6g}" if not isinstance(cell, str) else cell for cell in row] for row in zip(*columns))
        return html_table(head, cells)


@overload
def classify(
    model: Model | str | os.PathLike[str],
    *,
    transient: int = ...,
    most_periods: int = ...,
    most_n: int = ...,
    exponent_periods: int = ...,
    quick: int = ...,
    stops: str | Sequence[str] = ...,
    start: Start = ...,
    threads: int = ...,
    progress: Progress = ...,
    parameters: Mapping[str, float] | None = ...,
    **values: float,
) -> Attractor: ...
@overload
def classify(
    model: Model | str | os.PathLike[str],
    *,
    transient: int = ...,
    most_periods: int = ...,
    most_n: int = ...,
    exponent_periods: int = ...,
    quick: int = ...,
    stops: str | Sequence[str] = ...,
    start: Start = ...,
    threads: int = ...,
    progress: Progress = ...,
    parameters: Mapping[str, float] | None = ...,
    **values: ArrayLike,
) -> Attractors: ...
@obeys("classify")
def classify(
    model: Model | str | os.PathLike[str],
    *,
    transient: int = 500,
    most_periods: int = 20_000,
    most_n: int = 64,
    exponent_periods: int = 4000,
    quick: int = 0,
    stops: str | Sequence[str] = (),
    start: Start = None,
    threads: int = 0,
    progress: Progress = None,
    parameters: Values | None = None,
    **values: Any,
) -> Attractor | Attractors:
    """What the motion is after its transient: n-p-I, n-p-II, quasi-periodic, chaotic, or at rest.

    transient: forcing periods (returns of a free motion) that are left out; most_periods: a cycle is sought so long; most_n: the longest cycle.
    exponent_periods: length of the run from which exponent, averages and rotation number are taken. quick: look at so
    many periods only, half of them transient; a cycle that Newton's method confirms is named, else 'undecided'.
    stops: whose impacts are counted and listed (all). start: as of `simulate`.
    Parameters are keywords. Where some are arrays of the same shape (k,), or tuples (A, B, k) for a range with both
    ends, the result is an `Attractors` with k entries, computed on all cores (`threads`). An entry that fails says why
    in its `failure`, and is a RuntimeWarning.

    Raises InputError for a value out of range, NumericalError if the motion cannot go on.

    >>> import slapstick
    >>> slapstick.classify("vibro-impact", omega=1.5).label
    '1-1-II'
    >>> slapstick.classify("vibro-impact", omega=[1.5, 2.2, 9]).label.tolist()
    ['1-1-II', '1-1-I', '5-1-I']
    >>> slapstick.classify("belt").label
    'free-0-II'
    """
    chosen = model_of(model)
    given = given_to(classify, chosen, values, parameters)
    options = {"transient": transient, "most_periods": most_periods, "most_n": most_n, "stops": stops, "start": start}
    options |= {"exponent_periods": exponent_periods, "quick": quick}
    limits = _core.Limits(transient, most_periods, most_n, exponent_periods, quick, stops_of(stops))
    begin = start_of(start)
    if any(np.ndim(value) > 0 for value in given.values()):
        return classify_many(chosen, given, options, (begin, limits, threads), progress)
    fixed = numbers(given)
    found = _progress.run(_core.classify, (chosen._core, fixed, begin, limits), "periods", quick or transient + most_periods, progress)
    return Attractor(found, chosen, fixed, options)


def classify_many(
    model: Model,
    given: Values,
    options: dict[str, Any],
    limits: tuple[Any, ...],
    progress: Progress,
) -> Attractors:
    rows, columns = rows_of(given)
    found = _progress.run(_core.classify_many, (model._core, rows, *limits), "values", len(rows), progress)
    done = [i for i, row in enumerate(found) if row is not None]
    attractors = [Attractor(found[i], model, rows[i], options) for i in done]
    result = Attractors(attractors, {name: column[done] for name, column in columns.items()})
    failed = [row for row in attractors if row.failure]
    if failed:
        what = f"{len(failed)} of {len(attractors)} values failed, first {failed[0]._title()}: {failed[0].failure}"
        warnings.warn(what, RuntimeWarning, stacklevel=4)
    if len(done) < len(rows):
        raise Interrupted(result)
    return result
