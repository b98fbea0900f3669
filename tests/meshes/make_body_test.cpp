#include "meshes/make_body.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include "meshes/checks/sound_surface.hpp"
#include "meshes/shape_files.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/kirchhoff/kirchhoff_solver.hpp"
#include "samara/kirchhoff/solvers/tensor_error.hpp"
#include "support/expect_error.hpp"
#include "support/known_bodies.hpp"
#include "support/obstacles.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using std::numbers::pi;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double ellipsoid_volume = 4.0 / 3.0 * pi * 0.01 * 0.02 * 0.04;

MeshOptions with_triangles(int count, int order = automatic_order) {
    MeshOptions options;
    options.triangles = count;
    options.as_many_as_needed = false;
    options.order = order;
    return options;
}

MeshOptions keep() {
    MeshOptions options;
    options.sizing = MeshOptions::Sizing::keep;
    return options;
}

struct Shape {
    const char* file;
    double volume;
    double tolerance;  // relative: what flat triangles leave out of a curved body, or rounding
    Symmetry::Type type;
    std::size_t elements;
};

class ShapeOfSamara : public ::testing::TestWithParam<Shape> {};

TEST_P(ShapeOfSamara, MakesAValidBody) {
    const Shape& shape = GetParam();
    const Body body = make_body(test::shape_of_samara(shape.file));
    EXPECT_NEAR(static_cast<double>(body.surface.triangle_count()), 1280.0, 0.1 * 1280.0);
    EXPECT_NO_THROW(require_sound_surface(body.surface));
    EXPECT_NEAR(body.moments.volume, shape.volume, shape.tolerance * shape.volume);
    EXPECT_EQ(body.symmetry.type, shape.type);
    EXPECT_EQ(body.symmetry.elements.size(), shape.elements);
    EXPECT_TRUE(body.symmetry.axes.isIdentity(0.0));
    EXPECT_EQ(body.name, std::filesystem::path(shape.file).stem());
    EXPECT_THAT(body.source, AllOf(HasSubstr(shape.file), HasSubstr("1280 triangles"), HasSubstr("gmsh 4.")));
}

// The leaf and the samara have no closed form: their volumes are of meshes of 20,000 curved triangles.
INSTANTIATE_TEST_SUITE_P(
    , ShapeOfSamara,
    ::testing::Values(Shape{"sphere.geo", 4.0 / 3.0 * pi * 8e-6, 0.015, Symmetry::Type::spherical, 2},
                      Shape{"ellipsoid.geo", ellipsoid_volume, 0.02, Symmetry::Type::finite, 8},
                      Shape{"disc.geo", pi * 4e-4 * 0.002, 0.005, Symmetry::Type::axial, 4},
                      Shape{"sheet.geo", 0.083 * 0.083 * 0.0001, 1e-9, Symmetry::Type::finite, 16},
                      Shape{"cube.geo", 8e-6, 1e-9, Symmetry::Type::finite, 48},
                      // The folded sheet's own volume, but for the corners of the cut edges.
                      Shape{"airplane.geo", 0.083 * 0.083 * 0.0001, 0.005, Symmetry::Type::finite, 2},
                      Shape{"leaf.geo", 3.8565e-7, 0.02, Symmetry::Type::finite, 2},
                      Shape{"samara.geo", 2.5554e-7, 0.04, Symmetry::Type::finite, 2}),
    [](const auto& shape) { return std::filesystem::path(shape.param.file).stem().string(); });

TEST(MakeBody, ReachesTheCountOfTrianglesFromHundredsToThousands) {
    for (const int count : {300, 5000}) {
        const Body body = make_body(test::shape_of_samara("disc.geo"), with_triangles(count));
        EXPECT_NEAR(static_cast<double>(body.surface.triangle_count()), count, 0.1 * count);
    }
}

TEST(MakeBody, CurvedTrianglesAreAHundredTimesMoreAccurate) {
    const double flat =
        make_body(test::shape_of_samara("ellipsoid.geo"), with_triangles(1280, 1)).moments.volume;
    const Body curved = make_body(test::shape_of_samara("ellipsoid.geo"), with_triangles(1280, 2));
    EXPECT_EQ(curved.surface.order(), 2);
    EXPECT_LT(std::abs(curved.moments.volume - ellipsoid_volume), 0.01 * std::abs(flat - ellipsoid_volume));
    for (const Vector3d& vertex : curved.surface.vertices) {
        const Vector3d scaled = vertex.cwiseQuotient(Vector3d(0.01, 0.02, 0.04));
        EXPECT_NEAR(scaled.norm(), 1.0, 1e-6);
    }
}

