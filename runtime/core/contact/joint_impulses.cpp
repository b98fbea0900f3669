#include "samara/core/contact/joint_impulses.hpp"

#include <algorithm>

namespace samara {
namespace {

// Chosen by trial, as those of a single body (body_impulses.cpp).
constexpr int most_joint_sweeps = 60;  // forwards and backwards
// change of the impulses in a sweep, or of the velocities: where several points hold the same, impulses may
// go on shifting between them, which moves nothing
constexpr double joint_converged = 1e-5;

/// Adds to a velocity what impulses give a body. By numbers alone: vectors of three, of a velocity that was
/// just written by twos, would wait for it to reach the cache.
void push(ContactBody& body, const ContactImpulses::Side& side, const Vector6d& size, double sign) noexcept {
    for (Eigen::Index i = 0; i < 6; ++i) {
        body.velocity[i] +=
            sign * (side.push(i, 0) * size[0] + side.push(i, 1) * size[1] + side.push(i, 2) * size[2] +
                    side.spin(i, 0) * size[3] + side.spin(i, 1) * size[4] + side.spin(i, 2) * size[5]);
    }
}

void push_both(std::span<ContactBody> bodies, const ContactBetween& point, const ContactImpulses& impulses,
               const Vector6d& size) noexcept {
    push(bodies[point.first], impulses.first, size, 1.0);
    if (point.second != ContactBetween::none) push(bodies[point.second], impulses.second, size, -1.0);
}

/// The velocity (m/s) and angular velocity (rad/s) of the first body at a point relative to the second, or to
/// the surface that it touches.
struct Passing {
    Vector3d slide, turn;

    Passing(std::span<const ContactBody> bodies, const ContactBetween& point) noexcept {
        add(bodies[point.first].velocity, point.first_arm, 1.0);
        if (point.second != ContactBetween::none) add(bodies[point.second].velocity, point.second_arm, -1.0);
    }

  private:
    void add(const Vector6d& u, const Vector3d& arm, double sign) noexcept {
        const Vector3d v(u[3] + u[1] * arm[2] - u[2] * arm[1], u[4] + u[2] * arm[0] - u[0] * arm[2],
                         u[5] + u[0] * arm[1] - u[1] * arm[0]);
        if (sign > 0.0) {
            slide = v;
            turn = Vector3d(u[0], u[1], u[2]);
        } else {
            slide -= v;
            turn -= Vector3d(u[0], u[1], u[2]);
        }
    }
};

}  // namespace

void ContactSolver::prepare(std::span<ContactBody> bodies, std::span<const ContactBetween> points,
                            std::size_t known) {
    rows_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const ContactBetween& point = points[i];
        Row& row = rows_[i];
        row.direction.setZero();
        if (i < known) {
            push_both(bodies, point, row, row.size);
            continue;
        }
        const Matrix3d axes = axes_about(point.normal);
        const Matrix3d across = axes.transpose();
        const auto respond = [&](const ContactBody& body, const Vector3d& arm, ContactImpulses::Side& side) {
            ContactImpulses::Response wrench;
            wrench << skew(arm) * across, across;
            side.push = body.inverse_inertia * wrench;
            side.spin = body.inverse_inertia.leftCols<3>() * across;
            row.push_mobility += wrench.transpose() * side.push;
            row.spin_by_push += across.transpose() * side.push.topRows<3>();
            row.spin_mobility += across.transpose() * side.spin.topRows<3>();
        };
        row.push_mobility.setZero();
        row.spin_mobility.setZero();
        row.spin_by_push.setZero();
        respond(bodies[point.first], point.first_arm, row.first);
        double radius = bodies[point.first].radius;
        if (point.second != ContactBetween::none) {
            const ContactBody& second = bodies[point.second];
            respond(second, point.second_arm, row.second);
            radius = std::min(radius, second.radius);
        }
        row.begin(axes, point.surface_velocity, point.surface_angular_velocity, point.friction, radius);
        row.target.z() -= point.allowed_speed;
        row.invert();
    }
}

