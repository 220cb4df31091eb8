"""Draws the front of the dam break over the experiments: plot_front.py RESULT.csv PICTURE.png"""
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

EXPERIMENTS = {
    "martin_moyce_1952_n2eq2_a1.125in": "Martin & Moyce 1952, a = 1.125 in",
    "martin_moyce_1952_n2eq2_a2.25in": "Martin & Moyce 1952, a = 2.25 in",
    "koshizuka_oka_1996_exp": "Koshizuka & Oka 1996",
}


def draw_experiments(axes, **style):
    folder = pathlib.Path(__file__).parent
    for marker, (name, label) in zip("os^", EXPERIMENTS.items()):
        T, Z = np.loadtxt(folder / f"{name}.csv", delimiter=",", comments="#", usecols=(0, 1)).T
        axes.plot(T, Z, marker, label=label, **style)


def main(result, picture):
    figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
    draw_experiments(axes)
    T, Z = np.loadtxt(result, delimiter=",", comments="#", usecols=(0, 1)).T
    axes.plot(T, Z, "k-", label="sluice, a/dx = 40")
    axes.set(xlabel=r"$t\,\sqrt{2g/a}$", ylabel=r"$x_\mathrm{front}/a$", xlim=(0, 4.5), ylim=(1, 5.6),
             title="Dam break, column a wide and 2a high")
    axes.legend()
    figure.savefig(picture, dpi=150)


if __name__ == "__main__":
    main(*sys.argv[1:])
