"""Draws the mould at the times of the paper's pictures: plot_filling.py RESULT.csv PICTURE.png"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

TO_MM = 1000 / 10  # the scene is ten times as large
MOULD, CORE, GATE = 70, 22.5, 11.25  # radii and half width [mm]


def draw_walls(axes):
    end = np.pi - np.arcsin(GATE / MOULD)
    angle = np.linspace(-end, end, 200)
    axes.plot(MOULD * np.cos(angle), MOULD * np.sin(angle), "k", linewidth=0.8)
    axes.add_patch(plt.Circle((0, 0), CORE, color="0.75"))


def main(result, picture):
    t, x, y, speed = np.loadtxt(result, delimiter=",", comments="#").T
    times = np.unique(t)
    # Particles as large as their spacing: as many at the last time as fill what has come in.
    area = (18 * (times[-1] + 353.4 / 180) + 11.25) * 22.5
    spacing = np.sqrt(area / np.count_nonzero(t == times[-1]))
    figure, panels = plt.subplots(2, 2, figsize=(8, 8), layout="constrained", sharex=True, sharey=True)
    for axes, time in zip(panels.flat, times):
        now = t == time
        draw_walls(axes)
        points = 72 * 3.4 / 145 * spacing  # a panel is about 3.4 inches for 145 mm
        place = TO_MM * x[now], TO_MM * y[now]
        drawn = axes.scatter(*place, c=speed[now], s=points**2, linewidths=0, vmin=0, vmax=25)
        axes.set(title=f"{time:.2f} ms", aspect="equal", xlim=(-73, 73), ylim=(-73, 73))
    figure.colorbar(drawn, ax=panels, label="speed [m/s]", shrink=0.6)
    figure.supxlabel("x [mm]")
    figure.supylabel("y [mm]")
    figure.savefig(picture, dpi=100, pil_kwargs={"optimize": True})


if __name__ == "__main__":
    main(*sys.argv[1:])
