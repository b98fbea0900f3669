#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <mujoco/mujoco.h>

namespace samara::mujoco {

/// Angular, then linear; world axes, at the body's centre of mass.
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Returns where the numbers of an item begin in an array of MuJoCo that holds `width` of each.
inline const mjtNum* part(const mjtNum* numbers, int width, int item) {
    return numbers + static_cast<std::ptrdiff_t>(width) * item;
}

/// How a body moves with the degrees of freedom that carry it.
struct BodyMotion {
    std::vector<int> dofs;                              ///< from the body's own towards the world
    Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian;  ///< a column for each
    Vector6 velocity = Vector6::Zero();
    Vector6 acceleration = Vector6::Zero();  ///< where the degrees of freedom have none
};

/// Returns the motion of a body. Needs mj_comVel.
BodyMotion motion_of(const mjModel& model, const mjData& data, int body);

/// Whether MuJoCo keeps the body's own rows of the inertia matrix as a diagonal.
bool is_diagonal(const mjModel& model, int body);

/// Computes MuJoCo's inertia matrix without the fluid's anew.
void reset_inertia(const mjModel& model, mjData& data);

/// Adds J^T inertia J, of a symmetric inertia, to MuJoCo's inertia matrix.
void add_inertia(const mjModel& model, mjData& data, const BodyMotion& motion, const Matrix6& inertia);

/// Renews what MuJoCo has made of its inertia matrix: its factors and what the solvers of constraints take.
void renew_inertia(const mjModel& model, mjData& data);

}  // namespace samara::mujoco
