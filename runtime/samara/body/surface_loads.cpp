#include "samara/body/surface_loads.hpp"

#include <algorithm>
#include <cmath>

#include "internal/body/octahedral_map.hpp"

namespace samara {
namespace {

constexpr double blasius_friction = 1.33;  // of a plate, over the area of each side: times Re^-1/2
// About the rms over the directions of three bodies beside tables by CFD (docs/surface-loads.md).
constexpr double error_of_force = 0.3;
constexpr double error_of_moment = 0.3;

double rms(const std::vector<PressureLoads>& loads, Vector3d PressureLoads::*part) {
    double sum = 0.0;
    for (const PressureLoads& load : loads) sum += (load.*part).squaredNorm();
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, loads.size())));
}

}  // namespace

LoadTables as_tables(const SurfaceLoads& loads, double length) {
    LoadTables tables;
    tables.reference_length = length;
    tables.subdivisions = loads.subdivisions;
    tables.reynolds_numbers = {1.0, 3.0, 1e1, 3e1, 1e2, 3e2, 1e3, 3e3, 1e4, 1e5};
    tables.stokes_throughout = true;
    const int size = tables.map_size();
    const LoadEntryError error{.force = Vector3d::Constant(error_of_force / std::sqrt(3.0) *
                                                           rms(loads.pressure, &PressureLoads::force)),
                               .moment = Vector3d::Constant(error_of_moment / std::sqrt(3.0) *
                                                            rms(loads.pressure, &PressureLoads::moment))};
    for (const double reynolds_number : tables.reynolds_numbers) {
        const double friction = blasius_friction / std::sqrt(reynolds_number);
        for (int row = 0; row < size; ++row) {
            for (int column = 0; column < size; ++column) {
                const Vector3d direction = octahedral_node(loads.subdivisions, row, column);
                const PressureLoads& pressed =
                    loads.pressure[static_cast<std::size_t>(row) * static_cast<std::size_t>(size) +
                                   static_cast<std::size_t>(column)];
                LoadEntry entry;
                entry.force = pressed.force + friction * loads.friction_force * direction;
                entry.moment = pressed.moment + friction * loads.friction_moment * direction;
                tables.entries.push_back(entry);
                tables.errors.push_back(error);
            }
        }
    }
    tables.quality = "surface";
    return tables;
}

}  // namespace samara
