"""A recording as NumPy arrays. clients/recording/README.md describes the file."""

import json
from pathlib import Path

import h5py
import numpy as np

FORMAT = 1
FIELDS = {"position": "m", "velocity": "m/s", "density": "kg/m³", "pressure": "Pa"}


class RecordingError(Exception):
    """What is wrong with a file or a request, in one line."""


def _open(path):
    if not path.is_file():
        raise RecordingError(f"{path} does not exist")
    if not h5py.is_hdf5(path):
        raise RecordingError(f"{path} is not an HDF5 file, so no recording")
    try:
        return h5py.File(path, "r")
    except OSError:
        pass
    try:
        # A file that is being written, or whose writer was killed, opens only as a writer's companion.
        return h5py.File(path, "r", swmr=True)
    except OSError as error:
        raise RecordingError(f"{path} cannot be opened: {error}") from None


class Recording:
    """One run. `times` [s] has an entry for each frame; fields are read when asked for.

    >>> with Recording("run.h5") as run:
    ...     x = run.field("position", frame=-1)  # [particles, 3], m
    """

    def __init__(self, path):
        self.path = Path(path)
        self._file = _open(self.path)
        try:
            self._read_header()
        except (KeyError, OSError, ValueError, IndexError) as error:
            self.close()
            raise RecordingError(f"{self.path} is not a recording of sluice or is damaged: {error}") from None
        except RecordingError:
            self.close()
            raise

    def _read_header(self):
        parameters = self._file["parameters"]
        version = int(parameters.attrs["format"][0])
        if version != FORMAT:
            raise RecordingError(f"{self.path} has format {version}, this package reads format {FORMAT}")
        self.scene = json.loads(parameters["scene_json"][0])
        self.spacing = self.scene["spacing"]
        self.dimension = self.scene["dimension"]
        self.bodies = [body["name"] for body in self.scene.get("body", [])]
        self.reason = self._file["status"].attrs["reason"].decode()
        # A writer may be adding a frame, or was killed while it did: what all datasets have counts.
        self.frames = min(len(self._file[f"particles/fluid/{name}/value"]) for name in FIELDS)
        self.frames = min(self.frames, len(self._file["frames/step"]), len(self._file["frames/checksum"]))
        if self.bodies:
            self.frames = min(self.frames, len(self._file["frames/kinematics"]), len(self._file["frames/wrench"]))
        self.times = self._file["frames/time"][: self.frames]

    def close(self):
        self._file.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _index(self, frame):
        index = frame + self.frames if frame < 0 else frame
        if not 0 <= index < self.frames:
            raise RecordingError(f"{self.path} has no frame {frame}; it has {self.frames} frames, counted from 0")
        return index

    def frame_at(self, time):
        """The frame nearest to a time [s], which may be off by half an output interval."""
        if self.frames == 0:
            raise RecordingError(f"{self.path} holds no frame")
        interval = self.times[1] - self.times[0] if self.frames > 1 else 0.0
        first, last = self.times[0], self.times[-1]
        if not first - interval / 2 - 1e-9 <= time <= last + interval / 2 + 1e-9:
            raise RecordingError(f"time {time:g} s is not in {self.path}, which has {first:g} to {last:g} s")
        return int(np.argmin(np.abs(self.times - time)))

    def field(self, name, frame=-1):
        """position, velocity [n, 3]; density, pressure [n]; and speed, velocity_x ..., position_x ... [n]."""
        index = self._index(frame)
        base, _, component = name.partition("_")
        if name == "speed":
            return np.linalg.norm(self.field("velocity", index), axis=1)
        if name in FIELDS:
            return self._file[f"particles/fluid/{name}/value"][index]
        if base in ("position", "velocity") and component in ("x", "y", "z"):
            return self.field(base, index)[:, "xyz".index(component)]
        known = [*FIELDS, "speed", "velocity_x", "velocity_y", "velocity_z"]
        raise RecordingError(f"there is no field {name!r}; choose one of {', '.join(known)}")

    def unit(self, name):
        return "m/s" if name == "speed" else FIELDS.get(name.partition("_")[0], "")

    def body_kinematics(self, frame=-1):
        """[bodies, 19]: position, quaternion w x y z, velocity, angular velocity, both accelerations."""
        if not self.bodies:
            return np.empty((0, 19))
        return self._file["frames/kinematics"][self._index(frame)]

    def exchange(self):
        """Times [s], kinematics [steps, bodies, 19] and wrenches [steps, bodies, 6] of every step."""
        if not self.bodies:
            raise RecordingError(f"{self.path} has no bodies")
        group = self._file["exchange"]
        count = min(len(group[name]) for name in ("step", "time_ns", "checksum", "kinematics", "wrenches"))
        return 1e-9 * group["time_ns"][:count], group["kinematics"][:count], group["wrenches"][:count]

    def energy(self, name):
        """kinetic, potential, elastic, boundary_work [J], max_speed ...: a value for each frame."""
        return self._file[f"observables/energy/{name}/value"][: self.frames]
