"""Runs and sweeps from Python: what they return, what they record, and how they fail."""

import json
import subprocess
import threading
import unittest

import h5py
import numpy as np
import sluice
from scenes import SOURCE, TANK, Case
from sluice.launch import program
from sluice.ledger import ledgers
from sluice.motion import Function


class RunTest(Case):
    def test_returns_the_summary_and_tells_the_progress(self):
        told = []
        summary = sluice.run(self.scene, self.directory / "run.h5", until=0.05, threads=1, show=told.append)
        self.assertEqual(summary["status"], "FINISHED")
        self.assertEqual(summary["fluid_particles"], 50)
        self.assertEqual(told[-1], 1.0)
        with sluice.Recording(self.directory / "run.h5") as run:
            self.assertEqual(run.frames, 6)

    def test_settings_change_the_scene(self):
        summary = sluice.run(self.scene, spacing=0.05, settings={"gravity": [0, -1.62]}, until=0.01, threads=1)
        self.assertEqual(summary["fluid_particles"], 200)
        self.assertAlmostEqual(summary["energy"]["start"]["potential"] / (1000 * 0.5 * 1.62 * 0.25), 1, delta=0.02)

    def test_bad_input_is_told_and_starts_nothing(self):
        with self.assertRaisesRegex(sluice.RunError, "spacing: -1 m"):
            sluice.run(self.scene, self.directory / "run.h5", spacing=-1.0)
        self.assertFalse((self.directory / "run.h5").exists())
        with self.assertRaisesRegex(sluice.RunError, "absent.scene"):
            sluice.run(self.directory / "absent.scene")

    def test_a_function_moves_a_gate(self):
        def move(endpoint):
            with sluice.Participant(endpoint) as run:
                (body,) = run.scene.body
                run.drive({"gate": Function(body, lambda t: (0, 0.1 * t * t))})

        sluice.run(self.scene, self.directory / "run.h5", until=0.1, threads=1, motion=move)
        with sluice.Recording(self.directory / "run.h5") as run:
            time, kinematics, _ = run.exchange()
            np.testing.assert_allclose(kinematics[:, 0, 1], 1 + 0.1 * time**2, rtol=1e-12)

    def crane_and_ball(self):
        """The tank with its gate left to a crane, and a ball over the water."""
        ball = 'body { name: "ball" ball { radius: 0.2 } density: 500 position: [0.5, 1.2] }'
        self.scene.write_text(TANK.replace('body { name: "gate"', 'body { name: "gate" owner: "crane"') + ball)

    def drive_crane(self, endpoint):
        with sluice.Participant(endpoint, owner="crane") as run:
            self.assertEqual([body.name for body in run.bodies], ["gate"])
            self.assertEqual(run.wrenches.shape, (1, 6))
            run.drive({"gate": Function(run.bodies[0], lambda t: (0, 0.1 * t * t))})

    def check_crane_and_ball(self, recording):
        with sluice.Recording(recording) as run:
            time, kinematics, _ = run.exchange()
            np.testing.assert_allclose(kinematics[:, 0, 1], 1 + 0.1 * time**2, rtol=1e-12)
            np.testing.assert_allclose(kinematics[:, 1, 1], 1.2 - 0.5 * 9.81 * time**2, rtol=1e-9)  # still in the air
        words = [program(), "replay", str(recording), "--redrive"]
        redriven = subprocess.run(words, capture_output=True, text=True, stdin=subprocess.DEVNULL)
        self.assertEqual(redriven.stdout, "identical\n", redriven.stderr)

    def test_an_owner_moves_its_body_beside_the_rigid_process(self):
        self.crane_and_ball()
        recording = self.directory / "run.h5"
        sluice.run(self.scene, recording, until=0.1, threads=1, motion=self.drive_crane, rigid=True)
        self.check_crane_and_ball(recording)

    def test_sluice_run_waits_for_owners_and_says_where(self):
        self.crane_and_ball()
        recording, endpoint = self.directory / "run.h5", f"ipc://{self.directory}/run.ipc"
        words = [program(), "run", str(self.scene), "-o", str(recording), "--until", "0.1", "--listen", endpoint, "--threads", "1"]
        with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
            self.drive_crane(endpoint)
            said = process.stderr.read()
        self.assertEqual(process.returncode, 0, said)
        self.assertIn(f"waiting for 'crane', the owner of bodies, to join at {endpoint}", said)
        self.check_crane_and_ball(recording)

    def test_the_progress_of_a_run_whose_bodies_are_moved_here_is_told(self):
        told, begun = [], threading.Event()

        def show(fraction):
            told.append(fraction)
            begun.set()

        def move(endpoint):
            with sluice.Participant(endpoint) as run:
                self.assertTrue(begun.wait(30))
                run.drive({"gate": Function(run.scene.body[0], lambda t: (0, 0))})

        sluice.run(self.scene, until=0.05, threads=1, motion=move, show=show)
        self.assertEqual((told[0], told[-1]), (0.0, 1.0))
        self.assertEqual(told, sorted(told))

    def test_nothing_is_started_for_a_motion_when_the_scene_is_wrong(self):
        def move(endpoint):
            self.fail("it was asked for a motion")

        with self.assertRaisesRegex(sluice.RunError, "spacing: -1 m"):
            sluice.run(self.scene, spacing=-1.0, motion=move)
        taken = self.directory / "taken.h5"
        taken.write_text("mine")
        with self.assertRaisesRegex(sluice.RunError, "taken.h5 exists; .* force=True"):
            sluice.run(self.scene, taken, motion=move)

    def test_a_run_that_the_server_ends_fails_with_its_reason(self):
        def move(endpoint):
            with sluice.Participant(endpoint) as run:
                (body,) = run.scene.body
                run.drive({"gate": Function(body, lambda t: (-30 * t, -30 * t))})

        with self.assertRaisesRegex(sluice.RunError, "UNSTABLE"):
            sluice.run(self.scene, motion=move, threads=1)

    def test_a_run_whose_bodies_are_moved_here_fails_with_the_servers_reason(self):
        def move(endpoint):
            with sluice.Participant(endpoint) as run:
                run.step(1, np.full((1, 19), np.nan))

        with self.assertRaisesRegex(Exception, "kinematics of body 0 at step 1: entry 0 is nan"):
            sluice.run(self.scene, until=0.1, threads=1, motion=move)


