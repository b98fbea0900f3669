"""Tests samara.datasets, where xarray is installed. Run by ctest."""

import math
import os
import sys
import tempfile
import unittest

import numpy as np

import samara

try:
    import xarray as xr
except ImportError:
    print("xarray is not installed")
    sys.exit(77)

from samara import datasets  # noqa: E402

BODIES = os.path.join(os.path.dirname(__file__), "../../../runtime/bodies")


class OfAReadyBakedEllipsoid(unittest.TestCase):
    def setUp(self):
        self.body = samara.Body.read(os.path.join(BODIES, "ellipsoid.body.h5"))
        self.data = datasets.dataset(self.body, rho=998.2)

    def test_added_mass_is_the_tensor_in_capytaines_layout(self):
        added = self.data.added_mass
        self.assertEqual(added.dims, ("omega", "influenced_dof", "radiating_dof"))
        self.assertEqual(added.omega.values.tolist(), [math.inf])
        tensor = self.body.kirchhoff_tensor
        for place, dof in enumerate(("Roll", "Pitch", "Yaw", "Surge", "Sway", "Heave")):
            self.assertAlmostEqual(float(added.sel(omega=math.inf, influenced_dof=dof, radiating_dof=dof)),
                                   998.2 * tensor[place, place])
        np.testing.assert_allclose(self.data.rotation_center, self.body.centroid)

    def test_tables_are_those_that_the_body_looks_up(self):
        directions = self.data.direction_of_motion.values
        self.assertEqual(len(directions), len(np.unique(directions.round(9), axis=0)))
        for number in self.data.reynolds_number.values:
            for place in (0, 7, len(directions) - 1):
                force, moment = self.body.loads(directions[place], number)
                entry = self.data.sel(reynolds_number=number).isel(direction=place)
                np.testing.assert_allclose(entry.force, force, atol=1e-9)
                np.testing.assert_allclose(entry.moment, moment, atol=1e-9)
        self.assertEqual(self.data.force.attrs["units"], "rho U^2 A / 2")

    def test_netcdf_holds_all(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "ellipsoid.nc")
            try:
                self.data.to_netcdf(file)
            except ValueError as error:
                self.skipTest(str(error))  # neither netCDF4 nor h5netcdf nor SciPy
            with xr.open_dataset(file) as read:
                xr.testing.assert_equal(read.load(), self.data)
                self.assertEqual(read.moment.attrs["units"], "rho U^2 A L / 2")


if __name__ == "__main__":
    unittest.main()