void ContactSolver::sweep(std::span<ContactBody> bodies, std::span<const ContactBetween> points,
                          bool backwards) noexcept {
    for (std::size_t k = 0; k < points.size(); ++k) {
        const std::size_t i = backwards ? points.size() - 1 - k : k;
        const Passing passing(bodies, points[i]);
        Vector6d change;
        if (rows_[i].relax(passing.slide, passing.turn, change).touches)
            push_both(bodies, points[i], rows_[i], change);
    }
}

bool ContactSolver::has_converged(std::span<const ContactBody> bodies) const noexcept {
    double change = 0.0;
    double largest = 0.0;
    for (const Row& row : rows_) {
        const double mobility = row.push_mobility(2, 2);
        change = std::max(change, (row.size - row.before).head<3>().squaredNorm() * mobility);
        largest = std::max(largest, row.size.head<3>().squaredNorm() * mobility);
    }
    const double tolerated = joint_converged * joint_converged * largest;
    if (change <= tolerated) return true;
    double motion = 0.0;  // two thirds of its energy (J), with the mean of the mobilities
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Vector6d after = bodies[i].velocity - before_[i];
        const Matrix6d& mobility = bodies[i].inverse_inertia;
        motion =
            std::max(motion, after.head<3>().squaredNorm() / mobility.topLeftCorner<3, 3>().trace() +
                                 after.tail<3>().squaredNorm() / mobility.bottomRightCorner<3, 3>().trace());
    }
    return 3.0 * motion <= tolerated;
}

void ContactSolver::accelerate(std::span<ContactBody> bodies,
                               std::span<const ContactBetween> points) noexcept {
    double square = 0.0;
    for (const Row& row : rows_) square += (row.size - row.before).squaredNorm();
    const double share = slope_ > 0.0 ? square / slope_ : 0.0;
    slope_ = square;
    for (std::size_t i = 0; i < points.size(); ++i) {
        Row& row = rows_[i];
        const Vector6d change = row.size - row.before;
        if (!(share > 0.0 && share < 1.0)) {
            row.direction = change;
            continue;
        }
        const Vector6d more = share * row.direction;
        row.direction = more + change;
        row.size += more;
        push_both(bodies, points[i], row, more);
    }
}

void ContactSolver::keep_passive(std::span<ContactBody> bodies, std::span<ContactBetween> points) {
    impulse_.assign(bodies.size(), Vector6d::Zero());
    double gain = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const ContactBetween& point = points[i];
        const Row& row = rows_[i];
        const Vector3d push = row.push();
        const Vector3d spin = row.axes.transpose() * row.size.tail<3>();
        Vector6d wrench;
        wrench << point.first_arm.cross(push) + spin, push;
        impulse_[point.first] += wrench;
        if (point.second != ContactBetween::none) {
            wrench << point.second_arm.cross(push) + spin, push;
            impulse_[point.second] -= wrench;
        } else {
            gain -= row.work();
        }
    }
    double square = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        gain += start_[i].dot(impulse_[i]);
        square += impulse_[i].dot(bodies[i].inverse_inertia * impulse_[i]);
    }
    const double share = passive_share(gain, square);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        bodies[i].velocity = start_[i] + share * (bodies[i].inverse_inertia * impulse_[i]);
    }
    for (std::size_t i = 0; i < points.size(); ++i) points[i].impulse = share * rows_[i].push();
}

void ContactSolver::solve(std::span<ContactBody> bodies, std::span<ContactBetween> points,
                          std::size_t known) {
    if (points.empty()) return;
    start_.clear();
    for (const ContactBody& body : bodies) start_.push_back(body.velocity);
    prepare(bodies, points, known);
    slope_ = 0.0;
    for (int i = 0; i < most_joint_sweeps; ++i) {
        for (Row& row : rows_) row.before = row.size;
        before_.clear();
        for (const ContactBody& body : bodies) before_.push_back(body.velocity);
        sweep(bodies, points, false);
        sweep(bodies, points, true);
        if (has_converged(bodies)) break;
        if (i + 1 < most_joint_sweeps) accelerate(bodies, points);
    }
    keep_passive(bodies, points);
}

}  // namespace samara
