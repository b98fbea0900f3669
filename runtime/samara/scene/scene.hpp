#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "samara/base/linear_algebra.hpp"

namespace samara {

/// A uniform flow that swings: amplitude sin(2 pi t / period), world axes.
struct Gust {
    Vector3d amplitude = Vector3d::Zero();  ///< m/s
    double period = 1.0;                    ///< s
};

/// The fluid: incompressible and Newtonian, at rest but for a uniform current and gust.
struct Fluid {
    double density = 998.2;               ///< kg/m^3
    double viscosity = 1.002e-3;          ///< dynamic, Pa s
    Vector3d current = Vector3d::Zero();  ///< m/s, world axes
    Gust gust = {};

    [[nodiscard]] double kinematic_viscosity() const { return viscosity / density; }
};

/// The fluid of that name (water or air, at 20 degrees Celsius and 101325 Pa), or nothing.
std::optional<Fluid> fluid_preset(const std::string& name);

enum class Loads { none, coefficients, table };
enum class Turbulence { none, constant, table };
enum class Langevin { seen_fluid, body_velocity };
/// Whose coefficients give the loads of a body in motion beyond those of a steady tow: the body file's, or
/// the defaults where it has none; the defaults; none.
enum class Dynamic { of_body, by_default, none };

/// What a scene says of the paper's eq. 5; what is absent is taken from the body (docs/theory).
struct CoefficientLoads {
    double drag_coefficient = 1.0;
    double lift_coefficient = 0.0;
    std::optional<double> reference_area;  ///< m^2; default: the area projected along the direction of motion
    std::optional<Vector3d> normal;        ///< shape axes; default: the axis of the body's shortest extent
    Vector3d center_of_pressure = Vector3d::Zero();  ///< m from the centroid of the volume, shape axes
};

/// A body's mass: of uniform density, or given by its total, its centre and its inertia.
struct MassSpecification {
    std::optional<double> density;           ///< kg/m^3
    std::optional<double> mass;              ///< kg
    std::optional<Vector3d> center_of_mass;  ///< m, shape axes; default: the centroid of the volume
    std::optional<Matrix3d> inertia;  ///< kg m^2 about the centre of mass, shape axes; default: as if uniform
};

/// One [[body]] of a scene.
struct SceneBody {
    std::string name;
    std::filesystem::path shape;  ///< a shape file or a .body.h5, as found from the scene file's folder
    double scale = 1.0;           ///< metres for one unit of the shape file
    MassSpecification mass;
    Vector3d position = Vector3d::Zero();               ///< of the shape file's origin (m, world)
    Quaterniond orientation = Quaterniond::Identity();  ///< shape axes to world
    Vector3d velocity = Vector3d::Zero();               ///< of the centre of mass (m/s, world)
    Vector3d angular_velocity = Vector3d::Zero();       ///< rad/s, world
    double start = 0.0;                                 ///< s: held in place until then
    int count = 1;
    Vector3d spread_position =
        Vector3d::Zero();       ///< m: copies start within +- this of `position`, each axis uniform
    double spread_angle = 0.0;  ///< rad: copies are turned by up to this about a random axis
    bool models_auto = false;   ///< what the model advice says is to be flown (simulation/model_advice.hpp)
    Loads loads = Loads::table;
    std::optional<double> table_reynolds_number;  ///< at which alone tables are read
    bool added_mass = true;  ///< whether the fluid's inertia K_fluid is part of the body's
    Dynamic dynamic = Dynamic::of_body;
    CoefficientLoads coefficients;
    Turbulence turbulence = Turbulence::table;  ///< default: table where the loads are, else none
    double turbulent_kinetic_energy = 0.0;      ///< m^2/s^2, where turbulence is constant
    double dissipation_rate = 0.0;              ///< m^2/s^3, where turbulence is constant
    Langevin langevin = Langevin::seen_fluid;
};

/// A scene file, checked: every number is finite and in its range.
struct Scene {
    double duration = 0.0;     ///< s
    double step = 0.002;       ///< s
    double frame_rate = 60.0;  ///< frames per second
    std::uint64_t seed = 1;
    Vector3d gravity = Vector3d(0.0, 0.0, -9.81);  ///< m/s^2
    std::optional<double> ground;                  ///< m: the height of level ground
    Fluid fluid;
    std::vector<SceneBody> bodies;
    std::string text;            ///< the file as it was read
    std::filesystem::path file;  ///< where it was read from
};

}  // namespace samara
