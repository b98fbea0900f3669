// Winds of a case that OpenFOAM meshed and solved: the flow past a cube of cube-flow/.
#include <fstream>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "converter/wind/wind_readers.hpp"
#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

void run_in(const fs::path& folder, std::vector<std::string> words) {
    const std::vector<std::string> environment = {"env", "WM_PROJECT_DIR=/usr/share/openfoam",
                                                  "OMPI_ALLOW_RUN_AS_ROOT=1",
                                                  "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"};
    words.insert(words.begin(), environment.begin(), environment.end());
    ASSERT_EQ(run_subprocess(words, folder / "log", folder), 0) << read_bytes(folder / "log");
}

class FoamWind : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<test::TemporaryFolder>();
        fs::copy(fs::path(SAMARA_SOURCE_DIRECTORY) / "tests/converter/cube-flow", flow(),
                 fs::copy_options::recursive);
        std::ofstream(flow() / "output")
            << "endTime 30;\nwriteInterval 10;\nwriteFormat ascii;\nwriteCompression off;\n";
        run_in(flow(), {"./Allrun"});
    }
    static void TearDownTestSuite() { folder_.reset(); }
    static fs::path flow() { return folder_->path() / "flow"; }
    /// A copy without the times, but for one whose U is the place itself, as OpenFOAM says where cells are.
    static fs::path places() {
        const fs::path copy = folder_->path() / "places";
        if (fs::exists(copy)) return copy;
        fs::copy(flow(), copy, fs::copy_options::recursive);
        run_in(copy, {"postProcess", "-func", "writeCellCentres", "-time", "30"});
        for (const char* time : {"0", "10", "20"}) fs::remove_all(copy / time);
        fs::remove(copy / "30" / "U");
        fs::rename(copy / "30" / "C", copy / "30" / "U");
        return copy;
    }
    static std::string error(const fs::path& folder, const FoamWindOptions& options = {.spacing = 0.2}) {
        return test::error_of([&] { read_foam_wind(folder, options); });
    }

    static std::unique_ptr<test::TemporaryFolder> folder_;
};

std::unique_ptr<test::TemporaryFolder> FoamWind::folder_;

TEST_F(FoamWind, AFieldThatIsThePlaceIsReadAsThePlace) {
    const WindGrid whole = read_foam_wind(places(), {.spacing = 0.25});
    const Vector3d last(static_cast<double>(whole.nodes[0] - 1), static_cast<double>(whole.nodes[1] - 1),
                        static_cast<double>(whole.nodes[2] - 1));
    const Vector3d end = whole.origin + last.cwiseProduct(whole.spacing);
    const Vector3d size = end - whole.origin;
    // Well within the mesh, beside the cube in its middle.
    const Eigen::AlignedBox3d box(whole.origin + 0.7 * size, whole.origin + 0.9 * size);
    const WindGrid part = read_foam_wind(places(), {.spacing = 0.04 * size.minCoeff(), .box = box});
    std::size_t node = 0;
    for (std::size_t z = 0; z < part.nodes[2]; ++z) {
        for (std::size_t y = 0; y < part.nodes[1]; ++y) {
            for (std::size_t x = 0; x < part.nodes[0]; ++x, node += 3) {
                const Vector3d steps(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
                const Vector3d place = part.origin + steps.cwiseProduct(part.spacing);
                const Vector3d found(part.velocities[node], part.velocities[node + 1],
                                     part.velocities[node + 2]);
                EXPECT_LT((found - place).norm(), 1e-4 * size.norm()) << place.transpose();
            }
        }
    }
    EXPECT_GT(node, 3U * 30U);
}

TEST_F(FoamWind, YUpBecomesZUp) {
    const WindGrid upright = read_foam_wind(places(), {.spacing = 0.25});
    const WindGrid z_up = read_foam_wind(places(), {.spacing = 0.25, .y_up = true});
    EXPECT_EQ(z_up.nodes[2], upright.nodes[1]);
    EXPECT_EQ(z_up.nodes[1], upright.nodes[2]);
    EXPECT_EQ(z_up.origin.z(), upright.origin.y());
}

TEST_F(FoamWind, TimesAreThoseThatWereWritten) {
    fs::remove_all(flow() / "0");
    const WindGrid grid = read_foam_wind(flow(), {.spacing = 0.25});
    EXPECT_EQ(grid.frames, 3U);
    EXPECT_NEAR(grid.duration(), 20.0, 1e-9);
    const WindGrid latest = read_foam_wind(flow(), {.spacing = 0.25, .latest = true});
    ASSERT_EQ(latest.frames, 1U);
    const std::vector<float> tail(
        grid.velocities.end() - static_cast<std::ptrdiff_t>(latest.velocities.size()), grid.velocities.end());
    EXPECT_EQ(tail, latest.velocities);
    double fastest = 0.0;
    double slowest = 1e9;
    for (std::size_t i = 0; i < latest.velocities.size(); i += 3) {
        const double speed =
            Vector3d(latest.velocities[i], latest.velocities[i + 1], latest.velocities[i + 2]).norm();
        fastest = std::max(fastest, speed);
        slowest = std::min(slowest, speed);
    }
    EXPECT_GT(fastest, 0.9);  // the stream is 1 m/s
    EXPECT_EQ(slowest, 0.0);  // within the cube
}

TEST_F(FoamWind, WhatIsNoSolvedCaseIsRejected) {
    EXPECT_THAT(error(folder_->path() / "nowhere"), HasSubstr("nowhere"));
    const fs::path unsolved = folder_->path() / "unsolved";
    fs::copy(places(), unsolved, fs::copy_options::recursive);
    fs::remove_all(unsolved / "30");
    EXPECT_THAT(error(unsolved), HasSubstr("has no time folder with a velocity U"));
    fs::copy(places() / "30", unsolved / "1", fs::copy_options::recursive);
    fs::copy(places() / "30", unsolved / "2", fs::copy_options::recursive);
    fs::copy(places() / "30", unsolved / "5", fs::copy_options::recursive);
    EXPECT_THAT(error(unsolved), HasSubstr("are not equally spaced"));
    const Vector3d far(1e3, 1e3, 1e3);
    EXPECT_THAT(error(places(), {.spacing = 1.0, .box = Eigen::AlignedBox3d(far, far + Vector3d::Ones())}),
                HasSubstr("no node lies in the mesh"));
    EXPECT_THAT(error(places(), {.spacing = 1e-4}), HasSubstr("give a larger --spacing"));
    fs::resize_file(unsolved / "5" / "U", 2000);
    EXPECT_THAT(test::error_of([&] { read_foam_wind(unsolved, {.spacing = 0.5, .latest = true}); }),
                HasSubstr("U"));
}

}  // namespace
}  // namespace samara
