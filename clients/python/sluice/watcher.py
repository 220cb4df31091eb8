"""Follows a run while it is computed; protocol/README.md, Watching, is the reference."""

from dataclasses import dataclass

import numpy as np
import zmq

import messages_pb2 as messages
from sluice import probes
from sluice.link import PATIENCE, Clock, Link, Lost, arrays_of, make_socket, publish_address

FIELDS = ("velocity", "density", "pressure", "liquid")


@dataclass
class Status:
    """How far the run is."""

    step: int
    steps: int
    time: float  # [s]
    steps_per_second: float
    # Of every body, how near the exchange with it is to instability (Status in protocol/messages.proto); empty without free ones.
    indicator: tuple = ()


@dataclass
class State:
    """A frame. Particles are in the order of their identity; in two dimensions the third component is zero.

    What the scene's output leaves out is None, of a frame without particles all of theirs; `particles_every`, `field`,
    `region` and `precision` of protocol/scene.proto, Output, say what that is.
    """

    index: int
    step: int
    time: float  # [s]
    id: np.ndarray  # [n], identities, ascending
    position: np.ndarray  # [n, 3], m
    velocity: np.ndarray  # [n, 3], m/s
    density: np.ndarray  # [n], kg/m^3
    pressure: np.ndarray  # [n], Pa
    liquid: np.ndarray  # [n], number; None where there is one liquid
    kinematics: np.ndarray  # [bodies, 19], messages.proto, Kinematics
    wrench: np.ndarray  # [bodies, 6], N and N m
    probes: dict  # name -> column -> value, as in probes.COLUMNS
    energy: object  # messages.proto, Energy


def _particles(a):
    """id, position, velocity, density, pressure and liquid from the arrays of a frame."""
    position = a.get("fluid/position")
    if position is None:
        return [None] * 6
    return [a.get("fluid/id", np.arange(len(position))), position, *(a.get(f"fluid/{n}") for n in FIELDS)]


def _probes(scene, rows):
    return {p.name: probes.columns(p.WhichOneof("kind"), row) for p, row in zip(scene.probe, rows)}


class Watcher:
    """Joins a run at any time, however late; iterating gives a Status or State as they come, until the run ends.

    `scene`, `clock`, the boundary particles `walls` [n, 3] in the world and `boundary` [m, 3] in the frames of the bodies
    `boundary_body` [m] come with the welcome. What was published before it joined, or while it was busy for longer than
    eight messages, a watcher does not get; State.index shows the gap. `end` is the run's End once it is over.

    >>> with Watcher("ipc://run.ipc") as run:
    ...     for state in run.states():
    ...         print(state.time, state.position[:, 0].max())
    """

    def __init__(self, endpoint, topics=("status", "frame"), program="python", keys=None):
        self._endpoint, self.end = endpoint, None
        self._context = zmq.Context()
        try:
            self._news = make_socket(self._context, zmq.SUB, keys)
            # The End has the topic status; who has got a Status gets every frame from then on.
            for topic in sorted({*topics, "status"}):
                self._news.subscribe(topic)
            self._news.connect(publish_address(endpoint))
            hello = messages.Hello(role=messages.WATCHER, program=program)
            self._link = Link(self._context, endpoint, hello, keys)
        except BaseException:
            self._context.destroy(linger=0)
            raise
        self._wants_status = "status" in topics
        self.scene, self.clock = self._link.welcome.scene, Clock(self._link.welcome)
        self.walls, self.boundary, self.boundary_body = (
            self._link.arrays[name] for name in ("wall/position", "boundary/position", "boundary/body")
        )

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._context.destroy(linger=0)

    def __iter__(self):
        while self.end is None:
            news = self.receive(PATIENCE / 1000)
            if news is not None:
                yield news
            elif self.end is None:
                raise Lost(f"nothing came from the server at {self._endpoint} for {PATIENCE // 1000} s")

    def states(self):
        """The frames alone."""
        return (news for news in self if isinstance(news, State))

    def receive(self, timeout):
        """The next Status or State; None when nothing came within the timeout [s], or the run ended: then `end` is set."""
        poller = zmq.Poller()
        poller.register(self._news, zmq.POLLIN)
        poller.register(self._link.socket, zmq.POLLIN)
        while self.end is None:
            ready = dict(poller.poll(1000 * timeout))
            if self._news in ready:
                news = self._read_news()
                if news is not None:
                    return news
            elif self._link.socket in ready:
                self._read_link()
            else:
                return None
        return None

    def _read_link(self):
        """Heartbeats, and an End."""
        first, *_ = self._link.socket.recv_multipart()
        header = messages.Header.FromString(first)
        if header.WhichOneof("content") == "end":
            self.end = header.end

    def _read_news(self):
        _, first, *frames = self._news.recv_multipart()
        header = messages.Header.FromString(first)
        content = header.WhichOneof("content")
        time = 1e-9 * header.time_ns
        if content == "end":
            self.end = header.end
        elif content == "status" and self._wants_status:
            status = header.status
            return Status(header.step, status.steps, time, status.steps_per_second, tuple(status.indicator))
        elif content == "frame":
            a = arrays_of(header, frames)
            measured = _probes(self.scene, a.get("probe", []))
            frame = header.frame
            return State(
                frame.index, header.step, time, *_particles(a), a["body/kinematics"], a["body/wrench"], measured,
                frame.energy,
            )
        return None


__all__ = ["State", "Status", "Watcher"]
