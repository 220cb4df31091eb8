"""Pictures of a recording: particles coloured by a field, motion of the bodies, energies.

python3 -m sluice.plot RUN.h5 [-o OUT.png] [--time T | --frame N | --times T1,T2,...] [--field NAME]
                              [--front] [--bodies] [--energy]
"""

import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.patches import Polygon

from sluice import shapes
from sluice.recording import Recording, RecordingError

WIDTH = 8.0  # of a picture [inch]
DIAMETER = 1.4  # of a particle, in spacings: a lattice of them closes
MAPS = {"speed": "viridis", "pressure": "plasma", "density": "cividis"}
SIGNED = "RdBu_r"  # velocity_x ...: zero is the middle


def color_range(run, field, frames):
    """One range for all pictures, without the extreme 0.2 % at either end: single particles of spray.

    Returns the limits and which ends of the colour bar stand for more than they say.
    """
    values = np.concatenate([run.field(field, frame) for frame in frames])
    values = values[np.isfinite(values)]
    low, high = np.percentile(values, [0.2, 99.8])
    if field.startswith("velocity_"):
        high = max(abs(low), abs(high), 1e-12)
        low = -high
    elif field == "speed":
        low = 0.0
    if high <= low:
        high = low + max(abs(low), 1.0) * 1e-9
    below, above = values.min() < low, values.max() > high
    return (low, high), "both" if below and above else "min" if below else "max" if above else "neither"


def visible(run, frames):
    """Lower and upper corner of what is drawn: the tank, less the air that nothing ever enters."""
    lower, upper = shapes.domain(run.scene)
    tops = [np.nanmax(run.field("position_y", frame)) for frame in frames]
    for frame in frames:
        for body, row in zip(run.scene.get("body", []), run.body_kinematics(frame)):
            tops.append(shapes.placed(body, row)[:, 1].max())
    top = min(max(tops) + 0.06 * (upper[1] - lower[1]), max(upper[1], max(tops)))
    return lower, np.array([upper[0], top])


def draw_frame(axes, run, frame, field, limits, corners, front, title):
    x = run.field("position", frame)
    # In three dimensions the nearest particles are drawn last.
    order = np.argsort(-x[:, 2], kind="stable") if run.dimension == 3 else slice(None)
    size = np.full(len(x), DIAMETER * run.spacing)
    particles = EllipseCollection(
        size, size, np.zeros(len(x)), units="xy", offsets=x[order, :2], transOffset=axes.transData,
        cmap=MAPS.get(field, SIGNED), linewidths=0,
    )
    particles.set_array(run.field(field, frame)[order])
    particles.set_clim(*limits)
    axes.add_collection(particles)
    for line in shapes.walls(run.scene):
        axes.plot(*np.minimum(line, corners[1]).T, color="0.55", linewidth=1.2, zorder=3)
    for body, row in zip(run.scene.get("body", []), run.body_kinematics(frame)):
        axes.add_patch(Polygon(shapes.placed(body, row), facecolor="0.82", edgecolor="0.2", linewidth=0.8, zorder=4))
    if front:
        draw_front(axes, x, corners)
    lower, upper = corners
    margin = 1.5 * run.spacing
    axes.set_xlim(lower[0] - margin, upper[0] + margin)
    axes.set_ylim(lower[1] - margin, upper[1] + margin)
    axes.set_aspect("equal")
    axes.set_title(title, fontsize=10)
    for side in ("top", "right", "left", "bottom"):
        axes.spines[side].set_visible(False)
    axes.tick_params(labelsize=8, color="0.55")
    return particles


def draw_front(axes, x, corners):
    """The foremost particle."""
    front = x[:, 0].max()
    left = front > 0.5 * (corners[0][0] + corners[1][0])
    axes.axvline(front, color="crimson", linewidth=0.9, linestyle="--", zorder=5)
    axes.annotate(
        f"x = {front:.4g} m", (front, corners[1][1]), xytext=(-3 if left else 3, -3),
        textcoords="offset points", ha="right" if left else "left", va="top", fontsize=8, color="crimson",
    )


def grid_shape(count, aspect):
    """Columns and rows, for pictures `aspect` times as high as wide."""
    if count == 1:
        return 1, 1
    columns = 1 if aspect < 0.3 else 2 if aspect < 1.2 else 3
    columns = min(columns, count)
    return columns, -(-count // columns)


def plot_particles(run, frames, field, front):
    corners = visible(run, frames)
    size = corners[1] - corners[0]
    columns, rows = grid_shape(len(frames), size[1] / size[0])
    height = WIDTH / columns * np.clip(size[1] / size[0], 0.12, 2.0)
    figure, grid = plt.subplots(
        rows, columns, figsize=(WIDTH + 1.0, rows * (height + 0.35) + 0.5), squeeze=False, layout="constrained",
        sharex=True, sharey=True,
    )
    limits, extend = color_range(run, field, frames)
    name = run.scene.get("name", "")
    for axes, frame in zip(grid.flat, frames):
        time = f"t = {run.times[frame]:.4g} s"
        title = time if len(frames) > 1 else f"{name}, {time}"
        particles = draw_frame(axes, run, frame, field, limits, corners, front, title)
    for axes in grid.flat[len(frames):]:
        axes.set_visible(False)
    for axes in grid[-1]:
        axes.set_xlabel("x [m]", fontsize=9)
    for axes in grid[:, 0]:
        axes.set_ylabel("y [m]", fontsize=9)
    bar = figure.colorbar(particles, ax=grid, shrink=0.9, aspect=30, pad=0.02, extend=extend)
    bar.set_label(f"{field.replace('_', ' ')} [{run.unit(field)}]", fontsize=9)
    bar.ax.tick_params(labelsize=8)
    bar.outline.set_visible(False)
    if len(frames) > 1:
        figure.suptitle(name, fontsize=11)
    return figure


def angle(quaternion):
    """Rotation about z [rad], without jumps."""
    w, x, y, z = np.moveaxis(quaternion, -1, 0)
    return np.unwrap(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))


