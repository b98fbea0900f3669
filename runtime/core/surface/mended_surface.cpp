#include "samara/core/surface/mended_surface.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "samara/core/base/error.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

using Triangle = std::array<std::int32_t, 3>;

bool is_collapsed(const Triangle& triangle) {
    return triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
}

void erase_faces(Surface& surface, const std::vector<bool>& gone) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < gone.size(); ++t) {
        if (gone[t]) continue;
        surface.corners[kept] = surface.corners[t];
        if (surface.order() == 2) surface.edge_nodes[kept] = surface.edge_nodes[t];
        ++kept;
    }
    const bool curved = surface.order() == 2;
    surface.corners.resize(kept);
    if (curved) surface.edge_nodes.resize(kept);
}

// Returns the faces that are folded: two of the same corners, facing each other, whose edges have other
// faces, or none, once both are gone.
std::vector<bool> folded_faces(const Surface& surface) {
    const std::vector<EdgeUse> uses = edge_uses(surface);
    std::vector<bool> at_odd_edge(surface.triangle_count(), false);
    for (const auto& edge : edges_of(uses)) {
        if (edge.size() % 2 == 0) continue;
        for (const EdgeUse& use : edge) at_odd_edge[as_index(use.triangle)] = true;
    }
    // Each face's corners rotated so that the smallest comes first: the last two tell the orientation.
    std::vector<std::tuple<std::int32_t, std::int32_t, std::int32_t, bool, std::size_t>> faces;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        Triangle corners = surface.corners[t];
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        const bool reversed = corners[1] > corners[2];
        faces.emplace_back(corners[0], std::min(corners[1], corners[2]), std::max(corners[1], corners[2]),
                           reversed, t);
    }
    std::sort(faces.begin(), faces.end());
    std::vector<bool> folded(surface.triangle_count(), false);
    for (std::size_t i = 1; i < faces.size(); ++i) {
        const auto& [a, b, c, reversed, t] = faces[i];
        const auto& [before_a, before_b, before_c, before_reversed, before] = faces[i - 1];
        const bool same = a == before_a && b == before_b && c == before_c && reversed != before_reversed;
        if (!same || at_odd_edge[t] || at_odd_edge[before] || folded[before]) continue;
        folded[t] = true;
        folded[before] = true;
    }
    return folded;
}

void drop_unused_vertices(Surface& surface) {
    std::vector<std::int32_t> new_index(surface.vertices.size(), -1);
    std::vector<Vector3d> kept;
    for (auto* list : {&surface.corners, &surface.edge_nodes}) {
        for (Triangle& triangle : *list) {
            for (std::int32_t& index : triangle) {
                std::int32_t& mine = new_index[as_index(index)];
                if (mine < 0) {
                    mine = static_cast<std::int32_t>(kept.size());
                    kept.push_back(vertex(surface, index));
                }
                index = mine;
            }
        }
    }
    surface.vertices = std::move(kept);
}

// Returns zero where each edge has an even number of faces, and hardly ever otherwise.
std::uint64_t mark_of_odd_edges(const Surface& surface) {
    std::uint64_t mark = 0;
    for (const Triangle& corners : surface.corners) {
        for (std::size_t side = 0; side < 3; ++side) {
            const auto [low, high] = std::minmax(corners[side], corners[(side + 1) % 3]);
            std::uint64_t key = static_cast<std::uint64_t>(low) << 32U | static_cast<std::uint32_t>(high);
            // The finalizer of MurmurHash3.
            key = (key ^ key >> 33U) * 0xff51afd7ed558ccdU;
            key = (key ^ key >> 33U) * 0xc4ceb9fe1a85ec53U;
            mark ^= key ^ key >> 33U;
        }
    }
    return mark;
}

