"""A participant that moves bodies of a run, all in place of `sluice rigid` or those of an owner beside it;
protocol/README.md is the reference."""

import numpy as np
import zmq

import messages_pb2 as messages
from sluice import probes
from sluice.link import Clock, Ended, Link

__all__ = ["Clock", "Ended", "Participant"]


class Participant:
    """The connection: greets, sends kinematics, gives wrenches and what the probes measure.

    `scene` is the run's scene (scene.proto), `clock` its Clock, `bodies` the bodies that it moves: those whose `owner` the
    scene says to be the one given here, else those without. `wrenches` [bodies, 6] is the fluid's force [N] and
    moment about the centre of mass [N m] on each of them at the last step answered, at time 0 to begin with. `done` are the
    steps that were done before it joined: 0, or in a run that is resumed those up to the checkpoint; the next comes first.
    """

    def __init__(self, endpoint, program="python", keys=None, owner=""):
        self._context = zmq.Context()
        self._sequence = 0
        try:
            hello = messages.Hello(role=messages.RIGID, program=program, probes=True, owner=owner)
            self._link = Link(self._context, endpoint, hello, keys)
        except BaseException:
            self._context.destroy(linger=0)
            raise
        self.scene, self.clock = self._link.welcome.scene, Clock(self._link.welcome)
        bodies = self._link.welcome.body or range(len(self.scene.body))  # a server that knows no owners names none
        self.bodies = [self.scene.body[b] for b in bodies]
        self.done = self._link.welcome.done
        self.wrenches = self._link.arrays["wrenches"]
        self._probes = self._link.arrays.get("probe")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._context.destroy(linger=1000)

    def probe(self, name):
        """What a probe measured at the last output, by column (probes.COLUMNS): `run.probe("level")["height"]` [m]."""
        names = [entry.name for entry in self.scene.probe]
        if name not in names:
            raise KeyError(f"the scene has no probe {name!r}; its probes: {', '.join(names) or 'none'}")
        number = names.index(name)
        return probes.columns(self.scene.probe[number].WhichOneof("kind"), self._probes[number])

    def step(self, step, kinematics):
        """Sends its bodies' motion over one step, a row [19] a body (messages.proto, Kinematics); the wrenches at its end.

        Raises Ended when the server has ended the run instead.
        """
        rows = np.ascontiguousarray(kinematics, dtype="<f8").reshape(1, len(self.bodies), 19)
        self._sequence += 1
        header = messages.Header(sequence=self._sequence, step=step, time_ns=self.clock.time_ns(step))
        header.kinematics.first_step, header.kinematics.count = step, 1
        header.array.add(name="kinematics", type=messages.Array.FLOAT64, shape=rows.shape)
        self._link.send(header, rows.tobytes())
        _, arrays = self._link.receive()
        self.wrenches = arrays["wrenches"][0]
        self._probes = arrays.get("probe", self._probes)
        return self.wrenches

    def drive(self, motions, control=None):
        """Moves its bodies through the whole run, or what is left of it, until the server ends it; its End, which says why.

        `motions` has for every body's name an object with row(step, clock), its kinematics [19] over a step, asked for in
        order (sluice.motion). `control(run, time)` is called at the start and at every output, when the probes are fresh, and
        may change what the motions do from then on.
        """
        names = [body.name for body in self.bodies]
        if sorted(motions) != sorted(names):
            raise ValueError(f"there are motions for {sorted(motions)}, its bodies are {names}; give one for each")
        try:
            for step in range(self.done + 1, self.clock.steps + 1):
                if control and (step - 1) % self.clock.steps_per_output == 0:
                    control(self, self.clock.time(step - 1))
                self.step(step, [motions[name].row(step, self.clock) for name in names])
        except Ended as ended:
            return ended.end
        return self.wait_for_end()

    def wait_for_end(self):
        """The server's End, after the last step."""
        try:
            self._link.receive()
        except Ended as ended:
            return ended.end
        raise RuntimeError("the server went on after the last step")
