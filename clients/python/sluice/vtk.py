"""Files that ParaView opens: VTK's XML PolyData (.vtp) with raw data appended, and collections of them over time (.pvd).

The format is that of "VTK File Formats", Kitware, for VTK 4.2 and later: a block is its length in bytes as UInt64, then its
values, little-endian, at the offset that its DataArray names, counted from behind the underscore.
"""

from dataclasses import dataclass, field
from xml.sax.saxutils import quoteattr

import numpy as np

TYPES = {"f8": "Float64", "f4": "Float32", "i8": "Int64", "i4": "Int32"}


@dataclass
class PolyData:
    """Points [n, 3] and what lies on them: cells are rows of points' numbers, as many as `sizes` says for each cell."""

    points: np.ndarray
    kind: str = "Verts"  # Verts, Lines or Polys
    connectivity: np.ndarray = field(default_factory=lambda: np.empty(0, int))
    sizes: np.ndarray = field(default_factory=lambda: np.empty(0, int))
    point_data: dict = field(default_factory=dict)  # name -> [n] or [n, 3]
    cell_data: dict = field(default_factory=dict)  # name -> [cells] or [cells, 3]


def points(positions, data):
    """Particles: a vertex each."""
    n = len(positions)
    return PolyData(positions, "Verts", np.arange(n), np.ones(n, int), point_data=data)


class _Blocks:
    """The appended data; add() gives the DataArray that stands for it."""

    def __init__(self):
        self.parts, self.offset = [], 0

    def add(self, name, values):
        values = np.ascontiguousarray(values)
        code = values.dtype.str[1:]
        if code not in TYPES:
            values, code = values.astype("<i8"), "i8"
        values = values.astype("<" + code, copy=False)
        components = values.shape[1] if values.ndim == 2 else 1
        element = (
            f'<DataArray type="{TYPES[code]}" Name={quoteattr(name)} NumberOfComponents="{components}" '
            f'format="appended" offset="{self.offset}"/>\n'
        )
        self.parts += [np.uint64(values.nbytes).tobytes(), values.tobytes()]
        self.offset += 8 + values.nbytes
        return element


def _section(tag, arrays, blocks):
    return f"<{tag}>\n" + "".join(blocks.add(name, values) for name, values in arrays.items()) + f"</{tag}>\n"


def write(path, data):
    """One PolyData as a .vtp file."""
    blocks = _Blocks()
    cells = {"connectivity": data.connectivity.astype("<i8"), "offsets": np.cumsum(data.sizes).astype("<i8")}
    body = _section("Points", {"Points": data.points.astype("<f8")}, blocks)
    body += _section(data.kind, cells, blocks)
    body += _section("PointData", data.point_data, blocks) + _section("CellData", data.cell_data, blocks)
    counts = {kind: len(data.sizes) if kind == data.kind else 0 for kind in ("Verts", "Lines", "Strips", "Polys")}
    numbers = " ".join(f'NumberOf{kind}="{count}"' for kind, count in counts.items())
    head = (
        '<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
        f'<PolyData>\n<Piece NumberOfPoints="{len(data.points)}" {numbers}>\n{body}</Piece>\n</PolyData>\n'
        '<AppendedData encoding="raw">\n_'
    )
    with open(path, "wb") as file:
        file.write(head.encode())
        file.writelines(blocks.parts)
        file.write(b"\n</AppendedData>\n</VTKFile>\n")


def write_collection(path, entries):
    """A .pvd file: (time [s], file name) of every step."""
    steps = "".join(f'<DataSet timestep="{time!r}" group="" part="0" file={quoteattr(name)}/>\n' for time, name in entries)
    with open(path, "w", encoding="utf-8") as file:
        file.write('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n')
        file.write(f"<Collection>\n{steps}</Collection>\n</VTKFile>\n")
