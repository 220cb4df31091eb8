"""Runs scenes: one, with progress, or many at a time."""

import csv
import itertools
import json
import os
import shutil
import subprocess
import tempfile
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from sluice.progress import Bar
from sluice.recording import Recording


class RunError(Exception):
    """A run that did not start or did not finish; the text says why, `summary` is what `sluice run --json` said."""

    def __init__(self, text, summary=None):
        super().__init__(text)
        self.summary = summary or {}


def program(name="sluice"):
    """A program of the build or installation that this package belongs to, else the first in PATH."""
    beside = Path(__file__).resolve().parents[4] / "bin" / name
    found = str(beside) if beside.is_file() else shutil.which(name)
    if found is None:
        raise RunError(f"{name} is not found: neither {beside} nor in PATH; build sluice, or put its bin directory in PATH")
    return found


def _value(value):
    """As textproto writes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(entry) for entry in value) + "]"
    return repr(float(value)) if isinstance(value, float) else str(value)


def _settings(settings):
    return [word for path, value in settings.items() for word in ("--set", f"{path}={_value(value)}")]


def _options(settings, until, threads):
    words = _settings(settings)
    words += ["--until", repr(float(until))] if until is not None else []
    return words + (["--threads", str(threads)] if threads is not None else [])


def _progress_of(line):
    """Fraction of a line like `[sluice]  10.0 %  t = ...`, as `sluice run` writes them; None of any other."""
    head, sign, _ = line.partition(" %  t = ")
    try:
        return float(head.split()[-1]) / 100 if sign else None
    except (ValueError, IndexError):
        return None


def run(scene, output=None, settings=None, spacing=None, until=None, threads=None, force=False, motion=None, show=None):
    """Runs a scene file to its end; the summary of `sluice run --json` as a dict (status, energies, recording ...).

    `settings` changes fields of the scene, {"body[0].density": 500}; `spacing` [m] is one of them. `until` [s] ends the
    run early. `output` is the recording to make, which `force` allows to replace. `motion(endpoint)`, given, moves the
    bodies in place of `sluice rigid` (sluice.Participant) and returns when the run is over; the summary is then short.
    `show(fraction)` is told the progress; a bar is drawn on a terminal unless it is given. Raises RunError when the run
    does not finish.
    """
    settings = {**({"spacing": spacing} if spacing is not None else {}), **(settings or {})}
    options = [str(scene), *_options(settings, until, threads)]
    bar = Bar()
    tell = show or (lambda fraction: bar.show(fraction, f"{Path(scene).name} {100 * fraction:.0f} %"))
    try:
        if motion is not None:
            _require_runnable([str(scene), *_settings(settings)], output, force)
            return _run_with(motion, options, output, force)
        return _run_alone(options, output, force, tell)
    finally:
        bar.clear()


def _run_alone(options, output, force, tell):
    words = [program(), "run", *options, "--json"]
    words += ["-o", str(output)] if output else []
    words += ["--force"] if force else []
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, stdin=subprocess.DEVNULL)
    said = []

    def listen():
        for line in process.stderr:
            fraction = _progress_of(line)
            said.append(line.strip()) if fraction is None else tell(fraction)

    listener = threading.Thread(target=listen)
    listener.start()
    try:
        printed = process.stdout.read()
        process.wait()
    except BaseException:
        process.terminate()
        raise
    finally:
        listener.join()
        process.stdout.close()
        process.stderr.close()
    summary = json.loads(printed) if printed.strip() else {}
    if process.returncode != 0:
        raise RunError(_reason(summary, said), summary)
    tell(1.0)
    return summary


def _reason(summary, said):
    if summary.get("detail"):
        return f"{summary['status']}: {summary['detail']}"
    return "; ".join(said[-3:]) or "sluice said nothing"


def _require_runnable(scene, output, force):
    """What `sluice run` looks at before it starts anything."""
    checked = subprocess.run([program(), "check", *scene], capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if checked.returncode != 0:
        raise RunError(checked.stderr.strip())
    if output and Path(output).exists() and not force:
        raise RunError(f"{output} exists; name another file, or replace it with force=True")


def start(words, log):
    """One of the programs, with its output in a file."""
    return subprocess.Popen([program(), *words], stdout=log, stderr=log, stdin=subprocess.DEVNULL)


def _run_with(motion, options, output, force):
    """Server and recorder as processes of their own, the bodies moved here."""
    with tempfile.TemporaryDirectory(prefix="sluice-", dir=os.environ.get("XDG_RUNTIME_DIR")) as directory:
        endpoint = f"ipc://{directory}/run.ipc"
        serve = ["serve", "--scene", *options, "--listen", endpoint] + (["--expect-recorder"] if output else [])
        with tempfile.TemporaryFile("w+") as log:
            processes = [start(serve, log)]
            try:
                if output:
                    record = ["record", "--connect", endpoint, "-o", str(output)] + (["--force"] if force else [])
                    processes.append(start(record, log))
                motion(endpoint)
                codes = [process.wait() for process in processes]
            finally:
                for process in processes:
                    process.terminate()
                    process.wait()
            if any(codes):
                log.seek(0)
                raise RunError("; ".join(line.strip() for line in log.readlines()[-3:]))
    return {"status": "FINISHED", "exit_code": 0, "recording": {"path": str(output)} if output else None}


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
