#include "samara/export/gltf_file.hpp"

#include <algorithm>
#include <limits>
#include <ostream>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/text.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/export/float_range.hpp"
#include "samara/export/gltf_meshes.hpp"
#include "samara/export/key_reduction.hpp"
#include "samara/export/shape_pose.hpp"

namespace samara {
namespace {

constexpr const char* instancing = "EXT_mesh_gpu_instancing";

/// Returns the node's index.
int add_node(tinygltf::Model& model, const std::string& name, int mesh, const ShapePose& start) {
    tinygltf::Node node;
    node.name = printable(name);
    node.mesh = mesh;
    const Vector3d translation = y_up(start.position);
    const Eigen::Vector4d rotation = y_up(start.orientation);
    node.translation.assign(translation.begin(), translation.end());
    node.rotation.assign(rotation.begin(), rotation.end());
    model.nodes.push_back(node);
    const int index = static_cast<int>(model.nodes.size()) - 1;
    model.scenes[0].nodes.push_back(index);
    return index;
}

/// Adds a node with all copies of a body that one of its meshes shows, as instances at their first frame.
void add_instances(GltfBuilder& builder, const Motion& motion, const BodyMotion& body, int run,
                   const CopyMeshes& meshes, std::size_t number) {
    std::vector<float> translations;
    std::vector<float> rotations;
    std::vector<float> scales;
    for (int copy = static_cast<int>(number); copy < body.copies; copy += static_cast<int>(meshes.size())) {
        const ShapePose pose = shape_poses(motion, body, run, copy).front();
        append(translations, y_up(pose.position));
        append(rotations, y_up(pose.orientation));
        append(scales, Vector3d(Vector3d::Constant(body.size(run, copy))));
    }
    tinygltf::Node node;
    node.mesh = meshes[number];
    node.name = builder.model().meshes[static_cast<std::size_t>(node.mesh)].name;
    builder.begin_view(0);
    tinygltf::Value::Object attributes;
    attributes["TRANSLATION"] = tinygltf::Value(builder.add_floats(translations, 3, TINYGLTF_TYPE_VEC3));
    attributes["ROTATION"] = tinygltf::Value(builder.add_floats(rotations, 4, TINYGLTF_TYPE_VEC4));
    if (!body.sizes.empty()) {
        attributes["SCALE"] = tinygltf::Value(builder.add_floats(scales, 3, TINYGLTF_TYPE_VEC3));
    }
    node.extensions[instancing] =
        tinygltf::Value(tinygltf::Value::Object{{"attributes", tinygltf::Value(attributes)}});
    tinygltf::Model& model = builder.model();
    model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(std::move(node));
}

void add_channel(tinygltf::Animation& animation, int node, const char* path, int times, int keys) {
    tinygltf::AnimationSampler sampler;
    sampler.input = times;
    sampler.output = keys;
    sampler.interpolation = "LINEAR";
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size());
    channel.target_node = node;
    channel.target_path = path;
    animation.samplers.push_back(sampler);
    animation.channels.push_back(channel);
}

/// Returns the motion's times as glTF stores them.
std::vector<float> checked_times(const Motion& motion, const std::filesystem::path& file) {
    std::vector<float> times;
    append(times, motion.times);
    if (times.front() < 0.0F) {
        throw Error(fmt::format(
            "{}: glTF has no times before 0, but the motion starts at {} s; choose another format",
            file.string(), motion.times.front()));
    }
    if (std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) != times.end()) {
        throw Error(
            fmt::format("{}: the frames are too close in time for glTF's floats; use a lower frame "
                        "rate or a shorter motion",
                        file.string()));
    }
    return times;
}

/// The keys of one run, added body by body.
class Keys {
  public:
    Keys(GltfBuilder& builder, const Motion& motion, const std::vector<float>& times,
         tinygltf::Animation& animation)
        : builder_(builder),
          motion_(motion),
          times_(times),
          key_times_(times.begin(), times.end()),
          animation_(animation) {}

