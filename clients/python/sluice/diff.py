"""How far two recordings are apart, field by field and time by time.

python3 -m sluice.diff A.h5 B.h5 [--field NAME,...] [--from T] [--until T] [--every N] [--tolerance R] [--csv FILE] [--all]

Particles are matched by their identity, bodies and probes by name, frames by time.
"""

import csv
import sys
from dataclasses import dataclass

import numpy as np

from sluice.command import BAD_INPUT, DONE, Parser, add_frames, chosen_frames, number, run, words
from sluice.probes import COLUMNS
from sluice.recording import ENERGIES, FIELDS, Recording, RecordingError

PARTICLES = "particles"  # that one recording has and the other has not, where their number varies
SAME_TIME = 1  # two frames are of one time up to this [ns]
HEADINGS = ("time_s", "field", "unit", "max", "l2", "relative", "at")
BODY = {"body position": np.s_[0:3], "body velocity": np.s_[7:10], "body angular velocity": np.s_[10:13]}
BODY_UNITS = {"body position": "m", "body velocity": "m/s", "body angular velocity": "rad/s"}


@dataclass
class Norms:
    """Of the difference d of one field at one time, over n rows, each a number or a vector.

    max = max_i |d_i|, l2 = sqrt(sum_i |d_i|^2 / n), relative = l2 / sqrt(sum_i |a_i|^2 / n) with a the field in A;
    where a is zero everywhere it is 0 if d is too, infinite else. Of energies and probes, one number at a time, a is that
    of the whole run: a force that is zero at one time is not infinitely wrong there. `at` is the row with the maximum.
    """

    maximum: float
    l2: float
    relative: float
    at: int


def norms(a, b, size=None):
    """Norms of b - a, arrays [n] or [n, k], relative to `size`, by default that of a. What is NaN in both is equal; in one of them alone, infinitely apart."""
    a, b = (np.asarray(x, dtype=float).reshape(len(x), -1) for x in (a, b))
    gap = np.linalg.norm(np.where(np.isnan(a) & np.isnan(b), 0.0, b - a), axis=1)
    gap = np.where(np.isnan(gap), np.inf, gap)
    if size is None:
        size = np.sqrt(np.mean(np.nansum(a * a, axis=1)))
    l2 = np.sqrt(np.mean(gap * gap))
    relative = 0.0 if l2 == 0 else l2 / size if size > 0 else np.inf
    return Norms(float(gap.max()), float(l2), float(relative), int(gap.argmax()))


def scene_differences(a, b, path=""):
    """Where two scenes differ, as texts like `spacing: 0.004, 0.002`."""
    if isinstance(a, dict) and isinstance(b, dict):
        parts = [scene_differences(a.get(key), b.get(key), f"{path}.{key}".strip(".")) for key in sorted({*a, *b})]
    elif isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        parts = [scene_differences(x, y, f"{path}[{i}]") for i, (x, y) in enumerate(zip(a, b))]
    else:
        return [] if a == b else [f"{path}: {_brief(a)}, {_brief(b)}"]
    return [text for part in parts for text in part]


def _brief(value):
    text = "absent" if value is None else str(value)
    return text if len(text) <= 40 else text[:37] + "..."


class Quantity:
    """Something that both recordings have, with a value at every frame."""

    def __init__(self, name, unit, read, labels=None, size=None):
        self.name, self.unit, self.read, self.labels, self.size = name, unit, read, labels, size

    @property
    def is_of_particles(self):
        return self.name in FIELDS or self.name == PARTICLES

    def place(self, at):
        """What the row is, for people."""
        return self.labels[at] if self.labels else f"particle {at}" if self.name in FIELDS else ""

    def has(self, run_, frame):
        return not self.is_of_particles or frame in run_.particle_frames

    def compare(self, a, i, b, j):
        """The Norms at one time, or None where there is nothing of it; `at` is then a particle's identity."""
        if not self.is_of_particles or not (a.varies or b.varies):
            return norms(self.read(a, i), self.read(b, j), self.size)
        ids = a.ids(i), b.ids(j)
        both, *rows = np.intersect1d(*ids, assume_unique=True, return_indices=True)
        if self.name == PARTICLES:
            alone = len(ids[0]) + len(ids[1]) - 2 * len(both)
            return Norms(float(alone), float(alone), alone / max(len(ids[0]), 1), 0)
        if not len(both):
            return None
        result = norms(self.read(a, i)[rows[0]], self.read(b, j)[rows[1]])
        result.at = int(both[result.at])
        return result


