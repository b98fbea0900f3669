#include "samara/dynamics/dynamic_coefficients.hpp"

#include <algorithm>

namespace samara {
namespace {

// Chosen on a free fall of the 1:2:4 ellipsoid in OpenFOAM; docs/theory gives its figures and what they miss.
constexpr double default_transport = 0.75;
constexpr double default_rotational_transport = 1.0;
constexpr double default_drag_in_motion = 2.0;
constexpr double default_rotational_drag = 1.3;

double half_length_of(const Body& body) {
    double longest = 0.0;
    for (const Vector3d& vertex : body.surface.vertices) {
        longest = std::max(longest, (vertex - body.moments.centroid).norm());
    }
    return longest;
}

}  // namespace

Matrix3d rotational_drag_tensor(const Surface& surface, const Vector3d& centroid) {
    Matrix3d tensor = Matrix3d::Zero();
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const Vector3d area = area_vector(surface, t);
        const double size = area.norm();
        if (size == 0.0) continue;
        const Vector3d arm = (triangle_centroid(surface, t) - centroid).cross(area / size);
        tensor += 0.5 * size * arm * arm.transpose();
    }
    return tensor;
}

DynamicCoefficients rotational_drag_alone(const Body& body) {
    DynamicCoefficients coefficients;
    coefficients.rotational_drag =
        default_rotational_drag * rotational_drag_tensor(body.surface, body.moments.centroid);
    coefficients.half_length = half_length_of(body);
    coefficients.origin = "rotational drag by default";
    return coefficients;
}

DynamicCoefficients default_dynamic_coefficients(const Body& body) {
    DynamicCoefficients coefficients = rotational_drag_alone(body);
    if (body.kirchhoff) {
        coefficients.transport = default_transport * body.kirchhoff->matrix.bottomRightCorner<3, 3>();
    }
    coefficients.rotational_transport = default_rotational_transport;
    const Matrix3d axes = principal_axes(body.moments);
    for (int i = 0; i < 3; ++i) {
        const Vector3d axis = axes.col(i);
        coefficients.drag_in_motion +=
            default_drag_in_motion * projected_area(body.surface, axis) * axis * axis.transpose();
    }
    coefficients.origin = "dynamic coefficients by default (none in the body file)";
    return coefficients;
}

}  // namespace samara
