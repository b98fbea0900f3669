#include "synthetic_fall.hpp"

#include <cmath>

#include "converter/falls/fall_record.hpp"
#include "support/known_bodies.hpp"

namespace samara::test {
namespace {

constexpr double speed = 0.23;
constexpr double relative_density = 1.2;
constexpr int substeps = 5;

}  // namespace

Body ellipsoid_with_tables() {
    Body body = rubber_ellipsoid();
    body.tables = blunt_tables(body, 4);
    return body;
}

FreeFall oblique_fall(const Body& body, double duration) {
    FreeFall fall;
    fall.length = reference_length(body.moments.surface_area);
    fall.speed = speed;
    fall.fluid_density = 1000.0;
    fall.reynolds_number = speed * fall.length / 1e-6;
    fall.axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    fall.volume = body.moments.volume / std::pow(fall.length, 3.0);
    fall.mass = relative_density * fall.volume;
    fall.center_of_mass = {0.01, -0.005, 0.008};
    fall.principal_axes = fall.axes.transpose();
    fall.principal_moments =
        uniform_inertia(body.moments, relative_density).diagonal() / std::pow(fall.length, 5.0);
    const Vector3d down = Vector3d(-0.64, 0.5, 0.58).normalized();
    fall.gravity = fall.axes.transpose() * down * 9.81 * fall.length / (speed * speed);
    fall.duration = duration;
    fall.time_step = 0.01;
    return fall;
}

FallSample sample_of(const FreeFall& fall, double time, const BodyState& state) {
    const Matrix3d to_case = fall.axes.transpose();
    FallSample sample;
    sample.time = time;
    sample.position = fall.center_of_mass + to_case * state.position / fall.length;
    sample.rotation = to_case * state.orientation.toRotationMatrix() * fall.axes;
    sample.angular_velocity = sample.rotation * to_case * state.velocity.head<3>() * fall.time_unit();
    sample.velocity = sample.rotation * to_case * state.velocity.tail<3>() / fall.speed;
    return sample;
}

FallRecord record_of(const Body& body, const FreeFall& fall, const DynamicCoefficients& coefficients) {
    ImmersedBody immersed = falling_body(body, fall);
    immersed.dynamic = coefficients;
    prepare(immersed);
    FallRecord record;
    record.fall = fall;
    BodyState state = states_of(record).front();
    Vector6d momenta;
    momenta << immersed.own_inertia * state.velocity.head<3>(), immersed.mass * state.velocity.tail<3>();
    state.velocity = immersed.inverse_inertia * momenta;
    const Vector3d gravity = fall.axes * fall.gravity * fall.speed / fall.time_unit();
    const double step = fall.time_step * fall.time_unit() / substeps;
    const auto samples = static_cast<int>(std::lround(fall.duration / fall.time_step));
    for (int i = 1; i <= samples; ++i) {
        for (int j = 0; j < substeps; ++j) state = implicit_step(immersed, gravity, step, state);
        record.samples.push_back(sample_of(fall, i * fall.time_step, state));
    }
    return record;
}

}  // namespace samara::test
