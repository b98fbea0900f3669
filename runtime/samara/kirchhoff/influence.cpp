#include "samara/kirchhoff/influence.hpp"

#include <cmath>
#include <numbers>

namespace samara {
namespace {

constexpr double full_solid_angle = 4.0 * std::numbers::pi;
constexpr double near_distance = 4.0;  // panel radii

/// atan2(y, x); for the small angles of distant panels by its series, which is several times faster. The
/// series ends where the next term is below 1e-17 of the first.
double angle_of(double y, double x) {
    if (!(std::abs(y) < 0.0625 * x)) return std::atan2(y, x);
    const double t = y / x;
    const double s = t * t;
    return t *
           (1.0 + s * (-1.0 / 3.0 +
                       s * (1.0 / 5.0 + s * (-1.0 / 7.0 + s * (1.0 / 9.0 + s * (-1.0 / 11.0 + s / 13.0))))));
}

}  // namespace

InfluenceRow::InfluenceRow(const Panels& panels)
    : panels_(panels), arms_(panels.vertices.size()), distances_(panels.vertices.size()) {}

void InfluenceRow::move_to(std::size_t index) {
    own_ = index;
    const Vector3d point = panels_.panels[index].centroid;
    for (std::size_t k = 0; k < arms_.size(); ++k) {
        arms_[k] = panels_.vertices[k] - point;
        distances_[k] = std::sqrt(arms_[k].squaredNorm());
    }
}

double InfluenceRow::solid_angle_share(std::size_t j) const {
    if (j == own_) return 0.0;
    const Panel& panel = panels_.panels[j];
    const auto a = static_cast<std::size_t>(panel.corners[0]);
    const auto b = static_cast<std::size_t>(panel.corners[1]);
    const auto c = static_cast<std::size_t>(panel.corners[2]);
    // a . (b x c) of the three arms is the height over the panel times twice its area.
    const double triple = 2.0 * panel.area * arms_[a].dot(panel.normal);
    const double rest = distances_[a] * distances_[b] * distances_[c] +
                        arms_[a].dot(arms_[b]) * distances_[c] + arms_[a].dot(arms_[c]) * distances_[b] +
                        arms_[b].dot(arms_[c]) * distances_[a];
    return 2.0 / full_solid_angle * angle_of(triple, rest);
}

double InfluenceRow::source_potential(std::size_t j, double solid_angle_share) const {
    const Panel& panel = panels_.panels[j];
    const Vector3d arm = panel.centroid - panels_.panels[own_].centroid;
    const double squared = arm.squaredNorm();
    if (squared < near_distance * near_distance * panel.radius * panel.radius) {
        return near_integral(panel, solid_angle_share) / full_solid_angle;
    }
    // 1/r to second order about the centroid: the first moments of the panel vanish there.
    const double inverse = 1.0 / squared;
    const double second =
        1.5 * inverse * arm.dot(panel.second_moment * arm) - 0.5 * panel.second_moment.trace();
    return panel.area * std::sqrt(inverse) * (1.0 + inverse * second) / full_solid_angle;
}

double InfluenceRow::near_integral(const Panel& panel, double solid_angle_share) const {
    double integral = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto from = static_cast<std::size_t>(panel.corners[i]);
        const auto to = static_cast<std::size_t>(panel.corners[(i + 1) % 3]);
        const Vector3d edge = arms_[to] - arms_[from];
        const double length = std::sqrt(edge.squaredNorm());
        const double outward = arms_[from].dot(edge.cross(panel.normal)) / length;
        integral += outward * 2.0 * std::atanh(length / (distances_[from] + distances_[to]));
    }
    const auto first = static_cast<std::size_t>(panel.corners[0]);
    const double height = arms_[first].dot(panel.normal);
    return integral - height * solid_angle_share * full_solid_angle;
}

}  // namespace samara
