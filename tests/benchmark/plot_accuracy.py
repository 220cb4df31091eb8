"""Draws error over run time, a panel a case, a line a formulation: plot_accuracy.py PICTURE < accuracy.csv"""

import csv
import sys

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt

COLUMNS = 3


def read_runs(stream):
    """{case: {formulation: {resolution: (seconds, error, on the Pareto front)}}}; the file has a line a figure."""
    cases = {}
    for row in csv.DictReader(stream):
        if row["error"]:
            lines = cases.setdefault(row["case"], {})
            point = float(row["seconds"]), float(row["error"]), row["on_front"] == "1"
            lines.setdefault(row["formulation"], {})[int(row["resolution"])] = point
    return cases


def draw_case(axes, name, lines):
    for formulation, runs in lines.items():
        seconds, errors, _ = zip(*runs.values())
        line, = axes.loglog(seconds, errors, "o-", label=formulation)
        for resolution, (x, y, on_front) in runs.items():
            axes.annotate(resolution, (x, y), textcoords="offset points", xytext=(4, 4), fontsize="x-small")
            if on_front:
                axes.plot(x, y, "o", markersize=11, fillstyle="none", color=line.get_color())
    axes.set(title=name.replace("_", " "), xlabel="run time [s]", ylabel="error")
    axes.grid(which="both", alpha=0.3)
    axes.legend(fontsize="small")


def main(picture):
    cases = read_runs(sys.stdin)
    if not cases:
        sys.exit("no run has an error to draw")
    columns = min(COLUMNS, len(cases))
    rows = -(-len(cases) // columns)
    figure, panels = plt.subplots(rows, columns, figsize=(5 * columns, 4 * rows), squeeze=False,
                                  layout="constrained")
    for axes in panels.flat[len(cases):]:
        axes.remove()
    for axes, (name, lines) in zip(panels.flat, cases.items()):
        draw_case(axes, name, lines)
    figure.suptitle("Error over run time; circles: no other run is both faster and more accurate")
    figure.savefig(picture, dpi=150)


if __name__ == "__main__":
    main(sys.argv[1])
