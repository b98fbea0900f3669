#include "samara/kirchhoff/operators/rotation_fields.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "samara/kirchhoff/operators/rotation_fields.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

#include "samara/kirchhoff/panels/inverse_root-inl.h"

#ifndef SAMARA_ROTATION_FIELDS_TARGETS
#define SAMARA_ROTATION_FIELDS_TARGETS
namespace samara {

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
    const Lanes inverse = hn::IfThenElseZero(count, inverse_root<1>(tag, squared));
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

/// Returns the solid angles of the sources from `there` on, of those marked.
template <class Mask>
HWY_INLINE Lanes solid_angles(const RotationSources& sources, std::size_t there, const TargetPoint& eye,
                              Mask marked) {
    const Tag tag;
    const Lanes dx = hn::Sub(hn::LoadU(tag, &sources.place[0][there]), hn::Set(tag, eye.place[0]));
    const Lanes dy = hn::Sub(hn::LoadU(tag, &sources.place[1][there]), hn::Set(tag, eye.place[1]));
    const Lanes dz = hn::Sub(hn::LoadU(tag, &sources.place[2][there]), hn::Set(tag, eye.place[2]));
    const Lanes squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
    const Lanes inverse = hn::IfThenElseZero(marked, inverse_root<1>(tag, squared));
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

/// Adds the fields of a group of triangles very far off, in single precision: its rounding is far below the
/// error of one point a triangle.
HWY_INLINE void add_distant(const DistantSources& sources, std::size_t begin, std::size_t end,
                            const TargetPoint& target, FieldAtPoint& field, double& angle) {
    const hn::ScalableTag<float> tag;
    using Floats = hn::Vec<decltype(tag)>;
    const auto set = [&](double value) HWY_ATTR { return hn::Set(tag, static_cast<float>(value)); };
    const Floats x = set(target.place[0]);
    const Floats y = set(target.place[1]);
    const Floats z = set(target.place[2]);
    const Floats nx = set(target.normal[0]);
    const Floats ny = set(target.normal[1]);
    const Floats nz = set(target.normal[2]);
    const Floats zero = hn::Zero(tag);
    Floats potential[3] = {zero, zero, zero};
    Floats flux[3] = {zero, zero, zero};
    Floats angles = zero;
    for (std::size_t j = begin; j < end; j += hn::Lanes(tag)) {
        const auto present = hn::FirstN(tag, end - j);
        const Floats dx = hn::Sub(x, hn::LoadU(tag, &sources.place[0][j]));
        const Floats dy = hn::Sub(y, hn::LoadU(tag, &sources.place[1][j]));
        const Floats dz = hn::Sub(z, hn::LoadU(tag, &sources.place[2][j]));
        const Floats squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
        const Floats guess = hn::ApproximateReciprocalSqrt(squared);
        const Floats half = hn::Mul(hn::Set(tag, 0.5F), squared);
        const Floats root = hn::Mul(guess, hn::NegMulAdd(half, hn::Mul(guess, guess), hn::Set(tag, 1.5F)));
        const Floats inverse = hn::IfThenElseZero(present, root);
        const Floats cubed = hn::Mul(inverse, hn::Mul(inverse, inverse));
        const Floats factor = hn::Mul(cubed, hn::MulAdd(dx, nx, hn::MulAdd(dy, ny, hn::Mul(dz, nz))));
        for (std::size_t a = 0; a < 3; ++a) {
            const Floats strength = hn::LoadU(tag, &sources.strength[a][j]);
            potential[a] = hn::MulAdd(strength, inverse, potential[a]);
            flux[a] = hn::MulAdd(strength, factor, flux[a]);
        }
        const Floats seen = hn::MulAdd(dx, hn::LoadU(tag, &sources.area_vector[0][j]),
                                       hn::MulAdd(dy, hn::LoadU(tag, &sources.area_vector[1][j]),
                                                  hn::Mul(dz, hn::LoadU(tag, &sources.area_vector[2][j]))));
        angles = hn::NegMulAdd(seen, cubed, angles);
    }
    const auto sum = [&](Floats values)
                         HWY_ATTR { return static_cast<double>(hn::GetLane(hn::SumOfLanes(tag, values))); };
    for (std::size_t a = 0; a < 3; ++a) {
        field.potential[a] += sum(potential[a]);
        field.flux[a] += sum(flux[a]);
    }
    angle += sum(angles);
}

/// Adds the fields of triangles from `begin` to `end` that are not all very far off.
void add_fields(const RotationSourceSets& sources, std::size_t begin, std::size_t end, const Targets& targets,
                const std::array<double, 3>& distances, DistantFields& fields) {
    const Tag tag;
    const std::size_t lanes = hn::Lanes(tag);
    Lanes angles = hn::Zero(tag);
    LaneSums one = no_sums();
    LaneSums three[3] = {no_sums(), no_sums(), no_sums()};
    LaneSums six[6] = {no_sums(), no_sums(), no_sums(), no_sums(), no_sums(), no_sums()};
    for (std::size_t j = begin; j < end; j += lanes) {
        const TargetPoint& middle = targets.one;
        const Lanes dx = hn::Sub(hn::LoadU(tag, &sources.one.place[0][j]), hn::Set(tag, middle.place[0]));
        const Lanes dy = hn::Sub(hn::LoadU(tag, &sources.one.place[1][j]), hn::Set(tag, middle.place[1]));
        const Lanes dz = hn::Sub(hn::LoadU(tag, &sources.one.place[2][j]), hn::Set(tag, middle.place[2]));
        const Lanes squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
        const Lanes reach = hn::Add(hn::Set(tag, targets.radius), hn::LoadU(tag, &sources.radius[j]));
        const Lanes reach_squared = hn::Mul(reach, reach);
        const auto present = hn::FirstN(tag, std::min(lanes, end - j));
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
            if (marks[k] > 0.5) fields.exact.push_back(j + k);
            if (marks[k] > 1.5) fields.near.push_back(j + k);
        }
    }
    fields.solid_angle += hn::GetLane(hn::SumOfLanes(tag, angles));
    add_to(one, fields.one);
    for (std::size_t q = 0; q < 3; ++q) add_to(three[q], fields.three[q]);
    for (std::size_t q = 0; q < 6; ++q) add_to(six[q], fields.six[q]);
}

/// Computes all distant triangles' fields.
void all_fields(const RotationSourceSets& sources, const Targets& targets,
                const std::array<double, 3>& distances, DistantFields& fields) {
    const Vector3d middle(targets.one.place[0], targets.one.place[1], targets.one.place[2]);
    for (const SourceGroup& group : sources.groups) {
        const double gap = (group.low - middle).cwiseMax(middle - group.high).cwiseMax(0.0).norm();
        if (gap > distances[0] * (targets.radius + group.radius)) {
            add_distant(sources.distant, group.begin, group.end, targets.one, fields.one, fields.solid_angle);
        } else {
            add_fields(sources, group.begin, group.end, targets, distances, fields);
        }
    }
}

}  // namespace
}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace samara {
namespace {

HWY_EXPORT(all_fields);

// In sums of both radii: beyond the first one point a triangle, beyond the next three, beyond the last six.
constexpr std::array<double, 3> source_distances = {10.0, 2.0, 1.2};
// The widest vector register: arrays are read this far beyond their last triangle.
constexpr std::size_t padding = 64;

Eigen::Index at(std::size_t index) {
    return static_cast<Eigen::Index>(index);
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
    const std::vector<RulePoint>& rule = symmetric_rule(8);
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

DistantSources distant_sources(const RotationSources& sources) {
    DistantSources result;
    const auto single = [](const std::vector<double>& values) {
        return std::vector<float>(values.begin(), values.end());
    };
    for (std::size_t c = 0; c < 3; ++c) {
        result.place[c] = single(sources.place[c]);
        result.strength[c] = single(sources.strength[c]);
        result.area_vector[c] = single(sources.area_vector[c]);
    }
    return result;
}

std::vector<SourceGroup> source_groups(const LinearElements& elements) {
    std::vector<SourceGroup> groups;
    for (const Cluster& cluster : elements.tree.clusters) {
        if (!cluster.is_leaf()) continue;
        groups.push_back({cluster.begin, cluster.end, cluster.low, cluster.high, 0.0});
        for (std::size_t t = cluster.begin; t < cluster.end; ++t) {
            groups.back().radius = std::max(groups.back().radius, elements.triangles[t].radius);
        }
    }
    return groups;
}

TargetPoint target(const Vector3d& place, const Vector3d& normal) {
    return {{place.x(), place.y(), place.z()}, {normal.x(), normal.y(), normal.z()}};
}

template <std::size_t points>
std::array<TargetPoint, points> targets_on(const FlatTriangle& triangle, const std::vector<RulePoint>& rule) {
    std::array<TargetPoint, points> targets;
    for (std::size_t q = 0; q < points; ++q) {
        targets[q] = target(place_on(triangle, rule[q]), triangle.normal);
    }
    return targets;
}

}  // namespace

RotationSourceSets rotation_sources(const LinearElements& elements) {
    const std::vector<FlatTriangle>& triangles = elements.triangles;
    const std::size_t stride = triangles.size() + padding;
    RotationSourceSets sets{{},
                            empty_sources(stride, 1),
                            empty_sources(stride, 3),
                            empty_sources(stride, 6),
                            {},
                            source_groups(elements),
                            {}};
    sets.radius.assign(stride, 0.0);
    sets.near.reserve(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const FlatTriangle& triangle = triangles[t];
        sets.radius[t] = triangle.radius;
        set_source(sets.one, t, triangle, triangle.centroid, triangle.area);
        set_sources(sets.three, t, triangle, symmetric_rule(2));
        set_sources(sets.six, t, triangle, symmetric_rule(4));
        sets.near.push_back(near_sources(triangle));
    }
    sets.distant = distant_sources(sets.one);
    return sets;
}

DistantFields distant_fields(const RotationSourceSets& sources, const FlatTriangle& triangle) {
    const Targets targets{target(triangle.centroid, triangle.normal),
                          targets_on<3>(triangle, symmetric_rule(2)),
                          targets_on<6>(triangle, symmetric_rule(4)), triangle.radius};
    DistantFields fields;
    HWY_DYNAMIC_DISPATCH(all_fields)(sources, targets, source_distances, fields);
    return fields;
}

Vector3d place_on(const FlatTriangle& triangle, const RulePoint& point) {
    return point.corner_shares[0] * triangle.corners[0] + point.corner_shares[1] * triangle.corners[1] +
           point.corner_shares[2] * triangle.corners[2];
}

}  // namespace samara
#endif
