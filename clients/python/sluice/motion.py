"""Motions of bodies for a participant: a function of time, and an actuator that a controller commands.

Both give rows of kinematics [19] (messages.proto, Kinematics) in which position, mean velocity and acceleration agree.
"""

import numpy as np


def row(position, velocity=(0, 0, 0), acceleration=(0, 0, 0), angle=0.0, spin=0.0, spin_rate=0.0):
    """Kinematics of a body that turns about z at most; [m], [m/s], [m/s^2], [rad], [rad/s], [rad/s^2]."""
    result = np.zeros(19)
    result[0:3] = position
    result[[3, 6]] = np.cos(angle / 2), np.sin(angle / 2)
    result[7:10], result[12] = velocity, spin
    result[13:16], result[18] = acceleration, spin_rate
    return result


class Function:
    """Follows functions of time: offset(t) gives x, y[, z] [m] from the initial position, angle(t), if given, the rotation
    about z [rad] from the initial one. Both are zero at time 0.
    """

    def __init__(self, body, offset, angle=None):
        self._place = np.array([*body.position, 0.0][:3], dtype=float)
        self._angle0 = body.angle
        self._offset, self._angle = offset, angle or (lambda t: 0.0)

    def _pose(self, t):
        """Position and angle as one vector [4]."""
        offset = np.zeros(3)
        given = np.atleast_1d(self._offset(t))
        offset[: len(given)] = given
        return np.append(self._place + offset, self._angle0 + self._angle(t))

    def row(self, step, clock):
        """Velocity is the mean over the step; acceleration the second difference about its end."""
        t, dt = clock.time(step), clock.duration(step)
        before, here, after = self._pose(clock.time(step - 1)), self._pose(t), self._pose(t + dt)
        velocity = (here - before) / dt
        acceleration = (after - 2 * here + before) / dt**2
        return row(here[:3], velocity[:3], acceleration[:3], here[3], velocity[3], acceleration[3])


class Actuator:
    """Moves a body along a direction, at the speed that was commanded last.

    The speed [m/s] follows the command with the lag `response` [s], by at most `fastest`, and the way [m] from the initial
    position stays within `stops`, where the body comes to rest.
    """

    def __init__(self, body, direction, stops, fastest, response):
        if not stops[0] <= 0 <= stops[1]:
            raise ValueError(f"stops {stops} do not hold the way 0 at the start")
        if not (fastest > 0 and response > 0):
            raise ValueError(f"fastest {fastest} m/s and response {response} s must be positive")
        self._start = np.array([*body.position, 0.0][:3], dtype=float)
        self._direction = np.array([*direction, 0.0][:3], dtype=float) / np.linalg.norm(direction)
        self._angle = body.angle
        self.stops, self.fastest, self.response = stops, fastest, response
        self.way, self.speed, self._wanted = 0.0, 0.0, 0.0

    def command(self, speed):
        """From the next step on [m/s]."""
        self._wanted = float(np.clip(speed, -self.fastest, self.fastest))

    def row(self, step, clock):
        dt = clock.duration(step)
        lag = min(dt / self.response, 1.0)
        speed = self.speed + lag * (self._wanted - self.speed)
        low, high = ((stop - self.way) / max(self.response, dt) for stop in self.stops)
        speed = float(np.clip(speed, low, high))
        acceleration = (speed - self.speed) / dt
        self.speed = speed
        self.way += dt * speed
        position = self._start + self.way * self._direction
        return row(position, speed * self._direction, acceleration * self._direction, self._angle)
