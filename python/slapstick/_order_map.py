"""order_map: the lines of a quantity over a run-up."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from . import _core, _progress
from ._core import InputError
from ._model import Model, Start, Values, given_to, model_of, numbers, start_of
from ._obeys import obeys
from ._progress import Progress
from ._result import Floats, Given, Result, axes


class OrderMap(Result):
    """The lines of a quantity at each value of a run-up (a waterfall).

    value, time and period: of each of the k values, shape (k,); time at the value's begin, in the model's unit, period
    of the forcing. order: shape (m,). amplitude: in the quantity's unit, shape (m, k).
    """

    def __init__(
        self, found: _core.OrderMap, parameter: str, model: Model, values: dict[str, float], options: dict[str, Any]
    ) -> None:
        super().__init__(model, values, options)
        self._core, self.parameter, self._free = found, parameter, (parameter,)

    _core: _core.OrderMap

    value = Given[Floats]("Of the parameter, shape (k,).")
    time = Given[Floats]("At the begin of each value, in the model's unit, shape (k,).")
    period = Given[Floats]("Of the forcing at each value, shape (k,).")
    order = Given[Floats]("In multiples of the forcing, shape (m,).")
    amplitude = Given[Floats]("Of each line at each value, shape (m, k).")

    @property
    def frequency(self) -> Floats:
        """Cycles per unit of time, shape (m, k)."""
        frequency: Floats = self.order[:, None] / self.period[None, :]
        return frequency

    def plot(self, ax: Any = None, *, decibels: float = 60, **style: Any) -> Any:
        """Draws levels over value and order, `decibels` below the largest. Needs matplotlib."""
        ax = axes(ax)
        level = 20 * np.log10(np.maximum(self.amplitude, 1e-300) / self.amplitude.max())
        mesh = ax.pcolormesh(self.value, self.order, level, **({"vmin": -decibels, "shading": "nearest"} | style))
        ax.figure.colorbar(mesh, label=f"level of {self.options['of']} [dB]")
        ax.set_xlabel(self.parameter)
        ax.set_ylabel("order")
        return ax

    def _facts(self) -> list[tuple[str, str]]:
        return [("values", str(len(self.value))), ("orders", str(len(self.order)))]


@obeys("spectrum")
def order_map(
    model: Model | str | os.PathLike[str],
    of: str,
    parameter: str,
    ends: tuple[float, float],
    *,
    over: int,
    hold: int = 1,
    settle: int = 0,
    orders: float = 20,
    start: Start = None,
    progress: Progress = None,
    parameters: Values | None = None,
    **values: Any,
) -> OrderMap:
    """The lines of a quantity over a run-up: exact integrals over whole forcing periods, impulses included.

    The parameter goes from one of `ends` to the other over `over` forcing periods, in steps of `hold` periods; the first
    `settle` of these are not measured. orders: the highest one, in multiples of the forcing; the lines are at multiples
    of 1 / (hold - settle). Where the motion has settled on a cycle they are those of `spectrum`.

    Raises InputError for an unknown quantity or one at impacts, NumericalError if the motion cannot go on.

    >>> import slapstick
    >>> found = slapstick.order_map("shaken-table", "a", "acceleration", (1.2, 1.25), over=80, hold=40, settle=39, orders=3)
    >>> found.amplitude.shape, found.amplitude[3].round(6).tolist()
    ((4, 2), [2.0, 2.0])
    """
    chosen = model_of(model)
    fixed = numbers(given_to(order_map, chosen, values, parameters))
    if hold < 1 or over % hold != 0 or over // hold < 2:
        raise InputError(f"over: {over} periods are not two or more steps of hold = {hold}")
    options = {"of": of, "ends": ends, "over": over, "hold": hold, "settle": settle, "orders": orders, "start": start}
    begin, end = (float(value) for value in ends)
    call = (chosen._core, fixed, start_of(start), of, parameter, begin, end, over, hold, settle, float(orders))
    found = _progress.run(_core.order_map, call, "periods", over, progress)
    return OrderMap(found, parameter, chosen, fixed, options)
