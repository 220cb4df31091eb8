"""A recording for other programs: VTK files for ParaView, tables for spreadsheets.

python3 -m sluice.export RUN.h5 --to vtk|csv DIR [--times T,... | --from T --until T --every N] [--field NAME,...]
"""

import csv
import sys
from pathlib import Path

import numpy as np

from sluice import shapes, solids, vtk
from sluice.command import DONE, Parser, add_frames, chosen_frames, numbers, run, words
from sluice.probes import COLUMNS
from sluice.recording import ENERGIES, Recording, RecordingError

KINEMATICS = (
    [f"position_{a} [m]" for a in "xyz"] + [f"orientation_{a}" for a in "wxyz"] + [f"velocity_{a} [m/s]" for a in "xyz"]
    + [f"angular_velocity_{a} [rad/s]" for a in "xyz"] + [f"acceleration_{a} [m/s2]" for a in "xyz"]
    + [f"angular_acceleration_{a} [rad/s2]" for a in "xyz"]
)
WRENCH = [f"force_{a} [N]" for a in "xyz"] + [f"moment_{a} [N m]" for a in "xyz"]


def body_polygons(run_, frame):
    """All bodies where they stand at a frame: outlines in two dimensions, triangles in three; with their velocities."""
    placed, connectivity, sizes, owner = [], [], [], []
    start = 0
    kinematics = run_.body_kinematics(frame)
    for b, (body, row) in enumerate(zip(run_.scene.get("body", []), kinematics)):
        if run_.dimension == 3:
            vertices, cells = solids.placed(body, row)
            parts = [(vertices, cells)]
        else:
            parts = [(np.column_stack([o, np.zeros(len(o))]), np.arange(len(o))[None]) for o in shapes.placed(body, row)]
        for vertices, cells in parts:
            placed.append(vertices)
            connectivity.append((cells + start).ravel())
            sizes += [cells.shape[1]] * len(cells)
            owner += [b] * len(cells)
            start += len(vertices)
    owner = np.array(owner)
    data = {"body": owner, "velocity": kinematics[owner, 7:10], "angular velocity": kinematics[owner, 10:13]}
    data["force"] = run_.body_wrench(frame)[owner, :3]
    return vtk.PolyData(np.vstack(placed), "Polys", np.concatenate(connectivity), np.array(sizes), cell_data=data)


def tank(scene):
    """The tank's edges as lines."""
    lower, upper = (np.append(corner, [0.0] * (3 - len(corner))) for corner in shapes.domain(scene))
    corners = np.array([[(lower, upper)[i >> a & 1][a] for a in range(3)] for i in range(8 if lower[2] < upper[2] else 4)])
    edges = [(i, i | 1 << a) for i in range(len(corners)) for a in range(3) if not i >> a & 1 and i | 1 << a < len(corners)]
    return vtk.PolyData(corners, "Lines", np.ravel(edges), np.full(len(edges), 2))


def write_vtk(run_, frames, fields, directory):
    """fluid.pvd and bodies.pvd with a file a frame, tank.vtp; their paths."""
    series = {"fluid": lambda frame: vtk.points(run_.field("position", frame), particle_data(run_, frame, fields))}
    if run_.bodies:
        series["bodies"] = lambda frame: body_polygons(run_, frame)
    written = []
    for name, make in series.items():
        entries = []
        for frame in frames:
            file = f"{name}_{frame:05d}.vtp"
            vtk.write(directory / file, make(frame))
            entries.append((float(run_.times[frame]), file))
        vtk.write_collection(directory / f"{name}.pvd", entries)
        written.append(directory / f"{name}.pvd")
    vtk.write(directory / "tank.vtp", tank(run_.scene))
    return [*written, directory / "tank.vtp"]


def particle_data(run_, frame, fields):
    data = {name: run_.field(name, frame) for name in fields if name != "position"}
    return {**data, "particle": run_.ids(frame)}


