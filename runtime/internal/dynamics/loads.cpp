#include "internal/dynamics/loads.hpp"

#include <cmath>

#include "internal/kernel/kernel.hpp"

namespace samara {

Matrix6d load_matrix(const ImmersedBody& body, const Vector6d& relative_velocity) noexcept {
    return load_matrices(body, relative_velocity, Vector3d::Zero()).whole;
}

LoadMatrices load_matrices(const ImmersedBody& body, const Vector6d& velocity, const Vector3d& seen_rotation,
                           const Vector3d& slip, double formed) noexcept {
    if (body.loads == Loads::none) return {};
    return kernel::load_matrices(body.constants, velocity, seen_rotation, slip, formed);
}

double wake_formation_rate(const ImmersedBody& body, const Vector6d& relative_velocity) noexcept {
    const Vector3d velocity = relative_velocity.tail<3>();
    if (!body.constants.wake_forms || velocity.isZero(0.0)) return 0.0;
    const double combined =
        std::hypot(velocity.norm(), body.dynamic.half_length * relative_velocity.head<3>().norm());
    return combined * velocity.norm() / std::sqrt(velocity.dot(body.squared_formation_way * velocity));
}

double reynolds_number(const ImmersedBody& body, double speed) noexcept {
    return speed * body.length * body.fluid_density / body.viscosity;
}

}  // namespace samara
