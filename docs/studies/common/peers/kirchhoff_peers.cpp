#include <utility>

#include "peers/peer_body.hpp"
#include "samara/commands/shared/load_body.hpp"
#include "samara/core/simulation/world_pose.hpp"
#include "samara/kirchhoff/kirchhoff_solver.hpp"
#include "samara/scene/terminal_speed.hpp"
#include "support/reference_step.hpp"

namespace samara {
namespace {

/// What a model's loads may know of the body: SI units, shape axes.
struct Exposed {
    double fluid_density;
    double length;  ///< L = sqrt(S/pi)
    double surface_area;
    double terminal_speed;  ///< at a drag coefficient of 1
    Vector3d normal;        ///< the axis of the shortest extent
};

/// Moment and force about the centroid at its angular and linear velocity.
using PeerLoads = Vector6d (*)(const Exposed& body, const std::vector<double>& coefficients,
                               const Vector3d& angular_velocity, const Vector3d& velocity);

ImmersedBody without_loads(const SceneBody& given, const Fluid& fluid, Body& body) {
    body.kirchhoff = kirchhoff_tensor(body.surface, body.moments);
    BodyPhysics physics = given;
    physics.loads = Loads::none;
    physics.turbulence = Turbulence::none;
    physics.dynamic = Dynamic::none;
    physics.added_mass = true;
    return make_immersed_body(body, physics, fluid, given.name);
}

/// Kirchhoff's equations with gravity, buoyancy and a model's loads, by Runge and Kutta's fourth order.
class KirchhoffPeer : public PeerBody {
  public:
    KirchhoffPeer(const Scene& scene, const Motion& reference, PeerLoads loads, std::string words)
        : times_(reference.times),
          step_(scene.step),
          gravity_(scene.gravity),
          loads_(loads),
          words_(std::move(words)) {
        const SceneBody& given = scene.bodies.front();
        Body body = load_body(given.shape, reading_of(given));
        immersed_ = without_loads(given, scene.fluid, body);
        start_ = initial_state(given, immersed_.center_of_mass, {.gravity = scene.gravity},
                               Noise(scene.seed, immersed_.name, 0, 0));
        exposed_ = {scene.fluid.density, immersed_.length, body.moments.surface_area,
                    terminal_speed(body, scene.fluid, immersed_.mass, scene.gravity.norm()),
                    principal_axes(body.moments).col(0)};
    }

    [[nodiscard]] PeerFall fall(const std::vector<double>& coefficients, int cuts) const override {
        const double step = step_ / cuts;
        const EquationsOfMotion equations(immersed_, gravity_, {});
        const Matrix6d mobility = immersed_.inverse_inertia * immersed_.to_centroid.transpose();
        const auto rate = [&](const MotionVector& motion) {
            MotionVector result = equations.rate(motion);
            const Vector6d velocity = immersed_.to_centroid * motion.head<6>();
            result.head<6>() +=
                mobility * loads_(exposed_, coefficients, velocity.head<3>(), velocity.tail<3>());
            return result;
        };
        MotionVector motion = motion_vector(start_);
        const auto advance = [&] {
            const MotionVector a = rate(motion);
            const MotionVector b = rate(motion + 0.5 * step * a);
            const MotionVector c = rate(motion + 0.5 * step * b);
            const MotionVector d = rate(motion + step * c);
            motion = motion_vector(body_state(motion + step / 6.0 * (a + 2.0 * b + 2.0 * c + d), {}));
            return motion.allFinite() && motion.head<6>().norm() < 1e6;
        };
        return flown_through(times_, step, advance, [&] { return flow_pose(body_state(motion, {})); });
    }

    [[nodiscard]] std::string words() const override { return words_; }

  private:
    std::vector<double> times_;
    double step_;
    Vector3d gravity_;
    PeerLoads loads_;
    std::string words_;
    ImmersedBody immersed_;
    BodyState start_;
    Exposed exposed_{};
};

/// -d v and -d L^2 omega, each times a coefficient, with d = rho S U/8: a quarter of the surface is the
/// body's mean projected area, and U its speed of fall at a drag coefficient of 1.
Vector6d linear_drag(const Exposed& body, const std::vector<double>& coefficients,
                     const Vector3d& angular_velocity, const Vector3d& velocity) {
    const double drag = 0.125 * body.fluid_density * body.surface_area * body.terminal_speed;
    Vector6d load;
    load << -coefficients[1] * drag * body.length * body.length * angular_velocity,
        -coefficients[0] * drag * velocity;
    return load;
}

/// Eq. 5 of the paper as it is printed, A the whole surface, without an arm to the centre of pressure.
Vector6d printed_loads(const Exposed& body, const std::vector<double>& coefficients,
                       const Vector3d& /*angular_velocity*/, const Vector3d& velocity) {
    Vector3d direction = coefficients[0] * velocity;
    const Vector3d across = body.normal.cross(velocity);
    if (across.norm() > 0.0) direction += coefficients[1] * velocity.cross(across.normalized());
    Vector6d load;
    load << Vector3d::Zero(), -0.5 * body.fluid_density * body.surface_area * velocity.norm() * direction;
    return load;
}

}  // namespace

PeerModel linear_drag_model() {
    return {"linear-drag",
            {{"drag", 1.0, 0.0, 8.0}, {"drag of turning", 1.0, 0.0, 8.0}},
            [](const Scene& scene, const Motion& reference) {
                return std::make_shared<KirchhoffPeer>(scene, reference, linear_drag,
                                                       "Kirchhoff's equations with linear drag");
            }};
}

PeerModel printed_model() {
    return {"paper",
            {{"C_d", 0.5, 0.0, 2.0}, {"C_l", 0.1, 0.0, 2.0}},
            [](const Scene& scene, const Motion& reference) {
                return std::make_shared<KirchhoffPeer>(scene, reference, printed_loads,
                                                       "Kirchhoff's equations with eq. 5 as printed");
            }};
}

}  // namespace samara
