#include "samara/motion/motion_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "samara/base/error.hpp"
#include "samara/base/version.hpp"
#include "samara/body/surface_file.hpp"

namespace samara {
namespace {

constexpr std::int64_t format_version = 1;
constexpr const char* kind = "motion";
constexpr double unit_length_tolerance = 1e-6;

/// Throws Error, naming `source`, where the motion breaks a rule of read_motion_file that a single dataset
/// does not show.
class Rules {
  public:
    explicit Rules(const std::filesystem::path& file) : file_(file.string()) {}

    void check(const Motion& motion) const {
        if (motion.times.empty()) fail("/time holds no frame");
        if (motion.runs < 1) fail("it holds no run");
        if (motion.bodies.empty()) fail("it holds no body");
        if (!(motion.frame_rate > 0.0) || !std::isfinite(motion.frame_rate)) {
            fail("frame_rate is not a positive number");
        }
        if (!motion.gravity.allFinite()) fail("/gravity holds a value that is not finite");
        check_times(motion.times);
        std::set<std::string> names;
        for (const BodyMotion& body : motion.bodies) {
            if (body.name.empty() || body.name.front() == '.' || body.name.find('/') != std::string::npos) {
                fail(fmt::format("the body's name '{}' is empty, starts with a dot or holds a slash",
                                 body.name));
            }
            if (!names.insert(body.name).second) fail(fmt::format("two bodies have the name {}", body.name));
            check_body(motion, body);
        }
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(fmt::format("{}: {}; simulate the scene again", file_, what));
    }

    void check_times(const std::vector<double>& times) const {
        for (std::size_t i = 0; i < times.size(); ++i) {
            if (!std::isfinite(times[i])) fail(fmt::format("/time row {} is not finite", i));
            if (i > 0 && times[i] <= times[i - 1]) fail(fmt::format("/time does not ascend at row {}", i));
        }
    }

    void check_body(const Motion& motion, const BodyMotion& body) const {
        const auto place = [&](const char* what) { return fmt::format("/bodies/{} {}", body.name, what); };
        if (body.copies < 1) fail(place("has no copy"));
        const std::size_t rows = static_cast<std::size_t>(motion.runs) * motion.times.size();
        if (body.poses.size() != rows * static_cast<std::size_t>(body.copies)) {
            fail(place("has not one pose for each run, frame and copy"));
        }
        if (body.surface.corners.empty()) fail(place("has a surface without triangles"));
        if (!body.center_of_mass.allFinite()) fail(place("has a centre of mass that is not finite"));
        if (!is_one(body.shortest_axis.norm())) fail(place("has a shortest_axis that is no unit vector"));
        for (const Pose& pose : body.poses) {
            if (!pose.position.allFinite() || !pose.velocity.allFinite() ||
                !pose.angular_velocity.allFinite()) {
                fail(place("has a pose with a value that is not finite"));
            }
            if (!is_one(pose.orientation.norm()))
                fail(place("has an orientation that is not of unit length"));
        }
    }

    static bool is_one(double length) { return std::abs(length - 1.0) <= unit_length_tolerance; }

