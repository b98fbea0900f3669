#include "samara/core/body/table_errors_file.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/core/base/error.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

constexpr const char* sources_name = "/tables/error_sources";
constexpr const char* left_out_name = "/tables/left_out";

Error fault(const Hdf5Reader& file, const std::string& what) {
    return Error(fmt::format("{}: {}; bake the body again", file.path().string(), what));
}

std::vector<ErrorSource> sources_of(const Hdf5Reader& file) {
    const std::string names = file.text_attribute("/tables", "error_sources");
    std::vector<ErrorSource> sources;
    for (std::size_t start = 0; start < names.size();) {
        const std::size_t end = std::min(names.find(' ', start), names.size());
        const std::string name = names.substr(start, end - start);
        const auto source = error_source(name);
        if (!source) throw fault(file, fmt::format("/tables names the unknown error source '{}'", name));
        sources.push_back(*source);
        start = end + 1;
    }
    return sources;
}

std::vector<LeftOutCase> left_out_of(const Hdf5Reader& file) {
    std::vector<LeftOutCase> cases;
    try {
        const nlohmann::json list = parse_json_or_discard(file.json_text(left_out_name));
        if (!list.is_array()) throw fault(file, fmt::format("{} is no JSON list", left_out_name));
        for (const nlohmann::json& one : list) {
            cases.push_back({one.at("name").get<std::string>(), one.at("reason").get<std::string>()});
        }
    } catch (const nlohmann::json::exception&) {
        throw fault(file, fmt::format("{} is no JSON list of names and reasons", left_out_name));
    }
    return cases;
}

}  // namespace

void write_table_errors(Hdf5Writer& file, const LoadTables& tables) {
    if (!tables.error_sources.empty()) {
        std::vector<double> values;
        std::vector<std::string_view> names;
        for (const ErrorShare& share : tables.error_sources) {
            values.insert(values.end(), {share.force, share.moment, share.turbulent_kinetic_energy,
                                         share.dissipation_rate});
            names.emplace_back(name_of(share.source));
        }
        file.write(sources_name, values, {tables.error_sources.size(), 4}, "1",
                   "root mean square standard error by source over that of force, moment, turbulent kinetic "
                   "energy and dissipation rate");
        const std::string joined = fmt::format("{}", fmt::join(names, " "));
        file.attribute("/tables", "error_sources", std::string_view(joined));
    }
    if (!tables.left_out.empty()) {
        nlohmann::json list = nlohmann::json::array();
        for (const LeftOutCase& one : tables.left_out) {
            list.push_back({{"name", one.name}, {"reason", one.reason}});
        }
        file.write_text(left_out_name, list.dump(),
                        "JSON: cases that could not be solved, whose directions are filled from the others");
    }
}

void read_table_errors(const Hdf5Reader& file, LoadTables& tables) {
    if (file.has(sources_name)) {
        const std::vector<ErrorSource> sources = sources_of(file);
        const std::vector<double> values = file.finite_doubles(sources_name, {sources.size(), 4});
        for (std::size_t i = 0; i < sources.size(); ++i) {
            const double* row = &values[4 * i];
            tables.error_sources.push_back({sources[i], row[0], row[1], row[2], row[3]});
        }
    }
    if (file.has(left_out_name)) tables.left_out = left_out_of(file);
}

}  // namespace samara
