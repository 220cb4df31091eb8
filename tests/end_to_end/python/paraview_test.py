"""What ParaView reads by a recording's companion, with each of its readers, is what was recorded."""

import json
import os
import shutil
import subprocess
import sys
import unittest

import numpy as np
import sluice
from scenes import Case

READERS = ("XDMFReader", "Xdmf3ReaderS", "Xdmf3ReaderT")
SCRIPT = """
import json, sys
from paraview import servermanager, simple

def grid(reader):
    data = servermanager.Fetch(reader)
    return data.GetBlock(0) if data.IsA("vtkMultiBlockDataSet") else data

for name in sys.argv[2:]:
    files = {"FileNames" if name == "XDMFReader" else "FileName": [sys.argv[1]]}
    reader = getattr(simple, name)(**files)
    reader.UpdatePipelineInformation()
    frames = []
    for time in reader.TimestepValues:
        reader.UpdatePipeline(time)
        data = grid(reader)
        points = data.GetPointData()
        arrays = [points.GetArray(k) for k in range(points.GetNumberOfArrays())]
        frames.append({
            "time": time, "cells": data.GetNumberOfCells(),
            "position": [data.GetPoint(k) for k in range(data.GetNumberOfPoints())],
            **{a.GetName(): [a.GetTuple(k) for k in range(a.GetNumberOfTuples())] for a in arrays},
        })
    print(json.dumps(frames), flush=True)
"""
SELECTED = {
    "output.particles_every": 2, "output.field": ["PRESSURE"], "output.precision": "FLOAT32",
    "output.region": "{min: [0.3, 0] max: [2, 0.4]}",
}


@unittest.skipUnless(shutil.which("pvpython"), "ParaView is not installed")
class ParaViewTest(Case):
    def read(self, path):
        """The frames as each reader has them."""
        script = self.directory / "read.py"
        script.write_text(SCRIPT)
        words = ["pvpython", "--force-offscreen-rendering", str(script), str(path), *READERS]
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        done = subprocess.run(words, capture_output=True, text=True, env=environment)
        lines = [line for line in done.stdout.splitlines() if line.startswith("[")]
        self.assertEqual(len(lines), len(READERS), done.stderr)
        return [json.loads(line) for line in lines]

    def expect_read(self, settings):
        path = self.directory / "run.h5"
        sluice.run(self.scene, path, settings=settings, until=0.05, threads=1)
        with sluice.Recording(path) as run:
            for name, frames in zip(READERS, self.read(path.with_suffix(".xdmf"))):
                with self.subTest(name):
                    np.testing.assert_allclose([f["time"] for f in frames], run.times[run.particle_frames])
                    for frame, index in zip(frames, run.particle_frames):
                        self.assertEqual(frame["cells"], len(run.ids(index)))
                        for field in run.fields:
                            np.testing.assert_array_equal(np.squeeze(frame[field]), run.field(field, index))
                        if run.varies:
                            np.testing.assert_array_equal(np.squeeze(frame["id"]), run.ids(index))

    def test_everything(self):
        self.expect_read({})

    def test_what_was_selected(self):
        self.expect_read(SELECTED)


if __name__ == "__main__":
    sys.exit(unittest.main())
