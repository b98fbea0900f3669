#pragma once

#include "samara/core/body/load_tables.hpp"

namespace samara {

/// Returns `tables` with k, epsilon, their errors and their mean (TurbulenceMean) of `turbulence`, tables of
/// the same body, looked up at each node of `tables`. Loads and their errors stay. The provenance is that of
/// both: the cases of `turbulence` have the purpose "turbulence".
LoadTables with_replaced_turbulence(LoadTables tables, const LoadTables& turbulence);

}  // namespace samara
