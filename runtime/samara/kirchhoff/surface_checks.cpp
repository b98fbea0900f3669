#include "samara/kirchhoff/surface_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace samara {
namespace {

using Triangle = std::array<std::int32_t, 3>;

/// The triangles with vertices at the same place made one.
std::vector<Triangle> welded(const Surface& surface) {
    std::map<std::array<double, 3>, std::int32_t> places;
    std::vector<std::int32_t> welded_index;
    for (const Vector3d& vertex : surface.vertices) {
        const auto index = static_cast<std::int32_t>(places.size());
        welded_index.push_back(places.try_emplace({vertex.x(), vertex.y(), vertex.z()}, index).first->second);
    }
    std::vector<Triangle> triangles = surface.corners;
    for (Triangle& triangle : triangles) {
        for (std::int32_t& corner : triangle) corner = welded_index[static_cast<std::size_t>(corner)];
    }
    return triangles;
}

std::size_t count_repeated(const std::vector<Triangle>& triangles) {
    std::set<Triangle> seen;
    std::size_t repeated = 0;
    for (Triangle triangle : triangles) {
        std::sort(triangle.begin(), triangle.end());
        if (!seen.insert(triangle).second) ++repeated;
    }
    return repeated;
}

}  // namespace

double signed_volume(const Surface& surface) {
    double volume = 0.0;
    const Vector3d origin = surface.vertices.empty() ? Vector3d::Zero() : surface.vertices.front();
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        volume += (triangle_centroid(surface, t) - origin).dot(area_vector(surface, t)) / 3.0;
    }
    return volume;
}

std::string edge_fault(const Surface& surface) {
    const std::vector<Triangle> triangles = welded(surface);
    if (const std::size_t repeated = count_repeated(triangles); repeated > 0) {
        return fmt::format("{} triangle{} there twice", repeated, repeated == 1 ? " is" : "s are");
    }
    std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
    for (const Triangle& triangle : triangles) {
        for (std::size_t i = 0; i < 3; ++i) ++uses[{triangle[i], triangle[(i + 1) % 3]}];
    }
    std::size_t open = 0;
    std::size_t flipped = 0;
    for (const auto& [edge, count] : uses) {
        const auto opposite = uses.find({edge.second, edge.first});
        if (count > 1) {
            ++flipped;
        } else if (opposite == uses.end()) {
            ++open;
        }
    }
    if (flipped > 0) return fmt::format("{} edges have triangles that face opposite ways", flipped);
    if (open > 0) return fmt::format("it has a hole: {} edges belong to one triangle alone", open);
    return {};
}

bool has_creases(const Surface& surface, double angle) {
    const std::vector<Triangle> triangles = welded(surface);
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> owners;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) owners[{triangles[t][i], triangles[t][(i + 1) % 3]}] = t;
    }
    const double least_cosine = std::cos(angle);
    return std::any_of(owners.begin(), owners.end(), [&](const auto& owner) {
        const auto opposite = owners.find({owner.first.second, owner.first.first});
        if (opposite == owners.end()) return false;
        const Vector3d here = area_vector(surface, owner.second).normalized();
        return here.dot(area_vector(surface, opposite->second).normalized()) < least_cosine;
    });
}

}  // namespace samara
