#include "samara/export/gltf_file.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <ostream>
#include <string_view>

#include <fmt/format.h>
#include <tiny_gltf.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/text.hpp"
#include "samara/core/base/version.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/core/surface/display_image.hpp"
#include "samara/export/float_range.hpp"
#include "samara/export/key_reduction.hpp"
#include "samara/export/shaded_mesh.hpp"
#include "samara/export/shape_pose.hpp"

namespace samara {
namespace {

/// Returns a vector of the world (z up) in glTF's axes (y up).
Vector3d y_up(const Vector3d& vector) {
    return {vector.x(), vector.z(), -vector.y()};
}

/// Returns the components of a rotation between z-up axes, for glTF's axes and order (x, y, z, w).
Eigen::Vector4d y_up(const Quaterniond& rotation) {
    Eigen::Vector4d components;
    components << y_up(Vector3d(rotation.vec())), rotation.w();
    return components;
}

/// Fills the buffer of a glTF model, one accessor after another.
class Builder {
  public:
    Builder() {
        model_.asset.version = "2.0";
        model_.asset.generator = std::string("samara ") + version;
        model_.buffers.emplace_back();
    }

    tinygltf::Model& model() { return model_; }

    /// Begins a view of the buffer that the accessors added next share; `target` as in glTF, 0 for
    /// animations.
    void begin_view(int target) {
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = bytes().size();
        view.target = target;
        model_.bufferViews.push_back(view);
    }

    /// Adds values of `components` floats each, with their bounds; returns the accessor's index.
    int add_floats(const std::vector<float>& values, std::size_t components, int type) {
        tinygltf::Accessor accessor = next_accessor(values.size() / components, type);
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
        accessor.minValues.assign(components, std::numeric_limits<double>::infinity());
        accessor.maxValues.assign(components, -std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < values.size(); ++i) {
            double& lowest = accessor.minValues[i % components];
            double& highest = accessor.maxValues[i % components];
            lowest = std::min(lowest, static_cast<double>(values[i]));
            highest = std::max(highest, static_cast<double>(values[i]));
        }
        return add(accessor, values.data(), values.size() * sizeof(float));
    }

    int add_indices(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
        tinygltf::Accessor accessor = next_accessor(3 * triangles.size(), TINYGLTF_TYPE_SCALAR);
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        return add(accessor, triangles.data(), triangles.size() * sizeof triangles[0]);
    }

    /// Adds a texture of an image file; returns its number.
    int add_texture(const DisplayImage& image) {
        begin_view(0);
        bytes().insert(bytes().end(), image.bytes.begin(), image.bytes.end());
        model_.bufferViews.back().byteLength = image.bytes.size();
        bytes().resize((bytes().size() + 3) / 4 * 4);  // floats follow
        tinygltf::Image added;
        added.name = printable(image.name);
        added.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
        added.mimeType = image_type(image.bytes) == std::string_view("png") ? "image/png" : "image/jpeg";
        model_.images.push_back(added);
        tinygltf::Texture texture;
        texture.source = static_cast<int>(model_.images.size()) - 1;
        model_.textures.push_back(texture);
        return static_cast<int>(model_.textures.size()) - 1;
    }

  private:
    std::vector<unsigned char>& bytes() { return model_.buffers[0].data; }

    tinygltf::Accessor next_accessor(std::size_t count, int type) {
        tinygltf::Accessor accessor;
        accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
        accessor.byteOffset = model_.bufferViews.back().byteLength;
        accessor.count = count;
        accessor.type = type;
        return accessor;
    }

    int add(const tinygltf::Accessor& accessor, const void* data, std::size_t size) {
        const auto* first = static_cast<const unsigned char*>(data);
        bytes().insert(bytes().end(), first, first + size);
        model_.bufferViews.back().byteLength += size;
        model_.accessors.push_back(accessor);
        return static_cast<int>(model_.accessors.size()) - 1;
    }

