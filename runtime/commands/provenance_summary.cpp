#include "samara/commands/provenance_summary.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

using Values = std::vector<nlohmann::json>;

std::string in_words(const nlohmann::json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string in_words(const Values& values) {
    const std::set<nlohmann::json> distinct(values.begin(), values.end());
    if (distinct.size() == 1) return in_words(values.front());
    const bool numbers = std::all_of(values.begin(), values.end(),
                                     [](const nlohmann::json& value) { return value.is_number(); });
    if (!numbers) return fmt::format("{} different", distinct.size());
    return fmt::format("{:.6g} to {:.6g}", distinct.begin()->get<double>(), distinct.rbegin()->get<double>());
}

}  // namespace

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
    for (const auto& [key, list] : values) summary.keys.emplace_back(key, in_words(list));
    return summary;
}

}  // namespace samara
