#include "samara/motion/motion_writer.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/version.hpp"
#include "samara/core/body/file_arrays.hpp"
#include "samara/motion/motion_layout.hpp"

namespace samara {
namespace {

constexpr std::size_t block_bytes = 64U << 20U;
constexpr std::size_t rows_in_chunk = (1U << 16U) / 3;
constexpr std::size_t most_frames = 4096;
constexpr std::size_t pose_bytes = 13 * sizeof(double);
constexpr hsize_t components_of_wrench = 6;
constexpr std::size_t forces_bytes = parts_of_fluid_forces.size() * components_of_wrench * sizeof(double);

std::size_t row_bytes(const Motion& motion) {
    return pose_bytes + (motion.has_forces ? forces_bytes : 0);
}

struct Series {
    const char* name;
    hsize_t components;
    const char* units;
    const char* meaning;
    void (*take)(const Pose& pose, double* values);
};

void take(const Vector3d& vector, double* values) {
    std::copy_n(vector.data(), 3, values);
}

const Series all_series[] = {
    {"position", 3, "m", "of the centre of mass, world axes: run, frame, copy, component",
     [](const Pose& pose, double* values) { take(pose.position, values); }},
    {"orientation", 4, "1", "unit quaternion w, x, y, z, body to world: run, frame, copy, component",
     [](const Pose& pose, double* values) {
         const Quaterniond& q = pose.orientation;
         std::copy_n(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()).data(), 4, values);
     }},
    {"velocity", 3, "m/s", "of the centre of mass, world axes: run, frame, copy, component",
     [](const Pose& pose, double* values) { take(pose.velocity, values); }},
    {"angular_velocity", 3, "rad/s", "world axes: run, frame, copy, component",
     [](const Pose& pose, double* values) { take(pose.angular_velocity, values); }}};

std::string group_of(const BodyMotion& body) {
    return "/bodies/" + body.name;
}

std::size_t pieces_of(std::size_t whole, std::size_t most) {
    return (whole + most - 1) / most;
}

/// Returns the size of the pieces where `whole` is cut into the fewest about equal pieces of at most `most`.
std::size_t even_piece(std::size_t whole, std::size_t most) {
    return pieces_of(whole, pieces_of(whole, most));
}

/// Returns the copies of a body in a section, about.
std::size_t section_of(const Motion& motion, const BodyMotion& body) {
    return pieces_of(static_cast<std::size_t>(body.copies), section_count(motion));
}

/// Returns the shape of a chunk: the frames of a block of as many copies, and then runs, as fit.
std::vector<hsize_t> chunk_of(const Motion& motion, const BodyMotion& body, hsize_t components) {
    const std::size_t frames = frames_in_block(motion);
    const std::size_t copies =
        even_piece(section_of(motion, body), std::max<std::size_t>(rows_in_chunk / frames, 1));
    const std::size_t runs = even_piece(static_cast<std::size_t>(motion.runs),
                                        std::max<std::size_t>(rows_in_chunk / (frames * copies), 1));
    return {runs, frames, copies, components};
}

void write_body(Hdf5Writer& file, const Motion& motion, std::size_t index) {
    const BodyMotion& body = motion.bodies[index];
    const std::string group = group_of(body);
    for (const Series& series : all_series) {
        file.reserve(group + "/" + series.name,
                     {static_cast<hsize_t>(motion.runs), motion.times.size(),
                      static_cast<hsize_t>(body.copies), series.components},
                     chunk_of(motion, body, series.components), series.units, series.meaning);
    }
    for (const auto& [name, part] : parts_of_fluid_forces) {
        if (!motion.has_forces) break;
        file.reserve(forces_of(body.name, name),
                     {static_cast<hsize_t>(motion.runs), motion.times.size(),
                      static_cast<hsize_t>(body.copies), components_of_wrench},
                     chunk_of(motion, body, components_of_wrench), "N m, N",
                     "moment about the centre of mass, force, world axes: run, frame, copy, component");
    }
    file.write(group + "/center_of_mass", row_major(body.center_of_mass), {3}, "m",
               "shape axes: position - R center_of_mass is the place of the shape file's origin");
    file.write(group + "/shortest_axis", row_major(body.shortest_axis), {3}, "1",
               "principal axis of the shortest extent, shape axes: the axis of the inclination");
    write_surface(file, group + "/surface", body.surface);
    if (body.display != nullptr) write_display(file, group + "/look", *body.display);
    if (!body.sizes.empty()) {
        file.write(group + "/size", body.sizes,
                   {static_cast<hsize_t>(motion.runs), static_cast<hsize_t>(body.copies)}, "1",
                   "lengths of each copy over the surface's: run, copy");
    }
    for (const MetricUncertainty& one : body.uncertainties) {
        const std::string name = fmt::format("{}/{}/{}", uncertainty_group(body.name), one.cause, one.metric);
        file.write(
            name, std::vector{one.relative, one.chance}, {2}, "1",
            "what the figure differs by from another solution and the standard error, over the figure");
    }
    file.attribute(group, "index", static_cast<std::int64_t>(index));
    file.attribute(group, "body_hash", std::string_view(body.body_hash));
    file.attribute(group, "models", std::string_view(body.models));
}

std::uintmax_t rounded_up(std::uintmax_t value, std::uintmax_t multiple) {
    return (value + multiple - 1) / multiple * multiple;
}

/// Returns an upper estimate of the file's size (bytes).
std::uintmax_t expected_size(const Motion& motion) {
    constexpr std::uintmax_t small_parts = 1U << 20U;
    std::uintmax_t bytes = small_parts + 8 * motion.times.size();
    for (const BodyMotion& body : motion.bodies) {
        const std::vector<hsize_t> chunk = chunk_of(motion, body, 1);
        const std::uintmax_t poses = rounded_up(static_cast<std::uintmax_t>(motion.runs), chunk[0]) *
                                     rounded_up(motion.times.size(), chunk[1]) *
                                     rounded_up(static_cast<std::uintmax_t>(body.copies), chunk[2]);
        bytes += poses * row_bytes(motion) + poses * row_bytes(motion) / 1000;  // and the list of chunks
        bytes += body.surface.vertices.size() * 24 + body.surface.corners.size() * 24;
        if (body.display != nullptr)
            bytes += body.display->positions.size() * 64 + body.display->corners.size() * 16;
    }
    for (const Obstacle& obstacle : motion.obstacles) {
        bytes += small_parts + obstacle.surface.vertices.size() * 24 + obstacle.surface.corners.size() * 24 +
                 obstacle.keys.size() * 64;
    }
    return bytes;
}

}  // namespace

