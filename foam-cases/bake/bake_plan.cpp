#include "foam-cases/bake/bake_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/tables/direction_sampling.hpp"
#include "foam-cases/bake/direction_choice.hpp"
#include "foam-cases/falls/fall_plan.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/surface/octahedral_map.hpp"
#include "samara/formats/json_text.hpp"
#include "samara/scene/terminal_speed.hpp"

namespace samara {
namespace {

// CPU seconds, measured with simpleFoam v1912 by k-epsilon on two cores that other work shares, on which
// 6,000 to 19,000 cells take 2.3e-6 to 3.2e-6; an idle core takes half to two thirds of that.
// snappyHexMesh per cell of the result.
constexpr double seconds_per_cell_and_iteration = 2.7e-6;
constexpr double seconds_per_case = 0.6;  // starting programs, scripts and checks
constexpr double seconds_of_farm = 2.5;   // start of Snakemake
constexpr double seconds_per_cell_of_mesh = 1.7e-4;

// The value of `quality` in plan.json for a plan of falls only.
constexpr const char* quality_of_fall = "fall";

double largest_distance_from_centroid(const Body& body) {
    double largest = 0.0;
    for (const Vector3d& vertex : body.surface.vertices) {
        largest = std::max(largest, (vertex - body.moments.centroid).norm());
    }
    return largest;
}

double mean_width(const Surface& surface) {
    constexpr int subdivisions = 4;
    constexpr int nodes = 2 * subdivisions + 1;
    double sum = 0.0;
    double weights = 0.0;
    for (int row = 0; row < nodes; ++row) {
        for (int column = 0; column < nodes; ++column) {
            const auto here = static_cast<std::size_t>(row) * nodes + static_cast<std::size_t>(column);
            if (unique_node(subdivisions, row, column) != here) continue;
            const Vector3d direction = octahedral_node(subdivisions, row, column);
            double lowest = direction.dot(surface.vertices.front());
            double highest = lowest;
            for (const Vector3d& vertex : surface.vertices) {
                const double height = direction.dot(vertex);
                lowest = std::min(lowest, height);
                highest = std::max(highest, height);
            }
            // The nodes lie evenly on the octahedron, and so the closer on the sphere the farther off it is.
            const double weight = std::pow(direction.lpNorm<1>(), 3.0);
            sum += weight * (highest - lowest);
            weights += weight;
        }
    }
    return sum / weights;
}

// Returns the second smallest extent in case axes (m): the thickness of a rod, but the width of a sheet.
double second_extent(const Body& body) {
    Eigen::Array3d lowest = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Array3d highest = -lowest;
    for (const Vector3d& vertex : body.surface.vertices) {
        const Eigen::Array3d place = (body.symmetry.axes.transpose() * vertex).array();
        lowest = lowest.min(place);
        highest = highest.max(place);
    }
    Eigen::Array3d extents = highest - lowest;
    std::sort(extents.data(), extents.data() + 3);
    return extents[1];
}

// Returns the surface level with at least three cells across a rod, since snappyHexMesh would not resolve a
// thinner one. A sheet, thin in one direction only, needs no cells inside it.
int surface_level_for(const FlowMesh& mesh, double second_extent_over_length) {
    constexpr int cells_across = 3;
    constexpr int most_further_levels = 3;
    int level = mesh.surface_level;
    while (level < mesh.surface_level + most_further_levels &&
           cells_across * mesh.background_cell > std::ldexp(second_extent_over_length, level)) {
        ++level;
    }
    return level;
}

// Doubles the box with the same number of background cells; the previous cell size fills one more shell.
void widen(FlowMesh& mesh) {
    const double shell = mesh.refinement_shells.back().first + 4.0 * mesh.background_cell;
    for (auto& [distance, level] : mesh.refinement_shells) ++level;
    mesh.refinement_shells.emplace_back(shell, 1);
    ++mesh.surface_level;
    mesh.background_cell *= 2.0;
    mesh.box_half_width *= 2;
}

// Fits a mesh to the body: the far boundary is at least 10 L away, and four times the body's largest radius.
FlowMesh fitted_mesh(FlowMesh mesh, const Body& body, double length) {
    const double reach = largest_distance_from_centroid(body) / length;
    while (mesh.box_half_width < 4.0 * reach) widen(mesh);
    const int planned_level = mesh.surface_level;
    mesh.surface_level = surface_level_for(mesh, second_extent(body) / length);
    // snappyHexMesh refines where its cells resolve the surface, which cells as large as the body do not: so
    // each level is reached through a shell, the further ones two cells thick.
    for (int level = planned_level + 1; level <= mesh.surface_level; ++level) {
        const double thickness = 2.0 * mesh.background_cell / std::ldexp(1.0, level);
        mesh.refinement_shells.insert(mesh.refinement_shells.begin(), {thickness, level});
    }
    return mesh;
}

std::string case_name(const char* group, std::size_t index, const FlowMesh& mesh) {
    return fmt::format("{}_{:02}_{}", group, index, mesh.name.substr(mesh.name.find('_') + 1));
}

// Adds a copy of a case that starts from its solution and is modified by `change`.
template <typename Change>
void add_variant(const BakeCase& main, const std::string& more, Change change, BakePlan& plan) {
    BakeCase entry = main;
    entry.name = main.name + more;
    entry.start_from = main.name;
    change(entry);
    plan.cases.push_back(entry);
}

// Returns the mesh of the turbulence that belongs to one of the loads.
const std::string& turbulence_mesh_of(const std::string& mesh, const BakeQuality& quality) {
    const auto found = std::ranges::find(quality.meshes, mesh, &FlowMesh::name);
    return quality.turbulence_meshes.at(static_cast<std::size_t>(found - quality.meshes.begin())).name;
}

// Adds the separate turbulence case of the plan's last case, where the quality has such; returns its name.
std::string add_turbulence(const std::string& start_from, Closure closure, BakePlan& plan) {
    BakeCase& loads = plan.cases.back();
    if (plan.quality.turbulence_meshes.empty() || loads.reynolds_number < laminar_reynolds_number) return {};
    BakeCase entry = loads;
    entry.name += "_turbulence";
    entry.turbulence_from = "";
    entry.mesh = turbulence_mesh_of(loads.mesh, plan.quality);
    entry.closure = closure;
    entry.purpose = loads.purpose == CasePurpose::start ? CasePurpose::start : CasePurpose::turbulence;
    entry.start_from = start_from;
    loads.turbulence_from = entry.purpose == CasePurpose::turbulence ? entry.name : "";
    plan.cases.push_back(entry);
    return entry.name;
}

// Returns the mesh for further Reynolds numbers and closures: the one before the last.
const std::string& mesh_of_few(const BakePlan& plan) {
    const std::vector<FlowMesh>& meshes = plan.quality.meshes;
    return meshes[meshes.size() < 2 ? 0 : meshes.size() - 2].name;
}

// Returns the main case in a direction on that mesh.
BakeCase case_of_few(const Vector3d& direction, const BakePlan& plan) {
    const auto found = std::ranges::find_if(plan.cases, [&](const BakeCase& entry) {
        return entry.mesh == mesh_of_few(plan) && entry.direction == direction &&
               entry.reynolds_number == plan.main_reynolds_number;
    });
    if (found == plan.cases.end()) throw std::logic_error("the direction has no ladder in the plan");
    return *found;
}

// Returns the number of directions to solve, at most.
std::size_t most_directions(const Symmetry& symmetry, const BakeQuality& quality) {
    constexpr std::size_t many_images = 4;
    const bool few_images = symmetry.type == Symmetry::Type::finite && symmetry.elements.size() < many_images;
    return static_cast<std::size_t>(few_images ? quality.directions_without_symmetry : quality.directions);
}

// Adds the cases of the main Reynolds number in as many directions as the quality asks for, and those on the
// last mesh, at further Reynolds numbers and by other closures in the first of them.
void plan_cases(const Symmetry& symmetry, double main_reynolds_number, BakePlan& plan) {
    const BakeQuality& quality = plan.quality;
    const Candidates candidates = candidate_directions(symmetry);
    plan.subdivisions = stored_subdivisions(candidates, quality);
    plan.main_reynolds_number = main_reynolds_number;
    std::vector<std::size_t> chosen = ends_of_axes(symmetry, candidates.directions);
    const std::size_t count = most_directions(symmetry, quality);
    const auto more =
        choose_directions(symmetry, candidates.directions, chosen, direction_weights({}, symmetry),
                          count - std::min(count, chosen.size()));
    chosen.insert(chosen.end(), more.begin(), more.end());
    const std::size_t usual = std::min(chosen.size(), static_cast<std::size_t>(quality.directions));
    const auto few = static_cast<std::size_t>(std::ceil(quality.share_of_few * static_cast<double>(usual)));
    const bool one_mesh = quality.meshes.size() < 2;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        add_ladder("direction", i, candidates.directions[chosen[i]], main_reynolds_number, plan,
                   one_mesh || i < few ? Ladder::to_last_mesh : Ladder::to_mesh_before);
    }
    for (const double factor : quality.further_reynolds_numbers) {
        const double reynolds_number = rounded_reynolds_number(factor * main_reynolds_number);
        for (std::size_t i = 0; i < few; ++i) {
            add_further_reynolds_number(candidates.directions[chosen[i]], reynolds_number, plan);
        }
    }
    for (std::size_t i = 0; i < few; ++i) add_other_closures(candidates.directions[chosen[i]], plan);
}

std::size_t index_of_mesh(const BakePlan& plan, const std::string& name) {
    const std::vector<FlowMesh> meshes = plan.all_meshes();
    const auto found = std::ranges::find(meshes, name, &FlowMesh::name);
    if (found == meshes.end()) throw std::logic_error("the plan has no mesh " + name);
    return static_cast<std::size_t>(found - meshes.begin());
}

}  // namespace

