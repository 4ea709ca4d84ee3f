"""Oscillators with dry friction and impacts: exact, event driven.

    import slapstick

    m = slapstick.load("vibro-impact")
    motion = slapstick.simulate(m, periods=200, omega=1.5)
    slapstick.classify(m, omega=1.5).label

Parameters of the model are keywords. Times are in the model's unit, phases in forcing periods. There are no
tolerances to choose. Errors are InputError (a ValueError), NumericalError and StorageError.
"""

from ._attractor import Attractor, Attractors, classify
from ._core import InputError, NumericalError, Parameter, StorageError, __version__
from ._model import Model, Parameters, load, models, new
from ._motion import Events, Motion, simulate
from ._result import Interrupted, Result

__all__ = [
    "Attractor",
    "Attractors",
    "Events",
    "InputError",
    "Interrupted",
    "Model",
    "Motion",
    "NumericalError",
    "Parameter",
    "Parameters",
    "Result",
    "StorageError",
    "__version__",
    "classify",
    "load",
    "models",
    "new",
    "simulate",
]