def particle_quantities(a, b):
    names = [name for name in a.fields if name in b.fields]
    result = [Quantity(name, FIELDS[name], lambda r, frame, name=name: r.field(name, frame)) for name in names]
    return result + ([Quantity(PARTICLES, "", None)] if a.varies or b.varies else [])


def body_quantities(a):
    def column(slices):
        return lambda run_, frame: run_.body_kinematics(frame)[:, slices]

    result = [Quantity(name, BODY_UNITS[name], column(slices), a.bodies) for name, slices in BODY.items()]
    result.append(Quantity("body force", "N", lambda r, frame: r.body_wrench(frame)[:, :3], a.bodies))
    result.append(Quantity("body moment", "N m", lambda r, frame: r.body_wrench(frame)[:, 3:], a.bodies))
    return result if a.bodies else []


def series_quantities(a, b):
    """Energies and probes, read once."""
    cache = {}

    def at(run_, key, read):
        if (run_.path, key) not in cache:
            cache[run_.path, key] = read(run_)
        return cache[run_.path, key]

    def series(name, unit, key, read):
        values = at(a, key, read)
        size = float(np.sqrt(np.mean(np.nan_to_num(values) ** 2))) if len(values) else 0.0
        return Quantity(name, unit, lambda r, frame: at(r, key, read)[frame : frame + 1], size=size)

    result = [series(f"energy {name}", "J", name, lambda r, n=name: r.energy(n)) for name in ENERGIES]
    for name in (name for name in a.probes if name in b.probes):
        kind = a.probe_kind(name)
        if b.probe_kind(name) != kind:
            raise RecordingError(f"probe {name!r} is a {kind} probe in {a.path}, a {b.probe_kind(name)} probe in {b.path}")
        for column, unit in COLUMNS[kind].items():
            read = lambda r, n=name, c=column: r.probe(n)[c]
            result.append(series(f"probe {name} {column}", unit, (name, column), read))
    return result


def require_same(what, a, b, of_a, of_b, hint):
    if of_a != of_b:
        raise RecordingError(f"{a.path} has {what} {of_a}, {b.path} {of_b}; {hint}")


def quantities(a, b, wanted):
    """What is compared: all that the recordings have in common, or what is wanted by (the beginning of) its name."""
    require_same("the dimension", a, b, a.dimension, b.dimension, "such runs cannot be compared")
    per_particle = particle_quantities(a, b)
    everything = per_particle + body_quantities(a) + series_quantities(a, b)
    chosen = everything
    if wanted:
        for name in wanted:
            if not any(q.name == name or q.name.startswith(name + " ") for q in everything):
                known = ", ".join(q.name for q in everything)
                raise RecordingError(f"both recordings have no field {name!r}; choose from {known}")
        chosen = [q for q in everything if any(q.name == w or q.name.startswith(w + " ") for w in wanted)]
    if any(q in per_particle for q in chosen) and not (a.varies or b.varies):
        others = "compare --field energy or --field probe, which need no particles"
        require_same("a number of particles of", a, b, a.particles, b.particles, others)
    if any(q.name.startswith("body ") for q in chosen):
        require_same("the bodies", a, b, a.bodies, b.bodies, "name others with --field")
    return chosen


def common_frames(a, b, options):
    """Pairs of frames of one time."""
    pairs = []
    for frame in chosen_frames(a, options, range(a.frames)):
        near = int(np.searchsorted(b.time_ns, a.time_ns[frame] - SAME_TIME)) if b.frames else 0
        if near < b.frames and abs(int(b.time_ns[near]) - int(a.time_ns[frame])) <= SAME_TIME:
            pairs.append((frame, near))
    if not pairs:
        raise RecordingError(
            f"{a.path} and {b.path} have no time in common: {a.span_text()}, {b.span_text()}; "
            "record both with the same output.rate"
        )
    return pairs


