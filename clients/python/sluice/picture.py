"""Pictures of the liquid, coloured by a field, with bodies and walls."""

from dataclasses import dataclass, replace

import numpy as np

from sluice import raster, shapes
from sluice import view as views
from sluice.drawing import (
    Figure, LinearSegmentedColormap, ListedColormap, Normalize, PolyCollection, Rectangle, ScalarMappable, matplotlib,
)
from sluice.recording import RecordingError

DPI = 150
WIDTH = 7.2  # of what is drawn, without margins [inch]
LEFT, RIGHT, TOP, BOTTOM, GAP = 0.75, 1.15, 0.4, 0.55, 0.35  # margins [inch]; GAP between pictures, for a title
LEAST_ASPECT, MOST_ASPECT = 0.12, 1.6  # height over width of a picture
SIGNED = "RdBu_r"  # velocity_x ...: zero is the middle
BODY = np.array([0.80, 0.79, 0.77])


@dataclass
class Style:
    """What is drawn how."""

    field: str = "speed"
    limits: tuple = None  # of the colours; found from the frames unless given
    as_particles: bool = False
    front: bool = False
    liquids: tuple = ()  # their names, where the field is liquid

    def bar_label(self, unit):
        return self.field.replace("_", " ") + (f" [{unit}]" if unit else "")


def first_field(run):
    """What a picture shows unless asked otherwise: which of several liquids, the speed, or what is recorded instead."""
    shown = {"liquid": "liquid", "velocity": "speed", "pressure": "pressure", "density": "density"}
    return next((field for recorded, field in shown.items() if recorded in run.fields), f"position_{'xyz'[run.dimension - 1]}")


def color_map(style):
    field = style.field
    if field == "liquid":
        # Blue, orange ...: told apart without seeing colours, by brightness, as far as there are few.
        return ListedColormap(matplotlib.colormaps["tab10"].colors[: len(style.liquids)])
    if field == "speed":
        # Dark blue to pale yellow; white itself is where no liquid is.
        return LinearSegmentedColormap.from_list("speed", matplotlib.colormaps["YlGnBu_r"](np.linspace(0.08, 0.88, 256)))
    maps = {"pressure": "plasma", "density": "cividis"}
    return matplotlib.colormaps["viridis" if field.startswith("position_") else maps.get(field, SIGNED)]


def color_range(samples, field):
    """Limits for all pictures, without the extreme 0.2 % at either end, which are single particles of spray.

    Returns them and which ends of the colour bar stand for more than they say.
    """
    values = np.concatenate(list(samples))
    values = values[np.isfinite(values)]
    low, high = np.percentile(values, [0.2, 99.8]) if len(values) else (0.0, 1.0)
    if field.startswith("velocity_"):
        high = max(abs(low), abs(high), 1e-12)
        low = -high
    elif field == "speed":
        low = 0.0
    if high <= low:
        high = low + max(abs(low), 1.0) * 1e-9
    return (low, high), extension(values, low, high)


def extension(values, low, high):
    below, above = np.any(values < low), np.any(values > high)
    return "both" if below and above else "min" if below else "max" if above else "neither"


def visible(run, view, frames):
    """Lower and upper corner of what is drawn: the tank, less the air that nothing ever enters, and what has left it."""
    lower, upper = views.wide_limits(run, view)
    tops = []
    for frame in frames:
        x = run.field("position", frame)[:, view.axes[1]]
        tops += [np.nanmax(x)] if len(x) else []
        polygons = views.body_polygons(run, view, run.body_kinematics(frame))
        tops += [polygon[:, 1].max() for polygon, _ in polygons]
    height = upper[1] - lower[1]
    top = max(tops, default=upper[1]) + 0.06 * height
    top = np.clip(top, lower[1] + 0.1 * height, max(upper[1], min(top, upper[1] + height)))
    margin = min(1.5 * run.spacing, 0.015 * (upper - lower).max())
    return lower - margin, np.array([upper[0], top]) + margin


def time_text(run, time):
    """With as many decimals as tell neighbouring frames apart."""
    interval = run.times[1] - run.times[0] if run.frames > 1 else 0.001
    decimals = next((d for d in range(1, 9) if abs(round(interval, d) - interval) <= 0.01 * interval), 9)
    return f"t = {time:.{decimals}f} s"


