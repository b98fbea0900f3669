// Files as OpenVDB itself writes them.
#include <fstream>
#include <limits>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include "converter/wind/wind_readers.hpp"
#include "samara/core/wind/wind_field.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

constexpr int nodes = 12;
constexpr double voxel = 0.5;

openvdb::Vec3s rotating_flow(const openvdb::Vec3d& place) {
    return {static_cast<float>(-place.y() + 0.25 * place.z()), static_cast<float>(place.x()),
            static_cast<float>(2.0 * place.z())};
}

openvdb::Vec3SGrid::Ptr vectors(const std::string& name, double factor = 1.0, double size = voxel) {
    auto grid = openvdb::Vec3SGrid::create();
    grid->setName(name);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(size));
    auto accessor = grid->getAccessor();
    for (openvdb::Coord at(-nodes); at.x() <= nodes; ++at.x()) {
        for (at.y() = -nodes; at.y() <= nodes; ++at.y()) {
            for (at.z() = 0; at.z() <= nodes; ++at.z()) {
                accessor.setValue(at, static_cast<float>(factor) * rotating_flow(grid->indexToWorld(at)));
            }
        }
    }
    return grid;
}

openvdb::FloatGrid::Ptr component(const openvdb::Vec3SGrid& whole, int index, const std::string& name) {
    auto grid = openvdb::FloatGrid::create();
    grid->setName(name);
    grid->setTransform(whole.transform().copy());
    auto accessor = grid->getAccessor();
    for (auto value = whole.cbeginValueOn(); value; ++value)
        accessor.setValue(value.getCoord(), (*value)[index]);
    return grid;
}

class VdbWind : public testing::Test {
  protected:
    static void SetUpTestSuite() { openvdb::initialize(); }

    std::filesystem::path file(const std::string& name, const openvdb::GridCPtrVec& grids) {
        const std::filesystem::path path = folder_.path() / name;
        openvdb::io::File(path.string()).write(grids);
        return path;
    }
    std::string error(const std::filesystem::path& path, const VdbOptions& options = {}) {
        return test::error_of([&] { read_vdb_wind({path}, options); });
    }

    test::TemporaryFolder folder_;
};

Vector3d at(const WindGrid& grid, const Vector3d& place, double time = 0.0) {
    return grid_wind({.grid = std::make_shared<const WindGrid>(grid)}, place, time).velocity;
}

TEST_F(VdbWind, AVelocityGridIsTakenWhereItIs) {
    const WindGrid grid = read_vdb_wind({file("a.vdb", {vectors("velocity")})}, {});
    EXPECT_EQ(grid.nodes, (std::array<std::size_t, 3>{25, 25, 13}));
    EXPECT_EQ(grid.spacing, Vector3d(voxel, voxel, voxel));
    EXPECT_EQ(grid.origin, Vector3d(-6.0, -6.0, 0.0));
    const Vector3d place(1.3, -2.2, 3.1);
    EXPECT_LT((at(grid, place) - Vector3d(2.2 + 0.25 * 3.1, 1.3, 6.2)).norm(), 1e-5);
}

TEST_F(VdbWind, HoudinisThreeGridsWithYUpBecomeZUp) {
    const auto whole = vectors("any");
    const auto path = file("a.vdb", {component(*whole, 0, "vel.x"), component(*whole, 1, "vel.y"),
                                     component(*whole, 2, "vel.z")});
    const WindGrid grid = read_vdb_wind({path}, {.y_up = true});
    // The file's place (x, y, z) is (x, -z, y) here, and so are velocities.
    const Vector3d place(1.3, -3.1, -2.2);
    const openvdb::Vec3s there = rotating_flow({1.3, -2.2, 3.1});
    EXPECT_LT((at(grid, place) - Vector3d(there.x(), -there.z(), there.y())).norm(), 1e-5);
}

TEST_F(VdbWind, AStaggeredGridIsReadBetweenItsFaces) {
    const auto grid = vectors("v");
    grid->setGridClass(openvdb::GRID_STAGGERED);
    // Component i of a staggered grid lies half a voxel down along axis i.
    auto accessor = grid->getAccessor();
    for (auto value = grid->beginValueOn(); value; ++value) {
        openvdb::Vec3s faces;
        for (int i = 0; i < 3; ++i) {
            openvdb::Vec3d index = value.getCoord().asVec3d();
            index[i] -= 0.5;
            faces[i] = rotating_flow(grid->indexToWorld(index))[i];
        }
        value.setValue(faces);
    }
    const WindGrid wind = read_vdb_wind({file("a.vdb", {grid})}, {});
    EXPECT_LT((at(wind, Vector3d(1.3, -2.2, 3.1)) - Vector3d(2.2 + 0.25 * 3.1, 1.3, 6.2)).norm(), 1e-5);
}

