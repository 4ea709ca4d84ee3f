"""Models: built-in ones, model files, and the table of a model's parameters."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from difflib import get_close_matches
from inspect import signature
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import InputError, Parameter
from ._tables import html_table

Start = Union[Mapping[str, float], ArrayLike, None]
Values = Mapping[str, Any]


class Parameters(Mapping[str, Parameter]):
    """The parameters of a model by name, in the file's order; a table in a notebook.

    >>> import slapstick
    >>> slapstick.load("vibro-impact").parameters["restitution"].range
    '[0, 1]'
    """

    def __init__(self, rows: Sequence[Parameter]) -> None:
        self._rows = {row.name: row for row in rows}

    def __getitem__(self, name: str) -> Parameter:
        return self._rows[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows)

    def _table(self) -> list[tuple[str, ...]]:
        rows = self._rows.values()
        return [(row.name, row.expression or f"{row.value:g}", row.unit, row.range, row.description) for row in rows]

    def __repr__(self) -> str:
        table = [("name", "value", "unit", "range", "meaning"), *self._table()]
        widths = [max(map(len, column)) for column in zip(*table)]
        lines = ("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in table)
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        return html_table(("name", "value", "unit", "range", "meaning"), self._table())

    def to_pandas(self) -> Any:
        """The table as a pandas.DataFrame."""
        import pandas as pd

        return pd.DataFrame(self._table(), columns=["name", "value", "unit", "range", "meaning"]).set_index("name")


class Model:
    """A model file that has been read and checked; it never changes, and threads may share it.

    Made by `load` or `Model.from_toml`.

    >>> import slapstick
    >>> m = slapstick.load("bouncing-ball")
    >>> m.state_names
    ['x', 'v']
    """

    __slots__ = ("__weakref__", "_core", "_names")

    def __init__(self, definition: _core.Definition) -> None:
        self._core = definition
        self._names = frozenset(row.name for row in definition.parameters) | frozenset(definition.groups)

    @staticmethod
    def from_toml(text: str, source: str = "text") -> Model:
        """A model from the text of a model file. Errors call the text `source`.

        Raises InputError naming the line and the key.
        """
        return Model(_core.parse_model(text, source))

    @property
    def name(self) -> str:
        return self._core.name

    @property
    def summary(self) -> str:
        """One line."""
        return self._core.summary

    @property
    def notes(self) -> str:
        """Several lines, or ''."""
        return self._core.notes

    @property
    def parameters(self) -> Parameters:
        """The table of parameters: value, unit, range and meaning of each."""
        return Parameters(self._core.parameters)

    @property
    def groups(self) -> dict[str, list[str]]:
        """Names that set several parameters at once, with their members."""
        return self._core.groups

    @property
    def state_names(self) -> list[str]:
        """The numbers of a state: x1, v1, x2, v2, ..: 2 n names."""
        return self._core.state_names

    @property
    def contacts(self) -> list[str]:
        """All contacts: stops, friction contacts, compliant stops, characteristics."""
        return self._core.contacts

    @property
    def feeds_energy(self) -> list[str]:
        """The parts that can feed energy besides forces and belts, as `slapstick check` lists them."""
        return self._core.feeds_energy

    @property
    def stops(self) -> list[str]:
        """The stops, rigid and compliant, as `stops=` takes them."""
        return self._core.stops

    def values(self, **parameters: float) -> dict[str, float]:
        """Every parameter's value, with some of them set. Raises InputError as the verbs."""
        return self._core.values(numbers(parameters))

    def start(self, **parameters: float) -> NDArray[np.float64]:
        """The model's own start, a state of 2 n numbers."""
        return np.array(self._core.start(numbers(parameters)))

    def period(self, **parameters: float) -> float:
        """The forcing period in the model's unit of time; 1 without forcing."""
        return self._core.period(numbers(parameters))

    def check(self, **parameters: float) -> dict[str, Any]:
        """What `slapstick check` prints: the counts of parts, the period, what can feed energy, the natural modes.

        `natural_modes` are those without contact at the start; a mode that does not oscillate has a decay alone.
        `laid_errors` has the largest error of each friction law that is laid along a curve.
        Raises InputError for values that make no sound model or start.

        >>> [round(mode["frequency"], 4) for mode in load("vibro-impact").check()["natural_modes"]]
        [0.6526, 1.0836]
        """
        return self._core.check(numbers(parameters))

    def to_toml(self, **parameters: float) -> str:
        """A complete model file with these values as defaults. Comments of the file are not kept."""
        return self._core.to_toml(numbers(parameters))

    def __reduce__(self) -> tuple[Any, ...]:
        return Model.from_toml, (self.to_toml(), self.name)

    def __repr__(self) -> str:
        return f"<Model {self.name}: {self.summary}>"

    def _repr_html_(self) -> str:
        from html import escape

        return f"<b>{escape(self.name)}</b>: {escape(self.summary)}{self.parameters._repr_html_()}"