/// The error of the added mass of the 1:2:4 ellipsoid on the surface.
double added_mass_error(const Surface& surface) {
    const Body exact = test::rubber_ellipsoid();
    const KirchhoffTensor found = kirchhoff_tensor(surface, exact.moments);
    return relative_tensor_error(found.matrix, exact.kirchhoff->matrix,
                                 {exact.moments.volume, exact.moments.surface_area});
}

TEST(MakeBody, AddedMassIsWithinTwiceOfThatOnAnIdealMesh) {
    const double ideal = added_mass_error(test::curved_ellipsoid({0.01, 0.02, 0.04}, 3));
    const Surface meshed = make_body(test::shape_of_samara("ellipsoid.geo"), with_triangles(1280)).surface;
    EXPECT_LT(added_mass_error(meshed), 2.0 * ideal);
}

TEST(MakeBody, AddedMassFromFineFacetsIsWithinTwiceOfThatOnAnIdealMesh) {
    const test::TemporaryFolder folder;
    const Vector3d semi_axes(0.01, 0.02, 0.04);
    const double ideal = added_mass_error(test::curved_ellipsoid(semi_axes, 3));
    test::write_binary_stl(folder / "ellipsoid.stl", test::ellipsoid(semi_axes, 5));
    const Surface meshed = make_body(folder / "ellipsoid.stl", with_triangles(1280)).surface;
    EXPECT_LT(added_mass_error(meshed), 2.0 * ideal);
}

TEST(MakeBody, NodesOfEdgesLieInTheMiddleAsTheEllipsoidStretchesThem) {
    const Vector3d semi_axes(0.01, 0.02, 0.04);
    const Surface surface = make_body(test::shape_of_samara("ellipsoid.geo"), with_triangles(320)).surface;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        for (std::size_t side = 0; side < 3; ++side) {
            const auto at = [&](std::int32_t index) {
                return surface.vertices[static_cast<std::size_t>(index)];
            };
            const Vector3d one = at(surface.corners[t][side]);
            const Vector3d two = at(surface.corners[t][(side + 1) % 3]);
            const Vector3d middle = 0.5 * (one + two);
            const Vector3d ideal = middle / middle.cwiseQuotient(semi_axes).norm();
            EXPECT_LT((at(surface.edge_nodes[t][side]) - ideal).norm(), 0.01 * (two - one).norm());
        }
    }
}

TEST(MakeBody, SizeIsThatOfTheLargestTriangles) {
    MeshOptions options;
    options.sizing = MeshOptions::Sizing::size;
    options.size = 0.004;
    const Body body = make_body(test::shape_of_samara("sphere.geo"), options);
    double longest = 0.0;
    for (const auto& triangle : body.surface.corners) {
        const Vector3d side = body.surface.vertices[static_cast<std::size_t>(triangle[1])] -
                              body.surface.vertices[static_cast<std::size_t>(triangle[0])];
        longest = std::max(longest, side.norm());
    }
    EXPECT_NEAR(longest, 0.004, 0.002);
}

TEST(MakeBody, ScaleIsMetresForOneUnitOfTheFile) {
    MeshOptions options = with_triangles(1280);
    const VolumeMoments one = make_body(test::shape_of_samara("cube.geo"), options).moments;
    options.scale = 10.0;
    const Body body = make_body(test::shape_of_samara("cube.geo"), options);
    EXPECT_NEAR(body.moments.volume, 1e3 * one.volume, 1e-9);
    EXPECT_NEAR(body.moments.surface_area, 1e2 * one.surface_area, 1e-9);
    EXPECT_NEAR(static_cast<double>(body.surface.triangle_count()), 1280.0, 128.0);
}

