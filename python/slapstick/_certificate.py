"""certify: a run written down so that slapstick-verify can prove it."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterator
from typing import Any

from . import _core, _progress
from ._core import StorageError
from ._model import Model, Start, Values, given_to, model_of, numbers, start_of
from ._obeys import obeys
from ._progress import Progress
from ._result import Interrupted, Result


class Certificate(Result):
    """What a certificate holds, in numbers; `slapstick-verify PATH` checks the file.

    segments: of the motion; impacts: on them; chatters: limits of complete chatter; unproved: pile-ups, which are
    assumed and not proved. path: the file.
    """

    def __init__(
        self,
        core: _core.Certified,
        path: str,
        model: Model,
        values: dict[str, float],
        options: dict[str, Any],
    ) -> None:
        super().__init__(model, values, options)
        self.path = path
        self.segments, self.impacts = core.segments, core.impacts
        self.chatters, self.unproved = core.chatters, core.unproved
        self.periods, self.complete = core.periods, core.complete

    def _facts(self) -> list[tuple[str, str]]:
        names = ("segments", "impacts", "chatters", "unproved", "path")
        return [(name, str(getattr(self, name))) for name in names]


@obeys("simulate")
def certify(
    model: Model | str | os.PathLike[str],
    path: str | os.PathLike[str],
    *,
    periods: float = 100,
    start: Start = None,
    progress: Progress = None,
    parameters: Values | None = None,
    **values: float,
) -> Certificate:
    """Writes a certificate of the motion that `simulate` gives: the model, every segment, every impact.

    The file appears whole or not at all; after Ctrl-C it holds what is complete.

    Raises InputError as `simulate`, StorageError if the file cannot be written.

    >>> import slapstick, tempfile, os
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     run = slapstick.certify("vibro-impact", os.path.join(folder, "run.cert"), periods=20, omega=1.5)
    >>> run.unproved
    0
    """
    chosen, target = model_of(model), os.fspath(path)
    fixed = numbers(given_to(certify, chosen, values, parameters))

    arguments = (chosen._core, fixed, start_of(start), periods)
    with written_whole(target) as beside:
        certified = _progress.run(_core.certify, (*arguments, beside), "periods", periods, progress)
    found = Certificate(certified, target, chosen, fixed, {"periods": periods, "start": start})
    if not certified.complete:
        raise Interrupted(found)
    return found


@contextlib.contextmanager
def written_whole(path: str) -> Iterator[str]:
    """A file beside `path` to write into, which becomes `path` at the end; after an error nothing is left."""
    try:
        descriptor, beside = tempfile.mkstemp(dir=os.path.dirname(path) or ".")
    except OSError as error:
        raise StorageError(f"cannot write '{path}': {error.strerror}") from None
    os.close(descriptor)
    try:
        yield beside
        os.replace(beside, path)
    except BaseException:
        os.unlink(beside)
        raise
