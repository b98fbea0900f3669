#include "samara/kirchhoff/rotation_loads.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "samara/base/parallel_for.hpp"
#include "samara/kirchhoff/flat_triangle_integrals.hpp"
#include "samara/kirchhoff/triangle_rules.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "samara/kirchhoff/rotation_loads.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

#include "samara/kirchhoff/inverse_root-inl.h"

#ifndef SAMARA_ROTATION_LOADS_TYPES
#define SAMARA_ROTATION_LOADS_TYPES
namespace samara {

/// Point sources, coordinate by coordinate: the three rotations' strengths and an area vector each.
struct RotationSources {
    std::size_t stride = 0;  ///< from one point of a triangle to the next
    std::array<std::vector<double>, 3> place;
    std::array<std::vector<double>, 3> strength;
    std::array<std::vector<double>, 3> area_vector;
};

/// Sources in one, three or six points a triangle, and batches for the near ones.
struct RotationSourceSets {
    RotationSources one;
    RotationSources three;
    RotationSources six;
    std::vector<double> radius;
    std::vector<std::array<SourceBatch, 2>> near;
};

/// Sums over sources at one point.
struct FieldAtPoint {
    std::array<double, 3> potential{};  ///< of the strengths: sum of g / r
    std::array<double, 3> flux{};       ///< sum of g n . (y - x) / r^3, y and n this point's
};

struct TargetPoint {
    std::array<double, 3> place;
    std::array<double, 3> normal;
};

/// A triangle's own points that the fields of others are summed at.
struct Targets {
    TargetPoint one;
    std::array<TargetPoint, 3> three;
    std::array<TargetPoint, 6> six;
    double radius;
};

struct Fields {
    double solid_angle =
        0.0;  ///< sum of area vector . (x - y) / r^3 over the distant sources x, y the middle
    FieldAtPoint one;
    std::array<FieldAtPoint, 3> three;
    std::array<FieldAtPoint, 6> six;
};

}  // namespace samara
#endif

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 8>;
using Lanes = hn::Vec<Tag>;

struct LaneSums {
    Lanes potential[3];
    Lanes flux[3];
};

HWY_INLINE LaneSums no_sums() {
    const Lanes zero = hn::Zero(Tag());
    return {{zero, zero, zero}, {zero, zero, zero}};
}

/// Adds the sources from `there` on, as many as there are lanes; `count` says which.
template <class Mask>
HWY_INLINE void add_sources(const RotationSources& sources, std::size_t there, const TargetPoint& target,
                            Mask count, LaneSums& sums) {
    const Tag tag;
    const Lanes dx = hn::Sub(hn::Set(tag, target.place[0]), hn::LoadU(tag, &sources.place[0][there]));
    const Lanes dy = hn::Sub(hn::Set(tag, target.place[1]), hn::LoadU(tag, &sources.place[1][there]));
    const Lanes dz = hn::Sub(hn::Set(tag, target.place[2]), hn::LoadU(tag, &sources.place[2][there]));
    const Lanes squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
    const Lanes inverse = hn::IfThenElseZero(count, inverse_root(tag, squared));
    const Lanes cubed = hn::Mul(inverse, hn::Mul(inverse, inverse));
    const Lanes along = hn::MulAdd(
        dx, hn::Set(tag, target.normal[0]),
        hn::MulAdd(dy, hn::Set(tag, target.normal[1]), hn::Mul(dz, hn::Set(tag, target.normal[2]))));
    const Lanes factor = hn::Mul(along, cubed);
    for (std::size_t a = 0; a < 3; ++a) {
        const Lanes strength = hn::LoadU(tag, &sources.strength[a][there]);
        sums.potential[a] = hn::MulAdd(strength, inverse, sums.potential[a]);
        sums.flux[a] = hn::MulAdd(strength, factor, sums.flux[a]);
    }
}

