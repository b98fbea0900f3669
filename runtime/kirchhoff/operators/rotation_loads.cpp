#include "samara/kirchhoff/operators/rotation_loads.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "samara/core/base/parallel_for.hpp"
#include "samara/kirchhoff/operators/rotation_fields.hpp"

namespace samara {
namespace {

constexpr std::size_t load_rows_a_piece = 32;
constexpr double full_solid_angle = 4.0 * std::numbers::pi;

/// Loads of all triangles on one: row k of `loads` belongs to its corner k.
struct RowLoads {
    Matrix3d loads = Matrix3d::Zero();  // sum of g times the solid angle of v_k, without 1 / (4 pi)
    Eigen::Matrix<double, 3, 6> energies = Eigen::Matrix<double, 3, 6>::Zero();
    double solid_angle = 0.0;  // of all triangles, seen from this one's middle
};

Vector6d motions_at(const Vector3d& place, const Vector3d& normal) {
    Vector6d velocities;
    velocities << place.cross(normal), normal;
    return velocities;
}

void add_field(const FieldAtPoint& field, const FlatTriangle& triangle, const RulePoint& point,
               RowLoads& row) {
    const double area = point.weight * triangle.area;
    const Vector6d motions = motions_at(place_on(triangle, point), triangle.normal);
    const Vector3d flux(field.flux[0], field.flux[1], field.flux[2]);
    const Vector3d potential(field.potential[0], field.potential[1], field.potential[2]);
    for (std::size_t k = 0; k < 3; ++k)
        row.loads.row(eigen_index(k)) += point.corner_shares[k] * area * flux.transpose();
    row.energies += area * potential * motions.transpose();
}

/// Returns the solid angles of some triangles from the middle of one.
double exact_solid_angles(const std::vector<FlatTriangle>& triangles, const std::vector<std::size_t>& seen,
                          std::size_t own) {
    const Vector3d& eye = triangles[own].centroid;
    double sum = 0.0;
    for (const std::size_t j : seen) {
        if (j == own) continue;
        const Vector3d a = triangles[j].corners[0] - eye;
        const Vector3d b = triangles[j].corners[1] - eye;
        const Vector3d c = triangles[j].corners[2] - eye;
        const double ra = a.norm();
        const double rb = b.norm();
        const double rc = c.norm();
        sum +=
            2.0 * std::atan2(a.dot(b.cross(c)), ra * rb * rc + a.dot(b) * rc + a.dot(c) * rb + b.dot(c) * ra);
    }
    return sum;
}

template <std::size_t points>
void add_fields(const std::array<FieldAtPoint, points>& fields, const FlatTriangle& triangle,
                const std::vector<RulePoint>& rule, RowLoads& row) {
    for (std::size_t q = 0; q < points; ++q) {
        add_field(fields[q], triangle, rule[q], row);
    }
}

void add_near(const RotationSourceSets& sources, const std::vector<std::size_t>& near, std::size_t own,
              const FlatTriangle& triangle, RowLoads& row) {
    HatSums sums;
    for (const std::size_t j : near) {
        for (const SourceBatch& batch : sources.near[j]) {
            if (j == own) {
                HatSums own_sums;  // whose solid angles are zero, not what rounding leaves of them
                add_hat_sums(triangle, batch, own_sums);
                sums.potentials += own_sums.potentials;
            } else {
                add_hat_sums(triangle, batch, sums);
            }
        }
    }
    row.loads += sums.solid_angles;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector6d motions = motions_at(triangle.corners[k], triangle.normal);
        row.energies += sums.potentials.row(eigen_index(k)).transpose() * motions.transpose();
    }
}

RowLoads row_loads(const LinearElements& elements, const RotationSourceSets& sources, std::size_t t) {
    const FlatTriangle& triangle = elements.triangles[t];
    const DistantFields fields = distant_fields(sources, triangle);
    RowLoads row;
    add_field(fields.one, triangle, {{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, 1.0}, row);
    add_fields(fields.three, triangle, symmetric_rule(2), row);
    add_fields(fields.six, triangle, symmetric_rule(4), row);
    add_near(sources, fields.near, t, triangle, row);
    row.solid_angle = fields.solid_angle + exact_solid_angles(elements.triangles, fields.exact, t);
    return row;
}

/// Returns <g_a, v_k> on one triangle, a row each corner: g is linear too.
Matrix3d own_loads(const FlatTriangle& triangle) {
    Matrix3d at_corners;
    for (std::size_t k = 0; k < 3; ++k) {
        at_corners.row(eigen_index(k)) = triangle.corners[k].cross(triangle.normal).transpose();
    }
    const Matrix3d mass = triangle.area / 12.0 * (Matrix3d::Identity() + Matrix3d::Ones());
    return mass * at_corners;
}

}  // namespace

RotationLoads rotation_loads(const LinearElements& elements, int threads,
                             const std::function<void(double)>& progress) {
    const RotationSourceSets sources = rotation_sources(elements);
    std::vector<RowLoads> rows(elements.triangle_count());
    parallel_for(
        rows.size(), load_rows_a_piece, threads,
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t t = begin; t < end; ++t) rows[t] = row_loads(elements, sources, t);
        },
        progress);
    RotationLoads result;
    result.loads.setZero(eigen_index(elements.node_count()), 3);
    result.energies.setZero();
    result.closure_error = 0.0;
    for (std::size_t t = 0; t < rows.size(); ++t) {
        const Matrix3d loads = 0.5 * own_loads(elements.triangles[t]) - rows[t].loads / full_solid_angle;
        for (std::size_t k = 0; k < 3; ++k)
            result.loads.row(eigen_index(elements.node(t, k))) += loads.row(eigen_index(k));
        result.energies += rows[t].energies / full_solid_angle;
        const double share = rows[t].solid_angle / full_solid_angle;
        result.closure_error = std::max(result.closure_error, std::abs(share - 0.5));
    }
    return result;
}

}  // namespace samara
