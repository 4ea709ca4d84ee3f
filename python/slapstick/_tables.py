"""Tables for notebooks and for pandas, from columns."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from typing import Any


def html_table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A small table; all text is escaped."""
    left = 'style="text-align:left"'
    top = "".join(f"<th {left}>{escape(cell)}</th>" for cell in head)
    body = "".join("<tr>" + "".join(f"<td {left}>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<table><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table>"


def words(names: Sequence[str], codes: Any) -> Any:
    """A column of words, from the numbers of a list of names."""
    import numpy as np

    return np.asarray(names, dtype=np.str_)[codes] if names else np.empty(len(codes), dtype=np.str_)


def categorical(names: Sequence[str], codes: Any) -> Any:
    """The same for pandas: the words are not repeated."""
    import pandas as pd

    return pd.Categorical.from_codes(codes, list(names))


def state_columns(names: Sequence[str], states: Any) -> dict[str, Any]:
    """The rows of states (numbers x points) by name."""
    return dict(zip(names, states))
