#include "converter/cases/case_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/core/base/error.hpp"
#include "samara/core/base/text.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

constexpr std::pair<Closure, std::string_view> closures[] = {
    {Closure::unsaid, ""},
    {Closure::laminar, "laminar"},
    {Closure::k_epsilon, "kEpsilon"},
    {Closure::realizable_k_epsilon, "realizableKE"},
    {Closure::rng_k_epsilon, "RNGkEpsilon"},
    {Closure::launder_sharma_k_epsilon, "LaunderSharmaKE"},
    {Closure::k_omega, "kOmega"},
    {Closure::k_omega_sst, "kOmegaSST"},
    {Closure::k_omega_sst_lm, "kOmegaSSTLM"},
    {Closure::k_omega_sst_ddes, "kOmegaSSTDDES"},
    {Closure::spalart_allmaras, "SpalartAllmaras"},
    {Closure::other, "other"}};

}  // namespace

std::string_view name_of(Closure closure) {
    return std::ranges::find(closures, closure, &std::pair<Closure, std::string_view>::first)->second;
}

Closure closure_of(std::string_view name) {
    const auto* const found =
        std::ranges::find(closures, name, &std::pair<Closure, std::string_view>::second);
    return found == std::end(closures) ? Closure::other : found->first;
}

bool solves_for_omega(Closure closure) {
    return name_of(closure).starts_with("kOmega");
}

