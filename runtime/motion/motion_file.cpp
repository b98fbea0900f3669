#include "samara/motion/motion_file.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/body/file_arrays.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/motion/motion_layout.hpp"
#include "samara/motion/motion_writer.hpp"

namespace samara {
namespace {

constexpr std::size_t read_bytes_at_once = 64U << 20U;

/// Checks the shape that the file claims before memory for it is taken.
std::vector<hsize_t> pose_dimensions(const Hdf5Reader& file, const std::string& name, std::size_t frames) {
    std::vector<hsize_t> shape = file.shape(name);
    constexpr hsize_t most = std::numeric_limits<std::int32_t>::max();
    if (shape.size() != 4 || shape[0] < 1 || shape[0] > most || shape[1] != frames || shape[2] < 1 ||
        shape[2] > most || shape[3] != 3) {
        throw Error(
            fmt::format("{}: {} does not have the shape (runs, {} frames, copies, 3): the file has another "
                        "type or was changed; simulate the scene again",
                        file.path().string(), name, frames));
    }
    return shape;
}

std::vector<MetricUncertainty> read_uncertainties(const Hdf5Reader& file, const std::string& body) {
    std::vector<MetricUncertainty> uncertainties;
    const std::string group = uncertainty_group(body);
    if (!file.has(group)) return uncertainties;
    for (const std::string& cause : file.children(group)) {
        for (const std::string& metric : file.children(fmt::format("{}/{}", group, cause))) {
            const std::string name = fmt::format("{}/{}/{}", group, cause, metric);
            // Older files have no chance.
            const hsize_t count = file.shape(name) == std::vector<hsize_t>{1} ? 1 : 2;
            const std::vector<double> values = file.finite_doubles(name, {count});
            uncertainties.push_back({cause, metric, values.front(), count == 2 ? values.back() : 0.0});
        }
    }
    return uncertainties;
}

BodyMotion read_body_but_poses(const Hdf5Reader& file, const std::string& name, std::size_t frames,
                               bool has_forces, int& runs) {
    const std::string group = "/bodies/" + name;
    const std::vector<hsize_t> vectors = pose_dimensions(file, group + "/position", frames);
    std::vector<hsize_t> quaternions = vectors;
    quaternions.back() = 4;
    file.require_shape(group + "/velocity", vectors);
    file.require_shape(group + "/angular_velocity", vectors);
    file.require_shape(group + "/orientation", quaternions);
    for (const auto& [part, member] : parts_of_fluid_forces) {
        if (!has_forces) break;
        std::vector<hsize_t> wrenches = vectors;
        wrenches.back() = 6;
        file.require_shape(forces_of(name, part), wrenches);
    }
    runs = static_cast<int>(vectors[0]);
    BodyMotion body;
    body.name = name;
    body.copies = static_cast<int>(vectors[2]);
    body.center_of_mass = from_row_major<Vector3d>(file.finite_doubles(group + "/center_of_mass", {3}));
    body.shortest_axis = from_row_major<Vector3d>(file.finite_doubles(group + "/shortest_axis", {3}));
    body.surface = read_surface(file, group + "/surface");
    body.display = read_display(file, group + "/look");
    body.body_hash = file.text_attribute(group, "body_hash");
    body.models = file.text_attribute(group, "models");
    body.uncertainties = read_uncertainties(file, name);
    if (file.has(group + "/size"))
        body.sizes = file.finite_doubles(group + "/size", {vectors[0], vectors[2]});
    return body;
}

void read_bodies_but_poses(const Hdf5Reader& file, Motion& motion) {
    std::vector<std::pair<std::int64_t, BodyMotion>> bodies;
    for (const std::string& name : file.children("/bodies")) {
        int runs = 0;
        motion.has_forces =
            bodies.empty() ? file.has(forces_of(name, parts_of_fluid_forces[0].first)) : motion.has_forces;
        BodyMotion body = read_body_but_poses(file, name, motion.times.size(), motion.has_forces, runs);
        if (!bodies.empty() && runs != motion.runs) {
            throw Error(fmt::format(
                "{}: /bodies/{} has {} runs, but earlier bodies have {}; simulate the scene again",
                file.path().string(), name, runs, motion.runs));
        }
        motion.runs = runs;
        bodies.emplace_back(file.integer_attribute("/bodies/" + name, "index"), std::move(body));
    }
    std::stable_sort(bodies.begin(), bodies.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [index, body] : bodies) motion.bodies.push_back(std::move(body));
}

/// Returns `frames` frames of a motion in memory from number `first` on.
MotionBlock block_of(const Motion& motion, std::size_t index, std::size_t first, std::size_t frames,
                     const CopySpan& copies) {
    const BodyMotion& body = motion.bodies[index];
    MotionBlock block{index, first, copies, {}, {}};
    for (int run = 0; run < motion.runs; ++run) {
        for (std::size_t frame = first; frame < first + frames; ++frame) {
            const auto begin = static_cast<std::ptrdiff_t>(
                motion.index(body, run, static_cast<int>(frame), static_cast<int>(copies.first)));
            const auto end = begin + static_cast<std::ptrdiff_t>(copies.count);
            block.poses.insert(block.poses.end(), body.poses.begin() + begin, body.poses.begin() + end);
            if (!motion.has_forces) continue;
            block.forces.insert(block.forces.end(), body.forces.begin() + begin, body.forces.begin() + end);
        }
    }
    return block;
}

bool holds_motion(const Hdf5Reader& file) {
    return file.has("/time") && file.has("/bodies");
}

}  // namespace

MotionReader::~MotionReader() = default;
MotionReader::MotionReader(MotionReader&&) noexcept = default;
MotionReader& MotionReader::operator=(MotionReader&&) noexcept = default;

MotionReader::MotionReader(const std::filesystem::path& path) : file_(std::make_unique<Hdf5Reader>(path)) {
    if (!holds_motion(*file_)) {
        throw Error(fmt::format("{}: is an HDF5 file, but not a motion file; make one with 'samara simulate'",
                                path.string()));
    }
    if (const auto found = file_->integer_attribute("/", "format_version"); found > motion_format_version) {
        throw Error(
            fmt::format("{}: was written by a newer version of samara (format {}, this one reads {}); update",
                        path.string(), found, motion_format_version));
    }
    motion_.times = file_->finite_doubles("/time", {0});
    motion_.frame_rate = file_->number_attribute("/", "frame_rate");
    motion_.seed = file_->unsigned_attribute("/", "seed");
    if (file_->has_attribute("/", "ground")) motion_.ground = file_->number_attribute("/", "ground");
    motion_.gravity = from_row_major<Vector3d>(file_->finite_doubles("/gravity", {3}));
    motion_.scene_text = file_->text("/scene");
    motion_.obstacles = read_obstacles(*file_);
    read_bodies_but_poses(*file_, motion_);
    check_motion_but_poses(path, motion_);
    if (!motion_.ground) return;
    for (BodyMotion& body : motion_.bodies) {
        body.contact_points = contact_points(body.surface, body.center_of_mass);
    }
}

std::vector<Pose> MotionReader::poses(std::size_t body, const PoseBlock& block) const {
    const std::string group = "/bodies/" + motion_.bodies[body].name;
    const auto frames = static_cast<hsize_t>(motion_.frames());
    const auto runs = static_cast<hsize_t>(block.runs);
    const auto copies = static_cast<hsize_t>(block.copies);
    std::vector<Pose> poses(runs * frames * copies);
    const auto read = [&](const char* name, hsize_t components, const auto& put) {
        const std::vector<double> values = file_->finite_block(
            group + "/" + name,
            {static_cast<hsize_t>(block.first_run), 0, static_cast<hsize_t>(block.first_copy), 0},
            {runs, frames, copies, components});
        for (std::size_t i = 0; i < poses.size(); ++i) put(poses[i], values.data() + components * i);
    };
    read("position", 3, [](Pose& pose, const double* v) { pose.position = Vector3d(v); });
    read("orientation", 4,
         [](Pose& pose, const double* q) { pose.orientation = Quaterniond(q[0], q[1], q[2], q[3]); });
    read("velocity", 3, [](Pose& pose, const double* v) { pose.velocity = Vector3d(v); });
    read("angular_velocity", 3, [](Pose& pose, const double* v) { pose.angular_velocity = Vector3d(v); });
    check_poses(file_->path(), motion_.bodies[body].name, poses);
    return poses;
}

std::vector<FluidForces> MotionReader::forces(std::size_t body, const PoseBlock& block) const {
    if (!motion_.has_forces) return {};
    const auto frames = static_cast<hsize_t>(motion_.frames());
    const auto runs = static_cast<hsize_t>(block.runs);
    const auto copies = static_cast<hsize_t>(block.copies);
    std::vector<FluidForces> forces(runs * frames * copies);
    for (const auto& [name, part] : parts_of_fluid_forces) {
        const std::vector<double> values = file_->finite_block(
            forces_of(motion_.bodies[body].name, name),
            {static_cast<hsize_t>(block.first_run), 0, static_cast<hsize_t>(block.first_copy), 0},
            {runs, frames, copies, 6});
        for (std::size_t i = 0; i < forces.size(); ++i) {
            Wrench& wrench = forces[i].*part;
            wrench.moment = Vector3d(&values[6 * i]);
            wrench.force = Vector3d(&values[6 * i + 3]);
        }
    }
    return forces;
}

void MotionReader::for_each_block(std::size_t body,
                                  const std::function<void(const Motion&, const PoseBlock&)>& use) const {
    const BodyMotion& all = motion_.bodies[body];
    const std::size_t column = motion_.times.size() * sizeof(Pose);
    const int columns = static_cast<int>(std::clamp<std::size_t>(read_bytes_at_once / column, 1, 1U << 20U));
    Motion part{.times = motion_.times,
                .runs = motion_.runs,
                .frame_rate = motion_.frame_rate,
                .gravity = motion_.gravity,
                .ground = motion_.ground,
                .obstacles = motion_.obstacles,
                .seed = motion_.seed,
                .has_forces = motion_.has_forces,
                .scene_text = {},
                .bodies = {all}};
    const int copies = std::min(columns, all.copies);
    const int runs = std::clamp(columns / copies, 1, motion_.runs);
    for (int run = 0; run < motion_.runs; run += runs) {
        for (int copy = 0; copy < all.copies; copy += copies) {
            const PoseBlock block{run, std::min(runs, motion_.runs - run), copy,
                                  std::min(copies, all.copies - copy)};
            part.runs = block.runs;
            part.bodies[0].copies = block.copies;
            part.bodies[0].sizes.clear();
            for (int i = 0; !all.sizes.empty() && i < block.runs * block.copies; ++i) {
                part.bodies[0].sizes.push_back(all.size(run + i / block.copies, copy + i % block.copies));
            }
            part.bodies[0].poses = poses(body, block);
            part.bodies[0].forces = forces(body, block);
            use(part, block);
        }
    }
}

void write_motion_file(const std::filesystem::path& path, const Motion& motion) {
    check_motion(path, motion);
    write_motion_file(path, motion, [&](MotionWriter& writer) {
        const std::size_t frames = motion.times.size();
        const std::size_t planned = frames_in_block(motion);
        for (std::size_t section = 0; section < section_count(motion); ++section) {
            for (std::size_t first = 0; first < frames; first += planned) {
                const std::size_t count = std::min(planned, frames - first);
                for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
                    const CopySpan copies = copies_in_section(motion, motion.bodies[i], section);
                    writer.write(block_of(motion, i, first, count, copies));
                }
            }
        }
    });
}

Motion read_motion_file(const std::filesystem::path& path) {
    const MotionReader reader(path);
    Motion motion = reader.motion();
    for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
        const PoseBlock all{0, motion.runs, 0, motion.bodies[i].copies};
        motion.bodies[i].poses = reader.poses(i, all);
        motion.bodies[i].forces = reader.forces(i, all);
    }
    return motion;
}

bool is_motion_file(const std::filesystem::path& path) {
    try {
        return holds_motion(Hdf5Reader(path));
    } catch (const Error&) {
        return false;
    }
}

}  // namespace samara
