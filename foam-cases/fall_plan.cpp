#include "foam-cases/fall_plan.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

namespace samara {
namespace {

// Euler's scheme takes a new acceleration at most 2/(1 + ratio) at a time; three quarters of that leaves room for what
// the mesh adds.
constexpr double share_of_stable_relaxation = 0.75;
constexpr double most_relaxation = 0.7;

// Measured with pimpleFoam v1912, one outer and two pressure correctors, on meshes of 19,000 and 58,000 cells.
constexpr double seconds_per_cell_and_step = 2.7e-6;

// In case axes, right-handed; those of the case themselves where the inertia has no others.
void take_inertia(const Matrix3d& inertia, FreeFall& fall) {
    const Vector3d moments = inertia.diagonal();
    if ((inertia - Matrix3d(moments.asDiagonal())).norm() <= 1e-9 * inertia.norm()) {
        fall.principal_moments = moments;
        return;
    }
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(inertia);
    fall.principal_axes = solver.eigenvectors();
    if (fall.principal_axes.determinant() < 0.0) fall.principal_axes.col(0) *= -1.0;
    fall.principal_moments = solver.eigenvalues();
}

// Where gravity points at the start, along the principal axes from the shortest extent to the longest.
constexpr double start_directions[][3] = {{-0.64, 0.5, 0.58}, {-0.85, -0.45, 0.27}, {-0.35, 0.8, -0.48}};

}  // namespace

double largest_inertia_ratio(const ImmersedBody& body) {
    Matrix6d own = Matrix6d::Zero();
    own.topLeftCorner<3, 3>() = body.own_inertia;
    own.bottomRightCorner<3, 3>() = body.mass * Matrix3d::Identity();
    const Matrix6d fluid = body.inertia - own;
    return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6d>(fluid, own).eigenvalues().maxCoeff();
}

FreeFall plan_fall(const Body& body, const ImmersedBody& immersed, const BodyState& start, const Vector3d& gravity,
                   double speed, double duration) {
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
    fall.velocity = to_case * start.velocity.tail<3>() / speed;
    fall.angular_velocity = to_case * start.velocity.head<3>() * time_unit;
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
    start.orientation = Quaterniond::FromTwoVectors(gravity, -Vector3d::UnitZ());
    return start;
}

void add_falls(const Body& body, const Fluid& fluid, const MassSpecification& mass, double gravity, double speed,
               BakePlan& plan) {
    SceneBody scene_body;
    scene_body.name = body.name;
    scene_body.mass = mass;
    scene_body.loads = Loads::none;
    scene_body.turbulence = Turbulence::none;
    const ImmersedBody immersed = make_immersed_body(body, scene_body, fluid);
    const double duration = identification_fall_duration * plan.reference_length / speed;
    for (int i = 0; i < plan.quality.falls; ++i) {
        FreeFall fall = plan_fall(body, immersed, identification_start(body, i), gravity * -Vector3d::UnitZ(), speed,
                                  duration);
        fall.name = fmt::format("fall_{:02}", i);
        fall.mesh = plan.quality.meshes.at(plan.quality.fall_mesh).name;
        plan.falls.push_back(fall);
    }
    plan.cpu_seconds = 0.0;
    estimate_cost(plan);
}

BakePlan plan_single_fall(const Body& body, double cells, FreeFall fall) {
    BakePlan plan = plan_of_meshes(body, bake_quality("high"));
    const auto distance = [&](double count) { return std::abs(std::log(count / cells)); };
    const auto nearest = std::ranges::min_element(plan.cells, {}, distance) - plan.cells.begin();
    const FlowMesh mesh = plan.quality.meshes[static_cast<std::size_t>(nearest)];
    plan.quality.name = "fall";
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
