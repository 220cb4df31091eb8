"""Rows of kinematics agree with themselves: position, mean velocity and acceleration."""

import unittest
from types import SimpleNamespace

import numpy as np
from sluice.motion import Actuator, Function

DT = 1e-3
CLOCK = SimpleNamespace(time=lambda step: DT * step, duration=lambda step: DT)
GATE = SimpleNamespace(position=[0.4, 0.2], angle=0.0)


def rows(motion, count):
    return np.array([motion.row(step, CLOCK) for step in range(1, count + 1)])


class FunctionTest(unittest.TestCase):
    def test_follows_the_function(self):
        motion = Function(GATE, lambda t: (0, 0.05 * np.sin(20 * t)), lambda t: 0.3 * t)
        table = rows(motion, 200)
        t = DT * np.arange(1, 201)
        np.testing.assert_allclose(table[:, 0], 0.4)
        np.testing.assert_allclose(table[:, 1], 0.2 + 0.05 * np.sin(20 * t))
        np.testing.assert_allclose(2 * np.arctan2(table[:, 6], table[:, 3]), 0.3 * t)
        np.testing.assert_allclose(table[:, 12], 0.3)
        np.testing.assert_allclose(table[:, 14], -20 * np.sin(20 * t), atol=20 * (20 * DT) ** 2)

    def test_velocity_is_the_mean_over_the_step(self):
        table = rows(Function(GATE, lambda t: (t**3,)), 50)
        before = np.concatenate([[0.4], table[:-1, 0]])
        np.testing.assert_allclose(before + DT * table[:, 7], table[:, 0], rtol=1e-12)


class ActuatorTest(unittest.TestCase):
    def gate(self):
        return Actuator(GATE, (0, 1), stops=(0, 0.1), fastest=0.5, response=0.02)

    def test_takes_up_the_speed_and_no_more_than_the_fastest(self):
        gate = self.gate()
        gate.command(9.0)
        table = rows(gate, 100)
        self.assertAlmostEqual(table[:, 8].max(), 0.5, places=2)
        self.assertLessEqual(table[:, 8].max(), 0.5)
        before = np.concatenate([[0.2], table[:-1, 1]])
        np.testing.assert_allclose(before + DT * table[:, 8], table[:, 1], rtol=1e-13)
        np.testing.assert_allclose(np.diff(table[:, 8], prepend=0) / DT, table[:, 14], atol=1e-9)

    def test_rests_at_its_stops(self):
        gate = self.gate()
        gate.command(0.5)
        table = rows(gate, 2000)
        self.assertLessEqual(table[:, 1].max(), 0.3)
        self.assertAlmostEqual(table[-1, 1], 0.3, places=6)
        gate.command(-0.5)
        table = np.array([gate.row(step, CLOCK) for step in range(2001, 4001)])
        self.assertGreaterEqual(table[:, 1].min(), 0.2)
        self.assertAlmostEqual(table[-1, 1], 0.2, places=6)
        self.assertAlmostEqual(table[-1, 8], 0, places=6)

    def test_impossible_ones_are_refused(self):
        with self.assertRaisesRegex(ValueError, "do not hold the way 0"):
            Actuator(GATE, (0, 1), stops=(0.1, 0.2), fastest=1, response=0.1)
        with self.assertRaisesRegex(ValueError, "must be positive"):
            Actuator(GATE, (0, 1), stops=(0, 0.2), fastest=0, response=0.1)
