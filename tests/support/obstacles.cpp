#include "support/obstacles.hpp"

#include <memory>

namespace samara::test {

Surface sheet_of_many(double length, double width, int n) {
    Surface surface;
    for (int row = 0; row <= n; ++row) {
        for (int column = 0; column <= n; ++column) {
            surface.vertices.emplace_back((static_cast<double>(column) / n - 0.5) * length,
                                          (static_cast<double>(row) / n - 0.5) * width, 0.0);
        }
    }
    for (int row = 0; row < n; ++row) {
        for (int column = 0; column < n; ++column) {
            const int first = row * (n + 1) + column;
            const int above = first + n + 1;
            surface.corners.push_back({first, first + 1, above + 1});
            surface.corners.push_back({first, above + 1, above});
        }
    }
    return surface;
}

Surface sheet(double length, double width) {
    return sheet_of_many(length, width, 1);
}

Obstacle obstacle(const Surface& surface, const ObstaclePlace& place, double friction) {
    Obstacle result;
    result.name = "obstacle";
    result.surface = surface;
    result.friction = friction;
    result.keys = {{place, 0.0}};
    return result;
}

Surroundings with_obstacles(const std::vector<Obstacle>& obstacles) {
    Surroundings surroundings;
    surroundings.obstacles = std::make_shared<const ObstacleSet>(obstacles);
    return surroundings;
}

}  // namespace samara::test
