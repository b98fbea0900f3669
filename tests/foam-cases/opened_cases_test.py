"""Opens the folders of a smoke bake as other programs do: foamlib reads and runs a case, VTK's reader, which is
ParaView's, its fields. Each is skipped where its package is not installed.

    python3 tests/foam-cases/opened_cases_test.py FOLDER_OF_PROGRAMS
"""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SHAPE = Path(__file__).resolve().parents[2] / "meshes/shapes/sphere.geo"


class OpenedCases(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        subprocess.run([Path(PROGRAMS).resolve() / "samara-bake", SHAPE, "-o", "ball.body.h5", "--quality", "smoke"], cwd=FOLDER, check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        cls.case = Path(FOLDER) / "ball.cases/direction_00_coarse"

    def test_every_case_and_mesh_has_the_file_that_paraview_opens(self):
        for folder in (self.case, self.case.parent / "mesh_coarse"):
            self.assertEqual((folder / "case.foam").read_bytes(), b"")

    def test_foamlib_reads_dictionaries_and_fields(self):
        try:
            import foamlib
        except ImportError:
            self.skipTest("foamlib is not installed")
        case = foamlib.FoamCase(self.case)
        last = case[-1]
        cells = last["p"].internal_field.shape[0]
        self.assertEqual(last["U"].internal_field.shape, (cells, 3))
        self.assertGreater(cells, 1000)
        self.assertEqual(set(last["U"].boundary_field.keys()), {"far", "body"})
        self.assertEqual(case.decompose_par_dict["numberOfSubdomains"], 1)
        self.assertEqual(case.fv_solution["solvers"]["p"]["solver"], "GAMG")
        # What stands as $name in a dictionary is in the file parameters.
        parameters = case.file("parameters")
        for file, key in ((case.control_dict, "application"), (case.transport_properties, "nu")):
            self.assertTrue(file[key].startswith("$"))
            self.assertIn(file[key][1:], parameters)
        self.assertEqual(parameters["solver"], "simpleFoam")
        self.assertAlmostEqual(parameters["viscosity"] * parameters["reynoldsNumber"], 1.0)

    def test_foamlib_runs_a_copy(self):
        try:
            import foamlib
        except ImportError:
            self.skipTest("foamlib is not installed")
        copy = Path(FOLDER) / "copy"
        subprocess.run(["cp", "-rL", self.case, copy], check=True)
        subprocess.run(["./Allclean"], cwd=copy, check=True)
        foamlib.FoamCase(copy).run()
        self.assertTrue((copy / "rounds.json").exists())
        last = foamlib.FoamCase(copy)[-1]
        self.assertEqual(last["U"].path.read_bytes(), (self.case / last.name / "U").read_bytes())

    def test_paraviews_reader_reads_the_fields(self):
        try:
            import vtk
        except ImportError:
            self.skipTest("VTK is not installed")
        reader = vtk.vtkPOpenFOAMReader() if hasattr(vtk, "vtkPOpenFOAMReader") else vtk.vtkOpenFOAMReader()
        reader.SetFileName(str(self.case / "case.foam"))
        reader.UpdateInformation()
        times = reader.GetTimeValues()
        reader.SetTimeValue(times.GetValue(times.GetNumberOfTuples() - 1))
        reader.EnableAllCellArrays()
        reader.Update()
        flow = reader.GetOutput().GetBlock(0)
        self.assertGreater(flow.GetNumberOfCells(), 1000)
        self.assertGreater(flow.GetCellData().GetArray("U").GetRange(-1)[1], 1.0)


if __name__ == "__main__":
    PROGRAMS = sys.argv.pop(1)
    with tempfile.TemporaryDirectory() as FOLDER:
        os.environ.setdefault("SAMARA_CACHE", "off")
        unittest.main(argv=sys.argv)
