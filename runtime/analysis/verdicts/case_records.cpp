#include "samara/analysis/verdicts/case_records.hpp"

#include <map>

#include <nlohmann/json.hpp>

#include "samara/core/base/error.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

using Json = nlohmann::json;

std::string text_of(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

std::optional<double> number_of(const Json& object, const char* key) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number()) return std::nullopt;
    return found->get<double>();
}

/// Returns the object under the key, an empty one where there is none.
Json object_of(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_object() ? *found : Json::object();
}

/// Returns the mean of k of a case that has its own.
std::optional<double> k_of(const Json& one) {
    const Json* const means = turbulence_means(one);
    return means == nullptr ? std::nullopt : number_of(*means, "k");
}

std::optional<Vector3d> direction_of(const Json& object) {
    const auto found = object.find("direction");
    if (found == object.end() || !found->is_array() || found->size() != 3) return std::nullopt;
    for (const Json& number : *found) {
        if (!number.is_number()) return std::nullopt;
    }
    const Vector3d direction = vector_of(*found);
    if (!(direction.norm() > 0.0)) return std::nullopt;
    return direction.normalized();
}

std::optional<CaseRecord> record_of(const Json& one, const Matrix3d& axes) {
    if (!one.is_object()) return std::nullopt;
    const auto direction = direction_of(one);
    const auto reynolds_number = number_of(one, "reynolds_number");
    const auto drag = number_of(one, "drag_coefficient");
    if (!direction || !reynolds_number || !drag) return std::nullopt;
    const Json mesh = object_of(one, "mesh");
    CaseRecord record{.name = text_of(one, "name"),
                      .purpose = text_of(one, "purpose"),
                      .direction = axes * *direction,
                      .reynolds_number = *reynolds_number,
                      .drag = *drag,
                      .k = k_of(one),
                      .cells = number_of(mesh, "cells").value_or(0.0),
                      .closure = text_of(one, "closure"),
                      .verdict = text_of(one, "verdict"),
                      .mesh_verdict = text_of(mesh, "verdict"),
                      .mesh_remedy = text_of(mesh, "remedy"),
                      .openfoam = text_of(one, "openfoam"),
                      .cpu_seconds = number_of(one, "cpu_seconds").value_or(0.0),
                      .final_residual = number_of(object_of(one, "final_residuals"), "p").value_or(0.0)};
    // Where loads and turbulence come from different closures, k belongs to another case.
    if (const Json other = object_of(one, "turbulence"); !other.empty()) {
        record.k = k_of(other);
    }
    return record;
}

}  // namespace

const Json* turbulence_means(const Json& provenance) {
    for (const char* key : {"near_wake", "shell"}) {
        const auto found = provenance.find(key);
        if (found != provenance.end() && found->is_object()) return &*found;
    }
    return nullptr;
}

std::vector<CaseRecord> case_records(const LoadTables& tables) {
    const Json cases = parse_json_or_discard(tables.provenance);
    std::vector<CaseRecord> records;
    if (!cases.is_array()) return records;
    for (const Json& one : cases) {
        if (auto record = record_of(one, tables.axes)) records.push_back(std::move(*record));
    }
    return records;
}

bool is_on_last_meshes(const CaseRecord& record) {
    return record.purpose == "table" || record.purpose == "mesh";
}

double main_reynolds_number(const LoadTables& tables, const std::vector<CaseRecord>& records) {
    std::map<double, int> counts;
    for (const CaseRecord& record : records) {
        if (is_on_last_meshes(record)) ++counts[record.reynolds_number];
    }
    double main = tables.reynolds_numbers.back();
    int most = 0;
    for (const auto& [number, count] : counts) {
        if (count >= most) {
            main = number;
            most = count;
        }
    }
    return main;
}

std::string left_out_text(const std::vector<LeftOutCase>& cases) {
    if (cases.empty()) return {};
    nlohmann::json list = nlohmann::json::array();
    for (const LeftOutCase& one : cases) list.push_back({{"name", one.name}, {"reason", one.reason}});
    return list.dump();
}

std::vector<LeftOutCase> left_out_cases(const LoadTables& tables) {
    if (tables.left_out.empty()) return {};
    std::vector<LeftOutCase> cases;
    try {
        for (const nlohmann::json& one : parse_json(tables.left_out)) {
            cases.push_back({one.at("name").get<std::string>(), one.at("reason").get<std::string>()});
        }
    } catch (const nlohmann::json::exception&) {
        throw Error("/tables/left_out is not a JSON list of names and reasons; bake the body again");
    }
    return cases;
}

}  // namespace samara
