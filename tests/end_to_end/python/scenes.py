"""Scenes of these tests, and a directory for each."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from sluice.launch import program

SOURCE = Path(os.environ["SLUICE_SOURCE"])

# 50 particles at rest and a gate that stands in air: milliseconds of work, 20 steps an output or so.
TANK = """
name: "tank" dimension: 2 spacing: 0.1 duration: 0.2
liquid { max_speed: 3 }
domain { max: [2, 2] open: Y_MAX }
fluid { box { min: [0, 0] max: [1, 0.5] } }
body { name: "gate" box { size: [0.2, 0.4] } position: [1.5, 1] prescribed { constant { velocity: [0, 0] } } }
probe { name: "level" surface { position: [0.5, 0] } }
probe { name: "floor" point { position: [0.5, 0.1] } }
output { rate: 100 }
"""


class Case(unittest.TestCase):
    """A test with a directory of its own, and the tank in it."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="sluice-test-")
        self.addCleanup(scratch.cleanup)
        self.directory = Path(scratch.name)
        self.scene = self.directory / "tank.scene"
        self.scene.write_text(TANK)

    def serve(self, *words):
        """A server with the tank; its endpoint."""
        endpoint = f"ipc://{self.directory}/run.ipc"
        command = [program(), "serve", "--scene", str(self.scene), "--listen", endpoint, "--threads", "1", *words]
        self.server = subprocess.Popen(command, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        self.addCleanup(self.server.wait)
        self.addCleanup(self.server.kill)
        return endpoint
