#include "samara/pictures/body_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/formats/json_text.hpp"
#include "samara/pictures/body_arcs.hpp"

namespace samara {
namespace {

using nlohmann::json;

constexpr int points_of_curve = 181;
constexpr int rows = 120;
constexpr int columns = 240;

/// Returns the cases that went into the table at the Reynolds number.
std::vector<CaseRecord> table_cases(std::vector<CaseRecord> records, double reynolds_number) {
    std::erase_if(records, [&](const CaseRecord& record) {
        return record.purpose != "table" || record.reynolds_number != reynolds_number;
    });
    return records;
}

json arc_as_json(const Body& body, const BodyArc& arc, double most, double reynolds_number,
                 const std::vector<CaseRecord>& cases, std::set<const CaseRecord*>& on_arcs) {
    constexpr std::pair<const char*, double ArcValues::*> quantities[] = {{"drag", &ArcValues::drag},
                                                                          {"lift", &ArcValues::lift},
                                                                          {"moment", &ArcValues::moment},
                                                                          {"k", &ArcValues::k}};
    json result = {{"name", arc.name}};
    for (int i = 0; i < points_of_curve; ++i) {
        const double angle = most * i / (points_of_curve - 1);
        const ArcValues values = values_on(*body.tables, arc, angle / degrees, reynolds_number);
        const ArcValues errors = errors_on(*body.tables, arc, angle / degrees, reynolds_number);
        result["angles"].push_back(angle);
        for (const auto& [key, member] : quantities) {
            result[key].push_back(values.*member);
            result[fmt::format("{}_error", key)].push_back(errors.*member);
        }
    }
    json& solved =
        result["cases"] = {{"angles", json::array()}, {"drag", json::array()}, {"k", json::array()}};
    for (const CaseRecord& record : cases) {
        for (const double angle : angles_on(arc, body.symmetry, record.direction, most)) {
            on_arcs.insert(&record);
            solved["angles"].push_back(angle);
            solved["drag"].push_back(record.drag);
            solved["k"].push_back(or_null(record.k));
        }
    }
    return result;
}

json polars(const Body& body, double reynolds_number, const std::vector<CaseRecord>& records) {
    const std::vector<CaseRecord> cases = table_cases(records, reynolds_number);
    const std::vector<BodyArc> arcs = arcs_of(body, reynolds_number);
    const double most = shown_angle(*body.tables, arcs, reynolds_number);
    json picture = {{"shown_angle", most}, {"spherical", body.symmetry.type == Symmetry::Type::spherical}};
    std::set<const CaseRecord*> on_arcs;
    for (const BodyArc& arc : arcs) {
        picture["arcs"].push_back(arc_as_json(body, arc, most, reynolds_number, cases, on_arcs));
    }
    picture["solved"] = on_arcs.size();
    return picture;
}

json sphere(const Body& body, double reynolds_number, const std::vector<CaseRecord>& records) {
    const LoadTables& tables = *body.tables;
    const Matrix3d principal = principal_axes(body.moments);
    Matrix3d axes;  // columns: right, into the map's middle, up
    axes << principal.col(1), principal.col(2), principal.col(0);
    json picture = {{"solved_directions", json::array()}};
    double all = 0.0;
    double planned_area = 0.0;
    for (int row = 0; row < rows; ++row) {
        json drag = json::array();
        json moment = json::array();
        json k = json::array();
        json error = json::array();
        json planned = json::array();
        const double latitude = std::numbers::pi * ((row + 0.5) / rows - 0.5);
        for (int column = 0; column < columns; ++column) {
            const double longitude = std::numbers::pi * (2.0 * (column + 0.5) / columns - 1.0);
            const Vector3d direction =
                axes * Vector3d(std::cos(latitude) * std::sin(longitude),
                                std::cos(latitude) * std::cos(longitude), std::sin(latitude));
            const LoadEntry entry = look_up(tables, direction, reynolds_number);
            const double force = entry.force.norm();
            const bool known = tables.errors.size() == tables.entries.size() && force > 0.0;
            drag.push_back(-entry.force.dot(direction));
            moment.push_back(entry.moment.norm());
            k.push_back(entry.turbulent_kinetic_energy);
            error.push_back(
                known ? 100.0 * look_up_error(tables, direction, reynolds_number).force.norm() / force : 0.0);
            const bool is_planned = tables.plan.holds(tables.axes.transpose() * direction);
            all += std::cos(latitude);
            planned_area += is_planned ? std::cos(latitude) : 0.0;
            planned.push_back(is_planned);
        }
        picture["drag"].push_back(drag);
        picture["moment"].push_back(moment);
        picture["k"].push_back(k);
        picture["error"].push_back(error);
        picture["is_planned"].push_back(planned);
    }
    std::vector<Vector3d> solved;
    for (const CaseRecord& record : records) {
        if (!is_on_last_meshes(record) || record.reynolds_number != reynolds_number) continue;
        const bool known = std::ranges::any_of(solved, [&](const Vector3d& direction) {
            return (direction - record.direction).norm() < same_direction;
        });
        if (known) continue;
        solved.push_back(record.direction);
        picture["solved_directions"].push_back(as_json(Vector3d(axes.transpose() * record.direction)));
    }
    picture["cases"] = solved.size();
    picture["planned"] = planned_area / all;
    const Symmetry& symmetry = body.symmetry;
    picture["has_images"] = symmetry.elements.size() > 1 || symmetry.type != Symmetry::Type::finite;
    return picture;
}

/// One direction on its meshes, coarsest first.
using Ladder = std::vector<CaseRecord>;

/// Returns the ladders of the main Reynolds number with the closure of the table's cases that go to the last
/// mesh.
std::vector<Ladder> ladders_of(const std::vector<CaseRecord>& records, double reynolds_number) {
    std::vector<Ladder> ladders;
    for (const CaseRecord& record : records) {
        if (!is_on_last_meshes(record) || record.reynolds_number != reynolds_number || !(record.cells > 0.0))
            continue;
        const auto known = std::ranges::find_if(ladders, [&](const Ladder& ladder) {
            return (ladder.front().direction - record.direction).norm() < same_direction;
        });
        if (known == ladders.end()) {
            ladders.push_back({record});
        } else {
            known->push_back(record);
        }
    }
    std::erase_if(ladders, [](const Ladder& ladder) {
        return std::ranges::none_of(ladder, [](const CaseRecord& one) { return one.purpose == "table"; });
    });
    for (Ladder& ladder : ladders) std::ranges::sort(ladder, {}, &CaseRecord::cells);
    return ladders;
}

json axis_as_json(const Body& body, const std::string& name, const Vector3d& direction) {
    const LoadTables& tables = *body.tables;
    json result = {{"name", name}};
    for (const double number : tables.reynolds_numbers) {
        const bool known = tables.errors.size() == tables.entries.size();
        result["drag"].push_back(-look_up(tables, direction, number).force.dot(direction));
        result["error"].push_back(
            known ? look_up_error(tables, direction, number).force.cwiseProduct(direction).norm() : 0.0);
    }
    return result;
}

json convergence(const Body& body, double reynolds_number, const std::vector<CaseRecord>& records) {
    const LoadTables& tables = *body.tables;
    json picture = {{"ladders", json::array()},
                    {"error_sources", json::array()},
                    {"reynolds_numbers", tables.reynolds_numbers}};
    std::set<double> meshes;
    int directions = 0;
    for (const Ladder& ladder : ladders_of(records, reynolds_number)) {
        if (ladder.size() > 1) ++directions;
        json one;
        for (const CaseRecord& record : ladder) {
            meshes.insert(record.cells);
            one["cells"].push_back(record.cells);
            one["drag"].push_back(record.drag);
            one["k"].push_back(or_null(record.k));
        }
        picture["ladders"].push_back(one);
    }
    picture["directions"] = directions;  // that were solved on more than one mesh
    picture["meshes"] = meshes.size();
    picture["sources"] = tables.error_sources.size();
    for (const ErrorShare& share : tables.error_sources) {
        picture["error_sources"].push_back({{"source", name_of(share.source)},
                                            {"place", static_cast<int>(share.source)},
                                            {"force", share.force},
                                            {"moment", share.moment},
                                            {"k", share.turbulent_kinetic_energy},
                                            {"epsilon", share.dissipation_rate}});
    }
    const Matrix3d axes = principal_axes(body.moments);
    if (body.symmetry.type == Symmetry::Type::spherical) {
        picture["axes"].push_back(axis_as_json(body, "any direction", axes.col(0)));
    } else {
        constexpr const char* names[] = {"short", "middle", "long"};
        for (int axis = 0; axis < 3; ++axis) {
            picture["axes"].push_back(axis_as_json(body, names[axis], axes.col(axis)));
        }
    }
    return picture;
}

}  // namespace

json body_picture(const std::string& picture, const Body& body) {
    if (!body.tables) {
        throw Error(fmt::format("{}: has no tables to draw; make them with 'samara bake'", body.name));
    }
    const std::vector<CaseRecord> records = case_records(*body.tables);
    const double reynolds_number = main_reynolds_number(*body.tables, records);
    json result = picture == "sphere"        ? sphere(body, reynolds_number, records)
                  : picture == "convergence" ? convergence(body, reynolds_number, records)
                                             : polars(body, reynolds_number, records);
    result["picture"] = picture;
    result["name"] = body.name;
    result["reynolds_number"] = reynolds_number;
    return result;
}

}  // namespace samara
