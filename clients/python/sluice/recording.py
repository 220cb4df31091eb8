"""A recording as NumPy arrays. clients/recording/README.md describes the file."""

import json
from pathlib import Path

import h5py
import numpy as np

from sluice import probes

FORMAT = 3  # and those before
FIELDS = {"position": "m", "velocity": "m/s", "density": "kg/m³", "pressure": "Pa", "liquid": ""}
DERIVED = {"speed": "m/s"}
ENERGIES = ("kinetic", "potential", "elastic", "boundary_work")


class RecordingError(Exception):
    """What is wrong with a file or a request, in one line."""


def _open(path):
    if not path.is_file():
        raise RecordingError(f"{path} does not exist")
    if not h5py.is_hdf5(path):
        raise RecordingError(f"{path} is not an HDF5 file, so no recording")
    # A file that is being written, or whose writer was killed, opens only as a writer's companion. Of any other that would
    # hide damage: HDF5 then waits a minute for a writer to mend it.
    try:
        return h5py.File(path, "r", swmr=_is_open_for_writing(path))
    except OSError as error:
        raise RecordingError(f"{path} is damaged or cut short: {error}") from None


def _is_open_for_writing(path):
    """By the flags of the superblock, HDF5 File Format Specification 3.0, II.A."""
    with open(path, "rb") as file:
        start = file.read(12)
    return len(start) == 12 and start[8] >= 3 and bool(start[11] & 0b101)


