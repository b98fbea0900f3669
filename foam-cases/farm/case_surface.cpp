#include "foam-cases/farm/case_surface.hpp"

#include <iterator>

#include <fmt/format.h>

namespace samara {
namespace {

void append_facet(std::string& text, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const auto out = std::back_inserter(text);
    const Vector3d normal = (b - a).cross(c - a).normalized();
    fmt::format_to(out, "  facet normal {:.6g} {:.6g} {:.6g}\n    outer loop\n", normal.x(), normal.y(),
                   normal.z());
    for (const Vector3d* corner : {&a, &b, &c}) {
        fmt::format_to(out, "      vertex {:.9g} {:.9g} {:.9g}\n", corner->x(), corner->y(), corner->z());
    }
    text += "    endloop\n  endfacet\n";
}

}  // namespace

std::string case_surface_stl(const Body& body, const BakePlan& plan) {
    const Surface& surface = body.surface;
    const auto in_case_axes = [&](std::int32_t vertex) -> Vector3d {
        return plan.axes.transpose() *
               (surface.vertices[static_cast<std::size_t>(vertex)] - body.moments.centroid) /
               plan.reference_length;
    };
    std::string text = "solid body\n";
    for (std::size_t triangle = 0; triangle < surface.triangle_count(); ++triangle) {
        const auto& corners = surface.corners[triangle];
        const Vector3d a = in_case_axes(corners[0]);
        const Vector3d b = in_case_axes(corners[1]);
        const Vector3d c = in_case_axes(corners[2]);
        if (surface.order() == 1) {
            append_facet(text, a, b, c);
            continue;
        }
        const auto& middles = surface.edge_nodes[triangle];
        const Vector3d ab = in_case_axes(middles[0]);
        const Vector3d bc = in_case_axes(middles[1]);
        const Vector3d ca = in_case_axes(middles[2]);
        append_facet(text, a, ab, ca);
        append_facet(text, b, bc, ab);
        append_facet(text, c, ca, bc);
        append_facet(text, ab, bc, ca);
    }
    return text + "endsolid body\n";
}

}  // namespace samara
