#include "foam-cases/bake_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/direction_sampling.hpp"
#include "samara/base/error.hpp"
#include "samara/body/octahedral_map.hpp"

namespace samara {
namespace {

// Measured with simpleFoam v1912 on meshes of 6,000 to 21,000 cells; snappyHexMesh per cell of the result.
constexpr double seconds_per_cell_and_iteration = 2.2e-6;
constexpr double seconds_per_cell_of_mesh = 1.5e-4;

BakeQuality smoke_quality() {
    BakeQuality quality;
    quality.name = "smoke";
    quality.most_subdivisions = 2;
    quality.background_cell = 2.0;
    quality.mesh.layers = 2;
    quality.mesh.refinement_shells = {{0.4, 4}, {1.2, 3}, {3.0, 2}, {5.0, 1}};
    quality.iterations = 60;
    quality.averaged_iterations = 20;
    return quality;
}

BakeQuality preview_quality() {
    BakeQuality quality;
    quality.name = "preview";
    quality.mesh.refinement_shells = {{0.2, 4}, {0.6, 3}, {1.5, 2}, {3.0, 1}};
    return quality;
}

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
    for (int row = 0; row < nodes; ++row) {
        for (int column = 0; column < nodes; ++column) {
            const Vector3d direction = octahedral_node(subdivisions, row, column);
            double lowest = direction.dot(surface.vertices.front());
            double highest = lowest;
            for (const Vector3d& vertex : surface.vertices) {
                const double height = direction.dot(vertex);
                lowest = std::min(lowest, height);
                highest = std::max(highest, height);
            }
            sum += highest - lowest;
        }
    }
    return sum / (nodes * nodes);
}

// The second smallest extent in case axes (m): that of a rod's thickness, but of a sheet's width.
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

// A rod's surface is to have at least three cells across; snappyHexMesh would not see a thinner one. A sheet,
// thin in one direction alone, needs no cells inside it.
int surface_level_for(const BakeQuality& quality, double second_extent_over_length) {
    constexpr int cells_across = 3;
    constexpr int most_further_levels = 3;
    int level = quality.mesh.surface_level;
    while (level < quality.mesh.surface_level + most_further_levels &&
           cells_across * quality.background_cell > std::ldexp(second_extent_over_length, level)) {
        ++level;
    }
    return level;
}

// The far boundary is to be at least ten L away, and four times the body's own reach.
FlowMesh fitted_mesh(const BakeQuality& quality, const Body& body, double length) {
    FlowMesh mesh = quality.mesh;
    const double reach = largest_distance_from_centroid(body) / length;
    const int needed = 2 * static_cast<int>(std::ceil(2.0 * reach));
    mesh.box_half_width = std::max(mesh.box_half_width, needed);
    mesh.background_cells =
        static_cast<int>(std::lround(2.0 * mesh.box_half_width / quality.background_cell));
    mesh.surface_level = surface_level_for(quality, second_extent(body) / length);
    // snappyHexMesh refines at a surface that its cells can see, and cells as large as the body do not see
    // it: so each level is reached through a shell, for the further ones of two cells' thickness.
    for (int level = quality.mesh.surface_level + 1; level <= mesh.surface_level; ++level) {
        const double thickness = 2.0 * quality.background_cell / std::ldexp(1.0, level);
        mesh.refinement_shells.insert(mesh.refinement_shells.begin(), {thickness, level});
    }
    return mesh;
}

}  // namespace

std::vector<std::string> bake_quality_names() {
    return {"smoke", "preview"};
}

BakeQuality bake_quality(const std::string& name) {
    if (name == "smoke") return smoke_quality();
    if (name == "preview") return preview_quality();
    throw Error(fmt::format("there is no bake quality '{}'; choose smoke or preview", name));
}

double estimated_cells(const Body& body, const FlowMesh& mesh) {
    const double length = reference_length(body.moments.surface_area);
    const double width = mean_width(body.surface) / length;
    const double pi = std::numbers::pi;
    // Steiner's formula for a convex body of surface pi L^2 and mean width w, less the body itself.
    const auto volume_within = [&](double distance) {
        return pi * distance + 2.0 * pi * width * distance * distance +
               4.0 / 3.0 * pi * distance * distance * distance;
    };
    const double background_cell = 2.0 * mesh.box_half_width / mesh.background_cells;
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

BakePlan plan_bake(const Body& body, const BakeQuality& quality, double reynolds_number) {
    BakePlan plan;
    plan.quality = quality;
    plan.reference_length = reference_length(body.moments.surface_area);
    plan.axes = body.symmetry.axes;
    plan.subdivisions = quality.least_subdivisions;
    std::vector<Vector3d> directions = required_directions(body.symmetry, plan.subdivisions);
    for (int finer = plan.subdivisions + 1; finer <= quality.most_subdivisions; ++finer) {
        std::vector<Vector3d> more = required_directions(body.symmetry, finer);
        if (more.size() > static_cast<std::size_t>(quality.most_cases)) break;
        plan.subdivisions = finer;
        directions = std::move(more);
    }
    for (std::size_t i = 0; i < directions.size(); ++i) {
        plan.cases.push_back({fmt::format("direction_{:02}", i), directions[i], reynolds_number, "mesh"});
    }
    plan.quality.mesh = fitted_mesh(quality, body, plan.reference_length);
    plan.cells = estimated_cells(body, plan.quality.mesh);
    plan.cpu_seconds =
        plan.cells * (seconds_per_cell_of_mesh + seconds_per_cell_and_iteration * quality.iterations *
                                                     static_cast<double>(plan.cases.size()));
    return plan;
}

nlohmann::json plan_json(const BakePlan& plan) {
    nlohmann::json json;
    json["quality"] = plan.quality.name;
    json["subdivisions"] = plan.subdivisions;
    json["reference_length"] = plan.reference_length;
    for (int row = 0; row < 3; ++row) {
        json["axes"].push_back({plan.axes(row, 0), plan.axes(row, 1), plan.axes(row, 2)});
    }
    for (const BakeCase& entry : plan.cases) {
        json["cases"].push_back(
            {{"name", entry.name},
             {"direction", {entry.direction.x(), entry.direction.y(), entry.direction.z()}},
             {"reynolds_number", entry.reynolds_number},
             {"mesh", entry.mesh}});
    }
    return json;
}

}  // namespace samara