def plot_bodies(run):
    time, kinematics, wrenches = run.exchange()
    panels = [
        ("position [m]", [("x", kinematics[..., 0]), ("y", kinematics[..., 1])]),
        ("velocity [m/s]", [("x", kinematics[..., 7]), ("y", kinematics[..., 8])]),
        ("angle [rad]", [("", np.column_stack([angle(kinematics[:, b, 3:7]) for b in range(len(run.bodies))]))]),
        ("fluid force [N]" if run.dimension == 3 else "fluid force [N/m]", [("x", wrenches[..., 0]), ("y", wrenches[..., 1])]),
    ]
    figure, grid = plt.subplots(len(panels), 1, figsize=(WIDTH + 1.5, 8), sharex=True, layout="constrained")
    for axes, (label, curves) in zip(grid, panels):
        for component, values in curves:
            for b, name in enumerate(run.bodies):
                axes.plot(time, values[:, b], linewidth=1, label=f"{name} {component}".strip())
        axes.set_ylabel(label, fontsize=9)
        axes.legend(fontsize=8, frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.0))
        tidy(axes)
    grid[-1].set_xlabel("t [s]", fontsize=9)
    figure.suptitle(f"{run.scene.get('name', '')}: bodies", fontsize=11)
    return figure


def plot_energy(run):
    unit = "J" if run.dimension == 3 else "J/m"
    kinetic, potential, elastic, work = (run.energy(n) for n in ("kinetic", "potential", "elastic", "boundary_work"))
    lost = kinetic + potential + elastic - work
    figure, axes = plt.subplots(figsize=(WIDTH + 1.5, 4.5), layout="constrained")
    axes.plot(run.times, kinetic, label="kinetic")
    axes.plot(run.times, potential - potential[0], label="potential, change")
    axes.plot(run.times, elastic - elastic[0], label="elastic, change")
    axes.plot(run.times, work, label="work of boundaries")
    axes.plot(run.times, lost - lost[0], color="0.2", linestyle="--", label="total less work, change")
    axes.set_xlabel("t [s]", fontsize=9)
    axes.set_ylabel(f"energy [{unit}]", fontsize=9)
    axes.legend(fontsize=8, frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    tidy(axes)
    figure.suptitle(f"{run.scene.get('name', '')}: energy of the fluid", fontsize=11)
    return figure


def tidy(axes):
    axes.grid(color="0.9", linewidth=0.6)
    axes.tick_params(labelsize=8)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def parse_times(text):
    try:
        return [float(part) for part in text.split(",") if part.strip()]
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a list of times such as 0.012,0.036") from None


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise RecordingError(f"{message} (see --help)")


def arguments(argv):
    parser = Parser(prog="sluice plot", description="Draw a recording.")
    parser.add_argument("recording", help="RUN.h5")
    parser.add_argument("-o", "--output", help="PNG, PDF or SVG file; default: RUN.png")
    when = parser.add_mutually_exclusive_group()
    when.add_argument("--time", type=float, metavar="T", help="the frame nearest to a time [s]")
    when.add_argument("--frame", type=int, metavar="N", help="a frame from 0; negative from the end")
    when.add_argument("--times", type=parse_times, metavar="T1,T2,...", help="several times in one picture [s]")
    parser.add_argument("--field", default="speed", help="speed (default), pressure, density, velocity_x, velocity_y ...")
    parser.add_argument("--front", action="store_true", help="mark the foremost particle")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--bodies", action="store_true", help="motion of the bodies and forces on them over time")
    what.add_argument("--energy", action="store_true", help="energies over time")
    return parser.parse_args(argv)


def chosen_frames(run, options):
    if run.frames == 0:
        raise RecordingError(f"{run.path} holds no frame")
    if options.times is not None:
        return [run.frame_at(time) for time in options.times]
    if options.time is not None:
        return [run.frame_at(options.time)]
    frame = -1 if options.frame is None else options.frame
    return [range(run.frames)[frame] if -run.frames <= frame < run.frames else frame]


def draw(run, options):
    if options.bodies:
        return plot_bodies(run)
    if options.energy:
        return plot_energy(run)
    frames = chosen_frames(run, options)
    if not frames:
        raise RecordingError("--times names no time")
    return plot_particles(run, frames, options.field, options.front)


def main(argv=None):
    try:
        options = arguments(argv)
        output = Path(options.output) if options.output else Path(options.recording).with_suffix(".png")
        with Recording(options.recording) as run:
            figure = draw(run, options)
        figure.savefig(output, dpi=150)
    except RecordingError as error:
        print(f"[sluice-plot] {error}", file=sys.stderr)
        return 1
    except (OSError, ValueError) as error:
        print(f"[sluice-plot] cannot draw {options.recording}: {error}", file=sys.stderr)
        return 1
    print(output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
