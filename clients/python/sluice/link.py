"""The connection of a client to a server; protocol/README.md is the reference."""

from pathlib import Path

import numpy as np
import zmq

import messages_pb2 as messages

PROTOCOL_VERSION = 1
PATIENCE = 10_000  # [ms] with a silent server
HEARTBEAT = 1000, 2000  # [ms] between pings, and for the pong
TYPES = {
    messages.Array.FLOAT32: "<f4", messages.Array.FLOAT64: "<f8", messages.Array.INT32: "<i4",
    messages.Array.INT64: "<i8", messages.Array.UINT64: "<u8",
}


class Refused(Exception):
    """The server did not accept a message; the text is its reason."""


class Lost(Exception):
    """The server is silent or gone."""


class Ended(Exception):
    """The run is over; `end` says why (messages.proto, End)."""

    def __init__(self, end):
        super().__init__(f"{messages.End.Reason.Name(end.reason)} {end.detail}".strip())
        self.end = end


class Clock:
    """Times of the steps [ns]: whole, and the same in every process. Every `steps_per_output` steps there is an output."""

    def __init__(self, welcome):
        self.steps, self.steps_per_output = welcome.steps, welcome.steps_per_interval
        self._interval = welcome.interval_ns

    def time_ns(self, step):
        whole, part = divmod(step, self.steps_per_output)
        return whole * self._interval + part * self._interval // self.steps_per_output

    def time(self, step):
        """End of a step [s]."""
        return 1e-9 * self.time_ns(step)

    def duration(self, step):
        """[s]"""
        return 1e-9 * (self.time_ns(step) - self.time_ns(step - 1))


def publish_address(endpoint):
    """Where a server publishes whose exchange address is `endpoint`."""
    if endpoint.startswith("ipc://"):
        return endpoint + ".publish"
    host, _, port = endpoint.rpartition(":")
    if not endpoint.startswith("tcp://") or not port.isdigit():
        raise ValueError(f"endpoint {endpoint!r} is none; give ipc://PATH or tcp://HOST:PORT")
    return f"{host}:{int(port) + 1}"


def _key(path, kind):
    for line in path.read_text().splitlines():
        if line.startswith(kind + " "):
            return line.split()[1].encode()
    raise ValueError(f"{path} has no line \"{kind} KEY\"")


def secure(socket, directory):
    """Encrypts a socket with the keys of `sluice keygen`: client.secret and server.public in a directory."""
    directory = Path(directory)
    socket.curve_publickey = _key(directory / "client.secret", "public")
    socket.curve_secretkey = _key(directory / "client.secret", "secret")
    socket.curve_serverkey = _key(directory / "server.public", "public")


def make_socket(context, kind, keys):
    socket = context.socket(kind)
    socket.linger = 1000
    socket.heartbeat_ivl, socket.heartbeat_timeout = HEARTBEAT
    if keys:
        secure(socket, keys)
    return socket


def arrays_of(header, frames):
    """The raw frames behind a header, by name."""
    return {a.name: np.frombuffer(raw, TYPES[a.type]).reshape(a.shape) for a, raw in zip(header.array, frames)}


class Link:
    """A DEALER socket that says Hello; `welcome` is the answer (messages.proto), `arrays` what came with it."""

    def __init__(self, context, endpoint, hello, keys=None):
        publish_address(endpoint)
        self.socket = make_socket(context, zmq.DEALER, keys)
        self.socket.connect(endpoint)
        self._endpoint, self._run_id, self._token = endpoint, "", 0
        self.send(messages.Header(hello=hello))
        answer, self.arrays = self.receive()
        self._run_id, self._token = answer.run_id, answer.session_token
        self.welcome = answer.welcome

    def send(self, header, *arrays):
        header.protocol_version = PROTOCOL_VERSION
        header.run_id, header.session_token = self._run_id, self._token
        self.socket.send_multipart([header.SerializeToString(), *arrays])

    def receive(self):
        """The next message that is no heartbeat: header and arrays. Raises Ended, Refused or Lost instead."""
        while True:
            if not self.socket.poll(PATIENCE):
                raise Lost(f"no message from the server at {self._endpoint} for {PATIENCE // 1000} s; is it running?")
            first, *frames = self.socket.recv_multipart()
            header = messages.Header.FromString(first)
            content = header.WhichOneof("content")
            if content == "refusal":
                raise Refused(header.refusal.reason)
            if content == "end":
                raise Ended(header.end)
            if content != "heartbeat":
                return header, arrays_of(header, frames)
