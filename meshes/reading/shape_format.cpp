#include "meshes/reading/shape_format.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"

namespace samara {
namespace {

std::string extension_of(const std::filesystem::path& file) {
    if (is_body_file_name(file)) return ".body.h5";
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

}  // namespace

bool is_geometry(ShapeFormat format) {
    return format == ShapeFormat::script || format == ShapeFormat::step || format == ShapeFormat::brep;
}

bool is_read_by_gmsh(ShapeFormat format) {
    return is_geometry(format) || format == ShapeFormat::msh;
}

ShapeFormat shape_format(const std::filesystem::path& file) {
    static const std::map<std::string_view, ShapeFormat> formats = {
        {".geo", ShapeFormat::script},  {".step", ShapeFormat::step},    {".stp", ShapeFormat::step},
        {".brep", ShapeFormat::brep},   {".stl", ShapeFormat::stl},      {".obj", ShapeFormat::obj},
        {".ply", ShapeFormat::ply},     {".off", ShapeFormat::off},      {".glb", ShapeFormat::gltf},
        {".gltf", ShapeFormat::gltf},   {".3mf", ShapeFormat::three_mf}, {".msh", ShapeFormat::msh},
        {".body.h5", ShapeFormat::body}};
    const auto found = formats.find(extension_of(file));
    if (found == formats.end()) {
        throw Error(fmt::format(
            "{}: is of no known kind; give a .geo, .step, .stp, .brep, .stl, .obj, .ply, .off, .glb, "
            ".gltf, .3mf, .msh or .body.h5 file (Blender opens most other meshes and exports .stl, "
            "FreeCAD most geometry and exports .step)",
            file.string()));
    }
    std::error_code unknown;
    const std::filesystem::file_status status = std::filesystem::status(file, unknown);
    if (!std::filesystem::is_regular_file(status)) {
        const bool missing = status.type() == std::filesystem::file_type::not_found;
        const std::string reason = missing ? "does not exist" : unknown ? unknown.message() : "is not a file";
        throw Error(fmt::format("{}: {}", file.string(), reason));
    }
    return found->second;
}

void require_beginning(const std::filesystem::path& file, ShapeFormat format) {
    std::array<char, 1024> block{};
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw Error(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
    stream.read(block.data(), block.size());
    const std::string_view start(block.data(), static_cast<std::size_t>(stream.gcount()));
    const auto require = [&](bool holds, const char* kind, const char* beginning) {
        if (holds) return;
        const std::string what = start.empty() ? "is empty" : fmt::format("is no {} file", kind);
        throw Error(fmt::format("{}: {}: these begin with {}", file.string(), what, beginning));
    };
    if (format == ShapeFormat::step) {
        require(start.find("ISO-10303-21") != std::string_view::npos, "STEP", "ISO-10303-21");
    } else if (format == ShapeFormat::brep) {
        require(start.find("CASCADE Topology") != std::string_view::npos, "BREP", "CASCADE Topology");
    } else if (format == ShapeFormat::msh) {
        // Of the first version, of the later ones, and with a comment before.
        const bool holds =
            start.starts_with("$MeshFormat") || start.starts_with("$NOD") || start.starts_with("$Comments");
        require(holds, "MSH", "$MeshFormat");
    }
}

}  // namespace samara
