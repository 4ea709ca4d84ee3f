"""What all results have in common: they remember where they come from, and can be shown."""

from __future__ import annotations

from typing import Any, Generic, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._model import Model
from ._tables import html_table, words

T = TypeVar("T")
Floats = NDArray[np.float64]


class Given(Generic[T]):
    """An attribute that the extension's object `_core` gives, under the same name or another. It is read once."""

    def __init__(self, doc: str = "", name: str = "") -> None:
        self.__doc__, self._of_core = doc, name

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name
        self._of_core = self._of_core or name

    @overload
    def __get__(self, of: None, owner: type) -> Given[T]: ...
    @overload
    def __get__(self, of: Any, owner: type) -> T: ...
    def __get__(self, of: Any, owner: type) -> Given[T] | T:
        if of is None:
            return self
        known: dict[str, Any] = of.__dict__
        if self._name not in known:
            known[self._name] = self._read(of._core)
        value: T = known[self._name]
        return value

    def __set__(self, of: Any, value: object) -> None:
        raise AttributeError(f"{self._name} is what was computed; it cannot be set")

    def _read(self, core: Any) -> Any:
        return getattr(core, self._of_core)


class GivenTruths(Given[NDArray[np.bool_]]):
    """The same of a column of truths."""

    def _read(self, core: Any) -> Any:
        return super()._read(core).view(np.bool_)


class GivenWords(Given[NDArray[np.str_]]):
    """The same of a column of words, which the extension keeps as numbers `NAME_codes` of a list `NAME_names`."""

    def _read(self, core: Any) -> Any:
        return words(getattr(core, self._of_core + "_names"), getattr(core, self._of_core + "_codes"))


class Result:
    """A result of a verb.

    model: the Model; parameters: every parameter's value, but for those that vary; options: what the verb was called
    with; version: of slapstick.
    """

    _free: tuple[str, ...] = ()  # parameters that vary

    def __init__(self, model: Model, values: dict[str, float], options: dict[str, Any]) -> None:
        self.model = model
        self.options = options
        self.version: str = _core.version
        self._values = values

    @property
    def parameters(self) -> dict[str, float]:
        """The value of every parameter of the model, but for those that vary."""
        values = self.model._core.values(self._values)
        return {name: value for name, value in values.items() if name not in self._free}

    def _facts(self) -> list[tuple[str, str]]:
        """What the representations show, by name."""
        return []

    def _title(self) -> str:
        fixed = {name: value for name, value in self._values.items() if name not in self._free}
        changed = ", ".join(f"{name} = {value:g}" for name, value in fixed.items())
        return f"{type(self).__name__} of {self.model.name}" + (f" at {changed}" if changed else "")

    def __repr__(self) -> str:
        facts = ", ".join(f"{name} {text}" for name, text in self._facts())
        return f"<{self._title()}: {facts}>" if facts else f"<{self._title()}>"

    def _repr_html_(self) -> str:
        from html import escape

        return f"<b>{escape(self._title())}</b>" + html_table(("", ""), self._facts())


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a call. `result` has what was complete by then; its `complete` is False.

    In a notebook or at the prompt it is found as `sys.last_value.result`.
    """

    def __init__(self, result: Any) -> None:
        super().__init__("interrupted; what is complete is the attribute `result` of this exception")
        self.result = result


def axes(ax: Any) -> Any:
    """The axes to draw into: those given, or new ones."""
    if ax is not None:
        return ax
    from matplotlib import pyplot

    return pyplot.subplots(figsize=(6.4, 4.0), layout="constrained")[1]