TEST(MakeBody, KeepsTheTrianglesOfTextAndBinaryStlAndObj) {
    const test::TemporaryFolder folder;
    const Surface surface = test::ellipsoid(Vector3d(0.01, 0.02, 0.04), 2, Vector3d(0.1, 0.2, 0.3));
    test::write_stl(folder / "a.stl", surface);
    test::write_binary_stl(folder / "b.STL", surface);
    test::write_obj(folder / "c.obj", surface);
    const VolumeMoments expected = test::moments_of(surface);
    for (const char* name : {"a.stl", "b.STL", "c.obj"}) {
        const Body body = make_body(folder / name, keep());
        EXPECT_EQ(body.surface.triangle_count(), surface.triangle_count());
        EXPECT_EQ(body.surface.vertices.size(), surface.vertices.size());
        EXPECT_NEAR(body.moments.volume, expected.volume, 2e-6 * expected.volume) << name;
        EXPECT_LT((body.moments.centroid - expected.centroid).norm(), 1e-7);
    }
    // Neither reads nor remeshes triangles.
    EXPECT_THAT(make_body(folder / "a.stl").source, Not(HasSubstr("gmsh")));
}

TEST(MakeBody, RemeshesTriangles) {
    const test::TemporaryFolder folder;
    test::write_stl(folder / "box.stl", test::box(Vector3d(0.01, 0.02, 0.03), 1));
    const Body box = make_body(folder / "box.stl", with_triangles(600));
    EXPECT_NEAR(static_cast<double>(box.surface.triangle_count()), 600.0, 60.0);
    EXPECT_NEAR(box.moments.volume, 6e-6, 1e-15);
    EXPECT_EQ(box.symmetry.elements.size(), 8U);

    const Surface ellipsoid = test::ellipsoid(Vector3d(0.01, 0.02, 0.04), 4);
    test::write_obj(folder / "ellipsoid.obj", ellipsoid);
    const Body body = make_body(folder / "ellipsoid.obj", with_triangles(1280, 2));
    EXPECT_EQ(body.surface.order(), 2);
    EXPECT_NEAR(static_cast<double>(body.surface.triangle_count()), 1280.0, 128.0);
    EXPECT_EQ(body.symmetry.elements.size(), 8U);
}

// The facets' own volume is 2e-3 too small.
TEST(MakeBody, CurvedTrianglesLieOnTheSmoothShapeThatFacetsStandFor) {
    const test::TemporaryFolder folder;
    const Vector3d semi_axes(0.01, 0.02, 0.04);
    test::write_binary_stl(folder / "ellipsoid.stl", test::ellipsoid(semi_axes, 4));
    const Body body = make_body(folder / "ellipsoid.stl", with_triangles(1280));
    EXPECT_EQ(body.surface.order(), 2);
    EXPECT_NEAR(body.moments.volume, ellipsoid_volume, 2e-4 * ellipsoid_volume);
    for (const Vector3d& vertex : body.surface.vertices) {
        EXPECT_NEAR(vertex.cwiseQuotient(semi_axes).norm(), 1.0, 3e-4);
    }
}

TEST(MakeBody, AutomaticOrderIsTwoForCurvedBodiesAndOneForPolyhedra) {
    const test::TemporaryFolder folder;
    test::write_stl(folder / "box.stl", test::box(Vector3d(0.01, 0.02, 0.03), 4));
    EXPECT_EQ(make_body(folder / "box.stl", with_triangles(600)).surface.order(), 1);
    EXPECT_EQ(make_body(folder / "box.stl", with_triangles(600, 2)).surface.order(), 2);
    EXPECT_EQ(make_body(test::shape_of_samara("sheet.geo"), with_triangles(600)).surface.order(), 1);
    EXPECT_EQ(make_body(test::shape_of_samara("disc.geo"), with_triangles(600)).surface.order(), 2);
    EXPECT_EQ(make_body(test::shape_of_samara("disc.geo"), with_triangles(600, 1)).surface.order(), 1);
    // Kept triangles stay as they are.
    test::write_stl(folder / "ball.stl", test::icosphere(2));
    EXPECT_EQ(make_body(folder / "ball.stl", keep()).surface.order(), 1);
}

TEST(MakeBody, ADenseScanIsReducedAndStaysOnTheShape) {
    const test::TemporaryFolder folder;
    const Vector3d semi_axes(0.01, 0.02, 0.04);
    test::write_binary_stl(folder / "scan.stl", test::ellipsoid(semi_axes, 6));
    const Body body = make_body(folder / "scan.stl", with_triangles(600));
    EXPECT_NEAR(static_cast<double>(body.surface.triangle_count()), 600.0, 60.0);
    EXPECT_EQ(body.symmetry.elements.size(), 8U);
    for (const Vector3d& vertex : body.surface.vertices) {
        EXPECT_NEAR(vertex.cwiseQuotient(semi_axes).norm(), 1.0, 3e-5);
    }
}

