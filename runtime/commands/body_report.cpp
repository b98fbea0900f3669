#include "samara/commands/body_report.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/analysis/advice/input_warnings.hpp"
#include "samara/analysis/advice/model_judgement.hpp"
#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/commands/table_errors_report.hpp"
#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/body.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

/// Summary of the provenance of a table's cases.
struct ProvenanceSummary {
    std::size_t cases = 0;
    /// Each key of the cases, with its one value, its range, or how many values it takes.
    std::vector<std::pair<std::string, std::string>> keys;
};

using Values = std::vector<nlohmann::json>;

std::string values_in_words(const nlohmann::json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string values_in_words(const Values& values) {
    const std::set<nlohmann::json> distinct(values.begin(), values.end());
    if (distinct.size() == 1) return values_in_words(values.front());
    const bool numbers = std::all_of(values.begin(), values.end(),
                                     [](const nlohmann::json& value) { return value.is_number(); });
    if (!numbers) return fmt::format("{} different", distinct.size());
    return fmt::format("{:.6g} to {:.6g}", distinct.begin()->get<double>(), distinct.rbegin()->get<double>());
}

/// Summarises a JSON array with one object a case. A text that is no such array gives no cases.
ProvenanceSummary summarise_provenance(std::string_view json) {
    const nlohmann::json cases = parse_json_or_discard(json);
    ProvenanceSummary summary;
    if (!cases.is_array()) return summary;
    std::map<std::string, Values> values;
    for (const nlohmann::json& one : cases) {
        if (!one.is_object()) return {};
        for (const auto& [key, value] : one.items()) values[key].push_back(value);
    }
    summary.cases = cases.size();
    for (const auto& [key, list] : values) summary.keys.emplace_back(key, values_in_words(list));
    return summary;
}

template <typename... Values>
void print_row(const char* name, fmt::format_string<Values...> format, Values&&... values) {
    print_result("  {:<26}{}\n", name, fmt::format(format, std::forward<Values>(values)...));
}

std::string in_words(const Vector3d& vector) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", vector.x(), vector.y(), vector.z());
}

std::string in_words(const Symmetry& symmetry) {
    const std::string group = fmt::format("{} element{}", symmetry.elements.size(),
                                          symmetry.elements.size() == 1 ? " (only the identity)" : "s");
    switch (symmetry.type) {
        case Symmetry::Type::spherical:
            return "every rotation";
        case Symmetry::Type::axial:
            return fmt::format("every rotation about {}, and {}", in_words(symmetry.axis), group);
        default:
            return group;
    }
}

/// One quantity of the tables: the largest value, and the range of its standard errors.
struct TableRange {
    const char* name;
    const char* scale;
    double largest;
    double least_error;
    double most_error;
};

template <typename Value>
TableRange range_of(const char* name, const char* scale, const LoadTables& tables, const Value& value) {
    TableRange range{name, scale, 0.0, std::numeric_limits<double>::infinity(), 0.0};
    for (const LoadEntry& entry : tables.entries) range.largest = std::max(range.largest, value(entry));
    for (const LoadEntryError& error : tables.errors) {
        range.least_error = std::min(range.least_error, value(error));
        range.most_error = std::max(range.most_error, value(error));
    }
    return range;
}

std::vector<TableRange> ranges_of(const LoadTables& tables) {
    return {
        range_of("force", "rho U^2 A / 2", tables, [](const LoadEntry& e) { return e.force.norm(); }),
        range_of("moment", "rho U^2 A L / 2", tables, [](const LoadEntry& e) { return e.moment.norm(); }),
        range_of("turbulent_kinetic_energy", "U^2", tables,
                 [](const LoadEntry& e) { return e.turbulent_kinetic_energy; }),
        range_of("dissipation_rate", "U^3 / L", tables,
                 [](const LoadEntry& e) { return e.dissipation_rate; }),
    };
}

/// Returns the number of different directions of an octahedral map's nodes: an octahedron cut into n has 4
/// n^2 + 2.
int direction_count(const LoadTables& tables) {
    return 4 * tables.subdivisions * tables.subdivisions + 2;
}

