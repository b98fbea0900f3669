// Meshes that exports show: their UVs, normals and material slots, in .obj and .glb.
#include "samara/formats/display_mesh_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "samara/core/files/content_hash.hpp"
#include "samara/export/gltf_file.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/scene/scene_file.hpp"
#include "support/expect_error.hpp"
#include "support/painted_mesh.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::error_of;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;

DisplayMesh painted(const TemporaryFolder& folder) {
    (void)folder.file("leaf.mtl", test::painted_mtl);
    (void)folder.file("leaf.png", test::painted_png());
    return read_display_mesh_file(folder.file("leaf.obj", test::painted_obj));
}

/// The texture coordinates of a triangle's corner.
Eigen::Vector2d texture_at(const DisplayMesh& display, std::size_t triangle, std::size_t corner) {
    return display.texture[static_cast<std::size_t>(display.corners[triangle][corner])];
}

void expect_same(const DisplayMesh& one, const DisplayMesh& other, double tolerance) {
    ASSERT_EQ(one.corners.size(), other.corners.size());
    ASSERT_EQ(one.materials.size(), other.materials.size());
    for (std::size_t i = 0; i < one.corners.size(); ++i) {
        EXPECT_EQ(one.materials[static_cast<std::size_t>(one.slots[i])].name,
                  other.materials[static_cast<std::size_t>(other.slots[i])].name);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = static_cast<std::size_t>(one.corners[i][k]);
            const auto b = static_cast<std::size_t>(other.corners[i][k]);
            EXPECT_LT((one.positions[a] - other.positions[b]).norm(), tolerance);
            EXPECT_LT((one.texture[a] - other.texture[b]).norm(), tolerance);
            EXPECT_LT((one.normals[a] - other.normals[b]).norm(), tolerance);
        }
    }
    for (std::size_t i = 0; i < one.materials.size(); ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_NEAR(one.materials[i].color[k], other.materials[i].color[k], tolerance);
        }
        EXPECT_EQ(one.materials[i].image, other.materials[i].image);
    }
    EXPECT_EQ(one.materials[0].transparency, other.materials[0].transparency);
    ASSERT_EQ(one.images.size(), other.images.size());
    for (std::size_t i = 0; i < one.images.size(); ++i) {
        EXPECT_EQ(one.images[i].name, other.images[i].name);
        EXPECT_EQ(one.images[i].bytes, other.images[i].bytes);
    }
}

TEST(DisplayMeshFile, KeepsTextureCoordinatesNormalsAndMaterialsOfAnObj) {
    const TemporaryFolder folder;
    const DisplayMesh display = painted(folder);
    ASSERT_EQ(display.corners.size(), 4U);
    ASSERT_EQ(display.materials.size(), 2U) << "those that are used";
    EXPECT_EQ(display.materials[0].name, "leaf_front");
    EXPECT_EQ(display.materials[1].name, "stalk");
    EXPECT_EQ(display.materials[1].color, (std::array<double, 4>{0.4, 0.2, 0.1, 0.5}));
    EXPECT_EQ(display.slots, (std::vector<std::int32_t>{0, 0, 1, 1}));
    EXPECT_EQ(display.positions.size(), 8U) << "vertices of the seam are two";
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double right = display.positions[static_cast<std::size_t>(display.corners[i][k])].x();
            const double u = texture_at(display, i, k).x();
            EXPECT_NEAR(u, i < 2 ? 0.5 + right / 0.08 : 0.75 + right / 0.16, 1e-12);
        }
    }
    for (const Vector3d& normal : display.normals) EXPECT_EQ(normal, Vector3d::UnitZ());
}

