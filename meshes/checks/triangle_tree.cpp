#include "meshes/checks/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace samara {
namespace {

// A long oblique triangle is cut into pieces with a box each, since a single box would be mostly empty.
constexpr std::size_t most_pieces = 32;
constexpr std::size_t pieces_of_all = 4'000'000;

}  // namespace

TriangleTree::TriangleTree(std::vector<Vector3d> vertices, std::vector<Triangle> triangles)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)) {
    std::vector<Box> boxes;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        add_pieces(t, boxes);
        order_.resize(boxes.size(), static_cast<std::uint32_t>(t));
    }
    std::vector<Vector3d> centres;
    centres.reserve(boxes.size());
    for (const Box& box : boxes) centres.push_back(box.center());
    std::vector<std::uint32_t> pieces;
    tree_ = BoxTree(boxes, centres, pieces);
    for (std::uint32_t& piece : pieces) piece = order_[piece];
    order_ = std::move(pieces);
}

void TriangleTree::add_pieces(std::size_t triangle, std::vector<Box>& boxes) const {
    const std::size_t most = std::min<std::size_t>(most_pieces, 1 + pieces_of_all / triangles_.size());
    // Longest edge from a to b, with c across.
    int from = 0;
    double longest = 0.0;
    for (int i = 0; i < 3; ++i) {
        const double square = (corner(triangle, (i + 1) % 3) - corner(triangle, i)).squaredNorm();
        if (square <= longest) continue;
        longest = square;
        from = i;
    }
    const Vector3d& a = corner(triangle, from);
    const Vector3d& b = corner(triangle, (from + 1) % 3);
    const Vector3d& c = corner(triangle, (from + 2) % 3);
    const double area = (b - a).cross(c - a).norm();
    const double slenderness = longest / (2.0 * area);  // 0.6: equilateral
    const std::size_t count =
        area > 0.0 && slenderness > 1.0
            ? static_cast<std::size_t>(std::min(2.0 * std::sqrt(slenderness), static_cast<double>(most)))
            : 1;
    if (count <= 1) {
        boxes.push_back(box_of(triangle));
        return;
    }
    // Slabs across the longest edge: between two of them the triangle reaches from that edge to the other
    // two.
    const double place_of_c = (c - a).dot(b - a) / longest;
    const auto across = [&](double place) -> Vector3d {
        return place <= place_of_c && place_of_c > 0.0
                   ? Vector3d(a + place / place_of_c * (c - a))
                   : Vector3d(b + (1.0 - place) / (1.0 - place_of_c) * (c - b));
    };
    for (std::size_t i = 0; i < count; ++i) {
        const double begin = static_cast<double>(i) / static_cast<double>(count);
        const double end = static_cast<double>(i + 1) / static_cast<double>(count);
        Box box(a + begin * (b - a));
        box.extend(a + end * (b - a));
        box.extend(across(begin));
        box.extend(across(end));
        if (begin <= place_of_c && place_of_c <= end) box.extend(c);
        // Rounding may not leave a part of the triangle outside.
        const Vector3d margin = Vector3d::Constant(1e-12 * std::sqrt(longest));
        boxes.emplace_back(box.min() - margin, box.max() + margin);
    }
}

TriangleTree::Box TriangleTree::box_of(std::size_t triangle) const {
    Box box(corner(triangle, 0));
    box.extend(corner(triangle, 1));
    box.extend(corner(triangle, 2));
    return box;
}

TriangleTree::Nearest TriangleTree::search(const Vector3d& p, double bound, double good_enough) const {
    Nearest best;
    double limit = bound * bound;
    const double enough = good_enough * good_enough;
    std::array<std::pair<double, std::uint32_t>, BoxTree::most_waiting> stack;
    const std::vector<BoxTree::Node>& nodes = tree_.nodes();
    std::size_t depth = 0;
    if (!nodes.empty()) stack[depth++] = {nodes[0].box.squaredExteriorDistance(p), 0U};
    while (depth > 0) {
        const auto [distance, index] = stack[--depth];
        if (distance > limit) continue;
        const BoxTree::Node& node = nodes[index];
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const std::size_t t = order_[i];
            const Vector3d point = closest_point_of_triangle(p, corner(t, 0), corner(t, 1), corner(t, 2));
            const double squared = (point - p).squaredNorm();
            if (squared > limit) continue;
            limit = squared;
            best = {t, point, squared};
            if (squared <= enough) return best;
        }
        if (node.count > 0) continue;
        const std::pair near{nodes[index + 1].box.squaredExteriorDistance(p), index + 1};
        const std::pair far{nodes[node.right].box.squaredExteriorDistance(p), node.right};
        stack[depth++] = std::max(near, far);
        stack[depth++] = std::min(near, far);
    }
    return best;
}

TriangleTree::Nearest TriangleTree::nearest(const Vector3d& p, double bound) const {
    return search(p, bound, 0.0);
}

bool TriangleTree::is_within(const Vector3d& p, double bound) const {
    return search(p, bound, bound).squared_distance <= bound * bound;
}

}  // namespace samara
