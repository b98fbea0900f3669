#include "samara/kirchhoff/panels/single_layer_entries.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "samara/kirchhoff/panels/flat_triangle_integrals.hpp"
#include "samara/kirchhoff/panels/triangle_rules.hpp"

#ifndef SAMARA_SINGLE_LAYER_ENTRIES_LANES
#define SAMARA_SINGLE_LAYER_ENTRIES_LANES
namespace samara {
inline constexpr std::size_t most_lanes_of_entries =
    16;  // arrays are read this far beyond their last triangle
}
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "samara/kirchhoff/panels/single_layer_entries.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

#include "samara/kirchhoff/panels/inverse_root-inl.h"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, most_lanes_of_entries>;
using Lanes = hn::Vec<Tag>;

/// Returns the differences of as many numbers as there are lanes from one, which round only once.
HWY_INLINE Lanes differences(const double* values, double from) {
    const Tag tag;
    HWY_ALIGN float single[most_lanes_of_entries];
    for (std::size_t k = 0; k < hn::Lanes(tag); ++k) single[k] = static_cast<float>(values[k] - from);
    return hn::Load(tag, single);
}

/// Sums of 1/r between the points of one triangle and those of as many others as there are lanes, whose
/// centroids are at (x, y, z) from that one's.
HWY_INLINE Lanes product_rule(const SingleLayerEntries::Arrays& arrays,
                              const SingleLayerEntries::RulePoints& rule, std::size_t row, std::size_t column,
                              Lanes x, Lanes y, Lanes z) {
    const Tag tag;
    Lanes sum = hn::Zero(tag);
    const std::size_t count = rule.weights.size();
    for (std::size_t q = 0; q < count; ++q) {
        const std::size_t there = q * arrays.stride + column;
        const Lanes to_x = hn::Add(x, hn::LoadU(tag, &rule.coordinates[0][there]));
        const Lanes to_y = hn::Add(y, hn::LoadU(tag, &rule.coordinates[1][there]));
        const Lanes to_z = hn::Add(z, hn::LoadU(tag, &rule.coordinates[2][there]));
        Lanes inner = hn::Zero(tag);
        for (std::size_t p = 0; p < count; ++p) {
            const std::size_t here = p * arrays.stride + row;
            const Lanes dx = hn::Sub(to_x, hn::Set(tag, rule.coordinates[0][here]));
            const Lanes dy = hn::Sub(to_y, hn::Set(tag, rule.coordinates[1][here]));
            const Lanes dz = hn::Sub(to_z, hn::Set(tag, rule.coordinates[2][here]));
            const Lanes squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
            inner = hn::MulAdd(hn::Set(tag, rule.weights[p]), inverse_root(tag, squared), inner);
        }
        sum = hn::MulAdd(hn::Set(tag, rule.weights[q]), inner, sum);
    }
    return sum;
}

