#include "internal/dynamics/loads.hpp"

#include "internal/kernel/kernel.hpp"

namespace samara {

Matrix6d load_matrix(const ImmersedBody& body, const Vector6d& relative_velocity) noexcept {
    return load_matrices(body, relative_velocity, Vector3d::Zero()).whole;
}

LoadMatrices load_matrices(const ImmersedBody& body, const Vector6d& velocity, const Vector3d& seen_rotation,
                           const Vector3d& slip) noexcept {
    if (body.loads == Loads::none) return {};
    return kernel::load_matrices(body.constants, velocity, seen_rotation, slip);
}

double reynolds_number(const ImmersedBody& body, double speed) noexcept {
    return speed * body.length * body.fluid_density / body.viscosity;
}

}  // namespace samara
