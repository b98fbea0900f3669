// The output of OpenFOAM for one small flow, in all its formats, reduced: the flow past a cube of
// cube-flow/.
#include <fstream>
#include <memory>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "converter/cases/case_reduction.hpp"
#include "converter/openfoam/foam_file.hpp"
#include "converter/openfoam/foam_history.hpp"
#include "converter/openfoam/poly_mesh.hpp"
#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// How a run is to end and to write.
struct Output {
    int end_time = 40;
    const char* format = "ascii";
    const char* compression = "off";
};

void set_output(const fs::path& folder, const Output& output) {
    std::ofstream(folder / "output") << fmt::format(
        "endTime {};\nwriteInterval {};\nwriteFormat {};\nwriteCompression {};\n", output.end_time,
        output.end_time, output.format, output.compression);
}

void run_in(const fs::path& folder, std::vector<std::string> words) {
    const std::vector<std::string> environment = {"env", "WM_PROJECT_DIR=/usr/share/openfoam",
                                                  "OMPI_ALLOW_RUN_AS_ROOT=1",
                                                  "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"};
    words.insert(words.begin(), environment.begin(), environment.end());
    ASSERT_EQ(run_subprocess(words, folder / "log", folder), 0) << read_bytes(folder / "log");
}

void copy_case(const fs::path& from, const fs::path& to) {
    fs::copy(from, to, fs::copy_options::recursive);
}

void solve(const fs::path& folder, const Output& output) {
    copy_case(fs::path(SAMARA_SOURCE_DIRECTORY) / "tests" / "converter" / "cube-flow", folder);
    set_output(folder, output);
    run_in(folder, {"./Allrun"});
}

/// One flow, solved once for each format.
class SolvedFlow : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<test::TemporaryFolder>();
        solve(path("ascii"), {40, "ascii", "off"});
        solve(path("ascii_gz"), {40, "ascii", "on"});
        solve(path("binary"), {40, "binary", "off"});
        solve(path("binary_gz"), {40, "binary", "on"});
    }
    static void TearDownTestSuite() { folder_.reset(); }

    static fs::path path(const std::string& name) { return folder_->path() / name; }

    /// Where the formats stand after the solver has run, to be changed by one test.
    static fs::path copy_of(const std::string& name, const std::string& copy) {
        copy_case(path(name), path(copy));
        return path(copy);
    }

    static LoadEntry reduced(const std::string& name) {
        CasePlan plan;
        plan.axes = plan.case_axes = Matrix3d::Identity();
        plan.solved_by_user = true;
        // A cube of edge 1, whose area is that of a sphere of diameter 1.382.
        PlannedCase planned{name, {0.6, 0.48, 0.64}, 1382.0};
        planned.scales.length = 1.382;
        MeshZones zones;
        return reduce_case(folder_->path(), plan, planned, zones).sample.entry;
    }

    static void expect_equal(const LoadEntry& a, const LoadEntry& b, double tolerance) {
        EXPECT_LE((a.force - b.force).norm(), tolerance * b.force.norm());
        EXPECT_LE((a.moment - b.moment).norm(), tolerance * b.force.norm());
        EXPECT_NEAR(a.turbulent_kinetic_energy, b.turbulent_kinetic_energy,
                    tolerance * b.turbulent_kinetic_energy);
        EXPECT_NEAR(a.dissipation_rate, b.dissipation_rate, tolerance * b.dissipation_rate);
    }

  private:
    static inline std::unique_ptr<test::TemporaryFolder> folder_;
};

TEST_F(SolvedFlow, IsTheSameInEveryFormat) {
    const LoadEntry plain = reduced("ascii");
    EXPECT_GT(-plain.force.dot(Vector3d(0.6, 0.48, 0.64)), 0.5);
    for (const char* const format : {"ascii_gz", "binary", "binary_gz"}) {
        SCOPED_TRACE(format);
        expect_equal(reduced(format), plain, 1e-9);
    }
    EXPECT_TRUE(fs::exists(path("ascii_gz") / "40" / "k.gz"));
    EXPECT_THAT(read_bytes(path("binary") / "40" / "k"), HasSubstr("binary"));
}