class ResumeTest(Case):
    """A gate that Python moves, to the end at once and in two parts: the same recording."""

    def lift(self, endpoint):
        with sluice.Participant(endpoint) as run:
            self.starts.append(run.done)
            run.drive({"gate": Function(run.scene.body[0], lambda t: (-0.5 * t * t, -8 * t * t))})

    def bits(self, name):
        with h5py.File(self.directory / name) as file:
            names = ("frames/step", "frames/hash", "frames/checksum", "exchange/step", "exchange/checksum")
            return [file[dataset][:].tolist() for dataset in names]

    def test_is_the_run_that_never_stopped(self):
        self.starts = []
        sluice.run(self.scene, self.directory / "whole.h5", until=0.2, threads=1, motion=self.lift)
        sluice.run(self.scene, self.directory / "part.h5", until=0.1, threads=1, motion=self.lift)
        told = []
        checkpoint = self.directory / "part.checkpoint"
        sluice.resume(checkpoint, until=0.2, threads=2, motion=self.lift, show=told.append)
        self.assertEqual(self.bits("part.h5"), self.bits("whole.h5"))
        self.assertEqual(self.starts[:2], [0, 0])
        self.assertGreater(self.starts[2], 0)
        self.assertEqual(told[-1], 1.0)

    def test_into_another_recording_and_by_the_programs_own_motion(self):
        sluice.run(self.scene, self.directory / "part.h5", until=0.1, threads=1)
        before = self.bits("part.h5")
        summary = sluice.resume(self.directory / "part.checkpoint", output=self.directory / "more.h5", until=0.15)
        self.assertEqual(summary["status"], "FINISHED")
        self.assertEqual(self.bits("part.h5"), before)
        self.assertGreater(len(self.bits("more.h5")[0]), len(before[0]))

    def test_what_is_not_there_is_named(self):
        with self.assertRaisesRegex(sluice.RunError, "absent.h5 is not there"):
            sluice.resume(self.directory / "absent.checkpoint", motion=self.lift)


class LedgerTest(Case):
    def test_is_that_of_inspect(self):
        scene = SOURCE / "clients/scenes/falling_cylinder.scene"
        path = self.directory / "run.h5"
        sluice.run(scene, path, spacing=0.022, until=0.1, threads=1)
        inspected = subprocess.run([program(), "inspect", path, "--json"], check=True, capture_output=True)
        (expected,) = json.loads(inspected.stdout)["ledger"]
        with sluice.Recording(path) as run:
            (cylinder,) = ledgers(run)
        self.assertAlmostEqual(cylinder.time[-1], expected["time"], places=12)
        self.assertEqual(set(cylinder.impulses), set(expected["impulse"]))
        for name, values in cylinder.impulses.items():
            np.testing.assert_allclose(values[-1, :3], expected["impulse"][name]["force"], rtol=1e-9, atol=1e-12)
            np.testing.assert_allclose(values[-1, 3:], expected["impulse"][name]["moment"], rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(cylinder.momentum[-1], expected["momentum_change"], rtol=1e-12)
        self.assertAlmostEqual(cylinder.work[-1] / expected["work_of_liquid"], 1, places=9)
        self.assertLess(cylinder.residual.max(), 1e-9)


class SweepTest(Case):
    def measure(self, recording):
        return {"particles": recording.particles, "frames": recording.frames}

    def test_is_a_table_of_all_combinations(self):
        values = {"spacing": [0.1, 0.05], "liquid.density": [900.0, 1000.0]}
        table = sluice.sweep(self.scene, values, self.measure, at_once=2, until=0.02)
        settings = [(row["spacing"], row["liquid.density"]) for row in table]
        self.assertEqual(settings, [(0.1, 900.0), (0.1, 1000.0), (0.05, 900.0), (0.05, 1000.0)])
        self.assertEqual([row["particles"] for row in table], [50, 50, 200, 200])
        self.assertEqual({row["status"] for row in table}, {"FINISHED"})
        self.assertEqual({row["recording"] for row in table}, {None})

    def test_a_run_that_fails_is_a_row_that_says_why(self):
        kept = self.directory / "runs"
        table = sluice.sweep(self.scene, [{"spacing": 0.1}, {"spacing": -1.0}], self.measure, directory=kept, until=0.02)
        self.assertEqual([row["status"] for row in table], ["FINISHED", "BAD_INPUT"])
        self.assertIn("spacing", table[1]["detail"])
        self.assertNotIn("frames", table[1])
        self.assertEqual(table[0]["recording"], str(kept / "run_0.h5"))
        sluice.write_table(table, self.directory / "table.csv")
        lines = (self.directory / "table.csv").read_text().splitlines()
        self.assertEqual(len(lines), 3)
        self.assertTrue(lines[0].startswith("spacing,status,detail"))


if __name__ == "__main__":
    unittest.main()