std::vector<double> BakePlan::reynolds_numbers() const {
    std::vector<double> numbers = {main_reynolds_number};
    numbers.insert(numbers.end(), further_reynolds_numbers.begin(), further_reynolds_numbers.end());
    return numbers;
}

std::vector<FlowMesh> BakePlan::all_meshes() const {
    std::vector<FlowMesh> meshes = quality.meshes;
    meshes.insert(meshes.end(), quality.turbulence_meshes.begin(), quality.turbulence_meshes.end());
    meshes.insert(meshes.end(), quality.fall_meshes.begin(), quality.fall_meshes.end());
    return meshes;
}

void add_ladder(const char* group, std::size_t index, const Vector3d& direction, double reynolds_number,
                BakePlan& plan, Ladder ladder) {
    const std::vector<FlowMesh>& meshes = plan.quality.meshes;
    std::string before;
    std::string turbulence_before;
    const std::size_t last = meshes.size() - (ladder == Ladder::to_mesh_before ? 1 : 0);
    for (std::size_t i = 0; i < last; ++i) {
        BakeCase entry;
        entry.name = case_name(group, index, meshes[i]);
        entry.direction = direction;
        entry.reynolds_number = reynolds_number;
        entry.mesh = meshes[i].name;
        entry.closure = closure_at(reynolds_number, plan.quality.loads_closure);
        entry.purpose = i + 1 == meshes.size()   ? CasePurpose::table
                        : i + 2 == meshes.size() ? CasePurpose::mesh
                                                 : CasePurpose::start;
        entry.start_from = before;
        before = entry.name;
        plan.cases.push_back(entry);
        turbulence_before = add_turbulence(turbulence_before, plan.quality.turbulence_closure, plan);
    }
}

