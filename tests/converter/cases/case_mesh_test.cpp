#include "converter/cases/case_mesh.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

/// A solved case on two blocks side by side, 2 x 1 x 1 and 1 x 1 x 1, that stand with their sides z = 0 on
/// the body.
class TwoBlocks : public testing::Test {
  protected:
    TwoBlocks() {
        write("polyMesh/points", "vectorField",
              "12((0 0 0) (2 0 0) (2 1 0) (0 1 0) (0 0 1) (2 0 1) (2 1 1) (0 1 1) (3 0 0) (3 1 0) (3 1 1) (3 "
              "0 1))");
        write("polyMesh/faces", "faceList",
              "11(4(1 2 6 5) 4(0 3 2 1) 4(1 2 9 8) 4(0 4 7 3) 4(0 1 5 4) 4(3 7 6 2) 4(4 5 6 7) 4(8 9 10 11) "
              "4(1 8 11 5) "
              "4(2 6 10 9) 4(5 11 10 6))");
        write("polyMesh/owner", "labelList", "11(0 0 1 0 0 0 0 1 1 1 1)");
        write("polyMesh/neighbour", "labelList", "1(1)");
        write("polyMesh/boundary", "polyBoundaryMesh",
              "2(body { type wall; inGroups 1(wall); nFaces 2; startFace 1; }\n"
              "far { type patch; nFaces 8; startFace 3; })");
        write("100/k", "volScalarField", "internalField nonuniform List<scalar> 2(0.04 0.16);");
        write("100/U", "volVectorField", "internalField nonuniform List<vector> 2((0.3 0.4 7) (1 0 7));");
        parameters("RAS", "nutkWallFunction");
    }
    void write(const std::string& name, const std::string& kind, const std::string& text) const {
        static_cast<void>(
            folder_.file(name, "FoamFile { version 2.0; format ascii; class " + kind + "; object " +
                                   std::filesystem::path(name).filename().string() + "; }\n" + text + "\n"));
    }
    void parameters(const std::string& type, const std::string& wall) const {
        static_cast<void>(folder_.file(
            "parameters", "viscosity 1e-3;\nsimulationType " + type + ";\nnutAtWall " + wall + ";\n"));
    }
    [[nodiscard]] WallSpacing spacing() const { return wall_spacing(folder_.path(), mesh()); }
    [[nodiscard]] PolyMesh mesh() const { return read_poly_mesh(folder_ / "polyMesh"); }

    test::TemporaryFolder folder_;
};

TEST_F(TwoBlocks, WithWallFunctionsItIsByTheTurbulentKineticEnergy) {
    const WallSpacing found = spacing();
    const double unit = std::pow(0.09, 0.25) * 0.5 / 1e-3;
    EXPECT_TRUE(found.wall_functions);
    EXPECT_NEAR(found.least, 0.2 * unit, 1e-9);
    EXPECT_NEAR(found.most, 0.4 * unit, 1e-9);
    EXPECT_NEAR(found.median, found.least, 1e-9);  // on two thirds of the area
    EXPECT_NEAR(found.mean, (2.0 * found.least + found.most) / 3.0, 1e-9);
    EXPECT_EQ(found.below_30, 0.0);
}

TEST_F(TwoBlocks, WhereTheLayerIsResolvedItIsByTheVelocityAlongTheWall) {
    parameters("RAS", "nutLowReWallFunction");
    const WallSpacing found = spacing();
    EXPECT_FALSE(found.wall_functions);
    EXPECT_NEAR(found.least, std::sqrt(0.5 * 0.5 / 1e-3), 1e-9);
    EXPECT_NEAR(found.most, std::sqrt(1.0 * 0.5 / 1e-3), 1e-9);
    EXPECT_NEAR(found.above_1, 1.0, 1e-12);
}

TEST_F(TwoBlocks, FieldsOfAnotherMeshAreRejected) {
    write("100/k", "volScalarField", "internalField nonuniform List<scalar> 1(0.04);");
    EXPECT_THAT(test::error_of([&] { static_cast<void>(spacing()); }),
                HasSubstr("fields and mesh do not match; solve the case again"));
    write("polyMesh/boundary", "polyBoundaryMesh", "1(far { type patch; nFaces 10; startFace 1; })");
    EXPECT_THAT(test::error_of([&] { static_cast<void>(spacing()); }),
                HasSubstr("has no patch for the body"));
    write("polyMesh/boundary", "polyBoundaryMesh", "1(far { type patch; nFaces 99; startFace 1; })");
    EXPECT_THAT(test::error_of([&] { static_cast<void>(mesh()); }), HasSubstr("belong to different meshes"));
    write("polyMesh/boundary", "polyBoundaryMesh", "3(far { type patch; nFaces 9; startFace 1; })");
    EXPECT_THAT(test::error_of([&] { static_cast<void>(mesh()); }), HasSubstr("holds 1 patches, but says 3"));
}

TEST_F(TwoBlocks, ASectionHasTheOutlineOfEachCellAndTheBodysOwn) {
    // The plane y = 0.5: of x to the right and z up, right x up is -y.
    const MeshSection section = mesh_section(mesh(), Vector3d::UnitX(), Vector3d::UnitZ(), -0.5, 10.0, 10.0);
    const auto length = [](const std::vector<MeshSection::Piece>& pieces) {
        double sum = 0.0;
        for (const auto& [from, to] : pieces) sum += (to - from).norm();
        return sum;
    };
    EXPECT_NEAR(length(section.body), 3.0, 1e-12);
    EXPECT_NEAR(length(section.cells), 3.0 + 3.0, 1e-12);  // the upper side, two ends and the side between
    EXPECT_EQ(mesh_section(mesh(), Vector3d::UnitX(), Vector3d::UnitZ(), 2.0, 10.0, 10.0).cells.size(), 0U);
    EXPECT_EQ(mesh_section(mesh(), Vector3d::UnitX(), Vector3d::UnitZ(), -0.5, 0.5, 0.5).body.size(), 1U);
}

}  // namespace
}  // namespace samara
