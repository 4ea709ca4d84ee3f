"""lyapunov: all Lyapunov exponents of a motion."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping, Sequence
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from . import _core, _progress
from ._model import Model, Start, Values, given_to, model_of, numbers, rows_of, start_of
from ._obeys import obeys
from ._progress import Progress
from ._result import Floats, Given, Interrupted, Result


class Exponents(Result):
    """All Lyapunov exponents of a motion, largest first; -inf where stick, a closed stop or chatter forgets a direction.

    exponents, errors: per unit of time; per_period, errors_per_period: per forcing period, shape (2 n,) less one for
    each translation that the model does not notice.
    """

    def __init__(
        self, found: _core.Exponents, model: Model, values: dict[str, float], options: dict[str, Any]
    ) -> None:
        super().__init__(model, values, options)
        self._core = found

    _core: _core.Exponents

    per_period = Given[Floats]("Exponents per forcing period (unit of time without forcing), largest first.")
    errors_per_period = Given[Floats]("Their standard errors, by 20 batch means.")
    period = Given[float]("The forcing period in the model's unit of time; 1 without forcing.")
    dimension = Given[float]("Of Kaplan and Yorke: of the attractor in a stroboscopic section.")
    sum_per_period = Given[float]("Of all exponents per period, by the frames of tangents.")
    contraction_per_period = Given[float]("The same by traces along segments and determinants at events.")
    sum_rule_holds = Given[bool]("Whether both agree but for rounding.")
    periods = Given[int]("Forcing periods that the exponents are taken from.")
    reached = Given[bool]("Whether every error is below the `error` that was asked for.")
    failure = Given[str]("Of one among many: why there are no exponents; else ''.")

    @property
    def exponents(self) -> Floats:
        """Exponents per unit of time, largest first."""
        return self.per_period / self.period

    @property
    def errors(self) -> Floats:
        """Their standard errors, per unit of time."""
        return self.errors_per_period / self.period

    def _facts(self) -> list[tuple[str, str]]:
        if self.failure:
            return [("failed", self.failure)]
        shown = ", ".join(f"{value:.4g}" for value in self.exponents)
        return [("exponents", shown), ("dimension", f"{self.dimension:.4g}"), ("periods", str(self.periods))]


@overload
def lyapunov(
    model: Model | str | os.PathLike[str],
    *,
    transient: int = ...,
    periods: int = ...,
    error: float = ...,
    start: Start = ...,
    threads: int = ...,
    progress: Progress = ...,
    parameters: Mapping[str, float] | None = ...,
    **values: float,
) -> Exponents: ...
@overload
def lyapunov(
    model: Model | str | os.PathLike[str],
    *,
    transient: int = ...,
    periods: int = ...,
    error: float = ...,
    start: Start = ...,
    threads: int = ...,
    progress: Progress = ...,
    parameters: Mapping[str, float] | None = ...,
    **values: ArrayLike,
) -> list[Exponents]: ...
@obeys("lyapunov")
def lyapunov(
    model: Model | str | os.PathLike[str],
    *,
    transient: int = 500,
    periods: int = 20_000,
    error: float = 0.0,
    start: Start = None,
    threads: int = 0,
    progress: Progress = None,
    parameters: Values | None = None,
    **values: Any,
) -> Exponents | list[Exponents]:
    """All Lyapunov exponents, through impacts, stick and the limits of chatter.

    transient: forcing periods that are left out; periods: that the exponents are taken from, at most with `error`, which
    ends the run as soon as every standard error per period is below it. start: as of `simulate`.
    Parameters are keywords. Where some are arrays of the same shape (k,), or tuples (A, B, k), the result is a list of
    k entries, computed on all cores (`threads`). An entry that fails says why in its `failure`, and is a RuntimeWarning.

    Raises InputError for a value out of range, NumericalError if the motion cannot go on. An error that is not reached
    is a RuntimeWarning.

    >>> import slapstick
    >>> slapstick.lyapunov("impact-oscillator", periods=100).sum_rule_holds
    True
    """
    chosen = model_of(model)
    given = given_to(lyapunov, chosen, values, parameters)
    options = {"transient": transient, "periods": periods, "error": error, "start": start}
    limits = (start_of(start), transient, periods, error)
    if any(np.ndim(value) > 0 for value in given.values()):
        return lyapunov_many(chosen, given, options, (*limits, threads), progress)
    fixed = numbers(given)
    total = transient + periods
    found = _progress.run(_core.lyapunov, (chosen._core, fixed, *limits), "periods", total, progress)
    result = Exponents(found, chosen, fixed, options)
    complain([result])
    return result


def lyapunov_many(
    model: Model, given: Values, options: dict[str, Any], limits: tuple[Any, ...], progress: Progress
) -> list[Exponents]:
    rows, _ = rows_of(given)
    found = _progress.run(_core.lyapunov_many, (model._core, rows, *limits), "values", len(rows), progress)
    results = [Exponents(row, model, values, options) for row, values in zip(found, rows) if row is not None]
    if len(results) < len(rows):
        raise Interrupted(results)
    complain(results)
    return results


def complain(results: Sequence[Exponents]) -> None:
    """Says what the exponents do not."""
    for bad, what in (
        ([one for one in results if one.failure], "failed"),
        ([one for one in results if not one.failure and not one.sum_rule_holds], "break the sum rule"),
        ([one for one in results if not one.failure and not one.reached], "have a larger error than was asked for"),
    ):
        if bad:
            first = f"{bad[0]._title()}: {bad[0].failure}" if bad[0].failure else bad[0]._title()
            warnings.warn(f"{len(bad)} of {len(results)} {what}, first {first}", RuntimeWarning, stacklevel=5)