TEST_F(VdbWind, FilesAreTimes) {
    std::vector<std::filesystem::path> files;
    for (int i = 0; i < 4; ++i) files.push_back(file(fmt::format("{}.vdb", i), {vectors("vel", i)}));
    double reported = 0.0;
    const WindGrid grid =
        read_vdb_wind(files, {.frame_rate = 10.0, .progress = [&](double done, double total) {
                                  EXPECT_LE(reported, done);
                                  reported = done / total;
                              }});
    EXPECT_EQ(reported, 1.0);
    EXPECT_EQ(grid.frames, 4U);
    EXPECT_NEAR(grid.duration(), 0.3, 1e-15);
    const Vector3d place(1.3, -2.2, 3.1);
    EXPECT_LT((at(grid, place, 0.15) - 1.5 * Vector3d(2.2 + 0.25 * 3.1, 1.3, 6.2)).norm(), 1e-4);
}

TEST_F(VdbWind, ACoarserSpacingMayBeAskedFor) {
    const WindGrid grid = read_vdb_wind({file("a.vdb", {vectors("velocity")})}, {.spacing = 1.0});
    EXPECT_EQ(grid.nodes, (std::array<std::size_t, 3>{13, 13, 7}));
    EXPECT_LT((at(grid, Vector3d(1.3, -2.2, 3.1)) - Vector3d(2.2 + 0.25 * 3.1, 1.3, 6.2)).norm(), 1e-5);
    EXPECT_THAT(
        test::error_of([&] { read_vdb_wind({file("b.vdb", {vectors("velocity")})}, {.spacing = 1e-3}); }),
        HasSubstr("give a larger --spacing"));
}

TEST_F(VdbWind, WhatIsNoVelocityIsNamed) {
    auto density = openvdb::FloatGrid::create();
    density->setName("density");
    density->getAccessor().setValue(openvdb::Coord(0), 1.0F);
    EXPECT_THAT(error(file("smoke.vdb", {density})),
                HasSubstr("smoke.vdb: holds the grids density, none of which is recognised"));
    EXPECT_THAT(error(file("two.vdb", {vectors("a"), vectors("b")})), HasSubstr("--grid"));
    EXPECT_THAT(error(file("two.vdb", {vectors("a"), vectors("b")}), {.grid = "c"}),
                HasSubstr("no single-precision velocity 'c'"));
    EXPECT_EQ(read_vdb_wind({file("two.vdb", {vectors("a"), vectors("b")})}, {.grid = "b"}).frames, 1U);
    auto empty = openvdb::Vec3SGrid::create();
    empty->setName("velocity");
    empty->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
    EXPECT_THAT(error(file("empty.vdb", {empty})),
                HasSubstr("empty.vdb: none of the files has an active voxel"));
}

TEST_F(VdbWind, IndexSpaceWantsTheSizeOfAVoxel) {
    const auto path = file("a.vdb", {vectors("velocity", 1.0, 1.0)});
    EXPECT_THAT(error(path),
                HasSubstr("is in index space and does not define its voxel size; give --voxel-size"));
    const WindGrid grid = read_vdb_wind({path}, {.voxel_size = 0.1});
    EXPECT_NEAR(grid.spacing.x(), 0.1, 1e-12);
    // A place 10 voxels away is 1 m away now, with the same velocity.
    EXPECT_LT((at(grid, Vector3d(1.0, 0.0, 0.5)) - Vector3d(1.25, 10.0, 10.0)).norm(), 1e-4);
}

TEST_F(VdbWind, NumbersThatAreNotFiniteAreFound) {
    const auto grid = vectors("velocity");
    grid->getAccessor().setValue(openvdb::Coord(2, 0, 4),
                                 openvdb::Vec3s(0.0F, std::numeric_limits<float>::quiet_NaN(), 0.0F));
    EXPECT_THAT(error(file("a.vdb", {grid})), HasSubstr("is not finite"));
}

TEST_F(VdbWind, DamagedFilesAreRejected) {
    const auto path = file("a.vdb", {vectors("velocity")});
    const auto size = std::filesystem::file_size(path);
    for (const double share : {0.0, 0.01, 0.5}) {
        std::filesystem::resize_file(path, static_cast<std::uintmax_t>(share * static_cast<double>(size)));
        EXPECT_THAT(error(path), HasSubstr("a.vdb: cannot be read as OpenVDB")) << share;
    }
    EXPECT_THAT(error(folder_.path() / "nowhere.vdb"), HasSubstr("nowhere.vdb"));
    std::ofstream(folder_.path() / "text.vdb") << "not a grid\n";
    EXPECT_THAT(error(folder_.path() / "text.vdb"), HasSubstr("text.vdb: cannot be read as OpenVDB"));
}

}  // namespace
}  // namespace samara
