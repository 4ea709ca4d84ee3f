"""Special points of a branch: what happens, where, and what can be followed from there."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _core
from ._core import InputError
from ._model import Model
from ._orbit import Orbit
from ._result import Given

if TYPE_CHECKING:
    from ._locus import Locus


class SpecialPoint:
    """A point of a branch at which something changes.

    type: LP fold, PD period doubling, NS torus, BP branches cross, GR a stop is grazed, SL stick is gained or lost, CH
    a complete chatter begins or ends, CO two events meet. value: of the parameter; error: how well it is known.
    what, outcome: in words. occurrence, passage, sliding, jump, verdict: the same as data (docs/reference/command_line.md).
    rotation: of an NS; coefficient: of the normal form, or None. orbit: the orbit there.
    """

    def __init__(self, core: _core.Special, parameter: str, between: tuple[float, float], model: Model) -> None:
        self._core, self._between, self.model = core, between, model
        self.parameter = parameter
        self.type, self.value, self.error = core.type, core.value, core.error
        self.occurrence, self.passage, self.sliding, self.jump = core.occurrence, core.passage, core.sliding, core.jump
        self.rotation, self.after = core.rotation, core.after
        self.coefficient, self.coefficient_error = core.coefficient, core.coefficient_error
        self.verdict = core.verdict

    what = Given[str]("What happens, in words.")
    outcome = Given[str]("What becomes of the branch, in words; '' where it simply goes on.")
    normal_form = Given[str]("'supercritical', 'subcritical', or why there is no coefficient.")
    classes = Given[tuple[str, str]](
        "Of the orbits before and beyond a change of events; two empty words where there is nothing beyond."
    )

    @property
    def orbit(self) -> Orbit:
        return Orbit(self._core.orbit, self.model, {})

    @property
    def born(self) -> list[Orbit]:
        """Orbits of the other branches that begin here or cross: `special.born[0].continuation(...)`."""
        return [Orbit(orbit, self.model, {}) for orbit in self._core.born]

    def sensitivity(self, parameter: str) -> float:
        """d value / d parameter along which the point persists; nan where it is not known.

        Raises InputError for the parameter of the branch itself, and one that the model has not.
        """
        if parameter == self.parameter:
            raise InputError(f"{parameter}: the point is a value of this parameter")
        return self._core.sensitivity(parameter)[0]

    def locus(
        self,
        first: str,
        second: str,
        between: tuple[float, float] | None = None,
        second_between: tuple[float, float] | None = None,
        **options: Any,
    ) -> Locus:
        """This point followed in two parameters, of which one is the branch's.

        between, second_between: their ranges, in the same order. Left out, they are the branch's own and the range that
        the model gives the other parameter. `step`, `points` and `progress` as of `slapstick.locus`.
        """
        from ._locus import follow_special

        if first != self.parameter and second == self.parameter:
            first, second, between, second_between = second, first, second_between, between
        if first != self.parameter:
            raise InputError(f"locus: one of the parameters is that of the branch, {self.parameter}")
        return follow_special(self, second, between or self._between, second_between, **options)

    def __repr__(self) -> str:
        rest = ", ".join(text for text in (self.what, self.outcome, self.normal_form) if text)
        return f"<{self.type} at {self.parameter} = {self.value:.10g}: {rest}>"
