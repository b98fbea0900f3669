#include "samara/dynamics/loads.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace samara {
namespace {

constexpr double smallest_speed =
    1e-200;  // below it a direction has no meaning, and the loads are zero anyway

TowLoad table_load(const ImmersedBody& body, const Vector3d& direction, double speed) noexcept {
    const LoadEntry entry = look_up(*body.tables, direction, reynolds_number(body, speed));
    const double scale = 0.5 * body.fluid_density * body.reference_area;
    return {scale * entry.force, scale * body.length * entry.moment};
}

/// Eq. 5: the drag -C_d A U, and a lift along N less its part along U, so that C_L = C_l sin 2 alpha: no
/// singularity where U is parallel to N, no jump where it is perpendicular, and the same for N and -N.
TowLoad coefficient_load(const ImmersedBody& body, const Vector3d& direction) noexcept {
    const CoefficientLoads& given = body.coefficients;
    const double area = given.reference_area ? *given.reference_area : body.projected_area.at(direction);
    const double along_normal = direction.dot(*given.normal);
    const Vector3d lift =
        2.0 * given.lift_coefficient * along_normal * (*given.normal - along_normal * direction);
    const Vector3d force = -0.5 * body.fluid_density * area * (given.drag_coefficient * direction + lift);
    return {force, given.center_of_pressure.cross(force)};
}

/// The force -B v of a steady tow at the velocity v as a matrix B: drag along v, and a lift that does no
/// work.
Matrix3d tow_matrix(const ImmersedBody& body, const Vector3d& velocity) noexcept {
    const double speed = velocity.norm();
    if (speed < smallest_speed) return Matrix3d::Zero();
    const Vector3d direction = velocity / speed;
    const Vector3d force = tow_load(body, direction, speed).force;
    const double drag = std::max(0.0, -force.dot(direction));
    const Vector3d lift = force - force.dot(direction) * direction;
    return speed *
           (drag * Matrix3d::Identity() - lift * direction.transpose() + direction * lift.transpose());
}

/// Where the tow's force acts, and the part of its moment that no arm can give.
struct CenterOfPressure {
    Vector3d arm = Vector3d::Zero();                 ///< m, from the centroid
    Vector3d moment_along_force = Vector3d::Zero();  ///< over the speed squared, N s^2/m
};

CenterOfPressure center_of_pressure(const ImmersedBody& body, const Vector3d& velocity, double speed,
                                    double share) noexcept {
    if (speed < smallest_speed) return {};
    const Vector3d direction = velocity / speed;
    const TowLoad tow = tow_load(body, direction, speed);
    Vector3d moment = tow.moment;
    if (body.loads == Loads::table) {
        // The part (1 - kappa) of the Kirchhoff moment stays on the equation's left side: take it from the
        // table's.
        const Vector3d kirchhoff = (body.added_mass * direction).cross(direction);
        moment -= (1.0 - body.dynamic.transport) * kirchhoff;
    }
    const double square = tow.force.squaredNorm();
    if (square == 0.0) return {};
    return {share * tow.force.cross(moment) / square, share * moment.dot(tow.force) / square * tow.force};
}

/// Resistance where the flow creeps: Stokes' for the sphere of equal surface. In translation only below the
/// table's Reynolds numbers, where it grows from nothing at the table's edge.
void add_stokes_resistance(const ImmersedBody& body, double speed, Matrix6d& matrix) noexcept {
    const double pi = std::numbers::pi;
    const double cube = body.length * body.length * body.length;
    matrix.topLeftCorner<3, 3>() += pi * body.viscosity * cube * Matrix3d::Identity();
    if (body.loads != Loads::table) return;
    const double below = 1.0 - reynolds_number(body, speed) / body.tables->reynolds_numbers.front();
    if (below > 0.0) {
        matrix.bottomRightCorner<3, 3>() +=
            below * 3.0 * pi * body.viscosity * body.length * Matrix3d::Identity();
    }
}

}  // namespace

double reynolds_number(const ImmersedBody& body, double speed) noexcept {
    return speed * body.length * body.fluid_density / body.viscosity;
}

TowLoad tow_load(const ImmersedBody& body, const Vector3d& direction, double speed) noexcept {
    switch (body.loads) {
        case Loads::table:
            return table_load(body, direction, speed);
        case Loads::coefficients:
            return coefficient_load(body, direction);
        default:
            return {};
    }
}

Matrix6d load_matrix(const ImmersedBody& body, const Vector6d& relative_velocity) noexcept {
    Matrix6d matrix = Matrix6d::Zero();
    if (body.loads == Loads::none) return matrix;
    const Vector3d omega = relative_velocity.head<3>();
    const Vector3d velocity = relative_velocity.tail<3>();
    const DynamicCoefficients& dynamic = body.dynamic;
    const double speed = velocity.norm();
    const double tip_speed = dynamic.half_length * omega.norm();
    const double combined = std::hypot(speed, tip_speed);

    // The tow's moment fades as the tip speed outgrows the speed: a steady tow keeps it whole.
    const double share = combined > smallest_speed ? (speed / combined) * (speed / combined) : 0.0;
    const CenterOfPressure pressure = center_of_pressure(body, velocity, speed, share);
    Eigen::Matrix<double, 3, 6> to_pressure;
    to_pressure << -skew(pressure.arm), Matrix3d::Identity();
    const Matrix3d tow = tow_matrix(body, velocity + omega.cross(pressure.arm));
    matrix += to_pressure.transpose() * tow * to_pressure;

    auto moment_by_velocity = matrix.topRightCorner<3, 3>();
    auto force_by_rotation = matrix.bottomLeftCorner<3, 3>();
    // What a turning body gains along the force it loses along its path, as a windmill does: antisymmetric,
    // so workless.
    const Matrix3d windmill = pressure.moment_along_force * velocity.transpose();
    moment_by_velocity -= windmill;
    force_by_rotation += windmill.transpose();
    // kappa (omega x (M v), v x (M v)): workless.
    const Matrix3d transport = dynamic.transport * skew(body.added_mass * velocity);
    moment_by_velocity += transport;
    force_by_rotation += transport;

    const double half_density = 0.5 * body.fluid_density;
    if (combined > smallest_speed) {
        matrix.bottomRightCorner<3, 3>() +=
            half_density * (tip_speed / combined) * tip_speed * dynamic.drag_in_motion;
    }
    matrix.topLeftCorner<3, 3>() += half_density * combined * dynamic.rotational_drag;
    add_stokes_resistance(body, speed, matrix);
    return matrix;
}

}  // namespace samara