    /// Adds the keys of a node with these poses, within the tolerance; returns their number.
    std::size_t add(int node, const std::vector<ShapePose>& poses, const KeyTolerance& tolerance) {
        std::vector<Vector3d> positions;
        std::vector<Vector3d> position_keys;
        std::vector<Quaterniond> rotations;
        std::vector<Quaterniond> rotation_keys;
        for (const ShapePose& pose : poses) {
            positions.push_back(y_up(pose.position));
            position_keys.emplace_back(positions.back().cast<float>().cast<double>());
            rotations.emplace_back(y_up(pose.orientation));
            rotation_keys.emplace_back(rotations.back().coeffs().cast<float>().cast<double>().normalized());
        }
        const auto kept =
            kept_keys({motion_.times, positions, key_times_, position_keys}, tolerance.position);
        std::vector<float> values;
        for (const std::size_t key : kept) append(values, positions[key]);
        add_channel(animation_, node, "translation", times_of(kept),
                    builder_.add_floats(values, 3, TINYGLTF_TYPE_VEC3));
        const auto kept_turns =
            kept_keys({motion_.times, rotations, key_times_, rotation_keys}, tolerance.angle);
        values.clear();
        for (const std::size_t key : kept_turns) append(values, rotations[key].coeffs());
        add_channel(animation_, node, "rotation", times_of(kept_turns),
                    builder_.add_floats(values, 4, TINYGLTF_TYPE_VEC4));
        return kept.size() + kept_turns.size();
    }

  private:
    /// Returns the accessor of the kept keys' times; all channels that keep every key share one.
    int times_of(const std::vector<std::size_t>& kept) {
        const bool all = kept.size() == times_.size();
        if (all && all_times_ >= 0) return all_times_;
        std::vector<float> times;
        times.reserve(kept.size());
        for (const std::size_t key : kept) times.push_back(times_[key]);
        const int accessor = builder_.add_floats(times, 1, TINYGLTF_TYPE_SCALAR);
        if (all) all_times_ = accessor;
        return accessor;
    }

    GltfBuilder& builder_;
    const Motion& motion_;
    const std::vector<float>& times_;
    std::vector<double> key_times_;
    tinygltf::Animation& animation_;
    int all_times_ = -1;
};

}  // namespace

std::size_t write_glb(const std::filesystem::path& file, const Motion& motion, int run,
                      const std::optional<double>& tolerance, const CopyStyle& style, bool instances) {
    require_float_range(file, motion, run);
    const bool moves = motion.times.size() > 1;
    if (instances && moves) {
        throw Error(
            fmt::format("{}: the instances of glTF cannot move; export one frame (--at SECONDS), or nodes",
                        file.string()));
    }
    GltfBuilder builder;
    tinygltf::Model& model = builder.model();
    model.scenes.emplace_back();
    model.defaultScene = 0;
    tinygltf::Animation animation;
    animation.name = "motion";
    const std::vector<float> times = moves ? checked_times(motion, file) : std::vector<float>{};
    Keys keys(builder, motion, times, animation);
    std::size_t count = 0;
    ColorMaterials materials;
    for (const BodyMotion& body : motion.bodies) {
        const CopyMeshes meshes = add_meshes(builder, body, style, materials, file);
        if (instances && body.copies > 1) {
            for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
                add_instances(builder, motion, body, run, meshes, mesh);
            }
            model.extensionsUsed = model.extensionsRequired = {instancing};
            continue;
        }
        const KeyTolerance body_tolerance = key_tolerance(body, tolerance);
        if (moves) builder.begin_view(0);
        for (int copy = 0; copy < body.copies; ++copy) {
            const std::vector<ShapePose> poses = shape_poses(motion, body, run, copy);
            const int mesh = meshes[static_cast<std::size_t>(copy) % meshes.size()];
            const int node = add_node(model, style.name(body, copy), mesh, poses.front());
            if (!body.sizes.empty()) {
                model.nodes[static_cast<std::size_t>(node)].scale.assign(3, body.size(run, copy));
            }
            if (moves) count += keys.add(node, poses, body_tolerance);
        }
    }
    const auto obstacle_material = static_cast<int>(model.materials.size());
    if (!motion.obstacles.empty()) {
        model.materials.push_back(matte_material("obstacle", Vector3d::Constant(0.5)));
        model.materials.back().doubleSided = true;
    }
    for (const Obstacle& obstacle : motion.obstacles) {
        const int mesh = add_mesh(builder, obstacle.name, obstacle.surface, obstacle_material, file);
        const std::vector<ShapePose> places = shape_poses(motion, obstacle);
        const int node = add_node(model, obstacle.name, mesh, places.front());
        if (!moves || !obstacle.moves()) continue;
        builder.begin_view(0);
        count += keys.add(node, places, key_tolerance(obstacle, tolerance));
    }
    if (moves) model.animations.push_back(animation);
    if (model.buffers[0].data.size() > std::numeric_limits<std::uint32_t>::max() / 2) {
        throw Error(fmt::format(
            "{}: would exceed the limit of 2 GB for animation tools; use a lower frame rate or fewer copies",
            file.string()));
    }
    replace_file_by_stream(file, [&](std::ostream& stream) {
        tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true);
    });
    return count;
}

}  // namespace samara
