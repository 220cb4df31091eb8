"""Pictures are made of what they should be; one frame is read for a picture of one."""

import shutil
import unittest
import xml.etree.ElementTree as ElementTree
from unittest import mock

import h5py
import numpy as np
from sluice import curves, ledger, movie, picture, plot, view
from sluice.recording import Recording, RecordingError
from written import SCENE, Case, Values, write


def reads():
    """Notes (dataset, shape of what was read) of all that h5py reads while it is active."""
    noted = []
    read = h5py.Dataset.__getitem__

    def note(dataset, selection, **options):
        values = read(dataset, selection, **options)
        noted.append((dataset.name, np.shape(values), selection))
        return values

    return mock.patch.object(h5py.Dataset, "__getitem__", note), noted


class ReadingTest(Case):
    def test_a_picture_of_one_frame_reads_that_frame_alone(self):
        path = write(self.directory / "long.h5", Values(frames=60))
        patch, noted = reads()
        with patch:
            self.assertEqual(self.call(plot, path, "--frame", "41", "-o", self.directory / "one.png")[0], 0)
        states = [entry for entry in noted if entry[0].startswith(("/particles/fluid", "/frames/kinematics"))]
        self.assertTrue(any(name == "/particles/fluid/velocity/value" for name, _, _ in states))
        for name, shape, selection in states:
            self.assertEqual(selection, 41, name)
            self.assertLessEqual(np.prod(shape), 60, name)
        self.assertFalse([name for name, _, _ in noted if name.startswith(("/exchange", "/observables"))])


class PictureTest(Case):
    def draw(self, *words):
        out = self.directory / "picture.png"
        code, _, err = self.call(plot, self.path, "-o", out, *words)
        self.assertEqual(code, 0, err)
        self.assertEqual(out.read_bytes()[1:4], b"PNG")

    def test_fields_and_curves_are_drawn(self):
        for words in (
            ["--field", "pressure"], ["--times", "0.1,0.3,0.5", "--front"], ["--particles", "--range", "0,2"], ["--probes"],
            ["--probes", "floor,load"], ["--bodies"], ["--energy"], ["--ledger"],
        ):
            self.draw(*words)

    def test_axes_are_equal_and_say_what_they_are(self):
        with Recording(self.path) as run:
            sheet, (panel,) = picture.draw([(run, 2, "title")], view.make_view, picture.Style("pressure"))
            self.assertEqual(panel.axes.get_aspect(), 1)
            self.assertEqual((panel.axes.get_xlabel(), panel.axes.get_ylabel()), ("x [m]", "y [m]"))
            bar = sheet.figure.axes[-1]
            self.assertEqual(bar.get_ylabel(), "pressure [Pa]")
            (gate,) = panel.bodies.get_paths()
            np.testing.assert_allclose(gate.vertices[:4].mean(axis=0), [0.5, 0.4])

    def test_several_liquids_are_told_apart_by_their_names(self):
        def add_liquids(file):
            file["particles/fluid/liquid/value"] = np.tile(np.arange(20) % 2, (6, 1))

        scene = {**SCENE, "other_liquid": [{"name": "oil", "density": 850}]}
        with Recording(write(self.directory / "two.h5", scene=scene, finish=add_liquids)) as run:
            self.assertEqual(run.liquids, ["liquid", "oil"])
            self.assertEqual(picture.first_field(run), "liquid")
            sheet, (panel,) = picture.draw([(run, 2, "")], view.make_view, picture.Style("liquid"))
            self.assertEqual([text.get_text() for text in sheet.figure.axes[-1].get_yticklabels()], ["liquid", "oil"])
            colors = panel.image.get_array()
            seen = np.unique(colors[colors[..., 3] == 255][:, :3], axis=0)
            expected = np.round(255 * np.array(panel.colors.colors)).astype(int)
            self.assertEqual({tuple(map(int, c)) for c in seen}, {tuple(map(int, c)) for c in expected})

    def test_the_time_has_digits_enough(self):
        with Recording(self.path) as run:
            self.assertEqual(picture.time_text(run, 0.3), "t = 0.3 s")
            run.times = 0.0125 * np.arange(6)
            self.assertEqual(picture.time_text(run, 0.05), "t = 0.0500 s")

    def test_several_runs_are_curves_over_each_other(self):
        other = write(self.directory / "other.h5", Values(seed=3))
        out = self.directory / "both.svg"
        self.assertEqual(self.call(plot, self.path, other, "--energy", "-o", out)[0], 0)
        self.assertTrue(ElementTree.parse(out).getroot().tag.endswith("svg"))
        with Recording(self.path) as a, Recording(other) as b:
            figure = curves.draw([("run", curves.energy_curves(a)), ("other", curves.energy_curves(b))], "energies")
        labels = figure.axes[0].get_legend_handles_labels()[1]
        self.assertEqual(len(labels), 10)
        self.assertIn("kinetic (run)", labels)
        self.assertIn("kinetic (other)", labels)

    def test_a_movie_has_a_picture_a_frame(self):
        from PIL import Image

        out = self.directory / "movie.gif"
        code, _, err = self.call(movie, self.path, "-o", out, "--fps", "10", "--until", "0.35")
        self.assertEqual(code, 0, err)
        with Image.open(out) as made:
            self.assertEqual(made.n_frames, 4)
            self.assertEqual(made.info["duration"], 100)

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_a_movie_is_an_mp4_where_ffmpeg_is(self):
        out = self.directory / "movie.mp4"
        code, _, err = self.call(movie, self.path, "-o", out, "--scale", "0.37")
        self.assertEqual(code, 0, err)
        self.assertEqual(out.read_bytes()[4:8], b"ftyp")


