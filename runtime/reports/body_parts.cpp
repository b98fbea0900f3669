#include "samara/reports/body_parts.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "samara/analysis/advice/density_warning.hpp"
#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/body/table_errors.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/physics/fluid.hpp"
#include "samara/formats/left_out_cases.hpp"
#include "samara/pictures/body_pictures.hpp"
#include "samara/reports/words.hpp"

namespace samara {
namespace {

std::string in_words(const Vector3d& vector, const char* unit = "") {
    return fmt::format("({:.4g}, {:.4g}, {:.4g}){}", vector.x(), vector.y(), vector.z(), unit);
}

std::string size_of(const Body& body) {
    const Vector3d size = 1e3 * principal_extents(body);
    return fmt::format("{:.4g} x {:.4g} x {:.4g} mm along the principal axes", size.x(), size.y(), size.z());
}

/// The speed of a Reynolds number in a fluid, and the density with which the body falls broadside at it, by
/// the tables.
std::string density_in(const Body& body, const char* name, double reynolds_number) {
    const Fluid fluid = *fluid_preset(name);
    const LoadTables& tables = *body.tables;
    const Vector3d broadside = principal_axes(body.moments).col(0);
    const double speed = reynolds_number * fluid.kinematic_viscosity() / tables.reference_length;
    const double area = 0.25 * std::numbers::pi * tables.reference_length * tables.reference_length;
    const double drag = std::abs(look_up(tables, broadside, reynolds_number).force.dot(broadside));
    const double excess = 0.5 * drag * fluid.density * speed * speed * area / (9.81 * body.moments.volume);
    return fmt::format("{:.3g} m/s in {}, as with a density of {} kg/m³", speed, name,
                       in_plain_digits(fluid.density + excess));
}

ReportPart part_of_body(const Body& body) {
    const LoadTables& tables = *body.tables;
    Rows rows = {
        {"shape", body.source},
        {"size", size_of(body)},
        {"surface",
         fmt::format("{} triangles of order {}", body.surface.triangle_count(), body.surface.order())},
        {"volume, area", fmt::format("{:.4g} m³, {:.4g} m²", body.moments.volume, body.moments.surface_area)},
        {"symmetry",
         fmt::format("{}, {} elements", name_of(body.symmetry.type), body.symmetry.elements.size())},
        {"reference length L", fmt::format("{:.5g} m", tables.reference_length)}};
    if (body.kirchhoff) {
        const Matrix6d& added = body.kirchhoff->matrix;
        rows.push_back(
            {"added mass",
             fmt::format("{}, estimated error {:.2g} %, {}",
                         in_words(Vector3d(1e3 * added.diagonal().tail<3>()), " g in a fluid of 1 kg/m³"),
                         100.0 * body.kirchhoff->error_estimate, body.kirchhoff->method)});
    }
    if (body.mass) {
        const MassProperties mass = mass_properties(body, *body.mass);
        rows.push_back(
            {"mass, where none is said", fmt::format("{:.4g} g, {:.4g} kg/m³ on average", 1e3 * mass.mass,
                                                     mass.mass / body.moments.volume)});
    }
    std::vector<std::string> numbers;
    for (const double number : tables.reynolds_numbers) numbers.push_back(in_plain_digits(number));
    rows.push_back({"Reynolds numbers U L/ν", fmt::format("{}", fmt::join(numbers, ", "))});
    const double main = main_reynolds_number(tables, case_records(tables));
    for (const char* fluid : {"water", "air"}) {
        rows.push_back({fmt::format("at {:.6g}, broadside", main), density_in(body, fluid, main)});
    }
    return {"The body", {table_block({}, rows)}};
}

std::vector<nlohmann::json> error_blocks(const LoadTables& tables) {
    Rows rows;
    for (const ErrorShare& share : tables.error_sources) {
        rows.push_back({name_of(share.source), per_cent(share.force), per_cent(share.moment),
                        per_cent(share.turbulent_kinetic_energy), per_cent(share.dissipation_rate)});
    }
    if (rows.empty()) return {text_block("The file does not tell its errors by source.")};
    const auto total = [&](double ErrorShare::*quantity) {
        return per_cent(total_error(tables.error_sources, quantity));
    };
    rows.push_back({"together", total(&ErrorShare::force), total(&ErrorShare::moment),
                    total(&ErrorShare::turbulent_kinetic_energy), total(&ErrorShare::dissipation_rate)});
    return {
        text_block("Standard errors over the quantity, root mean squares over all directions and Reynolds "
                   "numbers."),
        table_block({"source", "force", "moment", "k", "epsilon"}, rows)};
}

std::string tensor_in_words(const Matrix3d& tensor, const char* unit) {
    return in_words(Vector3d(tensor.diagonal())) + ' ' + unit;
}

ReportPart part_of_rotation(const Body& body) {
    if (!body.dynamic) {
        return {"The turning body",
                {text_block("The file holds no coefficients of a turning body, for no "
                            "falls were solved. It flies with those that "
                            "bodies have in common (docs/studies/falls). Quality "
                            "standard solves falls and identifies its own.")}};
    }
    const auto& [values, errors, densities] = *body.dynamic;
    Rows rows;
    for (const NumberOfMotion& number : numbers_of_motion) {
        rows.push_back({number.title, fmt::format("{:.3g}", values.*number.member),
                        fmt::format("{:.2g}", errors.*number.member)});
    }
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        rows.push_back({tensor.title, tensor_in_words(values.*tensor.member, tensor.unit),
                        tensor_in_words(errors.*tensor.member, tensor.unit)});
    }
    rows.push_back({"density of the falling body, over the fluid's", in_words(densities), "-"});
    return {"The turning body",
            {text_block("From: " + values.origin),
             table_block({"coefficient (tensors: xx, yy, zz)", "value", "standard error"}, rows)}};
}

std::string or_dash(double number, const char* format) {
    return number > 0.0 ? fmt::format(fmt::runtime(format), number) : "-";
}

/// Where the solver's CPU seconds went, by mesh.
nlohmann::json table_of_cpu_seconds(const std::vector<CaseRecord>& records, double all) {
    std::map<double, std::pair<int, double>> meshes;
    for (const CaseRecord& one : records) {
        auto& [count, seconds] = meshes[one.cells];
        ++count;
        seconds += one.cpu_seconds;
    }
    Rows rows;
    for (const auto& [cells, spent] : meshes) {
        rows.push_back({or_dash(cells, "{:.0f}"), fmt::format("{}", spent.first),
                        fmt::format("{:.1f}", spent.second),
                        all > 0.0 ? fmt::format("{:.0f} %", 100.0 * spent.second / all) : "-"});
    }
    return table_block({"cells", "cases", "CPU s", "share"}, rows);
}

ReportPart part_of_cases(const LoadTables& tables) {
    const std::vector<CaseRecord> records = case_records(tables);
    ReportPart part{"The cases", {}};
    if (const auto left_out = left_out_cases(tables); !left_out.empty()) {
        Rows rows;
        for (const LeftOutCase& one : left_out) rows.push_back({one.name, one.reason});
        part.blocks.push_back(table_block({"left out", "why"}, rows));
    }
    Rows rows;
    for (const CaseRecord& one : records) {
        rows.push_back({one.name, one.purpose, in_words(one.direction), in_plain_digits(one.reynolds_number),
                        one.closure, or_dash(one.cells, "{:.0f}"), fmt::format("{:.3f}", one.drag),
                        one.k ? fmt::format("{:.3g}", *one.k) : "-", one.verdict,
                        or_dash(one.final_residual, "{:.1g}"), fmt::format("{:.1f}", one.cpu_seconds)});
    }
    if (rows.empty()) {
        part.blocks.push_back(text_block("The file does not say how its cases were solved."));
        return part;
    }
    double seconds = 0.0;
    for (const CaseRecord& one : records) seconds += one.cpu_seconds;
    part.blocks.push_back(table_of_cpu_seconds(records, seconds));
    part.blocks.push_back(
        folded_block(fmt::format("{} solved cases, {:.0f} CPU seconds", records.size(), seconds),
                     table_block({"case", "for", "moving along", "Reynolds", "closure", "cells", "drag",
                                  "k/U²", "verdict", "residual of p", "CPU s"},
                                 rows)));
    return part;
}

std::string joined(const std::set<std::string>& words) {
    return words.empty() ? "not said" : fmt::format("{}", fmt::join(words, ", "));
}

ReportPart part_of_provenance(const std::filesystem::path& path, const Body& body) {
    const Hdf5Reader file(path);
    std::set<std::string> programs;
    std::set<std::string> closures;
    std::set<std::string> remedies;
    for (const CaseRecord& one : case_records(*body.tables)) {
        if (!one.openfoam.empty()) programs.insert(one.openfoam);
        if (!one.closure.empty()) closures.insert(one.closure);
        if (!one.mesh_remedy.empty()) remedies.insert(one.mesh_remedy);
    }
    return {"Where it comes from",
            {table_block(
                {}, {{"file", path.filename().string()},
                     {"XXH3 128-bit hash", file_content_hash(path)},
                     {"digest of its content",
                      file.has_digest() ? "sound" : "none: 'samara check --add-digest' writes one"},
                     {"written by", fmt::format("samara {}", file.text_attribute("/", "samara_version"))},
                     {"quality", body.tables->quality},
                     {"solver", joined(programs)},
                     {"closures", joined(closures)},
                     {"meshes made", joined(remedies)}})}};
}

}  // namespace

std::vector<ReportPart> body_parts(const std::filesystem::path& file, const Body& body) {
    std::vector<nlohmann::json> convergence = error_blocks(*body.tables);
    convergence.insert(
        convergence.begin(),
        picture_block("Drag and k over the meshes, drag over Reynolds numbers, errors by source",
                      body_picture("convergence", body)));
    return {part_of_body(body),
            {"Polars",
             {picture_block("Drag, lift, moment and k against the direction of motion, with standard errors",
                            body_picture("polars", body)),
              text_block("Coefficients on ρU²A/2 with A = πL²/4, the moment's also on L. The direction of "
                         "motion turns in the plane of two principal axes; 0° is along the shorter one. Dots "
                         "are solved cases.")}},
            {"All directions",
             {picture_block("Drag, moment, k and the force's standard error over the sphere of directions",
                            body_picture("sphere", body))}},
            {"Convergence and errors", convergence},
            part_of_rotation(body),
            part_of_cases(*body.tables),
            part_of_provenance(file, body)};
}

}  // namespace samara