def write_table(path, headings, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(headings)
        table.writerows([repr(value) if isinstance(value, float) else value for value in row] for row in rows)
    return path


def particle_table(run_, frame, fields):
    """Headings and an array [particles, columns] of one frame."""
    headings, columns = [], []
    for name in fields:
        values, unit = run_.field(name, frame), run_.unit(name)
        axes = "xyz"[: run_.dimension] if values.ndim == 2 else ""
        headings += [f"{name}_{a} [{unit}]" for a in axes] or [f"{name} [{unit}]"]
        columns += [values[:, "xyz".index(a)] for a in axes] or [values]
    return headings, np.column_stack(columns)


def frame_table(run_, frames):
    """Energies and probes: headings and rows, one a frame."""
    headings = ["time [s]"] + [f"{name} energy [J]" for name in ENERGIES]
    columns = [run_.times] + [run_.energy(name) for name in ENERGIES]
    for name in run_.probes:
        for column, unit in COLUMNS[run_.probe_kind(name)].items():
            headings.append(f"{name} {column} [{unit}]")
        columns += list(run_.probe(name).values())
    return headings, np.column_stack(columns)[frames]


def body_tables(run_):
    """Motion and force of every body at every step: (name, headings, rows)."""
    time, kinematics, wrenches = run_.exchange()
    for b, name in enumerate(run_.bodies):
        yield name, ["time [s]", *KINEMATICS, *WRENCH], np.column_stack([time, kinematics[:, b], wrenches[:, b]])


def write_csv(run_, frames, fields, directory, outputs):
    """particles_N.csv a frame, frames.csv (energies, probes; a row of every output), a table a body; paths of the first
    of each."""
    for frame in frames:
        headings, values = particle_table(run_, frame, fields)
        rows = ((i, *row) for i, row in zip(run_.ids(frame).tolist(), values.tolist()))
        write_table(directory / f"particles_{frame:05d}.csv", ["particle", *headings], rows)
    headings, values = frame_table(run_, outputs)
    written = [directory / f"particles_{frames[0]:05d}.csv"]
    written.append(write_table(directory / "frames.csv", headings, values.tolist()))
    if run_.bodies:
        for name, headings, values in body_tables(run_):
            written.append(write_table(directory / f"body_{name}.csv", headings, values.tolist()))
    return written


def arguments(argv):
    parser = Parser(prog="sluice export", description="Write a recording for other programs.")
    parser.add_argument("recording", metavar="RUN.h5")
    parser.add_argument("--to", choices=("vtk", "csv"), required=True, dest="format", help="vtk: ParaView; csv: tables")
    parser.add_argument("directory", metavar="DIR", help="made if it is not there; files of the same names are replaced")
    parser.add_argument("--times", type=numbers, metavar="T,...", help="the frames nearest to these times [s] only")
    parser.add_argument("--field", type=words, metavar="NAME,...", help="these only: velocity, density, pressure, speed ...")
    add_frames(parser)
    return parser.parse_args(argv)


def main(argv):
    options = arguments(argv)
    directory = Path(options.directory)
    with Recording(options.recording) as run_:
        frames = sorted({run_.frame_at(t) for t in options.times}) if options.times else chosen_frames(run_, options)
        fields = ["position"] + [f for f in options.field or run_.fields if f != "position"]
        for name in fields:
            run_.field(name, frames[0])
        if directory.exists() and not directory.is_dir():
            raise RecordingError(f"{directory} is a file; name a directory")
        directory.mkdir(parents=True, exist_ok=True)
        if options.format == "vtk":
            written = write_vtk(run_, frames, fields, directory)
        else:
            outputs = frames if options.times else chosen_frames(run_, options, range(run_.frames))
            written = write_csv(run_, frames, fields, directory, outputs)
    for path in written:
        print(path)
    return DONE


if __name__ == "__main__":
    sys.exit(run("export", main, sys.argv[1:]))
