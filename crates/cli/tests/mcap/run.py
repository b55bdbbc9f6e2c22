"""Runs of the program: recorded as MCAP and Parquet, or killed half-way."""

import os
import signal
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq

AXES = "xyz"
# Columns of the Parquet file that a robot's state has too, and their names there.
STATE = {
    "tick": "tick",
    "malicious": "malicious",
    "degree": "degree",
    "level": "level",
    "told": "told",
    "h": "h",
    "phi_i": "phi_i",
    "value": "value",
    "value_told": "value_told",
    "degree_sensed": "degree_sensed",
    "level_sensed": "level_sensed",
    "outcome": "outcome",
}


@dataclass
class Run:
    """What the Parquet file of a run says: arrays of ticks times robots."""

    mcap: Path
    tick_ns: int
    columns: dict

    @property
    def ticks(self):
        return self.columns["tick"].shape[0]

    @property
    def robots(self):
        return self.columns["tick"].shape[1]

    @property
    def positions(self):
        """Ticks times robots times three."""
        return self._vectors("{}_m")

    @property
    def inputs(self):
        return self._vectors("u{}_m_s")

    def _vectors(self, name):
        nothing = np.zeros(self.columns["tick"].shape)
        return np.stack([self.columns.get(name.format(axis), nothing) for axis in AXES], axis=-1)


def record(program, work, name, scenario, tick_ns):
    """Runs a scenario with both kinds of recording."""
    file, mcap, out = work / f"{name}.toml", work / f"{name}.mcap", work / name
    file.write_text(scenario)
    command = [program, "run", file, "-q", "-o", out, "--record", mcap]
    done = subprocess.run(command, check=False)
    assert done.returncode in (0, 1), f"{name}: exit code {done.returncode}"
    table = pq.read_table(out / "run.parquet")
    robots = int(max(table["robot"].to_pylist()))
    columns = {
        column: np.array(table[column].to_pylist(), dtype=None if column == "outcome" else float).reshape(-1, robots)
        for column in table.column_names
    }
    return Run(mcap, tick_ns, columns)


def killed(program, work, scenario, bytes_at_least):
    """Starts a long run, kills it once its recording has grown, and says what is left and the most memory it had, in bytes."""
    file, mcap = work / "killed.toml", work / "killed.mcap"
    file.write_text(scenario)
    child = subprocess.Popen([program, "run", file, "-q", "--record", mcap])
    deadline = time.monotonic() + 60
    while not (mcap.exists() and mcap.stat().st_size > bytes_at_least):
        assert child.poll() is None, "the run ended before it could be killed: make it longer"
        assert time.monotonic() < deadline, "the recording does not grow"
        time.sleep(0.01)
    status = Path(f"/proc/{child.pid}/status").read_text()
    os.kill(child.pid, signal.SIGKILL)
    child.wait()
    peak = next(line.split()[1] for line in status.splitlines() if line.startswith("VmHWM"))
    return mcap, int(peak) * 1024