/// Fills values with V(row, begin...), and marks in `near` where a pair is too near for the rules.
void fill_far_lanes(const SingleLayerEntries::Arrays& arrays, const std::array<float, 3>& distances,
                    std::size_t row, std::size_t begin, std::size_t end, double* values,
                    std::vector<std::size_t>& near) {
    const Tag tag;
    const std::size_t lanes = hn::Lanes(tag);
    const Lanes radius = hn::Set(tag, arrays.radius[row]);
    const Lanes scale = hn::Set(tag, arrays.area[row] / static_cast<float>(4.0 * std::numbers::pi));
    HWY_ALIGN float buffer[most_lanes_of_entries] = {};
    HWY_ALIGN float ratios[most_lanes_of_entries];
    for (std::size_t j = begin; j < end; j += lanes) {
        const Lanes x = differences(&arrays.centroid[0][j], arrays.centroid[0][row]);
        const Lanes y = differences(&arrays.centroid[1][j], arrays.centroid[1][row]);
        const Lanes z = differences(&arrays.centroid[2][j], arrays.centroid[2][row]);
        const Lanes squared = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
        const Lanes reach = hn::Add(radius, hn::LoadU(tag, &arrays.radius[j]));
        const Lanes ratio = hn::Div(squared, hn::Mul(reach, reach));
        const auto beyond = [&](std::size_t rule) HWY_ATTR {
            return hn::AllTrue(tag, hn::Gt(ratio, hn::Set(tag, distances[rule] * distances[rule])));
        };
        const std::size_t rule = beyond(0) ? 0 : beyond(1) ? 1 : 2;
        const bool any = !hn::AllTrue(tag, hn::Lt(ratio, hn::Set(tag, distances[2] * distances[2])));
        if (any) {
            const Lanes sum = product_rule(arrays, arrays.rules[rule], row, j, x, y, z);
            hn::Store(hn::Mul(hn::Mul(sum, scale), hn::LoadU(tag, &arrays.area[j])), tag, buffer);
        }
        const std::size_t count = std::min(lanes, end - j);
        if (rule == 2) {
            hn::Store(ratio, tag, ratios);
            for (std::size_t k = 0; k < count; ++k) {
                if (!(ratios[k] > distances[2] * distances[2])) near.push_back(j + k);
            }
        }
        for (std::size_t k = 0; k < count; ++k) values[j - begin + k] = static_cast<double>(buffer[k]);
    }
}

}  // namespace
}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace samara {
namespace {

HWY_EXPORT(fill_far_lanes);

// Least distances of the centroids, in sums of both radii, that suffice for the rules of 3, 6 and 12 points.
constexpr std::array<float, 3> rule_distances = {10.0F, 3.0F, 1.2F};
// The 16-point rule serves where the other triangle's edges are this many radii away.
constexpr double outer_rule_distance = 3.0;

SingleLayerEntries::RulePoints points_of(const std::vector<FlatTriangle>& triangles, std::size_t stride,
                                         const std::vector<RulePoint>& rule) {
    SingleLayerEntries::RulePoints result;
    for (auto& coordinate : result.coordinates) coordinate.assign(rule.size() * stride, 0.0F);
    for (std::size_t p = 0; p < rule.size(); ++p) {
        result.weights.push_back(static_cast<float>(rule[p].weight));
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            Vector3d point = -triangles[t].centroid;
            for (std::size_t k = 0; k < 3; ++k) point += rule[p].corner_shares[k] * triangles[t].corners[k];
            for (std::size_t c = 0; c < 3; ++c) {
                result.coordinates[c][p * stride + t] =
                    static_cast<float>(point[static_cast<Eigen::Index>(c)]);
            }
        }
    }
    return result;
}

double squared_distance_to_edge(const Vector3d& point, const FlatTriangle& triangle, std::size_t e) {
    const Vector3d arm = point - triangle.corners[e];
    const double place = std::clamp(arm.dot(triangle.tangents[e]), 0.0, triangle.lengths[e]);
    return (arm - place * triangle.tangents[e]).squaredNorm();
}

double squared_distance_to_edges(const Vector3d& point, const FlatTriangle& triangle) {
    return std::min({squared_distance_to_edge(point, triangle, 0),
                     squared_distance_to_edge(point, triangle, 1),
                     squared_distance_to_edge(point, triangle, 2)});
}

/// Returns the double integral of 1/r by a rule on `outer` and the exact potential of `inner`.
double by_outer_rule(const FlatTriangle& outer, const FlatTriangle& inner) {
    const std::vector<RulePoint>& rule = symmetric_rule(8);
    double sum = 0.0;
    PointBatch points;
    for (std::size_t first = 0; first < rule.size(); first += point_batch) {
        for (std::size_t k = 0; k < point_batch; ++k) {
            const auto& shares = rule[first + k].corner_shares;
            points.set(k, shares[0] * outer.corners[0] + shares[1] * outer.corners[1] +
                              shares[2] * outer.corners[2]);
        }
        const ValueBatch potentials = uniform_potential(inner, points);
        for (std::size_t k = 0; k < point_batch; ++k) sum += rule[first + k].weight * potentials.values[k];
    }
    return outer.area * sum;
}

}  // namespace

SingleLayerEntries::SingleLayerEntries(std::vector<FlatTriangle> triangles)
    : triangles_(std::move(triangles)) {
    arrays_.stride = triangles_.size() + most_lanes_of_entries;
    for (auto& coordinate : arrays_.centroid) coordinate.assign(arrays_.stride, 1e3);
    arrays_.radius.assign(arrays_.stride, 0.0F);
    arrays_.area.assign(arrays_.stride, 0.0F);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        for (std::size_t c = 0; c < 3; ++c) {
            arrays_.centroid[c][t] = triangles_[t].centroid[static_cast<Eigen::Index>(c)];
        }
        arrays_.radius[t] = static_cast<float>(triangles_[t].radius);
        arrays_.area[t] = static_cast<float>(triangles_[t].area);
    }
    arrays_.rules = {points_of(triangles_, arrays_.stride, symmetric_rule(2)),
                     points_of(triangles_, arrays_.stride, symmetric_rule(4)),
                     points_of(triangles_, arrays_.stride, symmetric_rule(6))};
}

void SingleLayerEntries::fill_row(std::size_t row, std::size_t begin, std::size_t end, double* values) const {
    std::vector<std::size_t> near;
    HWY_DYNAMIC_DISPATCH(fill_far_lanes)(arrays_, rule_distances, row, begin, end, values, near);
    for (const std::size_t column : near) values[column - begin] = near_entry(row, column);
}

double SingleLayerEntries::near_entry(std::size_t i, std::size_t j) const {
    constexpr double scale = 1.0 / (4.0 * std::numbers::pi);
    if (i == j) return scale * self_potential(triangles_[i]);
    const bool i_is_outer = triangles_[i].radius < triangles_[j].radius ||
                            (triangles_[i].radius == triangles_[j].radius && i < j);
    const FlatTriangle& outer = triangles_[i_is_outer ? i : j];
    const FlatTriangle& inner = triangles_[i_is_outer ? j : i];
    const double reach = outer_rule_distance * outer.radius;
    if (squared_distance_to_edges(outer.centroid, inner) > reach * reach) {
        return scale * by_outer_rule(outer, inner);
    }
    return scale * pair_potential(outer, inner);
}

}  // namespace samara
#endif
