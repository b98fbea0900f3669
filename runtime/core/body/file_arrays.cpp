#include "samara/core/body/file_arrays.hpp"

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

using Triples = std::vector<std::array<std::int32_t, 3>>;

std::vector<std::int32_t> flattened_indices(const Triples& triples) {
    std::vector<std::int32_t> values;
    values.reserve(3 * triples.size());
    for (const auto& triple : triples) values.insert(values.end(), triple.begin(), triple.end());
    return values;
}

Triples read_triples(const Hdf5Reader& file, const std::string& name, std::size_t vertex_count) {
    const std::vector<std::int32_t> values = file.integers(name, {0, 3});
    Triples triples(values.size() / 3);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] < 0 || static_cast<std::size_t>(values[i]) >= vertex_count) {
            throw Error(fmt::format("{}: {} row {} refers to vertex {} of {}; make the file again",
                                    file.path().string(), name, i / 3, values[i], vertex_count));
        }
        triples[i / 3][i % 3] = values[i];
    }
    return triples;
}

}  // namespace

void write_surface(Hdf5Writer& file, const std::string& group, const Surface& surface, const char* units,
                   const char* axes) {
    file.write(group + "/vertices", flattened(surface.vertices), {surface.vertices.size(), 3}, units, axes);
    file.write(group + "/corners", flattened_indices(surface.corners), {surface.corners.size(), 3}, "1",
               "triangles: three rows of vertices, counter-clockwise from outside");
    if (surface.order() == 2) {
        file.write(group + "/edge_nodes", flattened_indices(surface.edge_nodes),
                   {surface.edge_nodes.size(), 3}, "1",
                   "middle nodes of the edges 0-1, 1-2, 2-0 of each triangle");
    }
}

Surface read_surface(const Hdf5Reader& file, const std::string& group) {
    Surface surface;
    surface.vertices = unflattened(file.finite_doubles(group + "/vertices", {0, 3}));
    surface.corners = read_triples(file, group + "/corners", surface.vertices.size());
    if (file.has(group + "/edge_nodes")) {
        surface.edge_nodes = read_triples(file, group + "/edge_nodes", surface.vertices.size());
        if (surface.edge_nodes.size() != surface.corners.size()) {
            throw Error(fmt::format("{}: {}/edge_nodes and corners differ in length; make the file again",
                                    file.path().string(), group));
        }
    }
    return surface;
}

std::vector<double> flattened(const std::vector<Vector3d>& vectors) {
    std::vector<double> values;
    values.reserve(3 * vectors.size());
    for (const Vector3d& vector : vectors) values.insert(values.end(), vector.data(), vector.data() + 3);
    return values;
}

std::vector<Vector3d> unflattened(const std::vector<double>& values) {
    std::vector<Vector3d> vectors(values.size() / 3);
    for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = Vector3d(values.data() + 3 * i);
    return vectors;
}

}  // namespace samara
