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

inline constexpr std::size_t most_lanes_of_fields =
    16;  // arrays are read this far beyond their last triangle

struct TargetPoint {
    std::array<float, 3> place;  // from the middle of the sources' group
    std::array<float, 3> normal;
};

/// A triangle's own points that the fields of others are summed at.
struct Targets {
    Vector3d middle;
    std::array<Vector3d, 3> three;
    std::array<Vector3d, 6> six;
    Vector3d normal;
    double radius;
};

}  // namespace samara
#endif

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, most_lanes_of_fields>;
using Lanes = hn::Vec<Tag>;

struct LaneSums {
    Lanes potential[3];
    Lanes flux[3];
};

HWY_INLINE LaneSums no_sums() {
    const Lanes zero = hn::Zero(Tag());
    return {{zero, zero, zero}, {zero, zero, zero}};
}

TargetPoint target_from(const Vector3d& middle, const Vector3d& place, const Vector3d& normal) {
    const Eigen::Vector3f from = (place - middle).cast<float>();
    const Eigen::Vector3f across = normal.cast<float>();
    return {{from.x(), from.y(), from.z()}, {across.x(), across.y(), across.z()}};
}

/// Adds the sources from `there` on, as many as there are lanes; `count` says which. Returns their solid
/// angles.
template <class Mask>
HWY_INLINE Lanes add_sources(const RotationSources& sources, std::size_t there, const TargetPoint& target,
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
    const Lanes seen = hn::MulAdd(dx, hn::LoadU(tag, &sources.area_vector[0][there]),
                                  hn::MulAdd(dy, hn::LoadU(tag, &sources.area_vector[1][there]),
                                             hn::Mul(dz, hn::LoadU(tag, &sources.area_vector[2][there]))));
    return hn::Neg(hn::Mul(seen, cubed));
}

HWY_INLINE double sum_of(Lanes lanes) {
    return static_cast<double>(hn::GetLane(hn::SumOfLanes(Tag(), lanes)));
}