/// The solid angles of the sources from `there` on, of those marked.
template <class Mask>
HWY_INLINE Lanes solid_angles(const RotationSources& sources, std::size_t there, const TargetPoint& eye,
                              Mask marked) {
    const Tag tag;
    const Lanes dx = hn::Sub(hn::LoadU(tag, &sources.place[0][there]), hn::Set(tag, eye.place[0]));
    const Lanes dy = hn::Sub(hn::LoadU(tag, &sources.place[1][there]), hn::Set(tag, eye.place[1]));
    const Lanes dz = hn::Sub(hn::LoadU(tag, &sources.place[2][there]), hn::Set(tag, eye.place[2]));
    const Lanes squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
    const Lanes inverse = hn::IfThenElseZero(marked, inverse_root(tag, squared));
    const Lanes along = hn::MulAdd(dx, hn::LoadU(tag, &sources.area_vector[0][there]),
                                   hn::MulAdd(dy, hn::LoadU(tag, &sources.area_vector[1][there]),
                                              hn::Mul(dz, hn::LoadU(tag, &sources.area_vector[2][there]))));
    return hn::Mul(along, hn::Mul(inverse, hn::Mul(inverse, inverse)));
}

HWY_INLINE void add_to(const LaneSums& sums, FieldAtPoint& field) {
    const Tag tag;
    for (std::size_t a = 0; a < 3; ++a) {
        field.potential[a] += hn::GetLane(hn::SumOfLanes(tag, sums.potential[a]));
        field.flux[a] += hn::GetLane(hn::SumOfLanes(tag, sums.flux[a]));
    }
}

/// Adds the sources of one group of triangles, those marked, at all points of a rule.
template <std::size_t points, class Mask>
HWY_INLINE void add_group(const RotationSources& sources, std::size_t group,
                          const std::array<TargetPoint, points>& targets, Mask marked, LaneSums* sums) {
    for (std::size_t q = 0; q < points; ++q) {
        for (std::size_t p = 0; p < points; ++p) {
            add_sources(sources, p * sources.stride + group, targets[q], marked, sums[q]);
        }
    }
}

