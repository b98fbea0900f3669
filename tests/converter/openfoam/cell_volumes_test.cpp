#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "converter/openfoam/poly_mesh.hpp"
#include "samara/core/base/linear_algebra.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

/// A mesh of two cells: a block of 2 x 1 x 1 (cell 0) and a pyramid of height 3 upon its face x = 2 (cell 1).
class TwoCells : public testing::Test {
  protected:
    TwoCells() {
        write("points", "vectorField",
              "9((0 0 0) (2 0 0) (2 1 0) (0 1 0) (0 0 1) (2 0 1) (2 1 1) (0 1 1) (5 0.5 0.5))");
        write(
            "faces", "faceList",
            "10(4(1 2 6 5) 4(0 4 7 3) 4(0 1 5 4) 4(3 7 6 2) 4(0 3 2 1) 4(4 5 6 7) 3(1 8 5) 3(5 8 6) 3(6 8 2) "
            "3(2 8 1))");
        write("owner", "labelList", "10(0 0 0 0 0 0 1 1 1 1)");
        write("neighbour", "labelList", "1(1)");
    }
    void write(const std::string& name, const std::string& kind, const std::string& list) {
        static_cast<void>(folder_.file(name, "FoamFile { version 2.0; format ascii; class " + kind +
                                                 "; object " + name + "; }\n" + list + "\n"));
    }

    test::TemporaryFolder folder_;
};

TEST_F(TwoCells, VolumesOfBlockAndPyramid) {
    EXPECT_THAT(cell_volumes(folder_.path(), {0, 1}),
                ElementsAre(DoubleNear(2.0, 1e-14), DoubleNear(1.0, 1e-14)));
    EXPECT_THAT(cell_volumes(folder_.path(), {1}), ElementsAre(DoubleNear(1.0, 1e-14)));
    EXPECT_THAT(cell_volumes(folder_.path(), {}), ElementsAre());
}

TEST_F(TwoCells, AWarpedFaceGivesOneCellWhatItTakesFromTheOther) {
    constexpr double shift = 0.3;
    write("points", "vectorField",
          "9((0 0 0) (2 0 0) (2.3 1 0) (0 1 0) (0 0 1) (2 0 1) (2 1 1) (0 1 1) (5 0.5 0.5))");
    // Cut about the mean of its points, the face bulges by a quarter of the shift on average.
    const double block = 2.0 + 0.25 * shift;
    const std::vector<Vector3d> rim = {{2, 0, 0}, {2 + shift, 1, 0}, {2, 1, 1}, {2, 0, 1}};
    const Vector3d middle(2 + 0.25 * shift, 0.5, 0.5);
    const Vector3d top = Vector3d(5, 0.5, 0.5) - middle;
    double pyramid = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        pyramid += (rim[i] - middle).cross(rim[(i + 1) % 4] - middle).dot(top) / 6.0;
    }
    const std::vector<double> volumes = cell_volumes(folder_.path(), {0, 1});
    EXPECT_NEAR(volumes[0] + volumes[1], block + pyramid, 1e-14);
    // A face's pyramid is taken from its centre alone, which costs a warped face a little.
    EXPECT_NEAR(volumes[0], block, 0.01 * block);
}

TEST_F(TwoCells, MeshesThatDoNotFitAreRejected) {
    EXPECT_THAT(test::error_of([&] { cell_volumes(folder_.path(), {2}); }),
                HasSubstr("the mesh has no cell 2, which its zone contains"));
    write("owner", "labelList", "9(0 0 0 0 0 0 1 1 1)");
    EXPECT_THAT(test::error_of([&] { cell_volumes(folder_.path(), {0}); }),
                HasSubstr("owner, neighbour and faces belong to different meshes"));
    write("owner", "labelList", "10(0 0 0 0 0 0 1 1 1 1)");
    write("points", "vectorField", "1((0 0 0))");
    EXPECT_THAT(test::error_of([&] { cell_volumes(folder_.path(), {0}); }),
                HasSubstr("faces: face 0 has the point 1, but there are 1"));
}

}  // namespace
}  // namespace samara
