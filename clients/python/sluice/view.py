"""From which side a run is seen, and what of it."""

from dataclasses import dataclass

import numpy as np

from sluice import shapes, solids
from sluice.recording import RecordingError

NAMES = {"xy": (0, 1), "xz": (0, 2), "yz": (1, 2), "zy": (2, 1), "yx": (1, 0), "zx": (2, 0)}
LIGHT = np.array([-0.35, 0.75, 0.56])  # where light comes from: right, up, towards the viewer


@dataclass
class View:
    """A plane of two axes, right and up; `slice` is the place [m] on the third where a layer is cut out, or None."""

    axes: tuple
    toward: np.ndarray  # direction to the viewer, [3]
    slice: float = None

    @property
    def depth_axis(self):
        return int(np.flatnonzero(self.toward)[0])

    def depth(self, x):
        """Of points [n, 3], towards the viewer [m]."""
        return x @ self.toward

    def labels(self):
        return ["xyz"[axis] for axis in self.axes]


def make_view(run, name=None, cut=None):
    """The plane of a plane run; else by its name, from the side with gravity down unless given."""
    if run.dimension == 2:
        if name not in (None, "xy") or cut is not None:
            raise RecordingError("--view and --slice are for runs in three dimensions; this one has two")
        axes = (0, 1)
    elif name is None:
        gravity = np.abs(run.scene.get("gravity") or [0, 0, 1])
        up = int(np.argmax(gravity)) if np.any(gravity) else 2
        axes = (0, up) if up else (1, 0)
    else:
        axes = NAMES[name]
    return View(axes, np.cross(*np.eye(3)[list(axes)]), cut)


def wide_limits(run, view):
    """Lower and upper corner of the tank in the plane of the view."""
    lower, upper = shapes.domain(run.scene)
    return lower[list(view.axes)], upper[list(view.axes)]


def body_polygons(run, view, kinematics):
    """What to draw of the bodies, farthest first: (polygon [n, 2], brightness 0 to 1) each."""
    pairs = list(zip(run.scene.get("body", []), kinematics))
    if run.dimension == 2:
        return [(outline, 1.0) for body, row in pairs for outline in shapes.placed(body, row)]
    faces = [face for body, row in pairs for face in _seen_faces(*solids.placed(body, row), view)]
    return [(polygon, brightness) for _, polygon, brightness in sorted(faces, key=lambda face: face[0])]


def _seen_faces(vertices, triangles, view):
    """(depth, triangle [3, 2], brightness) of those that face the viewer, lit from LIGHT."""
    corners = vertices[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    frame = np.eye(3)[list(view.axes)]
    light = LIGHT @ np.vstack([frame, view.toward])
    brightness = 0.55 + 0.45 * np.clip(normal @ light, 0, 1)
    seen = normal @ view.toward > 0
    plane = corners[:, :, list(view.axes)]
    depth = view.depth(corners).mean(axis=1)
    return list(zip(depth[seen], plane[seen], brightness[seen]))
