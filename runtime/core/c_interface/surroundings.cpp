#include <cstddef>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "samara.h"
#include "samara/core/c_interface/guard.hpp"
#include "samara/core/c_interface/members.hpp"
#include "samara/core/c_interface/objects.hpp"
#include "samara/core/surface/mended_surface.hpp"
#include "samara/core/surface/surface_check.hpp"

namespace {

using samara::fill;
using samara::guarded;
using samara::known_part;
using samara::require;
using samara::StatusError;

// The size up to the last member of version 6.
constexpr std::size_t first_obstacle_size = offsetof(samara_obstacle, key_count) + sizeof(size_t);
constexpr std::size_t most_triangles = 100'000'000;

samara_obstacle default_obstacle() {
    const samara::Obstacle standard;
    samara_obstacle obstacle{};
    obstacle.size = sizeof obstacle;
    obstacle.friction = standard.friction;
    obstacle.orientation[0] = 1.0;
    return obstacle;
}

samara::Surface read_surface(const samara_obstacle& given) {
    require(given.vertices, "vertices");
    require(given.triangles, "triangles");
    if (given.vertex_count > 3 * most_triangles || given.triangle_count > most_triangles) {
        samara::reject("triangle_count", fmt::format("or vertex_count is beyond {}", most_triangles));
    }
    samara::Surface surface;
    for (std::size_t i = 0; i < given.vertex_count; ++i) {
        surface.vertices.emplace_back(given.vertices + 3 * i);
    }
    for (std::size_t i = 0; i < given.triangle_count; ++i) {
        const std::int32_t* corners = given.triangles + 3 * i;
        surface.corners.push_back({corners[0], corners[1], corners[2]});
    }
    surface = samara::mended(surface);
    samara::require_solid_surface(surface);
    return surface;
}

std::vector<samara::ObstacleKey> read_keys(const samara_obstacle_key* given, std::size_t count) {
    std::vector<samara::ObstacleKey> keys;
    for (std::size_t i = 0; i < count; ++i) {
        samara::ObstacleKey key;
        key.time = samara::finite(given[i].time, "time");
        key.position = samara::vector(given[i].position, "position");
        key.orientation = samara::orientation(given[i].orientation, "orientation");
        keys.push_back(key);
    }
    return keys;
}

/// Returns the running simulation that has this obstacle.
samara::Simulation& simulation_with_obstacle(samara_simulation* simulation, std::size_t obstacle) {
    require(simulation, "simulation");
    samara::Simulation& core = simulation->core;
    core.require_running();
    if (obstacle >= core.obstacle_count()) {
        samara::reject("obstacle", fmt::format("is {}, but there are {}", obstacle, core.obstacle_count()));
    }
    if (core.is_obstacle_removed(obstacle)) samara::reject("obstacle", "is removed; add it again");
    return core;
}

samara::Obstacle read_obstacle(const samara_obstacle& all, std::size_t number) {
    const samara_obstacle given = known_part(all, default_obstacle(), first_obstacle_size, "obstacle");
    samara::Obstacle obstacle;
    obstacle.name =
        given.name == nullptr ? fmt::format("obstacle-{}", number) : samara::plain_name(given.name, "name");
    obstacle.friction = given.friction;
    obstacle.keys.front().position = samara::vector(given.position, "position");
    obstacle.keys.front().orientation = samara::orientation(given.orientation, "orientation");
    if (given.key_count > 0) {
        require(given.keys, "keys");
        obstacle.keys = read_keys(given.keys, given.key_count);
    }
    try {
        obstacle.surface = read_surface(given);
    } catch (const StatusError&) {
        throw;
    } catch (const samara::Error& caught) {
        throw StatusError(SAMARA_INVALID_ARGUMENT, fmt::format("obstacle '{}' is not a valid surface: {}",
                                                               obstacle.name, caught.what()));
    }
    if (const auto broken = samara::broken_rule(obstacle)) {
        samara::reject(broken->member, fmt::format("of obstacle '{}' {}", obstacle.name, broken->what));
    }
    return obstacle;
}

}  // namespace

samara_status samara_default_obstacle(samara_obstacle* obstacle, size_t size, char* error,
                                      size_t error_size) {
    return guarded(error, error_size, [&] { fill(obstacle, size, default_obstacle(), "obstacle"); });
}

samara_status samara_simulation_add_obstacle(samara_simulation* simulation, const samara_obstacle* obstacle,
                                             size_t* index, char* error, size_t error_size) {
    return guarded(error, error_size, [&] {
        require(simulation, "simulation");
        require(obstacle, "obstacle");
        samara::Simulation& core = simulation->core;
        const size_t added = core.add_obstacle(read_obstacle(*obstacle, core.obstacle_count()));
        if (index != nullptr) *index = added;
    });
}

size_t samara_simulation_obstacle_count(const samara_simulation* simulation) {
    return simulation == nullptr ? 0 : simulation->core.obstacle_count();
}

samara_status samara_remove_obstacle(samara_simulation* simulation, size_t obstacle, char* error,
                                     size_t error_size) {
    return guarded(error, error_size,
                   [&] { simulation_with_obstacle(simulation, obstacle).remove_obstacle(obstacle); });
}

samara_status samara_set_obstacle_keys(samara_simulation* simulation, size_t obstacle,
                                       const samara_obstacle_key* keys, size_t count, char* error,
                                       size_t error_size) {
    return guarded(error, error_size, [&] {
        samara::Simulation& core = simulation_with_obstacle(simulation, obstacle);
        require(keys, "keys");
        if (count < 1) samara::reject("count", "is 0; give at least one key");
        const std::vector<samara::ObstacleKey> read = read_keys(keys, count);
        samara::require_rules(samara::broken_rule(read));
        core.set_obstacle_keys(obstacle, read);
    });
}

samara_status samara_set_ground(samara_simulation* simulation, int32_t has_ground, double height, char* error,
                                size_t error_size) {
    return guarded(error, error_size, [&] {
        require(simulation, "simulation");
        simulation->core.require_running();
        std::optional<double> ground;
        if (has_ground != 0) ground = samara::finite(height, "height");
        simulation->core.set_ground(ground);
    });
}
