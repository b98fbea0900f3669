#include "foam-cases/farm/disk_need.hpp"

#include <fmt/format.h>

#include "converter/cases/case_reduction.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

// Measured on the meshes and cases of a sphere's preview, 5,400 and 18,700 cells: fields in binary, histories
// and logs.
constexpr double bytes_of_mesh = 1.5e6;
constexpr double bytes_of_mesh_per_cell = 200.0;
constexpr double bytes_of_case = 3e5;
constexpr double bytes_of_case_per_cell = 270.0;
// Two states are kept; histories and log grow with the steps.
constexpr double bytes_of_fall_per_cell = 600.0;
constexpr double bytes_of_fall_per_step = 2500.0;

}  // namespace

double bytes_to_solve(const fs::path& folder, const BakePlan& plan) {
    double bytes = 0.0;
    const std::vector<FlowMesh> meshes = plan.all_meshes();
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        if (fs::exists(folder / meshes[i].name / "mesh.json")) continue;
        bytes += bytes_of_mesh + bytes_of_mesh_per_cell * plan.cells[i];
    }
    for (const BakeCase& entry : plan.cases) {
        if (is_solved(folder / entry.name)) continue;
        bytes += bytes_of_case + bytes_of_case_per_cell * cells_of(plan, entry.mesh);
    }
    for (const FreeFall& fall : plan.falls) {
        if (is_solved(folder / fall.name)) continue;
        bytes += bytes_of_fall_per_cell * cells_of(plan, fall.mesh) +
                 bytes_of_fall_per_step * fall.duration / fall.time_step;
    }
    return bytes;
}

void require_room(const fs::path& folder, double bytes) {
    std::error_code unknown;
    const auto free = static_cast<double>(fs::space(folder, unknown).available);
    if (unknown || free > 0.5 * bytes) return;
    throw Error(fmt::format(
        "{}: what is to be solved takes about {:.3g} MB there, and {:.3g} MB are free on its disk; make "
        "room, or name an output elsewhere",
        folder.string(), 1e-6 * bytes, 1e-6 * free));
}

}  // namespace samara