// The corners at the ends of open sides, by their place along one axis.
class OpenCorners {
  public:
    OpenCorners(const Surface& surface, const std::vector<EdgeUse>& open) : surface_(surface) {
        Eigen::AlignedBox3d box;
        for (const EdgeUse& use : open) {
            for (const std::int32_t index : {use.low, use.high}) {
                corners_.push_back(index);
                box.extend(vertex(surface, index));
            }
        }
        if (!corners_.empty()) box.sizes().maxCoeff(&axis_);
        const auto key = [&](std::int32_t index) { return std::pair(vertex(surface, index)[axis_], index); };
        std::sort(corners_.begin(), corners_.end(),
                  [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
        corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    }

    // Returns the open corners on the side between two corners, the nearest to the first one first.
    [[nodiscard]] std::vector<std::int32_t> between(std::int32_t from, std::int32_t to,
                                                    double tolerance) const {
        const Vector3d& start = vertex(surface_, from);
        const Vector3d along = vertex(surface_, to) - start;
        const double length = along.norm();
        const double low = std::min(start[axis_], start[axis_] + along[axis_]) - tolerance;
        const double high = std::max(start[axis_], start[axis_] + along[axis_]) + tolerance;
        auto place = std::lower_bound(
            corners_.begin(), corners_.end(), low,
            [&](std::int32_t index, double value) { return vertex(surface_, index)[axis_] < value; });
        std::vector<std::pair<double, std::int32_t>> found;
        for (; place != corners_.end() && vertex(surface_, *place)[axis_] <= high; ++place) {
            const Vector3d arm = vertex(surface_, *place) - start;
            const double share = arm.dot(along) / length;
            if (*place == from || *place == to || share <= tolerance || share >= length - tolerance) continue;
            if ((arm - share / length * along).norm() <= tolerance) found.emplace_back(share, *place);
        }
        std::sort(found.begin(), found.end());
        std::vector<std::int32_t> result;
        for (const auto& [share, index] : found) result.push_back(index);
        return result;
    }

  private:
    const Surface& surface_;
    std::vector<std::int32_t> corners_;
    Eigen::Index axis_ = 0;
};

std::vector<EdgeUse> open_sides(const Surface& surface) {
    const std::vector<EdgeUse> uses = edge_uses(surface);
    std::vector<EdgeUse> open;
    for (const auto& edge : edges_of(uses)) {
        if (edge.size() == 1) open.push_back(edge.front());
    }
    return open;
}

// Cuts each face with an open corner on its side once; false where there is none.
bool split_each_once(Surface& surface, double tolerance) {
    constexpr std::size_t most_open_sides = 20'000;  // each is compared with all: so many are no small errors
    const std::vector<EdgeUse> open = open_sides(surface);
    if (open.size() > most_open_sides) return false;
    const OpenCorners corners(surface, open);
    std::vector<bool> is_cut(surface.triangle_count(), false);
    bool any = false;
    for (const EdgeUse& use : open) {
        const auto t = as_index(use.triangle);
        if (is_cut[t]) continue;
        const Triangle face = surface.corners[t];
        const auto side = as_index(use.side);
        const std::int32_t tip = face[(side + 2) % 3];
        std::int32_t from = face[side];
        std::vector<std::int32_t> cuts = corners.between(from, face[(side + 1) % 3], tolerance);
        if (cuts.empty() || std::find(cuts.begin(), cuts.end(), tip) != cuts.end()) continue;
        cuts.push_back(face[(side + 1) % 3]);
        surface.corners[t] = {from, cuts.front(), tip};
        for (std::size_t i = 1; i < cuts.size(); ++i) {
            surface.corners.push_back({cuts[i - 1], cuts[i], tip});
        }
        is_cut[t] = true;
        any = true;
    }
    return any;
}

class FaceFlipper {
  public:
    FaceFlipper(Surface& surface, double tolerance) : surface_(surface), tolerance_(tolerance) {
        for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
            if (is_flat(surface.corners[t])) waiting_.push_back(t);
        }
        if (waiting_.empty()) return;
        for (std::size_t t = 0; t < surface.triangle_count(); ++t) enter(t);
    }

    void flip_all() {
        // Each flip leaves fewer flat faces, or thicker ones; rounding may keep it from ending.
        std::size_t left = 16 * waiting_.size();
        while (!waiting_.empty() && left-- > 0) {
            const std::size_t t = waiting_.front();
            waiting_.pop_front();
            if (is_flat(surface_.corners[t])) flip(t);
        }
    }

  private:
    [[nodiscard]] double height(const Triangle& face) const {
        const Vector3d& a = vertex(surface_, face[0]);
        const Vector3d& b = vertex(surface_, face[1]);
        const Vector3d& c = vertex(surface_, face[2]);
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        return (b - a).cross(c - a).norm() / longest;
    }

    [[nodiscard]] Vector3d normal(const Triangle& face) const {
        const Vector3d& a = vertex(surface_, face[0]);
        return (vertex(surface_, face[1]) - a).cross(vertex(surface_, face[2]) - a);
    }

    // Excludes small faces that are as low as they are long.
    [[nodiscard]] bool is_flat(const Triangle& face) const {
        constexpr double flat = 1e-3;
        const double low = height(face);
        return low <= tolerance_ && 2.0 * low * low <= flat * normal(face).norm();
    }

    static std::uint64_t key(std::int32_t a, std::int32_t b) {
        const auto [low, high] = std::minmax(a, b);
        return static_cast<std::uint64_t>(low) << 32U | static_cast<std::uint32_t>(high);
    }

    void enter(std::size_t t) {
        const Triangle& face = surface_.corners[t];
        for (std::size_t side = 0; side < 3; ++side)
            faces_at_[key(face[side], face[(side + 1) % 3])].push_back(t);
    }

    void leave(std::size_t t) {
        const Triangle& face = surface_.corners[t];
        for (std::size_t side = 0; side < 3; ++side) {
            const auto place = faces_at_.find(key(face[side], face[(side + 1) % 3]));
            std::erase(place->second, t);
            if (place->second.empty()) faces_at_.erase(place);
        }
    }

    void flip(std::size_t t) {
        const Triangle face = surface_.corners[t];
        std::size_t side = 0;
        double longest = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double length = (vertex(surface_, face[(i + 1) % 3]) - vertex(surface_, face[i])).norm();
            if (length > longest) {
                longest = length;
                side = i;
            }
        }
        const std::int32_t from = face[side];
        const std::int32_t to = face[(side + 1) % 3];
        const std::int32_t tip = face[(side + 2) % 3];
        const std::vector<std::size_t>& both = faces_at_.at(key(from, to));
        if (both.size() != 2) return;
        // A face at the rim of a sheet bridges nothing, and may be deleted.
        if (faces_at_.at(key(to, tip)).size() < 2 || faces_at_.at(key(tip, from)).size() < 2) return;
        const std::size_t u = both[0] == t ? both[1] : both[0];
        const Triangle other = surface_.corners[u];
        const auto at = static_cast<std::size_t>(std::find(other.begin(), other.end(), to) - other.begin());
        const std::int32_t its_tip = other[(at + 2) % 3];
        if (other[(at + 1) % 3] != from || its_tip == tip || faces_at_.contains(key(tip, its_tip))) return;
        const Triangle first = {tip, from, its_tip};
        const Triangle second = {its_tip, to, tip};
        if (std::min(height(first), height(second)) <= std::min(height(face), height(other))) return;
        if (!is_flat(other) &&
            std::min(normal(first).dot(normal(other)), normal(second).dot(normal(other))) <= 0.0)
            return;
        leave(t);
        leave(u);
        surface_.corners[t] = first;
        surface_.corners[u] = second;
        enter(t);
        enter(u);
        // Faces that waited for a neighbour with area have one now.
        for (const Triangle& changed : {first, second}) {
            for (std::size_t i = 0; i < 3; ++i) {
                for (const std::size_t near : faces_at_.at(key(changed[i], changed[(i + 1) % 3]))) {
                    if (is_flat(surface_.corners[near])) waiting_.push_back(near);
                }
            }
        }
    }

