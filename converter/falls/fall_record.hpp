#pragma once

#include <filesystem>
#include <vector>

#include "converter/falls/free_fall.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/integrator/step.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// The body and the fluid's hold on it at the end of one step of a free fall, in the units and axes of its
/// case.
struct FallSample {
    double time = 0.0;
    Vector3d position = Vector3d::Zero();  ///< of the centre of mass
    Matrix3d turn = Matrix3d::Identity();  ///< since the start
    Vector3d velocity = Vector3d::Zero();  ///< of the centre of mass
    Vector3d angular_velocity = Vector3d::Zero();
    Vector3d force = Vector3d::Zero();   ///< of the fluid, without buoyancy
    Vector3d moment = Vector3d::Zero();  ///< about the centre of mass
};

/// A free fall that was solved.
struct FallRecord {
    FreeFall fall;
    std::vector<FallSample> samples;  ///< times ascend
};

/// Reads fall.json and what the function objects `state` and `forces` wrote in the fall's folder. Throws
/// Error where a file is missing or damaged, where states, forces and moments do not all reach from the start
/// to the fall's end without a gap, and where a value is beyond any fall's.
FallRecord read_fall_record(const std::filesystem::path& folder);

/// How far the momenta of a fall are from what the loads, weight and buoyancy give: root mean squares over
/// the samples but for the first half of a time unit, in which the start's jolt dies away. About the size of
/// the solver's error in time; a solver that drops the gyroscopic term, or a fall that blows up, shows in it.
/// Zero where there are less than three samples.
struct FallBalance {
    double force = 0.0;  ///< over the fluid's force or, where it is larger, weight less buoyancy
    /// Over the largest of the fluid's moment, the gyroscopic term, the buoyancy's moment, and the force's
    /// with an arm of L/100, below which a moment turns nothing.
    double moment = 0.0;
};
FallBalance balance_of(const FallRecord& record);

/// Above these the momenta of a fall are said not to balance: twice the worst of ten falls by kEpsilon
/// (docs/validate.md).
inline constexpr FallBalance doubtful_balance = {0.05, 0.15};

/// Whether either is above that.
bool is_doubtful(const FallBalance& balance);

/// The body of a solved fall as the runtime flies it: loads by its tables and the dynamic coefficients it
/// has, or the default ones. Throws Error where the fall is of a body of another size.
ImmersedBody falling_body(const Body& body, const FreeFall& fall);

/// The fall's states, the first at its start with the velocities of fall.json, in SI units; the world's axes
/// are the body's (shape) axes at the start, and its origin the centre of mass there.
std::vector<BodyState> states_of(const FallRecord& record);

/// The fall's gravity (m/s^2) in the same axes.
Vector3d gravity_of(const FreeFall& fall);

/// States at even times as a motion of the body, for measures.
Motion motion_of(const Body& body, const Vector3d& gravity, double interval,
                 const std::vector<BodyState>& states);

}  // namespace samara
