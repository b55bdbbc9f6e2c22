"""Writes the small recordings of this folder with pandas and polars (pip install pandas polars pyarrow).

Four robots in a square of 1 m; robot 4 walks off at 1 m/s from tick 2 on. Columns that say nothing, rows out of order.
"""

import pandas
import polars

ROWS = [
    {"note": "x", "robot": robot, "time_s": 0.5 * tick, "y_m": y, "x_m": x + (0.5 * max(0, tick - 2) if robot == 4 else 0.0)}
    for tick in range(6)
    for robot, (x, y) in {4: (1.0, 1.0), 1: (0.0, 0.0), 2: (1.0, 0.0), 3: (0.0, 1.0)}.items()
]

frame = pandas.DataFrame(ROWS)
frame.to_csv("pandas.csv", index=False)
frame.to_parquet("pandas.parquet")
frame.astype({"x_m": "float32", "robot": "int32"}).to_parquet("pandas-small.parquet", compression=None)

table = polars.DataFrame(ROWS)
table.write_csv("polars.csv")
table.write_parquet("polars.parquet")
named = table.with_columns(polars.format("cf{}", polars.col("robot")).alias("robot"))
named.write_parquet("polars-names.parquet", compression="snappy")
hole = table.with_columns(polars.when(polars.col("time_s") < 2).then(polars.col("x_m")).alias("x_m"))
hole.write_parquet("hole.parquet")
