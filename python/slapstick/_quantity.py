"""quantities, measure, spectrum: forces, accelerations, energies and impacts of a motion, without sampling."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from . import _core, _progress
from ._core import InputError, Quantity, StopImpacts
from ._model import Model, Start, Values, given_to, model_of, numbers, start_of
from ._obeys import obeys
from ._progress import Progress
from ._result import Floats, Given, Result, axes


def quantities(
    model: Model | str | os.PathLike[str], *, parameters: Mapping[str, float] | None = None, **values: float
) -> list[Quantity]:
    """What can be measured on a model: name, unit, kind and meaning of each quantity.

    >>> import slapstick
    >>> [q.name for q in slapstick.quantities("bouncing-ball")][:6]
    ['x', 'v', 'a', 'gap_floor', 'w_floor', 'F_floor']
    """
    chosen = model_of(model)
    return _core.quantities(chosen._core, numbers(given_to(quantities, chosen, values, parameters)))


class Measured(Result, Mapping[str, float]):
    """Statistics of quantities: a mapping from "Q:STAT" to a number.

    label: the class of the cycle that was measured, or "" for a time; duration: in the model's unit of time.
    impacts: by the name of the stop, each with the arrays w, impulse and energy_lost, shape (number,), by size.
    With `sensitivity`: the exact derivatives of all numbers by parameters, and their matrix `jacobian`.
    """

    def __init__(
        self,
        found: _core.Measures,
        wanted: list[tuple[Quantity, str]],
        model: Model,
        values: dict[str, float],
        options: dict[str, Any],
    ) -> None:
        super().__init__(model, values, options)
        self._core = found
        places = [
            (k, quantity, name)
            for k, (quantity, one) in enumerate(wanted)
            for name in ([one] if one else _core.usual_statistics(quantity))
        ]
        self._numbers = {f"{quantity.name}:{name}": found.statistic(k, quantity, name) for k, quantity, name in places}
        self.sensitivity: dict[str, dict[str, float]] = {
            parameter: {f"{quantity.name}:{name}": found.rate(j, k, name) for k, quantity, name in places}
            for j, parameter in enumerate(options.get("sensitivity", []))
        }

    _core: _core.Measures

    duration = Given[float]("Of the cycle, or of the motion that was measured.")
    label = Given[str]("The class of the cycle; '' if a motion was measured.")

    @property
    def jacobian(self) -> Floats:
        """The derivatives of all numbers by all parameters of `sensitivity`: shape (numbers, parameters)."""
        columns = [list(rates.values()) for rates in self.sensitivity.values()]
        return np.array(columns, dtype=np.float64).reshape(len(columns), len(self)).T

    @property
    def impacts(self) -> dict[str, StopImpacts]:
        """The impacts of each stop."""
        return {stop.stop: stop for stop in self._core.stops}

    def __getitem__(self, name: str) -> float:
        return self._numbers[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._numbers)

    def __len__(self) -> int:
        return len(self._numbers)

    def _facts(self) -> list[tuple[str, str]]:
        return [(name, f"{value:.6g}") for name, value in self._numbers.items()]


def wanted_of(
    of: str | Sequence[str], chosen: Model, values: dict[str, float]
) -> list[tuple[Quantity, str]]:
    words = of.split(",") if isinstance(of, str) else list(of)
    known = _core.quantities(chosen._core, values)
    pairs = (word.partition(":") for word in words)
    return [(_core.find_quantity(known, name), statistic) for name, _, statistic in pairs]


def words_of(names: str | Sequence[str]) -> list[str]:
    """ "a,b" or a list of words."""
    return [word for word in names.split(",") if word] if isinstance(names, str) else list(names)


def statistics_of(
    argument: str, of: str | Sequence[str], chosen: Model, values: dict[str, float]
) -> list[tuple[Quantity, str]]:
    """The same, each with a statistic. argument: what messages name."""
    wanted = wanted_of(of, chosen, values)
    for quantity, name in wanted:
        if not name:
            raise InputError(f"{argument}: '{quantity.name}' needs a statistic, as '{quantity.name}:rms'")
        _core.check_statistic(quantity, name)
    return wanted


@obeys("measure")
def measure(
    model: Model | str | os.PathLike[str],
    of: str | Sequence[str],
    *,
    periods: float = 0,
    sensitivity: str | Sequence[str] = (),
    transient: float | None = None,
    start: Start = None,
    progress: Progress = None,
    parameters: Values | None = None,
    **values: Any,
) -> Measured:
    """Statistics of quantities, exact but for rounding: over the cycle that the motion settles on, or over `periods`.

    of: "Q[:STAT],.." or a list of such words; STAT is mean, rms, min, max, min_at, max_at, peak_to_peak, crest,
    impulse or number; of a cycle also h1 .. h16 and h1:phase ..; of quantities at impacts also q05 .. q95. Without one:
    all that are usual. Where there is no cycle 1000 periods are measured, or the record of a signal.
    transient: forcing periods that are left out first; None: 500, or what comes before the record.

    sensitivity: names of parameters or groups; the result then has the exact derivative of every number by each, of a
    cycle as long as it keeps its events.

    Raises InputError for an unknown quantity or statistic (the nearest is named), NumericalError if the motion cannot
    go on, or the cycle has no derivative.

    >>> import slapstick
    >>> found = slapstick.measure("shaken-table", "impulse:mean,F_table:mean")
    >>> found.label, round(found["F_table:mean"], 9)
    ('1-1-I', 1.0)
    >>> slapstick.measure("shaken-table", "F_table:mean", sensitivity="gravity").jacobian.round(9).tolist()
    [[1.0]]
    """
    chosen = model_of(model)
    fixed = numbers(given_to(measure, chosen, values, parameters))
    by = words_of(sensitivity)
    options = {"of": of, "periods": periods, "sensitivity": by, "transient": transient, "start": start}
    wanted = wanted_of(of, chosen, fixed)
    names = [quantity.name for quantity, _ in wanted]
    call = (chosen._core, fixed, start_of(start), names, by, transient, float(periods))
    found = _progress.run(_core.measure, call, "periods", 500 if transient is None else transient, progress)
    return Measured(found, wanted, chosen, fixed, options)


def measured_orbit(
    core: _core.Orbit,
    model: Model,
    values: dict[str, float],
    of: str | Sequence[str],
    sensitivity: str | Sequence[str],
    options: dict[str, Any],
) -> Measured:
    """Statistics over the cycle of an orbit: what `Orbit.measure` gives."""
    wanted = wanted_of(of, model, values)
    found = _core.measure_orbit(core, [quantity.name for quantity, _ in wanted], words_of(sensitivity))
    return Measured(found, wanted, model, values, options | {"of": of, "sensitivity": words_of(sensitivity)})


class Spectrum(Result):
    """The Fourier lines of a cycle, or the power density of a motion.

    order: in multiples of the forcing, shape (k,); frequency: cycles per unit of time. Of a cycle: amplitude and phase of
    A cos(2 pi f t + phase), t from phase 0. Of a motion: density, in unit^2 per unit of frequency, with its resolution
    and the factors of its 95 % confidence interval.
    """

    def __init__(self, found: _core.Spectra, model: Model, values: dict[str, float], options: dict[str, Any]) -> None:
        super().__init__(model, values, options)
        self._core = found

    _core: _core.Spectra

    label = Given[str]("The class of the cycle; '' of a density.")
    of_cycle = Given[bool]("Whether these are lines of a cycle.")
    order = Given[Floats]("Multiples of the forcing; without forcing of the cycle.")
    frequency = Given[Floats]("Cycles per unit of time.")
    amplitude = Given[Floats]("Of the lines; empty of a density.")
    phase = Given[Floats]("Of the cosines, in radians.")
    density = Given[Floats]("One-sided power spectral density; empty of lines.")
    impulses = Given[int]("Impulses in a cycle: with some the lines do not decay.")
    mean_square = Given[float]("Of the quantity over the cycle, between impacts.")
    mean_square_of_lines = Given[float]("Of the lines: Parseval's sum.")
    resolution = Given[float]("Noise bandwidth of a density, as a frequency.")
    degrees_of_freedom = Given[float]("Of a density at each frequency.")
    confidence = Given[tuple[float, float]]("The true density is between these times the one given, with 95 %.")

    def octaves(self, parts: int = 3, unit_of_time: float = 1.0) -> Floats:
        """Bands of octaves (1) or thirds (3): columns centre, from, to in Hz, and the mean square; shape (k, 4).

        unit_of_time: the model's, in seconds.
        """
        return np.array(self._core.octaves(parts, unit_of_time), dtype=np.float64).reshape(-1, 4)

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """Draws amplitude or density over the order, on a logarithmic axis. Needs matplotlib."""
        ax = axes(ax)
        ax.set_xlabel("order")
        ax.set_yscale("log")
        if self.of_cycle:
            ax.vlines(self.order, 0, self.amplitude, **style)
            ax.set_ylabel(f"amplitude of {self.options['of']}")
        else:
            ax.plot(self.order, self.density, **style)
            ax.set_ylabel(f"power density of {self.options['of']}")
        return ax

    def _facts(self) -> list[tuple[str, str]]:
        return [("lines of", self.label) if self.of_cycle else ("density", ""), ("points", str(len(self.order)))]


@obeys("spectrum")
def spectrum(
    model: Model | str | os.PathLike[str],
    of: str,
    *,
    orders: float = 20,
    periods: float = 0,
    stretch: float = 64,
    transient: float | None = None,
    start: Start = None,
    progress: Progress = None,
    parameters: Values | None = None,
    **values: Any,
) -> Spectrum:
    """The spectrum of a quantity: exact Fourier lines of the cycle that the motion settles on, impulses included.

    With `periods`, or where there is no cycle (then 2048 of them, or the record of a signal): a power density by Welch's
    method over stretches of `stretch` forcing periods, each half in the next one, with the window of Hann. orders: the
    highest one, in multiples of the forcing.

    Raises InputError for an unknown quantity or one at impacts, NumericalError if the motion cannot go on.

    >>> import slapstick
    >>> slapstick.spectrum("shaken-table", "a", orders=4).amplitude[2:].round(9).tolist()
    [2.0, 2.0, 2.0]
    """
    chosen = model_of(model)
    fixed = numbers(given_to(spectrum, chosen, values, parameters))
    options = {"of": of, "orders": orders, "periods": periods, "stretch": stretch, "transient": transient, "start": start}
    call = (chosen._core, fixed, start_of(start), of, float(orders), transient, float(periods), float(stretch))
    found = _progress.run(_core.spectrum, call, "periods", 500 if transient is None else transient, progress)
    return Spectrum(found, chosen, fixed, options)
