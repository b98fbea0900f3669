#include "samara/kirchhoff/panels/linear_elements.hpp"

#include <numeric>

namespace samara {
namespace {

std::int32_t root_of(std::vector<std::int32_t>& parents, std::int32_t node) {
    const auto parent = [&](std::int32_t i) -> std::int32_t& { return parents[static_cast<std::size_t>(i)]; };
    while (parent(node) != node) {
        parent(node) = parent(parent(node));
        node = parent(node);
    }
    return node;
}

void find_components(LinearElements& elements) {
    std::vector<std::int32_t> parents(elements.node_count());
    std::iota(parents.begin(), parents.end(), 0);
    for (const auto& corners : elements.corners) {
        const std::int32_t first = root_of(parents, corners[0]);
        parents[static_cast<std::size_t>(root_of(parents, corners[1]))] = first;
        parents[static_cast<std::size_t>(root_of(parents, corners[2]))] = first;
    }
    std::vector<std::int32_t> number(elements.node_count(), -1);
    elements.component.resize(elements.node_count());
    for (std::size_t i = 0; i < elements.node_count(); ++i) {
        std::int32_t& known =
            number[static_cast<std::size_t>(root_of(parents, static_cast<std::int32_t>(i)))];
        if (known < 0) known = elements.component_count++;
        elements.component[i] = known;
    }
}

}  // namespace

LinearElements linear_elements(const Surface& surface, std::size_t leaf_size) {
    const std::vector<FlatTriangle> unordered = flat_triangles(surface);
    LinearElements elements;
    elements.tree = cluster_tree(unordered, leaf_size);
    std::vector<std::int32_t> renumbered(surface.vertices.size(), -1);
    for (const std::size_t t : elements.tree.order) {
        elements.triangles.push_back(unordered[t]);
        std::array<std::int32_t, 3> corners = surface.corners[t];
        for (std::int32_t& corner : corners) {
            std::int32_t& node = renumbered[static_cast<std::size_t>(corner)];
            if (node < 0) {
                node = static_cast<std::int32_t>(elements.node_count());
                elements.nodes.push_back(surface.vertices[static_cast<std::size_t>(corner)]);
            }
            corner = node;
        }
        elements.corners.push_back(corners);
    }
    find_components(elements);
    return elements;
}

void remove_component_sums(const LinearElements& elements, SixColumns& columns) {
    using Sums = Eigen::Matrix<double, 1, 6>;
    const auto components = static_cast<std::size_t>(elements.component_count);
    std::vector<Sums> sums(components, Sums::Zero());
    std::vector<double> areas(components, 0.0);
    std::vector<double> shares(elements.node_count(), 0.0);
    for (std::size_t t = 0; t < elements.triangle_count(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) shares[elements.node(t, k)] += elements.triangles[t].area / 3.0;
    }
    for (std::size_t i = 0; i < elements.node_count(); ++i) {
        const auto component = static_cast<std::size_t>(elements.component[i]);
        sums[component] += columns.row(static_cast<Eigen::Index>(i));
        areas[component] += shares[i];
    }
    for (std::size_t i = 0; i < elements.node_count(); ++i) {
        const auto component = static_cast<std::size_t>(elements.component[i]);
        columns.row(static_cast<Eigen::Index>(i)) -= shares[i] / areas[component] * sums[component];
    }
}

}  // namespace samara
