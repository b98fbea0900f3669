#include "converter/openfoam/foam_history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(FoamHistory, ErrorsNameFileAndLine) {
    const test::TemporaryFolder folder;
    const auto error = [&](const char* text) {
        const std::filesystem::path file = folder.file("force.dat", text);
        return test::error_of([&] { read_history(file); });
    };
    EXPECT_THAT(error("# Time a\n1 2\n2 x3\n"), EndsWith("force.dat:3: expected a number, found 'x3'"));
    EXPECT_THAT(error("# Time a\n1 2\n2\n"), EndsWith("force.dat:3: has 1 values for 2 columns"));
    EXPECT_THAT(error("# Time a\n"), EndsWith("force.dat: holds no values; the case was not solved"));
    EXPECT_THAT(error(""), EndsWith("holds no values; the case was not solved"));
}

TEST(FoamHistory, ReadsTheLayoutOfTheFoundation) {
    const test::TemporaryFolder folder;
    const FoamHistory history = read_history(folder.file(
        "forces.dat",
        "# Forces\n# CofR                : (0 0 0)\n# Time                forces(pressure viscous)\t"
        "moments(pressure viscous)\n1                   \t((1 2 3) (0.1 0.2 0.3))\t((4 5 6) (-1 -2 "
        "-3e-1))\n"));
    EXPECT_THAT(
        history.columns,
        ElementsAre("Time", "forces_pressure_x", "forces_pressure_y", "forces_pressure_z", "forces_viscous_x",
                    "forces_viscous_y", "forces_viscous_z", "moments_pressure_x", "moments_pressure_y",
                    "moments_pressure_z", "moments_viscous_x", "moments_viscous_y", "moments_viscous_z"));
    EXPECT_THAT(history.rows.at(0), ElementsAre(1, 1, 2, 3, 0.1, 0.2, 0.3, 4, 5, 6, -1, -2, -0.3));
}

TEST(FoamHistory, ReadsVectorsThatAHeadingNamesByOneWord) {
    const test::TemporaryFolder folder;
    const FoamHistory history = read_history(folder.file(
        "sixDoFRigidBodyState.dat",
        "# Motion State      \n# Angle Units       : radians\n"
        "# Time              \tcentreOfMass\trotation\n0.01                \t(1e-01 2 -3)\t(4 5 6)\n"
        "0.02                \t(1 2 3)\t(4 5 nan)\n"));
    EXPECT_THAT(history.columns, ElementsAre("Time", "centreOfMass_x", "centreOfMass_y", "centreOfMass_z",
                                             "rotation_x", "rotation_y", "rotation_z"));
    EXPECT_THAT(history.rows.at(0), ElementsAre(0.01, 0.1, 2, -3, 4, 5, 6));
    EXPECT_TRUE(std::isnan(history.rows.at(1).at(6)));
}

TEST(FoamHistory, ReadsNumbersBesideVectorsThatAHeadingNamesByOneWord) {
    const test::TemporaryFolder folder;
    const FoamHistory history =
        read_history(folder.file("f.dat", "# Time mass velocity\n1 0.5 (1 2 3)\n2 0.6 (4 5 6)\n"));
    EXPECT_THAT(history.columns, ElementsAre("Time", "mass", "velocity_x", "velocity_y", "velocity_z"));
    EXPECT_THAT(history.column("velocity_y", 2.0), ElementsAre(5));
}

TEST(FoamHistory, RejectsVectorsThatAHeadingDoesNotName) {
    const test::TemporaryFolder folder;
    const auto file = folder.file("f.dat", "# Time a b\n1 (1 2 3)\n");
    EXPECT_THAT(test::error_of([&] { read_history(file); }), EndsWith("f.dat:2: has 4 values for 3 columns"));
}

TEST(FoamHistory, TimesMustAscend) {
    const test::TemporaryFolder folder;
    const auto file = folder.file("force.dat", "# Time a\n1 2\n3 2\n3 5\n");
    EXPECT_THAT(test::error_of([&] { read_history(file); }),
                EndsWith("force.dat:4: the time 3 comes after 3; times must ascend"));
}

/// A function object's folder with the history `rows` of each start time.
class JoinedHistory : public testing::Test {
  protected:
    void write(const std::string& file, const std::string& rows) {
        static_cast<void>(folder_.file("shell/" + file, "# Time a\n" + rows));
    }
    std::vector<double> values() const {
        return read_joined_history(folder_.path() / "shell", "f").column("a", 0.0);
    }
    std::string error() const {
        return test::error_of([&] { values(); });
    }

    test::TemporaryFolder folder_;
};

TEST_F(JoinedHistory, FollowsTheStartTimesAsNumbers) {
    write("0/f.dat", "1 10\n2 20\n");
    write("100/f.dat", "101 1010\n");
    write("20/f.dat", "21 210\n");
    write("notes/f.dat", "1 0\n");
    EXPECT_THAT(values(), ElementsAre(10, 20, 210, 1010));
}

TEST_F(JoinedHistory, LaterRunsReplaceWhatTheyDoAnew) {
    write("0/f.dat", "1 10\n2 20\n3 30\n4 40\n5 5");
    write("2/f.dat", "3 31\n");
    write("2/f_2.dat", "");
    EXPECT_THAT(values(), ElementsAre(10, 20, 31));
    write("2/f_2.dat", "3 32\n4 42\n");
    EXPECT_THAT(values(), ElementsAre(10, 20, 32, 42));
}

TEST_F(JoinedHistory, IsRejectedWhereItsEndIsCutInALine) {
    write("0/f.dat", "1 10\n2 20\n");
    write("2/f.dat", "3 31\n4 4");
    EXPECT_THAT(
        error(),
        EndsWith("shell/2/f.dat:3: ends within this line; let the solver continue, or remove the line"));
}

TEST_F(JoinedHistory, SaysWhatIsMissing) {
    EXPECT_THAT(error(), EndsWith("shell: has no f.dat in any folder of a start time; solve the case with "
                                  "the function object 'shell'"));
    write("0/f.dat", "");
    EXPECT_THAT(error(), EndsWith("shell/0/f.dat: holds no values; the case was not solved"));
    write("0/f.dat", "1 2\n");
    static_cast<void>(folder_.file("shell/1/f.dat", "# Time b a\n2 1 2\n"));
    EXPECT_THAT(
        error(),
        EndsWith("shell/1/f.dat: its columns differ from those of earlier runs; solve the case again"));
}

}  // namespace
}  // namespace samara
