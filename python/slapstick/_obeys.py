"""Keywords are held to what the command line demands of the options of the same names, before anything runs."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from inspect import signature
from typing import Any, TypeVar, cast

from ._core import InputError
from ._rules import RULES

F = TypeVar("F", bound=Callable[..., Any])

# The command line's --start of these names is a choice, Python's a state.
NOT_THE_OPTION = ("start",)


def obeys(verb: str, least: Mapping[str, int] = {}, **called: str) -> Callable[[F], F]:
    """Of a function: its keywords obey the rules of a verb.

    least: counts that Python allows to be less. called: the option of a keyword that has another name.
    A keyword that has its default counts as not given, and one that no rule speaks of is left to the function.
    Whole numbers may be floats.
    """

    def of(call: F) -> F:
        names = tuple(signature(call).parameters)
        defaults = {name: parameter.default for name, parameter in signature(call).parameters.items()}
        options = {"threads": RULES["map"]["threads"]} | RULES[verb]  # of `classify` too, with arrays
        rules = {name: Rule(options.get(called.get(name, name), {}), least.get(name)) for name in names if name not in NOT_THE_OPTION}

        @wraps(call)
        def obeyed(*args: Any, **kwargs: Any) -> Any:
            values = dict(zip(names, args)) | kwargs if args else kwargs
            given = [name for name, value in values.items() if name in rules and not same(value, defaults[name])]
            for name in given:
                kept = rules[name].kept(name, values[name])
                if kept is not values[name]:  # whole, and a float
                    place = names.index(name)
                    kwargs, args = (kwargs | {name: kept}, args) if name in kwargs else (kwargs, (*args[:place], kept, *args[place + 1 :]))
                if rules[name].company:
                    demand_company(name, rules, {**defaults, **values}, given)
            return call(*args, **kwargs)

        return cast(F, obeyed)

    return of


class Rule:
    """What one option demands of its value, and of the other options."""

    __slots__ = ("company", "count", "needs", "number", "without", "words")

    def __init__(self, rule: Mapping[str, Any], least: int | None) -> None:
        self.count: tuple[int, int] | None = rule.get("count")
        if self.count and least is not None:
            self.count = (least, self.count[1])
        self.number: str | None = rule.get("number")
        self.words: list[str] | None = rule.get("words")
        self.without: list[tuple[str, str | None]] = rule.get("without", [])
        self.needs: list[list[tuple[str, str | None]]] = rule.get("needs", [])
        self.company = bool(self.without or self.needs)

    def kept(self, name: str, value: Any) -> Any:
        """The value, a count as an integer. Raises InputError."""
        if self.count is not None:
            least, most = self.count
            return value if type(value) is int and least <= value <= most else whole(name, value, least, most)
        if self.number is not None:
            demand_number(name, value, self.number)
        if self.words is not None and value not in self.words:
            raise InputError(f"{name} = {value!r} is not one of " + ", ".join(self.words))
        return value


def same(value: Any, default: Any) -> bool:
    return value is default or (type(value) is type(default) and isinstance(value, (int, float, str)) and value == default)


def whole(name: str, value: Any, least: int, most: int) -> int:
    """An integer between two others, also if it is a float. Raises InputError."""
    count = None
    if isinstance(value, float) and value.is_integer():
        count = int(value)
    elif not isinstance(value, bool):
        try:
            count = operator.index(value)
        except TypeError:
            pass
    if count is None:
        raise InputError(f"{name} = {value!r} is not a whole number")
    if not least <= count <= most:
        raise InputError(f"{name} = {value!r} is outside [{least}, {most}]")
    return count


def demand_number(name: str, value: Any, interval: str) -> None:
    """interval: '(0, 0.2]' or '' for all finite numbers. Raises InputError."""
    try:
        number = float("nan") if isinstance(value, (bool, str)) else float(value)
    except (TypeError, ValueError):
        number = float("nan")
    if math.isnan(number):
        raise InputError(f"{name} = {value!r} is not a number")
    low, high = (float(end) for end in interval[1:-1].split(",")) if interval else (-math.inf, math.inf)
    above = number > low or (number == low and interval.startswith("["))
    below = number < high or (number == high and interval.endswith("]"))
    if not (math.isfinite(number) and above and below):
        raise InputError(f"{name} = {value!r} is outside {interval or '(-inf, inf)'}")


def demand_company(name: str, rules: Mapping[str, Rule], values: Mapping[str, Any], given: Sequence[str]) -> None:
    """Raises InputError for what excludes another keyword, or needs one that is not there."""

    def holds(other: str, word: str | None) -> bool:
        return other in given if word is None else values[other] == word

    for other, word in rules[name].without:
        if other in rules and holds(other, word):
            raise InputError(f"{name}: not with {other}" + (f" = {word!r}" if word else ""))
    for any_of in rules[name].needs:
        known = [(other, word) for other, word in any_of if other in rules]
        if known and not any(holds(other, word) for other, word in known):
            words = " or ".join(other + (f" = {word!r}" if word else "") for other, word in known)
            raise InputError(f"{name}: only with {words}")