def inside_of_walls(run, view, corners, axes):
    """What liquid can be seen in: the corners' box, cut at closed walls, beyond which the last particles' discs reach."""
    lower, upper = (corner[list(view.axes)] for corner in shapes.enclosure(run.scene))
    lower, upper = np.maximum(corners[0], lower), np.minimum(corners[1], upper)
    return Rectangle(lower, *(upper - lower), transform=axes.transData)


class Panel:
    """One picture in a figure; show() draws a frame in it, again and again for a movie."""

    def __init__(self, axes, run, view, corners, style, norm, pixels):
        self.axes, self.run, self.view, self.style, self.norm = axes, run, view, style, norm
        self.colors = color_map(style)
        self.grid = raster.make_grid(*corners, run.spacing, pixels)
        empty = np.zeros((self.grid.height, self.grid.width, 4), np.uint8)
        self.image = axes.imshow(empty, extent=self.grid.extent, origin="lower", interpolation="bilinear", zorder=1)
        self.image.set_clip_path(inside_of_walls(run, view, corners, axes))
        self.bodies = PolyCollection([], zorder=4, linewidths=0.8 if run.dimension == 2 else 0.4)
        axes.add_collection(self.bodies)
        for line in shapes.walls(run.scene, view.axes):
            axes.plot(*np.minimum(line, corners[1]).T, color="0.45", linewidth=1.4, zorder=3, solid_capstyle="round")
        self.front = None
        axes.set_xlim(corners[0][0], corners[1][0])
        axes.set_ylim(corners[0][1], corners[1][1])
        axes.tick_params(labelsize=8, color="0.55")
        for side in axes.spines.values():
            side.set_visible(False)

    def show(self, frame, title):
        values, opacity, brightness = self._liquid(frame)
        rgba = self.colors(self.norm(np.nan_to_num(values)), bytes=True)
        if brightness is not None:
            rgba[..., :3] = rgba[..., :3] * brightness[..., None] + 0.5
        rgba[..., 3] = 255 * opacity + 0.5
        self.image.set_data(rgba)
        self._show_bodies(frame)
        if self.style.front:
            self._show_front(frame)
        self.axes.set_title(title, fontsize=10)

    def _liquid(self, frame):
        run, view = self.run, self.view
        x, values = run.field("position", frame), run.field(self.style.field, frame)
        seen = np.isfinite(x).all(axis=1) & np.isfinite(values)
        volumes = depth = None
        if view.slice is not None:
            # A layer as thick as the kernel is wide; a particle's part in it falls off to either side.
            away = np.abs(x[:, view.depth_axis] - view.slice) / (raster.SUPPORT * run.spacing)
            seen &= away < 1
            volumes = (1.25 / raster.SUPPORT * (1 - away) ** 3 * (1 + 3 * away))[seen]
        elif run.dimension == 3:
            depth = view.depth(x[seen])
        places = x[seen][:, list(view.axes)]
        if depth is not None or self.style.as_particles or self.style.liquids:
            return raster.discs(self.grid, places, values[seen], run.spacing, depth)
        walls = (corner[list(view.axes)] for corner in shapes.enclosure(run.scene))
        places, values, origin = raster.mirrored(places, values[seen], *walls, raster.SUPPORT * run.spacing)
        return raster.interpolate(self.grid, places, values, run.spacing, None if volumes is None else volumes[origin])

    def _show_bodies(self, frame):
        polygons = views.body_polygons(self.run, self.view, self.run.body_kinematics(frame))
        self.bodies.set_verts([polygon for polygon, _ in polygons])
        faces = np.array([brightness * BODY for _, brightness in polygons]).reshape(-1, 3)
        self.bodies.set_facecolor(faces)
        self.bodies.set_edgecolor("0.2" if self.run.dimension == 2 else faces)

    def _show_front(self, frame):
        """The foremost particle."""
        if self.front:
            for artist in self.front:
                artist.remove()
        front = np.nanmax(self.run.field("position", frame)[:, self.view.axes[0]])
        is_left = front > np.mean(self.axes.get_xlim())
        text = self.axes.annotate(
            f"{self.view.labels()[0]} = {front:.4g} m", (front, self.axes.get_ylim()[1]), xytext=(-3 if is_left else 3, -3),
            textcoords="offset points", ha="right" if is_left else "left", va="top", fontsize=8, color="crimson",
        )
        self.front = (self.axes.axvline(front, color="crimson", linewidth=0.9, linestyle="--", zorder=5), text)


