#include "foam-cases/falls/fall_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <fmt/format.h>

#include "internal/base/symmetric_matrix.hpp"
#include "internal/base/turn.hpp"
#include "internal/flight/terminal_speed.hpp"

namespace samara {
namespace {

// The fluid answers an acceleration with a force of `ratio` times the body's own inertia against it. Where a
// step takes the share s of the acceleration that this force gives, an error grows by 1 - s (1 + ratio): it
// dies out where s is below 2/(1 + ratio). Three quarters of that leaves room for what the mesh adds to the
// added mass.
constexpr double share_of_stable_relaxation = 0.75;
// The most where the body is so heavy that the above allows more: what takes the whole of it passes on every
// jolt of the pressure.
constexpr double most_relaxation = 0.7;

// A body whose mass differs less from that of the fluid it displaces floats; over the latter.
// A centre of mass that is nearer to the centroid is there but for rounding; over L.
constexpr double negligible_arm = 1e-9;

// Measured with pimpleFoam v1912, one outer and two pressure correctors, on meshes of 19,000 and 58,000
// cells.
constexpr double seconds_per_cell_and_step = 2.7e-6;

// The same axes in the order and with the signs that turn them least from the case's: right-handed. The
// solver writes where the body is as angles about x, y and z, which tell nothing where its axes start a
// quarter turn off about y.
Matrix3d least_turned(const Matrix3d& axes) {
    Matrix3d best = axes;
    double best_trace = -std::numeric_limits<double>::infinity();
    std::array<int, 3> order = {0, 1, 2};
    do {
        Matrix3d candidate;
        for (int i = 0; i < 3; ++i) {
            const Vector3d axis = axes.col(order[static_cast<std::size_t>(i)]);
            candidate.col(i) = axis[i] < 0.0 ? Vector3d(-axis) : axis;
        }
        if (candidate.determinant() < 0.0) {
            int smallest = 0;
            candidate.diagonal().minCoeff(&smallest);
            candidate.col(smallest) *= -1.0;
        }
        if (candidate.trace() > best_trace) {
            best = candidate;
            best_trace = candidate.trace();
        }
    } while (std::ranges::next_permutation(order).found);
    return best;
}

// The inertia is in case axes, which are its principal axes where it has no others.
void take_inertia(const Matrix3d& inertia, FreeFall& fall) {
    const Vector3d moments = inertia.diagonal();
    if ((inertia - Matrix3d(moments.asDiagonal())).norm() <= 1e-9 * inertia.norm()) {
        fall.principal_moments = moments;
        return;
    }
    fall.principal_axes = least_turned(principal_values(inertia).directions);
    fall.principal_moments = (fall.principal_axes.transpose() * inertia * fall.principal_axes).diagonal();
}

// Where gravity points at the start, along the principal axes from the shortest extent to the longest.
constexpr double start_directions[][3] = {{-0.86, 0.27, 0.433}, {-0.64, 0.5, 0.58}, {-0.35, 0.8, -0.48}};

}  // namespace

double largest_inertia_ratio(const ImmersedBody& body) {
    Matrix6d own = Matrix6d::Zero();
    own.topLeftCorner<3, 3>() = body.own_inertia;
    own.bottomRightCorner<3, 3>() = body.mass * Matrix3d::Identity();
    const Matrix6d fluid = body.inertia - own;
    return eigenvalues_of(fluid, own).maxCoeff();
}

double fall_speed(const Body& body, const ImmersedBody& immersed, const BodyState& start, const Fluid& fluid,
                  double gravity) {
    double speed =
        std::max(start.velocity.tail<3>().norm(), 0.5 * immersed.length * start.velocity.head<3>().norm());
    if (gravity == 0.0) return speed;
    const double buoyant_mass = immersed.fluid_density * immersed.volume;
    speed = std::max(speed, terminal_speed(body, fluid, immersed.mass, gravity));
    const double arm = immersed.center_of_buoyancy.norm();
    if (arm <= negligible_arm * immersed.length) return speed;
    // The fastest of small swings: buoyancy turns the body about axes across its arm.
    const Vector3d along = immersed.center_of_buoyancy / arm;
    const Matrix3d across = Matrix3d::Identity() - along * along.transpose();
    const Matrix3d mobility = across * immersed.inverse_inertia.topLeftCorner<3, 3>() * across;
    const double largest = eigenvalues_of(mobility).maxCoeff();
    return std::max(speed, immersed.length * std::sqrt(buoyant_mass * gravity * arm * largest));
}

FreeFall plan_fall(const Body& body, const ImmersedBody& immersed, const BodyState& start,
                   const Vector3d& gravity, double speed, double duration) {
    FreeFall fall;
    const double length = reference_length(body.moments.surface_area);
    const double time_unit = length / speed;
    const double volume_unit = length * length * length;
    const Matrix3d to_case = body.symmetry.axes.transpose();
    const Matrix3d to_body = start.orientation.toRotationMatrix().transpose();
    fall.length = length;
    fall.speed = speed;
    fall.fluid_density = immersed.fluid_density;
    fall.axes = body.symmetry.axes;
    fall.reynolds_number = speed * length * immersed.fluid_density / immersed.viscosity;
    fall.closure = closure_at(fall.reynolds_number);
    fall.volume = immersed.volume / volume_unit;
    fall.mass = immersed.mass / (immersed.fluid_density * volume_unit);
    fall.center_of_mass = to_case * -immersed.center_of_buoyancy / length;
    take_inertia(to_case * immersed.own_inertia * to_case.transpose() /
                     (immersed.fluid_density * volume_unit * length * length),
                 fall);
    fall.gravity = to_case * to_body * gravity * time_unit / speed;
    const Vector6d momentum = immersed.inertia * start.velocity;
    fall.velocity = to_case * momentum.tail<3>() / immersed.mass / speed;
    fall.angular_velocity = to_case * immersed.own_inertia.inverse() * momentum.head<3>() * time_unit;
    fall.duration = duration / time_unit;
    fall.time_step = fall_time_step;
    fall.acceleration_relaxation =
        std::min(most_relaxation, share_of_stable_relaxation * 2.0 / (1.0 + largest_inertia_ratio(immersed)));
    return fall;
}

BodyState identification_start(const Body& body, int index) {
    const auto& direction = start_directions[static_cast<std::size_t>(index) % std::size(start_directions)];
    const Vector3d gravity =
        principal_axes(body.moments) * Vector3d(direction[0], direction[1], direction[2]).normalized();
    BodyState start;
    start.orientation = turn_between(gravity, -Vector3d::UnitZ());
    return start;
}

void add_falls(const Body& body, const Fluid& fluid, const MassSpecification& mass, double gravity,
               double speed, BakePlan& plan) {
    BodyPhysics physics;
    physics.mass = mass;
    physics.loads = Loads::none;
    physics.turbulence = Turbulence::none;
    const ImmersedBody immersed = make_immersed_body(body, physics, fluid, body.name);
    const double duration = identification_fall_duration * plan.reference_length / speed;
    for (int i = 0; i < plan.quality.falls; ++i) {
        FreeFall fall = plan_fall(body, immersed, identification_start(body, i), gravity * -Vector3d::UnitZ(),
                                  speed, duration);
        fall.name = fmt::format("fall_{:02}", i);
        fall.mesh = plan.quality.meshes.at(plan.quality.fall_mesh).name;
        fall.closure = closure_at(fall.reynolds_number, plan.quality.loads_closure);
        plan.falls.push_back(fall);
    }
    estimate_cost(plan);
}

BakePlan plan_single_fall(const Body& body, double cells, FreeFall fall) {
    BakePlan plan = plan_of_meshes(body, bake_quality("high"));
    const auto distance = [&](double count) { return std::abs(std::log(count / cells)); };
    const auto nearest = std::ranges::min_element(plan.cells, {}, distance) - plan.cells.begin();
    const FlowMesh mesh = plan.quality.meshes[static_cast<std::size_t>(nearest)];
    plan.kind = CaseKind::fall;
    plan.quality.meshes = {mesh};
    plan.cells = {plan.cells[static_cast<std::size_t>(nearest)]};
    fall.mesh = mesh.name;
    plan.falls = {fall};
    estimate_cost(plan);
    return plan;
}

double estimated_fall_seconds(const FreeFall& fall, double cells) {
    return seconds_per_cell_and_step * cells * fall.duration / fall.time_step;
}

}  // namespace samara
