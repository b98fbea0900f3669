// Tables of few cases beside the loads of the body's surface.

#include <cmath>

#include <gtest/gtest.h>

#include "converter/tables/direction_sampling.hpp"
#include "converter/tables/reynolds_fit.hpp"
#include "load_laws.hpp"
#include "paths.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/surface/octahedral_map.hpp"
#include "table_cases.hpp"

namespace samara {
namespace {

Body ready_baked(const std::string& name) {
    return read_body_file(SAMARA_SOURCE_DIRECTORY "/runtime/bodies/" + name + ".body.h5");
}

constexpr double reynolds_number = 5000.0;

SurfaceTrend trend_of(const Body& body) {
    return {*body.surface_loads, body.symmetry, reynolds_number};
}

std::vector<DirectionSample> samples_of(const Symmetry& symmetry, int n,
                                        const std::function<LoadEntry(const Vector3d&)>& law) {
    std::vector<DirectionSample> samples;
    for (const Vector3d& direction : required_directions(symmetry, n)) {
        samples.push_back({direction, law(direction), {}});
    }
    keep_symmetric_part(symmetry, samples);
    return samples;
}

/// A smooth deviation from the trend.
const test::BoxLaw smooth{Vector3d(0.6, 0.6, 1.9), Vector3d(0.3, 0.3, 0.5)};

/// The largest error of a fit over directions between its samples.
double largest_error(const ReynoldsFit& fit, const std::function<LoadEntry(const Vector3d&)>& law) {
    double largest = 0.0;
    for (int i = 0; i < 100; ++i) {
        const Vector3d direction = test::spiral_direction(i, 100);
        largest = std::max(largest, test::difference(fit.at(direction), law(direction)));
    }
    return largest;
}

TEST(SurfaceTrend, HasTheSymmetryOfTheBody) {
    for (const char* name : {"ellipsoid", "sheet", "leaf"}) {
        const Body body = ready_baked(name);
        const SurfaceTrend trend = trend_of(body);
        for (const Matrix3d& element : elements_in_map_axes(body.symmetry)) {
            const Vector3d direction = Vector3d(1.0, -2.0, 3.0).normalized();
            EXPECT_LT(
                test::difference(trend.at(element * direction), transformed(trend.at(direction), element)),
                1e-12)
                << name;
        }
    }
}

TEST(SurfaceTrend, IsNearTheTablesOfTheSurface) {
    const Body body = ready_baked("sheet");
    const SurfaceTrend trend = trend_of(body);
    const LoadTables tables = as_tables(*body.surface_loads, reference_length(body.moments.surface_area), {},
                                        {.turbulent_kinetic_energy = 0.0});
    const Vector3d direction = Vector3d(1.0, -2.0, 3.0).normalized();
    const LoadEntry own = look_up(tables, body.symmetry.axes * direction, reynolds_number);
    EXPECT_LT(test::difference(trend.at(direction), transformed(own, body.symmetry.axes.transpose())),
              0.01 * own.force.norm());
}

TEST(ReynoldsFit, FollowsKinksThatTheTrendHas) {
    const Body body = ready_baked("sheet");
    const SurfaceTrend trend = trend_of(body);
    const auto law = [&](const Vector3d& d) { return plus(smooth(d), 1.0, trend.at(d)); };
    const std::vector<DirectionSample> samples = samples_of(body.symmetry, 4, law);
    const ReynoldsFit alone(body.symmetry, samples, nullptr);
    const ReynoldsFit beside(body.symmetry, samples, trend);
    EXPECT_TRUE(beside.force_has_trend());
    EXPECT_TRUE(beside.moment_has_trend());
    EXPECT_LT(largest_error(beside, law), 0.1 * largest_error(alone, law));
    const Vector3d between = Vector3d(1.0, -2.0, 3.0).normalized();
    EXPECT_LT(beside.interpolation_error(between).moment, 0.1 * alone.interpolation_error(between).moment);
}

TEST(ReynoldsFit, GoesThroughItsSamplesBesideTheTrendToo) {
    const Body body = ready_baked("sheet");
    const std::vector<DirectionSample> samples = samples_of(body.symmetry, 4, smooth);
    const ReynoldsFit fit(body.symmetry, samples, trend_of(body));
    for (const DirectionSample& sample : samples) {
        EXPECT_LT(test::difference(fit.at(sample.direction), sample.entry), 1e-12);
    }
}

TEST(ReynoldsFit, StandsAloneWhereTheTrendErrsMore) {
    const Body body = ready_baked("ellipsoid");
    const std::vector<DirectionSample> samples = samples_of(body.symmetry, 4, smooth);
    const ReynoldsFit alone(body.symmetry, samples, nullptr);
    const ReynoldsFit beside(body.symmetry, samples, trend_of(body));
    EXPECT_FALSE(beside.force_has_trend());
    EXPECT_FALSE(beside.moment_has_trend());
    EXPECT_EQ(largest_error(beside, smooth), largest_error(alone, smooth));
}

}  // namespace
}  // namespace samara
