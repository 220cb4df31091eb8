"""Draws the wave as it breaks: plot_wave.py RESULT.csv PICTURE.png"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

LENGTH = 0.503632  # of the wave and the tank [m]
WIDTH = 9  # of the picture [inches]


def main(result, picture):
    t, x, y, speed = np.loadtxt(result, delimiter=",", comments="#").T
    times = np.unique(t)
    spacing = np.sqrt(0.7 * LENGTH**2 / np.count_nonzero(t == times[0]))
    figure, panels = plt.subplots(2, 2, figsize=(WIDTH, 3.6), layout="constrained", sharex=True, sharey=True)
    for axes, time in zip(panels.flat, times):
        now = t == time
        points = 1.2 * 72 * 0.39 * WIDTH / (2 * LENGTH) * spacing  # overlapping a little
        for shift in (0, LENGTH):  # the tank twice
            drawn = axes.scatter(x[now] % LENGTH + shift, y[now], c=speed[now], s=points**2, linewidths=0, vmin=0,
                                 vmax=1.6)
        axes.set(title=f"{time:.2f} s", aspect="equal", xlim=(0, 2 * LENGTH), ylim=(0.2, 0.45))
    figure.colorbar(drawn, ax=panels, label="speed [m/s]", shrink=0.6)
    figure.supxlabel("x [m]")
    figure.supylabel("y [m]")
    figure.savefig(picture, dpi=100, pil_kwargs={"optimize": True})


if __name__ == "__main__":
    main(*sys.argv[1:])