    tinygltf::Model model_;
};

void append(std::vector<float>& values, const auto& vector) {
    for (const double value : vector) values.push_back(static_cast<float>(value));
}

std::vector<float> y_up_floats(const std::vector<Vector3d>& vectors) {
    std::vector<float> values;
    values.reserve(3 * vectors.size());
    for (const Vector3d& vector : vectors) append(values, y_up(vector));
    return values;
}

/// Adds a mesh; returns its number. `material`: the number of its material.
int add_mesh(Builder& builder, const std::string& name, const Surface& surface, int material,
             const std::filesystem::path& file) {
    const ShadedMesh shaded = shaded_mesh(surface);
    if (shaded.triangles.empty()) {
        throw Error(fmt::format("{}: the surface of {} has no area to show", file.string(), name));
    }
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = material;
    builder.begin_view(TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["POSITION"] =
        builder.add_floats(y_up_floats(shaded.positions), 3, TINYGLTF_TYPE_VEC3);
    builder.begin_view(TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["NORMAL"] = builder.add_floats(y_up_floats(shaded.normals), 3, TINYGLTF_TYPE_VEC3);
    builder.begin_view(TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    primitive.indices = builder.add_indices(shaded.triangles);
    tinygltf::Mesh mesh;
    mesh.name = printable(name);
    mesh.primitives.push_back(primitive);
    builder.model().meshes.push_back(mesh);
    return static_cast<int>(builder.model().meshes.size()) - 1;
}

tinygltf::Material matte_material(const char* name, double grey) {
    tinygltf::Material material;
    material.name = name;
    material.pbrMetallicRoughness.baseColorFactor = {grey, grey, grey, 1.0};
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = 0.6;
    return material;
}

/// Returns a mesh of as many parts as the display mesh has materials in use; adds these to the model.
int add_display(Builder& builder, const std::string& name, const DisplayMesh& display) {
    tinygltf::Mesh mesh;
    mesh.name = printable(name);
    const auto first_material = static_cast<int>(builder.model().materials.size());
    std::map<std::string, int> attributes;
    builder.begin_view(TINYGLTF_TARGET_ARRAY_BUFFER);
    attributes["POSITION"] = builder.add_floats(y_up_floats(display.positions), 3, TINYGLTF_TYPE_VEC3);
    if (!display.normals.empty()) {
        builder.begin_view(TINYGLTF_TARGET_ARRAY_BUFFER);
        attributes["NORMAL"] = builder.add_floats(y_up_floats(display.normals), 3, TINYGLTF_TYPE_VEC3);
    }
    if (!display.texture.empty()) {
        std::vector<float> values;
        for (const Eigen::Vector2d& place : display.texture)
            append(values, Eigen::Vector2d(place.x(), 1.0 - place.y()));
        builder.begin_view(TINYGLTF_TARGET_ARRAY_BUFFER);
        attributes["TEXCOORD_0"] = builder.add_floats(values, 2, TINYGLTF_TYPE_VEC2);
    }
    std::vector<int> textures;
    for (const DisplayImage& image : display.images) textures.push_back(builder.add_texture(image));
    for (std::size_t slot = 0; slot < display.materials.size(); ++slot) {
        const DisplayMaterial& material = display.materials[slot];
        builder.model().materials.push_back(matte_material(printable(material.name).c_str(), 1.0));
        tinygltf::Material& added = builder.model().materials.back();
        added.pbrMetallicRoughness.baseColorFactor.assign(material.color.begin(), material.color.end());
        added.doubleSided = true;  // a display mesh may be a sheet
        if (material.image >= 0) {
            added.pbrMetallicRoughness.baseColorTexture.index =
                textures[static_cast<std::size_t>(material.image)];
        }
        if (material.transparency == DisplayTransparency::cut_out) added.alphaMode = "MASK";
        if (material.transparency == DisplayTransparency::blended || material.color[3] < 1.0) {
            added.alphaMode = "BLEND";
        }
        std::vector<std::array<std::uint32_t, 3>> triangles;
        for (std::size_t i = 0; i < display.corners.size(); ++i) {
            if (display.slots[i] != static_cast<std::int32_t>(slot)) continue;
            const auto& [a, b, c] = display.corners[i];
            triangles.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                                 static_cast<std::uint32_t>(c)});
        }
        if (triangles.empty()) continue;
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = first_material + static_cast<int>(slot);
        primitive.attributes = attributes;
        builder.begin_view(TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
        primitive.indices = builder.add_indices(triangles);
        mesh.primitives.push_back(primitive);
    }
    builder.model().meshes.push_back(mesh);
    return static_cast<int>(builder.model().meshes.size()) - 1;
}

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
    Keys(Builder& builder, const Motion& motion, const std::vector<float>& times,
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

    Builder& builder_;
    const Motion& motion_;
    const std::vector<float>& times_;
    std::vector<double> key_times_;
    tinygltf::Animation& animation_;
    int all_times_ = -1;
};

}  // namespace

std::size_t write_glb(const std::filesystem::path& file, const Motion& motion, int run,
                      const std::optional<double>& tolerance) {
    require_float_range(file, motion, run);
    Builder builder;
    tinygltf::Model& model = builder.model();
    model.scenes.emplace_back();
    model.defaultScene = 0;
    model.materials.push_back(matte_material("body", 0.8));
    tinygltf::Animation animation;
    animation.name = "motion";
    const bool moves = motion.times.size() > 1;
    const std::vector<float> times = moves ? checked_times(motion, file) : std::vector<float>{};
    Keys keys(builder, motion, times, animation);
    std::size_t count = 0;
    for (const BodyMotion& body : motion.bodies) {
        const int mesh = body.display != nullptr ? add_display(builder, body.name, *body.display)
                                                 : add_mesh(builder, body.name, body.surface, 0, file);
        const KeyTolerance body_tolerance = key_tolerance(body, tolerance);
        if (moves) builder.begin_view(0);
        for (int copy = 0; copy < body.copies; ++copy) {
            const std::vector<ShapePose> poses = shape_poses(motion, body, run, copy);
            const int node = add_node(model, copy_name(body, copy), mesh, poses.front());
            if (!body.sizes.empty()) {
                model.nodes[static_cast<std::size_t>(node)].scale.assign(3, body.size(run, copy));
            }
            if (moves) count += keys.add(node, poses, body_tolerance);
        }
    }
    const auto obstacle_material = static_cast<int>(model.materials.size());
    if (!motion.obstacles.empty()) {
        model.materials.push_back(matte_material("obstacle", 0.5));
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
