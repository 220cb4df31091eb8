"""Drops a cylinder of several densities into water, several at a time, and draws how deep each goes.

    python3 sweep_density.py PICTURE.png [--spacing DX] [--until T]
"""

import argparse
from pathlib import Path

import sluice
from matplotlib.figure import Figure

SCENE = Path(__file__).resolve().parent.parent / "scenes" / "falling_cylinder.scene"
DENSITIES = [300.0, 500.0, 800.0]  # [kg/m^3]


def depth(recording):
    """Where the cylinder is at the end and at its deepest, and its way over time."""
    time, kinematics, _ = recording.exchange()
    height = kinematics[:, 0, 1]
    return {"deepest [m]": float(height.min()), "at the end [m]": float(height[-1]), "curve": (time, height)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("picture", metavar="PICTURE.png")
    parser.add_argument("--spacing", type=float, default=0.011)
    parser.add_argument("--until", type=float, default=0.5)
    options = parser.parse_args()
    table = sluice.sweep(
        SCENE, {"spacing": [options.spacing], "body[0].density": DENSITIES}, measure=depth, until=options.until, at_once=2
    )
    figure = Figure(figsize=(7, 4), layout="constrained")
    axes = figure.subplots()
    for row in table:
        axes.plot(*row.pop("curve"), label=f"{row['body[0].density']:g} kg/m³")
    axes.set_xlabel("t [s]")
    axes.set_ylabel("height of the centre [m]")
    axes.grid(color="0.9")
    axes.legend(frameon=False)
    figure.savefig(options.picture, dpi=150)
    print(sluice.table_text(table))


if __name__ == "__main__":
    main()
