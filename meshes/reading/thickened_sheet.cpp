#include "meshes/reading/thickened_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/surface/surface_check.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

constexpr double most_thickness = 0.2;  // over the diagonal of the bounding box
// At a fold sharper than a right angle the faces come nearer to each other than the thickness.
constexpr double least_cosine = 0.7;

void require_sheet(const Surface& sheet, double thickness) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : sheet.vertices) box.extend(vertex);
    const double diagonal = box.diagonal().norm();
    if (thickness > most_thickness * diagonal) {
        throw Error(
            fmt::format("the thickness of {:.3g} m is more than a fifth of the shape's {:.3g} m; check "
                        "the unit of either",
                        thickness, diagonal));
    }
    const std::vector<EdgeUse> uses = edge_uses(sheet);
    bool is_open = false;
    for (const auto& edge : edges_of(uses)) {
        is_open = is_open || edge.size() == 1;
        if (edge.size() <= 2) continue;
        throw Error(fmt::format("cannot be thickened: the edge from {} to {} has {} faces; leave two",
                                place(vertex(sheet, edge.front().low)),
                                place(vertex(sheet, edge.front().high)), edge.size()));
    }
    if (!is_open) throw Error("is closed already; leave the thickness out");
}

/// Orients the faces of each piece like its first.
void orient_alike(Surface& sheet) {
    for (const Component& piece : components(sheet)) {
        for (const std::int32_t triangle : piece.against) {
            reverse_triangle(sheet, static_cast<std::size_t>(triangle));
        }
    }
    const std::vector<EdgeUse> uses = edge_uses(sheet);
    for (const auto& edge : edges_of(uses)) {
        if (edge.size() < 2 || edge[0].forward != edge[1].forward) continue;
        throw Error(
            fmt::format("cannot be thickened: the sheet has one side only (a Moebius strip, near {}); "
                        "cut it",
                        place(vertex(sheet, edge.front().low))));
    }
}

/// Returns for each vertex the displacement by which the faces around it move one along their normals.
std::vector<Vector3d> displacements(const Surface& sheet) {
    std::vector<Vector3d> sums(sheet.vertices.size(), Vector3d::Zero());
    const auto for_each_corner = [&](const auto& visit) {
        for (std::size_t t = 0; t < sheet.triangle_count(); ++t) {
            const Vector3d normal = area_vector(sheet, t).normalized();
            for (std::size_t i = 0; i < 3; ++i) visit(t, i, normal);
        }
    };
    for_each_corner([&](std::size_t t, std::size_t i, const Vector3d& normal) {
        const auto& corners = sheet.corners[t];
        const Vector3d here = vertex(sheet, corners[i]);
        const Vector3d a = (vertex(sheet, corners[(i + 1) % 3]) - here).normalized();
        const Vector3d b = (vertex(sheet, corners[(i + 2) % 3]) - here).normalized();
        sums[static_cast<std::size_t>(corners[i])] += std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * normal;
    });
    for (Vector3d& sum : sums) sum.normalize();
    std::vector<double> cosines(sums.size(), 1.0);
    for_each_corner([&](std::size_t t, std::size_t i, const Vector3d& normal) {
        const auto corner = static_cast<std::size_t>(sheet.corners[t][i]);
        cosines[corner] = std::min(cosines[corner], normal.dot(sums[corner]));
    });
    for (std::size_t v = 0; v < sums.size(); ++v) sums[v] /= std::max(cosines[v], least_cosine);
    return sums;
}

}  // namespace

Surface thickened(const Surface& sheet, double thickness) {
    require_sheet(sheet, thickness);
    Surface middle = sheet;
    orient_alike(middle);
    const std::vector<Vector3d> displacement = displacements(middle);
    const auto count = static_cast<std::int32_t>(middle.vertices.size());
    Surface solid;
    for (const double side : {0.5, -0.5}) {
        for (std::size_t v = 0; v < middle.vertices.size(); ++v) {
            solid.vertices.push_back(middle.vertices[v] + side * thickness * displacement[v]);
        }
    }
    for (const auto& [a, b, c] : middle.corners) {
        solid.corners.push_back({a, b, c});
        solid.corners.push_back({a + count, c + count, b + count});
    }
    const std::vector<EdgeUse> uses = edge_uses(middle);
    for (const auto& edge : edges_of(uses)) {
        if (edge.size() != 1) continue;
        const EdgeUse& use = edge.front();
        const std::int32_t from = use.forward ? use.low : use.high;
        const std::int32_t to = use.forward ? use.high : use.low;
        solid.corners.push_back({to, from, from + count});
        solid.corners.push_back({to, from + count, to + count});
    }
    return solid;
}

}  // namespace samara
