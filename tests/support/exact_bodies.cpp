#include "support/exact_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/test_shapes.hpp"

namespace samara::test {
namespace {

/// a b c times the integral over lambda from 0 to infinity of 1 / ((a_i^2 + lambda) D(lambda)), D the root of
/// the product of all (a_j^2 + lambda). Lamb, art. 114, equation 6. By the trapezoidal rule after lambda =
/// exp(s - exp(-s)), which converges exponentially.
double lamb_integral(const Vector3d& semi_axes, Eigen::Index axis) {
    const Vector3d squares = semi_axes.cwiseAbs2();
    constexpr double step = 1.0 / 64.0;
    double sum = 0.0;
    for (int i = -6 * 64; i <= 100 * 64; ++i) {
        const double s = step * i;
        const double lambda = std::exp(s - std::exp(-s));
        const Vector3d shifted = squares.array() + lambda;
        sum += lambda * (1.0 + std::exp(-s)) / (shifted(axis) * std::sqrt(shifted.prod()));
    }
    return semi_axes.prod() * step * sum;
}

}  // namespace

ExactEllipsoid exact_ellipsoid(const Vector3d& semi_axes) {
    const double volume = 4.0 / 3.0 * std::numbers::pi * semi_axes.prod();
    Vector3d integrals;
    for (Eigen::Index i = 0; i < 3; ++i) integrals(i) = lamb_integral(semi_axes, i);
    ExactEllipsoid body{"ellipsoid", semi_axes, Vector3d::Zero(), Vector3d::Zero()};
    for (Eigen::Index i = 0; i < 3; ++i) {
        const Eigen::Index j = (i + 1) % 3;
        const Eigen::Index k = (i + 2) % 3;
        const double b = semi_axes(j) * semi_axes(j);
        const double c = semi_axes(k) * semi_axes(k);
        body.mass(i) = volume * integrals(i) / (2.0 - integrals(i));
        if (b == c) continue;
        // Art. 115, equation 8.
        body.inertia(i) = volume / 5.0 * (b - c) * (b - c) * (integrals(k) - integrals(j)) /
                          (2.0 * (b - c) + (b + c) * (integrals(j) - integrals(k)));
    }
    return body;
}

const std::vector<ExactEllipsoid>& exact_ellipsoids() {
    static const std::vector<ExactEllipsoid> bodies = {
        {"sphere", {1, 1, 1}, {0, 0, 0}, Vector3d::Constant(2.094395102393)},
        {"ellipsoid 1:2:4",
         {1, 2, 4},
         {19.46017908431, 111.0440372296, 13.6118310185},
         {50.87072167736, 13.34287626884, 4.241425456327}},
        {"prolate 4:1:1",
         {4, 1, 1},
         {0, 34.63273532154, 34.63273532154},
         {1.366504841191, 14.40542682308, 14.40542682308}},
        {"oblate 1:1:0.1",
         {1, 1, 0.1},
         {0.3403414985759, 0.3403414985759, 0},
         {0.03133385334413, 0.03133385334413, 2.590401796703}},
        {"oblate 1:1:0.01",
         {1, 1, 0.01},
         {0.3546522798836, 0.3546522798836, 0},
         {3.273857431985e-4, 3.273857431985e-4, 2.658763969103}},
    };
    return bodies;
}

const ExactEllipsoid& exact_ellipsoid(const std::string& name) {
    const auto& bodies = exact_ellipsoids();
    return *std::find_if(bodies.begin(), bodies.end(), [&](const auto& body) { return body.name == name; });
}

Matrix6d exact_tensor(const ExactEllipsoid& body) {
    Matrix6d tensor = Matrix6d::Zero();
    tensor.diagonal() << body.inertia, body.mass;
    return tensor;
}

VolumeMoments exact_moments(const ExactEllipsoid& body) {
    VolumeMoments moments;
    moments.volume = 4.0 / 3.0 * std::numbers::pi * body.semi_axes.prod();
    const Vector3d squares = body.semi_axes.cwiseAbs2();
    moments.second_moments = (moments.volume / 5.0 * squares).asDiagonal();
    moments.surface_area = surface_area(ellipsoid(body.semi_axes, 4));
    return moments;
}

Matrix6d unit_cube_tensor() {
    Matrix6d tensor = Matrix6d::Zero();
    tensor.diagonal() << Vector3d::Constant(0.03926), Vector3d::Constant(0.63842);
    return tensor;
}

double unit_plate_added_mass() {
    return 0.5790 * std::numbers::pi / 4.0;
}

}  // namespace samara::test
