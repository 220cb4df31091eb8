"""Curves over time: bodies, energies, probes, ledgers; of several runs over each other."""

from dataclasses import dataclass

import numpy as np

from sluice.drawing import Figure
from sluice.ledger import ledgers
from sluice.probes import COLUMNS
from sluice.recording import RecordingError

WIDTH, LEGEND = 7.0, 2.0  # of the curves and beside them [inch]
STYLES = ("-", "--", ":", "-.")  # one a run
RESIDUAL, ROUND_OFF = "third-law residual [-]", 1e-17


@dataclass
class Curve:
    panel: str  # what the panel's axis says: quantity and unit
    label: str
    time: np.ndarray
    values: np.ndarray


def angle(quaternion):
    """Rotation about z [rad], without jumps."""
    w, x, y, z = np.moveaxis(quaternion, -1, 0)
    return np.unwrap(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)), axis=0)


def turned(quaternion):
    """Angle [rad] of the rotation since the first entry, 0 to pi."""
    return 2 * np.arccos(np.clip(np.abs(np.sum(quaternion * quaternion[:1], axis=-1)), 0, 1))


def _per_depth(run, unit):
    return unit if run.dimension == 3 else f"{unit}/m"


def body_curves(run):
    time, kinematics, wrenches = run.exchange()
    axes = "xyz"[: run.dimension]
    moved = kinematics[..., 0:3] - run.body_kinematics(0)[:, 0:3]
    vectors = [("displacement [m]", moved), ("velocity [m/s]", kinematics[..., 7:10])]
    curves = [
        Curve(panel, f"{name} {a}", time, values[:, b, k])
        for panel, values in vectors
        for b, name in enumerate(run.bodies)
        for k, a in enumerate(axes)
    ]
    turn, text = (angle, "angle [rad]") if run.dimension == 2 else (turned, "turned by [rad]")
    curves += [Curve(text, name, time, turn(kinematics[:, b, 3:7])) for b, name in enumerate(run.bodies)]
    force = f"fluid force [{_per_depth(run, 'N')}]"
    return curves + [
        Curve(force, f"{name} {a}", time, wrenches[:, b, k]) for b, name in enumerate(run.bodies) for k, a in enumerate(axes)
    ]


def energy_curves(run):
    kinetic, potential, elastic, work = (run.energy(n) for n in ("kinetic", "potential", "elastic", "boundary_work"))
    lost = kinetic + potential + elastic - work
    panel = f"energy of the fluid [{_per_depth(run, 'J')}]"
    values = {
        "kinetic": kinetic, "potential, change": potential - potential[0], "elastic, change": elastic - elastic[0],
        "work of boundaries": work, "total less work, change": lost - lost[0],
    }
    return [Curve(panel, name, run.times, series) for name, series in values.items()]


def probe_curves(run, names):
    """A panel for each quantity: pressures together, heights together ..."""
    if not run.probes:
        raise RecordingError(f"{run.path} has no probes; the scene needs `probe {{ ... }}`")
    curves = []
    for name in names or run.probes:
        kind = run.probe_kind(name)
        for column, values in run.probe(name).items():
            base, _, component = column.partition("_")
            if component == "z" and run.dimension == 2 and base != "moment" or base == "wetness":
                continue
            if base == "moment" and run.dimension == 2 and component != "z":
                continue
            unit = COLUMNS[kind][column]
            unit = _per_depth(run, unit) if kind == "force" else unit
            curves.append(Curve(f"{base} [{unit}]", f"{name} {component}".strip(), run.times, values))
    return curves


def ledger_curves(run):
    curves = []
    for ledger in ledgers(run):
        for k, a in enumerate("xyz"[: run.dimension]):
            panel = f"impulse, {a} [{_per_depth(run, 'N s')}]"
            for part, values in ledger.impulses.items():
                if np.any(values[:, k]):
                    curves.append(Curve(panel, f"{ledger.name}: {part}", ledger.time, values[:, k]))
            if ledger.momentum is not None:
                curves.append(Curve(panel, f"{ledger.name}: momentum, change", ledger.time, ledger.momentum[:, k]))
        curves.append(Curve(f"work of the liquid [{_per_depth(run, 'J')}]", ledger.name, ledger.time, ledger.work))
        if ledger.residual is not None:
            curves.append(Curve(RESIDUAL, ledger.name, ledger.time, ledger.residual))
    return curves


def draw(curves_of_runs, title):
    """A figure from pairs of a run's label and its curves, a panel for each quantity."""
    panels = list(dict.fromkeys(curve.panel for _, curves in curves_of_runs for curve in curves))
    if not panels:
        raise RecordingError("there is nothing to draw")
    names = list(dict.fromkeys((c.panel, c.label) for _, curves in curves_of_runs for c in curves))
    height = max(2.0, 4.2 if len(panels) == 1 else 2.0)
    figure = Figure(figsize=(WIDTH + LEGEND, len(panels) * height + 0.6), dpi=150, layout="constrained")
    grid = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
    for axes, panel in zip(grid, panels):
        order = [label for p, label in names if p == panel]
        for style, (run_label, curves) in zip(_styles(len(curves_of_runs)), curves_of_runs):
            for curve in (c for c in curves if c.panel == panel):
                label = f"{curve.label} ({run_label})" if run_label else curve.label
                color = f"C{order.index(curve.label) % 10}"
                axes.plot(curve.time, curve.values, style, color=color, linewidth=1.1, label=label)
        axes.set_ylabel(panel, fontsize=9)
        if panel == RESIDUAL:
            axes.set_yscale("log")
            axes.set_ylim(bottom=max(axes.get_ylim()[0], ROUND_OFF))
        axes.legend(fontsize=8, frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.0))
        tidy(axes)
    grid[-1].set_xlabel("t [s]", fontsize=9)
    figure.suptitle(title, fontsize=11)
    return figure


def _styles(count):
    return [STYLES[i % len(STYLES)] for i in range(count)]


def tidy(axes):
    axes.grid(color="0.9", linewidth=0.6)
    axes.tick_params(labelsize=8)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
