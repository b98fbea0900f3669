#include "samara/export/gltf_meshes.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/text.hpp"
#include "samara/export/shaded_mesh.hpp"

namespace samara {
namespace {

std::vector<float> y_up_floats(const std::vector<Vector3d>& vectors) {
    std::vector<float> values;
    values.reserve(3 * vectors.size());
    for (const Vector3d& vector : vectors) append(values, y_up(vector));
    return values;
}

/// Returns a mesh of as many parts as the display mesh has materials in use; adds these to the model.
int add_display(GltfBuilder& builder, const std::string& name, const DisplayMesh& display) {
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
        builder.model().materials.push_back(matte_material(printable(material.name), Vector3d::Ones()));
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

}  // namespace

tinygltf::Material matte_material(const std::string& name, const Vector3d& color) {
    tinygltf::Material material;
    material.name = name;
    material.pbrMetallicRoughness.baseColorFactor = {color.x(), color.y(), color.z(), 1.0};
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = 0.6;
    return material;
}

int add_mesh(GltfBuilder& builder, const std::string& name, const Surface& surface, int material,
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

CopyMeshes add_meshes(GltfBuilder& builder, const BodyMotion& body, const CopyStyle& style,
                      ColorMaterials& materials, const std::filesystem::path& file) {
    if (body.display != nullptr) return {add_display(builder, body.name, *body.display)};
    tinygltf::Model& model = builder.model();
    const bool colored = style.colors_copies_of(body);
    const int count = colored ? std::min(body.copies, static_cast<int>(style.colors.size())) : 1;
    CopyMeshes meshes;
    for (int copy = 0; copy < count; ++copy) {
        const Vector3d* color = colored ? &style.color(copy) : nullptr;
        const auto [material, is_new] =
            materials.try_emplace(color, static_cast<int>(model.materials.size()));
        if (is_new) {
            const std::string name = colored ? fmt::format("color.{}", color - style.colors.data()) : "body";
            model.materials.push_back(matte_material(name, colored ? *color : Vector3d::Constant(0.8)));
        }
        if (copy == 0) {
            meshes.push_back(add_mesh(builder, body.name, body.surface, material->second, file));
            continue;
        }
        tinygltf::Mesh mesh = model.meshes[static_cast<std::size_t>(meshes.front())];
        mesh.name = printable(copy_name(body, copy));
        mesh.primitives[0].material = material->second;
        meshes.push_back(static_cast<int>(model.meshes.size()));
        model.meshes.push_back(std::move(mesh));
    }
    return meshes;
}

}  // namespace samara
