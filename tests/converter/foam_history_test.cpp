#include "converter/foam_history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/base/error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::ElementsAre;
using testing::EndsWith;

TEST(FoamHistory, ReadsVectorsInBrackets) {
    const test::TemporaryFolder folder;
    const FoamHistory history = read_history(folder.file(
        "force.dat",
        "# Force         \n# CofR          : (0.0e+00 0.0e+00 0.0e+00)\n#\n"
        "# Time          \t(total_x total_y total_z)\t(pressure_x pressure_y pressure_z)\n"
        "1               \t(-2.5e+00 1.0e-03 2)\t(-1.5 0 1)\n2               \t(-2 1 2)\t(-1 0 1)\n"));
    EXPECT_THAT(history.columns, ElementsAre("Time", "total_x", "total_y", "total_z", "pressure_x",
                                             "pressure_y", "pressure_z"));
    EXPECT_THAT(history.column("total_x", 0.0), ElementsAre(-2.5, -2.0));
    EXPECT_THAT(history.column("pressure_z", 2.0), ElementsAre(1.0));
}

TEST(FoamHistory, ReadsPlainColumns) {
    const test::TemporaryFolder folder;
    const FoamHistory history = read_history(
        folder.file("force.dat",
                    "# Force\n# CofR : (0 0 0)\n#\n# Time\ttotal_x\ttotal_y\ttotal_z\tpressure_x\n"
                    "1\t-2.5\t0.001\t2\t7\n"));
    EXPECT_THAT(history.column("total_z", 1.0), ElementsAre(2.0));
}

TEST(FoamHistory, ReadsVolumeAverages) {
    const test::TemporaryFolder folder;
    const FoamHistory history = read_history(folder.file(
        "volFieldValue.dat",
        "# Region        : cellZone shell\n# Cells         : 3436\n# Volume        : 8.9e-01\n"
        "# Time          \tvolAverage(k)\tvolAverage(epsilon)\n1 \t5.7e-04\t1.2e-04\n2\t6e-04\tnan\n"));
    EXPECT_THAT(history.column("volAverage(k)", 0.0), ElementsAre(5.7e-4, 6e-4));
    EXPECT_TRUE(std::isnan(history.column("volAverage(epsilon)", 2.0).at(0)));
    EXPECT_THAT(test::error_of([&] { static_cast<void>(history.column("volAverage(p)", 0.0)); }),
                EndsWith("volFieldValue.dat: has no column 'volAverage(p)'"));
}

TEST(FoamHistory, FaultsNameFileAndLine) {
    const test::TemporaryFolder folder;
    const auto fault = [&](const char* text) {
        const std::filesystem::path file = folder.file("force.dat", text);
        return test::error_of([&] { read_history(file); });
    };
    EXPECT_THAT(fault("# Time a\n1 2\n2 x3\n"), EndsWith("force.dat:3: expected a number, found 'x3'"));
    EXPECT_THAT(fault("# Time a\n1 2\n2\n"), EndsWith("force.dat:3: has 1 values for 2 columns"));
    EXPECT_THAT(fault("# Time a\n"), EndsWith("force.dat: holds no values; the case was not solved"));
    EXPECT_THAT(fault(""), EndsWith("holds no values; the case was not solved"));
}

}  // namespace
}  // namespace samara
