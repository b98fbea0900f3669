#include "support/exact_ellipsoids.hpp"

#include <algorithm>
#include <numbers>

#include "support/test_shapes.hpp"

namespace samara::test {

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

}  // namespace samara::test
