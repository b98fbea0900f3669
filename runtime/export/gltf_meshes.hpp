#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <tiny_gltf.h>

#include "samara/core/base/text.hpp"
#include "samara/core/base/version.hpp"
#include "samara/core/surface/display_image.hpp"
#include "samara/export/copy_style.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// Returns a vector of the world (z up) in glTF's axes (y up).
inline Vector3d y_up(const Vector3d& vector) {
    return {vector.x(), vector.z(), -vector.y()};
}

/// Returns the components of a rotation between z-up axes, for glTF's axes and order (x, y, z, w).
inline Eigen::Vector4d y_up(const Quaterniond& rotation) {
    Eigen::Vector4d components;
    components << y_up(Vector3d(rotation.vec())), rotation.w();
    return components;
}

/// Appends the components of a vector to floats.
inline void append(std::vector<float>& values, const auto& vector) {
    for (const double value : vector) values.push_back(static_cast<float>(value));
}

/// Fills the buffer of a glTF model, one accessor after another.
class GltfBuilder {
  public:
    /// Begins an empty model.
    GltfBuilder() {
        model_.asset.version = "2.0";
        model_.asset.generator = std::string("samara ") + version;
        model_.buffers.emplace_back();
    }

    /// Returns the model, for all but its buffer.
    tinygltf::Model& model() { return model_; }

    /// Begins a view of the buffer that the accessors added next share; `target` as in glTF, 0 for
    /// animations and instances.
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

    /// Adds the corners of triangles; returns the accessor's index.
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

/// The meshes of the copies of one body, which share its accessors: copy k is shown by number k modulo
/// theirs.
using CopyMeshes = std::vector<int>;

/// The materials of bodies without a display mesh, by colour; the key of the grey one is nullptr. Each is
/// added to the model where it is first needed.
using ColorMaterials = std::map<const Vector3d*, int>;

/// Returns a material of a colour (linear), without gloss.
tinygltf::Material matte_material(const std::string& name, const Vector3d& color);

/// Adds a mesh and returns its number. `material`: the number of its material. Throws Error, which names the
/// file, where the surface has no area.
int add_mesh(GltfBuilder& builder, const std::string& name, const Surface& surface, int material,
             const std::filesystem::path& file);

/// Adds the meshes of a body's copies, one for each of their colours.
CopyMeshes add_meshes(GltfBuilder& builder, const BodyMotion& body, const CopyStyle& style,
                      ColorMaterials& materials, const std::filesystem::path& file);

}  // namespace samara
