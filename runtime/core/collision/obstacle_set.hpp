#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "samara/core/base/box_tree.hpp"
#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/physics/obstacle.hpp"

namespace samara {

/// A face of an obstacle, prepared for contacts on both of its sides.
struct ObstacleTriangle {
    std::array<Vector3d, 3> corners;  ///< m, shape axes
    Vector3d normal;
    /// The third corner of the face beyond each side, from corner i to the next; the first corner of the side
    /// where the surface ends.
    std::array<Vector3d, 3> beyond;
    /// Whether something can lie on each side, from above or below: where the surface ends or is not flat.
    std::array<bool, 3> stands_out;
    /// Unit vectors from each corner along all sides that end there, of any face.
    std::array<std::span<const Vector3d>, 3> around;
    /// The triangle's number in the surface.
    std::int32_t index;

    /// Returns the distance (m) that it reaches along a unit vector.
    [[nodiscard]] double reach(const Vector3d& direction) const noexcept {
        return std::max({corners[0].dot(direction), corners[1].dot(direction), corners[2].dot(direction)});
    }
    /// Returns whether the projection of a point along the normal lies within it, or beside it within
    /// `margin` (m).
    [[nodiscard]] bool is_under(const Vector3d& point, double margin) const noexcept {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3d side = corners[(i + 1) % 3] - corners[i];
            const double area = normal.dot(side.cross(point - corners[i]));
            if (area < -margin * side.norm()) return false;
        }
        return true;
    }
};

/// One obstacle with a tree of boxes over its faces.
class ObstacleFaces {
  public:
    /// Prepares an obstacle, whose surface must be welded and have no face without area.
    explicit ObstacleFaces(Obstacle obstacle);
    ObstacleFaces(ObstacleFaces&&) noexcept = default;
    ObstacleFaces& operator=(ObstacleFaces&&) noexcept = default;
    ObstacleFaces(const ObstacleFaces&) = delete;  // its faces point into it
    ObstacleFaces& operator=(const ObstacleFaces&) = delete;
    ~ObstacleFaces() = default;

    [[nodiscard]] const Obstacle& obstacle() const noexcept { return obstacle_; }
    /// Replaces the keys: one at least, in ascending order of time.
    void set_keys(std::vector<ObstacleKey> keys);
    /// Takes it out of the world: it is nowhere, and stands still.
    void remove();
    [[nodiscard]] bool is_removed() const noexcept { return is_removed_; }
    /// Returns whether it has an inside.
    [[nodiscard]] bool is_closed() const noexcept { return is_closed_; }
    /// Returns whether a point (m, shape axes) lies inside the obstacle, which must be closed.
    [[nodiscard]] bool encloses(const Vector3d& point) const noexcept;
    /// Returns an upper bound of the speed (m/s) of its points.
    [[nodiscard]] double fastest() const noexcept { return fastest_; }
    /// Returns a box in the world that it never leaves; an empty one once it is removed.
    [[nodiscard]] const Eigen::AlignedBox3d& whereabouts() const noexcept { return whereabouts_; }

    /// Calls `visit` with each face whose box intersects `box` (m, shape axes). Never allocates.
    template <typename Visit>
    void visit_near(const Eigen::AlignedBox3d& box, const Visit& visit) const noexcept {
        tree_.visit_near(box, [&](std::uint32_t i) {
            visit(triangles_[i]);
            return true;
        });
    }

  private:
    void prepare_triangles();
    void look_around_corners();
    void grow_tree();
    void measure_displacements();

    Obstacle obstacle_;
    bool is_closed_ = false;
    bool is_removed_ = false;
    double fastest_ = 0.0;
    Eigen::AlignedBox3d whereabouts_;
    std::vector<Vector3d> around_;             ///< corner by corner
    std::vector<ObstacleTriangle> triangles_;  ///< as the tree's leaves hold them
    BoxTree tree_;
};

/// All obstacles of a simulation.
class ObstacleSet {
  public:
    explicit ObstacleSet(const std::vector<Obstacle>& obstacles);

    /// Adds an obstacle, as ObstacleFaces takes it.
    void add(Obstacle obstacle);
    /// Replaces the keys of an obstacle, as ObstacleFaces takes them.
    void set_keys(std::size_t index, std::vector<ObstacleKey> keys);
    /// Removes an obstacle; the others keep their numbers.
    void remove(std::size_t index);

    [[nodiscard]] const std::vector<ObstacleFaces>& obstacles() const noexcept { return obstacles_; }
    /// Returns whether any of them has keys.
    [[nodiscard]] bool moves() const noexcept { return fastest_ > 0.0; }
    /// Returns an upper bound of the speed (m/s) of the points of all.
    [[nodiscard]] double fastest() const noexcept { return fastest_; }
    /// Returns a box in the world that none ever leaves.
    [[nodiscard]] const Eigen::AlignedBox3d& whereabouts() const noexcept { return whereabouts_; }

  private:
    void measure();

    std::vector<ObstacleFaces> obstacles_;
    double fastest_ = 0.0;
    Eigen::AlignedBox3d whereabouts_;
};

/// Returns the distance (m) of a place in the world from the nearest obstacle at a time (s): 0 inside a
/// closed one, `within` where none is nearer. Never throws or allocates.
double distance_from(const ObstacleSet& obstacles, const Vector3d& place, double time,
                     double within) noexcept;

}  // namespace samara