int stored_subdivisions(const Candidates& candidates, const BakeQuality& quality) {
    const int solved = candidates.subdivisions;
    return solved * ((quality.table_subdivisions + solved - 1) / solved);
}

double mass_of(const MassSpecification& asked, const Body& body) {
    const MassSpecification mass = mass_asked_or_own(asked, body);
    if (mass.is_given()) return mass_properties(body, mass).mass;
    throw Error(fmt::format("{}: has neither a density nor a mass; give one", body.name));
}

double bake_speed(const Body& body, const Fluid& fluid, double mass, double gravity) {
    const double speed = terminal_speed(body, fluid, mass, gravity);
    if (speed > 0.0) return speed;
    if (gravity > 0.0) {
        throw Error(
            fmt::format("{}: the body is as dense as the fluid ({:.6g} kg/m^3) and has no terminal speed to "
                        "bake at; give another density",
                        body.name, fluid.density));
    }
    throw Error(fmt::format(
        "{}: without gravity the body has no terminal speed to bake at; give another gravity", body.name));
}

double rounded_reynolds_number(double reynolds_number) {
    const double unit = std::pow(10.0, std::floor(std::log10(reynolds_number)) - 2.0);
    return std::round(reynolds_number / unit) * unit;
}

void add_further_reynolds_number(const Vector3d& direction, double reynolds_number, BakePlan& plan) {
    const std::vector<double> known = plan.reynolds_numbers();
    if (std::ranges::find(known, reynolds_number) == known.end()) {
        plan.further_reynolds_numbers.push_back(reynolds_number);
    }
    const auto change = [&](BakeCase& entry) {
        entry.reynolds_number = reynolds_number;
        entry.closure = closure_at(reynolds_number, plan.quality.loads_closure);
        entry.purpose = CasePurpose::table;
        entry.turbulence_from = "";
    };
    const BakeCase main = case_of_few(direction, plan);
    add_variant(main, fmt::format("_re_{:.6g}", reynolds_number), change, plan);
    add_turbulence(main.turbulence_from, plan.quality.turbulence_closure, plan);
}

