#include "samara/formats/look_file.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/surface/obj_file.hpp"
#include "samara/formats/glb_file.hpp"

namespace samara {

LookMesh read_look_file(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    if (extension != ".obj" && extension != ".glb") {
        throw Error(fmt::format("{}: a look is a mesh, .obj or .glb", file.string()));
    }
    LookMesh look = extension == ".obj" ? read_obj_look(file) : read_glb_file(file);
    if (look.corners.empty()) throw Error(fmt::format("{}: holds no triangles", file.string()));
    return look;
}

Surface surface_of(const LookMesh& look) {
    Surface surface;
    surface.vertices = look.positions;
    surface.corners = look.corners;
    return surface;
}

}  // namespace samara
