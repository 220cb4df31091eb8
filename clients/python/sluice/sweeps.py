"""Runs of a scene with many settings, several at a time, and the tables they make."""

import csv
import itertools
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from sluice.launch import RunError, run
from sluice.progress import Bar
from sluice.recording import Recording


def _points(values):
    """Settings of every run: all combinations of a dict of lists, or a list of dicts as it is."""
    if not isinstance(values, dict):
        return [dict(point) for point in values]
    return [dict(zip(values, chosen)) for chosen in itertools.product(*values.values())]


def sweep(scene, values, measure=None, directory=None, at_once=2, until=None, threads=1, show=None):
    """Runs a scene with many settings, `at_once` of them at a time; a table: a list of dicts, one a run.

    `values` is {"spacing": [0.004, 0.002], "body[0].density": [400, 600]}, of which all combinations are run, or a list
    of settings. A row has the settings, then status, detail, fluid_particles, wall_seconds, recording, and what
    `measure(recording)`, a function of a Recording, returns as a dict. A run that fails is a row that says so.
    Recordings are `directory`/run_0.h5 ...; without a directory they are gone after the sweep.
    """
    points = _points(values)
    done, fractions = [], [0.0] * len(points)
    bar = Bar()

    def note(number, fraction):
        fractions[number] = fraction
        mean = sum(fractions) / max(len(points), 1)
        if show:
            show(mean)
        bar.show(mean, f"{len(done)} of {len(points)} runs")

    def one(number):
        path = Path(kept) / f"run_{number}.h5"
        row = dict(points[number])
        try:
            summary = run(
                scene, path, points[number], until=until, threads=threads, force=True, show=lambda f: note(number, f)
            )
            with Recording(path) as recording:
                measured = measure(recording) if measure else {}
        except RunError as error:
            summary, measured = {"status": "FAILED", **error.summary, "detail": str(error)}, {}
        row.update({name: summary.get(name) for name in ("status", "detail", "fluid_particles", "wall_seconds")})
        row["recording"] = str(path) if directory and path.exists() else None
        done.append(number)
        note(number, 1.0)
        return {**row, **measured}

    with tempfile.TemporaryDirectory(prefix="sluice-") as scratch:
        kept = directory or scratch
        Path(kept).mkdir(parents=True, exist_ok=True)
        with ThreadPoolExecutor(at_once) as pool:
            table = list(pool.map(one, range(len(points))))
    bar.clear()
    return table


def columns_of(table):
    """All columns of a table, in the order in which they first come."""
    return list(dict.fromkeys(name for row in table for name in row))


def write_table(table, path):
    """A table as CSV."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns_of(table))
        writer.writeheader()
        writer.writerows(table)


def table_text(table):
    """A table for people."""
    names = columns_of(table)
    cells = [names] + [[_cell(row.get(name)) for name in names] for row in table]
    widths = [max(len(line[k]) for line in cells) for k in range(len(names))]
    return "\n".join("  ".join(text.ljust(width) for text, width in zip(line, widths)).rstrip() for line in cells)


def _cell(value):
    return "" if value is None else f"{value:.6g}" if isinstance(value, float) else str(value)
