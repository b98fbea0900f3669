// Motion files: a recipe of edits on a sound one (hdf5_recipe.hpp).

#include <filesystem>
#include <fstream>

#include "harness.hpp"
#include "hdf5_recipe.hpp"
#include "samara/analysis/metrics/description.hpp"
#include "samara/core/files/folders.hpp"
#include "samara/export/csv_file.hpp"
#include "samara/motion/motion_file.hpp"
#include "support/painted_mesh.hpp"
#include "support/test_shapes.hpp"

namespace samara::fuzz {
namespace {

/// A triangle with all that a look can have.
DisplayMesh small_display() {
    DisplayMesh display;
    display.positions = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    display.normals.assign(3, Vector3d::UnitZ());
    display.texture.assign(3, Eigen::Vector2d(0.5, 0.5));
    display.corners = {{0, 1, 2}};
    display.slots = {0};
    display.images = {{"leaf", test::painted_png()}};
    display.materials.resize(1);
    display.materials[0].name = "leaf";
    display.materials[0].image = 0;
    return display;
}

/// Two bodies in two runs over a few frames, above ground and a table; one of several sizes, one with a look.
Motion small_motion() {
    Motion motion;
    motion.runs = 2;
    motion.times = {0.0, 0.1, 0.2};
    motion.frame_rate = 10.0;
    motion.ground = -1.0;
    motion.scene_text = "[scene]\nduration = 0.2\n";
    for (const char* name : {"leaf", "seed"}) {
        BodyMotion body;
        body.name = name;
        body.body_hash = "0123456789abcdef0123456789abcdef";
        body.models = "loads none, turbulence none";
        body.uncertainties = {{"closure", "frequency", 0.1, 0.2}, {"mesh", "descent_speed", 0.03}};
        body.surface = test::box({0.1, 0.2, 0.3}, 1);
        body.copies = 2;
        for (int i = 0; i < 12; ++i) {
            Pose pose;
            pose.position = Vector3d(0.01 * i, 0.0, -0.02 * i);
            pose.velocity = Vector3d(0.1, 0.0, -0.2);
            body.poses.push_back(pose);
        }
        motion.bodies.push_back(body);
    }
    motion.bodies[0].sizes = {1.0, 0.5, 2.0, 1.0};
    motion.bodies[1].display = std::make_shared<const DisplayMesh>(small_display());
    Obstacle table;
    table.name = "table";
    table.surface = test::box({1.0, 1.0, 0.1}, 1);
    table.keys = {{{}, 0.0}, {{}, 0.2}};
    motion.obstacles.push_back(table);
    return motion;
}

}  // namespace

const SeedFile& seed_file() {
    static const SeedFile seed = [] {
        const TemporaryFolder folder;
        write_motion_file(folder / "seed.h5", small_motion());
        return read_seed_file(folder / "seed.h5");
    }();
    return seed;
}

void feed(std::string_view input) {
    static const TemporaryFolder folder;
    const std::filesystem::path file = folder / "motion.h5";
    std::ofstream(file, std::ios::binary) << seed_file().bytes;
    apply_recipe(input, file);
    const auto motion = accepted([&] { return read_motion_file(file); });
    accepted([&] {
        const MotionReader reader(file);
        describe_motion_text(reader.motion(), measure_file(reader, 1, [](double, double) {}));
    });
    if (!motion) return;
    write_motion_file(folder / "again.h5", *motion);
    require(accepted([&] { return read_motion_file(folder / "again.h5"); }).has_value(),
            "what was read can be written");
    write_csv(folder / "motion.csv", *motion);
}

}  // namespace samara::fuzz
