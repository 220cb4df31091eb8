"""Particles as an image: arrays [height, width] of values, NaN where there is no liquid, of opacity and of brightness."""

from dataclasses import dataclass

import numpy as np

SUPPORT = 2.0  # of the interpolation, in spacings
SURFACE = 0.5  # share of a full neighbourhood at which liquid ends
DISC, SPHERE = 0.5, 0.75  # radius of a particle drawn, in spacings
BLOCK = 400_000  # pairs of pixel and particle at once


@dataclass
class Grid:
    """Pixels of a part of the plane: lower corner [2] and size of a pixel [m], number of pixels."""

    lower: np.ndarray
    pixel: float
    width: int
    height: int

    @property
    def extent(self):
        """left, right, bottom, top [m], as matplotlib has it."""
        x, y = self.lower
        return x, x + self.width * self.pixel, y, y + self.height * self.pixel

    def shaped(self, *images):
        return [image.reshape(self.height, self.width) for image in images]


def make_grid(lower, upper, spacing, most_pixels, most_per_spacing=24):
    """Pixels as small as is useful: most_pixels along the longer side at most, and most_per_spacing on a spacing."""
    size = upper - lower
    pixel = max(size.max() / most_pixels, spacing / most_per_spacing)
    width, height = (int(np.ceil(extent / pixel)) for extent in size)
    return Grid(np.asarray(lower, dtype=float), pixel, width, height)


def _pairs(grid, places, radius):
    """Every pixel within a radius [m] of a particle, in blocks: indices of pixels, particles, squared distances [m^2]."""
    reach = int(np.ceil(radius / grid.pixel))
    offset = np.mgrid[-reach : reach + 1, -reach : reach + 1].reshape(2, -1)
    offset = offset[:, np.hypot(*offset) <= reach + 1].astype(np.int32)
    block = max(1, BLOCK // offset.shape[1])
    for start in range(0, len(places), block):
        some = places[start : start + block]
        cell = np.floor((some - grid.lower) / grid.pixel).astype(np.int32)
        column = cell[:, 0, None] + offset[1]
        row = cell[:, 1, None] + offset[0]
        dx = grid.lower[0] + (column + 0.5) * grid.pixel - some[:, 0, None]
        dy = grid.lower[1] + (row + 0.5) * grid.pixel - some[:, 1, None]
        square = dx * dx + dy * dy
        inside = (square < radius * radius) & (column >= 0) & (column < grid.width) & (row >= 0) & (row < grid.height)
        yield row[inside] * grid.width + column[inside], start + np.nonzero(inside)[0], square[inside]


def mirrored(places, values, lower, upper, reach):
    """Adds the images of what is within `reach` of a wall, so that the neighbourhood is full there.

    Corners [2] are infinite where there is no wall. Returns places, values, and the particle that each stands for.
    """
    origin = np.arange(len(places))
    for axis in range(2):
        for wall in (lower[axis], upper[axis]):
            near = np.abs(places[:, axis] - wall) < reach
            images = places[near].copy()
            images[:, axis] = 2 * wall - images[:, axis]
            places, origin = np.concatenate([places, images]), np.concatenate([origin, origin[near]])
    return places, values[origin], origin


def interpolate(grid, places, values, spacing, volumes=None):
    """Shepard interpolation with Wendland's C2 kernel in the plane, Monaghan, Rep. Prog. Phys. 68 (2005) 1703, eq. 2.7.

    value = sum_j V_j W f_j / sum_j V_j W. Liquid is where the sum below reaches SURFACE, and within DISC of any particle, so
    that spray is seen; opacity goes from 0 to 1 over a pixel there. `volumes` [n] are in units of spacing^2, one each unless
    given.
    """
    radius = SUPPORT * spacing
    total, image, edge = np.zeros((3, grid.width * grid.height))
    for pixel, particle, square in _pairs(grid, places, radius):
        q = np.sqrt(square) / radius
        weight = 7 / (np.pi * SUPPORT**2) * (1 - q) ** 4 * (1 + 4 * q)
        if volumes is not None:
            weight *= volumes[particle]
        total += np.bincount(pixel, weight, len(total))
        image += np.bincount(pixel, weight * values[particle], len(total))
        if volumes is None:
            edge[pixel[square < (DISC * spacing - grid.pixel) ** 2]] = 1
    with np.errstate(invalid="ignore", divide="ignore"):
        image /= total
    steepness = grid.pixel / spacing  # about the change of the sum over a pixel at a surface
    opacity = np.maximum(np.clip(0.5 + (total - SURFACE) / steepness, 0, 1), edge)
    image[opacity == 0] = np.nan
    return grid.shaped(image, opacity, np.ones_like(image))


def discs(grid, places, values, spacing, depth=None):
    """Each particle as a disc, the nearest to a pixel in front; with `depth` [n] to the viewer as a sphere."""
    radius = (DISC if depth is None else SPHERE) * spacing
    count = grid.width * grid.height
    front, image, distance = np.full(count, -np.inf), np.full(count, np.nan), np.full(count, np.inf)
    # A disc's edge is half a pixel wide on either side; a sphere's hides what is behind it.
    for pixel, particle, square in _pairs(grid, places, radius + (0.5 * grid.pixel if depth is None else 0)):
        key = -square if depth is None else depth[particle] + np.sqrt(radius * radius - square)
        order = np.argsort(key, kind="stable")  # of the same pixel the front comes last and stays
        order = order[key[order] > front[pixel[order]]]
        at = pixel[order]
        front[at], image[at], distance[at] = key[order], values[particle[order]], np.sqrt(square[order])
    opacity = np.clip((radius - distance) / grid.pixel + 0.5, 0, 1)
    brightness = np.ones(count)
    if depth is not None:
        opacity = (distance < radius).astype(float)
        brightness = 0.6 + 0.4 * np.sqrt(1 - np.minimum(distance / radius, 1) ** 2)
    return grid.shaped(image, opacity, brightness)
