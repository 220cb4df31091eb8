"""Images of particles: constants stay constant, the surface is where it should be, the nearest is in front."""

import unittest

import numpy as np
from sluice import raster

DX = 0.1


def lattice(columns, rows):
    return np.array([[(i + 0.5) * DX, (j + 0.5) * DX] for j in range(rows) for i in range(columns)])


def grid(width, height, pixel=0.01):
    return raster.Grid(np.zeros(2), pixel, round(width / pixel), round(height / pixel))


class InterpolationTest(unittest.TestCase):
    def test_a_constant_stays_one_and_a_linear_field_nearly(self):
        x = lattice(20, 10)
        image, opacity, _ = raster.interpolate(grid(2, 1), x, np.full(len(x), 3.5), DX)
        np.testing.assert_allclose(image[opacity > 0], 3.5, rtol=1e-13)
        image, *_ = raster.interpolate(grid(2, 1), x, x[:, 0], DX)
        column = 0.005 + 0.01 * np.arange(40, 160)
        np.testing.assert_allclose(image[40:60, 40:160], np.broadcast_to(column, (20, 120)), atol=0.03 * DX)

    def test_the_surface_is_half_a_spacing_above_the_last_particles(self):
        x = lattice(20, 10)
        _, opacity, _ = raster.interpolate(grid(2, 1.5), x, x[:, 0], DX)
        heights = 0.01 * (opacity > 0.5)[:, 40:160].sum(axis=0)
        self.assertLess(np.abs(heights - 1.0).max(), 0.1 * DX)

    def test_walls_are_as_if_the_liquid_went_on_behind_them(self):
        x = lattice(10, 5)
        places, values, origin = raster.mirrored(x, x[:, 1], np.zeros(2), np.array([1.0, np.inf]), raster.SUPPORT * DX)
        np.testing.assert_array_equal(values, x[origin, 1])
        image, opacity, _ = raster.interpolate(grid(1, 0.4), places, values, DX)
        self.assertEqual(opacity.min(), 1)
        np.testing.assert_allclose(image[0], image[0].mean(), rtol=0.03)

    def test_a_lone_particle_is_seen(self):
        _, opacity, _ = raster.interpolate(grid(1, 1), np.array([[0.5, 0.5]]), np.ones(1), DX)
        area = 1e-4 * (opacity > 0.5).sum()
        self.assertGreater(area, 0.3 * DX**2)
        self.assertLess(area, DX**2)

    def test_blocks_do_not_matter(self):
        x = lattice(20, 10)
        values = np.sin(np.arange(len(x)))
        whole = raster.interpolate(grid(2, 1), x, values, DX)[0]
        block, raster.BLOCK = raster.BLOCK, 3000
        try:
            parts = raster.interpolate(grid(2, 1), x, values, DX)[0]
            front = raster.discs(grid(2, 1), x, values, DX, np.cos(np.arange(len(x))))[0]
        finally:
            raster.BLOCK = block
        np.testing.assert_allclose(parts, whole, rtol=1e-12)
        np.testing.assert_array_equal(front, raster.discs(grid(2, 1), x, values, DX, np.cos(np.arange(len(x))))[0])


class DiscTest(unittest.TestCase):
    def test_the_nearest_particle_colours_a_pixel(self):
        x = np.array([[0.45, 0.5], [0.52, 0.5]])
        image, opacity, _ = raster.discs(grid(1, 1), x, np.array([1.0, 2.0]), DX)
        self.assertEqual(image[50, 47], 1)
        self.assertEqual(image[50, 50], 2)
        self.assertAlmostEqual(1e-4 * opacity.sum(), 2 * np.pi * 0.05**2 - self.lens(0.05, 0.07), delta=3e-4)

    def lens(self, r, d):
        """Overlap of two discs of radius r, d apart."""
        return 2 * r * r * np.arccos(d / (2 * r)) - d / 2 * np.sqrt(4 * r * r - d * d)

    def test_of_spheres_the_one_towards_the_viewer_is_in_front(self):
        x = np.array([[0.5, 0.5], [0.5, 0.5]])
        for depth in ([1.0, 0.0], [0.0, 1.0]):
            image, *_ = raster.discs(grid(1, 1), x, np.array([1.0, 2.0]), DX, np.array(depth))
            self.assertEqual(image[50, 50], 1 if depth[0] > depth[1] else 2)
