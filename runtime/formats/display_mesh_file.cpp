#include "samara/formats/display_mesh_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <tiny_gltf.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/files/input_file.hpp"
#include "samara/core/surface/display_image.hpp"
#include "samara/core/surface/obj_file.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

constexpr std::size_t most_nodes_deep = 64;
constexpr std::size_t most_placed = 1'000'000;  // a node may stand in many others, and these likewise
constexpr std::size_t most_triangles = 20'000'000;

/// Rotates a vector from glTF's axes (y up) into axes with z up.
Vector3d z_up(const Vector3d& vector) {
    return {vector.x(), -vector.z(), vector.y()};
}

/// Keeps the bytes of an image that stands in the text; those of a buffer are read later, and with care.
bool keep_image(tinygltf::Image* image, int /*index*/, std::string* /*error*/, std::string* /*warning*/,
                int /*width*/, int /*height*/, const unsigned char* bytes, int size, void* /*data*/) {
    if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
    return true;
}

/// Returns file callbacks that read files beneath the folder alone, also behind links, and none where it is
/// empty.
tinygltf::FsCallbacks files_beneath(std::filesystem::path& folder) {
    tinygltf::FsCallbacks callbacks{};
    callbacks.user_data = &folder;
    callbacks.FileExists = [](const std::string& name, void* data) {
        const std::filesystem::path& place = *static_cast<const std::filesystem::path*>(data);
        std::error_code missing;
        return !place.empty() && std::filesystem::is_regular_file(name, missing);
    };
    callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
    callbacks.ReadWholeFile = [](std::vector<unsigned char>* bytes, std::string* error,
                                 const std::string& name, void* data) {
        const std::filesystem::path& place = *static_cast<const std::filesystem::path*>(data);
        try {
            if (place.empty()) return false;
            const InputFile input(name);
            if (!input.is_beneath(place)) return false;
            const std::string read = input.bytes(most_mesh_bytes);
            bytes->assign(read.begin(), read.end());
            return true;
        } catch (const Error& caught) {
            if (error != nullptr) *error += caught.what();
            return false;
        }
    };
    callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                                  void*) { return false; };
    return callbacks;
}

/// Returns the corners, three for each triangle, of a strip, or of a fan about the first one.
std::vector<std::uint32_t> separate_triangles(const std::vector<std::uint32_t>& row, bool fan) {
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 0; i + 2 < row.size(); ++i) {
        const std::size_t odd = i % 2;  // each second one of a strip runs in the opposite sense
        if (fan) {
            corners.insert(corners.end(), {row[i + 1], row[i + 2], row[0]});
        } else {
            corners.insert(corners.end(), {row[i], row[i + 1 + odd], row[i + 2 - odd]});
        }
    }
    return corners;
}

class GlbReader {
  public:
    GlbReader(const std::filesystem::path& file, bool may_be_text) : label_(file.string()) {
        const std::string bytes = read_at_most(file, most_mesh_bytes);
        const bool is_text = may_be_text && !bytes.starts_with("glTF");
        require_shallow(bytes, is_text);
        tinygltf::TinyGLTF loader;
        loader.SetImageLoader(keep_image, nullptr);
        std::filesystem::path folder;  // of the other files, which a .glb has none of
        if (is_text) folder = std::filesystem::absolute(file).parent_path();
        loader.SetFsCallbacks(files_beneath(folder));
        std::string error;
        std::string warning;
        const auto* first = reinterpret_cast<const unsigned char*>(bytes.data());
        const auto size = static_cast<unsigned int>(bytes.size());
        bool read = false;
        try {
            read = is_text ? loader.LoadASCIIFromString(&model_, &error, &warning, bytes.data(), size,
                                                        folder.string())
                           : loader.LoadBinaryFromMemory(&model_, &error, &warning, first, size);
        } catch (const std::exception&) {  // of what it did not expect, such as an image without bytes
            error.clear();
        }
        if (!read) {
            while (!error.empty() && std::isspace(static_cast<unsigned char>(error.back())) != 0)
                error.pop_back();
            std::replace(error.begin(), error.end(), '\n', ' ');
            const std::string type = is_text ? ".gltf" : ".glb";
            fail(error.empty()
                     ? fmt::format("is not a valid {} file", type)
                     : fmt::format("is not a valid {} file: {}; export it again as .glb", type, error));
        }
    }