void print_kirchhoff(const KirchhoffTensor& kirchhoff) {
    print_result("Kirchhoff tensor (fluid of 1 kg/m^3, about the centroid, shape axes)\n");
    print_row("added inertia", "{} kg m^2", in_words(Vector3d(kirchhoff.matrix.diagonal().head<3>())));
    print_row("added mass", "{} kg", in_words(Vector3d(kirchhoff.matrix.diagonal().tail<3>())));
    print_row("error estimate", "{:.2g} %, asymmetry {:.2g} %", 100.0 * kirchhoff.error_estimate,
              100.0 * kirchhoff.asymmetry);
    print_row("method", "{}, {} triangles", kirchhoff.method, kirchhoff.triangles);
}

constexpr int print_subdivisions = 8;  // of the grid of directions on which the largest value is sought

/// Returns the largest force and moment of a steady translation by pressure (rho U^2 A / 2, and times L).
PressureLoads largest_of(const SurfaceLoads& loads) {
    PressureLoads largest;
    for (const PressureLoads& load : pressure_loads(loads, print_subdivisions)) {
        if (load.force.norm() > largest.force.norm()) largest.force = load.force;
        if (load.moment.norm() > largest.moment.norm()) largest.moment = load.moment;
    }
    return largest;
}

void print_surface_loads(const SurfaceLoads& loads) {
    const auto [force, moment] = largest_of(loads);
    print_result("Surface loads, estimated from potential flow (docs/explanation/loads-without-a-bake.md)\n");
    print_row("force", "up to {:.3g} (rho U^2 A / 2)", force.norm());
    print_row("moment", "up to {:.3g} (rho U^2 A L / 2)", moment.norm());
}

void print_table_errors(const LoadTables& tables) {
    if (tables.error_sources.empty()) {
        print_row("standard errors include", "{}", error_sources_in_words(tables));
    } else {
        print_result("  {:<26}{:>10}{:>10}{:>10}{:>10}\n", "standard error (rms) from", "force", "moment",
                     "k", "epsilon");
    }
    for (const ErrorShare& share : tables.error_sources) {
        print_result("    {:<24}{:>8.2g} %{:>8.2g} %{:>8.2g} %{:>8.2g} %\n", name_of(share.source),
                     100.0 * share.force, 100.0 * share.moment, 100.0 * share.turbulent_kinetic_energy,
                     100.0 * share.dissipation_rate);
    }
    for (const LeftOutCase& one : left_out_cases(tables))
        print_row("left out", "{}: {}", one.name, one.reason);
}

void print_tables(const LoadTables& tables) {
    print_result("Tables\n");
    print_row("quality", "{}", tables.quality);
    print_row("reference length L", "{:.6g} m", tables.reference_length);
    std::string reynolds_numbers;
    for (const double number : tables.reynolds_numbers) reynolds_numbers += fmt::format("{:.6g} ", number);
    print_row("Reynolds numbers", "{}", reynolds_numbers);
    if (const std::string warning = drag_crisis_warning(tables.reynolds_numbers.back()); !warning.empty()) {
        print_row("warning", "{}", warning);
    }
    print_row("directions", "{} (octahedron cut into {})", direction_count(tables), tables.subdivisions);
    for (const TableRange& range : ranges_of(tables)) {
        print_row(range.name, "up to {:.3g} ({}), standard error {:.2g} to {:.2g}", range.largest,
                  range.scale, range.least_error, range.most_error);
    }
    print_table_errors(tables);
    const ProvenanceSummary provenance = summarise_provenance(tables.provenance);
    print_row("cases", "{}", provenance.cases);
    for (const auto& [key, value] : provenance.keys) print_row(("  " + key).c_str(), "{}", value);
}

std::string off_diagonal_in_words(const Matrix3d& tensor) {
    return in_words(Vector3d(tensor(0, 1), tensor(1, 2), tensor(2, 0)));
}