    std::string file_;
};

template <typename Component>
std::vector<double> column(const BodyMotion& body, std::size_t components, const Component& component) {
    std::vector<double> values;
    values.reserve(components * body.poses.size());
    for (const Pose& pose : body.poses) {
        const auto vector = component(pose);
        values.insert(values.end(), vector.data(), vector.data() + components);
    }
    return values;
}

void write_body(Hdf5Writer& file, const Motion& motion, std::size_t index) {
    const BodyMotion& body = motion.bodies[index];
    const std::string group = "/bodies/" + body.name;
    const std::vector<hsize_t> vectors = {static_cast<hsize_t>(motion.runs), motion.times.size(),
                                          static_cast<hsize_t>(body.copies), 3};
    std::vector<hsize_t> quaternions = vectors;
    quaternions.back() = 4;
    file.write(group + "/position", column(body, 3, [](const Pose& p) { return p.position; }), vectors, "m",
               "of the centre of mass, world axes: run, frame, copy, component");
    file.write(group + "/orientation",
               column(body, 4,
                      [](const Pose& p) {
                          const Quaterniond& q = p.orientation;
                          return Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
                      }),
               quaternions, "1", "unit quaternion w, x, y, z, body to world: run, frame, copy, component");
    file.write(group + "/velocity", column(body, 3, [](const Pose& p) { return p.velocity; }), vectors, "m/s",
               "of the centre of mass, world axes: run, frame, copy, component");
    file.write(group + "/angular_velocity", column(body, 3, [](const Pose& p) { return p.angular_velocity; }),
               vectors, "rad/s", "world axes: run, frame, copy, component");
    file.write(group + "/center_of_mass", row_major(body.center_of_mass), {3}, "m",
               "shape axes: position - R center_of_mass is the place of the shape file's origin");
    file.write(group + "/shortest_axis", row_major(body.shortest_axis), {3}, "1",
               "principal axis of the shortest extent, shape axes: the axis of the inclination");
    write_surface(file, group + "/surface", body.surface);
    file.attribute(group, "index", static_cast<std::int64_t>(index));
    file.attribute(group, "body_hash", std::string_view(body.body_hash));
    file.attribute(group, "models", std::string_view(body.models));
}

void read_vectors(const Hdf5Reader& file, const std::string& name, const std::vector<hsize_t>& dimensions,
                  std::vector<Pose>& poses, Vector3d Pose::*member) {
    const std::vector<double> values = file.finite_doubles(name, dimensions);
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i].*member = Vector3d(values.data() + 3 * i);
}

/// Checks the shape that the file claims before memory for it is taken.
std::vector<hsize_t> pose_dimensions(const Hdf5Reader& file, const std::string& name, std::size_t frames) {
    std::vector<hsize_t> shape = file.shape(name);
    constexpr hsize_t most = std::numeric_limits<std::int32_t>::max();
    if (shape.size() != 4 || shape[0] < 1 || shape[0] > most || shape[1] != frames || shape[2] < 1 ||
        shape[2] > most || shape[3] != 3) {
        throw Error(fmt::format(
            "{}: {} has not the shape (runs, {} frames, copies, 3); the file is of another kind or was "
            "changed: simulate the scene again",
            file.path().string(), name, frames));
    }
    return shape;
}

BodyMotion read_body(const Hdf5Reader& file, const std::string& name, std::size_t frames, int& runs) {
    const std::string group = "/bodies/" + name;
    const std::vector<hsize_t> vectors = pose_dimensions(file, group + "/position", frames);
    std::vector<hsize_t> quaternions = vectors;
    quaternions.back() = 4;
    runs = static_cast<int>(vectors[0]);
    BodyMotion body;
    body.name = name;
    body.copies = static_cast<int>(vectors[2]);
    body.poses.resize(vectors[0] * vectors[1] * vectors[2]);
    read_vectors(file, group + "/position", vectors, body.poses, &Pose::position);
    read_vectors(file, group + "/velocity", vectors, body.poses, &Pose::velocity);
    read_vectors(file, group + "/angular_velocity", vectors, body.poses, &Pose::angular_velocity);
    const std::vector<double> values = file.finite_doubles(group + "/orientation", quaternions);
    for (std::size_t i = 0; i < body.poses.size(); ++i) {
        const double* q = values.data() + 4 * i;
        body.poses[i].orientation = Quaterniond(q[0], q[1], q[2], q[3]);
    }
    body.center_of_mass = from_row_major<Vector3d>(file.finite_doubles(group + "/center_of_mass", {3}));
    body.shortest_axis = from_row_major<Vector3d>(file.finite_doubles(group + "/shortest_axis", {3}));
    body.surface = read_surface(file, group + "/surface");
    body.body_hash = file.text_attribute(group, "body_hash");
    body.models = file.text_attribute(group, "models");
    return body;
}

void read_bodies(const Hdf5Reader& file, Motion& motion) {
    std::vector<std::pair<std::int64_t, BodyMotion>> bodies;
    for (const std::string& name : file.children("/bodies")) {
        int runs = 0;
        BodyMotion body = read_body(file, name, motion.times.size(), runs);
        if (!bodies.empty() && runs != motion.runs) {
            throw Error(
                fmt::format("{}: /bodies/{} has {} runs, the bodies before it {}; simulate the scene "
                            "again",
                            file.path().string(), name, runs, motion.runs));
        }
        motion.runs = runs;
        bodies.emplace_back(file.integer_attribute("/bodies/" + name, "index"), std::move(body));
    }
    std::stable_sort(bodies.begin(), bodies.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [index, body] : bodies) motion.bodies.push_back(std::move(body));
}

bool holds_motion(const Hdf5Reader& file) {
    return file.has("/time") && file.has("/bodies");
}

}  // namespace

void write_motion_file(const std::filesystem::path& path, const Motion& motion) {
    Rules(path).check(motion);
    write_hdf5(path, [&](Hdf5Writer& file) {
        file.attribute("/", "format_version", format_version);
        file.attribute("/", "samara_version", std::string_view(version));
        file.attribute("/", "kind", std::string_view(kind));
        file.attribute("/", "frame_rate", motion.frame_rate);
        file.attribute("/", "seed", motion.seed);
        file.write("/time", motion.times, {motion.times.size()}, "s", "of each frame");
        file.write("/gravity", row_major(motion.gravity), {3}, "m/s^2", "world axes");
        file.write_text("/scene", motion.scene_text, "the scene file as it was read");
        for (std::size_t i = 0; i < motion.bodies.size(); ++i) write_body(file, motion, i);
    });
}

Motion read_motion_file(const std::filesystem::path& path) {
    const Hdf5Reader file(path);
    if (!holds_motion(file)) {
        throw Error(fmt::format("{}: is an HDF5 file, but not a motion file; make one with 'samara simulate'",
                                path.string()));
    }
    if (const auto found = file.integer_attribute("/", "format_version"); found > format_version) {
        throw Error(
            fmt::format("{}: was written by a newer version of samara (format {}, this one reads {}); update",
                        path.string(), found, format_version));
    }
    Motion motion;
    motion.times = file.finite_doubles("/time", {0});
    motion.frame_rate = file.number_attribute("/", "frame_rate");
    motion.seed = file.unsigned_attribute("/", "seed");
    motion.gravity = from_row_major<Vector3d>(file.finite_doubles("/gravity", {3}));
    motion.scene_text = file.text("/scene");
    read_bodies(file, motion);
    Rules(path).check(motion);
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
