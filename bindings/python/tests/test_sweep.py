"""Sweeps here are those of the command line: the same bytes on threads, on workers, and after either was killed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import closeranks as cr
from closeranks import _native

FILE = """
duration_s = 0.3
[sweep]
controllers = ["composed", "budget"]
[team]
robots = { draw = [4, 6] }
faults = { draw = [0, 2] }
[attack]
level = { choose = [{ kind = "none" }, { kind = "bias", bias = { draw = [-4.0, 4.0] } }] }
"""


@pytest.fixture
def many(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A file with draws, in the working directory."""
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "many.toml"
    file.write_text(FILE)
    return file


def theirs(program: Path, runs: int, *words: str) -> bytes:
    """The rows of the command line."""
    command = [program, "sweep", "many.toml", "--runs", str(runs), "-o", "theirs", "--quiet", *words]
    subprocess.run(command, check=True)
    return next(Path("theirs").glob("runs*.parquet")).read_bytes()


def test_threads_give_the_rows_of_the_command_line(many: Path, program: Path) -> None:
    told: list[tuple[int, int]] = []
    swept = cr.sweep("many.toml", 200, jobs=2, progress=lambda done, total: told.append((done, total)))
    assert swept.path == Path("many-sweep/runs.parquet") and told[-1] == (200, 200)
    assert swept.path.read_bytes() == theirs(program, 200)
    assert swept.ok and swept.summary["runs"] == 200 and repr(swept) == "<Sweep of 200 runs, seed 1, in 'many-sweep/runs.parquet'>"
    assert str(swept).startswith("200 runs, seed 1; ") and "budget" in str(swept)
    assert swept.to_polars().shape[0] == len(swept.to_pandas()) == 400
    again = cr.sweep("many.toml", 200)
    assert again.summary == swept.summary
    # The command line takes the folder for its own.
    words = ["sweep", "many.toml", "--runs", "200", "-o", "many-sweep"]
    said = subprocess.run([program, *words], capture_output=True, text=True, check=True).stdout
    assert said.startswith("this sweep was finished before in many-sweep\n")


def test_shards_of_python_are_merged_by_the_command_line(many: Path, program: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for index in range(3):
        monkeypatch.setenv("AWS_BATCH_JOB_ARRAY_INDEX", str(index))
        monkeypatch.setenv("AWS_BATCH_JOB_ARRAY_SIZE", "3")
        swept = cr.sweep(many.name, 100, shard="auto", output=f"part{index}")
        assert swept.path.name == f"runs-{index + 1}-of-3.parquet"
    parts = [f"part{index}" for index in range(3)]
    subprocess.run([program, "sweep", "merge", *parts, "-o", "merged", "-q"], check=True)
    assert Path("merged/runs.parquet").read_bytes() == theirs(program, 100)


KILLED = """
import os, signal, sys
import closeranks as cr

def tell(done, total):
    if done > 20:
        os.kill(os.getpid(), getattr(signal, sys.argv[1]))

cr.sweep("many.toml", 300, jobs=2, progress=tell)
"""


@pytest.mark.parametrize("sent", ["SIGKILL", "SIGINT"])
def test_a_killed_sweep_goes_on(many: Path, program: Path, sent: str) -> None:
    ended = subprocess.run([sys.executable, "-c", KILLED, sent], capture_output=True, text=True, check=False)
    assert ended.returncode == -getattr(signal, sent), ended.stderr
    assert not Path("many-sweep/runs.parquet").exists()
    there = len(list(Path("many-sweep").glob("part-*.parquet")))
    assert 10 <= there < 150
    told: list[int] = []
    swept = cr.sweep("many.toml", 300, progress=lambda done, total: told.append(done))
    assert told[0] > 20, "what was done was not done again"
    assert swept.path.read_bytes() == theirs(program, 300)


def test_a_killed_worker_loses_nothing(many: Path, program: Path) -> None:
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, host="127.0.0.1", dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        workers: list[int] = []

        def tell(done: int, total: int) -> None:
            if done > 30 and not workers:
                workers.extend(client.run(os.getpid).values())
                os.kill(workers[0], signal.SIGKILL)

        swept = cr.sweep("many.toml", 2_000, engine="dask", client=client, progress=tell)
        assert len(workers) == 2 and swept.summary["runs"] == 2_000
    assert swept.path.read_bytes() == theirs(program, 2_000)


def test_what_cannot_be_is_refused(many: Path, program: Path) -> None:
    for words, call in [
        ('`engine` is "ray", allowed is "local" or "dask"', lambda: cr.sweep(many, engine="ray")),  # type: ignore[arg-type]
        ("`runs` is 0, allowed is 1 to 10000000", lambda: cr.sweep(many, 0)),
        ('`shard` is "4/3": allowed is I/M', lambda: cr.sweep(many, shard="4/3")),
        ('`shard` is "auto": this is no task of an array', lambda: cr.sweep(many, shard="auto")),
    ]:
        with pytest.raises(cr.Error, match=words):
            call()
    assert not Path("many-sweep").exists()
    cr.sweep(many, 10)
    with pytest.raises(cr.Error, match="holds another sweep: its `runs` is 10, not 11"):
        cr.sweep(many, 11)
    with pytest.raises(OSError, match="no-such"):
        cr.sweep("no-such.toml")
    many.write_text("[team]\nrobots = 4\nfaults = { draw = [2, 3] }\n")
    said = subprocess.run([program, "sweep", many, "-o", "x"], capture_output=True, text=True, check=False)
    with pytest.raises(cr.ScenarioError) as refused:
        cr.sweep(many)
    assert str(refused.value).splitlines()[:-1] == said.stderr.strip().splitlines()[:-1]


def test_a_block_of_another_sweep_is_not_taken(many: Path) -> None:
    native, other = (_native.Sweep(FILE, "many.toml", [], 10, seed, "1/1") for seed in (1, 2))
    folder = native.open(Path("mine"))
    assert (native.runs(), native.shard(), native.runs_of(3)) == (10, "1/1", 1)
    with pytest.raises(cr.Error, match="another program|another closeranks is at work"):
        other.open(Path("mine"))
    folder.put(0, native.block(0))
    for wrong in (other.block(1), native.block(2), b"PAR1", native.block(1)[:-30]):
        with pytest.raises(cr.Error):
            folder.put(1, wrong)
    assert folder.left() == (list(range(1, 10)), 1) and not folder.is_finished()
    native.stop()
    with pytest.raises(KeyboardInterrupt, match="the same call goes on"):
        native.block(0)
    folder.close()
    with pytest.raises(cr.Error, match="was closed"):
        folder.rows()
