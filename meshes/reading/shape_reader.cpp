#include "meshes/reading/shape_reader.hpp"

#include <functional>
#include <string>

#include "meshes/reading/confined_surface.hpp"
#include "meshes/reading/gmsh_session.hpp"
#include "meshes/reading/gmsh_surface.hpp"
#include "meshes/reading/polygon_file.hpp"
#include "meshes/reading/three_mf_file.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/surface/obj_file.hpp"
#include "samara/core/surface/stl_file.hpp"
#include "samara/formats/glb_file.hpp"
#include "samara/formats/look_file.hpp"

namespace samara {
namespace {

Surface read_msh_file(const std::filesystem::path& file) {
    const GmshSession session;
    Surface surface;
    GmshSession::open(file.string());
    GmshSession::run(file.string(), "gmsh cannot read it",
                     [&] { surface = surface_of_model(file.string()); });
    return surface;
}

}  // namespace

Surface read_triangles(const std::filesystem::path& file, ShapeFormat format, double time_limit) {
    if (format == ShapeFormat::body) return read_body_file(file).surface;
    if (format == ShapeFormat::stl) return read_stl_file(file);
    if (format == ShapeFormat::obj) return read_obj_file(file);
    if (format == ShapeFormat::gltf) return surface_of(read_gltf_file(file));
    require_beginning(file, format);
    return confined_surface(file, time_limit, [&](const std::function<void(double)>&) {
        if (format == ShapeFormat::three_mf) return read_3mf_file(file);
        return format == ShapeFormat::msh ? read_msh_file(file) : read_polygon_file(file, format);
    });
}

}  // namespace samara
