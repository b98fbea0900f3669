#include "converter/tables/replaced_turbulence.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "converter/cases/case_plan.hpp"
#include "samara/core/surface/octahedral_map.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

void take_turbulence(LoadEntry& to, const LoadEntry& from) {
    to.turbulent_kinetic_energy = from.turbulent_kinetic_energy;
    to.dissipation_rate = from.dissipation_rate;
}

/// Returns the sources of both, each with the loads' shares of the first and the turbulence's of the second.
std::vector<ErrorShare> joined_sources(const std::vector<ErrorShare>& loads,
                                       const std::vector<ErrorShare>& turbulence) {
    std::vector<ErrorShare> joined;
    for (std::size_t i = 0; i < error_source_count; ++i) {
        const auto source = static_cast<ErrorSource>(i);
        const auto of_loads = std::ranges::find(loads, source, &ErrorShare::source);
        const auto of_turbulence = std::ranges::find(turbulence, source, &ErrorShare::source);
        if (of_loads == loads.end() && of_turbulence == turbulence.end()) continue;
        ErrorShare share{source, 0.0, 0.0, 0.0, 0.0};
        if (of_loads != loads.end()) {
            share.force = of_loads->force;
            share.moment = of_loads->moment;
        }
        if (of_turbulence != turbulence.end()) {
            share.turbulent_kinetic_energy = of_turbulence->turbulent_kinetic_energy;
            share.dissipation_rate = of_turbulence->dissipation_rate;
        }
        joined.push_back(share);
    }
    return joined;
}

std::string joined_provenance(const std::string& loads, const std::string& turbulence) {
    nlohmann::json cases = nlohmann::json::array();
    const nlohmann::json before = parse_json_or_discard(loads);
    for (const nlohmann::json& one : before.is_array() ? before : nlohmann::json::array()) {
        if (one.value("purpose", "") == name_of(CasePurpose::turbulence)) continue;
        cases.push_back(one);
        cases.back().erase("turbulence");
    }
    for (nlohmann::json one : parse_json(turbulence)) {
        one["purpose"] = name_of(CasePurpose::turbulence);
        cases.push_back(std::move(one));
    }
    return cases.dump();
}

}  // namespace

LoadTables with_replaced_turbulence(LoadTables tables, const LoadTables& turbulence) {
    std::size_t place = 0;
    for (const double reynolds_number : tables.reynolds_numbers) {
        for (const Vector3d& node : octahedral_nodes(tables.subdivisions)) {
            const Vector3d direction = tables.axes * node;
            take_turbulence(tables.entries[place], look_up(turbulence, direction, reynolds_number));
            if (!tables.errors.empty()) {
                take_turbulence(tables.errors[place], look_up_error(turbulence, direction, reynolds_number));
            }
            ++place;
        }
    }
    tables.turbulence_mean = turbulence.turbulence_mean;
    tables.error_sources = joined_sources(tables.error_sources, turbulence.error_sources);
    tables.provenance = joined_provenance(tables.provenance, turbulence.provenance);
    return tables;
}

}  // namespace samara
