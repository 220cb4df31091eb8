"""Surfaces of bodies are closed, look outward, enclose what the shape's formula says, and turn about the centre of mass."""

import unittest
from collections import Counter

import numpy as np
from sluice import shapes, solids

BOX = {"box": {"size": [0.1, 0.2, 0.3]}}
TETRAHEDRON = {"mesh": {"vertex": [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], "triangle": [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]}}


class SurfaceTest(unittest.TestCase):
    def check(self, body, volume, tolerance=1e-12):
        vertices, triangles = solids.surface(body)
        edges = Counter((a, b) for triangle in triangles for a, b in zip(triangle, np.roll(triangle, -1)))
        self.assertEqual(set(edges.values()), {1})
        self.assertTrue(all((b, a) in edges for a, b in edges), "an edge has one triangle")
        measured, center = solids.volume_and_center(vertices, triangles)
        self.assertAlmostEqual(measured / volume, 1, delta=tolerance)
        np.testing.assert_allclose(center, 0, atol=1e-12)

    def test_boxes_balls_cylinders_and_meshes(self):
        self.check(BOX, 0.006)
        self.check({"ball": {"radius": 0.5}}, 4 / 3 * np.pi * 0.125, 0.01)
        for axis in solids.AXES:
            self.check({"cylinder": {"radius": 0.5, "length": 2, "axis": axis}}, np.pi / 2, 0.01)
        self.check(TETRAHEDRON, 1 / 6)

    def test_cylinders_lie_along_their_axis(self):
        for k, axis in enumerate(solids.AXES):
            vertices, _ = solids.cylinder(0.5, 2, axis)
            np.testing.assert_allclose(np.ptp(vertices, axis=0), np.where(np.arange(3) == k, 2, 1))

    def test_compounds_balance_about_their_centre_of_mass(self):
        heavy = {"box": {"size": [1, 1, 1]}, "position": [0, 0, 0], "density": 300}
        light = {"box": {"size": [1, 1, 1]}, "position": [2, 0, 0], "density": 100}
        body = {"compound": {"part": [heavy, light]}}
        np.testing.assert_allclose(solids.center(body), [0.5, 0, 0])

    def test_a_quarter_turn_about_z(self):
        kinematics = np.zeros(19)
        kinematics[:7] = 1, 2, 3, np.sqrt(0.5), 0, 0, np.sqrt(0.5)
        vertices, _ = solids.placed(BOX, kinematics)
        np.testing.assert_allclose(vertices.mean(axis=0), [1, 2, 3])
        np.testing.assert_allclose(np.ptp(vertices, axis=0), [0.2, 0.1, 0.3])


class OutlineTest(unittest.TestCase):
    def test_polygons_move_to_their_centroid(self):
        body = {"polygon": {"vertex": [{}, {"x": 3.0}, {"y": 3.0}]}}
        (outline,) = shapes.outlines(body)
        np.testing.assert_allclose(shapes.area_and_centroid(outline)[1], 0, atol=1e-15)

    def test_open_sides_have_no_wall(self):
        scene = {"domain": {"min": [0, 0], "max": [2, 1], "open": ["Y_MAX"]}}
        self.assertEqual(len(shapes.walls(scene)), 3)
        scene["domain"]["periodic"] = ["X_AXIS"]
        (floor,) = shapes.walls(scene)
        np.testing.assert_array_equal(floor, [[0, 0], [2, 0]])
