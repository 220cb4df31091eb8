"""Outlines of a scene's walls and bodies, in its x-y plane."""

import numpy as np


def _area_and_centroid(vertices):
    """Area and centroid of a polygon [n, 2]."""
    x, y = vertices.T
    x1, y1 = np.roll(vertices, -1, axis=0).T
    cross = x * y1 - x1 * y
    area = cross.sum() / 2
    return area, np.array([((x + x1) * cross).sum(), ((y + y1) * cross).sum()]) / (6 * area)


def outline(body):
    """A body's outline [n, 2] in its own frame [m], whose origin is the centre of mass."""
    if "box" in body:
        a, b = np.array(body["box"]["size"][:2]) / 2
        return np.array([[-a, -b], [a, -b], [a, b], [-a, b]])
    if "ball" in body:
        angle = np.linspace(0, 2 * np.pi, 120, endpoint=False)
        return body["ball"]["radius"] * np.column_stack([np.cos(angle), np.sin(angle)])
    vertices = np.array([[v.get("x", 0.0), v.get("y", 0.0)] for v in body["polygon"]["vertex"]])
    return vertices - _area_and_centroid(vertices)[1]


def rotation(quaternion):
    """The x-y block of the rotation matrix of a quaternion w x y z."""
    w, x, y, z = quaternion
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z)], [2 * (x * y + w * z), 1 - 2 * (x * x + z * z)]])


def placed(body, kinematics):
    """The outline [n, 2] where a row of kinematics [19] puts it."""
    return outline(body) @ rotation(kinematics[3:7]).T + kinematics[:2]


def domain(scene):
    """Corners of the tank in the plane: lower [2], upper [2]."""
    box = scene["domain"]
    upper = np.array(box["max"][:2])
    return np.array((box.get("min") or [0.0, 0.0])[:2]), upper


def walls(scene):
    """The closed sides of the tank in the plane, each [2, 2]."""
    (x0, y0), (x1, y1) = domain(scene)
    sides = {
        "X_MIN": [[x0, y0], [x0, y1]],
        "X_MAX": [[x1, y0], [x1, y1]],
        "Y_MIN": [[x0, y0], [x1, y0]],
        "Y_MAX": [[x0, y1], [x1, y1]],
    }
    return [np.array(line) for side, line in sides.items() if side not in scene["domain"].get("open", [])]
