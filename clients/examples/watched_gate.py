"""Lifts the first body of a scene while the water presses on it with more than a given force, and holds it else.

    python3 watched_gate.py ipc://PATH [FORCE]

A motion that depends on the water cannot be written in a scene; FORCE [N] is 20 unless given.
"""

import sys

import numpy as np
from sluice.participant import Participant

SPEED, RELAXATION = 0.5, 0.02  # [m/s], [s] in which the gate takes up its speed


def row(position, velocity, acceleration):
    kinematics = np.zeros(19)
    kinematics[0:3], kinematics[3], kinematics[7:10], kinematics[13:16] = position, 1, velocity, acceleration
    return kinematics


def main():
    threshold = float(sys.argv[2]) if len(sys.argv) > 2 else 20.0
    with Participant(sys.argv[1], "watched_gate.py") as run:
        up = -np.array([*run.scene.gravity, 0.0][:3])
        up /= np.linalg.norm(up)
        places = [np.array([*body.position, 0.0][:3]) for body in run.scene.body]
        speed = 0.0
        for step in range(1, run.clock.steps + 1):
            dt = run.clock.duration(step)
            wanted = SPEED if np.linalg.norm(run.wrenches[0, :3]) > threshold else 0.0
            acceleration = (wanted - speed) / RELAXATION
            speed += dt * acceleration
            places[0] = places[0] + dt * speed * up
            rows = [row(place, 0 * up, 0 * up) for place in places]
            rows[0] = row(places[0], speed * up, acceleration * up)
            run.step(step, rows)
        run.wait_for_end()


if __name__ == "__main__":
    main()
