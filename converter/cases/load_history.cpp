#include "converter/cases/load_history.hpp"

#include <string>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

/// The sum of the vectors whose x components stand in the columns `first`.
VectorHistory sum_of(const FoamHistory& history, const std::vector<std::size_t>& first) {
    VectorHistory sum{history.files, {}, {}};
    for (const std::vector<double>& row : history.rows) {
        Vector3d value = Vector3d::Zero();
        for (const std::size_t x : first) value += Vector3d(row[x], row[x + 1], row[x + 2]);
        sum.times.push_back(row.front());
        sum.values.push_back(value);
    }
    return sum;
}

VectorHistory read_total(const std::filesystem::path& folder, const std::string& name) {
    const FoamHistory history = read_joined_history(folder, name);
    static_cast<void>(history.index("total_z"));
    return sum_of(history, {history.index("total_x")});
}

/// The vectors of .org's forces.dat that begin with `group`, such as forces_pressure.
VectorHistory sum_of_group(const FoamHistory& history, const std::string& group) {
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < history.columns.size(); ++i) {
        if (history.columns[i].starts_with(group) && history.columns[i].ends_with("_x")) first.push_back(i);
    }
    if (first.empty()) {
        throw Error(fmt::format("{}: has no column '{}pressure'", history.file.string(), group));
    }
    return sum_of(history, first);
}

}  // namespace

LoadHistory read_load_history(const std::filesystem::path& folder) {
    if (!history_files(folder, "force").empty() || history_files(folder, "forces").empty()) {
        return {read_total(folder, "force"), read_total(folder, "moment")};
    }
    const FoamHistory history = read_joined_history(folder, "forces");
    const bool singular = history.has("moment_pressure_x");
    return {sum_of_group(history, "forces_"), sum_of_group(history, singular ? "moment_" : "moments_")};
}

}  // namespace samara
