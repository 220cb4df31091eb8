"""Recordings of sluice runs: open them as NumPy arrays, draw them."""

from sluice.recording import Recording, RecordingError

__all__ = ["Recording", "RecordingError"]
