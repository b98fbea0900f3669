#include "meshes/shape_reader.hpp"

#include <algorithm>
#include <cctype>
#include <string>

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include "meshes/gmsh_session.hpp"
#include "meshes/gmsh_surface.hpp"
#include "meshes/stl_file.hpp"
#include "samara/base/content_hash.hpp"
#include "samara/base/error.hpp"
#include "samara/body/body_file.hpp"

namespace samara {
namespace {

std::string extension_of(const std::filesystem::path& file) {
    if (is_body_file_name(file)) return ".body.h5";
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

std::string one_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

Surface read_obj_file(const std::filesystem::path& file) {
    tinyobj::ObjReaderConfig options;
    options.triangulate = true;
    options.vertex_color = false;
    tinyobj::ObjReader reader;
    // Materials do not matter here, so a missing .mtl file is no fault.
    if (!reader.ParseFromString(read_bytes(file), {}, options)) {
        throw Error(fmt::format("{}: cannot be read: {}", file.string(), one_line(reader.Error())));
    }
    Surface surface;
    const std::vector<tinyobj::real_t>& coordinates = reader.GetAttrib().vertices;
    for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
        surface.vertices.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
    }
    for (const tinyobj::shape_t& shape : reader.GetShapes()) {
        const std::vector<tinyobj::index_t>& indices = shape.mesh.indices;
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            surface.corners.push_back(
                {indices[i].vertex_index, indices[i + 1].vertex_index, indices[i + 2].vertex_index});
        }
    }
    return surface;
}

Surface read_msh_file(const std::filesystem::path& file) {
    const GmshSession session;
    Surface surface;
    GmshSession::open(file.string());
    GmshSession::run(file.string(), "gmsh cannot read it",
                     [&] { surface = surface_of_model(file.string()); });
    return surface;
}

}  // namespace

ShapeKind shape_kind(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    const auto is_one_of = [&](std::initializer_list<const char*> names) {
        return std::any_of(names.begin(), names.end(), [&](const char* name) { return extension == name; });
    };
    const bool is_geometry = is_one_of({".geo", ".step", ".stp", ".brep"});
    if (!is_geometry && !is_one_of({".stl", ".obj", ".msh", ".body.h5"})) {
        throw Error(
            fmt::format("{}: is of no known kind; give a .geo, .step, .stp, .brep, .stl, .obj, .msh or "
                        ".body.h5 file",
                        file.string()));
    }
    if (!std::filesystem::is_regular_file(file)) {
        throw Error(fmt::format("{}: {}", file.string(),
                                std::filesystem::exists(file) ? "is not a file" : "does not exist"));
    }
    return is_geometry ? ShapeKind::geometry : ShapeKind::triangles;
}

Surface read_triangles(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    if (extension == ".body.h5") return read_body_file(file).surface;
    if (extension == ".stl") return read_stl_file(file);
    if (extension == ".obj") return read_obj_file(file);
    return read_msh_file(file);
}

}  // namespace samara
