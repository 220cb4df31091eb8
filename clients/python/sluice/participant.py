"""A participant that moves the bodies of a run in place of `sluice rigid`; protocol/README.md is the reference."""

import numpy as np
import zmq

import messages_pb2 as messages

PROTOCOL_VERSION = 1
PATIENCE = 10_000  # [ms] with a silent server


class Ended(Exception):
    """The run is over; `end` says why (messages.proto, End)."""

    def __init__(self, end):
        super().__init__(f"{messages.End.Reason.Name(end.reason)} {end.detail}".strip())
        self.end = end


class Clock:
    """Times of the steps [ns]: whole, and the same in every process."""

    def __init__(self, welcome):
        self.steps = welcome.steps
        self._interval, self._per_interval = welcome.interval_ns, welcome.steps_per_interval

    def time_ns(self, step):
        whole, part = divmod(step, self._per_interval)
        return whole * self._interval + part * self._interval // self._per_interval

    def time(self, step):
        """End of a step [s]."""
        return 1e-9 * self.time_ns(step)

    def duration(self, step):
        """[s]"""
        return 1e-9 * (self.time_ns(step) - self.time_ns(step - 1))


class Participant:
    """The connection: greets, sends kinematics, gives wrenches.

    `scene` is the run's scene (scene.proto), `clock` its Clock, `wrenches` [bodies, 6] the fluid's force [N] and
    moment about the centre of mass [N m] on every body at the last step answered, at time 0 to begin with.
    """

    def __init__(self, endpoint, program="python"):
        self._context = zmq.Context()
        self._socket = self._context.socket(zmq.DEALER)
        self._socket.setsockopt(zmq.LINGER, 1000)
        self._socket.connect(endpoint)
        self._run_id, self._token, self._sequence = "", 0, 0
        hello = messages.Header()
        hello.hello.role, hello.hello.program = messages.RIGID, program
        self._send(hello)
        answer, arrays = self._receive()
        self._run_id, self._token = answer.run_id, answer.session_token
        self.scene, self.clock = answer.welcome.scene, Clock(answer.welcome)
        self.wrenches = arrays["wrenches"]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._context.destroy(linger=1000)

    def step(self, step, kinematics):
        """Sends the bodies' motion over one step, a row [19] a body (messages.proto, Kinematics); the wrenches at its end.

        Raises Ended when the server has ended the run instead.
        """
        rows = np.ascontiguousarray(kinematics, dtype="<f8").reshape(1, len(self.scene.body), 19)
        self._sequence += 1
        header = messages.Header(sequence=self._sequence, step=step, time_ns=self.clock.time_ns(step))
        header.kinematics.first_step, header.kinematics.count = step, 1
        header.array.add(name="kinematics", type=messages.Array.FLOAT64, shape=rows.shape)
        self._send(header, rows.tobytes())
        _, arrays = self._receive()
        self.wrenches = arrays["wrenches"][0]
        return self.wrenches

    def wait_for_end(self):
        """The server's End, after the last step."""
        try:
            self._receive()
        except Ended as ended:
            return ended.end
        raise RuntimeError("the server went on after the last step")

    def _send(self, header, *arrays):
        header.protocol_version = PROTOCOL_VERSION
        header.run_id, header.session_token = self._run_id, self._token
        self._socket.send_multipart([header.SerializeToString(), *arrays])

    def _receive(self):
        while True:
            if not self._socket.poll(PATIENCE):
                raise TimeoutError(f"no message from the server for {PATIENCE // 1000} s")
            first, *frames = self._socket.recv_multipart()
            header = messages.Header.FromString(first)
            content = header.WhichOneof("content")
            if content == "refusal":
                raise RuntimeError(header.refusal.reason)
            if content == "end":
                raise Ended(header.end)
            if content != "heartbeat":
                arrays = zip(header.array, frames)
                return header, {a.name: np.frombuffer(raw, "<f8").reshape(a.shape) for a, raw in arrays}
