"""Surfaces of a scene's bodies in three dimensions: vertices [k, 3] and triangles [m, 3], counter-clockwise from outside."""

from functools import reduce

import numpy as np

ROUND = 48  # corners of a circle
AXES = ("X_AXIS", "Y_AXIS", "Z_AXIS")


def rotation(quaternion):
    """The matrix [3, 3] of a unit quaternion w x y z."""
    w, x, y, z = quaternion
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])


def _swept(rings):
    """Triangles between rings of equally many vertices, one above the other, closed by a fan at either end."""
    count, n = len(rings), len(rings[0])
    k = np.arange(n)
    after = (k + 1) % n
    low = (np.arange(count - 1) * n)[:, None]
    sides = np.concatenate([
        np.stack([low + k, low + after, low + n + after], axis=-1).reshape(-1, 3),
        np.stack([low + k, low + n + after, low + n + k], axis=-1).reshape(-1, 3),
    ])
    bottom = np.column_stack([np.zeros(n - 2, int), k[2:], k[1:-1]])
    top = (count - 1) * n + np.column_stack([np.zeros(n - 2, int), k[1:-1], k[2:]])
    return np.concatenate(rings), np.concatenate([sides, bottom, top])


def _circle():
    angle = 2 * np.pi * np.arange(ROUND) / ROUND
    return np.column_stack([np.cos(angle), np.sin(angle), np.zeros(ROUND)])


def box(size):
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) / 2
    rings = [(corners + [0, 0, z]) * size for z in (-0.5, 0.5)]
    return _swept(rings)


def ball(radius):
    """Rings of latitude; the poles are small caps."""
    latitude = np.linspace(0.01 - np.pi / 2, np.pi / 2 - 0.01, ROUND // 2 + 1)
    rings = [radius * (np.cos(a) * _circle() + [0, 0, np.sin(a)]) for a in latitude]
    return _swept(rings)


def cylinder(radius, length, axis="Z_AXIS"):
    vertices, triangles = _swept([radius * _circle() + [0, 0, z * length] for z in (-0.5, 0.5)])
    # A cyclic permutation keeps the sense of the triangles.
    return np.roll(vertices, AXES.index(axis) + 1, axis=1), triangles


def mesh(shape):
    return np.reshape(shape["vertex"], (-1, 3)).astype(float), np.reshape(shape["triangle"], (-1, 3)).astype(int)


def volume_and_center(vertices, triangles):
    """Of the solid inside a closed surface: sums over the tetrahedra from the origin to the triangles."""
    a, b, c = np.moveaxis(vertices[triangles], 1, 0)
    six = np.einsum("ij,ij->i", a, np.cross(b, c))
    return six.sum() / 6, six @ (a + b + c) / (4 * six.sum())


def given(body):
    """The surface in the frame that the shape is given in."""
    if "box" in body:
        return box(body["box"]["size"])
    if "ball" in body:
        return ball(body["ball"]["radius"])
    if "cylinder" in body:
        shape = body["cylinder"]
        return cylinder(shape["radius"], shape["length"], shape.get("axis", "Z_AXIS"))
    if "mesh" in body:
        return mesh(body["mesh"])
    return joined([placed_part(part) for part in body["compound"]["part"]])


def joined(surfaces):
    """Several surfaces as one."""

    def join(one, other):
        return np.vstack([one[0], other[0]]), np.vstack([one[1], other[1] + len(one[0])])

    return reduce(join, surfaces)


def placed_part(part):
    """The surface of a compound's part where it stands in the compound's frame."""
    vertices, triangles = given(part)
    turn = rotation(part.get("orientation") or [1, 0, 0, 0])
    return vertices @ turn.T + np.array(part.get("position") or [0, 0, 0]), triangles


def center(body):
    """The centre of mass [3] in the frame that the shape is given in."""
    if body.get("center_of_mass"):
        return np.array(body["center_of_mass"], dtype=float)
    if "mesh" in body:
        return volume_and_center(*mesh(body["mesh"]))[1]
    if "compound" in body:
        parts = body["compound"]["part"]
        density = np.array([part.get("density", body.get("density", 1.0)) for part in parts])
        measured = [volume_and_center(*placed_part(part)) for part in parts]
        weight = density * [volume for volume, _ in measured]
        return weight @ np.array([place for _, place in measured]) / weight.sum()
    return np.zeros(3)


def surface(body):
    """A body's surface in its own frame [m], whose origin is the centre of mass."""
    vertices, triangles = given(body)
    return vertices - center(body), triangles


def placed(body, kinematics):
    """The surface where a row of kinematics [19] puts it."""
    vertices, triangles = surface(body)
    return vertices @ rotation(kinematics[3:7]).T + kinematics[:3], triangles
