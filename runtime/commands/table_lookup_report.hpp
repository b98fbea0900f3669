#pragma once

#include <nlohmann/json_fwd.hpp>

#include "samara/core/body/load_tables.hpp"

namespace samara {

/// The tables' entry with its standard errors for a body that moves along the unit direction (shape axes) at
/// the Reynolds number, on standard output.
void print_lookup(const LoadTables& tables, const Vector3d& direction, double reynolds_number);

/// The same as JSON: drag_coefficient, force, moment, turbulent_kinetic_energy, dissipation_rate, each with
/// its _error; on A = pi L^2/4 and L.
nlohmann::json lookup_as_json(const LoadTables& tables, const Vector3d& direction, double reynolds_number);

}  // namespace samara
