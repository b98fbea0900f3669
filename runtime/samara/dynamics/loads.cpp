#include "samara/dynamics/loads.hpp"

#include "samara/dynamics/kernel/kernel.hpp"

namespace samara {

Matrix6d load_matrix(const ImmersedBody& body, const Vector6d& relative_velocity) noexcept {
    return load_matrix(body, relative_velocity, relative_velocity.head<3>());
}

Matrix6d load_matrix(const ImmersedBody& body, const Vector6d& relative_velocity,
                     const Vector3d& angular_velocity) noexcept {
    if (body.loads == Loads::none) return Matrix6d::Zero();
    return kernel::load_matrix(body.constants, relative_velocity, angular_velocity);
}

double reynolds_number(const ImmersedBody& body, double speed) noexcept {
    return speed * body.length * body.fluid_density / body.viscosity;
}

}  // namespace samara
