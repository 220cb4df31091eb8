"""Runs scenes and goes on with them, with progress."""

import json
import os
import shutil
import subprocess
import tempfile
import threading
from contextlib import contextmanager
from pathlib import Path

from sluice.progress import Bar


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


def run(scene, output=None, settings=None, spacing=None, until=None, threads=None, force=False, motion=None, rigid=False,
        show=None):
    """Runs a scene file to its end; the summary of `sluice run --json` as a dict (status, energies, recording ...).

    `settings` changes fields of the scene, {"body[0].density": 500}; `spacing` [m] is one of them. `until` [s] ends the
    run early. `output` is the recording to make, which `force` allows to replace. `motion(endpoint)`, given, moves the
    bodies in place of `sluice rigid` (sluice.Participant) and returns when the run is over; the summary is then short. With
    `rigid` it moves those of an owner, and `sluice rigid` those that have none.
    A run that ends before its scene leaves a checkpoint beside the recording, which resume() goes on from.
    `show(fraction)` is told the progress; a bar is drawn on a terminal unless it is given. Raises RunError when the run
    does not finish.
    """
    settings = {**({"spacing": spacing} if spacing is not None else {}), **(settings or {})}
    options = [str(scene), *_options(settings, until, threads)]
    with _telling(scene, show) as tell:
        if motion is not None:
            _require_runnable([str(scene), *_settings(settings)], output, force)
            return _run_with(motion, ["--scene", *options], output, [], force, tell, rigid)
        return _run_alone(["run", *options], output, force, tell)


def resume(checkpoint, recording=None, output=None, until=None, threads=None, force=False, motion=None, show=None):
    """Goes on with a run from its checkpoint, as `sluice resume`, or where `motion` is given with bodies that it moves.

    `recording` is that of the run so far, RUN.h5 beside RUN.checkpoint unless it is named; it goes on, or is the beginning of
    `output`. The rest is as of run(). To be the run that was never stopped, `motion` has to do from Participant.done on what it
    would have done: a function of time does, a controller has to keep its own state.
    """
    checkpoint = Path(checkpoint)
    recording = Path(recording) if recording else checkpoint.with_suffix(".h5")
    output = Path(output) if output else recording
    options = [str(checkpoint), *_options({}, until, threads)]
    with _telling(checkpoint, show) as tell:
        if motion is None:
            return _run_alone(["resume", *options, "--recording", str(recording)], output, force, tell)
        if not recording.is_file():
            raise RunError(f"{recording} is not there; name the recording of the run so far")
        return _run_with(motion, ["--resume", *options], output, ["--resume", str(recording)], force, tell)


@contextmanager
def _telling(what, show):
    """A function that takes the fraction done, for the caller or for a bar on the terminal."""
    bar = Bar()
    try:
        yield show or (lambda fraction: bar.show(fraction, f"{Path(what).name} {100 * fraction:.0f} %"))
    finally:
        bar.clear()


def _run_alone(command, output, force, tell):
    words = [program(), *command, "--json"]
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


class _Follower(threading.Thread):
    """Tells how far a run is that other processes compute, until it ends or is stopped."""

    def __init__(self, endpoint, tell):
        super().__init__(daemon=True)
        self._endpoint, self._tell, self._stopped = endpoint, tell, False
        self.start()

    def run(self):
        from sluice.link import Ended, Lost
        from sluice.watcher import Watcher

        try:
            with Watcher(self._endpoint, topics=("status",)) as watched:
                while not self._stopped and watched.end is None:
                    status = watched.receive(timeout=0.2)
                    if status and not self._stopped:
                        self._tell(status.step / max(status.steps, 1))
        except (Lost, Ended):
            pass  # who waits for the server says so

    def stop(self):
        self._stopped = True
        self.join(timeout=1)


def _run_with(motion, serve, output, record, force, tell, rigid=False):
    """Server, recorder and rigid process as processes of their own, with these words; bodies moved here."""
    with tempfile.TemporaryDirectory(prefix="sluice-", dir=os.environ.get("XDG_RUNTIME_DIR")) as directory:
        endpoint = f"ipc://{directory}/run.ipc"
        words = ["serve", *serve, "--listen", endpoint]
        if output:
            words += ["--expect-recorder", "--checkpoint", str(Path(output).with_suffix(".checkpoint"))]
        with tempfile.TemporaryFile("w+") as log:
            processes = [start(words, log)]
            try:
                if output:
                    words = ["record", "--connect", endpoint, "-o", str(output), *record] + (["--force"] if force else [])
                    processes.append(start(words, log))
                if rigid:
                    processes.append(start(["rigid", "--connect", endpoint], log))
                follower = _Follower(endpoint, tell)
                try:
                    motion(endpoint)
                    codes = [process.wait() for process in processes]
                finally:
                    follower.stop()
            finally:
                for process in processes:
                    process.terminate()
                    process.wait()
            if any(codes):
                log.seek(0)
                raise RunError("; ".join(line.strip() for line in log.readlines()[-3:]))
    tell(1.0)
    return {"status": "FINISHED", "exit_code": 0, "recording": {"path": str(output)} if output else None}