    DisplayMesh read() {
        for (const std::string& extension : model_.extensionsRequired) {
            if (extension.starts_with("KHR_draco") || extension.starts_with("EXT_meshopt") ||
                extension == "KHR_mesh_quantization") {
                fail(fmt::format("its meshes are compressed ({}); export it without compression", extension));
            }
        }
        for (const tinygltf::Material& material : model_.materials) {
            DisplayMaterial& slot = display_.materials.emplace_back();
            slot.name = material.name;
            const std::vector<double>& color = material.pbrMetallicRoughness.baseColorFactor;
            for (std::size_t i = 0; i < std::min<std::size_t>(4, color.size()); ++i) {
                slot.color[i] = std::isfinite(color[i]) ? std::clamp(color[i], 0.0, 1.0) : 1.0;
            }
            slot.image = image_of(material.pbrMetallicRoughness.baseColorTexture);
            if (material.alphaMode == "MASK") slot.transparency = DisplayTransparency::cut_out;
            if (material.alphaMode == "BLEND") slot.transparency = DisplayTransparency::blended;
        }
        if (model_.scenes.empty()) fail("has no scene");
        const std::size_t shown = model_.defaultScene < 0 ? 0 : static_cast<std::size_t>(model_.defaultScene);
        if (shown >= model_.scenes.size()) fail("refers to a scene that is missing");
        for (const int node : model_.scenes[shown].nodes) add_node(node, Eigen::Affine3d::Identity(), 0);
        if (!has_normals_) display_.normals.clear();
        if (!has_texture_) display_.texture.clear();
        return std::move(display_);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(fmt::format("{}: {}", label_, what));
    }

    /// Throws Error where the JSON nests too deep for its parser. The JSON is all of a .gltf; in a .glb it
    /// stands behind 20 bytes that end in its length and its type.
    void require_shallow(std::string_view bytes, bool is_text) const {
        constexpr std::size_t header = 20;
        std::uint32_t length = 0;
        if (!is_text) {
            if (bytes.size() < header) return;
            std::memcpy(&length, bytes.data() + 12, sizeof length);
            bytes = bytes.substr(header, length);
        }
        const std::string caught = error_of_json_size(bytes);
        if (!caught.empty()) fail("its JSON " + caught);
    }

    template <typename Part>
    const Part& at(const std::vector<Part>& parts, int index, const char* what) const {
        if (index < 0 || static_cast<std::size_t>(index) >= parts.size()) {
            fail(fmt::format("refers to a {} that is missing", what));
        }
        return parts[static_cast<std::size_t>(index)];
    }

    /// Returns the display mesh's index of the image that a texture shows; -1 where it shows none that can be
    /// kept.
    std::int32_t image_of(const tinygltf::TextureInfo& info) {
        if (info.index < 0 || info.texCoord != 0) return -1;
        const tinygltf::Texture& texture = at(model_.textures, info.index, "texture");
        if (texture.source < 0) return -1;
        const auto [known, is_new] = images_.try_emplace(texture.source, -1);
        if (!is_new) return known->second;
        const tinygltf::Image& image = at(model_.images, texture.source, "image");
        const std::string_view bytes = bytes_of(image);
        if (image_type(bytes) == nullptr) return -1;
        if (!add_image(display_, {image.name, std::string(bytes)})) fail(too_many_images);
        known->second = static_cast<std::int32_t>(display_.images.size()) - 1;
        return known->second;
    }

