"""Thousands of runs drawn from one file, on this machine or on the workers of a Dask cluster."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from closeranks import _native
from closeranks._files import scenario_with_files
from closeranks._progress import bar
from closeranks._types import Progress

if TYPE_CHECKING:
    import pandas as pd
    import polars as pl
    from distributed import Client

_Recipe: TypeAlias = tuple[str, str, tuple[tuple[str, "str | None", str], ...], int, int, str]


class Sweep:
    """What a sweep came to: one row a run and controller, as the page docs/sweeps.md says.

    Its folder is that of `closeranks sweep`, which goes on in it, adds pages and figures to it, and merges it with other shards.
    """

    __slots__ = ("_report", "path", "summary")

    path: Path
    """The Parquet file with all rows."""
    summary: dict[str, Any]
    """Counts, bounds and how to repeat violations, as `closeranks sweep --json` gives them."""

    def __init__(self, path: Path, report: str, summary: dict[str, Any]) -> None:
        self.path, self._report, self.summary = path, report, summary

    @property
    def ok(self) -> bool:
        """False if a law was broken that should hold: the command line's exit code is 1 then."""
        return bool(self.summary["ok"])

    def to_polars(self) -> pl.DataFrame:
        """All rows; needs polars."""
        import polars as pl

        return pl.read_parquet(self.path)

    def to_pandas(self) -> pd.DataFrame:
        """All rows; needs pandas and pyarrow."""
        import pandas as pd

        return pd.read_parquet(self.path)

    def __str__(self) -> str:
        return self._report

    def __repr__(self) -> str:
        return f"<Sweep of {self.summary['runs']} runs, seed {self.summary['seed']}, in {str(self.path)!r}>"


def sweep(
    file: str | os.PathLike[str],
    runs: int = 1_000,
    *,
    engine: Literal["local", "dask"] = "local",
    output: str | os.PathLike[str] | None = None,
    seed: int = 1,
    shard: str = "1/1",
    jobs: int | None = None,
    client: Client | None = None,
    progress: Progress = None,
) -> Sweep:
    """Runs a sweep, or what is left of it: the same call goes on where another was killed, in Python or on the command line.

    The rows are those of `closeranks sweep` with the same file, runs, seed and shard, byte for byte, whatever computes them.

    Parameters
    ----------
    file : path
        A scenario with draws, a TOML file.
    runs : int
        How many runs, in all shards together.
    engine : "local" or "dask"
        Threads of this process, or the workers of a Dask cluster. Workers need the same version of this package and no common disk:
        blocks of rows come back as bytes and are written here, each whole or not at all. A worker that dies loses the block that
        it was at, which another one does again.
    output : path, optional
        Folder to write to; by default the name of the file with `-sweep` for its ending, in the working directory.
    seed : int
        Seed of all draws.
    shard : str
        Only part I of M, as "I/M"; or "auto", what Slurm, AWS Batch, Cloud Run or Kubernetes tell a task of an array.
    jobs : int, optional
        Threads of the engine "local"; by default one a core.
    client : distributed.Client, optional
        Which cluster; by default one on this machine, for the length of the call.

    Raises
    ------
    ScenarioError
        If the file is wrong, or a run cannot be drawn.
    Error
        If the folder holds another sweep, or another program is at work in it.
    OSError
        If a file cannot be read or written.
    """
    if engine not in ("local", "dask"):
        raise _native.Error(f'`engine` is "{engine}", allowed is "local" or "dask"')
    text, files = scenario_with_files(Path(file))
    recipe: _Recipe = (text, str(file), tuple(files), runs, seed, shard)
    native = _native.Sweep(text, str(file), files, runs, seed, shard)
    folder = native.open(Path(f"{Path(file).stem}-sweep") if output is None else Path(output))
    try:
        if not folder.is_finished():
            missing, done = folder.left()
            if engine == "local":
                ended = _in_threads(native, folder, missing, jobs)
            else:
                ended = _on_workers((*recipe[:5], native.shard()), folder, missing, client)
            _count(native, ended, done, progress)
            folder.join()
        return Sweep(folder.rows(), *folder.outcome())
    finally:
        folder.close()


def _count(native: _native.Sweep, ended: Iterator[int], done: int, progress: Progress) -> None:
    """Waits for all blocks, and shows how many runs are done."""
    with bar(progress, native.runs(), "sweep", "run") as tell:
        for block in ended:
            done += native.runs_of(block)
            tell(done)


def _in_threads(
    native: _native.Sweep, folder: _native.SweepFolder, missing: list[int], jobs: int | None
) -> Iterator[int]:
    """Runs blocks here; gives their numbers as they are written."""
    pool = ThreadPoolExecutor(jobs or os.cpu_count() or 1)
    try:
        blocks = {pool.submit(folder.run, block): block for block in missing}
        for future in as_completed(blocks):
            future.result()
            yield blocks[future]
    except BaseException:
        native.stop()
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def _on_workers(
    recipe: _Recipe, folder: _native.SweepFolder, missing: list[int], client: Client | None
) -> Iterator[int]:
    """Runs blocks on workers; gives their numbers as they are written here."""
    distributed: Any = import_module("distributed")  # its calls have no types
    own: Any = distributed.Client() if client is None else client
    futures: dict[Any, int] = {}
    try:
        # Not pure: a key of its own for each call, so that no result of another call is taken for ours.
        started = own.map(_block, [recipe] * len(missing), missing, pure=False)
        futures = dict(zip(started, missing, strict=True))
        for future, data in distributed.as_completed(started, with_results=True):
            block = futures.pop(future)
            folder.put(block, data)
            future.release()
            yield block
    finally:
        own.cancel(list(futures))
        if client is None:
            own.close()


_last: dict[_Recipe, _native.Sweep] = {}
"""The sweep of which this worker did a block last."""


def _block(recipe: _Recipe, block: int) -> bytes:
    """The rows of a block, on a worker."""
    native = _last.get(recipe)
    if native is None:
        text, name, files, runs, seed, shard = recipe
        native = _native.Sweep(text, name, list(files), runs, seed, shard)
        _last.clear()
        _last[recipe] = native
    return native.block(block)
