# SPDX-License-Identifier: GPL-3.0-or-later
"""Results and sweeps as tables."""
from __future__ import annotations

import json
import os
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np

from . import _tunica

try:
    import pandas
except ImportError:
    pandas = None


class Columns(dict):
    """A table where there is no pandas: numpy arrays by name, units in `.attrs["units"]`."""

    def __init__(self, columns: dict[str, Any]):
        super().__init__(columns)
        self.attrs: dict[str, Any] = {}


def _table(columns: list[tuple[str, str, Any]]):
    """A DataFrame, or Columns, of (name, unit, values)."""
    by_name = {name: values if isinstance(values, np.ndarray) else np.array(values, dtype=object)
               for name, _, values in columns}
    table = Columns(by_name) if pandas is None else pandas.DataFrame(by_name)
    table.attrs["units"] = {name: unit for name, unit, _ in columns if unit}
    return table


class Result:
    """The tables of a run, as `tunica run` writes them: `observables`, `profiles`, `events`, `sensitivities`,
    `event_sensitivities`, `recruited_time`, `compartments` and `along`, each with the columns of its CSV file
    and without any where the run has none; `record` (a dict) says what the run did."""

    def __init__(self, parts: dict[str, Any]):
        self.record: dict[str, Any] = json.loads(parts["record"])
        self.observables = _table(parts["observables"])
        self.profiles = _table(parts["profiles"])
        self.events = _table(parts["events"])
        self.sensitivities = _table(parts["sensitivities"])
        self.event_sensitivities = _table(parts["event_sensitivities"])
        self.recruited_time = _table(parts["recruited_time"])
        self.compartments = _table(parts["compartments"])
        self.along = _table(parts["along"])

    def __repr__(self) -> str:
        times = self.observables["time"]
        return f"<tunica.Result by {self.record.get('tier')}, {len(times)} times>"


def read(folder: str | os.PathLike) -> Result:
    """The result in a folder of `tunica run`. Raises InvalidInput when something is missing or broken."""
    return Result(_tunica.read_result(Path(folder)))


def _split(head: str) -> tuple[str, str]:
    """Name and unit of "name[unit]"; keys such as wall.layers[0].fraction[1] have brackets of their own."""
    if not head.endswith("]"):
        return head, ""
    name, _, unit = head[:-1].rpartition("[")
    return name, unit


def _rows_so_far(file: Path) -> list[tuple[str, str, Any]]:
    with closing(sqlite3.connect(f"{file.resolve().as_uri()}?mode=ro", uri=True)) as database:
        rows = database.execute("SELECT * FROM sweep ORDER BY point")
        heads = [column[0] for column in rows.description]
        values = list(zip(*rows)) or [()] * len(heads)
    columns = []
    for head, column in zip(heads, values):
        name, unit = _split(head)
        if unit:
            columns.append((name, unit, np.array(column, dtype=float)))
        elif name == "point":
            columns.append((name, "", np.array(column, dtype=np.int64)))
        else:
            columns.append((name, "", list(column)))
    return columns


def read_sweep(folder: str | os.PathLike):
    """The rows of a sweep in the order of points, also of one that is still growing: point, status, reason,
    tier, seconds, the keys that vary, the quantities, and gradients where there are some. From sweep.db, or
    from sweep.csv where that is all there is. Raises InvalidInput when there is neither or it is broken."""
    folder = Path(folder)
    database, written = folder / "sweep.db", folder / "sweep.csv"
    if database.is_file():
        try:
            return _table(_rows_so_far(database))
        except sqlite3.Error as error:
            raise _tunica.InvalidInput(f"{database}: not the table of a sweep: {error}") from None
    if not written.is_file():
        raise _tunica.InvalidInput(f"{folder}: no sweep.db and no sweep.csv there; give the folder of a sweep")
    return _table([(name, unit, np.array(values, dtype=np.int64) if name == "point" else values)
                   for name, unit, values in _tunica.read_table(str(written))])
