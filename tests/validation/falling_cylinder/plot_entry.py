"""Depth of a falling cylinder over experiment and boundary elements.

python3 plot_entry.py REFERENCE.csv COMPUTED_500.csv COMPUTED_1000.csv OUT.png
Computed: t sqrt(g/D), depth over D. The reference's T is read as t sqrt(g/D), see tests/README.md.
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def rows(path):
    with open(path) as file:
        return [line.strip().split(",") for line in file if line[0] not in "#d"]


def main(reference, computed_500, computed_1000, out):
    figure, panels = plt.subplots(1, 2, figsize=(9, 4), sharey=True)
    for panel, density, path in zip(panels, ("500", "1000"), (computed_500, computed_1000)):
        for source, style in (("bem", "k-"), ("experiment", "ko")):
            points = sorted((float(t), float(y)) for d, s, t, y in rows(reference) if (d, s) == (density, source))
            panel.plot(*zip(*points), style, label="boundary elements" if source == "bem" else source, mfc="none")
        panel.plot(*zip(*((float(t), float(y)) for t, y in rows(path))), "r--", label="sluice, D/40")
        panel.set(title=f"{density} kg/m³", xlabel="t √(g/D)", xlim=(0, 1.2), ylim=(0, 2))
        panel.legend()
    panels[0].set_ylabel("depth / D")
    figure.tight_layout()
    figure.savefig(out, dpi=110)


main(*sys.argv[1:])