def load(name_or_path: str | os.PathLike[str]) -> Model:
    """A built-in model by its name, or a model file by a path that ends in .toml.

    Raises InputError for an unknown name or an unsound file, StorageError for a file that cannot be read.

    >>> import slapstick
    >>> slapstick.load("vibro-impact")
    <Model vibro-impact: Two blocks with friction between them and a stop; block 1 is forced (the paper's system)>
    """
    return Model(_core.load_model(os.fspath(name_or_path)))


def models() -> list[str]:
    """The names of the built-in models."""
    return _core.builtin_models()


def new(name: str) -> str:
    """The text of a commented model file to start from, with an example of every key."""
    return _core.new_model(name)


def model_of(model: Model | str | os.PathLike[str]) -> Model:
    return model if isinstance(model, Model) else load(model)


def given_to(verb: Callable[..., Any], model: Model, values: Values, parameters: Values | None) -> Values:
    """Values by keyword and those of `parameters`. Raises InputError for an option that is mistyped, or a value given twice."""
    given = values if parameters is None else {**values, **parameters}
    for name in values:
        if parameters is not None and name in parameters:
            raise InputError(f"{name} is set twice")
    for name in values:
        if name not in model._names:
            refuse_option(verb, model, name)
    return given


def refuse_option(verb: Callable[..., Any], model: Model, name: str) -> None:
    """A word that is no parameter but like an option. What is neither is left to the library, which lists the parameters."""
    if name in ("tol", "rtol", "atol", "tolerance"):
        raise InputError(f"{name}: there is no tolerance; every event is found to the last digits")
    options = [option for option in signature(verb).parameters if option not in ("model", "values")]
    like = get_close_matches(name, options, 1, 0.75)
    if like and not get_close_matches(name, model._names, 1, 0.75):
        raise InputError(f"{name}: neither a parameter of {model.name} nor an option; did you mean the option {like[0]}?")


def stops_of(stops: str | Sequence[str]) -> list[str]:
    """Names of stops; one may stand by itself."""
    return [stops] if isinstance(stops, str) else list(stops)


def sweep_of(name: str, value: Any) -> NDArray[np.float64]:
    """The values of a parameter that varies: a tuple (A, B, COUNT) with both ends, or an array."""
    if not isinstance(value, tuple):
        return np.asarray(value, dtype=np.float64)
    if len(value) != 3 or number(name, value[2]) < 2 or not number(name, value[0]) < number(name, value[1]):
        raise InputError(f"{name}: {value!r} is not of the form (A, B, COUNT) with A < B and COUNT at least 2")
    count = int(value[2])
    return np.array([_core.sweep_value(float(value[0]), float(value[1]), count, i) for i in range(count)])


def rows_of(given: Values) -> tuple[list[dict[str, float]], dict[str, NDArray[np.float64]]]:
    """Values that are arrays of one length, row by row beside the fixed ones; and the columns. Raises InputError."""
    columns = {name: sweep_of(name, value) for name, value in given.items() if np.ndim(value) > 0}
    if len({column.shape for column in columns.values()}) != 1 or any(c.ndim != 1 for c in columns.values()):
        raise InputError(", ".join(columns) + ": arrays of one length are wanted")
    fixed = {name: number(name, value) for name, value in given.items() if name not in columns}
    rows = [fixed | dict(zip(columns, row)) for row in zip(*(column.tolist() for column in columns.values()))]
    return rows, columns


def numbers(values: Values) -> dict[str, float]:
    """Values of parameters as floats. Raises InputError for what is no number."""
    return {name: number(name, value) for name, value in values.items()}


def number(name: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise InputError(f"{name}: {value!r} is not a number") from None


def start_of(start: Start) -> dict[str, float] | list[float] | None:
    """A start as the library takes it."""
    if start is None:
        return None
    if isinstance(start, Mapping):
        return numbers(start)
    if isinstance(start, str):
        raise InputError(f"start: {start!r} is not a state: numbers by name, or 2 n numbers")
    return [number("start", value) for value in np.ravel(np.asarray(start))]