def compare(a, b, options):
    """Rows (time, quantity, Norms), by time and then by quantity."""
    chosen = quantities(a, b, options.field)
    pairs = common_frames(a, b, options)
    rows = [
        (float(a.times[i]), q, q.compare(a, i, b, j)) for i, j in pairs for q in chosen if q.has(a, i) and q.has(b, j)
    ]
    rows = [row for row in rows if row[2] is not None]
    if not rows:
        raise RecordingError(f"{a.path} and {b.path} have no particles at a common time; compare --field energy or --field probe")
    return rows


def write_csv(rows, path):
    with open(path, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(HEADINGS)
        for time, q, n in rows:
            table.writerow([repr(time), q.name, q.unit, repr(n.maximum), repr(n.l2), repr(n.relative), q.place(n.at)])


def line(time, q, n):
    measured = f"{n.maximum:<12.4g} {n.l2:<12.4g} {n.relative:<11.3g}"
    return f"{time:<11.6g} {q.name:<28} {measured} {q.unit:<7} {q.place(n.at)}".rstrip()


def print_table(rows, everything):
    """Of every quantity the time at which it is the farthest apart, or all of them."""
    print(f"{'time [s]':<11} {'field':<28} {'max':<12} {'L2':<12} {'relative':<11} {'unit':<7} max at")
    if not everything:
        worst = {}
        for row in rows:
            if row[1] not in worst or row[2].l2 > worst[row[1]][2].l2:
                worst[row[1]] = row
        rows = worst.values()
    for row in rows:
        print(line(*row))


def arguments(argv):
    parser = Parser(
        prog="sluice diff",
        description="Say how far two recordings are apart: of every field the time of the largest difference.",
        epilog="max: largest difference of a particle, body or probe; L2: root of the mean square; relative: L2 over that "
        "of the field in A, of energies and probes over the whole run. Exit code 0: nothing differs by more than the tolerance; 1: something does, or the recordings "
        "cannot be compared.",
    )
    parser.add_argument("a", metavar="A.h5")
    parser.add_argument("b", metavar="B.h5")
    parser.add_argument(
        "--field", type=words, metavar="NAME,...",
        help="only these: position, velocity, density, pressure, body, energy, probe, 'probe NAME' ...",
    )
    add_frames(parser)
    parser.add_argument("--tolerance", type=number, default=0.0, metavar="R", help="allowed relative difference; 0")
    parser.add_argument("--all", action="store_true", help="print every field at every time")
    parser.add_argument("--csv", metavar="FILE", help="every field at every time, a line each")
    return parser.parse_args(argv)


def summary(rows, a, b, tolerance):
    """The last line, and whether the recordings are within the tolerance."""
    times = len({row[0] for row in rows})
    counted = f"{times} common times of {a.frames} and {b.frames}"
    if all(n.maximum == 0 for _, _, n in rows):
        return f"identical at {counted}", True
    beyond = [row for row in rows if not row[2].relative <= tolerance]
    if not beyond:
        return f"within {tolerance:g} at {counted}", True
    time, q, n = beyond[0]
    found = f"first at t = {time:g} s in {q.name}: relative {n.relative:.3g}, allowed {tolerance:g}"
    return f"differ at {counted}, {found}", False


def main(argv):
    options = arguments(argv)
    if not options.tolerance >= 0:
        raise RecordingError(f"--tolerance {options.tolerance:g} is negative; give 0 or more")
    with Recording(options.a) as a, Recording(options.b) as b:
        rows = compare(a, b, options)
        differences = scene_differences(a.scene, b.scene)
        if differences:
            print("scenes differ in " + "; ".join(differences[:8]) + ("; ..." if len(differences) > 8 else ""))
        print_table(rows, options.all)
        text, is_within = summary(rows, a, b, options.tolerance)
        print(text)
    if options.csv:
        write_csv(rows, options.csv)
    return DONE if is_within else BAD_INPUT


if __name__ == "__main__":
    sys.exit(run("diff", main, sys.argv[1:]))
