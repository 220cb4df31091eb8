"""What the commands of the package have in common: arguments, errors in one line, exit codes."""

import argparse
import os
import subprocess
import sys

import numpy as np

from sluice.recording import RecordingError

DONE, BAD_INPUT, FAILED = 0, 1, 2


class Parser(argparse.ArgumentParser):
    """Bad arguments are bad input: one line, exit code 1."""

    def error(self, message):
        raise RecordingError(f"{message} (see --help)")


def run(name, action, argv):
    """Calls action(argv), which returns the exit code; tells what is wrong as `[sluice-NAME] ...`."""
    try:
        return action(argv)
    except RecordingError as error:
        problem = error
    except KeyboardInterrupt:
        return FAILED
    except BrokenPipeError:
        # The reader of our output has had enough; Python must not complain of it when it closes stdout.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE
    except (OSError, ValueError, KeyError) as error:
        problem = f"cannot read or write: {error}"
    except subprocess.CalledProcessError as error:
        print(f"[sluice-{name}] {error.cmd[0]} failed with exit code {error.returncode}", file=sys.stderr)
        return FAILED
    print(f"[sluice-{name}] {problem}", file=sys.stderr)
    return BAD_INPUT


def numbers(text):
    """A list of numbers as an argument: 0.012,0.036."""
    try:
        return [float(part) for part in text.split(",") if part.strip()]
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a list of numbers such as 0.012,0.036") from None


def words(text):
    return [part.strip() for part in text.split(",") if part.strip()]


def positive(text):
    """A whole number from 1."""
    if not text.isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 1")
    return int(text)


def limits(text):
    """LOW,HIGH"""
    values = numbers(text)
    if len(values) != 2 or not values[0] < values[1]:
        raise argparse.ArgumentTypeError(f"{text!r} is not a lower and a higher number such as 0,2.5")
    return tuple(values)


def scale(text):
    value = number(text)
    if not 0.1 <= value <= 4:
        raise argparse.ArgumentTypeError(f"{text} is not from 0.1 to 4")
    return value


def number(text):
    try:
        value = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number") from None
    if not np.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text} is not finite")
    return value


def add_picture(parser):
    """What a picture shows and how, of plot and movie."""
    fields = "speed (default, where velocities are recorded), pressure, density, velocity_x, velocity_y ..."
    parser.add_argument("--field", metavar="NAME", help=fields)
    parser.add_argument("--range", type=limits, metavar="LOW,HIGH", help="of the colours; from the frames by default")
    parser.add_argument("--particles", action="store_true", help="draw each particle as a disc, do not interpolate")
    views = ("xy", "xz", "yz", "yx", "zx", "zy")
    parser.add_argument("--view", choices=views, help="3D: axes to the right and up; from the side by default")
    cut = "3D: cut at this place [m] of the axis that is looked along"
    parser.add_argument("--slice", type=number, metavar="PLACE", help=cut)


def add_frames(parser):
    """--from, --until and --every: which frames a command goes through."""
    parser.add_argument("--from", type=number, dest="first", metavar="T", help="leave out what is before this time [s]")
    parser.add_argument("--until", type=number, dest="last", metavar="T", help="leave out what is after this time [s]")
    parser.add_argument("--every", type=positive, default=1, metavar="N", help="each Nth frame only")


def chosen_frames(run_, options, among=None):
    """The frames that the arguments of add_frames choose, at least one: of those that hold particles, or `among` some."""
    among = run_.particle_frames if among is None else np.asarray(among, dtype=int)
    first = -np.inf if options.first is None else options.first
    last = np.inf if options.last is None else options.last
    margin = 1e-9
    times = run_.times[among]
    inside = among[(times >= first - margin) & (times <= last + margin)]
    if not len(inside):
        raise RecordingError(f"{run_.path} has no frame from {first:g} to {last:g} s; {run_.span_text()}")
    return [int(frame) for frame in inside[:: options.every]]
