"""Draws both fronts over the experiments with one liquid: plot_fronts.py RESULT.csv PICTURE.png"""
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "dam_break"))
from plot_front import draw_experiments  # noqa: E402


def main(result, picture):
    figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
    draw_experiments(axes, markerfacecolor="none")
    T, light, heavy = np.loadtxt(result, delimiter=",", comments="#").T
    axes.plot(T, light, "-", color="tab:orange", label="light liquid")
    axes.plot(T, heavy, "--", color="tab:blue", label="heavy liquid")
    axes.set(xlabel=r"$t\,\sqrt{2g/a}$", ylabel=r"way of the front over $a$", xlim=(0, 4.5), ylim=(1, 5.6),
             title="Two columns of liquids of 2:1, each a wide and 2a high, until they meet")
    axes.legend()
    figure.savefig(picture, dpi=150)


if __name__ == "__main__":
    main(*sys.argv[1:])