class Recording:
    """One run. `times` [s] and `time_ns` have an entry for each frame; fields are read when asked for, a frame at a time.

    `fields` are those that the scene's output had recorded, `particle_frames` the frames that hold particles, and
    `particles` the most in any; who they are say `ids`.

    >>> with Recording("run.h5") as run:
    ...     x = run.field("position", frame=-1)  # [particles, 3], m
    """

    def __init__(self, path):
        self.path = Path(path)
        self._file = _open(self.path)
        try:
            self._read_header()
        except (KeyError, OSError, ValueError, IndexError, TypeError, RuntimeError) as error:
            self.close()
            raise RecordingError(f"{self.path} is not a recording of sluice or is damaged: {error}") from None
        except RecordingError:
            self.close()
            raise

    def _read_header(self):
        parameters = self._file["parameters"]
        version = int(parameters.attrs["format"][0])
        if not 1 <= version <= FORMAT:
            raise RecordingError(f"{self.path} has format {version}, this package reads format 1 to {FORMAT}")
        self.scene = json.loads(parameters["scene_json"][0])
        self.name = self.scene.get("name", "")
        self.spacing = self.scene["spacing"]
        self.dimension = self.scene["dimension"]
        self.bodies = [body["name"] for body in self.scene.get("body", [])]
        # By number; the scene's own has no name.
        self.liquids = ["liquid", *(liquid["name"] for liquid in self.scene.get("other_liquid", []))]
        self.probes = [probe["name"] for probe in self.scene.get("probe", [])]
        self.reason = self._file["status"].attrs["reason"].decode()
        self.steps_per_interval = int(parameters["steps_per_interval"][()])
        self.particle_mass = float(parameters["particle_mass"][()])
        self.fields = [name for name in FIELDS if f"particles/fluid/{name}/value" in self._file]
        # A writer may be adding a frame, or was killed while it did: what all datasets have counts.
        growing = ["frames/step", "frames/checksum"]
        growing += ["frames/kinematics", "frames/wrench"] if self.bodies else []
        growing += ["observables/probe/value"] if self.probes else []
        self._every = self.scene.get("output", {}).get("particles_every", 1)
        self.varies = "particles/fluid/id" in self._file
        by_particle = [f"particles/fluid/{name}/value" for name in self.fields + ["id"] * self.varies]
        rows = [len(self._file[name]) * self._every for name in by_particle]
        self.frames = min(len(self._file[name]) for name in growing)
        self.frames = min([self.frames, *rows])
        self.particle_frames = np.arange(0, self.frames, self._every)
        self.particles = self._file[by_particle[0]].shape[1] if self.fields else 0
        self._ids = None, None  # the frame read last, and those in it
        self.times = self._file["frames/time"][: self.frames]
        self.time_ns = self._file["frames/time_ns"][: self.frames]

    def close(self):
        self._file.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def span_text(self):
        """What times there are, for messages."""
        if self.frames == 0:
            return "it holds no frame"
        return f"it has {self.frames} frames from {self.times[0]:g} to {self.times[-1]:g} s"

    def index(self, frame):
        """The number from 0 of a frame that may be counted from the end, negative."""
        index = frame + self.frames if frame < 0 else frame
        if not 0 <= index < self.frames:
            raise RecordingError(f"{self.path} has no frame {frame}; it has {self.frames} frames, counted from 0")
        return index

    def frame_at(self, time):
        """The frame with particles nearest to a time [s], which may be off by half the interval between two such."""
        if self.frames == 0:
            raise RecordingError(f"{self.path} holds no frame")
        times = self.times[self.particle_frames]
        interval = times[1] - times[0] if len(times) > 1 else 0.0
        first, last = times[0], times[-1]
        if not first - interval / 2 - 1e-9 <= time <= last + interval / 2 + 1e-9:
            raise RecordingError(f"time {time:g} s is not in {self.path}, which has {first:g} to {last:g} s")
        return int(self.particle_frames[np.argmin(np.abs(times - time))])

    def _particle_frame(self, frame):
        """The number of a frame that holds particles; of the last for None."""
        if frame is None and self.frames:
            return int(self.particle_frames[-1])
        index = self.index(-1 if frame is None else frame)
        if index % self._every:
            frames = f"0, {self._every}, {2 * self._every} ..."
            raise RecordingError(f"{self.path} has no particles in frame {index}, only in {frames} (output.particles_every)")
        return index

    def ids(self, frame=None):
        """Who the particles of a frame are, in the order of its fields, ascending: [n]. Those of a run without selected
        particles are 0, 1, ... in all frames."""
        index = self._particle_frame(frame)
        if not self.varies:
            return np.arange(self.particles)
        if self._ids[0] != index:
            row = self._read("particles/fluid/id/value", index // self._every)
            self._ids = index, row[row >= 0]
        return self._ids[1]

    def field(self, name, frame=None):
        """position, velocity [n, 3]; density, pressure, liquid (its number) [n]; and speed, velocity_x ..., position_x ... [n].

        Of the last frame that holds particles unless one is named.
        """
        index = self._particle_frame(frame)
        base, _, component = name.partition("_")
        if name == "speed":
            return np.linalg.norm(self.field("velocity", index), axis=1)
        if name in self.fields:
            row = self._read(f"particles/fluid/{name}/value", index // self._every)
            return (row[: len(self.ids(index))] if self.varies else row).astype(float, copy=False)
        if base in ("position", "velocity") and component in ("x", "y", "z"):
            return self.field(base, index)[:, "xyz".index(component)]
        if name in FIELDS:
            raise RecordingError(f"{self.path} holds no {name}; its fields are {', '.join(self.fields)}")
        known = [*FIELDS, *DERIVED, "velocity_x", "velocity_y", "velocity_z"]
        raise RecordingError(f"there is no field {name!r}; choose one of {', '.join(known)}")

    def unit(self, name):
        return DERIVED.get(name) or FIELDS.get(name.partition("_")[0], "")

    def _read(self, dataset, rows):
        try:
            return self._file[dataset][rows]
        except (OSError, KeyError) as error:
            raise RecordingError(f"{self.path} is damaged: {dataset} cannot be read: {error}") from None

    def body_kinematics(self, frame=-1):
        """[bodies, 19]: position, quaternion w x y z, velocity, angular velocity, both accelerations."""
        if not self.bodies:
            return np.empty((0, 19))
        return self._read("frames/kinematics", self.index(frame))

    def body_wrench(self, frame=-1):
        """[bodies, 6]: force [N] and moment about the centre of mass [N m] by the fluid."""
        if not self.bodies:
            return np.empty((0, 6))
        return self._read("frames/wrench", self.index(frame))

    def probe_kind(self, name):
        """point, surface or force."""
        if name not in self.probes:
            known = ", ".join(self.probes) if self.probes else "none"
            raise RecordingError(f"{self.path} has no probe {name!r}; its probes: {known}")
        entry = self.scene["probe"][self.probes.index(name)]
        return next(kind for kind in probes.COLUMNS if kind in entry)

    def probe(self, name):
        """A probe's values over the frames, by column (probes.COLUMNS), each [frames]; a height without liquid is NaN."""
        kind = self.probe_kind(name)
        return probes.columns(kind, self._read("observables/probe/value", np.s_[: self.frames, self.probes.index(name)]))

    def exchange(self, *extra):
        """Times [s], kinematics [steps, bodies, 19] and wrenches [steps, bodies, 6] of every step, and `extra` datasets."""
        if not self.bodies:
            raise RecordingError(f"{self.path} has no bodies")
        group = self._file["exchange"]
        absent = [name for name in extra if name not in group]
        if absent:
            raise RecordingError(f"{self.path} holds no {absent[0]}; it was made by an older build, run the scene again")
        names = ("kinematics", "wrenches", *extra)
        count = min(len(group[name]) for name in ("step", "time_ns", "checksum", *names))
        values = [self._read(f"exchange/{name}", np.s_[:count]) for name in names]
        return 1e-9 * group["time_ns"][:count], *values

    def energy(self, name):
        """kinetic, potential, elastic, boundary_work [J], max_speed ...: a value for each frame."""
        return self._read(f"observables/energy/{name}/value", np.s_[: self.frames])

    def walls(self):
        """The walls' particles [n, 3], at rest [m]."""
        return self._read("particles/wall/position", np.s_[:])