MotionWriter::MotionWriter(Hdf5Writer& file, const Motion& motion) : file_(file), motion_(motion) {
    file.attribute("/", "format_version", motion_format_version);
    file.attribute("/", "samara_version", std::string_view(version));
    file.attribute("/", "kind", std::string_view("motion"));
    file.attribute("/", "frame_rate", motion.frame_rate);
    file.attribute("/", "seed", motion.seed);
    if (motion.ground) file.attribute("/", "ground", *motion.ground);
    file.reserve("/time", {motion.times.size()}, {std::min(motion.times.size(), rows_in_chunk)}, "s",
                 "of each frame");
    file.write_block("/time", motion.times, {0}, {motion.times.size()});
    file.write("/gravity", row_major(motion.gravity), {3}, "m/s^2", "world axes");
    file.write_text("/scene", motion.scene_text, "the scene file as it was read");
    write_obstacles(file, motion.obstacles);
    for (std::size_t i = 0; i < motion.bodies.size(); ++i) write_body(file, motion, i);
}

void MotionWriter::write(const MotionBlock& block) {
    const BodyMotion& body = motion_.bodies[block.body];
    check_poses("motion", body.name, block.poses);
    const auto runs = static_cast<hsize_t>(motion_.runs);
    const hsize_t copies = block.copies.count;
    const hsize_t frames = copies == 0 ? 0 : block.poses.size() / (runs * copies);
    if (frames == 0) return;
    for (const Series& series : all_series) {
        values_.resize(block.poses.size() * series.components);
        for (std::size_t i = 0; i < block.poses.size(); ++i) {
            series.take(block.poses[i], &values_[i * series.components]);
        }
        file_.write_block(group_of(body) + "/" + series.name, values_,
                          {0, block.first_frame, block.copies.first, 0},
                          {runs, frames, copies, series.components});
    }
    if (!block.forces.empty()) write_forces(block);
}