TEST(MakeBody, ADenseScanOfAThinPlateKeepsItsThicknessAndEdges) {
    const test::TemporaryFolder folder;
    test::write_binary_stl(folder / "plate.stl", test::box(Vector3d(0.083, 0.083, 0.0001), 60));
    const Body body = make_body(folder / "plate.stl");
    EXPECT_NEAR(static_cast<double>(body.surface.triangle_count()), 1280.0, 128.0);
    EXPECT_EQ(body.surface.order(), 1);
    EXPECT_NEAR(body.moments.volume, 0.083 * 0.083 * 0.0001, 1e-6 * 6.889e-07);
    EXPECT_NEAR(body.moments.surface_area, 2.0 * 0.083 * 0.083 + 4.0 * 0.083 * 0.0001, 1e-8);
    EXPECT_EQ(body.symmetry.elements.size(), 16U);
}

TEST(MakeBody, TellsItsProgress) {
    const test::TemporaryFolder folder;
    test::write_stl(folder / "ball.stl", test::icosphere(4));
    std::vector<double> shares;
    make_body(folder / "ball.stl", {}, [&](double share) { shares.push_back(share); });
    EXPECT_GT(shares.size(), 5U);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_GE(shares.front(), 0.0);
    EXPECT_LE(shares.back(), 1.0);
}

TEST(MakeBody, RemeshingKeepsTheShallowFoldsOfAThinBody) {
    const test::TemporaryFolder folder;
    const Body airplane = make_body(test::shape_of_samara("airplane.geo"), with_triangles(400));
    test::write_stl(folder / "airplane.stl", airplane.surface);
    const Body body = make_body(folder / "airplane.stl", with_triangles(600));
    EXPECT_NEAR(body.moments.volume, airplane.moments.volume, 1e-3 * airplane.moments.volume);
    EXPECT_EQ(body.symmetry.elements.size(), 2U);
}

TEST(MakeBody, HonoursTheUnitOfAStepFile) {
    const test::TemporaryFolder folder;
    // gmsh writes STEP in millimetres.
    test::write_with_gmsh(folder / "ball.step", [] {
        gmsh::model::occ::addSphere(0.0, 0.0, 0.0, 20.0);
        gmsh::model::occ::synchronize();
    });
    const Body body = make_body(folder / "ball.step", with_triangles(1280, 2));
    EXPECT_NEAR(body.moments.volume, 4.0 / 3.0 * pi * 8e-6, 1e-4 * 3.35e-5);
    EXPECT_EQ(body.symmetry.type, Symmetry::Type::spherical);
}

TEST(MakeBody, TheSymmetryOfAStepFileIsTheSameInAnyUnit) {
    for (const double size : {0.01, 1.0, 10.0, 1e3, 1e5}) {
        const test::TemporaryFolder folder;
        test::write_with_gmsh(folder / "cone.step", [&] {
            gmsh::model::occ::addCone(0.0, 0.0, 0.0, 0.0, 0.0, 2.0 * size, size, 0.0);
            gmsh::model::occ::synchronize();
        });
        const Body body = make_body(folder / "cone.step");
        const double metres = 1e-3 * size;
        EXPECT_EQ(body.symmetry.type, Symmetry::Type::axial) << size;
        EXPECT_NEAR(body.moments.volume / (metres * metres * metres), 2.0 / 3.0 * pi, 1e-3) << size;
    }
}

