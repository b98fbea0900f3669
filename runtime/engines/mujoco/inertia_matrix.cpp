#include "runtime/engines/mujoco/inertia_matrix.hpp"

#include <Eigen/Geometry>

#if mjVERSION_HEADER >= 333 && mjVERSION_HEADER < 336
#error "MuJoCo 3.3.3 to 3.3.5 have two inertia matrices: take 3.3.2 or older, or 3.3.6 or newer"
#endif

namespace samara::mujoco {
namespace {

using Vector3 = Eigen::Vector3d;

/// Returns a spatial vector about the tree's reference point as one at a point `arm` away from it.
Vector6 moved(const mjtNum* spatial, const Vector3& arm) {
    Vector6 result = Eigen::Map<const Vector6>(spatial);
    result.tail<3>() += result.head<3>().cross(arm);
    return result;
}

}  // namespace

BodyMotion motion_of(const mjModel& model, const mjData& data, int body) {
    BodyMotion motion;
    int carrier = body;
    while (carrier > 0 && model.body_dofnum[carrier] == 0) carrier = model.body_parentid[carrier];
    if (carrier == 0) return motion;
    for (int dof = model.body_dofadr[carrier] + model.body_dofnum[carrier] - 1; dof >= 0;
         dof = model.dof_parentid[dof])
        motion.dofs.push_back(dof);
    const Vector3 arm = Eigen::Map<const Vector3>(part(data.xipos, 3, body)) -
                        Eigen::Map<const Vector3>(part(data.subtree_com, 3, model.body_rootid[body]));
    motion.jacobian.resize(6, static_cast<Eigen::Index>(motion.dofs.size()));
    for (Eigen::Index i = 0; i < motion.jacobian.cols(); ++i) {
        const int dof = motion.dofs[static_cast<std::size_t>(i)];
        motion.jacobian.col(i) = moved(part(data.cdof, 6, dof), arm);
        motion.velocity += data.qvel[dof] * motion.jacobian.col(i);
        motion.acceleration += data.qvel[dof] * moved(part(data.cdof_dot, 6, dof), arm);
    }
    // From the spatial acceleration to that of the point.
    motion.acceleration.tail<3>() += Vector3(motion.velocity.head<3>()).cross(motion.velocity.tail<3>());
    return motion;
}

bool is_diagonal(const mjModel& model, int body) {
    return model.body_dofnum[body] > 0 && model.dof_simplenum[model.body_dofadr[body]] > 0;
}

void reset_inertia(const mjModel& model, mjData& data) {
#if mjVERSION_HEADER >= 336
    mj_makeM(&model, &data);
#else
    mj_crb(&model, &data);
#endif
}

void add_inertia(const mjModel& model, mjData& data, const BodyMotion& motion, const Matrix6& inertia) {
    const Eigen::Matrix<double, 6, Eigen::Dynamic> momentum = inertia * motion.jacobian;
    for (Eigen::Index i = 0; i < momentum.cols(); ++i) {
        const int dof = motion.dofs[static_cast<std::size_t>(i)];
        for (Eigen::Index k = i; k < momentum.cols(); ++k) {
            const double entry = motion.jacobian.col(k).dot(momentum.col(i));
#if mjVERSION_HEADER >= 336
            data.M[model.M_rowadr[dof] + model.M_rownnz[dof] - 1 - (k - i)] += entry;
#else
            data.qM[model.dof_Madr[dof] + (k - i)] += entry;
#endif
        }
    }
}

void renew_inertia(const mjModel& model, mjData& data) {
    mj_factorM(&model, &data);
#if mjVERSION_HEADER >= 330
    mj_island(&model, &data);
#endif
    mj_projectConstraint(&model, &data);
}

}  // namespace samara::mujoco
