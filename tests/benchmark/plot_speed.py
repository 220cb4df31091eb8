"""Draws particle steps a second over the number of particles, and the stages' shares: plot_speed.py PICTURE < speed.csv"""

import csv
import sys

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt

STAGES = ("search", "boundary", "gradients", "forces", "reactions", "passes")


def draw_rates(axes, rows):
    """A line a case and number of threads."""
    for key in dict.fromkeys((row["scene"], row["threads"]) for row in rows):
        line = [row for row in rows if (row["scene"], row["threads"]) == key]
        particles, rates = ([float(row[column]) for row in line] for column in ("particles", "rate"))
        axes.loglog(particles, rates, "o-", label="{}, {} thread(s)".format(key[0].replace("_", " "), key[1]))
    axes.set(xlabel="fluid particles", ylabel="particle steps a second")
    axes.grid(which="both", alpha=0.3)
    axes.legend(fontsize="small")


def draw_stages(axes, rows):
    """A bar a row."""
    labels = ["{} {:g}, {}".format(row["scene"].replace("_", " "), float(row["particles"]), row["threads"]) for row in rows]
    left = [0.0] * len(rows)
    for stage in STAGES:
        shares = [100 * float(row[stage]) for row in rows]
        axes.barh(range(len(rows)), shares, left=left, label=stage)
        left = [a + b for a, b in zip(left, shares)]
    axes.set(xlabel="share of a step [%]", xlim=(0, 100))
    axes.set_yticks(range(len(rows)), labels, fontsize="small")
    axes.invert_yaxis()
    axes.legend(fontsize="small", ncols=len(STAGES), loc="lower center", bbox_to_anchor=(0.5, 1.0))


def main(picture):
    rows = list(csv.DictReader(sys.stdin))
    figure, (left, right) = plt.subplots(1, 2, figsize=(14, 3 + 0.25 * len(rows)), layout="constrained")
    draw_rates(left, rows)
    draw_stages(right, rows)
    figure.savefig(picture, dpi=120)


if __name__ == "__main__":
    main(*sys.argv[1:])
