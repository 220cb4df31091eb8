"""Moves the free bodies of a scene in the plane: gravity and the water, no contact.

    python3 falling_body.py ipc://PATH
"""

import sys

import numpy as np
from sluice.participant import Participant


class Body:
    """Kick, drift, kick (protocol/README.md, Rigid exchange), for translation and rotation alike."""

    def __init__(self, body, gravity):
        if body.WhichOneof("shape") != "ball":
            sys.exit(f"{body.name}: only balls here")
        area = np.pi * body.ball.radius**2
        mass = body.mass or body.density * area
        self.inertia = np.array([mass, mass, mass * body.ball.radius**2 / 2])
        self.gravity = np.array([*gravity, 0.0])
        self.place = np.array([*body.position, body.angle])  # x, y [m], angle [rad]
        self.speed = np.array([*body.velocity, *body.angular_velocity])

    def acceleration(self, wrench):
        return wrench[[0, 1, 5]] / self.inertia + self.gravity

    def predict(self, wrench, dt):
        acceleration = self.acceleration(wrench)
        self.speed = self.speed + dt / 2 * acceleration
        self.place = self.place + dt * self.speed
        row = np.zeros(19)
        row[[0, 1]] = self.place[:2]
        row[[3, 6]] = np.cos(self.place[2] / 2), np.sin(self.place[2] / 2)
        row[[7, 8, 12]] = self.speed
        row[[13, 14, 18]] = acceleration
        return row

    def correct(self, wrench, dt):
        self.speed = self.speed + dt / 2 * self.acceleration(wrench)


def main():
    with Participant(sys.argv[1], "falling_body.py") as run:
        bodies = [Body(body, run.scene.gravity) for body in run.scene.body]
        for step in range(1, run.clock.steps + 1):
            dt = run.clock.duration(step)
            rows = [body.predict(wrench, dt) for body, wrench in zip(bodies, run.wrenches)]
            for body, wrench in zip(bodies, run.step(step, rows)):
                body.correct(wrench, dt)
        run.wait_for_end()


if __name__ == "__main__":
    main()
