#include "samara/motion/inclination.hpp"

#include <algorithm>
#include <cmath>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/base/numbers.hpp"

namespace samara {
namespace {

constexpr double alike = 0.01;

/// Returns the place of the extremum of the parabola through the points at i - 1, i and i + 1; time i where
/// the three lie on a line.
double parabola_vertex(const std::vector<double>& times, const std::vector<double>& values, std::size_t i) {
    const double before = times[i] - times[i - 1];
    const double after = times[i + 1] - times[i];
    const double slope_before = (values[i] - values[i - 1]) / before;
    const double slope_after = (values[i + 1] - values[i]) / after;
    const double curvature = (slope_after - slope_before) / (before + after);
    if (curvature == 0.0) return times[i];
    const double slope = (slope_before * after + slope_after * before) / (before + after);
    return times[i] + std::clamp(-0.5 * slope / curvature, -before, after);
}

}  // namespace

Vector3d down_direction(const Vector3d& gravity) {
    const double strength = gravity.norm();
    return strength > 0.0 ? Vector3d(gravity / strength) : Vector3d(0.0, 0.0, -1.0);
}

double inclination(const Motion& motion, const BodyMotion& body, const Pose& pose) {
    const Vector3d axis = pose.orientation * body.shortest_axis;
    const Vector3d down = down_direction(motion.gravity);
    return std::atan2(axis.cross(down).norm(), std::abs(axis.dot(down)));
}

SurfaceSpread surface_spread(const Surface& surface) {
    double area = 0.0;
    Vector3d middle = Vector3d::Zero();
    Matrix3d squares = Matrix3d::Zero();
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        // The integral of x x^T over a triangle: a twelfth of its area by its corners' squares and their
        // sum's.
        const double size = area_vector(surface, t).norm();
        const Vector3d sum = 3.0 * triangle_centroid(surface, t);
        area += size;
        middle += size / 3.0 * sum;
        squares += size / 12.0 * sum * sum.transpose();
        for (const std::int32_t corner : surface.corners[t]) {
            const Vector3d& place = surface.vertices[static_cast<std::size_t>(corner)];
            squares += size / 12.0 * place * place.transpose();
        }
    }
    middle /= area;
    return {middle, squares / area - middle * middle.transpose()};
}

bool has_shortest_axis(const Surface& surface) {
    const Vector3d extents = eigenvalues_of(surface_spread(surface).covariance).cwiseSqrt();
    return extents.maxCoeff() - extents.minCoeff() > alike * extents.maxCoeff();
}

double percentile(std::vector<double> values, double percent) {
    std::sort(values.begin(), values.end());
    return percentile_of_sorted(values, percent);
}

double percentile_of_sorted(const std::vector<double>& values, double percent) {
    const double place = percent / 100.0 * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], place - static_cast<double>(below));
}

double required_prominence(const std::vector<double>& inclinations) {
    return std::max(degree, 0.1 * (percentile(inclinations, 95.0) - percentile(inclinations, 5.0)));
}

std::vector<double> inclination_minima(const std::vector<double>& times,
                                       const std::vector<double>& inclinations, double prominence) {
    std::vector<double> squared_cosines(inclinations.size());
    std::transform(inclinations.begin(), inclinations.end(), squared_cosines.begin(),
                   [](double angle) { return std::cos(angle) * std::cos(angle); });
    std::vector<double> minima;
    std::size_t lowest = 0;
    std::size_t highest = 0;
    bool falling = false;
    for (std::size_t i = 1; i < inclinations.size(); ++i) {
        if (inclinations[i] > inclinations[highest]) highest = i;
        if (inclinations[i] < inclinations[lowest]) lowest = i;
        if (!falling && inclinations[i] < inclinations[highest] - prominence) {
            falling = true;
            lowest = i;
        } else if (falling && inclinations[i] > inclinations[lowest] + prominence) {
            minima.push_back(parabola_vertex(times, squared_cosines, lowest));
            falling = false;
            highest = i;
        }
    }
    return minima;
}

}  // namespace samara