    [[nodiscard]] std::string_view bytes_of(const tinygltf::Image& image) const {
        if (image.bufferView < 0) {
            return {reinterpret_cast<const char*>(image.image.data()), image.image.size()};
        }
        const tinygltf::BufferView& view = at(model_.bufferViews, image.bufferView, "view of its bytes");
        const std::vector<unsigned char>& bytes = at(model_.buffers, view.buffer, "buffer").data;
        if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset) {
            fail("is truncated");
        }
        return {reinterpret_cast<const char*>(bytes.data()) + view.byteOffset, view.byteLength};
    }

    void add_node(int index, const Eigen::Affine3d& parent, std::size_t depth) {
        if (depth > most_nodes_deep) fail("its nodes are nested too deeply, or in a cycle");
        if (++placed_ > most_placed) fail("has more than a million instances of nodes");
        const tinygltf::Node& node = at(model_.nodes, index, "node");
        Eigen::Affine3d place = Eigen::Affine3d::Identity();
        if (node.matrix.size() == 16) {
            place.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
        } else {
            if (node.translation.size() == 3) place.translate(Vector3d(node.translation.data()));
            if (node.rotation.size() == 4) {
                const std::vector<double>& q = node.rotation;
                place.rotate(Quaterniond(q[3], q[0], q[1], q[2]).normalized());
            }
            if (node.scale.size() == 3) place.scale(Vector3d(node.scale.data()));
        }
        const Eigen::Affine3d here = parent * place;
        if (!here.matrix().allFinite()) fail("has a node transform with invalid numbers");
        if (node.mesh >= 0) {
            for (const tinygltf::Primitive& part : at(model_.meshes, node.mesh, "mesh").primitives) {
                add_part(part, here);
            }
        }
        for (const int child : node.children) add_node(child, here, depth + 1);
    }

    /// Calls `take` with a pointer to each element of an accessor.
    template <typename Take>
    void visit(const tinygltf::Accessor& accessor, int type, int component, const Take& take) const {
        if (accessor.type != type || accessor.componentType != component || accessor.sparse.isSparse) {
            fail("has a mesh with an unsupported number type; export it again");
        }
        const tinygltf::BufferView& view = at(model_.bufferViews, accessor.bufferView, "view of its bytes");
        const std::vector<unsigned char>& bytes = at(model_.buffers, view.buffer, "buffer").data;
        const auto size =
            static_cast<std::size_t>(
                tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component))) *
            static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
        const std::size_t stride = view.byteStride == 0 ? size : view.byteStride;
        const std::size_t first = view.byteOffset + accessor.byteOffset;
        if (accessor.count == 0) return;
        if (stride > 4096 || first > bytes.size() || accessor.count > bytes.size() ||
            first + (accessor.count - 1) * stride + size > bytes.size()) {
            fail("is truncated");
        }
        for (std::size_t i = 0; i < accessor.count; ++i) take(&bytes[first + i * stride]);
    }

    std::vector<float> floats(const tinygltf::Accessor& accessor, int type, std::size_t components) const {
        std::vector<float> values;
        visit(accessor, type, TINYGLTF_COMPONENT_TYPE_FLOAT, [&](const unsigned char* bytes) {
            const std::size_t old = values.size();
            values.resize(old + components);
            std::memcpy(&values[old], bytes, components * sizeof(float));
        });
        for (const float value : values) {
            if (!std::isfinite(value)) fail("has an invalid number");
        }
        return values;
    }

    std::vector<std::uint32_t> indices(const tinygltf::Accessor& accessor) const {
        std::vector<std::uint32_t> values;
        const auto take_as = [&](auto number) {
            visit(accessor, TINYGLTF_TYPE_SCALAR, accessor.componentType, [&](const unsigned char* bytes) {
                std::memcpy(&number, bytes, sizeof number);
                values.push_back(number);
            });
        };
        if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) {
            take_as(std::uint8_t{});
        } else if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) {
            take_as(std::uint16_t{});
        } else {
            if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
                fail("has an index of an invalid type");
            take_as(std::uint32_t{});
        }
        return values;
    }

    void add_part(const tinygltf::Primitive& part, const Eigen::Affine3d& place) {
        if (part.mode >= 0 && part.mode < TINYGLTF_MODE_TRIANGLES) return;  // points and lines
        const auto attribute = [&](const char* name) -> const tinygltf::Accessor* {
            const auto found = part.attributes.find(name);
            return found == part.attributes.end() ? nullptr : &at(model_.accessors, found->second, "list");
        };
        const tinygltf::Accessor* positions = attribute("POSITION");
        if (positions == nullptr) return;
        const std::size_t first = display_.positions.size();
        const std::vector<float> places = floats(*positions, TINYGLTF_TYPE_VEC3, 3);
        for (std::size_t i = 0; i < places.size(); i += 3) {
            display_.positions.push_back(z_up(place * Vector3d(places[i], places[i + 1], places[i + 2])));
        }
        const std::size_t end = display_.positions.size();
        if (end > most_triangles) fail("has too many vertices");
        const Matrix3d rotation = place.linear().inverse().transpose();
        if (const tinygltf::Accessor* normals = attribute("NORMAL");
            normals != nullptr && rotation.allFinite()) {
            const std::vector<float> values = floats(*normals, TINYGLTF_TYPE_VEC3, 3);
            for (std::size_t i = 0; i < values.size(); i += 3) {
                const Vector3d normal = rotation * Vector3d(values[i], values[i + 1], values[i + 2]);
                display_.normals.push_back(unit_normal(z_up(normal)));
            }
        } else {
            has_normals_ = false;
        }
        if (const tinygltf::Accessor* texture = attribute("TEXCOORD_0");
            texture != nullptr && texture->componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) {
            has_texture_ = true;
            const std::vector<float> values = floats(*texture, TINYGLTF_TYPE_VEC2, 2);
            for (std::size_t i = 0; i < values.size(); i += 2) {
                display_.texture.emplace_back(values[i], 1.0 - static_cast<double>(values[i + 1]));
            }
        }
        display_.normals.resize(end, Vector3d::UnitZ());
        display_.texture.resize(end, Eigen::Vector2d::Zero());
        add_triangles(part, first, end, place.linear().determinant() < 0.0);
    }

    void add_triangles(const tinygltf::Primitive& part, std::size_t first, std::size_t end, bool mirrored) {
        std::vector<std::uint32_t> corners;
        if (part.indices >= 0) {
            corners = indices(at(model_.accessors, part.indices, "list"));
        } else {
            for (std::size_t i = first; i < end; ++i)
                corners.push_back(static_cast<std::uint32_t>(i - first));
        }
        if (part.mode == TINYGLTF_MODE_TRIANGLE_STRIP || part.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
            corners = separate_triangles(corners, part.mode == TINYGLTF_MODE_TRIANGLE_FAN);
        }
        if (corners.size() % 3 != 0) fail("has a triangle without three corners");
        const std::int32_t slot = slot_of(part.material);
        if (display_.corners.size() + corners.size() / 3 > most_triangles) fail("has too many triangles");
        for (std::size_t i = 0; i < corners.size(); i += 3) {
            std::array<std::int32_t, 3> triangle{};
            for (std::size_t k = 0; k < 3; ++k) {
                if (first + corners[i + k] >= end) fail("has a triangle with a corner that is missing");
                triangle[k] = static_cast<std::int32_t>(first + corners[i + k]);
            }
            if (mirrored) std::swap(triangle[1], triangle[2]);
            display_.corners.push_back(triangle);
            display_.slots.push_back(slot);
        }
    }

    std::int32_t slot_of(int material) {
        if (material >= 0) {
            at(model_.materials, material, "material");
            return material;
        }
        if (plain_slot_ < 0) {
            plain_slot_ = static_cast<std::int32_t>(display_.materials.size());
            display_.materials.emplace_back().name = "body";
        }
        return plain_slot_;
    }

    std::string label_;
    tinygltf::Model model_;
    DisplayMesh display_;
    std::map<int, std::int32_t> images_;  // index in the file to index in the display mesh
    std::size_t placed_ = 0;
    std::int32_t plain_slot_ = -1;
    bool has_normals_ = true;
    bool has_texture_ = false;
};

}  // namespace

DisplayMesh read_glb_file(const std::filesystem::path& file) {
    constexpr bool may_be_text = false;
    return GlbReader(file, may_be_text).read();
}

DisplayMesh read_gltf_file(const std::filesystem::path& file) {
    constexpr bool may_be_text = true;
    return GlbReader(file, may_be_text).read();
}

DisplayMesh read_display_mesh_file(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    if (extension != ".obj" && extension != ".glb") {
        throw Error(fmt::format("{}: a look must be a mesh, .obj or .glb", file.string()));
    }
    DisplayMesh display = extension == ".obj" ? read_obj_display_mesh(file) : read_glb_file(file);
    if (display.corners.empty()) throw Error(fmt::format("{}: holds no triangles", file.string()));
    return display;
}

Surface surface_of(const DisplayMesh& display) {
    Surface surface;
    surface.vertices = display.positions;
    surface.corners = display.corners;
    return surface;
}

}  // namespace samara
