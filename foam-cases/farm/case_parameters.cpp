#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "foam-cases/farm/case_folder.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;

constexpr const char* mesh_entries[] = {
    "boxHalfWidth",     "backgroundCells",  "surfaceLevel",    "layers",     "layerThickness",
    "layerRatio",       "leastDeterminant", "leastTetQuality", "leastTwist", "pointInFluid",
    "refinementShells", "wakeLevel",        "wakeEnd",         "wakeRadius"};

// C_mu of the k-epsilon model (Launder & Spalding 1974).
constexpr double c_mu = 0.09;

std::string foam_vector(const Vector3d& vector) {
    // Adding zero turns a negative zero into zero.
    return fmt::format("({} {} {})", vector.x() + 0.0, vector.y() + 0.0, vector.z() + 0.0);
}

struct ValueRange {
    std::size_t begin;
    std::size_t end;
};

ValueRange find_value(const std::string& text, const std::string& name) {
    std::size_t line = 0;
    while (line < text.size()) {
        const std::string_view rest = std::string_view(text).substr(line);
        if (rest.starts_with(name) && rest.size() > name.size() && rest[name.size()] == ' ') {
            const std::size_t begin = text.find_first_not_of(' ', line + name.size());
            const std::size_t end = text.find(';', begin);
            if (end != std::string::npos) return {begin, end};
        }
        const std::size_t next = text.find('\n', line);
        if (next == std::string::npos) break;
        line = next + 1;
    }
    throw Error(fmt::format(
        "the case template has no entry '{}' in its parameters or decomposeParDict; restore it", name));
}

// Returns the momentum-thickness Reynolds number at which a boundary layer becomes turbulent by the
// turbulence of the outer flow, without pressure gradient (Langtry & Menter, AIAA Journal 47, 2009).
double transition_reynolds_number(double intensity) {
    constexpr double least_percent = 0.027;
    const double percent = std::max(least_percent, 100.0 * intensity);
    if (percent <= 1.3) return 1173.51 - 589.428 * percent + 0.2196 / (percent * percent);
    return 331.5 * std::pow(percent - 0.5658, -0.671);
}

Entries fluid_entries(const Inflow& inflow, double reynolds_number) {
    const double viscosity = 1.0 / reynolds_number;
    const double k = 1.5 * inflow.intensity * inflow.intensity;
    const double epsilon =
        inflow.length ? std::pow(c_mu, 0.75) * std::pow(k, 1.5) / *inflow.length : c_mu * k * k / viscosity;
    return {{"reynoldsNumber", fmt::format("{}", reynolds_number)},
            {"viscosity", fmt::format("{}", viscosity)},
            {"inflowK", fmt::format("{:.6g}", k)},
            {"inflowEpsilon", fmt::format("{:.6g}", epsilon)},
            {"inflowNut", fmt::format("{:.6g}", c_mu * k * k / epsilon)},
            {"inflowOmega", fmt::format("{:.6g}", epsilon / (c_mu * k))},
            {"inflowReThetat", fmt::format("{:.6g}", transition_reynolds_number(inflow.intensity))}};
}

Entries flow_entries(const BakeCase& entry) {
    return {{"direction", foam_vector(entry.direction)}, {"flowVelocity", foam_vector(-entry.direction)}};
}

std::string foam_tensor(const Matrix3d& matrix) {
    std::string text = "(";
    for (int row = 0; row < 3; ++row) {
        text += fmt::format("{}{} {} {}", row == 0 ? "" : "  ", matrix(row, 0) + 0.0, matrix(row, 1) + 0.0,
                            matrix(row, 2) + 0.0);
    }
    return text + ")";
}

// The height of the spring that models buoyancy, so large that its force is constant over a fall of some
// hundred lengths.
constexpr double anchor_height = 1e7;