namespace {

Error error(const std::filesystem::path& file, const std::string& what) {
    return Error(
        fmt::format("{}: {}; make the cases again with 'samara bake', or correct the plan if you wrote it",
                    file.string(), what));
}

nlohmann::json read_json(const std::filesystem::path& file) {
    const std::string bytes = read_bytes(file);
    try {
        return parse_json(bytes);
    } catch (const Error& reason) {
        throw error(file, reason.what());
    }
}

constexpr std::array<std::pair<CasePurpose, const char*>, 5> purposes = {
    {{CasePurpose::table, "table"},
     {CasePurpose::mesh, "mesh"},
     {CasePurpose::closure, "closure"},
     {CasePurpose::turbulence, "turbulence"},
     {CasePurpose::start, "start"}}};

CaseScales as_scales(const nlohmann::json& values, const CaseScales& defaults) {
    return {values.value("length", defaults.length), values.value("speed", defaults.speed),
            values.value("density", defaults.density)};
}

/// Throws where the object has a key that is none of the words: a misspelt one would be ignored.
void require_known_keys(const nlohmann::json& values, const std::string& where,
                        const std::vector<std::string>& known) {
    if (!values.is_object()) return;  // reading the entries reports it
    for (const auto& [key, value] : values.items()) {
        if (std::ranges::find(known, key) != known.end()) continue;
        throw Error(
            fmt::format("{} has the unknown key '{}'{}", where, printable(key), did_you_mean(key, known)));
    }
}

/// Throws where the name of a folder leads out of the folder of cases.
void require_inside(const std::string& name, const char* what) {
    const std::filesystem::path path(name);
    const bool goes_up = std::ranges::find(path, "..") != path.end();
    if (!name.empty() && path.is_relative() && !goes_up) return;
    throw Error(
        fmt::format("the {} '{}' is not the name of a folder beside plan.json", what, printable(name)));
}

PlannedCase as_case(const nlohmann::json& values, const CasePlan& plan, const CaseScales& scales) {
    require_known_keys(values, "a case",
                       {"name", "direction", "reynolds_number", "mesh", "purpose", "closure", "start_from",
                        "turbulence_from", "averaging_start", "length", "speed", "density", "inputs_hash"});
    PlannedCase planned{values.at("name").get<std::string>(), vector_of(values.at("direction")),
                        values.at("reynolds_number").get<double>()};
    planned.direction = plan.to_map_axes() * planned.direction;
    planned.mesh = values.value("mesh", planned.mesh);
    planned.purpose = purpose_of(values.value("purpose", "table"));
    planned.closure = closure_of(values.value("closure", ""));
    planned.scales = as_scales(values, scales);
    planned.turbulence_from = values.value("turbulence_from", "");
    if (values.contains("averaging_start")) planned.averaging_start = values["averaging_start"].get<double>();
    return planned;
}

bool solved_by_user(const nlohmann::json& values) {
    const std::string who = values.value("solved_by", "samara");
    if (who != "samara" && who != "user") {
        throw Error(fmt::format("'solved_by' is \"{}\", not samara or user", who));
    }
    return who == "user";
}

CasePlan as_plan(const nlohmann::json& values, const std::filesystem::path& folder) {
    require_known_keys(values, "the plan",
                       {"solved_by", "quality", "subdivisions", "reference_length", "ranks", "covers", "axes",
                        "case_axes", "length", "speed", "density", "meshes", "cases", "falls"});
    CasePlan plan;
    plan.solved_by_user = solved_by_user(values);
    plan.quality =
        plan.solved_by_user ? values.value("quality", "user") : values.at("quality").get<std::string>();
    plan.subdivisions = values.at("subdivisions").get<int>();
    plan.covers_scene = values.value("covers", "all") == "scene";
    std::optional<Body> body;
    if (plan.solved_by_user && !(values.contains("reference_length") && values.contains("axes"))) {
        body = read_body_file(folder / "body.body.h5");
    }
    plan.reference_length = body && !values.contains("reference_length")
                                ? reference_length(body->moments.surface_area)
                                : values.at("reference_length").get<double>();
    plan.axes = body && !values.contains("axes") ? body->symmetry.axes : matrix_of(values.at("axes"));
    plan.case_axes = values.contains("case_axes") ? matrix_of(values["case_axes"]) : plan.axes;
    const CaseScales scales = as_scales(values, {});
    for (const nlohmann::json& entry : values.at("cases")) plan.cases.push_back(as_case(entry, plan, scales));
    if (values.contains("falls")) {
        for (const nlohmann::json& entry : values["falls"]) {
            PlannedFall fall{entry.at("name").get<std::string>()};
            fall.mesh = entry.value("mesh", fall.mesh);
            plan.falls.push_back(std::move(fall));
        }
    }
    return plan;
}

void check_case(const PlannedCase& planned) {
    require_inside(planned.name, "case");
    require_inside(planned.mesh, "mesh");
    const auto reject = [&](const char* what) {
        return Error(fmt::format("the {} of case {} is not positive", what, planned.name));
    };
    if (!(std::abs(planned.direction.norm() - 1.0) < 1e-6)) {
        throw Error(fmt::format("the direction of case {} is not a unit vector", planned.name));
    }
    if (!(planned.reynolds_number > 0.0)) throw reject("Reynolds number");
    if (!(planned.scales.length > 0.0)) throw reject("length");
    if (!(planned.scales.speed > 0.0)) throw reject("speed");
    if (!(planned.scales.density > 0.0)) throw reject("density");
}

bool are_of_one_flow(const PlannedCase& a, const PlannedCase& b) {
    return a.reynolds_number == b.reynolds_number && (a.direction - b.direction).norm() <= 1e-6;
}

/// Whether two cases have the same flow and purpose (and mesh and closure, unless they are for the table).
bool are_same(const PlannedCase& a, const PlannedCase& b) {
    if (a.purpose != b.purpose || !are_of_one_flow(a, b)) return false;
    return a.purpose == CasePurpose::table || (a.mesh == b.mesh && a.closure == b.closure);
}

void check_cases(const std::vector<PlannedCase>& cases) {
    if (cases.empty()) throw Error("'cases' is empty");
    std::set<std::string> names;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        check_case(cases[i]);
        if (!names.insert(cases[i].name).second) throw Error("two cases are named " + cases[i].name);
        for (std::size_t j = 0; j < i; ++j) {
            if (!are_same(cases[i], cases[j])) continue;
            throw Error(
                fmt::format("the cases {} and {} have the same direction, Reynolds number and purpose",
                            cases[j].name, cases[i].name));
        }
    }
}

