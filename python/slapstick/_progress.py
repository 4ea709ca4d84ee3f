"""Progress of long calls: a bar of tqdm in a terminal or a notebook, if tqdm is there."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any, TypeVar, Union

Progress = Union[bool, Callable[[float, float], object], None]
T = TypeVar("T")

PATIENCE = 0.5  # seconds before a bar appears: short calls show none


class Bar:
    """Called by the library some twenty times a second with how much is done."""

    __slots__ = ("began", "shown", "total", "what")

    def __init__(self, what: str, total: float) -> None:
        self.what, self.total = what, total
        self.began = time.monotonic()
        self.shown: Any = None

    def __call__(self, done: float) -> None:
        if self.shown is None:
            if time.monotonic() - self.began < PATIENCE:
                return
            from tqdm.auto import tqdm

            self.shown = tqdm(total=self.total, unit=" " + self.what, leave=False, smoothing=0)
            self.shown.start_t -= time.monotonic() - self.began
        self.shown.n = min(done, self.total)
        self.shown.refresh()

    def close(self) -> None:
        if self.shown is not None:
            self.shown.close()


def watched_by_a_person() -> bool:
    """Whether standard error is a terminal or the program is a notebook's."""
    interactive = sys.modules.get("IPython")
    if interactive is not None and hasattr(interactive.get_ipython(), "kernel"):
        return True
    return sys.stderr is not None and sys.stderr.isatty()


def tqdm_is_there() -> bool:
    from importlib.util import find_spec

    return find_spec("tqdm") is not None


def run(call: Callable[..., T], arguments: tuple[Any, ...], what: str, total: float, progress: Progress) -> T:
    """Calls `call(*arguments, progress)`; `progress` is None (where a person sees it), a bool, or f(done, total)."""
    if callable(progress):
        return call(*arguments, lambda done: progress(done, total))
    if progress is False or (progress is None and not watched_by_a_person()) or not tqdm_is_there():
        return call(*arguments, None)
    bar = Bar(what, total)
    try:
        return call(*arguments, bar)
    finally:
        bar.close()
