"""Reads the results of `vinesink sweep` in pandas, in polars or in DuckDB.

    python read.py sweeps/map/sweep.parquet [--with pandas|polars|duckdb]

Prints the units of the columns, and for each regime at how many points most starts lead to it and how much
it takes from the oscillator's peak on average, largest share first. The three say the same. Needs
`pip install pandas pyarrow`, `pip install polars` or `pip install duckdb`.
"""

import argparse


def with_pandas(path):
    import pandas
    import pyarrow.parquet

    notes = {key.decode(): value.decode() for key, value in pyarrow.parquet.read_metadata(path).metadata.items()}
    points = pandas.read_parquet(path)
    groups = points.groupby("regime").agg(points=("point", "count"), reduction_db=("reduction_db", "mean"))
    return notes, [(regime, int(row.points), row.reduction_db) for regime, row in groups.iterrows()]


def with_polars(path):
    import polars

    notes = polars.read_parquet_metadata(path)
    groups = (
        polars.scan_parquet(path)
        .drop_nulls("regime")
        .group_by("regime")
        .agg(polars.len(), polars.col("reduction_db").mean())
        .collect()
    )
    return notes, groups.rows()


def with_duckdb(path):
    import duckdb

    found = duckdb.execute("SELECT key, value FROM parquet_kv_metadata(?)", [path]).fetchall()
    notes = {key.decode(): value.decode() for key, value in found}
    groups = duckdb.execute(
        "SELECT regime, count(*), avg(reduction_db) FROM read_parquet(?) WHERE regime IS NOT NULL GROUP BY regime",
        [path],
    )
    return notes, groups.fetchall()


READERS = {"pandas": with_pandas, "polars": with_polars, "duckdb": with_duckdb}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("path", help="sweep.parquet")
    parser.add_argument("--with", dest="reader", choices=READERS, default="pandas")
    arguments = parser.parse_args()
    notes, groups = READERS[arguments.reader](arguments.path)
    units = [(key.removeprefix("vinesink.unit."), unit) for key, unit in notes.items() if "unit." in key]
    print("units:", ", ".join(f"{column} {unit}" for column, unit in sorted(units) if unit not in ("", "1")))
    for regime, points, reduction in sorted(groups, key=lambda group: (-group[1], group[0])):
        print(f"{regime}: {points} points, {reduction:+.3f} dB")


if __name__ == "__main__":
    main()
