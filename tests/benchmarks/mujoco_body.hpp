#pragma once

#include <array>
#include <memory>
#include <optional>

#include <mujoco/mujoco.h>

#include "samara/motion/motion.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// The five coefficients of MuJoCo's ellipsoid fluid model: drag of a blunt, of a slender body, of turning;
/// lift by Kutta, by Magnus.
using FluidCoefficients = std::array<double, 5>;

/// MuJoCo's own defaults.
inline constexpr FluidCoefficients default_fluid_coefficients = {0.5, 0.25, 1.5, 1.0, 1.0};

/// How one fall came out.
struct MujocoFall {
    std::vector<Pose> poses;  ///< of every frame; empty where a number ran away
    int steps = 0;
    double seconds = 0.0;  ///< CPU time of the steps alone
};

/// One free body of uniform density in MuJoCo's ellipsoid fluid model, and nothing else: no contacts, no
/// constraints. MuJoCo makes its ellipsoid from a geom's half sizes, for ellipsoids, cylinders and boxes
/// alike (mju_geomSemiAxes): here the half extents of the body along its principal axes. Mass and inertia are
/// the body's own. MuJoCo knows no buoyancy: gravity is reduced by the fluid's share, which is the same force
/// as the body is uniform.
class MujocoBody {
  public:
    /// The first body of a scene; its shape is meshed by samara-mesh. `reference`: a motion of the same
    /// scene, whose frames and body are taken. `integrator`: one of MuJoCo's mjtIntegrator. Throws Error
    /// where the body's density is not uniform and where MuJoCo refuses the model.
    MujocoBody(const Scene& scene, const Motion& reference, int integrator);

    /// Falls from the scene's start, by the scene's step over `cuts`, through the reference's frames.
    [[nodiscard]] MujocoFall fall(const FluidCoefficients& coefficients, int cuts = 1) const;

    /// The reference with the poses of a fall in place of its own.
    [[nodiscard]] Motion motion(const MujocoFall& fall, const FluidCoefficients& coefficients) const;

    [[nodiscard]] const Motion& reference() const { return reference_; }
    [[nodiscard]] double step() const { return step_; }

  private:
    [[nodiscard]] Pose pose() const;

    Motion reference_;
    double step_ = 0.0;
    Vector3d start_ = Vector3d::Zero();             ///< of the centre of mass (m, world)
    Quaterniond turn_ = Quaterniond::Identity();    ///< principal axes to world, at the start
    Quaterniond axes_ = Quaterniond::Identity();    ///< principal axes to shape axes
    Vector3d velocity_ = Vector3d::Zero();          ///< m/s, world
    Vector3d angular_velocity_ = Vector3d::Zero();  ///< rad/s, world
    std::shared_ptr<mjModel> model_;
    std::shared_ptr<mjData> data_;
};

}  // namespace samara
