#include "samara/internal/plot/strip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "samara/internal/plot/silhouette.hpp"
#include "samara/motion/measures.hpp"

namespace samara {
namespace {

constexpr double longest_stretch = 24.0;  // body lengths
constexpr int most_silhouettes = 40;
constexpr double separate_share = 0.9;
constexpr int hull_directions = 256;
constexpr int axes_of_separation = 12;

/// Vertices about the centre of mass that are outermost in directions spread evenly over the sphere (a
/// Fibonacci lattice): the corners of a hull.
std::vector<Vector3d> hull_points(const BodyMotion& body) {
    std::set<std::size_t> outermost;
    for (int i = 0; i < hull_directions; ++i) {
        const double height = 1.0 - 2.0 * (i + 0.5) / hull_directions;
        const double azimuth = 2.0 * std::numbers::pi * i / std::numbers::phi;
        const double radius = std::sqrt(1.0 - height * height);
        const Vector3d direction(radius * std::cos(azimuth), radius * std::sin(azimuth), height);
        std::size_t best = 0;
        for (std::size_t v = 1; v < body.surface.vertices.size(); ++v) {
            if (body.surface.vertices[v].dot(direction) > body.surface.vertices[best].dot(direction))
                best = v;
        }
        outermost.insert(best);
    }
    std::vector<Vector3d> points;
    points.reserve(outermost.size());
    for (const std::size_t v : outermost) points.push_back(body.surface.vertices[v] - body.center_of_mass);
    return points;
}

/// How far a silhouette reaches along each axis of separation, in both views.
using Reach = std::array<std::array<double, 2>, static_cast<std::size_t>(2 * axes_of_separation)>;

Reach reach_of(const std::vector<Vector3d>& hull, const Pose& pose) {
    const std::array<View, 2> views = {front_view(), side_view()};
    Reach reach;
    reach.fill({std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()});
    const Matrix3d rotation = pose.orientation.toRotationMatrix();
    for (const Vector3d& point : hull) {
        const Vector3d place = pose.position + rotation * point;
        for (std::size_t i = 0; i < reach.size(); ++i) {
            const std::size_t axis = i / 2;
            const double angle = std::numbers::pi * static_cast<double>(axis) / axes_of_separation;
            const double along = views[i % 2].project(place).dot(Vector2d(std::cos(angle), std::sin(angle)));
            reach[i][0] = std::min(reach[i][0], along);
            reach[i][1] = std::max(reach[i][1], along);
        }
    }
    return reach;
}

/// In how many of the views a line passes between the two silhouettes.
int views_apart(const Reach& a, const Reach& b) {
    std::array<bool, 2> apart = {false, false};
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i][1] < b[i][0] || b[i][1] < a[i][0]) apart[i % 2] = true;
    }
    return (apart[0] ? 1 : 0) + (apart[1] ? 1 : 0);
}

int frame_at(const Motion& motion, double time) {
    const auto place = std::lower_bound(motion.times.begin(), motion.times.end(), time - 1e-9);
    return std::min(static_cast<int>(place - motion.times.begin()), motion.frames() - 1);
}

/// The first frame from which on the path fits in a box with sides of `size`.
int start_of_stretch(const Motion& motion, const BodyMotion& body, int run, int copy, int first, int last,
                     double size) {
    Vector3d lowest = motion.pose(body, run, last, copy).position;
    Vector3d highest = lowest;
    for (int frame = last; frame >= first; --frame) {
        lowest = lowest.cwiseMin(motion.pose(body, run, frame, copy).position);
        highest = highest.cwiseMax(motion.pose(body, run, frame, copy).position);
        if ((highest - lowest).maxCoeff() > size) return frame + 1;
    }
    return first;
}

}  // namespace

Strip choose_strip(const Motion& motion, const BodyMotion& body, int run, int copy) {
    const TimeWindow fall = fall_of(motion, body, run, copy);
    std::vector<Vector3d> hull = hull_points(body);
    for (Vector3d& point : hull) point *= body.size(run, copy);
    double extent = 0.0;
    for (const Vector3d& a : hull) {
        for (const Vector3d& b : hull) extent = std::max(extent, (a - b).norm());
    }
    Strip strip;
    strip.last = frame_at(motion, fall.end);
    strip.first = start_of_stretch(motion, body, run, copy, frame_at(motion, fall.begin), strip.last,
                                   longest_stretch * extent);
    const int length = strip.last - strip.first;
    int longest_stride = length;
    for (int stride = std::max(1, (length + most_silhouettes - 2) / (most_silhouettes - 1));
         stride <= longest_stride; ++stride) {
        strip.frames.clear();
        std::array<int, 3> pairs{};  // by the number of views in which they are apart
        Reach before{};
        for (int frame = strip.first; frame <= strip.last; frame += stride) {
            const Reach reach = reach_of(hull, motion.pose(body, run, frame, copy));
            if (!strip.frames.empty()) ++pairs[static_cast<std::size_t>(views_apart(before, reach))];
            strip.frames.push_back(frame);
            before = reach;
        }
        const double enough = separate_share * static_cast<double>(strip.frames.size() - 1);
        if (pairs[2] >= enough) return strip;
        if (pairs[1] + pairs[2] >= enough) longest_stride = std::min(longest_stride, 2 * stride);
        if (pairs[1] + pairs[2] > 0 && stride == longest_stride) return strip;
    }
    strip.frames = {strip.first};
    return strip;
}

}  // namespace samara
