"""orbit, orbits: periodic orbits, stable or not."""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _core, _progress
from ._model import Model, Start, Values, given_to, model_of, numbers, start_of
from ._obeys import obeys
from ._motion import Motion, simulate
from ._progress import Progress
from ._quantity import Measured, measured_orbit
from ._result import Floats, Given, Interrupted, Result
from ._tables import categorical, state_columns, words

if TYPE_CHECKING:
    from ._branch import Branch


class OrbitEvents:
    """The events of one cycle, as columns; the last one ends the cycle.

    t: time, shape (k,); kind, contact, mode: words, mode being that after the event; w: relative velocity just before;
    before: the state just before, shape (2 n, k).
    """

    def __init__(self, core: _core.OrbitEvents, names: list[str]) -> None:
        self._core, self._names = core, names
        self.t: NDArray[np.float64] = core.t
        self.w: NDArray[np.float64] = core.w
        self.before: NDArray[np.float64] = core.before
        self.kind: NDArray[np.str_] = words(core.kind_names, core.kind_codes)
        self.contact: NDArray[np.str_] = words(core.contact_names, core.contact_codes)
        self.mode: NDArray[np.str_] = words(core.mode_names, core.mode_codes)

    def __len__(self) -> int:
        return len(self.t)

    def to_pandas(self) -> Any:
        """A DataFrame of these columns."""
        import pandas as pd

        core = self._core
        columns = {
            "time": self.t,
            "kind": categorical(core.kind_names, core.kind_codes),
            "contact": categorical(core.contact_names, core.contact_codes),
            "mode_after": categorical(core.mode_names, core.mode_codes),
            "w": self.w,
        }
        return pd.DataFrame(columns | state_columns(self._names, self.before))

    def __repr__(self) -> str:
        return f"<{len(self)} events: " + ", ".join(f"{k} {c}" for k, c in zip(self.kind, self.contact)) + ">"


class Orbit(Result):
    """A periodic orbit.

    label: '1-1-II', or 'free-1-II' where nothing drives the motion; n: forcing periods in a cycle, or how often the
    rarest event of a free one happens in it; p: impacts in a cycle, inf with complete chatter.
    multipliers: of the return map, complex, largest first; stable: all are inside the unit circle.
    state: at phase 0, shape (2 n,); cycle: the period of the orbit in the model's unit of time.
    is_motion: the simulator does the same; if not, why. t and y: samples of one cycle, as of `simulate`.
    """

    def __init__(self, core: _core.Orbit, model: Model, options: dict[str, Any]) -> None:
        super().__init__(model, core.values, options)
        self._core = core

    label = Given[str]("'1-1-II', '2-inf-II'.")
    n = Given[int]("Forcing periods in a cycle; where nothing drives it, how often its rarest event happens.")

    @property
    def p(self) -> float:
        return float("inf") if self._core.chatter else self._core.impacts

    sticking = Given[bool]("Whether there is a stick phase in the cycle.")
    stable = Given[bool | None](
        "Whether all multipliers are inside the unit circle; None where the return map has no derivative: contacts "
        "that act on each other meet their events at one instant."
    )
    family = Given[int]("Dimensions of the continuum of orbits that this is a member of; 0: it is isolated.")
    multipliers = Given[NDArray[np.complex128]](
        "Of the return map, complex, largest first, shape (k,); empty where it has no derivative."
    )
    cycle = Given[float]("The period of the orbit in the model's unit of time.")
    is_motion = Given[bool]("Whether the simulator does the same.")
    why = Given[str]("What the simulator does instead; '' if it does the same.")
    drift = Given[Floats](
        "Along rigid translations, in the unit of each coordinate, for each cycle, shape (n,); empty without such."
    )
    settles = Given[bool]("Whether the motion from the start settles on it.")
    symmetric = Given[bool]("Whether it is its own image half a forcing period later.")

    @cached_property
    def state(self) -> NDArray[np.float64]:
        return np.array(self._core.state)

    @cached_property
    def events(self) -> OrbitEvents:
        return OrbitEvents(self._core.events, self.model.state_names)

    extremes = Given[dict[str, tuple[float, float]]](
        "The least and the largest value of every number of the state, in the model's units, exact to rounding."
    )
    energy = Given[dict[str, Any]](
        "Of one cycle, in the model's unit of energy: input, damping, friction and impacts by contact, balance."
    )
    margins = Given[list[tuple[str, str, float]]](
        "How near the cycle comes to a change of its events: what is measured, of which contact, the least value."
    )

    def measure(self, of: str | Sequence[str], *, sensitivity: str | Sequence[str] = ()) -> Measured:
        """Statistics of quantities over the cycle, exact but for rounding, also where the orbit is unstable.

        of: "Q[:STAT],.." or a list of such words, as of `slapstick.measure`; sensitivity: parameters that derivatives
        are by, likewise.

        Raises InputError for an unknown quantity or statistic (the nearest is named).

        >>> import slapstick
        >>> slapstick.orbit("vibro-impact", "1-1", omega=2.9).measure("w:number")["w:number"]
        1.0
        """
        return measured_orbit(self._core, self.model, self._values, of, sensitivity, self.options)

    def motion(self, *, samples: int = 200) -> Motion:
        """One cycle as `simulate` gives it. Of an unstable orbit rounding grows by its multipliers."""
        length: dict[str, Any] = {"periods": self.n} if self.n else {"time": self.cycle}
        return simulate(self.model, samples=samples, start=self.state, parameters=self._values, **length)

    @cached_property
    def _motion(self) -> Motion:
        return self.motion()

    @property
    def t(self) -> NDArray[np.float64]:
        return self._motion.t

    @property
    def y(self) -> NDArray[np.float64]:
        return self._motion.y

    def to_pandas(self) -> Any:
        """One cycle as `Motion.to_pandas` gives it."""
        return self._motion.to_pandas()

    def to_xarray(self) -> Any:
        """One cycle as `Motion.to_xarray` gives it."""
        return self._motion.to_xarray()

    def plot(self, ax: Any = None) -> Any:
        """Draws one cycle, as `Motion.plot`."""
        return self._motion.plot(ax)

    def continuation(self, parameter: str, between: tuple[float, float] | None = None, **options: Any) -> Branch:
        """The branch through this orbit. `step`, `points`, `same_events`, `progress` as of `slapstick.continuation`."""
        from ._branch import continue_orbit

        return continue_orbit(self, parameter, between, **options)

    def _facts(self) -> list[tuple[str, str]]:
        largest = f"{self.multipliers[0]:.6g}" if len(self.multipliers) else "0"
        facts = [("class", self.label), ("stable", {True: "yes", False: "no", None: "unknown"}[self.stable]), ("largest multiplier", largest)]
        return facts + ([] if self.is_motion else [("no motion", self.why)])


