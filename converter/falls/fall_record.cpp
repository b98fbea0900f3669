#include "converter/falls/fall_record.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "converter/cases/case_plan.hpp"
#include "converter/cases/load_fluctuations.hpp"
#include "converter/openfoam/foam_history.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/simulation/world_pose.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {
namespace {

Vector3d vector_at(const FoamHistory& history, std::size_t row, std::size_t first) {
    const std::vector<double>& values = history.rows[row];
    return {values[first], values[first + 1], values[first + 2]};
}

// Returns the rotation of OpenFOAM's eulerAngles(XYZ).
Matrix3d rotation_of(const Vector3d& angles) {
    using Rotation = Eigen::AngleAxisd;
    return (Rotation(angles.x(), Vector3d::UnitX()) * Rotation(angles.y(), Vector3d::UnitY()) *
            Rotation(angles.z(), Vector3d::UnitZ()))
        .toRotationMatrix();
}

// In units of L/U: the jolt of a body released in fluid at rest has decayed by then.
constexpr double longest_jolt = 0.5;
// In units of L: the moment of the force with a smaller arm is negligible, such as the noise of the moment on
// a sphere.
constexpr double least_arm = 0.01;

// In the case's units: a fall has diverged at a speed of 10, its angular velocity stays below 100, and fluid
// that is accelerated within one short step reacts with a force of some hundred.
constexpr double largest_value = 1e4;

Error damaged(const std::filesystem::path& folder, const std::string& what) {
    return Error(fmt::format("{}: {}; the fall's history is damaged: remove that folder and run again",
                             folder.string(), what));
}

// Throws unless states, forces and moments are of the same times, in even steps to the fall's end.
void require_whole(const std::filesystem::path& folder, const FreeFall& fall, const FoamHistory& state,
                   const LoadHistory& loads) {
    const double same = 1e-6 * fall.duration;
    const std::size_t rows = state.rows.size();
    const std::size_t shortest = std::min({rows, loads.force.times.size(), loads.moment.times.size()});
    double longest_step = 0.0;
    for (std::size_t i = 0; i < shortest; ++i) {
        const double time = state.rows[i].front();
        if (std::abs(time - loads.force.times[i]) > same || std::abs(time - loads.moment.times[i]) > same) {
            throw damaged(
                folder, fmt::format("its states, forces and moments have different times at {:.10g}", time));
        }
        const double before = i == 0 ? 0.0 : state.rows[i - 1].front();
        longest_step = std::max(longest_step, time - before);
        if (time - before > fall.time_step * (1.0 + 1e-3) + same) {
            throw damaged(
                folder, fmt::format("it has no values between the times {:.10g} and {:.10g}", before, time));
        }
    }
    const double end = shortest == 0 ? 0.0 : state.rows[shortest - 1].front();
    const std::size_t longest = std::max({rows, loads.force.times.size(), loads.moment.times.size()});
    if (end < fall.duration - 1.5 * longest_step || shortest < longest) {
        throw damaged(
            folder, fmt::format("its states, forces or moments end at the time {:.10g}, not at {:.10g}", end,
                                fall.duration));
    }
}

// Returns the rate of change of a vector at sample i, by central differences.
template <typename Quantity>
Vector3d rate(const std::vector<FallSample>& samples, std::size_t i, Quantity quantity) {
    const FallSample& before = samples[i - 1];
    const FallSample& after = samples[i + 1];
    return (quantity(after) - quantity(before)) / (after.time - before.time);
}

}  // namespace

FallRecord read_fall_record(const std::filesystem::path& folder) {
    FallRecord record;
    require_links_within(folder / "postProcessing");
    record.fall = read_free_fall(folder);
    const FoamHistory state = read_joined_history(folder / "postProcessing/state", "sixDoFRigidBodyState");
    const LoadHistory loads = read_load_history(folder / "postProcessing/forces");
    const std::size_t position = state.index("centreOfMass_x");
    const std::size_t angles = state.index("rotation_x");
    const std::size_t velocity = state.index("velocity_x");
    const std::size_t angular_velocity = state.index("omega_x");
    require_whole(folder, record.fall, state, loads);
    record.samples.resize(state.rows.size());
    for (std::size_t i = 0; i < record.samples.size(); ++i) {
        FallSample& sample = record.samples[i];
        sample.time = state.rows[i].front();
        sample.position = vector_at(state, i, position);
        const Vector3d angle = vector_at(state, i, angles);
        // The solver's rotation is that of the principal axes.
        sample.rotation = rotation_of(angle) * record.fall.principal_axes.transpose();
        sample.velocity = vector_at(state, i, velocity);
        sample.angular_velocity = vector_at(state, i, angular_velocity);
        sample.force = loads.force.values[i];
        sample.moment = loads.moment.values[i] - sample.position.cross(sample.force);
        for (const Vector3d& value : {sample.position, angle, sample.velocity, sample.angular_velocity,
                                      sample.force, sample.moment}) {
            if (value.norm() < largest_value) continue;
            throw damaged(folder, fmt::format("a state, force or moment at the time {:.10g} has the "
                                              "magnitude {:.3g}, above the largest plausible value",
                                              sample.time, value.norm()));
        }
    }
    return record;
}

