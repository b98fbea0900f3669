// The files of openfoam-v1912/ are what OpenFOAM v1912 wrote for the flow around an ellipsoid, cut to the
// first cells and the last iterations.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "converter/openfoam/foam_file.hpp"
#include "converter/openfoam/foam_history.hpp"
#include "paths.hpp"

namespace samara {
namespace {

using testing::ElementsAre;

const std::filesystem::path folder =
    std::filesystem::path(SAMARA_SOURCE_DIRECTORY) / "tests" / "converter" / "openfoam-v1912";

TEST(OpenFoamOutput, FieldsAndVolumes) {
    const FoamField<double> k = read_scalar_field(folder / "kMean");
    ASSERT_EQ(k.values.size(), 10U);
    EXPECT_EQ(k[0], 3.3349659e-05);
    EXPECT_EQ(k[9], 0.00011357075);
    EXPECT_EQ(read_scalar_field(folder / "V")[8], 7.9363952);
}

TEST(OpenFoamOutput, CellZones) {
    EXPECT_THAT(read_cell_zone(folder / "cellZones", "shell"), ElementsAre(1702, 2085, 2127, 2218));
}

TEST(OpenFoamOutput, ForcesAndMoments) {
    const FoamHistory force = read_history(folder / "force.dat");
    EXPECT_EQ(force.columns.size(), 10U);
    EXPECT_THAT(force.column("Time", 58.0), ElementsAre(58.0, 59.0, 60.0));
    EXPECT_THAT(force.column("total_x", 59.0), ElementsAre(-6.66730956e-01, -6.67220398e-01));
    EXPECT_THAT(force.column("viscous_z", 60.0), ElementsAre(-5.95457307e-03));
    const FoamHistory moment = read_history(folder / "moment.dat");
    EXPECT_EQ(moment.columns, force.columns);
    EXPECT_EQ(moment.rows.size(), 6U);
}

TEST(OpenFoamOutput, PressureAndViscousForceAddUpToTheTotal) {
    const FoamHistory force = read_history(folder / "force.dat");
    for (const std::vector<double>& row : force.rows) {
        for (std::size_t i = 1; i <= 3; ++i) EXPECT_NEAR(row[i], row[i + 3] + row[i + 6], 2e-9);
    }
}

TEST(OpenFoamOutput, VolumeMeans) {
    const FoamHistory shell = read_history(folder / "volFieldValue.dat");
    EXPECT_THAT(shell.column("volAverage(k)", 60.0), ElementsAre(1.57439301e-03));
    EXPECT_THAT(shell.column("volAverage(epsilon)", 60.0), ElementsAre(1.42355139e-03));
}

}  // namespace
}  // namespace samara