def wish_of(options: dict[str, Any]) -> _core.OrbitWish:
    names = ("orbit", "stable", "symmetric", "nearest", "transient", "starts", "seconds", "seed")
    return _core.OrbitWish(*(options[name] for name in names))


@obeys("orbit")
def orbit(
    model: Model | str | os.PathLike[str],
    orbit: str = "",
    *,
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
) -> Orbit:
    """A periodic orbit, stable or not, by Newton's method; the simulator verifies it.

    orbit: 'N-P', 'N-P-I' or 'N-P-II': forcing periods (returns, where nothing drives the motion: 'free-P-I' takes any
    number), impacts ('inf' with complete chatter), with stick or without; '': what the motion settles on. stable, symmetric: conditions; nearest: of those that a search finds, the nearest
    to the start. transient: forcing periods or returns before the first try. A search looks through `starts` motions (64), or
    ends after `seconds` (10; none if starts is given); seed: of its starts.

    Raises NumericalError if there is none, saying what was tried and found instead.

    >>> import slapstick
    >>> slapstick.orbit("vibro-impact", "1-1", omega=2.2).label
    '1-1-I'
    """
    chosen = model_of(model)
    fixed = numbers(given_to(VERB, chosen, values, parameters))
    options: dict[str, Any] = {"orbit": orbit, "stable": stable, "symmetric": symmetric, "nearest": nearest}
    options["transient"] = transient
    options |= {"starts": starts, "seconds": seconds, "seed": seed, "start": start}
    arguments = (chosen._core, fixed, start_of(start), wish_of(options))
    return Orbit(_progress.run(_core.find_orbit, arguments, "orbits", 1, progress), chosen, options)


VERB = orbit  # which has an argument of its own name


@obeys("orbit", most_n="max_n")
def orbits(
    model: Model | str | os.PathLike[str],
    *,
    most_n: int = 1,
    stable: bool | None = None,
    symmetric: bool | None = None,
    starts: int = 0,
    seconds: float = 0.0,
    seed: int = 1,
    start: Start = None,
    progress: Progress = None,
    parameters: Values | None = None,
    **values: float,
) -> list[Orbit]:
    """Every orbit of up to `most_n` forcing periods, or returns of a free motion, that a search finds; options as of `orbit`.

    A search is no proof of completeness.
    """
    chosen = model_of(model)
    fixed = numbers(given_to(orbits, chosen, values, parameters))
    options: dict[str, Any] = {"orbit": "", "stable": stable, "symmetric": symmetric, "nearest": False}
    options |= {"transient": 0, "starts": starts, "seconds": seconds, "seed": seed, "start": start}
    arguments = (chosen._core, fixed, start_of(start), wish_of(options), most_n)
    found, complete = _progress.run(_core.find_orbits, arguments, "motions", starts or 64, progress)
    result = [Orbit(one, chosen, options) for one in found]
    if not complete:
        raise Interrupted(result)
    return result
