"""Small recordings, written by h5py as clients/recording/README.md describes them, with values that tests can predict."""

import contextlib
import csv
import io
import json
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

UP = {"constant": {"velocity": [0, 1]}}
GATE = {"name": "gate", "box": {"size": [0.1, 0.4]}, "position": [0.5, 0.2], "prescribed": UP}
PROBES = [
    {"name": "floor", "point": {"position": [0.2, 0.0]}},
    {"name": "level", "surface": {"position": [0.2, 0.0]}},
    {"name": "load", "force": {"body": "gate"}},
]
SCENE = {
    "name": "written", "dimension": 2, "spacing": 0.1, "duration": 1.0, "gravity": [0, -9.81],
    "domain": {"min": [0, 0], "max": [1, 1], "open": ["Y_MAX"]}, "body": [GATE], "probe": PROBES, "output": {"rate": 10},
}


class Values:
    """Frames of 20 particles on a lattice that move to the right; frame f is at f / 10 s, of 5 steps each."""

    steps_per_frame = 5

    def __init__(self, frames=6, particles=20, seed=0):
        random = np.random.default_rng(seed)
        lattice = np.array([[0.05 + 0.1 * (i % 5), 0.05 + 0.1 * (i // 5), 0.0] for i in range(particles)])
        self.frames, self.particles = frames, particles
        self.position = lattice + 0.02 * np.arange(frames)[:, None, None] * [1, 0, 0]
        self.velocity = random.normal(size=(frames, particles, 3)) * [1, 1, 0]
        self.density = 1000 + random.normal(size=(frames, particles))
        self.pressure = 500 * random.normal(size=(frames, particles))
        steps = (frames - 1) * self.steps_per_frame
        self.step_time = 0.02 * (1 + np.arange(steps))
        self.kinematics = np.zeros((steps, 1, 19))
        self.kinematics[:, 0, :2] = np.column_stack([np.full(steps, 0.5), 0.2 + self.step_time])
        self.kinematics[..., 3], self.kinematics[..., 8] = 1, 1
        self.wrenches = random.normal(size=(steps, 1, 6))
        self.parts = random.normal(size=(steps, 1, 12))
        self.probe = random.normal(size=(frames, 3, 6))
        self.probe[:, 1, 1] = np.arange(frames) % 2  # the level is known at odd frames
        energies = ("kinetic", "potential", "elastic", "boundary_work", "max_speed")
        self.energy = {name: random.normal(size=frames) for name in energies}


def write(path, values=None, scene=None, finish=None):
    """A recording of these values; finish(file), if given, is called before the file is closed."""
    values, scene = values or Values(), scene or SCENE
    frame_time_ns = 100_000_000 * np.arange(values.frames)
    with h5py.File(path, "w", libver="v110") as file:
        parameters = file.create_group("parameters")
        parameters.attrs["format"] = np.array([1], np.int32)
        parameters["scene_json"] = np.array([json.dumps(scene).encode()])
        parameters["steps_per_interval"] = np.uint64(values.steps_per_frame)
        parameters["particle_mass"] = 10.0
        file.create_group("status").attrs["reason"] = np.bytes_("FINISHED")
        for name in ("position", "velocity", "density", "pressure"):
            data = getattr(values, name)
            file.create_dataset(f"particles/fluid/{name}/value", data=data, chunks=(1, *data.shape[1:]))
        file["particles/wall/position"] = np.zeros((4, 3))
        file["frames/step"] = np.arange(values.frames, dtype=np.uint64) * np.uint64(values.steps_per_frame)
        file["frames/time_ns"] = frame_time_ns
        file["frames/time"] = 1e-9 * frame_time_ns
        file["frames/checksum"] = np.zeros(values.frames, np.uint64)
        start = np.zeros((1, 1, 19))
        start[0, 0, [0, 1, 3]] = 0.5, 0.2, 1
        every = values.steps_per_frame
        if scene.get("body"):
            file["frames/kinematics"] = np.concatenate([start, values.kinematics[every - 1 :: every]])
            file["frames/wrench"] = np.concatenate([np.zeros((1, 1, 6)), values.wrenches[every - 1 :: every]])
            file["exchange/step"] = np.arange(1, len(values.step_time) + 1, dtype=np.uint64)
            file["exchange/time_ns"] = np.round(1e9 * values.step_time).astype(np.int64)
            file["exchange/checksum"] = np.zeros(len(values.step_time), np.uint64)
            file["exchange/kinematics"], file["exchange/wrenches"] = values.kinematics, values.wrenches
            file["exchange/wrench_parts"] = values.parts
            file["exchange/ledger"] = np.zeros((len(values.step_time), 1, 29))
        if scene.get("probe"):
            file["observables/probe/value"] = values.probe
        for name, series in values.energy.items():
            file[f"observables/energy/{name}/value"] = series
        if finish:
            finish(file)
    return path


def rows_of(path):
    """The rows of a table, each by its headings."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Case(unittest.TestCase):
    """A test with a directory of its own and, as `path` and `values`, a recording in it."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="sluice-test-")
        self.addCleanup(scratch.cleanup)
        self.directory = Path(scratch.name)
        self.values = Values()
        self.path = write(self.directory / "run.h5", self.values)

    def call(self, module, *words):
        """Exit code, stdout and stderr of a command of the package."""
        from sluice.command import run

        name = module.__name__.rpartition(".")[2]
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = run(name, module.main, [str(word) for word in words])
        return code, out.getvalue(), err.getvalue()

    def expect_error(self, module, words, *texts):
        """Bad input: exit code 1, one line on stderr with these texts."""
        code, _, err = self.call(module, *words)
        self.assertEqual(code, 1, words)
        self.assertEqual(err.count("\n"), 1, err)
        for text in texts:
            self.assertIn(text, err)
