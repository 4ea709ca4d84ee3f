"""Oscillators with dry friction and impacts: exact, event driven.

    import slapstick

    m = slapstick.load("vibro-impact")
    motion = slapstick.simulate(m, periods=200, omega=1.5)
    slapstick.classify(m, omega=1.5).label

Parameters of the model are keywords. Times are in the model's unit, phases in forcing periods. There are no
tolerances to choose. Errors are InputError (a ValueError), NumericalError and StorageError.
"""

from ._attractor import Attractor, Attractors, classify
from ._basins import Basin, Basins, basins
from ._batch import Batch, BatchEvents, batch
from ._branch import Branch, continuation
from ._certificate import Certificate, certify
from ._core import InputError, NumericalError, Parameter, Quantity, StorageError
from ._core import version as __version__
from ._diagram import Diagram, diagram
from ._locus import Locus, Meeting, locus
from ._lyapunov import Exponents, lyapunov
from ._map import ChartCurve, ChartCurves, Map, map  # noqa: A004 (the verb is called so)
from ._model import Model, Parameters, load, models, new
from ._modes import Modes, modes
from ._motion import Events, Motion, simulate
from ._orbit import Orbit, OrbitEvents, orbit, orbits
from ._order_map import OrderMap, order_map
from ._quantity import Measured, Spectrum, measure, quantities, spectrum
from ._result import Interrupted, Result
from ._section import Section, poincare
from ._special import SpecialPoint

__all__ = [
    "Attractor",
    "Attractors",
    "Basin",
    "Basins",
    "Batch",
    "BatchEvents",
    "Branch",
    "Certificate",
    "ChartCurve",
    "ChartCurves",
    "Diagram",
    "Events",
    "Exponents",
    "InputError",
    "Interrupted",
    "Locus",
    "Map",
    "Meeting",
    "Measured",
    "Model",
    "Modes",
    "Motion",
    "NumericalError",
    "Orbit",
    "OrbitEvents",
    "OrderMap",
    "Parameter",
    "Parameters",
    "Quantity",
    "Result",
    "Section",
    "SpecialPoint",
    "Spectrum",
    "StorageError",
    "__version__",
    "basins",
    "batch",
    "certify",
    "classify",
    "continuation",
    "diagram",
    "load",
    "locus",
    "lyapunov",
    "map",
    "measure",
    "models",
    "modes",
    "new",
    "orbit",
    "orbits",
    "order_map",
    "poincare",
    "quantities",
    "simulate",
    "spectrum",
]
