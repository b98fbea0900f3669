#include "converter/case_plan.hpp"

#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/base/content_hash.hpp"
#include "samara/base/error.hpp"

namespace samara {
namespace {

Error fault(const std::filesystem::path& file, const std::string& what) {
    return Error(fmt::format("{}: {}; make the cases again with 'samara bake'", file.string(), what));
}

nlohmann::json read_json(const std::filesystem::path& file) {
    try {
        return nlohmann::json::parse(read_bytes(file));
    } catch (const nlohmann::json::exception& reason) {
        throw fault(file, fmt::format("is no JSON ({})", reason.what()));
    }
}

Vector3d as_vector(const nlohmann::json& values) {
    const auto numbers = values.get<std::array<double, 3>>();
    return {numbers[0], numbers[1], numbers[2]};
}

constexpr std::array<std::pair<CasePurpose, const char*>, 4> purposes = {{{CasePurpose::table, "table"},
                                                                          {CasePurpose::mesh, "mesh"},
                                                                          {CasePurpose::closure, "closure"},
                                                                          {CasePurpose::start, "start"}}};

CasePurpose as_purpose(const std::string& word) {
    for (const auto& [purpose, name] : purposes) {
        if (word == name) return purpose;
    }
    throw Error(fmt::format("'purpose' is \"{}\", not table, mesh, closure or start", word));
}

PlannedCase as_case(const nlohmann::json& values) {
    return {values.at("name").get<std::string>(),         as_vector(values.at("direction")),
            values.at("reynolds_number").get<double>(),   values.value("mesh", "mesh"),
            as_purpose(values.value("purpose", "table")), values.value("closure", "")};
}

CasePlan as_plan(const nlohmann::json& values) {
    CasePlan plan;
    plan.quality = values.at("quality").get<std::string>();
    plan.subdivisions = values.at("subdivisions").get<int>();
    plan.reference_length = values.at("reference_length").get<double>();
    for (int row = 0; row < 3; ++row) {
        plan.axes.row(row) = as_vector(values.at("axes").at(static_cast<std::size_t>(row)));
    }
    for (const nlohmann::json& entry : values.at("cases")) plan.cases.push_back(as_case(entry));
    return plan;
}

void check(const std::filesystem::path& file, const CasePlan& plan) {
    const bool rotation = (plan.axes.transpose() * plan.axes - Matrix3d::Identity()).norm() < 1e-6 &&
                          plan.axes.determinant() > 0.0;
    if (!rotation) throw fault(file, "'axes' is no rotation");
    if (plan.subdivisions < 1 || plan.subdivisions > 1024) throw fault(file, "'subdivisions' is not sane");
    if (!(plan.reference_length > 0.0)) throw fault(file, "'reference_length' is not positive");
    if (plan.cases.empty()) throw fault(file, "'cases' is empty");
    std::set<std::string> names;
    for (const PlannedCase& planned : plan.cases) {
        if (!names.insert(planned.name).second) throw fault(file, "two cases are named " + planned.name);
        if (!(std::abs(planned.direction.norm() - 1.0) < 1e-6)) {
            throw fault(file, "the direction of case " + planned.name + " is no unit vector");
        }
        if (!(planned.reynolds_number > 0.0)) {
            throw fault(file, "the Reynolds number of case " + planned.name + " is not positive");
        }
    }
}

}  // namespace

std::string name_of(CasePurpose purpose) {
    for (const auto& [one, name] : purposes) {
        if (one == purpose) return name;
    }
    return {};
}

CasePlan read_case_plan(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "plan.json";
    if (!std::filesystem::is_directory(folder)) {
        throw Error(fmt::format("{}: is no folder; give the folder NAME.cases that 'samara bake' made",
                                folder.string()));
    }
    if (!std::filesystem::exists(file)) {
        throw Error(
            fmt::format("{}: is no folder of cases (it has no plan.json); give the folder NAME.cases that "
                        "'samara bake' made",
                        folder.string()));
    }
    const nlohmann::json values = read_json(file);
    CasePlan plan;
    try {
        plan = as_plan(values);
    } catch (const nlohmann::json::exception& reason) {
        throw fault(file, fmt::format("an entry is missing or of the wrong kind ({})", reason.what()));
    } catch (const Error& reason) {
        throw fault(file, reason.what());
    }
    check(file, plan);
    return plan;
}

}  // namespace samara