TEST(DisplayMeshFile, TakesNormalsOfAnyLengthForTheirDirection) {
    const TemporaryFolder folder;
    for (const char* length : {"1e300", "1e308", "1e-300"}) {
        const std::string normals = std::string("vn 0 ") + length + " " + length + "\n";
        const DisplayMesh display = read_display_mesh_file(folder.file(
            "leaf.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + normals + "vn 0 0 0\nf 1//1 2//1 3//2\n"));
        ASSERT_EQ(display.normals.size(), 3U) << length;
        EXPECT_LT((display.normals[0] - Vector3d(0.0, 1.0, 1.0).normalized()).norm(), 1e-12) << length;
        EXPECT_EQ(display.normals[2], Vector3d::UnitZ()) << "what has no direction";
    }
}

TEST(DisplayMeshFile, CarriesTheImageThatLiesBesideAnObj) {
    const TemporaryFolder folder;
    const DisplayMesh display = painted(folder);
    ASSERT_EQ(display.images.size(), 1U) << "of a path on another machine the name is looked for";
    EXPECT_EQ(display.images[0].name, "leaf");
    EXPECT_EQ(display.images[0].bytes, test::painted_png());
    EXPECT_EQ(display.materials[0].image, 0);
    EXPECT_EQ(display.materials[0].transparency, DisplayTransparency::cut_out);
    EXPECT_EQ(display.materials[1].image, -1);
    (void)folder.file("leaf.png", "GIF89a, or a key that is nobody's business");
    EXPECT_EQ(read_display_mesh_file(folder / "leaf.obj").materials[0].image, -1);
    std::filesystem::remove(folder / "leaf.png");
    EXPECT_TRUE(read_display_mesh_file(folder / "leaf.obj").images.empty());
}

TEST(DisplayMeshFile, TakesNothingThroughALinkOutOfTheFolderOrFromAPipe) {
    const TemporaryFolder elsewhere;
    const TemporaryFolder folder;
    (void)painted(folder);
    const auto rejection = [&] {
        return error_of([&] { (void)read_display_mesh_file(folder / "leaf.obj"); });
    };
    for (const char* name : {"leaf.png", "leaf.mtl"}) {
        const std::string inside = read_bytes(folder / name);
        std::filesystem::remove(folder / name);
        std::filesystem::create_symlink(elsewhere.file(name, inside), folder / name);
        EXPECT_THAT(rejection(), AllOf(HasSubstr("leaf.obj: "), HasSubstr(name),
                                       HasSubstr("is a link to outside of the folder")));
        std::filesystem::remove(folder / name);
        ASSERT_EQ(::mkfifo((folder / name).c_str(), 0600), 0);
        EXPECT_THAT(rejection(), AllOf(HasSubstr(name), HasSubstr("is a pipe, socket or device")));
        std::filesystem::remove(folder / name);
        std::filesystem::create_symlink(std::filesystem::path("below") / name, folder / name);
        (void)folder.file(std::filesystem::path("below") / name, inside);
        EXPECT_NO_THROW((void)read_display_mesh_file(folder / "leaf.obj")) << "a link within the folder";
    }
    EXPECT_EQ(read_display_mesh_file(folder / "leaf.obj").images.size(), 1U);
}

TEST(DisplayMeshFile, NamesNoFileOfMaterialsOutsideOfItsFolder) {
    const TemporaryFolder folder;
    (void)folder.file("other.mtl", "newmtl a\nKd 0.1 0.2 0.3\n");
    for (const std::string& name : {(folder / "other.mtl").string(), std::string("../other.mtl")}) {
        const auto file =
            folder.file("inner/a.obj", "mtllib " + name + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
        EXPECT_NE(read_display_mesh_file(file).materials.at(0).color[0], 0.1) << name;
    }
}

/// A .glb of a JSON text alone.
std::string glb_of(std::string json) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto four_bytes = [](std::size_t number) {
        std::string bytes;
        for (int i = 0; i < 4; ++i, number >>= 8) bytes += static_cast<char>(number & 0xff);
        return bytes;
    };
    return "glTF" + four_bytes(2) + four_bytes(20 + json.size()) + four_bytes(json.size()) + "JSON" + json;
}

TEST(DisplayMeshFile, ThatNestsOrRepeatsWithoutMeasureIsRefused) {
    const TemporaryFolder folder;
    const auto rejection = [&](const std::string& json) {
        return error_of([&] { (void)read_display_mesh_file(folder.file("a.glb", glb_of(json))); });
    };
    const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
    EXPECT_THAT(rejection(R"({"asset": {"version": "2.0"}, "extras": )" + deep + "}"),
                HasSubstr("a.glb: its JSON nests lists and objects more than 100 deep"));
    // Each node holds the next one twice.
    std::string nodes = R"({"name": "last"})";
    for (int i = 60; i > 0; --i) nodes = fmt::format(R"({{"children": [{0}, {0}]}}, {1})", i, nodes);
    EXPECT_THAT(
        rejection(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [)" +
                  nodes + "]}"),
        HasSubstr("a.glb: has more than a million instances of nodes"));
}

TEST(DisplayMeshFile, ReadsWhatWasWrittenAsGlbTheSame) {
    const TemporaryFolder folder;
    Motion motion = test::motion_of(test::wander, 0.0);
    motion.bodies[0].display = std::make_shared<const DisplayMesh>(painted(folder));
    motion.bodies[0].poses.resize(1);
    motion.bodies[0].poses[0] = Pose();
    motion.bodies[0].center_of_mass.setZero();
    motion.times.resize(1);
    write_glb(folder / "leaf.glb", motion, 0, 0.0);
    expect_same(read_display_mesh_file(folder / "leaf.glb"), *motion.bodies[0].display, 1e-6);
}

TEST(DisplayMeshFile, LiesInTheMotionFile) {
    const TemporaryFolder folder;
    Motion motion = test::motion_of(test::wander, 0.1);
    motion.bodies[0].display = std::make_shared<const DisplayMesh>(painted(folder));
    write_motion_file(folder / "motion.h5", motion);
    const Motion read = read_motion_file(folder / "motion.h5");
    ASSERT_NE(read.bodies[0].display, nullptr);
    expect_same(*read.bodies[0].display, *motion.bodies[0].display, 0.0 + 1e-300);
}

TEST(DisplayMeshFile, IsReadByScenesInTheShapesScaleOrItsOwn) {
    const TemporaryFolder folder;
    (void)painted(folder);
    const auto scene = [&](const std::string& keys) {
        return read_scene_file(folder.file(
            "scene.toml",
            "[scene]\nduration = 1\n[[body]]\nname = \"leaf\"\nshape = \"samara:leaf\"\n" + keys));
    };
    EXPECT_EQ(scene("").bodies[0].display, nullptr);
    EXPECT_NEAR(scene("look = \"leaf.obj\"\n").bodies[0].display->positions[0].x(), -0.04, 1e-12);
    EXPECT_NEAR(scene("look = \"leaf.obj\"\nlook_scale = 2\n").bodies[0].display->positions[0].x(), -0.08,
                1e-12);
    const auto error = [&](const std::string& keys) { return error_of([&] { (void)scene(keys); }); };
    EXPECT_THAT(error("look = \"none.obj\"\n"), HasSubstr("look in [[body]] cannot be read"));
    EXPECT_THAT(error("look_scale = 2\n"), HasSubstr("look_scale in [[body]] needs a look"));
    (void)folder.file("leaf.stl", "solid\nendsolid\n");
    EXPECT_THAT(error("look = \"leaf.stl\"\n"), HasSubstr("a look must be a mesh, .obj or .glb"));
    (void)folder.file("empty.obj", "v 0 0 0\n");
    EXPECT_THAT(error("look = \"empty.obj\"\n"), HasSubstr("holds no triangles"));
    (void)folder.file("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/2 3/1\n");
    EXPECT_THAT(error("look = \"bad.obj\"\n"), HasSubstr("line 5: a face refers to texture '2' of 1"));
    (void)folder.file("bad.glb", "glTF\2\0\0\0 and no more");
    EXPECT_THAT(error("look = \"bad.glb\"\n"), HasSubstr("is not a valid .glb file"));
}

TEST(DisplayMeshFile, AnObstacleMayBeAGlb) {
    const TemporaryFolder folder;
    Motion motion = test::motion_of(test::wander, 0.0);
    motion.bodies[0].surface = test::box({2.0, 2.0, 2.0}, 1);
    motion.bodies[0].center_of_mass.setZero();
    motion.times.resize(1);
    motion.bodies[0].poses.assign(1, Pose());
    motion.bodies[0].poses[0].position = Vector3d(0.0, 0.0, 3.0);
    write_glb(folder / "box.glb", motion, 0, 0.0);
    const Scene scene = read_scene_file(
        folder.file("scene.toml",
                    "[scene]\nduration = 1\n[[body]]\nname = \"leaf\"\nshape = \"samara:leaf\"\n"
                    "[[obstacle]]\nname = \"box\"\nshape = \"box.glb\"\n"));
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : scene.obstacles[0].surface.vertices) box.extend(vertex);
    EXPECT_LT((box.min() - Vector3d(-1, -1, 2)).norm(), 1e-6)
        << "y up is turned to z up, and the node's place counts";
    EXPECT_LT((box.max() - Vector3d(1, 1, 4)).norm(), 1e-6);
    EXPECT_EQ(scene.obstacles[0].surface.vertices.size(), 8U);
}

}  // namespace
}  // namespace samara