Entries body_entries(const FreeFall& fall) {
    const double gravity = fall.gravity.norm();
    const Vector3d up = gravity > 0.0 ? Vector3d(-fall.gravity / gravity) : Vector3d::UnitZ();
    const Vector3d spin =
        fall.principal_moments.cwiseProduct(fall.principal_axes.transpose() * fall.angular_velocity);
    return {{"mass", fmt::format("{}", fall.mass)},
            {"centreOfMass", foam_vector(fall.center_of_mass)},
            {"momentsOfInertia", foam_vector(fall.principal_moments)},
            {"principalAxes", foam_tensor(fall.principal_axes)},
            {"startVelocity", foam_vector(fall.velocity)},
            {"startAngularMomentum", foam_vector(spin)},
            {"gravity", foam_vector(fall.gravity)},
            {"buoyancyAnchor", foam_vector(anchor_height * up)},
            {"buoyancyStiffness", fmt::format("{}", fall.volume * gravity / anchor_height)}};
}

Entries step_entries(const FreeFall& fall) {
    Entries entries = {{"timeStep", fmt::format("{}", fall.time_step)},
                       {"duration", fmt::format("{}", fall.duration)},
                       {"outerCorrectors", fmt::format("{}", fall.outer_correctors)},
                       {"accelerationRelaxation", fmt::format("{:.4g}", fall.acceleration_relaxation)}};
    if (fall.field_interval > 0.0) {
        entries.emplace_back("fieldControl", "runTime");
        entries.emplace_back("fieldInterval", fmt::format("{}", fall.field_interval));
    }
    return entries;
}

// Returns the entries of a closure; where the mesh resolves the boundary layer, with the scheme and wall
// treatment by which the closures were compared with measurements (docs/studies/closures).
Entries closure_entries(Closure closure, bool resolves_boundary_layer) {
    const bool resolves_eddies = closure == Closure::k_omega_sst_ddes;
    Entries entries = {{"simulationType", closure == Closure::laminar ? "laminar"
                                          : resolves_eddies           ? "LES"
                                                                      : "RAS"}};
    if (closure != Closure::laminar) entries.emplace_back("closure", name_of(closure));
    if (resolves_boundary_layer) {
        entries.insert(entries.end(),
                       {{"convection", resolves_eddies ? "LUST grad(U)" : "linearUpwind grad(U)"},
                        {"nutAtWall", "nutLowReWallFunction"},
                        {"kAtWall", "fixedValue"}});
    }
    return entries;
}

// Returns the entries of a flow's case beyond closure_entries(): k and epsilon need second order, and a mean
// where no other case has it; loads are as the closures were compared with measurements.
Entries turbulence_entries(const BakePlan& plan, const BakeCase& entry) {
    const std::vector<FlowMesh>& separate = plan.quality.turbulence_meshes;
    const bool has_means =
        entry.closure != Closure::laminar &&
        (separate.empty() || std::ranges::find(separate, entry.mesh, &FlowMesh::name) != separate.end());
    Entries entries = {{"turbulenceMeans", has_means ? "yes" : "no"}};
    if (has_means && solves_for_omega(entry.closure)) {
        entries.insert(entries.end(),
                       {{"solvesForOmega", "yes"}, {"dissipationField", "turbulenceProperties:epsilon"}});
    }
    if (!has_means) entries.emplace_back("turbulenceConvection", "upwind");
    return entries;
}

// Without these limits snappyHexMesh rejects layers that are thinner than a hundredth of their width.
Entries layer_entries(const FlowMesh& mesh) {
    Entries entries = {{"layers", fmt::format("{}", mesh.layers)}};
    if (mesh.resolves_boundary_layer) {
        entries.insert(entries.end(), {{"layerRatio", "1.4"},
                                       {"leastDeterminant", "1e-9"},
                                       {"leastTetQuality", "-1e30"},
                                       {"leastTwist", "-1"}});
    }
    return entries;
}

Entries mesh_entries_of(const FlowMesh& mesh) {
    const double corner = mesh.box_half_width;
    std::string shells;
    for (const auto& [distance, level] : mesh.refinement_shells) {
        shells += fmt::format("{}({} {})", shells.empty() ? "" : " ", distance, level);
    }
    Entries entries = layer_entries(mesh);
    entries.insert(entries.end(), {{"boxHalfWidth", fmt::format("{}", mesh.box_half_width)},
                                   {"backgroundCells", fmt::format("{}", mesh.background_cells())},
                                   {"surfaceLevel", fmt::format("{}", mesh.surface_level)},
                                   {"pointInFluid", fmt::format("({:.3f} {:.3f} {:.3f})", corner - 0.783,
                                                                corner - 0.681, corner - 0.577)},
                                   {"refinementShells", "(" + shells + ")"}});
    return entries;
}

