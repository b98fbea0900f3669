#include "foam-cases/falls/fall_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/linear_algebra.hpp"
#include "samara/scene/terminal_speed.hpp"

namespace samara {
namespace {

// The largest share of a new acceleration where a heavy body would allow more, since the full acceleration
// would follow every jolt of the pressure.
constexpr double most_relaxation = 0.7;

// The used share of the stable limit; the rest is a margin for the error of the added mass by the mesh.
constexpr double stable_share = 0.85;

// A centre of mass nearer to the centroid (in L) coincides with it but for rounding.
constexpr double negligible_arm = 1e-9;

// CPU seconds, measured with pimpleFoam v1912, one outer and two pressure correctors: on a core of its
// own 2.7e-6 by k-epsilon, 3.7e-6 without a closure and 5e-6 by the others (docs/explanation/full-cfd.md).
// Two cores that other work shares take 1.46 times as long.
double seconds_per_cell_and_step(Closure closure) {
    constexpr double shared = 1.46;
    if (closure == Closure::k_epsilon) return shared * 2.7e-6;
    return shared * (closure == Closure::laminar ? 3.7e-6 : 5e-6);
}

// Returns whether all roots of a polynomial (coefficients from the highest power down) lie within the unit
// circle, by the criterion of Schur and Cohn.
bool roots_decay(std::vector<double> polynomial) {
    while (polynomial.size() > 1) {
        const double first = polynomial.front();
        const double last = polynomial.back();
        if (!(std::abs(last) < std::abs(first))) return false;
        std::vector<double> reduced(polynomial.size() - 1);
        for (std::size_t i = 0; i < reduced.size(); ++i) {
            reduced[i] = first * polynomial[i] - last * polynomial[polynomial.size() - 1 - i];
        }
        polynomial = std::move(reduced);
    }
    return true;
}

// Returns whether errors decay from step to step with this share and the scheme `backward` (see
// FallModel::acceleration_relaxation).
bool errors_decay(double share, double inertia_ratio) {
    const double reaction = 0.25 * share * inertia_ratio;
    return roots_decay({1.0, share - 1.0, 9.0 * reaction, -6.0 * reaction, reaction});
}

// Returns the largest share, up to one, with which errors decay.
double largest_stable_share(double inertia_ratio) {
    double stable = 0.0;
    double unstable = 1.0;
    if (errors_decay(unstable, inertia_ratio)) return unstable;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (stable + unstable);
        (errors_decay(middle, inertia_ratio) ? stable : unstable) = middle;
    }
    return stable;
}

// Permutes axes and chooses their signs so that the right-handed frame has the smallest rotation from the
// case's axes. The solver writes orientations as angles about x, y and z, which are singular at a rotation by
// 90 degrees about y.
Matrix3d nearest_frame(const Matrix3d& axes) {
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

// Stores principal axes and moments of the inertia (in case axes); the case axes themselves where it is
// diagonal.
void take_inertia(const Matrix3d& inertia, FreeFall& fall) {
    const Vector3d moments = inertia.diagonal();
    if ((inertia - Matrix3d(moments.asDiagonal())).norm() <= 1e-9 * inertia.norm()) {
        fall.principal_moments = moments;
        return;
    }
    fall.principal_axes = nearest_frame(principal_values(inertia).directions);
    fall.principal_moments = (fall.principal_axes.transpose() * inertia * fall.principal_axes).diagonal();
}

// Returns the inertia of the body without the fluid, about its centre of mass.
Matrix6d own_inertia_of(const ImmersedBody& body) {
    Matrix6d own = Matrix6d::Zero();
    own.topLeftCorner<3, 3>() = body.own_inertia;
    own.bottomRightCorner<3, 3>() = body.mass * Matrix3d::Identity();
    return own;
}

// Returns the initial velocity of a body in fluid at rest that has `velocity` once the fluid has taken its
// share of the momenta. With `backward` the body provides half of a jump in the first step, which is of first
// order, unlike the following ones.
Vector6d velocity_before_fluid_moves(const ImmersedBody& body, const Vector6d& velocity,
                                     const FallModel& model) {
    const Matrix6d own = own_inertia_of(body);
    const Matrix6d left = model.resolved ? Matrix6d(0.5 * (body.inertia + own)) : own;
    return left.lu().solve(body.inertia * velocity);
}

// Directions of gravity at the start, along the principal axes from the shortest extent to the longest.
constexpr double start_directions[][3] = {{-0.86, 0.27, 0.433}, {-0.64, 0.5, 0.58}, {-0.35, 0.8, -0.48}};

constexpr const char* own_mesh = "mesh_falls";

std::string name_of_fall(std::size_t index) {
    return fmt::format("fall_{:02}", index);
}

/// Returns a plan with only the mesh for falls, of about that number of cells.
BakePlan plan_of_mesh_of_falls(const Body& body, double cells, double reynolds_number,
                               const FallModel& model) {
    BakeQuality quality = bake_quality("high");
    quality.meshes = meshes_of_falls(reynolds_number, model.resolved);
    BakePlan plan = plan_of_meshes(body, quality);
    const auto distance = [&](double count) { return std::abs(std::log(count / cells)); };
    const auto nearest = std::ranges::min_element(plan.cells, {}, distance) - plan.cells.begin();
    const FlowMesh mesh = plan.quality.meshes[static_cast<std::size_t>(nearest)];
    plan.quality.meshes = {mesh};
    plan.cells = {plan.cells[static_cast<std::size_t>(nearest)]};
    return plan;
}

}  // namespace

double largest_inertia_ratio(const ImmersedBody& body) {
    const Matrix6d own = own_inertia_of(body);
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
    // The fastest small oscillation: the moment of buoyancy is about axes perpendicular to its arm.
    const Vector3d along = immersed.center_of_buoyancy / arm;
    const Matrix3d across = Matrix3d::Identity() - along * along.transpose();
    const Matrix3d mobility = across * immersed.inverse_inertia.topLeftCorner<3, 3>() * across;
    const double largest = eigenvalues_of(mobility).maxCoeff();
    return std::max(speed, immersed.length * std::sqrt(buoyant_mass * gravity * arm * largest));
}

double FallModel::acceleration_relaxation(double inertia_ratio) const {
    // The fluid reacts to an acceleration with `inertia_ratio` times the body's own inertia, and a step
    // applies the share s of the resulting acceleration.
    if (!resolved) {
        // With an immediate reaction an error would change by the factor 1 - s (1 + ratio) in a step. Three
        // quarters of the stable limit leave a margin for the error of the added mass by the mesh.
        return std::min(most_relaxation, 0.75 * 2.0 / (1.0 + inertia_ratio));
    }
    // The reaction is a step late, and `backward` computes it from three velocities, each by two
    // accelerations: a_n = (1 - s) a_n-1 - s ratio (9 a_n-2 - 6 a_n-3 + a_n-4)/4. For light bodies that is
    // stable below s = 0.5/ratio, for others the limit is lower: a sheet of ratio 0.57 with s = 0.7 diverged.
    return std::min(
        {most_relaxation, 0.4 / inertia_ratio, stable_share * largest_stable_share(inertia_ratio)});
}

double FallModel::time_step(double inertia_ratio) const {
    if (!resolved) return 0.01;
    // Applying the share s of each new acceleration delays the body by step/(s (1 + ratio)): by 0.02 L/U at
    // most, a fortieth of a radian of an oscillation.
    constexpr double longest_delay = 0.02;
    return longest_delay * std::min(1.0, acceleration_relaxation(inertia_ratio) * (1.0 + inertia_ratio));
}

Closure closure_of_falls(const std::string& name) {
    for (const Closure closure : {Closure::k_omega_sst_lm, Closure::k_omega_sst, Closure::k_omega_sst_ddes,
                                  Closure::laminar, Closure::k_epsilon}) {
        if (name_of(closure) == name) return closure;
    }
    throw Error(fmt::format(
        "falls cannot be solved by '{}'; choose kOmegaSSTLM, kOmegaSST, kOmegaSSTDDES, laminar or kEpsilon",
        name));
}

FallModel fall_model_of(Closure closure) {
    const bool has_wall_functions = closure == Closure::k_epsilon ||
                                    closure == Closure::realizable_k_epsilon ||
                                    closure == Closure::rng_k_epsilon;
    return {closure, !has_wall_functions};
}

FreeFall plan_fall(const Body& body, const ImmersedBody& immersed, const BodyState& start,
                   const Vector3d& gravity, double speed, double duration, const FallModel& model) {
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
    fall.closure = closure_at(fall.reynolds_number, model.closure);
    fall.volume = immersed.volume / volume_unit;
    fall.mass = immersed.mass / (immersed.fluid_density * volume_unit);
    fall.center_of_mass = to_case * -immersed.center_of_buoyancy / length;
    take_inertia(to_case * immersed.own_inertia * to_case.transpose() /
                     (immersed.fluid_density * volume_unit * length * length),
                 fall);
    fall.gravity = to_case * to_body * gravity * time_unit / speed;
    const Vector6d velocity = velocity_before_fluid_moves(immersed, start.velocity, model);
    fall.velocity = to_case * velocity.tail<3>() / speed;
    fall.angular_velocity = to_case * velocity.head<3>() * time_unit;
    fall.duration = duration / time_unit;
    const double inertia_ratio = largest_inertia_ratio(immersed);
    fall.time_step = model.time_step(inertia_ratio);
    fall.acceleration_relaxation = model.acceleration_relaxation(inertia_ratio);
    return fall;
}

BodyState identification_start(const Body& body, int index) {
    const auto& direction = start_directions[static_cast<std::size_t>(index) % std::size(start_directions)];
    const Vector3d gravity =
        principal_axes(body.moments) * Vector3d(direction[0], direction[1], direction[2]).normalized();
    BodyState start;
    start.orientation = rotation_between(gravity, -Vector3d::UnitZ());
    return start;
}

bool has_time_to_fall(double speed, double length, double gravity) {
    constexpr double least_share = 0.1;
    return gravity * identification_fall_duration * length >= least_share * speed * speed;
}

void add_falls(const Body& body, const Fluid& fluid, const std::vector<MassSpecification>& masses,
               double gravity, BakePlan& plan) {
    for (const MassSpecification& mass : masses) {
        const double speed = bake_speed(body, fluid, mass_of(mass, body), gravity);
        if (gravity > 0.0 && !has_time_to_fall(speed, plan.reference_length, gravity)) plan.quality.falls = 0;
    }
    if (plan.quality.falls == 0) return;
    const FallModel model = fall_model_of(plan.quality.fall_closure);
    double reynolds_number = 0.0;
    for (int i = 0; i < plan.quality.falls; ++i) {
        BodyPhysics physics;
        physics.mass = masses.at(static_cast<std::size_t>(i) % masses.size());
        physics.loads = Loads::none;
        physics.turbulence = Turbulence::none;
        const ImmersedBody immersed = make_immersed_body(body, physics, fluid, body.name);
        const double speed = bake_speed(body, fluid, immersed.mass, gravity);
        const double duration = identification_fall_duration * plan.reference_length / speed;
        FreeFall fall = plan_fall(body, immersed, identification_start(body, i), gravity * -Vector3d::UnitZ(),
                                  speed, duration, model);
        fall.name = name_of_fall(static_cast<std::size_t>(i));
        fall.time_step *= plan.quality.fall_step;
        fall.mesh = own_mesh;
        reynolds_number = std::max(reynolds_number, fall.reynolds_number);
        plan.falls.push_back(fall);
    }
    const BakePlan of_falls = plan_of_mesh_of_falls(body, plan.quality.fall_cells, reynolds_number, model);
    plan.quality.fall_meshes = of_falls.quality.meshes;
    plan.quality.fall_meshes.front().name = own_mesh;
    plan.cells.push_back(of_falls.cells.front());
    estimate_cost(plan);
}

BakePlan plan_falls(const Body& body, double cells, std::vector<FreeFall> falls, const FallModel& model) {
    BakePlan plan = plan_of_mesh_of_falls(body, cells, falls.at(0).reynolds_number, model);
    plan.type = CaseType::fall;
    plan.falls = std::move(falls);
    for (std::size_t i = 0; i < plan.falls.size(); ++i) {
        plan.falls[i].name = name_of_fall(i);
        plan.falls[i].mesh = plan.quality.meshes.front().name;
    }
    estimate_cost(plan);
    return plan;
}

double estimated_fall_seconds(const FreeFall& fall, double cells) {
    return seconds_per_cell_and_step(fall.closure) * cells * fall.duration / fall.time_step;
}

}  // namespace samara
