#include "internal/export/usd_mesh.hpp"

#include <array>
#include <iterator>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "internal/export/shaded_mesh.hpp"

namespace samara {
namespace {

constexpr std::size_t items_in_line = 8;

/// [a, b, c] over several lines.
std::string usd_list(const std::vector<std::string>& items, const std::string& indent) {
    std::string text = "[";
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (items.size() > items_in_line && i % items_in_line == 0) text += "\n" + indent + "    ";
        text += items[i];
        if (i + 1 < items.size()) text += (i + 1) % items_in_line == 0 ? "," : ", ";
    }
    if (items.size() > items_in_line) text += "\n" + indent;
    return text + "]";
}

/// For each position the index of the first that is the same.
std::vector<std::size_t> welded(const std::vector<Vector3d>& positions, std::vector<std::string>& points) {
    std::map<std::array<double, 3>, std::size_t> known;
    std::vector<std::size_t> indices;
    for (const Vector3d& p : positions) {
        const auto [place, is_new] = known.try_emplace({p.x(), p.y(), p.z()}, points.size());
        if (is_new) points.push_back(usd_float3(p));
        indices.push_back(place->second);
    }
    return indices;
}

}  // namespace

std::string usd_float(double value) {
    return fmt::format("{}", static_cast<float>(value));
}

std::string usd_float3(const Vector3d& vector) {
    return fmt::format("({}, {}, {})", static_cast<float>(vector.x()), static_cast<float>(vector.y()),
                       static_cast<float>(vector.z()));
}

std::string usd_mesh(const Surface& surface, std::size_t indent, double grey, bool double_sided) {
    const ShadedMesh mesh = shaded_mesh(surface);
    std::vector<std::string> points;
    const std::vector<std::size_t> point_of = welded(mesh.positions, points);
    const bool smooth = points.size() == mesh.positions.size();
    std::vector<std::string> counts;
    std::vector<std::string> indices;
    std::vector<std::string> normals;
    for (const auto& triangle : mesh.triangles) {
        counts.emplace_back("3");
        for (const std::uint32_t corner : triangle) {
            indices.push_back(fmt::format("{}", point_of[corner]));
            if (!smooth) normals.push_back(usd_float3(mesh.normals[corner]));
        }
    }
    if (smooth) {
        for (const Vector3d& normal : mesh.normals) normals.push_back(usd_float3(normal));
    }
    Eigen::AlignedBox3d box;
    for (const Vector3d& position : mesh.positions) box.extend(position);

    const std::string outer(indent, ' ');
    const std::string inner = outer + "    ";
    fmt::memory_buffer text;
    const auto line = std::back_inserter(text);
    fmt::format_to(line, "{}def Mesh \"mesh\"\n{}{{\n", outer, outer);
    fmt::format_to(line, "{}float3[] extent = [{}, {}]\n", inner, usd_float3(box.min()),
                   usd_float3(box.max()));
    fmt::format_to(line, "{}int[] faceVertexCounts = {}\n", inner, usd_list(counts, inner));
    fmt::format_to(line, "{}int[] faceVertexIndices = {}\n", inner, usd_list(indices, inner));
    fmt::format_to(line, "{}normal3f[] normals = {} (\n{}    interpolation = \"{}\"\n{})\n", inner,
                   usd_list(normals, inner), inner, smooth ? "vertex" : "faceVarying", inner);
    fmt::format_to(line, "{}point3f[] points = {}\n", inner, usd_list(points, inner));
    fmt::format_to(line, "{0}color3f[] primvars:displayColor = [({1}, {1}, {1})]\n", inner, grey);
    if (double_sided) fmt::format_to(line, "{}uniform bool doubleSided = true\n", inner);
    fmt::format_to(line, "{}uniform token subdivisionScheme = \"none\"\n{}}}\n", inner, outer);
    return fmt::to_string(text);
}

}  // namespace samara