HWY_INLINE void add_to(const LaneSums& sums, FieldAtPoint& field) {
    for (std::size_t a = 0; a < 3; ++a) {
        field.potential[a] += sum_of(sums.potential[a]);
        field.flux[a] += sum_of(sums.flux[a]);
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

/// Sums over groups of triangles very far off.
struct DistantSums {
    LaneSums sums;
    Lanes angles;
    std::size_t groups;
};

HWY_INLINE DistantSums no_distant_sums() {
    return {no_sums(), hn::Zero(Tag()), 0};
}

/// Adds the fields of a group of triangles very far off.
HWY_INLINE void add_distant(const RotationSources& sources, const SourceGroup& group, const Targets& targets,
                            DistantSums& distant) {
    const Tag tag;
    const TargetPoint target = target_from(group.middle(), targets.middle, targets.normal);
    for (std::size_t j = group.begin; j < group.end; j += hn::Lanes(tag)) {
        const auto present = hn::FirstN(tag, group.end - j);
        const Lanes angles = add_sources(sources, j, target, present, distant.sums);
        distant.angles = hn::Add(distant.angles, angles);
    }
    ++distant.groups;
}

HWY_INLINE void move_to(DistantSums& distant, DistantFields& fields) {
    add_to(distant.sums, fields.one);
    fields.solid_angle += sum_of(distant.angles);
    distant = no_distant_sums();
}

/// Sums at the points of the rules, over all groups.
struct RuleSums {
    LaneSums three[3];
    LaneSums six[6];
};

template <std::size_t points>
std::array<TargetPoint, points> targets_from(const Vector3d& middle,
                                             const std::array<Vector3d, points>& places,
                                             const Vector3d& normal) {
    std::array<TargetPoint, points> result;
    for (std::size_t q = 0; q < points; ++q) result[q] = target_from(middle, places[q], normal);
    return result;
}

/// Adds the fields of a group of triangles that are not all very far off.
void add_fields(const RotationSourceSets& sources, const SourceGroup& group, const Targets& targets,
                const std::array<float, 3>& distances, RuleSums& sums, DistantFields& fields) {
    const Tag tag;
    const std::size_t lanes = hn::Lanes(tag);
    const Vector3d from = group.middle();
    const TargetPoint middle = target_from(from, targets.middle, targets.normal);
    const std::array<TargetPoint, 3> three = targets_from(from, targets.three, targets.normal);
    const std::array<TargetPoint, 6> six = targets_from(from, targets.six, targets.normal);
    const Lanes radius = hn::Set(tag, static_cast<float>(targets.radius));
    Lanes angles = hn::Zero(tag);
    LaneSums one = no_sums();
    for (std::size_t j = group.begin; j < group.end; j += lanes) {
        const Lanes dx = hn::Sub(hn::LoadU(tag, &sources.one.place[0][j]), hn::Set(tag, middle.place[0]));
        const Lanes dy = hn::Sub(hn::LoadU(tag, &sources.one.place[1][j]), hn::Set(tag, middle.place[1]));
        const Lanes dz = hn::Sub(hn::LoadU(tag, &sources.one.place[2][j]), hn::Set(tag, middle.place[2]));
        const Lanes squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
        const Lanes reach = hn::Add(radius, hn::LoadU(tag, &sources.radius[j]));
        const Lanes reach_squared = hn::Mul(reach, reach);
        const std::size_t count = std::min(lanes, group.end - j);
        const auto present = hn::FirstN(tag, count);
        const auto beyond = [&](std::size_t rule) HWY_ATTR {
            return hn::Gt(squared, hn::Mul(reach_squared, hn::Set(tag, distances[rule] * distances[rule])));
        };
        if (hn::AllTrue(tag, hn::Or(beyond(0), hn::Not(present)))) {
            angles = hn::Add(angles, add_sources(sources.one, j, middle, present, one));
            continue;
        }
        const auto far = hn::And(present, beyond(1));
        if (!hn::AllFalse(tag, far)) {
            add_group(sources.three, j, three, far, sums.three);
            LaneSums unused = no_sums();
            for (std::size_t p = 0; p < 3; ++p) {
                const std::size_t there = p * sources.three.stride + j;
                angles = hn::Add(angles, add_sources(sources.three, there, middle, far, unused));
            }
        }
        const auto nearer = hn::AndNot(far, present);
        if (hn::AllFalse(tag, nearer)) continue;
        const auto six_points = hn::And(nearer, beyond(2));
        if (!hn::AllFalse(tag, six_points)) add_group(sources.six, j, six, six_points, sums.six);
        HWY_ALIGN float marks[most_lanes_of_fields];  // 0: done, 1: six points, 2: near
        const Lanes near_mark = hn::IfThenElse(six_points, hn::Set(tag, 1.0F), hn::Set(tag, 2.0F));
        hn::Store(hn::IfThenElseZero(nearer, near_mark), tag, marks);
        for (std::size_t k = 0; k < count; ++k) {
            if (marks[k] > 0.5F) fields.exact.push_back(j + k);
            if (marks[k] > 1.5F) fields.near.push_back(j + k);
        }
    }
    fields.solid_angle += sum_of(angles);
    add_to(one, fields.one);
}

/// Computes all distant triangles' fields.
void all_fields(const RotationSourceSets& sources, const Targets& targets,
                const std::array<float, 3>& distances, DistantFields& fields) {
    constexpr std::size_t most_distant_groups = 16;  // whose sums single precision carries
    DistantSums distant = no_distant_sums();
    RuleSums sums;
    for (LaneSums& at_point : sums.three) at_point = no_sums();
    for (LaneSums& at_point : sums.six) at_point = no_sums();
    for (const SourceGroup& group : sources.groups) {
        const double gap =
            (group.low - targets.middle).cwiseMax(targets.middle - group.high).cwiseMax(0.0).norm();
        if (gap > static_cast<double>(distances[0]) * (targets.radius + group.radius)) {
            add_distant(sources.one, group, targets, distant);
            if (distant.groups == most_distant_groups) move_to(distant, fields);
        } else {
            add_fields(sources, group, targets, distances, sums, fields);
        }
    }
    move_to(distant, fields);
    for (std::size_t q = 0; q < 3; ++q) add_to(sums.three[q], fields.three[q]);
    for (std::size_t q = 0; q < 6; ++q) add_to(sums.six[q], fields.six[q]);
}

}  // namespace
}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace samara {
namespace {

HWY_EXPORT(all_fields);

// In sums of both radii: beyond the first one point a triangle, beyond the next three, beyond the last six.
constexpr std::array<float, 3> source_distances = {10.0F, 2.0F, 1.2F};

Eigen::Index at(std::size_t index) {
    return static_cast<Eigen::Index>(index);
}

void set_source(RotationSources& sources, std::size_t i, const FlatTriangle& triangle, const Vector3d& middle,
                const Vector3d& place, double area) {
    const Vector3d velocity = place.cross(triangle.normal);
    for (std::size_t c = 0; c < 3; ++c) {
        sources.place[c][i] = static_cast<float>(place[at(c)] - middle[at(c)]);
        sources.strength[c][i] = static_cast<float>(area * velocity[at(c)]);
        sources.area_vector[c][i] = static_cast<float>(area * triangle.normal[at(c)]);
    }
}

RotationSources empty_sources(std::size_t stride, std::size_t points) {
    RotationSources sources;
    sources.stride = stride;
    for (std::size_t c = 0; c < 3; ++c) {
        sources.place[c].assign(points * stride, 1e3F);
        sources.strength[c].assign(points * stride, 0.0F);
        sources.area_vector[c].assign(points * stride, 0.0F);
    }
    return sources;
}

void set_sources(RotationSources& sources, std::size_t t, const FlatTriangle& triangle,
                 const Vector3d& middle, const std::vector<RulePoint>& rule) {
    for (std::size_t p = 0; p < rule.size(); ++p) {
        const Vector3d place = place_on(triangle, rule[p]);
        set_source(sources, p * sources.stride + t, triangle, middle, place, rule[p].weight * triangle.area);
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

template <std::size_t points>
std::array<Vector3d, points> places_on(const FlatTriangle& triangle, const std::vector<RulePoint>& rule) {
    std::array<Vector3d, points> places;
    for (std::size_t q = 0; q < points; ++q) places[q] = place_on(triangle, rule[q]);
    return places;
}

}  // namespace

RotationSourceSets rotation_sources(const LinearElements& elements) {
    const std::vector<FlatTriangle>& triangles = elements.triangles;
    const std::size_t stride = triangles.size() + most_lanes_of_fields;
    RotationSourceSets sets{empty_sources(stride, 1), empty_sources(stride, 3),
                            empty_sources(stride, 6), {},
                            source_groups(elements),  {}};
    sets.radius.assign(stride, 0.0F);
    sets.near.reserve(triangles.size());
    for (const SourceGroup& group : sets.groups) {
        for (std::size_t t = group.begin; t < group.end; ++t) {
            const FlatTriangle& triangle = triangles[t];
            const Vector3d middle = group.middle();
            sets.radius[t] = static_cast<float>(triangle.radius);
            set_source(sets.one, t, triangle, middle, triangle.centroid, triangle.area);
            set_sources(sets.three, t, triangle, middle, symmetric_rule(2));
            set_sources(sets.six, t, triangle, middle, symmetric_rule(4));
        }
    }
    for (const FlatTriangle& triangle : triangles) sets.near.push_back(near_sources(triangle));
    return sets;
}

DistantFields distant_fields(const RotationSourceSets& sources, const FlatTriangle& triangle) {
    const Targets targets{triangle.centroid, places_on<3>(triangle, symmetric_rule(2)),
                          places_on<6>(triangle, symmetric_rule(4)), triangle.normal, triangle.radius};
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