/// The fields of all distant triangles at a triangle's points, one point for those very far off, three or six
/// for the others; the list of those whose solid angle is left to do, and that of those too near for points.
void far_fields(const RotationSourceSets& sources, const Targets& targets,
                const std::array<double, 3>& distances, std::size_t count, Fields& fields,
                std::vector<std::size_t>& exact, std::vector<std::size_t>& near) {
    const Tag tag;
    const std::size_t lanes = hn::Lanes(tag);
    Lanes angles = hn::Zero(tag);
    LaneSums one = no_sums();
    LaneSums three[3] = {no_sums(), no_sums(), no_sums()};
    LaneSums six[6] = {no_sums(), no_sums(), no_sums(), no_sums(), no_sums(), no_sums()};
    for (std::size_t j = 0; j < count; j += lanes) {
        const TargetPoint& middle = targets.one;
        const Lanes dx = hn::Sub(hn::LoadU(tag, &sources.one.place[0][j]), hn::Set(tag, middle.place[0]));
        const Lanes dy = hn::Sub(hn::LoadU(tag, &sources.one.place[1][j]), hn::Set(tag, middle.place[1]));
        const Lanes dz = hn::Sub(hn::LoadU(tag, &sources.one.place[2][j]), hn::Set(tag, middle.place[2]));
        const Lanes squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
        const Lanes reach = hn::Add(hn::Set(tag, targets.radius), hn::LoadU(tag, &sources.radius[j]));
        const Lanes reach_squared = hn::Mul(reach, reach);
        const auto present = hn::FirstN(tag, std::min(lanes, count - j));
        const auto beyond = [&](std::size_t rule) HWY_ATTR {
            return hn::Gt(squared, hn::Mul(reach_squared, hn::Set(tag, distances[rule] * distances[rule])));
        };
        if (hn::AllTrue(tag, hn::Or(beyond(0), hn::Not(present)))) {
            add_sources(sources.one, j, middle, present, one);
            angles = hn::Add(angles, solid_angles(sources.one, j, middle, present));
            continue;
        }
        const auto far = hn::And(present, beyond(1));
        if (!hn::AllFalse(tag, far)) {
            add_group(sources.three, j, targets.three, far, three);
            for (std::size_t p = 0; p < 3; ++p) {
                angles =
                    hn::Add(angles, solid_angles(sources.three, p * sources.three.stride + j, middle, far));
            }
        }
        const auto nearer = hn::AndNot(far, present);
        if (hn::AllFalse(tag, nearer)) continue;
        const auto six_points = hn::And(nearer, beyond(2));
        if (!hn::AllFalse(tag, six_points)) add_group(sources.six, j, targets.six, six_points, six);
        HWY_ALIGN double marks[8];  // 0: done, 1: six points, 2: near
        const Lanes near_mark = hn::IfThenElse(six_points, hn::Set(tag, 1.0), hn::Set(tag, 2.0));
        hn::Store(hn::IfThenElseZero(nearer, near_mark), tag, marks);
        for (std::size_t k = 0; k < lanes; ++k) {
            if (marks[k] > 0.5) exact.push_back(j + k);
            if (marks[k] > 1.5) near.push_back(j + k);
        }
    }
    fields.solid_angle = hn::GetLane(hn::SumOfLanes(tag, angles));
    add_to(one, fields.one);
    for (std::size_t q = 0; q < 3; ++q) add_to(three[q], fields.three[q]);
    for (std::size_t q = 0; q < 6; ++q) add_to(six[q], fields.six[q]);
}

}  // namespace
}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace samara {
namespace {

HWY_EXPORT(far_fields);

// In sums of both radii: beyond the first one point a triangle, beyond the next three, beyond the last six.
constexpr std::array<double, 3> source_distances = {15.0, 3.0, 1.2};
constexpr std::size_t padding = 8;
constexpr std::size_t rows_a_piece = 32;
constexpr double full_solid_angle = 4.0 * std::numbers::pi;

Eigen::Index at(std::size_t index) {
    return static_cast<Eigen::Index>(index);
}

Vector3d place_on(const FlatTriangle& triangle, const RulePoint& point) {
    return point.corner_shares[0] * triangle.corners[0] + point.corner_shares[1] * triangle.corners[1] +
           point.corner_shares[2] * triangle.corners[2];
}

void set_source(RotationSources& sources, std::size_t i, const FlatTriangle& triangle, const Vector3d& place,
                double area) {
    const Vector3d velocity = place.cross(triangle.normal);
    for (std::size_t c = 0; c < 3; ++c) {
        sources.place[c][i] = place[at(c)];
        sources.strength[c][i] = area * velocity[at(c)];
        sources.area_vector[c][i] = area * triangle.normal[at(c)];
    }
}

RotationSources empty_sources(std::size_t stride, std::size_t points) {
    RotationSources sources;
    sources.stride = stride;
    for (std::size_t c = 0; c < 3; ++c) {
        sources.place[c].assign(points * stride, 1e3);
        sources.strength[c].assign(points * stride, 0.0);
        sources.area_vector[c].assign(points * stride, 0.0);
    }
    return sources;
}

void set_sources(RotationSources& sources, std::size_t t, const FlatTriangle& triangle,
                 const std::vector<RulePoint>& rule) {
    for (std::size_t p = 0; p < rule.size(); ++p) {
        const Vector3d place = place_on(triangle, rule[p]);
        set_source(sources, p * sources.stride + t, triangle, place, rule[p].weight * triangle.area);
    }
}

std::array<SourceBatch, 2> near_sources(const FlatTriangle& triangle) {
    const std::vector<RulePoint>& rule = triangle_rule_16();
    std::array<SourceBatch, 2> batches;
    for (std::size_t i = 0; i < rule.size(); ++i) {
        SourceBatch& batch = batches[i / point_batch];
        const Vector3d place = place_on(triangle, rule[i]);
        const Vector3d strength = rule[i].weight * triangle.area * place.cross(triangle.normal);
        batch.points.set(i % point_batch, place);
        for (std::size_t a = 0; a < 3; ++a) batch.strengths[a].values[i % point_batch] = strength[at(a)];
    }
    return batches;
}

RotationSourceSets make_sources(const std::vector<FlatTriangle>& triangles) {
    const std::size_t stride = triangles.size() + padding;
    RotationSourceSets sets{
        empty_sources(stride, 1), empty_sources(stride, 3), empty_sources(stride, 6), {}, {}};
    sets.radius.assign(stride, 0.0);
    sets.near.reserve(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const FlatTriangle& triangle = triangles[t];
        sets.radius[t] = triangle.radius;
        set_source(sets.one, t, triangle, triangle.centroid, triangle.area);
        set_sources(sets.three, t, triangle, triangle_rule_3());
        set_sources(sets.six, t, triangle, triangle_rule_6());
        sets.near.push_back(near_sources(triangle));
    }
    return sets;
}

TargetPoint target(const Vector3d& place, const Vector3d& normal) {
    return {{place.x(), place.y(), place.z()}, {normal.x(), normal.y(), normal.z()}};
}

/// What all triangles exert on one: row k of `loads` belongs to its corner k.
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
        row.loads.row(at(k)) += point.corner_shares[k] * area * flux.transpose();
    row.energies += area * potential * motions.transpose();
}

/// The solid angles of some triangles from the middle of one.
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
std::array<TargetPoint, points> targets_on(const FlatTriangle& triangle, const std::vector<RulePoint>& rule) {
    std::array<TargetPoint, points> targets;
    for (std::size_t q = 0; q < points; ++q) {
        targets[q] = target(place_on(triangle, rule[q]), triangle.normal);
    }
    return targets;
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
        row.energies += sums.potentials.row(at(k)).transpose() * motions.transpose();
    }
}

