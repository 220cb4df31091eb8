"""How far something is: a bar on a terminal, nothing elsewhere."""

import shutil
import sys

WIDTH = 40


def bar_text(fraction, width=WIDTH):
    """[=====>    ]"""
    filled = int(min(max(fraction, 0.0), 1.0) * width)
    return "[" + ("=" * filled + ">")[:width].ljust(width) + "]"


class Bar:
    """A line on stderr that is written again and again."""

    def __init__(self, stream=None):
        self._stream = stream or sys.stderr
        self._is_terminal = self._stream.isatty()

    def show(self, fraction, text):
        if not self._is_terminal:
            return
        line = f"{bar_text(fraction)} {text}"
        self._stream.write("\r" + line[: shutil.get_terminal_size().columns - 1] + "\033[K")
        self._stream.flush()

    def clear(self):
        if self._is_terminal:
            self._stream.write("\r\033[K")
            self._stream.flush()
