#include "converter/report/flow_part.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "converter/report/mesh_order.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/formats/json_text.hpp"
#include "samara/scene/terminal_speed.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* limits_of_steady_flow =
    "What a steady flow by a RANS closure does not hold: vortex shedding and its loads, beyond the mean; "
    "memory of "
    "the wake; a boundary layer that turns turbulent at another place than in nature (drag crisis, "
    "roughness); a "
    "mean wake that meanders. No error bar above includes these (docs/studies/closures compares closures "
    "with "
    "measurements).";

/// A solved case of the plan with its record.
struct SolvedRecord {
    const PlannedCase* planned;
    Json provenance;
};

std::vector<SolvedRecord> records_in(const fs::path& folder, const CasePlan& plan) {
    std::vector<SolvedRecord> records;
    for (const PlannedCase& one : plan.cases) {
        const fs::path file = folder / one.name / "provenance.json";
        if (!fs::is_regular_file(file)) continue;
        Json record = parse_json_or_discard(read_bytes(file));
        if (record.is_object()) records.push_back({&one, std::move(record)});
    }
    return records;
}

std::string text_at(const Json& record, const char* key) {
    const auto found = record.find(key);
    return found != record.end() && found->is_string() ? found->get<std::string>() : "";
}

std::optional<double> number_at(const Json& record, const char* key) {
    const auto found = record.find(key);
    if (found == record.end() || !found->is_number()) return std::nullopt;
    return found->get<double>();
}

/// Returns least, median and most of some numbers as text; "-" of none.
std::string range_of(std::vector<double> numbers, const char* format) {
    if (numbers.empty()) return "-";
    std::ranges::sort(numbers);
    const auto text = [&](double number) { return fmt::format(fmt::runtime(format), number); };
    return fmt::format("{}, {}, {}", text(numbers.front()), text(numbers[numbers.size() / 2]),
                       text(numbers.back()));
}

void add_domain(const CasePlan& plan, const Body& body, const std::vector<SolvedMesh>& meshes, Rows& rows) {
    if (meshes.empty() || plan.cases.empty() || meshes.back().mesh.points.empty()) return;
    Eigen::Array3d low = meshes.back().mesh.points.front().array();
    Eigen::Array3d high = low;
    for (const Vector3d& point : meshes.back().mesh.points) {
        low = low.min(point.array());
        high = high.max(point.array());
    }
    const Eigen::Array3d size = (high - low) / plan.cases.front().scales.length;
    rows.push_back(
        {"domain",
         fmt::format("{:.3g} x {:.3g} x {:.3g} L; its boundary is at least {:.3g} L from the centroid",
                     size[0], size[1], size[2],
                     (-low).min(high).minCoeff() / plan.cases.front().scales.length)});
    Eigen::Array3d faces(size[1] * size[2], size[2] * size[0], size[0] * size[1]);
    const double share =
        largest_projected_area(body) / (plan.reference_length * plan.reference_length * faces.minCoeff());
    rows.push_back(
        {"blockage ratio", fmt::format("{}: largest projected area over the least section of the domain, "
                                       "which has no walls",
                                       per_cent(share))});
}

void add_solution(const std::vector<SolvedRecord>& records, Rows& rows) {
    std::set<std::string> closures;
    std::vector<double> window;
    std::vector<double> iterations;
    std::vector<double> pressure;
    std::size_t restless = 0;
    for (const auto& [planned, record] : records) {
        if (planned->purpose == CasePurpose::start) continue;
        const bool of_turbulence = planned->purpose == CasePurpose::turbulence;
        if (const std::string closure = text_at(record, "closure"); !closure.empty()) {
            closures.insert(fmt::format("{}{}", closure, of_turbulence ? " (k and epsilon)" : ""));
        }
        if (const auto count = number_at(record, "averaged_iterations")) window.push_back(*count);
        if (const auto count = number_at(record, "iterations")) iterations.push_back(*count);
        if (const auto found = record.find("final_residuals"); found != record.end() && found->is_object()) {
            if (const auto residual = number_at(*found, "p")) pressure.push_back(*residual);
        }
        if (text_at(record, "verdict") == "restless") ++restless;
    }
    if (!closures.empty()) rows.push_back({"closure", fmt::format("{}", fmt::join(closures, ", "))});
    if (window.empty()) return;
    rows.push_back(
        {"averaging window", range_of(window, "{:.0f}") + " last iterations (least, median, most)"});
    rows.push_back({"iterations", range_of(iterations, "{:.0f}") + " (least, median, most)"});
    rows.push_back({"initial residual of the pressure, at the end",
                    range_of(pressure, "{:.1g}") + " (least, median, most)"});
    rows.push_back({"means that settled",
                    fmt::format("{} of {}; the others swing about a mean, and their error includes it",
                                window.size() - restless, window.size())});
}

