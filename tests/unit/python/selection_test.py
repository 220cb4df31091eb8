"""Recordings of selected particles: in some frames only, in a region, so that their number differs from frame to frame."""

import copy

import numpy as np
from sluice import diff, export, movie, plot
from sluice.recording import Recording, RecordingError
from written import SCENE, Case, Values, rows_of, write

EVERY = 2
LEFT = 0.36  # only particles to the left of this place are in the recording


def selected(values, fields=("position", "velocity", "density", "pressure")):
    """What finish() of `written.write` makes of a recording: particles left of LEFT, in every second frame, by slots."""
    frames = range(0, values.frames, EVERY)
    ids = [np.flatnonzero(values.position[f, :, 0] < LEFT) for f in frames]
    slots = max(map(len, ids))

    def finish(file):
        file["parameters"].attrs["format"] = np.array([2], np.int32)
        del file["particles/fluid"]
        rows = np.full((len(ids), slots), -1)
        for row, who in zip(rows, ids):
            row[: len(who)] = who
        file["particles/fluid/id/value"] = rows
        for name in fields:
            whole = getattr(values, name)
            data = np.full((len(ids), slots, *whole.shape[2:]), np.nan, "f4")
            for row, f, who in zip(data, frames, ids):
                row[: len(who)] = whole[f, who]
            file[f"particles/fluid/{name}/value"] = data

    return finish, ids


class SelectedCase(Case):
    def setUp(self):
        super().setUp()
        self.scene = copy.deepcopy(SCENE)
        self.scene["output"]["particles_every"] = EVERY
        self.some, self.ids = self.write("some.h5", self.values)

    def write(self, name, values, **what):
        finish, ids = selected(values, **what)
        return write(self.directory / name, values, self.scene, finish), ids


class SelectionTest(SelectedCase):
    def test_fields_are_of_the_particles_that_are_there(self):
        self.assertGreater(len({len(who) for who in self.ids}), 1)
        with Recording(self.some) as run:
            self.assertEqual((run.frames, run.particles), (6, max(map(len, self.ids))))
            np.testing.assert_array_equal(run.particle_frames, [0, 2, 4])
            for frame, who in zip((0, 2, 4), self.ids):
                np.testing.assert_array_equal(run.ids(frame), who)
                np.testing.assert_array_equal(run.field("density", frame), self.values.density[frame, who].astype("f4"))
                self.assertEqual(run.field("position", frame).shape, (len(who), 3))
            np.testing.assert_array_equal(run.field("pressure"), run.field("pressure", 4))
            self.assertEqual((run.frame_at(0.31), len(run.probe("load")["force_x"]), len(run.energy("kinetic"))), (4, 6, 6))
            with self.assertRaisesRegex(RecordingError, r"no particles in frame 3, only in 0, 2, 4 \.\.\."):
                run.field("density", 3)

    def test_all_particles_are_counted_where_nothing_is_selected(self):
        with Recording(self.path) as run:
            np.testing.assert_array_equal(run.ids(3), np.arange(20))
            np.testing.assert_array_equal(run.particle_frames, np.arange(6))

    def test_is_drawn(self):
        for words in ([plot, self.some], [plot, self.some, "--times", "0,0.4", "--particles"], [plot, self.some, "--energy"]):
            code, _, err = self.call(*words, "-o", self.directory / "a.png")
            self.assertEqual(code, 0, err)
        self.expect_error(plot, [self.some, "--frame", "3"], "no particles in frame 3")
        code, _, err = self.call(movie, self.some, "-o", self.directory / "a.gif", "--scale", "0.2")
        self.assertEqual(code, 0, err)

    def test_is_drawn_whatever_was_recorded(self):
        for fields in (("position",), ("position", "density")):
            path, _ = self.write("few.h5", self.values, fields=fields)
            code, _, err = self.call(plot, path, "-o", self.directory / "a.png")
            self.assertEqual(code, 0, err)
        self.expect_error(plot, [path, "--field", "speed"], "holds no velocity; its fields are position, density")

    def test_exports_name_the_particles(self):
        code, _, err = self.call(export, self.some, "--to", "csv", self.directory / "csv")
        self.assertEqual(code, 0, err)
        rows = rows_of(self.directory / "csv/particles_00002.csv")
        self.assertEqual([int(row["particle"]) for row in rows], self.ids[1].tolist())
        self.assertEqual(len(list(self.directory.glob("csv/particles_*.csv"))), 3)
        self.assertEqual(len(rows_of(self.directory / "csv/frames.csv")), 6)
        code, out, err = self.call(export, self.some, "--to", "vtk", self.directory / "vtk")
        self.assertEqual(code, 0, err)
        self.assertEqual(len(list(self.directory.glob("vtk/fluid_*.vtp"))), 3)


class SelectedDiffTest(SelectedCase):
    def test_the_same_is_identical(self):
        code, out, _ = self.call(diff, self.some, self.some)
        self.assertEqual(code, 0, out)
        self.assertIn("identical at 6 common times", out)

    def test_particles_are_matched_by_identity(self):
        code, out, _ = self.call(diff, self.some, self.path, "--field", "position", "--tolerance", "1e-6")
        self.assertEqual(code, 0, out)
        self.assertIn("3 common times", out)

    def test_a_particle_is_named_by_its_identity(self):
        other = Values()
        who = self.ids[1][-1]
        other.velocity[2, who] += 1
        table = self.directory / "diff.csv"
        code, _, _ = self.call(diff, self.some, self.write("other.h5", other)[0], "--csv", table)
        self.assertEqual(code, 1)
        rows = [row for row in rows_of(table) if float(row["max"]) > 0]
        self.assertEqual([(row["field"], row["at"]) for row in rows], [("velocity", f"particle {who}")])

    def test_particles_that_one_alone_has_are_counted(self):
        other = Values()
        other.position[2, self.ids[1][:3], 0] += 1
        code, out, _ = self.call(diff, self.some, self.write("other.h5", other)[0], "--field", "particles")
        self.assertEqual(code, 1)
        self.assertRegex(out, r"0\.2 +particles +3 ")
