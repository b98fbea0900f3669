#include "samara/core/body/surface_loads_file.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/body/surface_file.hpp"
#include "samara/core/files/row_major.hpp"

namespace samara {
namespace {

constexpr const char* group = "/surface_loads";
constexpr const char* potentials_name = "/surface_loads/potentials";
// No surface of the area pi L^2 is as wide, and no potential of a unit velocity as large.
constexpr double most_lengths = 1e4;

double largest_of(const std::vector<Vector3d>& vectors) {
    double largest = 0.0;
    for (const Vector3d& vector : vectors) largest = std::max(largest, vector.cwiseAbs().maxCoeff());
    return largest;
}

}  // namespace

void write_surface_loads(Hdf5Writer& file, const SurfaceLoads& loads) {
    write_surface(file, group, loads.surface, "1", "over L about the centroid of the volume, body axes");
    file.write(potentials_name, flattened(loads.potentials), {loads.potentials.size(), 3}, "1",
               "at each vertex, over U L: the fluid's potentials where the body moves along each axis");
}

bool has_surface_loads(const Hdf5Reader& file) {
    return file.has(potentials_name);
}

SurfaceLoads read_surface_loads(const Hdf5Reader& file) {
    SurfaceLoads loads;
    loads.surface = read_surface(file, group);
    loads.surface.edge_nodes.clear();
    loads.potentials = unflattened(file.finite_doubles(potentials_name, {loads.surface.vertices.size(), 3}));
    const double largest = std::max(largest_of(loads.surface.vertices), largest_of(loads.potentials));
    if (largest > most_lengths) {
        throw Error(fmt::format("{}: {} holds a length of {:g} L; make it again with 'samara kirchhoff'",
                                file.path().string(), group, largest));
    }
    return loads;
}

}  // namespace samara