TEST(MakeBody, SolidsThatTouchOrOverlapAreOne) {
    const auto boxes = [](double shift, double size) {
        return [=] {
            gmsh::model::occ::addBox(0.0, 0.0, 0.0, 1e3, 1e3, 1e3);
            gmsh::model::occ::addBox(shift, 0.0, 0.0, 1e3, size, size);
            gmsh::model::occ::synchronize();
        };
    };
    for (const char* name : {"two.step", "two.brep"}) {
        const test::TemporaryFolder folder;
        MeshOptions options = with_triangles(600);
        options.scale = std::string(name).ends_with("brep") ? 1e-3 : 1.0;
        test::write_with_gmsh(folder / name, boxes(1e3, 1e3));
        EXPECT_NEAR(make_body(folder / name, options).moments.volume, 2.0, 1e-9) << "a common side";
        test::write_with_gmsh(folder / name, boxes(1e3, 500.0));
        EXPECT_NEAR(make_body(folder / name, options).moments.volume, 1.25, 1e-9) << "a part of a side";
        test::write_with_gmsh(folder / name, boxes(500.0, 1e3));
        EXPECT_NEAR(make_body(folder / name, options).moments.volume, 1.5, 1e-9) << "an overlap";
        test::write_with_gmsh(folder / name, boxes(2e3, 1e3));
        EXPECT_NEAR(make_body(folder / name, options).moments.volume, 2.0, 1e-9) << "a gap";
    }
}

TEST(MakeBody, SolidsOfAScriptThatTouchAreOne) {
    const test::TemporaryFolder folder;
    const auto script = folder.file("two.geo",
                                    "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n"
                                    "Box(2) = {1, 0.2, 0.2, 1, 0.5, 0.5};\n");
    EXPECT_NEAR(make_body(script).moments.volume, 1.25, 1e-9);
}

TEST(MakeBody, NamesTheUnitWhereNoBodyIsSoLarge) {
    const test::TemporaryFolder folder;
    test::write_stl(folder / "a.stl", test::box(Vector3d::Constant(3e9), 1));
    EXPECT_THAT(test::error_of([&] { make_body(folder / "a.stl"); }),
                AllOf(HasSubstr("a.stl: "), HasSubstr("which is too large"), HasSubstr("--scale")));
    MeshOptions options;
    options.scale = 1e-9;
    EXPECT_NEAR(make_body(folder / "a.stl", options).moments.volume, 27.0, 1e-9);
}

TEST(MakeBody, ReadsBrepAndLeavesInnerWallsOut) {
    const test::TemporaryFolder folder;
    test::write_with_gmsh(folder / "two.brep", [] {
        gmsh::model::occ::addBox(0.0, 0.0, 0.0, 1.0, 1.0, 1.0);
        gmsh::model::occ::addBox(1.0, 0.0, 0.0, 1.0, 1.0, 1.0);
        gmsh::vectorpair parts;
        std::vector<gmsh::vectorpair> origin;
        gmsh::model::occ::fragment({{3, 1}}, {{3, 2}}, parts, origin);
        gmsh::model::occ::synchronize();
    });
    const Body body = make_body(folder / "two.brep", with_triangles(600));
    EXPECT_NEAR(body.moments.volume, 2.0, 1e-12);
    EXPECT_NEAR(body.moments.surface_area, 10.0, 1e-12);
}

TEST(MakeBody, ReadsMshOfBothOrders) {
    const test::TemporaryFolder folder;
    for (const int order : {1, 2}) {
        test::write_with_gmsh(folder / "ball.msh", [&] {
            gmsh::option::setNumber("Mesh.MeshSizeMax", 0.25);
            gmsh::model::occ::addSphere(0.0, 0.0, 0.0, 1.0);
            gmsh::model::occ::synchronize();
            gmsh::model::mesh::generate(2);
            gmsh::model::mesh::setOrder(order);
        });
        MeshOptions options = keep();
        options.order = order;
        const Body body = make_body(folder / "ball.msh", options);
        EXPECT_EQ(body.surface.order(), order);
        EXPECT_NEAR(body.moments.volume, 4.0 / 3.0 * pi, order == 1 ? 0.1 : 1e-3);
    }
}

TEST(MakeBody, TakesTheSurfaceOfABodyFile) {
    const test::TemporaryFolder folder;
    const Body body = make_body(test::shape_of_samara("cube.geo"), with_triangles(300));
    write_body_file(folder / "cube.body.h5", body);
    const Body again = make_body(folder / "cube.body.h5", keep());
    EXPECT_EQ(again.surface.triangle_count(), body.surface.triangle_count());
    EXPECT_NEAR(again.moments.volume, body.moments.volume, 1e-12 * body.moments.volume);
    EXPECT_EQ(again.name, "cube");
}

