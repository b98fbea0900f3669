#include "samara/scene/run_needs.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/machine_memory.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/kernel/state_block.hpp"
#include "samara/core/physics/pose.hpp"
#include "samara/motion/motion_writer.hpp"
#include "samara/scene/table_errors_on_path.hpp"

namespace samara {
namespace {

// Bytes of a copy in a run while it is simulated (runtime/core/simulation/body_group.hpp), and of its poses
// in a block while that is written.
constexpr double bytes_of_a_flight =
    static_cast<double>(sizeof(StateBlock)) / StateBlock::size + 2.0 * sizeof(Pose) + sizeof(Quaterniond);
constexpr double bytes_in_file = 13.0 * sizeof(double);
constexpr double bytes_of_a_written_pose = 2.0 * sizeof(Pose) + 4.0 * sizeof(double);  // two blocks
constexpr double bytes_in_block = 64U << 20U;
// Bytes of a frame of the one copy that is measured at a time, and of its time.
constexpr double bytes_of_a_measured_frame = 170.0;
constexpr double bytes_of_all_else = 60e6;

/// Returns the bytes of the hull with which a copy of another size than the shape's touches ground, obstacles
/// and others.
double bytes_of_a_touching_body(const Scene& scene, const SceneBody& body, const LoadedBody& loaded) {
    const bool touches = scene.ground || !scene.obstacles.empty() || scene.bodies_collide;
    if (!touches || !body.spreads_size()) return 0.0;
    const auto made = loaded.prepared->get(*loaded.body, body, scene.fluid, body.name);
    const ContactPoints& points = made->contact_points;
    return sizeof(TouchingBody) +
           static_cast<double>(points.corners.size() + points.round.size()) * sizeof(Vector3d);
}

}  // namespace

RunNeeds needs_of(const Scene& scene, int runs, const std::vector<LoadedBody>& loaded) {
    const double frames = std::floor(scene.duration * scene.frame_rate) + 1.0;
    double samples = 0.0;
    double touching = 0.0;
    double sizes = 0.0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const SceneBody& body = scene.bodies[i];
        const double copies = static_cast<double>(body.count) * runs;
        samples += copies;
        sizes += body.spreads_size() ? copies * sizeof(double) : 0.0;
        if (!loaded.empty()) touching += copies * bytes_of_a_touching_body(scene, body, loaded[i]);
    }
    // A section of bodies that do not touch each other is simulated at a time.
    const double least = static_cast<double>(scene.bodies.size()) * runs;
    const double flown =
        scene.bodies_collide ? samples : std::min(samples, std::max<double>(bodies_in_section, least));
    const double block = std::min(frames * flown, std::max(flown, bytes_in_block / bytes_in_file));
    const double simulation = flown * bytes_of_a_flight + touching * flown / samples + sizes +
                              block * bytes_of_a_written_pose + frames * 2.0 * sizeof(double);
    const double measuring =
        frames * bytes_of_a_measured_frame + std::min(frames * samples * sizeof(Pose), bytes_in_block);
    RunNeeds needs;
    needs.memory = std::max(simulation, measuring) + bytes_of_all_else;
    needs.disk = frames * samples * bytes_in_file + frames * sizeof(double);
    needs.memory_for_copies = simulation > measuring;
    return needs;
}

std::string in_words(const RunNeeds& needs) {
    return fmt::format("{:.3g} GB of memory and {:.3g} GB of disk", 1e-9 * needs.memory, 1e-9 * needs.disk);
}

void require_room(const RunNeeds& needs, const std::string& scene, const std::filesystem::path& output) {
    require_memory(
        needs.memory, scene + ": its simulation",
        needs.memory_for_copies ? "lower the count or --runs" : "lower the duration or frame_rate");
    std::error_code unknown;
    const std::filesystem::path folder = output.has_parent_path() ? output.parent_path() : ".";
    const auto space = std::filesystem::space(folder, unknown);
    if (unknown || needs.disk <= static_cast<double>(space.available)) return;
    throw Error(
        fmt::format("{}: needs {:.3g} GB, but {:.3g} GB are free on its disk; lower the duration, "
                    "frame_rate, count or runs, or write to another disk",
                    output.string(), 1e-9 * needs.disk, 1e-9 * static_cast<double>(space.available)));
}

}  // namespace samara