RowLoads row_loads(const LinearElements& elements, const RotationSourceSets& sources, std::size_t t) {
    const FlatTriangle& triangle = elements.triangles[t];
    const Targets targets{target(triangle.centroid, triangle.normal),
                          targets_on<3>(triangle, triangle_rule_3()),
                          targets_on<6>(triangle, triangle_rule_6()), triangle.radius};
    Fields fields;
    std::vector<std::size_t> exact;
    std::vector<std::size_t> near;
    HWY_DYNAMIC_DISPATCH(far_fields)
    (sources, targets, source_distances, elements.triangle_count(), fields, exact, near);
    RowLoads row;
    add_field(fields.one, triangle, {{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, 1.0}, row);
    row.solid_angle = fields.solid_angle + exact_solid_angles(elements.triangles, exact, t);
    add_fields(fields.three, triangle, triangle_rule_3(), row);
    add_fields(fields.six, triangle, triangle_rule_6(), row);
    add_near(sources, near, t, triangle, row);
    return row;
}

/// <g_a, v_k> on one triangle, a row each corner: g is linear too.
Matrix3d own_loads(const FlatTriangle& triangle) {
    Matrix3d at_corners;
    for (std::size_t k = 0; k < 3; ++k) {
        at_corners.row(at(k)) = triangle.corners[k].cross(triangle.normal).transpose();
    }
    const Matrix3d mass = triangle.area / 12.0 * (Matrix3d::Identity() + Matrix3d::Ones());
    return mass * at_corners;
}

}  // namespace

RotationLoads rotation_loads(const LinearElements& elements, int threads,
                             const std::function<void(double)>& progress) {
    const RotationSourceSets sources = make_sources(elements.triangles);
    std::vector<RowLoads> rows(elements.triangle_count());
    parallel_for(
        rows.size(), rows_a_piece, threads,
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t t = begin; t < end; ++t) rows[t] = row_loads(elements, sources, t);
        },
        progress);
    RotationLoads result;
    result.loads.setZero(at(elements.node_count()), 3);
    result.energies.setZero();
    result.closure_fault = 0.0;
    for (std::size_t t = 0; t < rows.size(); ++t) {
        const Matrix3d loads = 0.5 * own_loads(elements.triangles[t]) - rows[t].loads / full_solid_angle;
        for (std::size_t k = 0; k < 3; ++k) result.loads.row(at(elements.node(t, k))) += loads.row(at(k));
        result.energies += rows[t].energies / full_solid_angle;
        const double share = rows[t].solid_angle / full_solid_angle;
        result.closure_fault = std::max(result.closure_fault, std::abs(share - 0.5));
    }
    return result;
}

}  // namespace samara
#endif