void add_spacing(const std::vector<SolvedMesh>& meshes, Rows& rows) {
    for (const SolvedMesh& mesh : meshes) {
        if (mesh.spacings.empty()) continue;
        WallSpacing all = mesh.spacings.front();
        double mean = 0.0;
        for (const WallSpacing& one : mesh.spacings) {
            all.least = std::min(all.least, one.least);
            all.most = std::max(all.most, one.most);
            mean += one.mean / static_cast<double>(mesh.spacings.size());
        }
        rows.push_back({fmt::format("y+ on {}", mesh.name),
                        fmt::format("{:.2g}, {:.2g}, {:.2g} (least, mean, most; cases: {}), {}", all.least,
                                    mean, all.most, mesh.spacings.size(),
                                    all.wall_functions ? "with wall functions" : "boundary layer resolved")});
    }
}

/// Returns the drag, or of the cases of turbulence k, that a case found.
std::optional<double> value_of(const SolvedRecord& one) {
    if (one.planned->purpose != CasePurpose::turbulence && !one.planned->name.ends_with("_turbulence")) {
        return number_at(one.provenance, "drag_coefficient");
    }
    const auto means = one.provenance.find("near_wake");
    return means == one.provenance.end() ? std::nullopt : number_at(*means, "k");
}

/// Returns the rows of the directions that were solved on three meshes or more: the last three values, and
/// how they converge.
Rows rows_of_families(const std::vector<SolvedRecord>& records) {
    struct Solved {
        double cells;
        double value;
    };
    std::map<std::string, std::vector<Solved>> families;
    for (const SolvedRecord& one : records) {
        const auto mesh = one.provenance.find("mesh");
        const auto value = value_of(one);
        if (mesh == one.provenance.end() || !mesh->is_object() || !value) continue;
        const bool of_turbulence = one.planned->name.ends_with("_turbulence");
        const Vector3d& d = one.planned->direction;
        families[fmt::format("{} along ({:.2f}, {:.2f}, {:.2f}) at {}, {}", of_turbulence ? "k/U²" : "drag",
                             d.x(), d.y(), d.z(), in_plain_digits(one.planned->reynolds_number),
                             text_at(one.provenance, "closure"))]
            .push_back({number_at(*mesh, "cells").value_or(0.0), *value});
    }
    Rows rows;
    for (auto& [name, solved] : families) {
        if (solved.size() < 3) continue;
        std::ranges::sort(solved, {}, &Solved::cells);
        std::array<double, 3> cells{};
        std::array<double, 3> values{};
        std::vector<std::string> row = {name};
        for (std::size_t i = 0; i < 3; ++i) {
            const Solved& one = solved[solved.size() - 3 + i];
            cells[i] = one.cells;
            values[i] = one.value;
            row.push_back(fmt::format("{:.4g} on {:.0f}", one.value, one.cells));
        }
        const std::optional<MeshOrder> order = observed_order(cells, values);
        row.push_back(order ? fmt::format("{:.2g}", order->order) : "none: no monotone convergence");
        row.push_back(order ? per_cent(order->uncertainty) : "-");
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace

ReportPart part_of_flow(const fs::path& folder, const CasePlan& plan, const Body& body,
                        const std::vector<SolvedMesh>& meshes) {
    const std::vector<SolvedRecord> records = records_in(folder, plan);
    Rows rows;
    add_domain(plan, body, meshes, rows);
    add_solution(records, rows);
    add_spacing(meshes, rows);
    ReportPart part{"How the flow was solved", {table_block({}, rows)}};
    if (const Rows families = rows_of_families(records); !families.empty()) {
        part.blocks.push_back(
            text_block("Observed order and grid convergence index of the finest mesh by Celik et al. (2008), "
                       "with the cubic "
                       "root of the mean cell volume. The last meshes of the loads refine the wake alone, so "
                       "that theirs is "
                       "an indication; those of k and epsilon are uniform. The tables state the whole "
                       "difference of the last "
                       "two meshes as their error by the mesh."));
        part.blocks.push_back(table_block(
            {"value, on cells", "coarse", "medium", "fine", "observed order", "index"}, families));
    }
    part.blocks.push_back(text_block(limits_of_steady_flow));
    return part;
}

}  // namespace samara