void print_tensor(const char* name, const char* unit, const Matrix3d& tensor, const Matrix3d& errors) {
    print_row(name, "{} +- {} {}", in_words(Vector3d(tensor.diagonal())),
              in_words(Vector3d(errors.diagonal())), unit);
    if (tensor.isDiagonal(1e-12) && errors.isDiagonal(1e-12)) return;
    print_row("  xy, yz, zx", "{} +- {} {}", off_diagonal_in_words(tensor), off_diagonal_in_words(errors),
              unit);
}

void print_dynamic(const IdentifiedCoefficients& dynamic) {
    const auto& [values, errors, densities] = dynamic;
    print_result("Dynamic coefficients, +- standard errors (body axes, about the centroid)\n");
    print_row("origin", "{}", values.origin);
    for (const NumberOfMotion& number : numbers_of_motion) {
        print_row(number.title, "{:.3g} +- {:.2g}", values.*number.member, errors.*number.member);
    }
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        print_tensor(tensor.title, tensor.unit, values.*tensor.member, errors.*tensor.member);
    }
    print_row("half-length", "{:.6g} m", values.half_length);
    print_row("density of falls", "{} (over the fluid's)", in_words(densities));
}

nlohmann::json numbers_as_json(const DynamicCoefficients& numbers) {
    nlohmann::json json;
    for (const NumberOfMotion& number : numbers_of_motion) json[number.name] = numbers.*number.member;
    for (const TensorOfMotion& tensor : tensors_of_motion)
        json[tensor.name] = rows_as_json(numbers.*tensor.member);
    return json;
}

nlohmann::json dynamic_as_json(const IdentifiedCoefficients& dynamic) {
    nlohmann::json result = numbers_as_json(dynamic.values);
    result["half_length"] = dynamic.values.half_length;
    result["origin"] = dynamic.values.origin;
    result["standard_errors"] = numbers_as_json(dynamic.standard_errors);
    const auto& [lowest, highest] = dynamic.densities;
    result["densities"] = lowest > 0.0 ? nlohmann::json{lowest, highest} : nlohmann::json();
    return result;
}

nlohmann::json tables_as_json(const LoadTables& tables) {
    nlohmann::json result = {
        {"quality", tables.quality},
        {"reference_length", tables.reference_length},
        {"reynolds_numbers", tables.reynolds_numbers},
        {"subdivisions", tables.subdivisions},
        {"directions", direction_count(tables)},
    };
    for (const TableRange& range : ranges_of(tables)) {
        result["ranges"][range.name] = {{"largest", range.largest},
                                        {"least_error", range.least_error},
                                        {"most_error", range.most_error},
                                        {"unit", range.scale}};
    }
    result["error_sources"] = nlohmann::json::object();
    for (const ErrorShare& share : tables.error_sources) {
        result["error_sources"][name_of(share.source)] = {
            {"force", share.force},
            {"moment", share.moment},
            {"turbulent_kinetic_energy", share.turbulent_kinetic_energy},
            {"dissipation_rate", share.dissipation_rate}};
    }
    result["left_out"] = nlohmann::json::array();
    for (const LeftOutCase& one : left_out_cases(tables)) {
        result["left_out"].push_back({{"name", one.name}, {"reason", one.reason}});
    }
    result["provenance"] = parse_json_or_discard(tables.provenance);
    if (result["provenance"].is_discarded()) result["provenance"] = nullptr;
    result["cases"] = summarise_provenance(tables.provenance).cases;
    return result;
}

nlohmann::json recommended_as_json(const RecommendedModels& models) {
    return {{"loads", name_of(models.loads)},
            {"patches", models.patches},
            {"turbulence", name_of(models.turbulence)},
            {"origin", models.origin}};
}

nlohmann::json mass_as_json(const Body& body) {
    const MassProperties mass = mass_properties(body, *body.mass);
    return {{"density", or_null(body.mass->density)},
            {"area_density", or_null(body.mass->area_density)},
            {"mass", mass.mass},
            {"center_of_mass", as_json(mass.center_of_mass)},
            {"inertia", rows_as_json(mass.inertia)}};
}

}  // namespace

