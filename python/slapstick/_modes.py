"""modes: natural frequencies, damping and shapes with contacts stuck or closed."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._model import Model, Start, Values, given_to, model_of, numbers, rows_of, start_of, stops_of
from ._result import Floats, Result, axes


class Modes(Result):
    """Natural modes phi exp(lambda t) of a machine, by rising frequency; arrays with an entry for each of m modes.

    frequency: abs(lambda) of what oscillates, else 0; damping_ratio: NaN of what does not; decay: -Re lambda, negative
    where the motion grows; cycles: Im lambda / (2 pi). shape: the displacements phi, complex, shape (m, n), the largest
    of which is 1.
    amplitude, phase: of these, shape (m, n).
    """

    def __init__(
        self, found: list[_core.NaturalMode], model: Model, values: dict[str, float], options: dict[str, Any]
    ) -> None:
        super().__init__(model, values, options)
        self.frequency: Floats = np.array([mode.frequency for mode in found])
        self.damping_ratio: Floats = np.array([mode.damping_ratio for mode in found])
        self.decay: Floats = np.array([mode.decay for mode in found])
        self.cycles: Floats = np.array([mode.cycles for mode in found])
        rows = (len(found), len(model.state_names) // 2)
        shape = np.array([mode.shape for mode in found], dtype=np.complex128)
        self.shape: NDArray[np.complex128] = shape.reshape(rows)
        self.amplitude: Floats = np.array([mode.amplitude for mode in found], dtype=np.float64).reshape(rows)
        self.phase: Floats = np.array([mode.phase for mode in found], dtype=np.float64).reshape(rows)

    def __len__(self) -> int:
        return len(self.frequency)

    @property
    def coordinates(self) -> list[str]:
        """The names of the columns of `shape`."""
        return self.model.state_names[::2]

    def _columns(self) -> dict[str, Any]:
        return {
            "frequency": self.frequency,
            "damping_ratio": self.damping_ratio,
            "decay": self.decay,
            "cycles": self.cycles,
        }

    def to_pandas(self) -> Any:
        """A DataFrame with the columns of `slapstick modes`: of each coordinate the amplitude and the phase."""
        import pandas as pd

        columns = {"mode": np.arange(1.0, len(self) + 1.0)} | self._columns()
        for name, amplitude, phase in zip(self.coordinates, self.amplitude.T, self.phase.T):
            columns |= {name: amplitude, f"{name}:phase": phase}
        return pd.DataFrame(columns)

    def to_xarray(self) -> Any:
        """A Dataset over `mode` and `coordinate`."""
        import xarray as xr

        about = {"model": self.model.name, "version": self.version} | self.parameters
        data: dict[str, Any] = {name: ("mode", column) for name, column in self._columns().items()}
        data["shape"] = (("mode", "coordinate"), self.shape)
        return xr.Dataset(data, coords={"coordinate": self.coordinates}, attrs=about)

    def plot(self, ax: Any = None) -> Any:
        """Draws the eigenvalues of what oscillates: frequency over decay. Left of zero the motion grows."""
        ax = axes(ax)
        turns = self.frequency > 0
        ax.plot(self.decay[turns], self.frequency[turns], "o", markersize=4, color="tab:blue")
        ax.axvline(0, color="grey", linewidth=0.5)
        ax.set_xlabel("decay")
        ax.set_ylabel("frequency")
        return ax

    def _facts(self) -> list[tuple[str, str]]:
        shown = ", ".join(f"{value:.4g}" for value in self.frequency)
        grows = int(np.sum(self.decay < 0))
        return [("frequencies", shown)] + ([("that grow", str(grows))] if grows else [])


@overload
def modes(
    model: Model | str | os.PathLike[str],
    *,
    stuck: str | Sequence[str] = ...,
    closed: str | Sequence[str] = ...,
    start: Start = ...,
    parameters: Mapping[str, float] | None = ...,
    **values: float,
) -> Modes: ...
@overload
def modes(
    model: Model | str | os.PathLike[str],
    *,
    stuck: str | Sequence[str] = ...,
    closed: str | Sequence[str] = ...,
    start: Start = ...,
    parameters: Mapping[str, float] | None = ...,
    **values: ArrayLike,
) -> list[Modes]: ...
def modes(
    model: Model | str | os.PathLike[str],
    *,
    stuck: str | Sequence[str] = (),
    closed: str | Sequence[str] = (),
    start: Start = None,
    parameters: Values | None = None,
    **values: Any,
) -> Modes | list[Modes]:
    """Natural frequencies, damping and shapes of the machine with some contacts held.

    stuck: friction contacts that stick; all others slide, in the sense of the start. closed: stops that are closed: a
    rigid one holds its two sides together, a compliant one acts; all others are open. start: as of `simulate`; it says
    which pieces of polylines hold.
    Parameters are keywords. Where some are arrays of the same shape (k,), or tuples (A, B, k), the result is a list of
    k entries.

    Raises InputError for a name that is no such contact.

    >>> import slapstick
    >>> slapstick.modes("vibro-impact").frequency.round(4).tolist()
    [0.6526, 1.0836]
    >>> slapstick.modes("mode-coupling-brake", closed="belt").decay.round(4).tolist()
    [-0.1187, 0.1187]
    """
    chosen = model_of(model)
    given = given_to(modes, chosen, values, parameters)
    options = {"stuck": stuck, "closed": closed, "start": start}

    def at(fixed: dict[str, float]) -> Modes:
        found = _core.modes(chosen._core, fixed, start_of(start), stops_of(stuck), stops_of(closed))
        return Modes(found, chosen, fixed, options)

    if any(np.ndim(value) > 0 for value in given.values()):
        return [at(row) for row in rows_of(given)[0]]
    return at(numbers(given))
