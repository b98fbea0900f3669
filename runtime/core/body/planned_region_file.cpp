#include "samara/core/body/planned_region_file.hpp"

#include <cmath>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

constexpr const char* region_name = "/tables/planned";
constexpr const char* report_name = "/tables/plan";

}  // namespace

void write_planned_region(Hdf5Writer& file, const PlannedRegion& region) {
    if (!region.report.empty()) {
        file.write_text(report_name, region.report, "JSON: what a bake for a scene aimed at and reached");
    }
    if (region.subdivisions == 0) return;
    const hsize_t side = 2 * static_cast<hsize_t>(region.subdivisions) + 1;
    const std::vector<std::int32_t> planned(region.planned.begin(), region.planned.end());
    file.write(region_name, planned, {side, side}, "1",
               "1 where the scene's motion was expected: nodes of an octahedral map of the tables' axes");
}

PlannedRegion read_planned_region(const Hdf5Reader& file) {
    PlannedRegion region;
    if (file.has(report_name)) region.report = file.json_text(report_name);
    if (!file.has(region_name)) return region;
    const std::vector<std::int32_t> planned = file.integers(region_name, {0, 0});
    const auto side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(planned.size()))));
    region.subdivisions = (side - 1) / 2;
    if (region.subdivisions < 1 ||
        planned.size() != static_cast<std::size_t>(side) * static_cast<std::size_t>(side) || side % 2 == 0) {
        throw Error(fmt::format("{}: {} is no map of directions; bake the body again", file.path().string(),
                                region_name));
    }
    for (const std::int32_t one : planned) region.planned.push_back(one != 0 ? 1 : 0);
    return region;
}

}  // namespace samara
