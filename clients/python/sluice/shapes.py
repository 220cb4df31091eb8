"""Outlines of a scene's walls and bodies, in its x-y plane."""

import numpy as np


def _area_and_centroid(vertices):
    """Area and centroid of a polygon [n, 2]."""
    x, y = vertices.T
    x1, y1 = np.roll(vertices, -1, axis=0).T
    cross = x * y1 - x1 * y
    area = cross.sum() / 2
    return area, np.array([((x + x1) * cross).sum(), ((y + y1) * cross).sum()]) / (6 * area)


def _hull(points):
    """The convex hull of points [n, 2], counter-clockwise (A. M. Andrew, Inf. Process. Lett. 9 (1979) 216)."""
    points = sorted(map(tuple, points))

    def half(chain):
        kept = []
        for x, y in chain:
            while len(kept) > 1:
                (ax, ay), (bx, by) = kept[-2:]
                if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0:
                    break
                kept.pop()
            kept.append((x, y))
        return kept[:-1]

    return np.array(half(points) + half(points[::-1]))


def _area_of(part):
    """Area [m^2] of a part of a plane compound."""
    return abs(_area_and_centroid(_given_outline(part))[0])


def _given_outline(body):
    """A shape's outline [n, 2] in the frame that it is given in; of meshes and compounds their hull."""
    if "cylinder" in body:
        r, half = body["cylinder"]["radius"], body["cylinder"]["length"] / 2
        axis = body["cylinder"].get("axis", "Z_AXIS")
        if axis == "Z_AXIS":
            return _given_outline({"ball": {"radius": r}})
        a, b = (half, r) if axis == "X_AXIS" else (r, half)
        return np.array([[-a, -b], [a, -b], [a, b], [-a, b]])
    if "mesh" in body:
        return _hull(np.array(body["mesh"]["vertex"]).reshape(-1, 3)[:, :2])
    if "compound" in body:
        return _hull(np.vstack([_placed_part(part) for part in body["compound"]["part"]]))
    if "box" in body:
        a, b = np.array(body["box"]["size"][:2]) / 2
        return np.array([[-a, -b], [a, -b], [a, b], [-a, b]])
    if "ball" in body:
        angle = np.linspace(0, 2 * np.pi, 120, endpoint=False)
        return body["ball"]["radius"] * np.column_stack([np.cos(angle), np.sin(angle)])
    return np.array([[v.get("x", 0.0), v.get("y", 0.0)] for v in body["polygon"]["vertex"]])


def _placed_part(part):
    """A compound's part [n, 2] where it stands in the compound's frame."""
    angle = part.get("angle", 0.0)
    quaternion = part.get("orientation") or [np.cos(angle / 2), 0, 0, np.sin(angle / 2)]
    return _given_outline(part) @ rotation(quaternion).T + np.array((part.get("position") or [0, 0])[:2])


def _center(body):
    """Centre of mass [2] in the frame that the shape is given in, seen along z."""
    if body.get("center_of_mass"):
        return np.array(body["center_of_mass"][:2])
    if "polygon" in body:
        return _area_and_centroid(_given_outline(body))[1]
    if "mesh" in body:
        x = np.array(body["mesh"]["vertex"]).reshape(-1, 3)[np.array(body["mesh"]["triangle"]).reshape(-1, 3)]
        six = np.einsum("ij,ij->i", x[:, 0], np.cross(x[:, 1], x[:, 2]))
        return (six @ x.sum(axis=1) / (4 * six.sum()))[:2]
    if "compound" in body:
        parts = body["compound"]["part"]
        density = [part.get("density", body.get("density", 1.0)) for part in parts]
        weight = np.array([d * _area_of(part) for d, part in zip(density, parts)])
        places = np.array([_area_and_centroid(_placed_part(part))[1] for part in parts])
        return weight @ places / weight.sum()
    return np.zeros(2)


def outline(body):
    """A body's outline [n, 2] in its own frame [m], whose origin is the centre of mass."""
    return _given_outline(body) - _center(body)


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
