"""A watcher that comes late, beside a participant that steps the run: both see the same."""

import subprocess

import numpy as np
import sluice
from scenes import Case
from sluice.launch import program
from sluice.link import Lost, publish_address
from sluice.motion import row


class WatcherTest(Case):
    def steps(self, run, first, last):
        """The gate stays where it is."""
        for step in range(first, last + 1):
            run.step(step, [row((1.5, 1, 0))])

    def first_status(self, watcher):
        """Whoever has one gets every frame from then on."""
        while True:
            news = watcher.receive(10)
            self.assertIsNotNone(news)
            if isinstance(news, sluice.Status):
                return news

    def test_a_late_joiner_has_the_scene_and_every_frame_from_then_on(self):
        endpoint = self.serve()
        with sluice.Participant(endpoint) as run:
            every = run.clock.steps_per_output
            self.steps(run, 1, 3 * every)
            with sluice.Watcher(endpoint) as watcher:
                self.assertEqual(watcher.scene.name, "tank")
                self.assertEqual(watcher.boundary.shape[1], 3)
                self.assertEqual(set(watcher.boundary_body), {0})
                status = self.first_status(watcher)
                self.assertEqual((status.step, status.steps), (3 * every, run.clock.steps))
                seen = {}
                for output in range(4, 7):
                    self.steps(run, (output - 1) * every + 1, output * every)
                    seen[output] = run.probe("level")["height"], run.probe("floor")["pressure"]
                self.steps(run, 6 * every + 1, run.clock.steps)
                states = list(watcher.states())
                run.wait_for_end()
            self.assertEqual(watcher.end.detail, f"{run.clock.steps} steps, 0.2 s simulated")
        self.assertEqual([state.index for state in states][:3], [4, 5, 6])
        for state in states[:3]:
            self.assertEqual(state.step, state.index * every)
            self.assertEqual(state.position.shape, (50, 3))
            self.assertEqual((state.probes["level"]["height"], state.probes["floor"]["pressure"]), seen[state.index])
            np.testing.assert_array_equal(state.kinematics[0, :3], [1.5, 1, 0])

    def test_keys_are_used(self):
        keys = self.directory / "keys"
        subprocess.run([program(), "keygen", str(keys)], check=True, capture_output=True)
        endpoint = self.serve("--keys", str(keys), "--until", "0.02")
        with sluice.Watcher(endpoint, keys=keys) as watcher, sluice.Participant(endpoint, keys=keys) as run:
            self.first_status(watcher)
            self.steps(run, 1, run.clock.steps)
            self.assertEqual([state.index for state in watcher.states()][-2:], [1, 2])

    def test_addresses(self):
        self.assertEqual(publish_address("ipc:///tmp/a.ipc"), "ipc:///tmp/a.ipc.publish")
        self.assertEqual(publish_address("tcp://host:7400"), "tcp://host:7401")
        with self.assertRaisesRegex(ValueError, "'host:7400' is none; give ipc://PATH or tcp://HOST:PORT"):
            sluice.Watcher("host:7400")


class ProbeTest(Case):
    def test_a_controller_has_fresh_probes_at_every_output(self):
        endpoint, told = self.serve("--until", "0.05"), []

        def control(run, time):
            told.append((time, float(run.probe("level")["height"])))

        class Held:
            def row(self, step, clock):
                return row((1.5, 1, 0))

        with sluice.Participant(endpoint) as run:
            with self.assertRaisesRegex(KeyError, "no probe 'sea'; its probes: level, floor"):
                run.probe("sea")
            with self.assertRaisesRegex(ValueError, "give one for each"):
                run.drive({"door": Held()})
            end = run.drive({"gate": Held()}, control)
        self.assertEqual(end.reason, 1)
        np.testing.assert_allclose([time for time, _ in told], [0, 0.01, 0.02, 0.03, 0.04])
        np.testing.assert_allclose([height for _, height in told], 0.5, atol=0.02)
        self.assertEqual(len({height for _, height in told}), 5)


class LostTest(Case):
    def test_a_server_that_is_not_there_is_said_to_be(self):
        import sluice.link

        patience, sluice.link.PATIENCE = sluice.link.PATIENCE, 50
        try:
            with self.assertRaisesRegex(Lost, "is it running"):
                sluice.Participant(f"ipc://{self.directory}/nobody.ipc")
        finally:
            sluice.link.PATIENCE = patience
