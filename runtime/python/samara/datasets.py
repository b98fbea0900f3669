"""Hands a body file's tensor and tables to xarray, and so to netCDF: `samara.datasets.dataset(body).to_netcdf("leaf.nc")`."""

from typing import Any

import numpy as np
import xarray as xr

from ._samara import Body

_DOFS = ["Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"]
_AXES = ["x", "y", "z"]


def _added_mass(body: Body, rho: float) -> xr.Dataset:
    # Capytaine has translations before rotations, samara angular velocity first.
    order = [3, 4, 5, 0, 1, 2]
    added_mass = rho * np.asarray(body.kirchhoff_tensor)[np.ix_(order, order)]
    return xr.Dataset(
        {"added_mass": (("omega", "influenced_dof", "radiating_dof"), added_mass[np.newaxis],
                        {"long_name": "Added mass", "units": "kg, kg m and kg m^2"})},
        {"omega": ("omega", [np.inf], {"long_name": "Angular frequency", "units": "rad/s"}),
         "influenced_dof": ("influenced_dof", _DOFS, {"long_name": "Influenced DOF"}),
         "radiating_dof": ("radiating_dof", _DOFS, {"long_name": "Radiating DOF"}),
         "space_coordinate": _AXES,
         "rho": ((), rho, {"units": "kg/m^3"}),
         "water_depth": ((), np.inf, {"units": "m"}),
         "rotation_center": ("space_coordinate", body.centroid, {"units": "m"})})


def _tables(body: Body) -> xr.Dataset:
    directions = np.asarray(body.table_directions).reshape(-1, 3)
    # The edges of the octahedral map hold some directions twice.
    _, unique = np.unique(directions.round(12) + 0.0, axis=0, return_index=True)
    unique.sort()
    dims = ("reynolds_number", "direction", "component")

    def variable(table: Any, of: int, units: str, long_name: str) -> Any:
        values = np.asarray(table)
        values = values.reshape(values.shape[0], -1, *values.shape[3:])[:, unique]
        return dims[:of], values, {"units": units, "long_name": long_name}

    return xr.Dataset(
        {"force": variable(body.force_table, 3, "rho U^2 A / 2", "Force"),
         "force_error": variable(body.force_error_table, 3, "rho U^2 A / 2", "Standard error of the force"),
         "moment": variable(body.moment_table, 3, "rho U^2 A L / 2", "Moment about the centroid"),
         "turbulent_kinetic_energy": variable(body.turbulent_kinetic_energy_table, 2, "U^2", "Turbulent kinetic energy"),
         "dissipation_rate": variable(body.dissipation_rate_table, 2, "U^3 / L", "Dissipation rate")},
        {"reynolds_number": ("reynolds_number", np.asarray(body.reynolds_numbers), {"units": "1", "long_name": "U L / nu"}),
         "component": _AXES,
         "direction_of_motion": (("direction", "component"), directions[unique],
                                 {"units": "1", "long_name": "Velocity relative to the fluid, unit vector"})})


def dataset(body: Body, *, rho: float = 1000.0) -> xr.Dataset:
    """Returns a body's added mass and tables as an xarray.Dataset, in the axes of the shape file.

    `added_mass` (omega, influenced_dof, radiating_dof) has the layout of Capytaine's assemble_dataset()
    (https://capytaine.org/stable/user_manual/post_pro.html): an unbounded fluid of the density `rho` (kg/m^3), about the
    coordinate rotation_center, the centroid; omega is infinity, since no frequency matters without a free surface. It is
    absent without a Kirchhoff tensor. `force`, `force_error`, `moment` (reynolds_number, direction, component),
    `turbulent_kinetic_energy` and `dissipation_rate` (reynolds_number, direction) are absent without tables; their units
    are in the attributes, with A = pi L^2/4 and L the attribute reference_length (m) of the dataset."""
    parts = []
    if body.kirchhoff_tensor is not None:
        parts.append(_added_mass(body, rho))
    if body.reynolds_numbers is not None:
        parts.append(_tables(body))
    result = xr.merge(parts)
    result.attrs = {"name": body.name, "source": body.source, "quality": body.quality,
                    "reference_length": float(np.sqrt(body.surface_area / np.pi))}
    return result
