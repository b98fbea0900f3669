#include "samara/dynamics/ground_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <Eigen/LU>

namespace samara {
namespace {

constexpr int sectors = 8;
constexpr std::size_t most_contacts = sectors + 1;
constexpr int most_sweeps = 100;
constexpr double converged = 1e-9;  // change of an impulse in a sweep, over the largest
constexpr double touching = 1e-5;   // gap that counts as none, over the bounding radius
constexpr double still = 1e-4;      // speed that counts as rest, over the change of speed in the step

using Block = Eigen::Matrix<double, 3, 6>;

/// Impulses that act on the body together, along the rows of a block (world axes: x, y, z) and within a
/// length that the normal impulse bounds.
struct Impulses {
    Block along = Block::Zero();  ///< J: velocity -> rates along the rows
    Eigen::Matrix<double, 6, 3> response = Eigen::Matrix<double, 6, 3>::Zero();  ///< K^-1 J^T
    Matrix3d mobility = Matrix3d::Zero();                                        ///< J K^-1 J^T
    Vector3d size = Vector3d::Zero();

    void set(const Block& rows, const Matrix6d& inverse_inertia) {
        along = rows;
        response = inverse_inertia * rows.transpose();
        mobility = rows * response;
    }
};

struct Contact {
    double gap = 0.0;
    bool round = false;
    Impulses push;  ///< friction along x and y, the normal impulse along z
    Impulses turn;  ///< of a round side: rolling resistance
};

struct Candidate {
    Vector3d point = Vector3d::Zero();
    double gap = std::numeric_limits<double>::infinity();
};

/// The points near the ground: of the corners the lowest one in each sector around the centre of mass, and
/// the lowest point of the round sides.
class Contacts {
  public:
    Contacts(const ImmersedBody& body, const Matrix3d& to_world, double height, double margin) noexcept {
        std::array<Candidate, sectors> lowest;
        std::array<double, sectors> best;
        best.fill(std::numeric_limits<double>::infinity());
        for (const Vector3d& point : body.contact_points.corners) {
            const Vector3d arm = to_world * point;
            const double gap = height + arm.z();
            if (gap > margin) continue;
            const double turn = 0.5 + std::atan2(arm.y(), arm.x()) / (2.0 * std::numbers::pi);
            const auto sector = std::min(static_cast<std::size_t>(turn * sectors), std::size_t{sectors - 1});
            // Of points at about one height the outer one carries better.
            const double score = gap - 0.01 * std::hypot(arm.x(), arm.y());
            if (score >= best[sector]) continue;
            best[sector] = score;
            lowest[sector] = {point, gap};
        }
        for (const Candidate& candidate : lowest) {
            if (candidate.gap <= margin) add(body, to_world, candidate, false);
        }
        if (body.contact_points.round.empty()) return;
        const Vector3d point = lowest_round_point(body.contact_points, -to_world.row(2).transpose());
        const double gap = height + to_world.row(2).dot(point);
        if (gap <= margin) add(body, to_world, {point, gap}, true);
    }

    [[nodiscard]] bool empty() const { return count_ == 0; }
    Contact* begin() { return contacts_.data(); }
    Contact* end() { return contacts_.data() + count_; }

  private:
    void add(const ImmersedBody& body, const Matrix3d& to_world, const Candidate& candidate, bool round) {
        Contact& contact = contacts_[count_++];
        contact.gap = candidate.gap;
        contact.round = round;
        Block rows;
        rows << -to_world * skew(candidate.point), to_world;
        contact.push.set(rows, body.inverse_inertia);
        if (!round) return;
        rows << to_world, Matrix3d::Zero();
        contact.turn.set(rows, body.inverse_inertia);
    }

    std::array<Contact, most_contacts> contacts_;
    std::size_t count_ = 0;
};

/// The velocity relative to the ground while impulses act on it.
class ImpulseSolver {
  public:
    explicit ImpulseSolver(const Vector6d& velocity) noexcept : velocity_(velocity) {}

    void solve(Contacts& contacts, double radius, double time_step) noexcept {
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            change_ = largest_ = 0.0;
            for (Contact& contact : contacts) {
                press(contact.push, std::max(0.0, contact.gap - touching * radius) / time_step);
                const double normal = contact.push.size.z();
                hold<2>(contact.push, ground_friction * normal);
                if (contact.round) hold<3>(contact.turn, rolling_resistance * radius * normal);
            }
            if (change_ <= converged * largest_) return;
        }
    }

    [[nodiscard]] const Vector6d& velocity() const { return velocity_; }

  private:
    /// Lets the point come down by no more than its gap.
    void press(Impulses& impulses, double allowed_speed) noexcept {
        const double mobility = impulses.mobility(2, 2);
        const double speed = impulses.along.row(2).dot(velocity_) + allowed_speed;
        const double before = impulses.size.z();
        impulses.size.z() = std::max(0.0, before - speed / mobility);
        velocity_ += impulses.response.col(2) * (impulses.size.z() - before);
        note(std::abs(impulses.size.z() - before), impulses.size.z(), mobility);
    }