void add_other_closures(const Vector3d& direction, BakePlan& plan) {
    if (closure_at(plan.main_reynolds_number) == Closure::laminar) return;
    for (const Closures& closures : plan.quality.other_closures) {
        const auto change = [&](BakeCase& entry) {
            entry.closure = closures.loads;
            entry.purpose = CasePurpose::closure;
        };
        const BakeCase main = case_of_few(direction, plan);
        add_variant(main, fmt::format("_{}", name_of(closures.loads)), change, plan);
        add_turbulence(main.turbulence_from, closures.turbulence, plan);
    }
}

BakePlan plan_of_meshes(const Body& body, const BakeQuality& quality) {
    BakePlan plan;
    plan.quality = quality;
    plan.reference_length = reference_length(body.moments.surface_area);
    plan.axes = body.symmetry.axes;
    for (std::vector<FlowMesh>* const meshes : {&plan.quality.meshes, &plan.quality.turbulence_meshes}) {
        for (FlowMesh& mesh : *meshes) {
            mesh = fitted_mesh(mesh, body, plan.reference_length);
            plan.cells.push_back(estimated_cells(body, mesh));
        }
    }
    return plan;
}

void estimate_cost(BakePlan& plan) {
    plan.cpu_seconds = seconds_of_farm;
    for (const double cells : plan.cells) plan.cpu_seconds += estimated_mesh_seconds(cells);
    for (const BakeCase& entry : plan.cases) plan.cpu_seconds += estimated_seconds(plan, entry);
    for (const FreeFall& fall : plan.falls) {
        plan.cpu_seconds += estimated_fall_seconds(fall, cells_of(plan, fall.mesh));
    }
}

FlowMesh mesh_of(const BakePlan& plan, const std::string& name) {
    return plan.all_meshes()[index_of_mesh(plan, name)];
}

double cells_of(const BakePlan& plan, const std::string& mesh) {
    return plan.cells.at(index_of_mesh(plan, mesh));
}

Closure closure_at(double reynolds_number, Closure turbulent) {
    return reynolds_number < laminar_reynolds_number ? Closure::laminar : turbulent;
}

double estimated_iterations(const BakePlan& plan, const BakeCase& entry) {
    // For k-epsilon, means over the cases of docs/explanation/bake.md whose tails were compared with longer
    // runs.
    if (entry.closure == Closure::k_epsilon)
        return (entry.start_from.empty() ? 1.3 : 1.2) * plan.quality.least_iterations;
    return (entry.start_from.empty() ? 0.35 : 0.25) * plan.quality.most_iterations;
}

double estimated_mesh_seconds(double cells) {
    return seconds_per_cell_of_mesh * cells;
}

