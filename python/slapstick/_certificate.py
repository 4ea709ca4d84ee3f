"""certify: a run written down as a proof that no event was missed."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from typing import Any

from . import _core, _progress
from ._core import StorageError
from ._model import Model, Start, Values, model_of, numbers, start_of
from ._progress import Progress
from ._result import Interrupted, Result


class Certificate(Result):
    """What a certificate holds, in numbers; `slapstick-verify PATH` checks the file.

    segments: of the motion; guards: proven on them; steps: of the proofs; touches: zeros that 256 bits could not decide;
    chatters: limits of complete chatter; unproved: guards that the verifier will refuse. path: the file.
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
        self.segments, self.guards, self.steps = core.segments, core.guards, core.steps
        self.touches, self.chatters, self.unproved = core.touches, core.chatters, core.unproved
        self.periods, self.complete = core.periods, core.complete

    def _facts(self) -> list[tuple[str, str]]:
        names = ("segments", "guards", "touches", "chatters", "unproved", "path")
        return [(name, str(getattr(self, name))) for name in names]


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
    """Writes a certificate of the motion that `simulate` gives: a proof of every guard of every segment.

    The file appears whole or not at all; after Ctrl-C it holds what is complete.

    Raises InputError as `simulate`, StorageError if the file cannot be written.

    >>> import slapstick, tempfile, os
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     run = slapstick.certify("vibro-impact", os.path.join(folder, "run.cert"), periods=20, omega=1.5)
    >>> run.unproved
    0
    """
    chosen, target = model_of(model), os.fspath(path)
    fixed = numbers(values if parameters is None else {**values, **parameters})

    def work(write: Callable[[str], object]) -> _core.Certified:
        arguments = (chosen._core, fixed, start_of(start), periods, write)
        return _progress.run(_core.certify, arguments, "periods", periods, progress)

    certified = written_whole(target, work)
    found = Certificate(certified, target, chosen, fixed, {"periods": periods, "start": start})
    if not certified.complete:
        raise Interrupted(found)
    return found


def written_whole(path: str, work: Callable[[Callable[[str], object]], _core.Certified]) -> _core.Certified:
    """What `work` writes becomes the file `path` when it has ended, or leaves nothing behind."""
    try:
        file = tempfile.NamedTemporaryFile("w", dir=os.path.dirname(path) or ".", delete=False, newline="\n")
    except OSError as error:
        raise StorageError(f"cannot write '{path}': {error.strerror}") from None
    try:
        with file:
            certified = work(file.write)
        os.replace(file.name, path)
    except BaseException as error:
        os.unlink(file.name)
        if isinstance(error, OSError) and not isinstance(error, StorageError):
            raise StorageError(f"cannot write '{path}': {error.strerror}") from None
        raise
    return certified
