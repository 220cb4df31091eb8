"""Holds the level in a channel with a gate: a PID controller that sees a probe, in the place of `sluice rigid`.

    python3 hold_level.py RUN.h5 [LEVEL] [--scene SCENE] [--spacing DX] [--until T]

LEVEL [m] is 0.15 unless given. The scene has a gate, a weir and the probe `level` (scenes/held_level.scene).
"""

import argparse
from pathlib import Path

import numpy as np
import sluice
from sluice.motion import Actuator, Function

SCENE = Path(__file__).resolve().parent.parent / "scenes" / "held_level.scene"


class Pid:
    """Speed of the gate [m/s] from the error of the level [m], in the velocity form: the gate itself is the integrator.

    u = K (e' + e / T_i + T_d e''), by differences over the time between two outputs. Nothing winds up when the gate is at
    a stop. The level is smoothed over `filter_time` [s], because waves pass the probe.
    """

    def __init__(self, level, gain, integral_time, derivative_time, filter_time):
        self.level, self.gain, self.integral_time, self.derivative_time = level, gain, integral_time, derivative_time
        self.filter_time = filter_time
        self.time, self.seen, self.rate = 0.0, None, 0.0

    def speed(self, time, height):
        if self.seen is None or not np.isfinite(height):
            self.seen = height if np.isfinite(height) else self.seen
            self.time = time
            return 0.0
        dt, self.time = time - self.time, time
        before = self.seen
        self.seen += dt / (self.filter_time + dt) * (height - self.seen)
        rate = -(self.seen - before) / dt
        change, self.rate = (rate - self.rate) / dt, rate
        error = self.level - self.seen
        return self.gain * (rate + error / self.integral_time + self.derivative_time * change)


def hold(endpoint, level):
    with sluice.Participant(endpoint, "hold_level.py") as run:
        bodies = {body.name: body for body in run.scene.body}
        gate = Actuator(bodies["gate"], (0, 1), stops=(0.0, 0.25), fastest=0.5, response=0.02)
        weir = Function(bodies["weir"], lambda time: (0.0, 0.0))
        pid = Pid(level, gain=0.8, integral_time=2.0, derivative_time=0.1, filter_time=0.1)

        def control(run, time):
            gate.command(pid.speed(time, run.probe("level")["height"]))

        return run.drive({"gate": gate, "weir": weir}, control)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording", metavar="RUN.h5")
    parser.add_argument("level", type=float, nargs="?", default=0.15, metavar="LEVEL")
    parser.add_argument("--scene", default=SCENE)
    parser.add_argument("--spacing", type=float)
    parser.add_argument("--until", type=float)
    options = parser.parse_args()
    sluice.run(
        options.scene, options.recording, spacing=options.spacing, until=options.until, force=True,
        motion=lambda endpoint: hold(endpoint, options.level),
    )
    with sluice.Recording(options.recording) as run:
        late = run.times > 0.6 * run.times[-1]
        height = run.probe("level")["height"][late]
        print(f"level {np.mean(height):.4f} m, asked for {options.level:.4f} m; waves of {np.std(height):.4f} m (rms)")


if __name__ == "__main__":
    main()
