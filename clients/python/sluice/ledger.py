"""What acted on a body over a run, from the exchanges: impulses, work, and what is left of Newton's third law.

The sums are those of `sluice inspect` (clients/recording/ledger.cpp), kept for every step. World frame, moments about the
centre of mass, per metre of depth in two dimensions.
"""

from dataclasses import dataclass, field

import numpy as np

GRAVITY = "gravity"
# Where the impulses of what acts on a body besides liquid and gravity begin in a row of its ledger. Before format 3 a row ended
# with the mass, and what joints gave was under contact.
CAUSES = {"contact": 6, "joints": 15, "drive and locks": 22}


@dataclass
class Ledger:
    """Of one body. All arrays have an entry for each of `time` [s]."""

    name: str
    time: np.ndarray
    impulses: dict = field(default_factory=dict)  # name -> [n, 6]: force [N s], moment [N m s], since the start
    work: np.ndarray = None  # of the liquid on the body since the start [J]
    momentum: np.ndarray = None  # of a free body: its change since the start [n, 3], kg m/s
    residual: np.ndarray = None  # of a free body: |change of momentum - all impulses| over the liquid's impulse


def exchange_begins(run, steps):
    """Which of the steps 1 ... are the first of an exchange: [steps] of bool."""
    most = int(run.scene.get("coupling", {}).get("steps_per_exchange", 1))
    return np.arange(steps) % run.steps_per_interval % most == 0


def ledgers(run):
    """One for each body: of a free one with an entry for each exchange from where it is free, of others for each step."""
    time, kinematics, wrenches, parts, states = run.exchange("wrench_parts", "ledger")
    dt = np.diff(time, prepend=0.0)
    start = run.body_wrench(0), run.body_kinematics(0)
    begins = exchange_begins(run, len(time))
    return [
        _ledger(run, b, time, dt, kinematics[:, b], wrenches[:, b], parts[:, b], states[:, b], start[0][b], begins)
        for b in range(len(run.bodies))
    ]


def _mean(values, first):
    """Of every step from its values at the ends [n, k]."""
    return 0.5 * (np.concatenate([first[None], values[:-1]]) + values)


def _ledger(run, b, time, dt, kinematics, wrench, parts, states, first_wrench, begins):
    mean = _mean(wrench, first_wrench)
    mean_parts = _mean(parts, np.zeros(12))
    total, of_parts = (np.cumsum(dt[:, None] * values, axis=0) for values in (mean, mean_parts))
    viscous, penetration = of_parts[:, :6], of_parts[:, 6:]
    impulses = {"pressure": total - viscous - penetration, "viscous": viscous, "penetration": penetration}
    power = np.sum(mean * kinematics[:, 7:13], axis=1)
    work = np.cumsum(dt * power)
    given = np.cumsum(dt * np.linalg.norm(mean[:, :3], axis=1))
    ledger = Ledger(run.bodies[b], time, impulses, work)
    # What the body has at the beginning of an exchange is due to the steps before it. Where it is not free it has no mass.
    free = np.flatnonzero(begins & (states[:, 14] > 0))
    if len(free) < 2:
        return ledger
    first, at = free[0], free[1:]

    def since(values):
        return values[at - 1] - (values[first - 1] if first else 0)

    start = time[first - 1] if first else 0.0
    ledger.time, ledger.work = time[at - 1], since(work)
    ledger.impulses = {name: since(values) for name, values in impulses.items()}
    gravity = np.zeros(6)
    gravity[: run.dimension] = run.scene.get("gravity", [0.0] * run.dimension)
    ledger.impulses[GRAVITY] = states[at, 14, None] * gravity * (ledger.time - start)[:, None]
    for name, column in CAUSES.items():
        if column < states.shape[1]:
            ledger.impulses[name] = states[at, column : column + 6] - states[first, column : column + 6]
    ledger.momentum = states[at, 0:3] - states[first, 0:3]
    missing = ledger.momentum - sum(values[:, :3] for values in ledger.impulses.values())
    with np.errstate(invalid="ignore", divide="ignore"):
        ledger.residual = np.linalg.norm(missing, axis=1) / since(given)
    return ledger
