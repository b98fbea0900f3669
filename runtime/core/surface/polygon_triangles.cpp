#include "samara/core/surface/polygon_triangles.hpp"

#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>

namespace samara {
namespace {

using Triangle = std::array<std::int32_t, 3>;
using Point = Eigen::Vector2d;

// Returns twice the area of the triangle, positive where it runs anticlockwise.
double doubled_area(const Point& a, const Point& b, const Point& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

class EarCutter {
  public:
    EarCutter(const std::vector<Vector3d>& vertices, const std::vector<std::int32_t>& corners)
        : corners_(corners), next_(corners.size()), previous_(corners.size()), remaining_(corners.size()) {
        const std::size_t count = corners.size();
        for (std::size_t i = 0; i < count; ++i) {
            next_[i] = (i + 1) % count;
            previous_[i] = (i + count - 1) % count;
        }
        project(vertices);
        for (std::size_t i = 0; i < count; ++i) {
            if (!is_convex(i)) reflex_.push_back(i);
        }
    }

    std::vector<Triangle> cut() {
        std::vector<std::size_t> round(corners_.size());
        std::iota(round.begin(), round.end(), std::size_t{0});
        std::vector<std::size_t> next_round;
        std::vector<bool> is_gone(corners_.size());
        std::vector<bool> waits(corners_.size());
        while (remaining_ > 3 && !round.empty()) {
            const auto wait = [&](std::size_t corner) {
                if (!waits[corner]) next_round.push_back(corner);
                waits[corner] = true;
            };
            for (const std::size_t corner : round) {
                // Cutting an ear changes its neighbours alone: all other corners stay what they are.
                if (is_gone[corner] || waits[corner] || remaining_ == 3 || !is_ear(corner)) continue;
                is_gone[corner] = true;
                remove(corner);
                wait(previous_[corner]);
                wait(next_[corner]);
            }
            for (const std::size_t corner : next_round) waits[corner] = false;
            round.swap(next_round);
            next_round.clear();
            std::erase_if(reflex_, [&](std::size_t corner) { return is_gone[corner] || is_convex(corner); });
        }
        const auto rest =
            static_cast<std::size_t>(std::find(is_gone.begin(), is_gone.end(), false) - is_gone.begin());
        while (remaining_ > 2) remove(next_[rest]);
        return triangles_;
    }

  private:
    // Projects the polygon onto the plane of the two axes in which its area is largest.
    void project(const std::vector<Vector3d>& vertices) {
        const auto vertex = [&](std::size_t i) -> const Vector3d& {
            return vertices[static_cast<std::size_t>(corners_[i])];
        };
        Vector3d normal = Vector3d::Zero();
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            normal += (vertex(i) - vertex(0)).cross(vertex(next_[i]) - vertex(0));
        }
        Eigen::Index axis = 0;
        normal.cwiseAbs().maxCoeff(&axis);
        const double sign = normal[axis] < 0.0 ? -1.0 : 1.0;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            points_.emplace_back(sign * vertex(i)[(axis + 1) % 3], vertex(i)[(axis + 2) % 3]);
        }
    }

    [[nodiscard]] bool is_convex(std::size_t corner) const {
        return doubled_area(points_[previous_[corner]], points_[corner], points_[next_[corner]]) > 0.0;
    }

    [[nodiscard]] bool is_ear(std::size_t corner) const {
        if (!is_convex(corner)) return false;
        const Point& a = points_[previous_[corner]];
        const Point& b = points_[corner];
        const Point& c = points_[next_[corner]];
        return std::none_of(reflex_.begin(), reflex_.end(), [&](std::size_t other) {
            const Point& p = points_[other];
            return p != a && p != b && p != c && doubled_area(a, b, p) >= 0.0 &&
                   doubled_area(b, c, p) >= 0.0 && doubled_area(c, a, p) >= 0.0;
        });
    }

    void remove(std::size_t corner) {
        const std::size_t before = previous_[corner];
        const std::size_t after = next_[corner];
        triangles_.push_back({corners_[before], corners_[corner], corners_[after]});
        next_[before] = after;
        previous_[after] = before;
        --remaining_;
    }

    const std::vector<std::int32_t>& corners_;
    std::vector<std::size_t> next_;
    std::vector<std::size_t> previous_;
    std::size_t remaining_;
    std::vector<Point> points_;
    std::vector<std::size_t> reflex_;
    std::vector<Triangle> triangles_;
};

}  // namespace

std::vector<Triangle> polygon_triangles(const std::vector<Vector3d>& vertices,
                                        const std::vector<std::int32_t>& corners) {
    if (corners.size() == 3) return {{corners[0], corners[1], corners[2]}};
    return EarCutter(vertices, corners).cut();
}

}  // namespace samara
