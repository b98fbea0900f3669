#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A bounding volume tree. Each level halves the boxes along the axis on which their places differ most.
class BoxTree {
  public:
    using Box = Eigen::AlignedBox3d;
    /// The box around all boxes of a branch or a leaf.
    struct Node {
        Box box;
        std::uint32_t first = 0;  ///< of a leaf: the first of its boxes in the order
        std::uint32_t count = 0;  ///< of a leaf's boxes; 0: a branch
        std::uint32_t right = 0;  ///< of a branch: its second child; the first follows it
    };
    /// The most nodes that wait during a traversal of a tree of 2^32 boxes: one for each level, and room to
    /// spare.
    static constexpr std::size_t most_waiting = 64;

    BoxTree() = default;
    /// Builds the tree. `places`: a point of each box. `order`: receives the boxes' numbers in the order of
    /// the leaves.
    BoxTree(const std::vector<Box>& boxes, const std::vector<Vector3d>& places,
            std::vector<std::uint32_t>& order) {
        order.resize(boxes.size());
        std::iota(order.begin(), order.end(), 0U);
        if (!order.empty()) build(boxes, places, order, 0, static_cast<std::uint32_t>(order.size()));
    }

    /// Returns the nodes, the root first; empty where there are no boxes.
    [[nodiscard]] const std::vector<Node>& nodes() const noexcept { return nodes_; }

    /// Calls `visit` with the place in the order of each box whose leaf's box intersects `box`, until it
    /// returns false. Never allocates.
    template <typename Visit>
    void visit_near(const Box& box, const Visit& visit) const {
        std::array<std::uint32_t, most_waiting> waiting;
        std::size_t count = 0;
        if (!nodes_.empty()) waiting[count++] = 0;
        while (count > 0) {
            const std::uint32_t at = waiting[--count];
            const Node& node = nodes_[at];
            if (!node.box.intersects(box)) continue;
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                if (!visit(i)) return;
            }
            if (node.count > 0) continue;
            waiting[count++] = node.right;
            waiting[count++] = at + 1;
        }
    }

  private:
    static constexpr std::uint32_t boxes_of_a_leaf = 4;

    void build(const std::vector<Box>& boxes, const std::vector<Vector3d>& places,
               std::vector<std::uint32_t>& order, std::uint32_t first, std::uint32_t count) {
        const std::size_t self = nodes_.size();
        nodes_.emplace_back();
        Box box;
        Box box_of_places;
        for (std::uint32_t i = first; i < first + count; ++i) {
            box.extend(boxes[order[i]]);
            box_of_places.extend(places[order[i]]);
        }
        nodes_[self].box = box;
        nodes_[self].first = first;
        if (count <= boxes_of_a_leaf) {
            nodes_[self].count = count;
            return;
        }
        Eigen::Index axis = 0;
        box_of_places.sizes().maxCoeff(&axis);
        const std::uint32_t half = count / 2;
        const auto begin = order.begin() + first;
        std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(places[a][axis], a) < std::pair(places[b][axis], b);
        });
        build(boxes, places, order, first, half);
        nodes_[self].right = static_cast<std::uint32_t>(nodes_.size());
        build(boxes, places, order, first + half, count - half);
    }

    std::vector<Node> nodes_;
};

}  // namespace samara
