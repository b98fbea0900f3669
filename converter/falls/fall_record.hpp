#pragma once

#include <filesystem>
#include <vector>

#include "converter/falls/free_fall.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/integrator/step.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// The state of the body and the fluid's loads on it at the end of one step of a free fall, in the units and
/// axes of its case.
struct FallSample {
    double time = 0.0;
    Vector3d position = Vector3d::Zero();      ///< of the centre of mass
    Matrix3d rotation = Matrix3d::Identity();  ///< since the start
    Vector3d velocity = Vector3d::Zero();      ///< of the centre of mass
    Vector3d angular_velocity = Vector3d::Zero();
    Vector3d force = Vector3d::Zero();   ///< by the fluid, without buoyancy
    Vector3d moment = Vector3d::Zero();  ///< about the centre of mass
};

/// A free fall that was solved.
struct FallRecord {
    FreeFall fall;
    std::vector<FallSample> samples;  ///< by ascending time
};

/// Reads fall.json and the output of the function objects `state` and `forces` in the fall's folder. Throws
/// Error where a file is missing or damaged, where states, forces and moments do not all reach from the start
/// to the fall's end without a gap, and where a value is too large for any fall.
FallRecord read_fall_record(const std::filesystem::path& folder);

/// The residuals of a fall's momentum balance: how far the rates of change of the momenta are from loads,
/// weight and buoyancy, as root mean squares over the samples without the first half of a time unit, in which
/// the jolt of the start decays. They are about as large as the solver's error in time; a solver that drops
/// the gyroscopic term, or a fall that diverges, shows in them. Zero where there are fewer than three
/// samples.
struct FallBalance {
    double force = 0.0;  ///< relative to the fluid's force or, where it is larger, weight less buoyancy
    /// Relative to the largest of the fluid's moment, the gyroscopic term, the buoyancy's moment, and the
    /// force times an arm of L/100, below which a moment is negligible.
    double moment = 0.0;
};

/// Computes the momentum balance of a fall.
FallBalance balance_of(const FallRecord& record);

/// The limits above which a fall gets a warning that its momenta do not balance: twice the worst of ten falls
/// by kEpsilon (docs/explanation/full-cfd.md).
inline constexpr FallBalance largest_good_balance = {0.05, 0.15};

/// Whether either residual exceeds largest_good_balance.
bool is_unbalanced(const FallBalance& balance);

/// Returns the body of a solved fall as the runtime simulates it with the models, but without noise: by
/// default with loads by its tables. Its dynamic coefficients are its own, or the default ones. Throws Error
/// where the fall is of a body of another size.
ImmersedBody falling_body(const Body& body, const FreeFall& fall, const RecommendedModels& models = {});

/// Returns the fall's states in SI units, the first at its start with the velocities of fall.json. The
/// world's axes are the body's (shape) axes at the start, and its origin the centre of mass there.
std::vector<BodyState> states_of(const FallRecord& record);

/// Returns the fall's gravity (m/s^2) in the world axes of states_of().
Vector3d gravity_of(const FreeFall& fall);

/// Returns states at even times as a motion of the body, to be measured.
Motion motion_of(const Body& body, const Vector3d& gravity, double interval,
                 const std::vector<BodyState>& states);

}  // namespace samara
