#include "samara/formats/left_out_cases.hpp"

#include <nlohmann/json.hpp>

#include "samara/core/base/error.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {

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
        throw Error("/tables/left_out is no JSON list of names and reasons; bake the body again");
    }
    return cases;
}

}  // namespace samara