TEST(MakeBody, IsTheSameEachTime) {
    const Body one = make_body(test::shape_of_samara("samara.geo"), with_triangles(500));
    const Body two = make_body(test::shape_of_samara("samara.geo"), with_triangles(500));
    EXPECT_EQ(surface_hash(one.surface), surface_hash(two.surface));
}

std::string error_of_text(const std::string& name, const std::string& text) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / name) << text;
    const std::string error = test::error_of([&] { make_body(folder / name); });
    EXPECT_THAT(error, ::testing::StartsWith((folder / name).string() + ": "));
    EXPECT_THAT(error, ::testing::Not(HasSubstr("\n")));
    return error;
}

TEST(MakeBody, AnOpenSheetOfPaperIsThickenedAndMeshed) {
    const test::TemporaryFolder folder;
    test::write_obj(folder / "paper.obj", test::sheet_of_many(210.0, 297.0, 6));
    EXPECT_THAT(test::error_of([&] { make_body(folder / "paper.obj"); }), HasSubstr("--thickness"));
    MeshOptions options;
    options.scale = 0.001;
    options.thickness = 1e-4;
    const Body paper = make_body(folder / "paper.obj", options);
    EXPECT_NEAR(paper.moments.volume, 0.21 * 0.297 * 1e-4, 0.01 * 0.21 * 0.297 * 1e-4);
    EXPECT_NO_THROW(require_sound_surface(paper.surface));
    EXPECT_THAT(paper.source, HasSubstr("thickness 0.0001 m"));
    EXPECT_THAT(test::error_of([&] { make_body(test::shape_of_samara("sheet.geo"), options); }),
                HasSubstr("only sheets of triangles"));
}

TEST(MakeBody, NamesWhatIsWrongWithAFile) {
    EXPECT_THAT(test::error_of([] { make_body("nowhere/missing.stl"); }),
                HasSubstr("missing.stl: does not exist"));
    EXPECT_THAT(test::error_of([] { make_body(std::filesystem::temp_directory_path() / "x.blend"); }),
                HasSubstr("has an unknown format; give a .geo"));
    EXPECT_THAT(error_of_text("empty.stl", ""), HasSubstr("is empty"));
    EXPECT_THAT(error_of_text("words.stl", "these are no triangles"), HasSubstr("is not an STL file"));
    EXPECT_THAT(
        error_of_text("cut.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"),
        HasSubstr("is truncated within a face at line 5"));
    EXPECT_THAT(error_of_text("word.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 zero 0\n"),
                HasSubstr("line 4: 'vertex' needs three numbers, not 'zero'"));
    EXPECT_THAT(error_of_text("none.obj", "# nothing\n"), HasSubstr("holds no triangles"));
    EXPECT_THAT(error_of_text("range.obj", "v 0 0 0\nv 1 0 0\nf 1 2 7\n"), HasSubstr("range.obj"));
    EXPECT_THAT(error_of_text("wrong.geo", "Sphere(1) = {0, 0, nonsense, 1};\n"), HasSubstr("nonsense"));
    EXPECT_THAT(error_of_text("none.geo", "Point(1) = {0, 0, 0, 1};\n"), HasSubstr("holds no surface"));
    EXPECT_THAT(error_of_text("open.geo", "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 1, 1};\n"),
                HasSubstr("is not closed"));
    EXPECT_THAT(error_of_text("a.step", "ISO-10303-21; cut short"), HasSubstr("a.step"));
    EXPECT_THAT(error_of_text("a.msh", "$MeshFormat\nnonsense\n"), HasSubstr("a.msh"));
    EXPECT_THAT(error_of_text("a.body.h5", "not HDF5"), HasSubstr("is not an HDF5 file"));
}

TEST(MakeBody, RejectsOptionsOutOfRange) {
    const auto cube = test::shape_of_samara("cube.geo");
    MeshOptions options;
    options.scale = -1.0;
    EXPECT_THAT(test::error_of([&] { make_body(cube, options); }), HasSubstr("scale must be positive"));
    options = {};
    options.order = 3;
    EXPECT_THAT(test::error_of([&] { make_body(cube, options); }), HasSubstr("order must be 1 or 2"));
    options = {};
    options.flip = true;
    EXPECT_THAT(test::error_of([&] { make_body(cube, options); }), HasSubstr("leave --flip out"));
}

}  // namespace
}  // namespace samara