def grid_shape(count, aspect):
    """Columns and rows, for pictures `aspect` times as high as wide."""
    columns = 1 if aspect < 0.3 else 2 if aspect < 1.2 else 3
    columns = min(columns, count)
    return columns, -(-count // columns)


class Sheet:
    """A figure of one picture or several of the same size, with one colour bar."""

    def __init__(self, count, corners, title=""):
        size = corners[1] - corners[0]
        aspect = float(np.clip(size[1] / size[0], LEAST_ASPECT, MOST_ASPECT))
        self.columns, self.rows = grid_shape(count, aspect)
        between = 0.55
        self.width = (WIDTH - between * (self.columns - 1)) / self.columns
        if self.columns == 1 and aspect > 0.8:
            self.width *= 0.8 / aspect
        self.height = aspect * self.width
        top = TOP + (0.3 if title else 0)
        inches = np.array([
            LEFT + self.columns * self.width + between * (self.columns - 1) + RIGHT,
            BOTTOM + self.rows * self.height + GAP * (self.rows - 1) + top,
        ])
        self.figure = Figure(figsize=inches, dpi=DPI)
        if title:
            self.figure.suptitle(title, fontsize=11, y=1 - 0.12 / inches[1], va="top")
        self.inches, self.between, self.top = inches, between, top

    def axes(self, number):
        row, column = divmod(number, self.columns)
        x = LEFT + column * (self.width + self.between)
        y = self.inches[1] - self.top - (row + 1) * self.height - row * GAP
        box = np.array([x, y, self.width, self.height]) / np.tile(self.inches, 2)
        return self.figure.add_axes(box, aspect="equal", anchor="SW")

    def bar(self, norm, style, unit, extend):
        x = (self.inches[0] - RIGHT + 0.15) / self.inches[0]
        y = BOTTOM / self.inches[1]
        axes = self.figure.add_axes([x, y, 0.14 / self.inches[0], 1 - y - self.top / self.inches[1]])
        bar = self.figure.colorbar(ScalarMappable(norm, color_map(style)), cax=axes, extend=extend)
        bar.set_label(style.bar_label(unit), fontsize=9)
        if style.liquids:
            bar.set_ticks(range(len(style.liquids)), labels=style.liquids)
        bar.ax.tick_params(labelsize=8)
        bar.outline.set_visible(False)


def draw(shots, view_of, style, title="", sampled=None):
    """A sheet with a panel for every (run, frame, title) of `shots`, and its panels.

    `view_of` gives the view of a run. `sampled`, pairs of run and frame, are what colours and limits are found from; those
    of the shots unless given.
    """
    sampled = sampled or [(run, frame) for run, frame, _ in shots]
    if not any(run.particles for run, _ in sampled):
        raise RecordingError(f"{shots[0][0].path} has no particles to draw")
    seen = [visible(run, view_of(run), [frame]) for run, frame in sampled]
    corners = np.min([low for low, _ in seen], axis=0), np.max([high for _, high in seen], axis=0)
    samples = [run.field(style.field, frame) for run, frame in sampled]
    if style.field == "liquid":
        style = replace(style, liquids=max((tuple(run.liquids) for run, _ in sampled), key=len))
        style.limits = -0.5, len(style.liquids) - 0.5
    limits, extend = color_range(samples, style.field)
    if style.limits:
        limits, extend = style.limits, extension(np.concatenate(samples), *style.limits)
    norm = Normalize(*limits)
    sheet = Sheet(len(shots), corners, title)
    panels = []
    for number, (run, frame, text) in enumerate(shots):
        axes = sheet.axes(number)
        panel = Panel(axes, run, view_of(run), corners, style, norm, round(DPI * max(sheet.width, sheet.height)))
        panel.show(frame, text)
        right, up = view_of(run).labels()
        if number + sheet.columns >= len(shots):
            axes.set_xlabel(f"{right} [m]", fontsize=9)
        else:
            axes.tick_params(labelbottom=False)
        if number % sheet.columns == 0:
            axes.set_ylabel(f"{up} [m]", fontsize=9)
        else:
            axes.tick_params(labelleft=False)
        panels.append(panel)
    sheet.bar(norm, style, shots[0][0].unit(style.field), extend)
    return sheet, panels