    /// Stops the first N rates where impulses within `bound` can, else slows them.
    template <int N>
    void hold(Impulses& impulses, double bound) noexcept {
        using Part = Eigen::Matrix<double, N, 1>;
        const Eigen::Matrix<double, N, N> mobility = impulses.mobility.topLeftCorner<N, N>();
        const Part rates = impulses.along.topRows<N>() * velocity_;
        const Part before = impulses.size.head<N>();
        Part after = before - mobility.inverse() * rates;
        if (!(after.norm() <= bound)) {
            // A step of projected gradients: no longer than the mobility's trace allows, so it never gains.
            after = before - rates / mobility.trace();
            const double size = after.norm();
            if (size > bound) after *= bound / size;
        }
        impulses.size.head<N>() = after;
        velocity_ += impulses.response.leftCols<N>() * (after - before);
        note((after - before).norm(), after.norm(), mobility.trace());
    }

    void note(double change, double size, double mobility) noexcept {
        change_ = std::max(change_, change * std::sqrt(mobility));
        largest_ = std::max(largest_, size * std::sqrt(mobility));
    }

    Vector6d velocity_;
    double change_ = 0.0;
    double largest_ = 0.0;
};

/// The change that was found, or as much of it as adds no energy: friction that was bounded by a normal
/// impulse which later fell may add a little.
Vector6d passive(const ImmersedBody& body, const Vector6d& velocity, const Vector6d& change) {
    const Vector6d momentum = body.inertia * change;
    const double gain = velocity.dot(momentum);
    const double square = change.dot(momentum);
    if (gain + 0.5 * square <= 0.0) return change;
    return std::max(0.0, -gain / square) * change;
}

Vector6d relative_to(const Ground& ground, const BodyState& state) {
    Vector6d velocity = state.velocity;
    velocity.tail<3>() -= state.orientation.conjugate() * ground.velocity;
    return velocity;
}

/// What the impulses make of a velocity relative to the ground, for a body with the orientation `to_world`
/// whose centre of mass stands at `height` above the ground.
Vector6d after_impulses(const ImmersedBody& body, const Matrix3d& to_world, double height, double margin,
                        double time_step, const Vector6d& velocity) noexcept {
    Contacts contacts(body, to_world, height, margin);
    if (contacts.empty()) return velocity;
    ImpulseSolver solver(velocity);
    solver.solve(contacts, body.contact_points.bounding_radius, time_step);
    return velocity + passive(body, velocity, solver.velocity() - velocity);
}

/// Whether a body that was still before the step is still after it, where it lay.
bool lies_still(const ImmersedBody& body, const Ground& ground, double margin, double time_step,
                const BodyState& before, const Vector6d& velocity) noexcept {
    const auto square = [&](const Vector6d& u) { return u.dot(body.inertia * u); };
    const Vector6d velocity_before = relative_to(ground, before);
    const double rest = still * still * square(velocity - velocity_before);
    if (!(square(velocity_before) < rest)) return false;
    const double height = before.position.z() + ground.travel.z() - ground.height;
    return square(after_impulses(body, before.orientation.toRotationMatrix(), height, margin, time_step,
                                 velocity)) < rest;
}

}  // namespace

Ground ground_in_flow(const Surroundings& surroundings, double begin, double end) noexcept {
    const Vector3d displacement = flow_displacement(surroundings, end);
    return {.height = *surroundings.ground - displacement.z(),
            .velocity = -flow_velocity(surroundings, end),
            .travel = flow_displacement(surroundings, begin) - displacement};
}

void touch_ground(const ImmersedBody& body, const Ground& ground, double time_step, const BodyState& before,
                  BodyState& state) noexcept {
    const double radius = body.contact_points.bounding_radius;
    const Vector6d velocity = relative_to(ground, state);
    // No point moves faster than this, nor twice as fast once impulses have turned the body.
    const double margin = 2.0 * time_step * (velocity.tail<3>().norm() + radius * velocity.head<3>().norm());
    const double height = state.position.z() - ground.height;
    if (!(height - radius <= margin)) return;

    if (lies_still(body, ground, margin, time_step, before, velocity)) {
        state.position = before.position + ground.travel;
        state.orientation = before.orientation;
        state.velocity << Vector3d::Zero(), state.orientation.conjugate() * ground.velocity;
        return;
    }
    const Matrix3d to_world = state.orientation.toRotationMatrix();
    const double lowest = height - reach(body.contact_points, -to_world.row(2).transpose());
    const double lift = std::max(0.0, -lowest);
    state.position.z() += lift;
    state.velocity += after_impulses(body, to_world, height + lift, margin, time_step, velocity) - velocity;
}

}  // namespace samara
