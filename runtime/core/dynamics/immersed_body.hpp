#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/body/contact_points.hpp"
#include "samara/core/dynamics/steady_patches.hpp"
#include "samara/core/kernel/step_constants.hpp"
#include "samara/core/physics/body_physics.hpp"
#include "samara/core/physics/fluid.hpp"

namespace samara {

/// The part of a body in a fluid that its contacts depend on; body axes about the centre of mass, SI units.
struct TouchingBody {
    ContactPoints contact_points;                     ///< none where it touches nothing
    Matrix6d inertia = Matrix6d::Identity();          ///< K = K_body + rho_f K_fluid, order (omega, v)
    Matrix6d inverse_inertia = Matrix6d::Identity();  ///< K^-1; of an ImmersedBody set by prepare()
};

/// A body in a fluid, prepared for the time steps: constant while it moves. Body axes are the shape file's,
/// about the centre of mass unless said otherwise; SI units. Where a member is set by hand, prepare() must
/// follow.
struct ImmersedBody : TouchingBody {
    std::string name;
    double mass = 0.0;  ///< kg
    bool keeps_thickness =
        false;                   ///< whether the mass of other sizes grows with their square, not their cube
    double volume = 0.0;         ///< m^3
    double fluid_density = 0.0;  ///< kg/m^3
    double viscosity = 0.0;      ///< dynamic, Pa s
    Vector3d center_of_mass = Vector3d::Zero();  ///< m, shape axes from the shape's origin
    /// m, from the centre of mass to the centroid of the volume
    Vector3d center_of_buoyancy = Vector3d::Zero();
    Matrix3d own_inertia = Matrix3d::Identity();  ///< of the body alone about the centre of mass (kg m^2)
    Matrix6d to_centroid = Matrix6d::Identity();  ///< X: (omega, v) at the centre of mass -> at the centroid
    Matrix3d added_mass = Matrix3d::Zero();       ///< rho_f M (kg)
    Matrix3d added_inertia = Matrix3d::Zero();    ///< rho_f J, K_fluid's block of (omega, omega) (kg m^2)
    Matrix3d added_coupling = Matrix3d::Zero();   ///< rho_f C, its block of (omega, v) (kg m)
    double length = 1.0;                          ///< L = sqrt(S/pi) (m)
    double reference_area = 0.0;                  ///< A = pi L^2/4 (m^2)
    /// m^2, body axes: projected areas along the principal axes
    Matrix3d projected_area_tensor = Matrix3d::Zero();
    /// m^2, body axes: d.(squared_formation_length d) is the square of the distance over which a wake forms
    /// behind a body that moves in the direction d (docs/explanation/moving-loads.md#a-wake-that-forms).
    Matrix3d squared_formation_length = Matrix3d::Zero();
    /// Projects an angular velocity onto the part that the flow does not see: about axes across which the
    /// body reaches equally far, as the axis of a body of revolution.
    Matrix3d spin_about_symmetry = Matrix3d::Zero();
    /// sqrt of the largest ratio of added-mass difference to inertia (1/m): with |v| the rate at which the
    /// Munk moment rotates the body
    double rotation_scale = 0.0;

    Loads loads = Loads::none;
    CoefficientLoads coefficients;  ///< where loads are coefficients; normal always set
    /// m^2, where loads are coefficients without a reference area: the body's projected area along the nodes
    /// of an octahedral map of `projection_subdivisions`, row by row.
    std::vector<double> projected_areas;
    std::optional<LoadTables> tables;  ///< where loads or turbulence are from tables
    DynamicCoefficients dynamic;
    /// m^4, body axes: the least rotational drag of `dynamic` about the direction of motion
    /// (docs/explanation/moving-loads.md); zero beside loads without such a term.
    Matrix3d roll_drag = Matrix3d::Zero();
    std::vector<SteadyPatch> patches{SteadyPatch()};  ///< of the surface; one alone is the whole

    Turbulence turbulence = Turbulence::none;
    double turbulent_kinetic_energy = 0.0;  ///< m^2/s^2, where turbulence is constant
    double dissipation_rate = 0.0;          ///< m^2/s^3, likewise
    Langevin langevin = Langevin::wake;

    // Derived from all members above, as inverse_inertia, by prepare().
    StepConstants constants;
};
inline constexpr int projection_subdivisions = 16;

/// Returns the inertia of the body alone about the centre of mass, order (omega, v): diag(I, m 1).
Matrix6d own_inertia(const ImmersedBody& body);
/// Returns the constants of the steps, derived from the members.
StepConstants step_constants(const ImmersedBody& body);
/// Computes the derived members: inverse_inertia and constants.
void prepare(ImmersedBody& body);

/// Returns the body with this physics in a fluid. Without added mass K_fluid is zero, and the coefficients T
/// and t with it. `name` is the body's name in messages. Throws Error where the body lacks what its physics
/// needs (the Kirchhoff tensor; tables: the message names the command that makes them), where a number is not
/// finite or out of its range (the message names the member), and where the inertia is not that of any body.
/// `touches`: whether it may touch something; without it there are no contact points.
ImmersedBody make_immersed_body(const Body& body, const BodyPhysics& physics, const Fluid& fluid,
                                const std::string& name = "body", bool touches = true);

/// Throws Error, one line that names the body and the member, where a number that make_immersed_body needs is
/// not finite or not in its range, or where tables or surface contradict themselves. A Kirchhoff tensor or
/// tables that are missing altogether are no error here.
void require_sound(const Body& body, const BodyPhysics& physics, const Fluid& fluid, const std::string& name);

/// A cache of the bodies that were prepared last from one body. Simulations and groups that differ only in
/// names and starts share them: preparing many takes the time and memory of one. Safe to call from several
/// threads.
class PreparedBodies {
  public:
    /// Keeps the `most` bodies that were made last.
    explicit PreparedBodies(std::size_t most = 64) : most_(most) {}
    /// Returns make_immersed_body() of the body, computed once for equal physics and fluid. The name is that
    /// of the first caller; contact points may be there that nobody asked for. Throws as make_immersed_body()
    /// does.
    [[nodiscard]] std::shared_ptr<const ImmersedBody> get(const Body& body, const BodyPhysics& physics,
                                                          const Fluid& fluid, const std::string& name,
                                                          bool touches = true);

  private:
    struct Entry {
        BodyPhysics physics;
        double fluid_density;
        double viscosity;
        bool touches;
        std::shared_ptr<const ImmersedBody> body;
    };

    std::size_t most_;
    std::mutex mutex_;
    std::vector<Entry> entries_;  ///< the oldest first
};

}  // namespace samara
