"""Particles as an image: arrays [height, width] of values, NaN where there is no liquid, of opacity and of brightness, which is
None where all is lit alike.
"""

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


def _bands(grid, places, radius):
    """Blocks of particles, by height, and the rows of pixels that each reaches: as pixels of an image that has a margin of
    `reach` all around, so that a square of pixels about any particle lies in it. Particles beyond the margin are left out.

    Yields the particles [n], the pixel [n, side * side] of each within its band, the band, and squared distances [n, side, side]
    over radius^2; the margin comes first of all.
    """
    reach = int(np.ceil(radius / grid.pixel))
    yield reach
    span = np.arange(-reach, reach + 1)
    width = grid.width + 2 * reach
    cell = np.floor((places - grid.lower) / grid.pixel).astype(int)
    seen = np.all((cell >= -reach) & (cell < np.array([grid.width, grid.height]) + reach), axis=1)
    # Half a margin outside, the square would leave the image: such a particle's cell is moved in, and its distances tell.
    cell = np.clip(cell, 0, [grid.width - 1, grid.height - 1])
    order = np.flatnonzero(seen)
    order = order[np.argsort(cell[order, 1], kind="stable")]
    block = max(1, BLOCK // len(span) ** 2)
    for start in range(0, len(order), block):
        some = order[start : start + block]
        column, row = cell[some, 0, None] + span, cell[some, 1, None] + span
        dx = ((column + 0.5) * grid.pixel + (grid.lower[0] - places[some, 0, None])) / radius
        dy = ((row + 0.5) * grid.pixel + (grid.lower[1] - places[some, 1, None])) / radius
        square = (dy * dy).astype(np.float32)[:, :, None] + (dx * dx).astype(np.float32)[:, None, :]
        first = int(row[0, 0]) + reach
        pixel = (row[:, :, None] + (reach - first)) * width + (column[:, None, :] + reach)
        band = slice(first * width, (int(row[-1, -1]) + reach + 1) * width)
        yield some, pixel.ravel(), band, square


def interpolate(grid, places, values, spacing, volumes=None):
    """Shepard interpolation with Wendland's C2 kernel in the plane, Monaghan, Rep. Prog. Phys. 68 (2005) 1703, eq. 2.7.

    value = sum_j V_j W f_j / sum_j V_j W. Liquid is where the sum below reaches SURFACE, and within DISC of any particle, so
    that spray is seen; opacity goes from 0 to 1 over a pixel there. `volumes` [n] are in units of spacing^2, one each unless
    given.
    """
    radius = SUPPORT * spacing
    bands = _bands(grid, places, radius)
    margin = next(bands)
    shape = grid.height + 2 * margin, grid.width + 2 * margin
    total, image = np.zeros((2, shape[0] * shape[1]))
    edge = np.zeros(total.shape, bool)
    core = np.float32(max(DISC * spacing - grid.pixel, 0.0) / radius) ** 2
    for particles, pixel, band, square in bands:
        if volumes is None and core > 0:
            edge[band][pixel[(square < core).ravel()]] = True
        q = np.sqrt(np.minimum(square, 1, out=square), out=square)
        weight = (1 - q) ** 2
        weight *= weight
        weight *= 1 + 4 * q
        weight *= np.float32(7 / (np.pi * SUPPORT**2))
        if volumes is not None:
            weight *= volumes[particles, None, None].astype(np.float32)
        length = band.stop - band.start
        total[band] += np.bincount(pixel, weight.ravel(), length)
        image[band] += np.bincount(pixel, (weight * values[particles, None, None]).ravel(), length)
    total, image, edge = (part.reshape(shape)[margin:-margin, margin:-margin] for part in (total, image, edge))
    with np.errstate(invalid="ignore", divide="ignore"):
        image = image / total
    steepness = grid.pixel / spacing  # about the change of the sum over a pixel at a surface
    opacity = np.maximum(np.clip(0.5 + (total - SURFACE) / steepness, 0, 1), edge)
    image[opacity == 0] = np.nan
    return image, opacity, None


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
    if depth is None:
        return *grid.shaped(image, opacity), None
    opacity = (distance < radius).astype(float)
    brightness = 0.6 + 0.4 * np.sqrt(1 - np.minimum(distance / radius, 1) ** 2)
    return grid.shaped(image, opacity, brightness)
