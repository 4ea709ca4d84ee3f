"""What branches and loci have in common: orbits that were followed both ways until something ended them."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from typing import Any, TypeVar

from ._model import Model
from ._orbit import Orbit
from ._result import Given, GivenTruths, Interrupted, Result


class Followed(Result):
    """Orbits one after the other, as columns of shape (k,). `followed[i]` is the orbit of a point."""

    def __init__(self, core: Any, model: Model, values: dict[str, float], options: dict[str, Any]) -> None:
        super().__init__(model, values, options)
        self._core = core

    is_motion = GivenTruths("Whether the simulator does the same, shape (k,).")
    ended = Given[str]("Why they end at either side, in words.")
    failed = Given[bool]("Whether what is beyond an end is not known.")
    complete = Given[bool]("False after Ctrl-C.")

    def __len__(self) -> int:
        return len(self._core)

    def __getitem__(self, index: int) -> Orbit:
        return Orbit(self._core.orbit(range(len(self))[index]), self.model, {})

    def __iter__(self) -> Iterator[Orbit]:
        return (self[i] for i in range(len(self)))


F = TypeVar("F", bound=Followed)


def finished(followed: F, verb: str, frames: int) -> F:
    """Says if the work was interrupted, or ended for a reason that is not known. frames: from here to the caller's."""
    if not followed.complete:
        raise Interrupted(followed)
    if followed.failed:
        warnings.warn(f"{verb}: {followed.ended}", RuntimeWarning, stacklevel=frames)
    return followed
