"""Charts on a Dask cluster: the tiles of `slapstick.map`, one task for each shard.

    from dask.distributed import Client
    import slapstick.dask

    chart = slapstick.dask.map(Client(), "vibro-impact", ("omega", 1, 6, 400), ("friction", 0.05, 0.3, 300))

The result is that of `slapstick.map`, to the last bit. A worker that dies costs the tasks that it had; others do them
again. Workers need the same version of slapstick, and numpy.
"""

from __future__ import annotations

import os
from typing import Any

from . import _map
from ._core import InputError
from ._map import Axis, Map
from ._model import Model, model_of


def shard_of(text: str, x: Axis, y: Axis, shard: tuple[int, int], options: dict[str, Any]) -> dict[str, Any]:
    """On a worker: the columns of one shard, from the text of the model."""
    return _map.map(Model.from_toml(text), x, y, shard=shard, threads=1, progress=False, **options)._columns


def map(  # noqa: A001 (the verb is called so)
    client: Any,
    model: Model | str | os.PathLike[str],
    x: Axis,
    y: Axis,
    *,
    tasks: int = 0,
    retries: int = 3,
    **options: Any,
) -> Map:
    """`slapstick.map` on the workers of a dask.distributed Client.

    tasks: into how many shards the chart is cut; 0: four for each thread of the cluster. retries: how often a task that
    fails is tried again; one whose worker dies is given to another. options: those of `slapstick.map`, but for shard,
    threads, progress, store, resume and refine.
    """
    refused = [name for name in ("shard", "threads", "progress", "store", "resume", "refine") if name in options]
    if refused:
        raise InputError(f"{refused[0]}: the cluster decides it")
    chosen = model_of(model)
    tasks = tasks or 4 * max(sum(client.nthreads().values()), 1)
    text = chosen.to_toml()
    parts = client.gather(
        [client.submit(shard_of, text, x, y, (i + 1, tasks), options, retries=retries, pure=False) for i in range(tasks)]
    )
    whole = _map.merged(parts)
    names = set(chosen._names)
    values = {name: value for name, value in options.items() if name in names} | dict(options.get("parameters") or {})
    kept = {name: value for name, value in options.items() if name not in names and name != "parameters"}
    given = {"x": _map.axis_of("x", x), "y": _map.axis_of("y", y), "direction": "up", "starts": 0, "tasks": tasks}
    return _map.reported(Map(whole, chosen, {name: float(value) for name, value in values.items()}, given | kept))
