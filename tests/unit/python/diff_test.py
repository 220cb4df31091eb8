"""Norms against their definitions; what is matched with what; what cannot be compared is named."""

import copy

import numpy as np
from sluice import diff
from written import SCENE, Case, Values, rows_of, write


class NormsTest(Case):
    def test_are_those_of_the_definitions(self):
        random = np.random.default_rng(1)
        a, d = random.normal(size=(7, 3)), random.normal(size=(7, 3))
        n = diff.norms(a, a + d)
        lengths = [np.hypot.reduce(row) for row in d]
        self.assertAlmostEqual(n.maximum, max(lengths), places=14)
        self.assertEqual(n.at, int(np.argmax(lengths)))
        self.assertAlmostEqual(n.l2, (sum(x * x for x in lengths) / 7) ** 0.5, places=14)
        self.assertAlmostEqual(n.relative, (sum(x * x for x in lengths) / np.sum(a * a)) ** 0.5, places=14)

    def test_nothing_is_far_from_nothing_only_if_it_differs(self):
        self.assertEqual(diff.norms([0.0], [0.0]).relative, 0)
        self.assertEqual(diff.norms([0.0], [1e-100]).relative, np.inf)
        self.assertEqual(diff.norms([np.nan], [np.nan]).maximum, 0)
        self.assertEqual(diff.norms([np.nan], [1.0]).maximum, np.inf)

    def test_scenes_differ_where_they_do(self):
        other = copy.deepcopy(SCENE)
        other["spacing"], other["domain"]["max"][1] = 0.05, 2
        del other["probe"]
        texts = diff.scene_differences(SCENE, other)
        self.assertEqual(len(texts), 3)
        self.assertIn("spacing: 0.1, 0.05", texts)
        self.assertIn("domain.max[1]: 1, 2", texts)


class DiffTest(Case):
    def other(self, change=None, scene=None, **sizes):
        values = Values(**sizes)
        if change:
            change(values)
        return write(self.directory / "other.h5", values, scene)

    def test_the_same_is_identical(self):
        code, out, _ = self.call(diff, self.path, self.other())
        self.assertEqual(code, 0)
        self.assertIn("identical at 6 common times of 6 and 6", out)

    def test_one_particle_at_one_time_is_found(self):
        def push(values):
            values.velocity[4, 13] += [3e-3, 4e-3, 0]

        table = self.directory / "diff.csv"
        code, out, _ = self.call(diff, self.path, self.other(push), "--csv", table)
        self.assertEqual(code, 1)
        self.assertIn("first at t = 0.4 s in velocity", out)
        rows = [row for row in rows_of(table) if float(row["max"]) > 0]
        self.assertEqual(len(rows), 1)
        self.assertEqual((rows[0]["field"], rows[0]["time_s"], rows[0]["at"]), ("velocity", "0.4", "particle 13"))
        self.assertAlmostEqual(float(rows[0]["max"]), 5e-3, places=14)
        self.assertAlmostEqual(float(rows[0]["l2"]), 5e-3 / 20**0.5, places=14)

    def test_a_tolerance_is_on_the_relative_norm(self):
        def scale(values):
            values.density *= 1.001

        other = self.other(scale)
        self.assertEqual(self.call(diff, self.path, other, "--tolerance", "0.00101")[0], 0)
        self.assertEqual(self.call(diff, self.path, other, "--tolerance", "0.00099")[0], 1)
        self.assertEqual(self.call(diff, self.path, other, "--field", "position,energy")[0], 0)

    def test_only_common_times_count(self):
        code, out, _ = self.call(diff, self.path, self.other(frames=6), "--from", "0.15", "--until", "0.4", "--every", "2")
        self.assertEqual(code, 0)
        self.assertIn("identical at 2 common times", out)

    def test_what_cannot_be_compared_is_named(self):
        fewer = self.other(particles=15)
        self.expect_error(diff, [self.path, fewer], "has a number of particles of 20", "15", "--field energy")
        self.expect_error(diff, [self.path, self.path, "--field", "colour"], "no field 'colour'", "choose from position")
        solid = copy.deepcopy(SCENE)
        solid["dimension"] = 3
        self.expect_error(diff, [self.path, self.other(scene=solid)], "has the dimension 2", "3")
        renamed = copy.deepcopy(SCENE)
        renamed["body"][0]["name"] = "door"
        self.expect_error(diff, [self.path, self.other(scene=renamed)], "has the bodies ['gate']", "['door']")
        self.expect_error(diff, [self.path, self.path, "--from", "7"], "no frame from 7 to inf s")
        self.expect_error(diff, [self.path, self.path, "--tolerance", "-1"], "--tolerance -1 is negative")
        self.expect_error(diff, [self.path], "required: B.h5")

    def test_other_resolutions_compare_by_energy_and_probe(self):
        code, out, _ = self.call(diff, self.path, self.other(particles=15), "--field", "energy,probe floor")
        self.assertIn("probe floor pressure", out)
        self.assertNotIn("position", out)
        self.assertEqual(code, 1)
