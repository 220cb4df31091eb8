"""What is read is what was written; what is no recording, or not a whole one, is said to be so."""

import os

import h5py
import numpy as np
import sluice
from sluice import diff, export, plot
from sluice.recording import Recording, RecordingError
from written import SCENE, Case, write

BARE = {name: value for name, value in SCENE.items() if name not in ("body", "probe")}


class ReadingTest(Case):
    def test_fields_and_their_derivatives(self):
        with Recording(self.path) as run:
            np.testing.assert_array_equal(run.field("position", 2), self.values.position[2])
            np.testing.assert_array_equal(run.field("velocity_y", -1), self.values.velocity[-1, :, 1])
            np.testing.assert_allclose(run.field("speed", 0), np.hypot(*self.values.velocity[0, :, :2].T))
            self.assertEqual((run.unit("speed"), run.unit("velocity_y"), run.unit("pressure")), ("m/s", "m/s", "Pa"))

    def test_frames_are_found_by_their_time(self):
        with Recording(self.path) as run:
            self.assertEqual([run.frame_at(t) for t in (0, 0.14, 0.16, 0.5)], [0, 1, 2, 5])
            with self.assertRaisesRegex(RecordingError, "time 0.6 s is not in .* which has 0 to 0.5 s"):
                run.frame_at(0.6)

    def test_probes_by_column(self):
        with Recording(self.path) as run:
            self.assertEqual(run.probe_kind("load"), "force")
            np.testing.assert_array_equal(run.probe("load")["moment_z"], self.values.probe[:, 2, 5])
            height = run.probe("level")["height"]
            np.testing.assert_array_equal(np.isnan(height), [True, False] * 3)
            np.testing.assert_array_equal(height[1::2], self.values.probe[1::2, 1, 0])

    def test_every_step_of_the_exchange(self):
        with Recording(self.path) as run:
            time, kinematics, wrenches = run.exchange()
            np.testing.assert_allclose(time, self.values.step_time)
            np.testing.assert_array_equal(kinematics, self.values.kinematics)
            np.testing.assert_array_equal(wrenches, self.values.wrenches)

    def test_single_precision_and_left_out_fields(self):
        def narrow(file):
            values = file["particles/fluid/pressure/value"][:]
            del file["particles/fluid/pressure/value"], file["particles/fluid/density/value"]
            file["particles/fluid/pressure/value"] = values.astype("f4")

        path = write(self.directory / "narrow.h5", self.values, finish=narrow)
        with Recording(path) as run:
            self.assertEqual(run.fields, ["position", "velocity", "pressure"])
            np.testing.assert_array_equal(run.field("pressure", 1), self.values.pressure[1].astype("f4"))
            with self.assertRaisesRegex(RecordingError, "holds no density; its fields are position, velocity, pressure"):
                run.field("density")

    def test_the_shortest_dataset_counts(self):
        def shorten(file):
            checksum = file["frames/checksum"][:4]
            del file["frames/checksum"]
            file["frames/checksum"] = checksum

        with Recording(write(self.directory / "short.h5", self.values, finish=shorten)) as run:
            self.assertEqual((run.frames, len(run.times), len(run.probe("load")["force_x"])), (4, 4, 4))

    def test_the_writer_was_killed(self):
        def die(file):
            file.swmr_mode = True
            os._exit(0)

        path = self.directory / "killed.h5"
        child = os.fork()
        if child == 0:
            write(path, self.values, finish=die)
        os.waitpid(child, 0)
        with Recording(path) as run:
            np.testing.assert_array_equal(run.field("pressure", 3), self.values.pressure[3])


class BadFileTest(Case):
    def expect(self, path, text):
        self.expect_error(plot, [path], str(path), text)
        self.expect_error(diff, [path, self.path], str(path), text)
        self.expect_error(export, [path, "--to", "csv", self.directory / "x"], str(path), text)

    def test_no_file_and_no_recording(self):
        self.expect(self.directory / "absent.h5", "does not exist")
        text = self.directory / "text.h5"
        text.write_text("no recording")
        self.expect(text, "is not an HDF5 file")
        foreign = self.directory / "foreign.h5"
        with h5py.File(foreign, "w") as file:
            file["data"] = 1
        self.expect(foreign, "is not a recording of sluice")

    def test_a_newer_format(self):
        def renew(file):
            file["parameters"].attrs["format"] = np.array([99], np.int32)

        self.expect(write(self.directory / "newer.h5", finish=renew), "has format 99")

    def test_a_truncated_file(self):
        cut = self.directory / "cut.h5"
        whole = self.path.read_bytes()
        for size in (20, 100, len(whole) // 2, len(whole) - 1):
            cut.write_bytes(whole[:size])
            self.expect(cut, str(cut))

    def test_bodies_that_are_not_there(self):
        with Recording(write(self.directory / "bare.h5", scene=BARE)) as run:
            self.assertEqual(run.body_kinematics(0).shape, (0, 19))
            with self.assertRaisesRegex(RecordingError, "has no bodies"):
                run.exchange()
        self.expect_error(plot, [self.directory / "bare.h5", "--bodies"], "has no bodies")
        self.expect_error(plot, [self.directory / "bare.h5", "--probes"], "has no probes")


class PackageTest(Case):
    def test_names_what_it_has(self):
        for name in sluice.__all__:
            self.assertTrue(callable(getattr(sluice, name)), name)
        with self.assertRaises(AttributeError):
            sluice.fly  # noqa: B018
