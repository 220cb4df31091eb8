"""Runs of sluice from Python: launch and sweep scenes, move their bodies, follow them, open and draw recordings.

What needs more than the standard library is imported when it is asked for, so that a participant needs no HDF5 and a
reader of recordings no ZeroMQ.
"""

from importlib import import_module

_HOMES = {
    "Recording": "recording", "RecordingError": "recording", "Participant": "participant", "Watcher": "watcher",
    "State": "watcher", "Status": "watcher", "run": "launch", "resume": "launch", "RunError": "launch",
    "sweep": "sweeps", "write_table": "sweeps", "table_text": "sweeps",
}
__all__ = list(_HOMES)


def __getattr__(name):
    if name not in _HOMES:
        raise AttributeError(f"module 'sluice' has no attribute {name!r}")
    return getattr(import_module(f"sluice.{_HOMES[name]}"), name)
