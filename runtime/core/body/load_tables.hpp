#pragma once

#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/planned_region.hpp"
#include "samara/core/body/table_errors.hpp"

namespace samara {

/// The mean over the fluid that k and epsilon of a table are.
enum class TurbulenceMean {
    shell,     ///< by volume, over distances from 0.05 L to 0.25 L from the body: of earlier files
    near_wake  ///< weighted by k, over distances from 0.2 L to 1.5 L: int k^2 / int k, int k epsilon / int k
};

/// Returns "shell" or "near wake".
const char* name_of(TurbulenceMean mean);

/// One entry of the tables, made nondimensional with L = sqrt(S/pi), A = pi L^2/4 and U, the speed relative
/// to the fluid. Vectors are in body (shape) axes; moments are about the centroid of the volume.
struct LoadEntry {
    Vector3d force = Vector3d::Zero();  ///< F / (rho U^2 A / 2)
    /// M / (rho U^2 A L / 2), the total moment of the fluid in a steady translation
    Vector3d moment = Vector3d::Zero();
    double turbulent_kinetic_energy = 0.0;  ///< k / U^2 (TurbulenceMean)
    double dissipation_rate = 0.0;          ///< epsilon L / U^3, likewise
};

/// The standard errors of an entry's values, in the same units; of vectors, of each component.
using LoadEntryError = LoadEntry;

/// Load and turbulence tables over the direction d of the body's velocity relative to the fluid and the
/// Reynolds number U L / nu.
///
/// Directions lie on the octahedral map (octahedral_map.hpp) of `axes`^T d, with map_size() nodes a side,
/// both edges included: node (row, column) of Reynolds number r is entries[(r * map_size() + row) *
/// map_size() + column].
struct LoadTables {
    double reference_length = 0.0;         ///< L (m)
    int subdivisions = 1;                  ///< n: each edge of the octahedron is cut into n
    Matrix3d axes = Matrix3d::Identity();  ///< columns: the map's axes, in body axes
    std::vector<double> reynolds_numbers;  ///< ascending
    /// Whether Stokes' resistance is added to the entries at every Reynolds number; else it is added below
    /// the first one alone, and fades out there.
    bool stokes_throughout = false;
    TurbulenceMean turbulence_mean = TurbulenceMean::near_wake;  ///< what k and epsilon are
    std::vector<LoadEntry> entries;                              ///< in the order of index()
    std::vector<LoadEntryError> errors;  ///< of the entries, in their order; empty where unknown
    std::string quality;                 ///< of the bake: smoke, preview, ...
    std::string provenance;              ///< JSON text: one object for each solved case (docs/file-formats)
    std::vector<ErrorShare> error_sources;  ///< the parts of `errors`; empty where the file does not say
    /// JSON: the cases that could not be solved (formats/left_out_cases.hpp); empty: none
    std::string left_out;
    PlannedRegion plan;  ///< the directions that a bake for a scene was planned for

    /// Returns the number of nodes along each side of the octahedral map.
    [[nodiscard]] int map_size() const { return 2 * subdivisions + 1; }
    /// Returns the place in `entries` of a node of the map at a Reynolds number, each counted from 0.
    [[nodiscard]] std::size_t index(int reynolds, int row, int column) const {
        const auto size = static_cast<std::size_t>(map_size());
        return (static_cast<std::size_t>(reynolds) * size + static_cast<std::size_t>(row)) * size +
               static_cast<std::size_t>(column);
    }
};

/// Returns the entry at the unit direction (body axes) and the Reynolds number: bilinear on the map, linear
/// in log Re, held at the first and last Reynolds number. Never throws; the tables must hold at least one
/// Reynolds number.
LoadEntry look_up(const LoadTables& tables, const Vector3d& direction, double reynolds_number) noexcept;

/// Returns tables of one Reynolds number, with the values of `tables` there. A number beyond the tables' is
/// moved to their edge.
LoadTables at_reynolds_number(const LoadTables& tables, double reynolds_number);

/// Returns the standard errors of look_up()'s values, interpolated in the same way.
LoadEntryError look_up_error(const LoadTables& tables, const Vector3d& direction,
                             double reynolds_number) noexcept;

}  // namespace samara