void MotionWriter::write_forces(const MotionBlock& block) {
    const auto runs = static_cast<hsize_t>(motion_.runs);
    const hsize_t copies = block.copies.count;
    values_.resize(block.forces.size() * components_of_wrench);
    for (const auto& [name, part] : parts_of_fluid_forces) {
        for (std::size_t i = 0; i < block.forces.size(); ++i) {
            const Wrench& wrench = block.forces[i].*part;
            take(wrench.moment, &values_[i * components_of_wrench]);
            take(wrench.force, &values_[i * components_of_wrench + 3]);
        }
        file_.write_block(forces_of(motion_.bodies[block.body].name, name), values_,
                          {0, block.first_frame, block.copies.first, 0},
                          {runs, block.forces.size() / (runs * copies), copies, components_of_wrench});
    }
}

void MotionWriter::finish(std::size_t frames, const std::vector<std::size_t>& copies) {
    if (frames < motion_.times.size()) file_.shorten("/time", {frames});
    const auto runs = static_cast<hsize_t>(motion_.runs);
    for (std::size_t i = 0; i < motion_.bodies.size(); ++i) {
        const BodyMotion& body = motion_.bodies[i];
        if (frames == motion_.times.size() && copies[i] == static_cast<std::size_t>(body.copies)) continue;
        for (const Series& series : all_series) {
            file_.shorten(group_of(body) + "/" + series.name, {runs, frames, copies[i], series.components});
        }
        if (!body.sizes.empty()) file_.shorten(group_of(body) + "/size", {runs, copies[i]});
        for (const auto& [name, part] : parts_of_fluid_forces) {
            if (!motion_.has_forces) break;
            file_.shorten(forces_of(body.name, name), {runs, frames, copies[i], components_of_wrench});
        }
    }
}

std::size_t section_count(const Motion& motion) {
    std::size_t bodies = 0;
    std::size_t most_copies = 1;
    for (const BodyMotion& body : motion.bodies) {
        bodies += static_cast<std::size_t>(motion.runs) * static_cast<std::size_t>(body.copies);
        most_copies = std::max(most_copies, static_cast<std::size_t>(body.copies));
    }
    return std::clamp<std::size_t>(pieces_of(bodies, bodies_in_section), 1, most_copies);
}

CopySpan copies_in_section(const Motion& motion, const BodyMotion& body, std::size_t section) {
    const auto copies = static_cast<std::size_t>(body.copies);
    const auto chunk = static_cast<std::size_t>(chunk_of(motion, body, 1)[2]);
    const std::size_t length = pieces_of(section_of(motion, body), chunk) * chunk;  // no chunk is in two
    const std::size_t first = std::min(copies, section * length);
    return {first, std::min(length, copies - first)};
}

std::size_t frames_in_block(const Motion& motion) {
    std::size_t poses = 0;
    for (const BodyMotion& body : motion.bodies) poses += section_of(motion, body);
    poses *= static_cast<std::size_t>(motion.runs);
    const std::size_t in_memory = block_bytes / (std::max<std::size_t>(1, poses) * row_bytes(motion));
    return even_piece(motion.times.size(), std::clamp<std::size_t>(in_memory, 1, most_frames));
}

void write_motion_file(const std::filesystem::path& path, const Motion& motion_but_poses,
                       const std::function<void(MotionWriter&)>& fill) {
    check_motion_but_poses(path, motion_but_poses);
    write_hdf5(path, [&](Hdf5Writer& file) {
        try {
            file.expect_size(expected_size(motion_but_poses));
        } catch (const Error& error) {
            throw Error(
                fmt::format("{}: {}; lower the duration, frame_rate, count or runs, or write to another disk",
                            path.string(), error.what()));
        }
        MotionWriter writer(file, motion_but_poses);
        fill(writer);
    });
}

}  // namespace samara
