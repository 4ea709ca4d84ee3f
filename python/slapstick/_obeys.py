"""Keywords are held to what the command line demands of the options of the same names, before anything runs."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
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

    least: counts that Python allows to be less. called: the option of a keyword that has another name. A keyword that has its default counts as not given, and one
    that no rule speaks of is left to the function. Whole numbers may be floats.
    """

    def of(call: F) -> F:
        takes = signature(call)
        options = {"threads": RULES["map"]["threads"]} | RULES[verb]  # of `classify` too, with arrays
        rules = {name: options.get(called.get(name, name), {}) for name in takes.parameters if name not in NOT_THE_OPTION}

        @wraps(call)
        def obeyed(*args: Any, **kwargs: Any) -> Any:
            bound = takes.bind_partial(*args, **kwargs)
            values = {name: takes.parameters[name].default for name in rules} | bound.arguments
            given = {name for name in bound.arguments if name in rules and not same(values[name], takes.parameters[name].default)}
            for name in sorted(given):
                if "count" in rules[name]:
                    bound.arguments[name] = whole(name, values[name], least.get(name, rules[name]["count"][0]), rules[name]["count"][1])
                if values[name] not in rules[name].get("words", [values[name]]):
                    raise InputError(f"{name} = {values[name]!r} is not one of " + ", ".join(rules[name]["words"]))
                if "number" in rules[name]:
                    demand_number(name, values[name], rules[name]["number"])
                demand_company(name, rules, values, given)
            return call(*bound.args, **bound.kwargs)

        return cast(F, obeyed)

    return of


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


def demand_company(name: str, rules: Mapping[str, Any], values: Mapping[str, Any], given: set[str]) -> None:
    """Raises InputError for what excludes another keyword, or needs one that is not there."""

    def holds(other: str, word: str | None) -> bool:
        return other in given if word is None else values[other] == word

    for other, word in rules[name].get("without", ()):
        if other in rules and holds(other, word):
            raise InputError(f"{name}: not with {other}" + (f" = {word!r}" if word else ""))
    for any_of in rules[name].get("needs", ()):
        known = [(other, word) for other, word in any_of if other in rules]
        if known and not any(holds(other, word) for other, word in known):
            words = " or ".join(other + (f" = {word!r}" if word else "") for other, word in known)
            raise InputError(f"{name}: only with {words}")