TEST_F(SolvedFlow, FieldsAreTheSameInEveryFormat) {
    const std::vector<double> plain = read_scalar_field(path("ascii") / "40" / "k").values;
    ASSERT_EQ(plain.size(), 4088U);
    for (const char* const format : {"ascii_gz", "binary", "binary_gz"}) {
        const std::vector<double> values = read_scalar_field(path(format) / "40" / "k").values;
        ASSERT_EQ(values.size(), plain.size());
        for (std::size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(values[i], plain[i], 1e-9 * plain[i]);
    }
}

TEST_F(SolvedFlow, HistoriesAndFieldsAgreeFarWithinWhatIsAsked) {
    for (const char* const format : {"ascii", "binary"}) {
        MeshZones zones;
        const TurbulenceHistory turbulence = read_turbulence_history(path(format));
        const WrittenMeans means = written_means(path(format), path(format), turbulence, zones);
        EXPECT_EQ(means.time, 40.0);
        const double k = turbulence.means.rows.back().at(turbulence.k_column);
        const double epsilon = turbulence.means.rows.back().at(turbulence.epsilon_column);
        EXPECT_NEAR(means.turbulent_kinetic_energy, k, 1e-8 * k);
        EXPECT_NEAR(means.dissipation_rate, epsilon, 1e-8 * epsilon);
    }
}

TEST_F(SolvedFlow, VolumesComeFromTheMeshWhereTheFieldVIsMissing) {
    for (const char* const format : {"ascii", "ascii_gz", "binary", "binary_gz"}) {
        SCOPED_TRACE(format);
        const fs::path mesh = path(format) / "constant" / "polyMesh";
        const std::vector<double> written = read_scalar_field(path(format) / "40" / "V").values;
        std::vector<std::int64_t> cells(written.size());
        for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = static_cast<std::int64_t>(i);
        const std::vector<double> computed = cell_volumes(mesh, cells);
        for (std::size_t i = 0; i < cells.size(); ++i)
            ASSERT_NEAR(computed[i], written[i], 1e-8 * written[i]);
    }
    const fs::path bare = copy_of("binary", "no_volumes");
    fs::remove(bare / "40" / "V");
    expect_equal(reduced("no_volumes"), reduced("binary"), 1e-12);
    fs::remove(bare / "constant" / "polyMesh" / "points");
    EXPECT_THAT(test::error_of([&] { reduced("no_volumes"); }),
                HasSubstr("40/V: is missing, and so is the mesh that would give it; run 'postProcess -func "
                          "writeCellVolumes -latestTime'"));
}

TEST_F(SolvedFlow, DecomposedFieldsAreSummedOverTheProcessors) {
    for (const char* const format : {"ascii", "binary_gz"}) {
        SCOPED_TRACE(format);
        const std::string name = std::string(format) + "_cut";
        const fs::path folder = copy_of(format, name);
        run_in(folder, {"decomposePar", "-latestTime"});
        fs::remove_all(folder / "40");
        fs::remove_all(folder / "constant" / "polyMesh");
        expect_equal(reduced(name), reduced(format), 1e-9);
        fs::remove(folder / "processor0" / "40" / (std::string(format) == "ascii" ? "V" : "V.gz"));
        expect_equal(reduced(name), reduced(format), 1e-9);
        fs::remove_all(folder / "processor1");
        EXPECT_THAT(
            test::error_of([&] { reduced(name); }),
            HasSubstr("processor1: is missing, but the case is decomposed into 2 parts; copy all of them"));
    }
}

TEST_F(SolvedFlow, ARunOnTwoProcessorsIsReadAsItStands) {
    const fs::path folder = copy_of("binary", "parallel");
    fs::remove_all(folder / "40");
    fs::remove_all(folder / "postProcessing");
    run_in(folder, {"decomposePar"});
    run_in(folder, {"mpirun", "--oversubscribe", "-np", "2", "simpleFoam", "-parallel"});
    // Another order of the solver's sums and another splitting of its matrices: the same flow all the same.
    expect_equal(reduced("parallel"), reduced("binary"), 0.02);
    run_in(folder, {"reconstructPar", "-latestTime"});
    fs::remove_all(folder / "processor1");
    fs::remove_all(folder / "processor0");
    expect_equal(reduced("parallel"), reduced("binary"), 0.02);
}

TEST_F(SolvedFlow, CollatedPartsNameTheirRemedy) {
    const fs::path folder = copy_of("binary", "collated");
    run_in(folder, {"decomposePar", "-latestTime", "-fileHandler", "collated"});
    fs::remove_all(folder / "40");
    EXPECT_THAT(
        test::error_of([&] { reduced("collated"); }),
        HasSubstr("collated: is decomposed in the collated layout; run 'reconstructPar -latestTime'"));
    run_in(folder, {"reconstructPar", "-latestTime", "-fileHandler", "collated"});
    expect_equal(reduced("collated"), reduced("binary"), 1e-9);
}

TEST_F(SolvedFlow, RoundsOfOneSolutionAreOneHistory) {
    const fs::path folder = path("rounds");
    solve(folder, {20, "binary", "off"});
    for (const int end : {30, 40}) {
        set_output(folder, {end, "binary", "off"});
        run_in(folder, {"simpleFoam"});
    }
    EXPECT_TRUE(fs::exists(folder / "postProcessing" / "forces" / "30" / "force.dat"));
    const FoamHistory history = read_joined_history(folder / "postProcessing" / "forces", "force");
    ASSERT_EQ(history.rows.size(), 40U);
    for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(history.rows[i].front(), static_cast<double>(i + 1));
    // OpenFOAM writes less than it needs to go on to the last digit.
    expect_equal(reduced("rounds"), reduced("binary"), 0.02);
}

}  // namespace
}  // namespace samara
