#include "solved_folder.hpp"

#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/tables/direction_sampling.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "symmetry_groups.hpp"

namespace samara::test {
namespace {

constexpr int iterations = 20;
constexpr int averaging_start = 10;

std::string foam_header(const std::string& class_name, const std::string& object) {
    return fmt::format(
        "FoamFile\n{{\n    version 2.0;\n    format ascii;\n    class {};\n    object {};\n}}\n\n",
        class_name, object);
}

/// The part of a history's value beside its mean: large before the averaging starts, then one that
/// alternates and has no mean over 11 iterations, and is nothing at the last.
double transient(int iteration) {
    if (iteration < averaging_start) return 1.0 / iteration;
    if (iteration == iterations) return 0.0;
    return iteration % 2 == 0 ? 0.01 : -0.01;
}

std::string load_history(const Vector3d& mean) {
    std::string text =
        "# Force\n# CofR : (0 0 0)\n#\n# Time\t(total_x total_y total_z)\t(pressure_x pressure_y "
        "pressure_z)\t(viscous_x viscous_y viscous_z)\n";
    for (int i = 1; i <= iterations; ++i) {
        const Vector3d value = mean * (1.0 + transient(i));
        text += fmt::format("{}\t({:.10e} {:.10e} {:.10e})\t(0 0 0)\t(0 0 0)\n", i, value.x(), value.y(),
                            value.z());
    }
    return text;
}

std::string turbulence_history(const LoadEntry& entry) {
    std::string text =
        "# Region : cellZone nearWake\n# Cells : 3\n# Volume : 6\n# "
        "Time\tweightedVolAverage(k)\tweightedVolAverage(epsilon)\n";
    for (int i = 1; i <= iterations; ++i) {
        text +=
            fmt::format("{}\t{:.10e}\t{:.10e}\n", i, entry.turbulent_kinetic_energy * (1.0 + transient(i)),
                        entry.dissipation_rate * (1.0 + transient(i)));
    }
    return text;
}

/// A field over five cells, of which 1, 2 and 4 are the near wake, of volumes 1, 2 and 3: their mean weighted
/// by such a field is `mean`, their means by volume and by number are not.
std::string field(const std::string& object, double mean) {
    return foam_header("volScalarField", object) +
           fmt::format(
               "dimensions [0 0 0 0 0 0 0];\n\ninternalField nonuniform List<scalar> \n5\n(\n{:.10e}\n"
               "{:.10e}\n{:.10e}\n{:.10e}\n{:.10e}\n)\n;\n",
               99.0, 1.5 * mean, 0.0, 99.0, 0.5 * mean);
}

void add_face(Surface& surface, const std::array<std::int32_t, 4>& face) {
    surface.corners.push_back({face[0], face[1], face[2]});
    surface.corners.push_back({face[0], face[2], face[3]});
}

}  // namespace

Body box_body(const Vector3d& edges) {
    Body body;
    body.name = "box";
    body.source = "a box";
    for (int i = 0; i < 8; ++i) {
        const Vector3d corner((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5,
                              (i & 4) != 0 ? 0.5 : -0.5);
        body.surface.vertices.emplace_back(corner.cwiseProduct(edges));
    }
    for (const auto& face :
         {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        add_face(body.surface, face);
    }
    body.moments.volume = edges.prod();
    body.moments.second_moments = (body.moments.volume / 12.0 * edges.cwiseAbs2()).asDiagonal();
    body.moments.surface_area = surface_area(body.surface);
    body.symmetry = box_symmetry();
    return body;
}

SolvedFolder::SolvedFolder(Body body, int subdivisions, const std::vector<double>& reynolds_numbers,
                           const Law& law)
    : body_(std::move(body)) {
    write_body_file(path() / "body.body.h5", body_);
    write("mesh/constant/polyMesh/cellZones",
          foam_header("regIOobject", "cellZones") +
              "1\n(\nnearWake\n{\n    type cellZone;\ncellLabels List<label> 3(1 2 4);\n}\n)\n");
    nlohmann::json cases = nlohmann::json::array();
    for (const double reynolds_number : reynolds_numbers) {
        for (const Vector3d& direction : required_directions(body_.symmetry, subdivisions)) {
            names_.push_back(fmt::format("case_{:02}", names_.size()));
            cases.push_back({{"name", names_.back()},
                             {"direction", {direction.x(), direction.y(), direction.z()}},
                             {"reynolds_number", reynolds_number}});
            write_case(names_.back(), direction, reynolds_number, law(direction, reynolds_number));
        }
    }
    nlohmann::json axes = nlohmann::json::array();
    for (int row = 0; row < 3; ++row) {
        const Vector3d values = body_.symmetry.axes.row(row);
        axes.push_back({values.x(), values.y(), values.z()});
    }
    const nlohmann::json plan = {{"quality", "smoke"},
                                 {"subdivisions", subdivisions},
                                 {"reference_length", reference_length(body_.moments.surface_area)},
                                 {"axes", axes},
                                 {"cases", cases}};
    write("plan.json", plan.dump(2));
}

void SolvedFolder::write_case(const std::string& name, const Vector3d& direction, double reynolds_number,
                              const LoadEntry& entry) const {
    const std::filesystem::path folder = name;
    write(folder / "parameters",
          fmt::format("direction ({:.17g} {:.17g} {:.17g});\nreynoldsNumber {:.17g};\n", direction.x(),
                      direction.y(), direction.z(), reynolds_number));
    write(folder / "postProcessing/forces/0/force.dat", load_history(std::numbers::pi / 8.0 * entry.force));
    write(folder / "postProcessing/forces/0/moment.dat", load_history(std::numbers::pi / 8.0 * entry.moment));
    write(folder / "postProcessing/nearWake/0/volFieldValue.dat", turbulence_history(entry));
    write(folder / "0/k", foam_header("volScalarField", "k") + "internalField uniform 1;\n");
    write(folder / "20/k", field("k", entry.turbulent_kinetic_energy));
    write(folder / "20/epsilon", field("epsilon", entry.dissipation_rate));
    write(folder / "20/V",
          foam_header("volScalarField::Internal", "V") + "value nonuniform List<scalar> 5(7 1 2 7 3);\n");
    write(folder / "provenance.json",
          fmt::format(R"({{"closure": "kEpsilon", "cells": 5, "averaging_start": {}}})", averaging_start));
}

void SolvedFolder::change_plan(const std::function<void(nlohmann::json&)>& change) const {
    nlohmann::json plan = nlohmann::json::parse(read_bytes(path() / "plan.json"));
    change(plan);
    write("plan.json", plan.dump(2));
}

void SolvedFolder::replace(const std::filesystem::path& name, const std::string& from,
                           const std::string& to) const {
    std::string text = read_bytes(path() / name);
    const std::size_t place = text.find(from);
    if (place == std::string::npos) throw std::runtime_error(name.string() + " has no '" + from + "'");
    write(name, text.replace(place, from.size(), to));
}

}  // namespace samara::test