void print_recommended(const Body& body) {
    const RecommendedModels& models = *body.recommended;
    print_row("default models", "{} ({})", in_words(models), models.origin);
}

void print_mass(const Body& body) {
    const MassProperties mass = mass_properties(body, *body.mass);
    std::string uniform;
    if (body.mass->density) uniform = fmt::format(", uniform, {:.6g} kg/m^3", *body.mass->density);
    if (body.mass->area_density)
        uniform = fmt::format(", uniform, {:.6g} g/m^2", *body.mass->area_density / gram);
    print_row("default mass", "{:.6g} kg{}", mass.mass, uniform);
    if (!uniform.empty()) return;
    print_row("  centre of mass", "{} m", in_words(mass.center_of_mass));
    print_row("  principal inertia", "{} kg m^2", in_words(eigenvalues_of(mass.inertia)));
}

void print_body(const Body& body) {
    const VolumeMoments& moments = body.moments;
    print_result("Body {} (metres, shape axes)\n", body.name);
    print_row("source", "{}", body.source);
    print_row("surface", "{} triangles of order {}, {} vertices", body.surface.triangle_count(),
              body.surface.order(), body.surface.vertices.size());
    print_row("volume", "{:.6g} m^3", moments.volume);
    print_row("centroid", "{} m", in_words(moments.centroid));
    print_row("surface area", "{:.6g} m^2", moments.surface_area);
    print_row("principal extents", "{} m", in_words(principal_extents(body)));
    print_row("symmetry", "{}", in_words(body.symmetry));
    if (body.mass) print_mass(body);
    if (body.recommended) print_recommended(body);
    if (body.kirchhoff) {
        print_kirchhoff(*body.kirchhoff);
    } else {
        print_result("No Kirchhoff tensor: 'samara kirchhoff' computes it\n");
    }
    if (body.surface_loads) print_surface_loads(*body.surface_loads);
    if (body.tables) {
        print_tables(*body.tables);
    } else {
        print_result("No tables: 'samara bake' computes them\n");
    }
    if (body.dynamic) {
        print_dynamic(*body.dynamic);
    } else {
        print_result("No dynamic coefficients: 'samara simulate' uses defaults\n");
    }
}

nlohmann::json body_as_json(const Body& body) {
    const VolumeMoments& moments = body.moments;
    nlohmann::json result = {
        {"kind", "body"},
        {"name", body.name},
        {"source", body.source},
        {"triangles", body.surface.triangle_count()},
        {"order", body.surface.order()},
        {"volume", moments.volume},
        {"centroid", as_json(moments.centroid)},
        {"surface_area", moments.surface_area},
        {"principal_extents", as_json(principal_extents(body))},
        {"symmetry", {{"kind", name_of(body.symmetry.type)}, {"elements", body.symmetry.elements.size()}}},
        {"mass", nullptr},
        {"recommended", nullptr},
        {"kirchhoff", nullptr},
        {"surface_loads", nullptr},
        {"tables", nullptr},
        {"dynamic_coefficients", nullptr},
    };
    if (body.symmetry.type == Symmetry::Type::axial) result["symmetry"]["axis"] = as_json(body.symmetry.axis);
    if (body.mass) result["mass"] = mass_as_json(body);
    if (body.recommended) result["recommended"] = recommended_as_json(*body.recommended);
    if (body.kirchhoff) {
        result["kirchhoff"] = {{"added_mass", rows_as_json(body.kirchhoff->matrix)},
                               {"error_estimate", body.kirchhoff->error_estimate},
                               {"asymmetry", body.kirchhoff->asymmetry},
                               {"triangles", body.kirchhoff->triangles},
                               {"method", body.kirchhoff->method}};
    }
    if (body.surface_loads) {
        const auto [force, moment] = largest_of(*body.surface_loads);
        result["surface_loads"] = {{"largest_force", force.norm()}, {"largest_moment", moment.norm()}};
    }
    if (body.tables) result["tables"] = tables_as_json(*body.tables);
    if (body.dynamic) result["dynamic_coefficients"] = dynamic_as_json(*body.dynamic);
    return result;
}

}  // namespace samara