    Surface& surface_;
    double tolerance_;
    std::deque<std::size_t> waiting_;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> faces_at_;
};

// Leaves out triangles with two equal corners, folded_faces(), and vertices that no triangle uses.
void drop_collapsed_faces(Surface& surface) {
    if (std::none_of(surface.corners.begin(), surface.corners.end(), is_collapsed)) return;
    std::vector<bool> gone;
    for (const Triangle& triangle : surface.corners) gone.push_back(is_collapsed(triangle));
    erase_faces(surface, gone);
    erase_faces(surface, folded_faces(surface));
    drop_unused_vertices(surface);
}

// Ends at once where every side has a neighbour.
void split_at_corners_on_sides(Surface& surface, double tolerance) {
    if (mark_of_odd_edges(surface) == 0) return;
    constexpr int most_rounds = 8;  // a face has three sides, and their parts may have corners on them again
    for (int round = 0; round < most_rounds && split_each_once(surface, tolerance); ++round) {
    }
}

}  // namespace

Surface mended(const Surface& surface, double part) {
    Surface result = welded(surface, part);
    const double tolerance = part * bounding_box(surface).diagonal().norm();
    drop_collapsed_faces(result);
    if (result.order() == 1) {
        split_at_corners_on_sides(result, tolerance);
        FaceFlipper(result, tolerance).flip_all();
    }
    if (result.corners.empty()) {
        throw Error("none of its triangles has an area; export the surface as triangles");
    }
    return result;
}

}  // namespace samara
