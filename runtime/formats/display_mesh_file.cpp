#include "samara/formats/display_mesh_file.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/surface/obj_file.hpp"
#include "samara/formats/glb_file.hpp"

namespace samara {

DisplayMesh read_display_mesh_file(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    if (extension != ".obj" && extension != ".glb") {
        throw Error(fmt::format("{}: a look is a mesh, .obj or .glb", file.string()));
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
