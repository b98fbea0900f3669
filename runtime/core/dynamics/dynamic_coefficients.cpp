#include "samara/core/dynamics/dynamic_coefficients.hpp"

#include <algorithm>

namespace samara {
namespace {

// The rotational drag of loads by drag and lift coefficients, which have no other damping of rotation.
constexpr double rotational_drag_beside_coefficients = 1.3;

double half_length_of(const Body& body) {
    double longest = 0.0;
    for (const Vector3d& vertex : body.surface.vertices) {
        longest = std::max(longest, (vertex - body.moments.centroid).norm());
    }
    return longest;
}

struct ProjectedArea {
    Matrix3d areas;     // m^2: projected along the principal axes
    double unevenness;  // 0 for a sphere, whose rotation does not change its flow, to 1 for a thin sheet
};

ProjectedArea projected_area_of(const Body& body) {
    const Matrix3d axes = principal_axes(body.moments);
    Vector3d areas;
    for (int i = 0; i < 3; ++i) areas[i] = projected_area(body.surface, axes.col(i));
    return {axes * areas.asDiagonal() * axes.transpose(), 1.0 - areas.minCoeff() / areas.maxCoeff()};
}

}  // namespace

Matrix3d projected_area_tensor(const Body& body) {
    return projected_area_of(body).areas;
}

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
        rotational_drag_beside_coefficients * rotational_drag_tensor(body.surface, body.moments.centroid);
    coefficients.half_length = half_length_of(body);
    coefficients.origin = "rotational drag by default";
    return coefficients;
}

DynamicCoefficients no_dynamic_coefficients(const Body& body) {
    DynamicCoefficients coefficients;
    coefficients.half_length = half_length_of(body);
    coefficients.origin = "no dynamic coefficients";
    return coefficients;
}

DynamicCoefficients default_dynamic_coefficients(const Body& body) {
    DynamicCoefficients coefficients;
    coefficients.half_length = half_length_of(body);
    const auto [areas, unevenness] = projected_area_of(body);
    if (body.kirchhoff) {
        coefficients.transport =
            usual_transport * unevenness * body.kirchhoff->matrix.bottomRightCorner<3, 3>();
    }
    coefficients.rotational_transport = usual_rotational_transport;
    coefficients.drag_in_motion = usual_drag_in_motion * unevenness * areas;
    coefficients.drag_in_spin = usual_drag_in_spin * unevenness * areas;
    const Matrix3d rotational = rotational_drag_tensor(body.surface, body.moments.centroid);
    coefficients.rotational_drag = usual_rotational_drag * rotational;
    coefficients.rotational_drag_in_spin = usual_rotational_drag_in_spin * rotational;
    coefficients.origin = "dynamic coefficients by default (none in the body file)";
    return coefficients;
}

DynamicCoefficients surface_dynamic_coefficients(const Body& body, const SurfaceMotion& motion) {
    DynamicCoefficients coefficients;
    coefficients.half_length = half_length_of(body);
    const auto [areas, unevenness] = projected_area_of(body);
    if (body.kirchhoff) {
        const Matrix3d added_mass = body.kirchhoff->matrix.bottomRightCorner<3, 3>();
        coefficients.transport = motion.transport * added_mass +
                                 motion.spin_lift * added_mass.trace() / 3.0 * Matrix3d::Identity();
    }
    coefficients.rotational_transport = usual_rotational_transport;
    coefficients.drag_in_motion = motion.drag_in_motion * unevenness * areas;
    coefficients.drag_in_spin = motion.drag_in_spin * unevenness * areas;
    const Matrix3d rotational = rotational_drag_tensor(body.surface, body.moments.centroid);
    coefficients.rotational_drag = motion.rotational_drag * rotational;
    coefficients.rotational_drag_in_spin = motion.rotational_drag_in_spin * rotational;
    coefficients.laminar_rotational_drag = motion.laminar_rotational_drag;
    coefficients.spin_lift_onset = motion.spin_lift_onset;
    coefficients.origin = "dynamic coefficients that all bodies share";
    return coefficients;
}

}  // namespace samara
