"""Outlines of a scene's walls and bodies, in its x-y plane; bodies in three dimensions are in solids.py."""

import numpy as np


def area_and_centroid(vertices):
    """Area and centroid of a polygon [n, 2]."""
    x, y = vertices.T
    x1, y1 = np.roll(vertices, -1, axis=0).T
    cross = x * y1 - x1 * y
    area = cross.sum() / 2
    return area, np.array([((x + x1) * cross).sum(), ((y + y1) * cross).sum()]) / (6 * area)


def _given_outlines(body):
    """A shape's outlines, each [n, 2], in the frame that it is given in: one, or one a part of a compound."""
    if "compound" in body:
        return [_placed_part(part) for part in body["compound"]["part"]]
    if "box" in body:
        a, b = np.array(body["box"]["size"][:2]) / 2
        return [np.array([[-a, -b], [a, -b], [a, b], [-a, b]])]
    if "ball" in body:
        angle = np.linspace(0, 2 * np.pi, 120, endpoint=False)
        return [body["ball"]["radius"] * np.column_stack([np.cos(angle), np.sin(angle)])]
    return [np.array([[v.get("x", 0.0), v.get("y", 0.0)] for v in body["polygon"]["vertex"]])]


def _placed_part(part):
    """A compound's part [n, 2] where it stands in the compound's frame."""
    angle = part.get("angle", 0.0)
    turn = rotation([np.cos(angle / 2), 0, 0, np.sin(angle / 2)])
    return _given_outlines(part)[0] @ turn.T + np.array((part.get("position") or [0, 0])[:2])


def _center(body):
    """Centre of mass [2] in the frame that the shape is given in."""
    if body.get("center_of_mass"):
        return np.array(body["center_of_mass"][:2])
    if "polygon" in body:
        return area_and_centroid(_given_outlines(body)[0])[1]
    if "compound" in body:
        parts = body["compound"]["part"]
        density = np.array([part.get("density", body.get("density", 1.0)) for part in parts])
        measured = [area_and_centroid(_placed_part(part)) for part in parts]
        weight = density * [abs(area) for area, _ in measured]
        return weight @ np.array([place for _, place in measured]) / weight.sum()
    return np.zeros(2)


def outlines(body):
    """A plane body's outlines, each [n, 2], in its own frame [m], whose origin is the centre of mass."""
    return [outline - _center(body) for outline in _given_outlines(body)]


def rotation(quaternion):
    """The x-y block of the rotation matrix of a quaternion w x y z."""
    w, x, y, z = quaternion
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z)], [2 * (x * y + w * z), 1 - 2 * (x * x + z * z)]])


def placed(body, kinematics):
    """The outlines, each [n, 2], where a row of kinematics [19] puts them."""
    turn = rotation(kinematics[3:7])
    return [outline @ turn.T + kinematics[:2] for outline in outlines(body)]


def domain(scene):
    """Corners of the tank: lower and upper, each [dimension]."""
    upper = np.array(scene["domain"]["max"], dtype=float)
    return np.array(scene["domain"].get("min") or np.zeros(len(upper)), dtype=float), upper


def enclosure(scene):
    """The same of the closed sides alone; infinite where a side has no wall."""
    lower, upper = domain(scene)
    for k, axis in enumerate("XYZ"[: len(upper)]):
        open_sides = scene["domain"].get("open", [])
        is_periodic = f"{axis}_AXIS" in scene["domain"].get("periodic", [])
        lower[k] = -np.inf if is_periodic or f"{axis}_MIN" in open_sides else lower[k]
        upper[k] = np.inf if is_periodic or f"{axis}_MAX" in open_sides else upper[k]
    return lower, upper


def walls(scene, axes=(0, 1)):
    """The closed sides of the tank seen along the third axis, each [2, 2], in the plane of two axes."""
    lower, upper = (corner[list(axes)] for corner in domain(scene))
    lines = []
    for across, along in ((0, 1), (1, 0)):
        for corner in enclosure(scene):
            line = np.empty((2, 2))
            line[:, across] = corner[axes[across]]
            line[:, along] = lower[along], upper[along]
            lines += [line] if np.isfinite(line).all() else []
    return lines