class LedgerTest(Case):
    def test_impulses_are_trapezoids_and_add_up(self):
        with Recording(self.path) as run:
            (gate,) = ledger.ledgers(run)
        force = np.concatenate([np.zeros((1, 6)), self.values.wrenches[:, 0]])
        dt = 0.02
        expected = dt * np.cumsum((force[:-1] + force[1:]) / 2, axis=0)
        np.testing.assert_allclose(sum(gate.impulses.values()), expected, atol=1e-14)
        np.testing.assert_allclose(gate.work, dt * np.cumsum((force[:-1, 1] + force[1:, 1]) / 2), atol=1e-14)


class BadInputTest(Case):
    def test_is_named(self):
        absent = self.directory / "absent.h5"
        self.expect_error(plot, [absent], f"{absent} does not exist")
        self.expect_error(plot, [self.path, "--field", "hue"], "no field 'hue'")
        self.expect_error(plot, [self.path, "--frame", "6"], "no frame 6", "6 frames")
        self.expect_error(plot, [self.path, "--time", "3"], "time 3 s is not in", "0 to 0.5 s")
        self.expect_error(plot, [self.path, "--probes", "sea"], "no probe 'sea'", "floor, level, load")
        self.expect_error(plot, [self.path, "-o", "picture.bmp"], "picture.bmp", ".png, .svg")
        self.expect_error(plot, [self.path, "--range", "2,1"], "'2,1' is not a lower and a higher number")
        self.expect_error(plot, [self.path, "--slice", "0.5"], "--slice are for runs in three dimensions")
        self.expect_error(plot, [self.path, "--time", "nan"], "nan is not finite")
        self.expect_error(movie, [self.path, "-o", "movie.avi"], "movie.avi", ".mp4 or .gif")
        self.expect_error(movie, [self.path, "-o", "movie.gif", "--speed", "100"], "--speed 100 needs", "--every")

    def test_a_movie_without_ffmpeg_says_so(self):
        with mock.patch("shutil.which", return_value=None):
            self.expect_error(movie, [self.path, "-o", self.directory / "movie.mp4"], "ffmpeg", "name a .gif")

    def test_no_frames_to_draw(self):
        empty = write(self.directory / "empty.h5", Values(frames=1))
        with h5py.File(empty, "r+") as file:
            del file["frames/step"]
            file["frames/step"] = np.empty(0, np.uint64)
        self.expect_error(plot, [empty], "holds no frame")
        self.expect_error(plot, [empty, "--energy"], "holds no frame")
        with Recording(empty) as run, self.assertRaises(RecordingError):
            run.field("speed")
