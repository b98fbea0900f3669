#include "meshes/reading/shape_reader.hpp"

#include <functional>
#include <string>

#include "internal/body/obj_file.hpp"
#include "internal/body/stl_file.hpp"
#include "meshes/reading/confined_surface.hpp"
#include "meshes/reading/gmsh_session.hpp"
#include "meshes/reading/gmsh_surface.hpp"
#include "samara/body/body_file.hpp"

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
    require_beginning(file, format);
    return confined_surface(file, time_limit,
                            [&](const std::function<void(double)>&) { return read_msh_file(file); });
}

}  // namespace samara
