"""Every tick as a table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import pandas as pd
    import polars as pl

    from closeranks._run import Run

AXES = ("x", "y", "z")


def columns(run: Run) -> dict[str, Any]:
    """Columns by their names, but for `outcome`; inputs of the last tick are NaN."""
    ticks, robots = run.h.shape
    points, inputs = run.positions, run.velocities.copy()
    inputs[-1] = np.nan
    tick = np.repeat(np.arange(ticks, dtype=np.uint32), robots)
    table: dict[str, Any] = {
        "tick": tick,
        "time_s": tick * run.scenario.tick_s,
        "robot": np.tile(np.arange(1, robots + 1, dtype=np.uint16), ticks),
        "malicious": np.tile(run.scenario.is_malicious, ticks),
    }
    axes = AXES[: run.scenario.dimension]
    table |= {f"{axis}_m": np.ascontiguousarray(points[:, :, d]).reshape(-1) for d, axis in enumerate(axes)}
    table |= {f"u{axis}_m_s": np.ascontiguousarray(inputs[:, :, d]).reshape(-1) for d, axis in enumerate(axes)}
    table["degree"] = run.degree.reshape(-1)
    numbers = {"level": run.levels, "told": run.told, "h": run.h, "phi_i": run.phi, "value": run.values}
    numbers |= {"value_told": run.values_told, "degree_sensed": run.degree_sensed, "level_sensed": run.levels_sensed}
    held, told = run.points, run.points_told
    for place in range(1, held.shape[2]):
        numbers |= {f"value_{place + 1}": held[:, :, place], f"value_told_{place + 1}": told[:, :, place]}
    return table | {name: column.reshape(-1) for name, column in numbers.items()}


def polars_frame(run: Run) -> pl.DataFrame:
    """The table for polars."""
    import polars as pl

    frame = pl.DataFrame(columns(run))
    inputs = [f"u{axis}_m_s" for axis in AXES[: run.scenario.dimension]]
    last = pl.col("tick") == pl.col("tick").max()
    names = pl.Series("outcome", list(run.outcome_names), dtype=pl.String)
    outcome = names.gather(pl.Series(run.outcome.reshape(-1).astype(np.uint32)))
    frame = frame.with_columns(pl.when(last).then(None).otherwise(pl.col(inputs)).name.keep())
    frame = frame.with_columns(pl.col("^(told|value_told.*|degree_sensed|level_sensed)$").fill_nan(None))
    return frame.with_columns(outcome.alias("outcome"))


def pandas_frame(run: Run) -> pd.DataFrame:
    """The table for pandas."""
    import pandas as pd

    outcome = np.array(run.outcome_names, dtype=object)[run.outcome.reshape(-1)]
    return pd.DataFrame(columns(run) | {"outcome": outcome})
