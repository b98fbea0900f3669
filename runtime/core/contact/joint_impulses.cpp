#include "samara/core/contact/joint_impulses.hpp"

#include <algorithm>

#include <Eigen/LU>

#include "samara/core/contact/contact_impulses.hpp"

namespace samara {
namespace {

// Chosen by trial: what they must give, rest and no energy, is what the tests Encounters hold them to.
constexpr int most_sweeps = 60;     // forwards and backwards
constexpr double converged = 1e-5;  // change of an impulse in a sweep, over the largest

/// How fast the first passes the second at a point (m/s), or what it meets there.
Vector3d passing(std::span<const JointBody> bodies, const JointPoint& point) noexcept {
    const Vector6d& a = bodies[point.first].velocity;
    Vector3d rate = a.tail<3>() + a.head<3>().cross(point.first_arm);
    if (point.second == JointPoint::none) return rate;
    const Vector6d& b = bodies[point.second].velocity;
    rate -= b.tail<3>() + b.head<3>().cross(point.second_arm);
    return rate;
}

Vector3d turning(std::span<const JointBody> bodies, const JointPoint& point) noexcept {
    Vector3d rate = bodies[point.first].velocity.head<3>();
    if (point.second != JointPoint::none) rate -= bodies[point.second].velocity.head<3>();
    return rate;
}

/// Stops rates where impulses within `bound` can, else slows them: returns what the size becomes.
template <int N>
Eigen::Matrix<double, N, 1> held(const Eigen::Matrix<double, N, 1>& size,
                                 const Eigen::Matrix<double, N, 1>& rates,
                                 const Eigen::Matrix<double, N, N>& inverse, double trace, double bound) {
    Eigen::Matrix<double, N, 1> after = size - inverse * rates;
    if (after.norm() <= bound) return after;
    // A step of projected gradients: no longer than the mobility's trace allows, so it never gains.
    after = size - rates / trace;
    const double length = after.norm();
    if (length > bound) after *= bound / length;
    return after;
}

}  // namespace

void JointImpulses::give(std::span<JointBody> bodies, const JointPoint& point, const Row& row,
                         const Vector6d& size) noexcept {
    bodies[point.first].velocity += row.first_push * size.head<3>() + row.first_turn * size.tail<3>();
    if (point.second == JointPoint::none) return;
    bodies[point.second].velocity -= row.second_push * size.head<3>() + row.second_turn * size.tail<3>();
}

void JointImpulses::prepare(std::span<JointBody> bodies, std::span<const JointPoint> points,
                            std::size_t known) {
    rows_.resize(points.size());
    for (std::size_t i = 0; i < known; ++i) {
        rows_[i].way.setZero();
        give(bodies, points[i], rows_[i], rows_[i].size);
    }
    for (std::size_t i = known; i < points.size(); ++i) {
        const JointPoint& point = points[i];
        Row& row = rows_[i];
        row.axes.row(0) = point.normal.unitOrthogonal().transpose();
        row.axes.row(1) = point.normal.cross(row.axes.row(0).transpose()).transpose();
        row.axes.row(2) = point.normal.transpose();
        const Matrix3d across = row.axes.transpose();
        const auto respond = [&](const JointBody& body, const Vector3d& arm, Block& push, Block& turn) {
            Block wrench;
            wrench << skew(arm) * across, across;
            push = body.inverse_inertia * wrench;
            turn = body.inverse_inertia.leftCols<3>() * across;
            row.push_mobility += wrench.transpose() * push;
            row.turn_mobility += across.transpose() * turn.topRows<3>();
        };
        row.push_mobility.setZero();
        row.turn_mobility.setZero();
        respond(bodies[point.first], point.first_arm, row.first_push, row.first_turn);
        double radius = bodies[point.first].radius;
        if (point.second != JointPoint::none) {
            const JointBody& second = bodies[point.second];
            respond(second, point.second_arm, row.second_push, row.second_turn);
            radius = std::min(radius, second.radius);
        }
        row.turn_inverse = row.turn_mobility.inverse();
        row.slip_inverse = row.push_mobility.topLeftCorner<2, 2>().inverse();
        row.meant = row.axes * point.surface_velocity;
        row.meant_turn = row.axes * point.surface_turning;
        row.rising = row.meant.z();
        row.meant.z() -= point.allowed_speed;
        row.size.setZero();
        row.way.setZero();
        row.lever = rolling_resistance * radius;
    }
}

void JointImpulses::relax(std::span<JointBody> bodies, const JointPoint& point, Row& row) noexcept {
    const auto change_push = [&](const Vector3d& change) {
        bodies[point.first].velocity += row.first_push * change;
        if (point.second != JointPoint::none) bodies[point.second].velocity -= row.second_push * change;
    };
    const double closing = point.normal.dot(passing(bodies, point)) - row.meant.z();
    const double normal = std::max(0.0, row.size[2] - closing / row.push_mobility(2, 2));
    change_push(Vector3d(0.0, 0.0, normal - row.size[2]));
    row.size[2] = normal;
    if (normal == 0.0 && row.size.isZero(0.0)) return;

    const Vector3d rates = row.axes * passing(bodies, point) - row.meant;
    const Eigen::Vector2d slip =
        held<2>(row.size.head<2>(), rates.head<2>(), row.slip_inverse,
                row.push_mobility(0, 0) + row.push_mobility(1, 1), point.friction * normal);
    change_push(Vector3d(slip.x() - row.size[0], slip.y() - row.size[1], 0.0));
    row.size.head<2>() = slip;

    const Vector3d turn_rates = row.axes * turning(bodies, point) - row.meant_turn;
    const Vector3d turn = held<3>(row.size.tail<3>(), turn_rates, row.turn_inverse, row.turn_mobility.trace(),
                                  row.lever * normal);
    const Vector3d change = turn - row.size.tail<3>();
    bodies[point.first].velocity += row.first_turn * change;
    if (point.second != JointPoint::none) bodies[point.second].velocity -= row.second_turn * change;
    row.size.tail<3>() = turn;
}

void JointImpulses::sweep(std::span<JointBody> bodies, std::span<const JointPoint> points,
                          bool backwards) noexcept {
    for (std::size_t k = 0; k < points.size(); ++k) {
        const std::size_t i = backwards ? points.size() - 1 - k : k;
        relax(bodies, points[i], rows_[i]);
    }
}

bool JointImpulses::has_converged() const noexcept {
    double change = 0.0;
    double largest = 0.0;
    for (const Row& row : rows_) {
        const double mobility = row.push_mobility(2, 2);
        change = std::max(change, (row.size - row.before).head<3>().squaredNorm() * mobility);
        largest = std::max(largest, row.size.head<3>().squaredNorm() * mobility);
    }
    return change <= converged * converged * largest;
}

void JointImpulses::hasten(std::span<JointBody> bodies, std::span<const JointPoint> points) noexcept {
    double square = 0.0;
    for (const Row& row : rows_) square += (row.size - row.before).squaredNorm();
    const double share = slope_ > 0.0 ? square / slope_ : 0.0;
    slope_ = square;
    for (std::size_t i = 0; i < points.size(); ++i) {
        Row& row = rows_[i];
        const Vector6d change = row.size - row.before;
        if (!(share > 0.0 && share < 1.0)) {
            row.way = change;
            continue;
        }
        const Vector6d more = share * row.way;
        row.way = more + change;
        row.size += more;
        give(bodies, points[i], row, more);
    }
}

void JointImpulses::keep_passive(std::span<JointBody> bodies, std::span<JointPoint> points) {
    impulse_.assign(bodies.size(), Vector6d::Zero());
    double gain = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const JointPoint& point = points[i];
        const Row& row = rows_[i];
        const Vector3d push = row.axes.transpose() * row.size.head<3>();
        const Vector3d turn = row.axes.transpose() * row.size.tail<3>();
        Vector6d wrench;
        wrench << point.first_arm.cross(push) + turn, push;
        impulse_[point.first] += wrench;
        if (point.second != JointPoint::none) {
            wrench << point.second_arm.cross(push) + turn, push;
            impulse_[point.second] -= wrench;
        } else {
            gain -= row.size.head<2>().dot(row.meant.head<2>()) + row.size[2] * row.rising +
                    row.size.tail<3>().dot(row.meant_turn);
        }
    }
    double square = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        gain += start_[i].dot(impulse_[i]);
        square += impulse_[i].dot(bodies[i].inverse_inertia * impulse_[i]);
    }
    // Friction that was bounded by a normal impulse which later fell may add a little.
    const double share = gain + 0.5 * square <= 0.0 ? 1.0 : std::max(0.0, -gain / square);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        bodies[i].velocity = start_[i] + share * (bodies[i].inverse_inertia * impulse_[i]);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].impulse = share * (rows_[i].axes.transpose() * rows_[i].size.head<3>());
    }
}

void JointImpulses::solve(std::span<JointBody> bodies, std::span<JointPoint> points, std::size_t known) {
    if (points.empty()) return;
    start_.clear();
    for (const JointBody& body : bodies) start_.push_back(body.velocity);
    prepare(bodies, points, known);
    slope_ = 0.0;
    for (int i = 0; i < most_sweeps; ++i) {
        for (Row& row : rows_) row.before = row.size;
        sweep(bodies, points, false);
        sweep(bodies, points, true);
        if (has_converged()) break;
        if (i + 1 < most_sweeps) hasten(bodies, points);
    }
    keep_passive(bodies, points);
}

}  // namespace samara