bool is_unbalanced(const FallBalance& balance) {
    return balance.force > largest_good_balance.force || balance.moment > largest_good_balance.moment;
}

FallBalance balance_of(const FallRecord& record) {
    const FreeFall& fall = record.fall;
    const std::vector<FallSample>& samples = record.samples;
    if (samples.size() < 3) return {};
    const Matrix3d inertia = fall.inertia();
    const auto spin = [&](const FallSample& sample) -> Vector3d {
        return sample.rotation * (inertia * (sample.rotation.transpose() * sample.angular_velocity));
    };
    const auto velocity = [](const FallSample& sample) -> Vector3d { return sample.velocity; };
    const Vector3d weight = (fall.mass - fall.volume) * fall.gravity;
    const double settled = std::min(longest_jolt, 0.25 * samples.back().time);
    // Sums of squares.
    double force_residual = 0.0;
    double force = 0.0;
    double moment_residual = 0.0;
    double moment = 0.0;
    double gyroscopic = 0.0;
    double of_weights = 0.0;
    double of_buoyancies = 0.0;
    for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
        const FallSample& sample = samples[i];
        if (sample.time < settled) continue;
        const Vector3d acceleration = rate(samples, i, velocity);
        force_residual += (fall.mass * acceleration - weight - sample.force).squaredNorm();
        force += sample.force.squaredNorm();
        of_weights += weight.squaredNorm();
        // The arm of the buoyancy is from the centre of mass to the centroid, and its direction opposite to
        // gravity.
        const Vector3d of_buoyancy =
            (sample.rotation * fall.center_of_mass).cross(fall.volume * fall.gravity);
        moment_residual += (rate(samples, i, spin) - of_buoyancy - sample.moment).squaredNorm();
        moment += sample.moment.squaredNorm();
        of_buoyancies += of_buoyancy.squaredNorm();
        gyroscopic += sample.angular_velocity.cross(spin(sample)).squaredNorm();
    }
    const auto ratio = [](double residual, double scale) {
        return scale > 0.0 ? std::sqrt(residual / scale) : 0.0;
    };
    const double force_scale = std::max(force, of_weights);
    return {ratio(force_residual, force_scale),
            ratio(moment_residual,
                  std::max({moment, gyroscopic, of_buoyancies, least_arm * least_arm * force_scale}))};
}

ImmersedBody falling_body(const Body& body, const FreeFall& fall, const RecommendedModels& models) {
    const double length = reference_length(body.moments.surface_area);
    if (std::abs(length - fall.length) > 1e-6 * length) {
        throw Error(
            fmt::format("{}: the fall belongs to another body than {}: its length L is {:.6g} m, not {:.6g} "
                        "m; give falls of this body",
                        fall.name, body.name, fall.length, length));
    }
    const double mass_unit = fall.fluid_density * length * length * length;
    BodyPhysics physics;
    physics.mass.mass = fall.mass * mass_unit;
    physics.mass.center_of_mass = body.moments.centroid + length * (fall.axes * fall.center_of_mass);
    physics.mass.inertia =
        mass_unit * length * length * (fall.axes * fall.inertia() * fall.axes.transpose()).eval();
    physics.loads = models.loads;
    physics.patches = models.patches;
    physics.turbulence = Turbulence::none;
    Fluid fluid;
    fluid.density = fall.fluid_density;
    fluid.viscosity = fall.speed * length * fall.fluid_density / fall.reynolds_number;
    return make_immersed_body(body, physics, fluid, body.name);
}

std::vector<BodyState> states_of(const FallRecord& record) {
    const FreeFall& fall = record.fall;
    const Matrix3d& axes = fall.axes;
    const auto state = [&](const Vector3d& position, const Matrix3d& rotation, const Vector3d& velocity,
                           const Vector3d& angular_velocity) {
        BodyState one;
        one.position = fall.length * (axes * (position - fall.center_of_mass));
        one.orientation = Quaterniond(axes * rotation * axes.transpose());
        one.velocity << axes * (rotation.transpose() * angular_velocity) / fall.time_unit(),
            axes * (rotation.transpose() * velocity) * fall.speed;
        return one;
    };
    std::vector<BodyState> states = {
        state(fall.center_of_mass, Matrix3d::Identity(), fall.velocity, fall.angular_velocity)};
    for (const FallSample& sample : record.samples) {
        states.push_back(state(sample.position, sample.rotation, sample.velocity, sample.angular_velocity));
    }
    return states;
}

Vector3d gravity_of(const FreeFall& fall) {
    return fall.axes * fall.gravity * fall.speed / fall.time_unit();
}

Motion motion_of(const Body& body, const Vector3d& gravity, double interval,
                 const std::vector<BodyState>& states) {
    Motion motion;
    motion.gravity = gravity;
    motion.frame_rate = 1.0 / interval;
    BodyMotion& one = motion.bodies.emplace_back();
    one.name = body.name;
    one.shortest_axis = principal_axes(body.moments).col(0);
    for (std::size_t i = 0; i < states.size(); ++i) {
        motion.times.push_back(static_cast<double>(i) * interval);
        one.poses.push_back(flow_pose(states[i]));
    }
    return motion;
}

}  // namespace samara
