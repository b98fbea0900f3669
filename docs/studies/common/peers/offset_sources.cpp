#include "peers/offset_sources.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace samara::peers {
namespace {

/// The solid angle under which the triangle is seen from the point, positive from behind its outer side. van
/// Oosterom and Strackee, IEEE Trans. Biomed. Eng. BME-30(2), 1983, equation 8.
double solid_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

Matrix6d offset_source_tensor(const Surface& surface, double offset) {
    const auto count = static_cast<Eigen::Index>(surface.triangle_count());
    std::vector<Vector3d> centroids;
    std::vector<Vector3d> sources;
    Eigen::Matrix<double, Eigen::Dynamic, 6> fluxes(count, 6);
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const Vector3d area = area_vector(surface, t);
        const Vector3d centroid = triangle_centroid(surface, t);
        centroids.push_back(centroid);
        sources.emplace_back(centroid - offset * std::sqrt(area.norm()) * area.normalized());
        fluxes.row(static_cast<Eigen::Index>(t)) << centroid.cross(area).transpose(), area.transpose();
    }
    Eigen::MatrixXd flux_of_source(count, count);
    Eigen::MatrixXd potential_of_source(count, count);
    for (Eigen::Index j = 0; j < count; ++j) {
        const Vector3d& source = sources[static_cast<std::size_t>(j)];
        for (Eigen::Index i = 0; i < count; ++i) {
            const auto t = static_cast<std::size_t>(i);
            const auto corner = [&](std::size_t k) -> Vector3d {
                return surface.vertices[static_cast<std::size_t>(surface.corners[t][k])] - source;
            };
            flux_of_source(i, j) = solid_angle(corner(0), corner(1), corner(2)) / (4.0 * std::numbers::pi);
            potential_of_source(i, j) = -1.0 / (4.0 * std::numbers::pi * (centroids[t] - source).norm());
        }
    }
    const Eigen::Matrix<double, Eigen::Dynamic, 6> strengths = flux_of_source.partialPivLu().solve(fluxes);
    return -fluxes.transpose() * (potential_of_source * strengths);
}

}  // namespace samara::peers
