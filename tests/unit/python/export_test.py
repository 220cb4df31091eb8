"""What is exported is what was recorded: VTK files are read back from their bytes, tables from their text."""

import shutil
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

import numpy as np
from sluice import export
from written import Case, rows_of

TYPES = {"Float64": "<f8", "Int64": "<i8", "Int32": "<i4", "Float32": "<f4"}


def read_vtp(path):
    """Arrays of a .vtp file by section and name, and the numbers of its piece."""
    head, _, rest = path.read_bytes().partition(b'<AppendedData encoding="raw">\n_')
    data, _, tail = rest.rpartition(b"\n</AppendedData>")
    assert tail == b"\n</VTKFile>\n"
    piece = ElementTree.fromstring(head.decode() + "</VTKFile>").find("PolyData/Piece")
    arrays = {}
    for section in piece:
        for array in section:
            start = int(array.get("offset"))
            size = int(np.frombuffer(data, "<u8", 1, start)[0])
            values = np.frombuffer(data[start + 8 : start + 8 + size], TYPES[array.get("type")])
            components = int(array.get("NumberOfComponents"))
            arrays[section.tag, array.get("Name")] = values.reshape(-1, components) if components > 1 else values
    return arrays, {name: int(value) for name, value in piece.attrib.items()}


class VtkTest(Case):
    def exported(self, *words):
        code, out, err = self.call(export, self.path, "--to", "vtk", self.directory / "vtk", *words)
        self.assertEqual(code, 0, err)
        return out

    def test_particles_have_their_places_and_fields(self):
        self.exported()
        arrays, counts = read_vtp(self.directory / "vtk/fluid_00003.vtp")
        self.assertEqual(counts["NumberOfPoints"], 20)
        self.assertEqual(counts["NumberOfVerts"], 20)
        np.testing.assert_array_equal(arrays["Points", "Points"], self.values.position[3])
        for name in ("velocity", "density", "pressure"):
            np.testing.assert_array_equal(arrays["PointData", name], getattr(self.values, name)[3])
        np.testing.assert_array_equal(arrays["PointData", "particle"], np.arange(20))
        np.testing.assert_array_equal(arrays["Verts", "connectivity"], np.arange(20))
        np.testing.assert_array_equal(arrays["Verts", "offsets"], np.arange(1, 21))

    def test_bodies_stand_where_they_were(self):
        self.exported()
        arrays, counts = read_vtp(self.directory / "vtk/bodies_00002.vtp")
        self.assertEqual((counts["NumberOfPolys"], counts["NumberOfPoints"]), (1, 4))
        corners = arrays["Points", "Points"]
        np.testing.assert_allclose(corners.mean(axis=0), [0.5, 0.2 + 0.2, 0], atol=1e-15)
        np.testing.assert_allclose(np.ptp(corners, axis=0), [0.1, 0.4, 0])
        np.testing.assert_array_equal(arrays["CellData", "velocity"], [[0, 1, 0]])

    def test_collections_name_the_files_and_their_times(self):
        self.exported("--every", "2")
        for name in ("fluid", "bodies"):
            steps = ElementTree.parse(self.directory / f"vtk/{name}.pvd").findall("Collection/DataSet")
            self.assertEqual([float(step.get("timestep")) for step in steps], [0.0, 0.2, 0.4])
            for step in steps:
                self.assertTrue((self.directory / "vtk" / step.get("file")).is_file())

    def test_fields_and_times_can_be_chosen(self):
        out = self.exported("--times", "0.31", "--field", "speed")
        self.assertEqual(len(out.splitlines()), 3)
        self.assertEqual([p.name for p in sorted((self.directory / "vtk").glob("fluid*"))], ["fluid.pvd", "fluid_00003.vtp"])
        arrays, _ = read_vtp(self.directory / "vtk/fluid_00003.vtp")
        names = {name for section, name in arrays if section == "PointData"}
        self.assertEqual(names, {"speed", "particle"})

    def test_the_tank_is_a_box_of_lines(self):
        self.exported()
        arrays, counts = read_vtp(self.directory / "vtk/tank.vtp")
        self.assertEqual(counts["NumberOfLines"], 4)
        ends = arrays["Points", "Points"][arrays["Lines", "connectivity"].reshape(-1, 2)]
        np.testing.assert_array_equal(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1), np.ones(4))


PARAVIEW = """
from paraview.simple import OpenDataFile
reader = OpenDataFile({path!r})
reader.UpdatePipeline({time})
print(len(reader.TimestepValues), reader.GetDataInformation().GetNumberOfPoints(), sorted(reader.PointData.keys()))
"""


@unittest.skipUnless(shutil.which("pvpython"), "ParaView is not installed")
class ParaViewTest(Case):
    def test_opens_the_series(self):
        self.call(export, self.path, "--to", "vtk", self.directory)
        script = self.directory / "open.py"
        script.write_text(PARAVIEW.format(path=str(self.directory / "fluid.pvd"), time=0.5))
        done = subprocess.run(["pvpython", "--force-offscreen-rendering", str(script)], capture_output=True, text=True)
        self.assertIn("6 20 ['density', 'particle', 'pressure', 'velocity']", done.stdout, done.stderr)


class CsvTest(Case):
    def test_tables_have_every_digit(self):
        code, _, err = self.call(export, self.path, "--to", "csv", self.directory / "csv", "--times", "0.1")
        self.assertEqual(code, 0, err)
        rows = rows_of(self.directory / "csv/particles_00001.csv")
        np.testing.assert_array_equal([float(row["density [kg/m³]"]) for row in rows], self.values.density[1])
        np.testing.assert_array_equal([float(row["velocity_y [m/s]"]) for row in rows], self.values.velocity[1, :, 1])
        self.assertNotIn("velocity_z [m/s]", rows[0])
        body = rows_of(self.directory / "csv/body_gate.csv")
        np.testing.assert_array_equal([float(row["force_x [N]"]) for row in body], self.values.wrenches[:, 0, 0])

    def test_frames_have_energies_and_probes(self):
        self.call(export, self.path, "--to", "csv", self.directory / "csv")
        rows = rows_of(self.directory / "csv/frames.csv")
        np.testing.assert_array_equal([float(row["floor pressure [Pa]"]) for row in rows], self.values.probe[:, 0, 0])
        np.testing.assert_array_equal([float(row["kinetic energy [J]"]) for row in rows], self.values.energy["kinetic"])
        heights = np.array([float(row["level height [m]"]) for row in rows])
        np.testing.assert_array_equal(np.isnan(heights), [True, False] * 3)


class BadInputTest(Case):
    def test_is_named(self):
        there = self.directory / "there"
        there.write_text("a file")
        self.expect_error(export, [self.path, "--to", "vtk", there], f"{there} is a file")
        self.expect_error(export, [self.path, "--to", "xls", "x"], "invalid choice: 'xls'")
        to_csv = [self.path, "--to", "csv", self.directory / "x"]
        self.expect_error(export, [*to_csv, "--field", "hue"], "no field 'hue'")
        self.expect_error(export, [*to_csv, "--times", "9"], "time 9 s is not in")
        self.expect_error(export, [*to_csv, "--every", "0"], "not a whole number from 1")
        self.assertFalse((self.directory / "x").exists())
