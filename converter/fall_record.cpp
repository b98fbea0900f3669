#include "converter/fall_record.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "converter/foam_history.hpp"
#include "converter/load_history.hpp"
#include "samara/base/error.hpp"

namespace samara {
namespace {

Vector3d vector_at(const FoamHistory& history, std::size_t row, std::size_t first) {
    const std::vector<double>& values = history.rows[row];
    return {values[first], values[first + 1], values[first + 2]};
}

// OpenFOAM's eulerAngles(XYZ).
Matrix3d turn_of(const Vector3d& angles) {
    using Turn = Eigen::AngleAxisd;
    return (Turn(angles.x(), Vector3d::UnitX()) * Turn(angles.y(), Vector3d::UnitY()) *
            Turn(angles.z(), Vector3d::UnitZ()))
        .toRotationMatrix();
}

// Over L/U: the jolt of a body let go in fluid at rest has died away by then.
constexpr double longest_jolt = 0.5;
// Over L: with less than this as arm, a force turns no body that matters; what is smaller is noise of the
// pressure, as the moment on a sphere.
constexpr double least_arm = 0.01;

// The rate of change of a vector between the samples beside sample i.
template <typename Quantity>
Vector3d rate(const std::vector<FallSample>& samples, std::size_t i, Quantity quantity) {
    const FallSample& before = samples[i - 1];
    const FallSample& after = samples[i + 1];
    return (quantity(after) - quantity(before)) / (after.time - before.time);
}

}  // namespace

FallRecord read_fall_record(const std::filesystem::path& folder) {
    FallRecord record;
    record.fall = read_free_fall(folder);
    const FoamHistory state = read_joined_history(folder / "postProcessing/state", "sixDoFRigidBodyState");
    const LoadHistory loads = read_load_history(folder / "postProcessing/forces");
    const std::size_t position = state.index("centreOfMass_x");
    const std::size_t angles = state.index("rotation_x");
    const std::size_t velocity = state.index("velocity_x");
    const std::size_t angular_velocity = state.index("omega_x");
    const std::size_t rows = std::min(state.rows.size(), loads.force.times.size());
    record.samples.resize(rows);
    for (std::size_t i = 0; i < rows; ++i) {
        FallSample& sample = record.samples[i];
        sample.time = state.rows[i].front();
        if (std::abs(sample.time - loads.force.times[i]) > 1e-6 * record.fall.duration) {
            throw Error(fmt::format("{}: its states and forces are not of the same times", folder.string()));
        }
        sample.position = vector_at(state, i, position);
        // The solver turns the axes of its inertia.
        sample.turn = turn_of(vector_at(state, i, angles)) * record.fall.principal_axes.transpose();
        sample.velocity = vector_at(state, i, velocity);
        sample.angular_velocity = vector_at(state, i, angular_velocity);
        sample.force = loads.force.values[i];
        sample.moment = loads.moment.values[i] - sample.position.cross(sample.force);
    }
    return record;
}

FallBalance balance_of(const FallRecord& record) {
    const FreeFall& fall = record.fall;
    const std::vector<FallSample>& samples = record.samples;
    if (samples.size() < 3) return {};
    const Matrix3d inertia = fall.inertia();
    const auto spin = [&](const FallSample& sample) -> Vector3d {
        return sample.turn * (inertia * (sample.turn.transpose() * sample.angular_velocity));
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
        // The buoyancy's arm is from the centre of mass to the centroid, and it is opposed to gravity.
        const Vector3d of_buoyancy = (sample.turn * fall.center_of_mass).cross(fall.volume * fall.gravity);
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

}  // namespace samara