double estimated_seconds(const BakePlan& plan, const BakeCase& entry) {
    return seconds_per_case +
           seconds_per_cell_and_iteration * cells_of(plan, entry.mesh) * estimated_iterations(plan, entry);
}

double estimated_cells(const Body& body, const FlowMesh& mesh) {
    const double length = reference_length(body.moments.surface_area);
    const double width = mean_width(body.surface) / length;
    const double pi = std::numbers::pi;
    // Steiner's formula for a convex body of surface pi L^2 and mean width w, without the body itself.
    const auto volume_within = [&](double distance) {
        return pi * distance + 2.0 * pi * width * distance * distance +
               4.0 / 3.0 * pi * distance * distance * distance;
    };
    const double background_cell = 2.0 * mesh.box_half_width / mesh.background_cells();
    const auto cells_per_volume = [&](int level) {
        return std::pow(std::ldexp(1.0, level) / background_cell, 3.0);
    };
    double inner = 0.0;
    double cells = 0.0;
    for (const auto& [distance, level] : mesh.refinement_shells) {
        cells += (volume_within(distance) - inner) * cells_per_volume(level);
        inner = volume_within(distance);
    }
    cells += (std::pow(2.0 * mesh.box_half_width, 3.0) - inner) * cells_per_volume(0);
    const double surface_cell = background_cell / std::ldexp(1.0, mesh.surface_level);
    return cells + mesh.layers * pi / (surface_cell * surface_cell);
}

BakePlan plan_bake(const Body& body, const BakeQuality& quality, double reynolds_number,
                   const Inflow& inflow) {
    BakePlan plan = plan_of_meshes(body, quality);
    plan.inflow = inflow;
    plan_cases(body.symmetry, reynolds_number, plan);
    estimate_cost(plan);
    return plan;
}

BakePlan plan_probes(const Body& body, const BakeQuality& quality, double reynolds_number, int count) {
    BakePlan plan = plan_of_meshes(body, quality);
    plan.main_reynolds_number = reynolds_number;
    const auto fraction = [](double value) { return value - std::floor(value); };
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - 2.0 * fraction(0.5 + 0.7548776662466927 * i);
        const double angle = 2.0 * std::numbers::pi * fraction(0.5 + 0.5698402909980532 * i);
        const double radius = std::sqrt(1.0 - z * z);
        const Vector3d direction(radius * std::cos(angle), radius * std::sin(angle), z);
        const double decades = i % 3 == 2 ? fraction(0.6180339887498949 * i) : 0.0;
        add_ladder("probe", static_cast<std::size_t>(i), direction.normalized(),
                   rounded_reynolds_number(reynolds_number * std::pow(10.0, -decades)), plan);
    }
    estimate_cost(plan);
    return plan;
}

nlohmann::json plan_json(const BakePlan& plan) {
    nlohmann::json json;
    json["quality"] = plan.type == CaseType::fall ? quality_of_fall : plan.quality.name;
    json["subdivisions"] = plan.subdivisions;
    json["reference_length"] = plan.reference_length;
    json["ranks"] = plan.ranks;
    if (plan.covers_scene) json["covers"] = "scene";
    json["axes"] = rows_as_json(plan.axes);
    for (const FlowMesh& mesh : plan.all_meshes()) json["meshes"].push_back({{"name", mesh.name}});
    json["cases"] = nlohmann::json::array();
    for (const FreeFall& fall : plan.falls) {
        json["falls"].push_back({{"name", fall.name}, {"mesh", fall.mesh}});
    }
    for (const BakeCase& entry : plan.cases) {
        json["cases"].push_back(
            {{"name", entry.name},
             {"direction", {entry.direction.x(), entry.direction.y(), entry.direction.z()}},
             {"reynolds_number", entry.reynolds_number},
             {"mesh", entry.mesh},
             {"purpose", name_of(entry.purpose)},
             {"closure", name_of(entry.closure)},
             {"start_from", entry.start_from},
             {"turbulence_from", entry.turbulence_from}});
    }
    return json;
}

CaseType type_of_plan(const nlohmann::json& json) {
    const auto quality = json.find("quality");
    return quality != json.end() && *quality == quality_of_fall ? CaseType::fall : CaseType::bake;
}

}  // namespace samara