Entries model_entries(const BakeQuality& quality, const BakeCase& entry) {
    Entries entries = {
        {"stationarity", fmt::format("{}", quality.stationarity)},
        {"mostIterations",
         fmt::format("{}", entry.start_from.empty() ? quality.most_iterations : quality.most_iterations / 2)},
        {"startFrom", entry.start_from.empty() ? "none" : entry.start_from}};
    const bool is_started = !entry.start_from.empty();
    if (entry.closure == Closure::k_epsilon) {
        // docs/studies/bake has the savings and the errors; for other models they are not known.
        const int least = quality.least_iterations;
        entries.insert(entries.end(),
                       {{"roundIterations", "50"},
                        {"leastIterations", fmt::format("{}", is_started ? least / 2 : least)}});
    } else if (is_started) {
        // A solution on a coarser mesh, or by a similar model, is a good start.
        entries.emplace_back("leastIterations", "100");
    }
    return entries;
}

// Returns the numbers of ranks along x, y and z: as even as possible, the most along x.
std::array<int, 3> ranks_along_axes(int ranks) {
    std::array<int, 3> best = {ranks, 1, 1};
    for (int z = 1; z * z * z <= ranks; ++z) {
        for (int y = z; ranks % z == 0 && z * y * y <= ranks; ++y) {
            if (ranks / z % y != 0) continue;
            const int x = ranks / z / y;
            if (x - z <= best[0] - best[2]) best = {x, y, z};
        }
    }
    return best;
}

Entries process_entries(int ranks) {
    const auto [x, y, z] = ranks_along_axes(ranks);
    return {{"numberOfSubdomains", fmt::format("{}", ranks)},
            {"ranksAlong", fmt::format("({} {} {})", x, y, z)}};
}

void replace_values(std::string& text, const Entries& entries) {
    for (const auto& [name, value] : entries) {
        const auto [begin, end] = find_value(text, name);
        text.replace(begin, end - begin, value);
    }
}

}  // namespace

std::string case_parameters(const std::string& template_text, const BakePlan& plan, const BakeCase& entry) {
    std::string text = template_text;
    replace_values(text, flow_entries(entry));
    replace_values(text, fluid_entries(plan.inflow, entry.reynolds_number));
    replace_values(text, mesh_entries_of(mesh_of(plan, entry.mesh)));
    const bool resolves_boundary_layer = mesh_of(plan, entry.mesh).resolves_boundary_layer;
    replace_values(text, closure_entries(entry.closure, resolves_boundary_layer));
    replace_values(text, turbulence_entries(plan, entry));
    replace_values(text, model_entries(plan.quality, entry));
    return text;
}

std::string decomposition(const std::string& template_text, int ranks) {
    std::string text = template_text;
    replace_values(text, process_entries(ranks));
    return text;
}

std::string fall_parameters(const std::string& template_text, const BakePlan& plan, const FreeFall& fall) {
    std::string text = template_text;
    replace_values(text, fluid_entries(plan.inflow, fall.reynolds_number));
    replace_values(text, body_entries(fall));
    const bool resolves_boundary_layer = mesh_of(plan, fall.mesh).resolves_boundary_layer;
    replace_values(text, closure_entries(fall.closure, resolves_boundary_layer));
    replace_values(text, {{"rateOfChange", resolves_boundary_layer ? "backward" : "Euler"}});
    replace_values(text, step_entries(fall));
    return text;
}

std::string mesh_case_parameters(const std::string& template_text, const FlowMesh& mesh) {
    std::string text = template_text;
    replace_values(text, mesh_entries_of(mesh));
    return text;
}

std::string mesh_parameters_of(const std::string& parameters) {
    std::string text;
    for (const char* name : mesh_entries) {
        const auto [begin, end] = find_value(parameters, name);
        text += fmt::format("{} {};\n", name, parameters.substr(begin, end - begin));
    }
    return text;
}

}  // namespace samara