void check_turbulence(const std::vector<PlannedCase>& cases) {
    for (const PlannedCase& planned : cases) {
        if (planned.turbulence_from.empty()) continue;
        const auto found = std::ranges::find(cases, planned.turbulence_from, &PlannedCase::name);
        if (found == cases.end() || found->purpose != CasePurpose::turbulence ||
            !are_of_one_flow(*found, planned)) {
            throw Error(
                fmt::format("the case {} takes its turbulence from {}, which is not a case with purpose "
                            "turbulence and the same direction and Reynolds number",
                            planned.name, planned.turbulence_from));
        }
    }
}

void check_falls(const CasePlan& plan) {
    std::set<std::string> names;
    for (const PlannedCase& planned : plan.cases) names.insert(planned.name);
    for (const PlannedFall& fall : plan.falls) {
        require_inside(fall.name, "fall");
        require_inside(fall.mesh, "mesh");
        if (!names.insert(fall.name).second) throw Error("two cases or falls are named " + fall.name);
    }
}

void check(const CasePlan& plan) {
    const auto is_rotation = [](const Matrix3d& axes) {
        return (axes.transpose() * axes - Matrix3d::Identity()).norm() < 1e-6 && axes.determinant() > 0.0;
    };
    if (!is_rotation(plan.axes)) throw Error("'axes' is not a rotation");
    if (!is_rotation(plan.case_axes)) throw Error("'case_axes' is not a rotation");
    if (plan.subdivisions < 1 || plan.subdivisions > 1024)
        throw Error("'subdivisions' is not from 1 to 1024");
    if (!(plan.reference_length > 0.0)) throw Error("'reference_length' is not positive");
    check_cases(plan.cases);
    check_turbulence(plan.cases);
    check_falls(plan);
}

}  // namespace

CasePurpose purpose_of(const std::string& name) {
    for (const auto& [purpose, word] : purposes) {
        if (word == name) return purpose;
    }
    throw Error(fmt::format("'purpose' is \"{}\", not table, mesh, closure, turbulence or start", name));
}

std::string name_of(CasePurpose purpose) {
    for (const auto& [one, name] : purposes) {
        if (one == purpose) return name;
    }
    return {};
}

CasePlan read_case_plan(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "plan.json";
    if (!std::filesystem::is_directory(folder)) {
        throw Error(fmt::format("{}: is not a folder; give the folder NAME.cases that 'samara bake' made",
                                folder.string()));
    }
    if (!std::filesystem::exists(file)) {
        throw Error(
            fmt::format("{}: is not a folder of cases (it has no plan.json); give the folder NAME.cases that "
                        "'samara bake' made",
                        folder.string()));
    }
    require_links_within(folder);
    const nlohmann::json values = read_json(file);
    try {
        CasePlan plan = as_plan(values, folder);
        check(plan);
        return plan;
    } catch (const nlohmann::json::exception& reason) {
        throw error(file, fmt::format("an entry is missing or of the wrong type ({})", reason.what()));
    } catch (const Error& reason) {
        throw error(file, reason.what());
    }
}

namespace {

namespace fs = std::filesystem;

/// Returns where a link leads, whether or not anything exists there; empty for a link to itself.
fs::path end_of(const fs::path& link) {
    std::error_code error;
    const fs::path end = fs::weakly_canonical(link.parent_path() / fs::read_symlink(link, error), error);
    return error ? fs::path() : end;
}

}  // namespace

void require_links_within(const fs::path& folder) {
    std::error_code unreadable;
    const fs::path root = fs::canonical(folder, unreadable);
    if (unreadable) return;  // its reader says why
    for (fs::recursive_directory_iterator entry(folder, unreadable), end; !unreadable && entry != end;
         entry.increment(unreadable)) {
        const fs::file_type type = entry->symlink_status(unreadable).type();
        if (type == fs::file_type::symlink) {
            const fs::path inside = end_of(entry->path()).lexically_relative(root);
            if (!inside.empty() && *inside.begin() != "..") continue;
            throw Error(fmt::format(
                "{}: is a link to outside of {}, which is not followed; replace it by a copy, or remove it",
                entry->path().string(), folder.string()));
        }
        if (type != fs::file_type::regular && type != fs::file_type::directory) {
            throw Error(fmt::format("{}: is neither a file nor a folder; remove it", entry->path().string()));
        }
    }
}

}  // namespace samara
