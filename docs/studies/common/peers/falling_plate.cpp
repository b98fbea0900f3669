#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "peers/peer_body.hpp"
#include "samara/commands/shared/load_body.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

constexpr double pi = std::numbers::pi;

double reach_along(const Body& body, const Vector3d& direction) {
    double reach = 0.0;
    for (const Vector3d& vertex : body.surface.vertices) {
        reach = std::max(reach, std::abs(direction.dot(vertex - body.moments.centroid)));
    }
    return reach;
}

/// A plate that stays in the vertical plane of its first tilt: an ellipse of the half-chord a and the
/// half-thickness b, as long as gives the body's volume as a plate of that chord and thickness.
class FallingPlate : public PeerBody {
  public:
    FallingPlate(const Scene& scene, const Motion& reference) : times_(reference.times), step_(scene.step) {
        const SceneBody& given = scene.bodies.front();
        if (!given.mass.density || scene.fluid.current.norm() > 0.0) {
            throw Error(fmt::format("{}: the plate's equations know bodies of uniform density in still fluid",
                                    scene.file.string()));
        }
        const Body body = load_body(given.shape, reading_of(given));
        const Vector3d up = -scene.gravity.normalized();
        const Vector3d thin = principal_axes(body.moments).col(0);
        Vector3d normal = given.orientation * thin;
        if (normal.dot(up) < 0.0) normal = -normal;
        const Vector3d across = up.cross(normal);
        if (across.norm() < 1e-6) {
            throw Error(
                fmt::format("{}: the plate's equations need a start that is tilted", scene.file.string()));
        }
        // Right-handed with the angle from the horizontal: chord, normal, axis of turning.
        axis_ = -across.normalized();
        horizontal_ = up.cross(axis_);
        up_ = up;
        chord_ = normal.cross(axis_);
        angle_ = std::atan2(chord_.dot(up), chord_.dot(horizontal_));
        start_ = given.orientation;
        centroid_ = given.position + given.orientation * body.moments.centroid;
        density_ = scene.fluid.density;
        half_chord_ = reach_along(body, given.orientation.conjugate() * chord_);
        half_thickness_ = reach_along(body, thin);
        span_ = body.moments.volume / (4.0 * half_chord_ * half_thickness_);
        mass_ = *given.mass.density * body.moments.volume;
        weight_ = (*given.mass.density - density_) * body.moments.volume * scene.gravity.norm();
        const Vector3d own_axis = given.orientation.conjugate() * axis_;
        inertia_ = own_axis.dot(uniform_inertia(body.moments, *given.mass.density) * own_axis);
        const Vector3d velocity = given.velocity;
        begin_ = {
            velocity.dot(chord_), velocity.dot(normal), given.angular_velocity.dot(axis_), angle_, 0.0, 0.0};
    }

    [[nodiscard]] PeerFall fall(const std::vector<double>& coefficients, int cuts) const override {
        const double step = step_ / cuts;
        State state = begin_;
        const auto advance = [&] {
            const State a = rate(coefficients, state);
            const State b = rate(coefficients, state + 0.5 * step * a);
            const State c = rate(coefficients, state + 0.5 * step * b);
            const State d = rate(coefficients, state + step * c);
            state += step / 6.0 * (a + 2.0 * b + 2.0 * c + d);
            return state.isFinite().all() && state.head<3>().abs().maxCoeff() < 1e6;
        };
        return flown_through(times_, step, advance, [&] { return pose(state); });
    }

    [[nodiscard]] std::string words() const override {
        return "a falling plate's planar equations (Andersen, Pesavento and Wang 2005), Runge and Kutta's "
               "fourth order";
    }

  private:
    /// Velocity along the chord and the normal, turning, angle of the chord, horizontal and vertical place.
    using State = Eigen::Array<double, 6, 1>;

    /// Eq. 4.1 to 4.9 with the paper's C_T, C_R, A, B, mu_1 and mu_2 as the coefficients, in SI units.
    [[nodiscard]] State rate(const std::vector<double>& coefficients, const State& state) const {
        const double u = state[0], v = state[1], omega = state[2], theta = state[3];
        const double a = half_chord_, b = half_thickness_;
        const double along = mass_ + pi * density_ * b * b * span_;
        const double across = mass_ + pi * density_ * a * a * span_;
        const double added_inertia = pi / 8.0 * density_ * std::pow(a * a - b * b, 2) * span_;
        const double speed = std::max(std::hypot(u, v), 1e-12);
        const double circulation = 2.0 * a * (a * coefficients[1] * omega - coefficients[0] * u * v / speed);
        const double lift = density_ * circulation * span_;
        const double drag = density_ * a * span_ * speed *
                            (coefficients[2] - coefficients[3] * (u * u - v * v) / (speed * speed));
        const double scale = std::sqrt(std::abs(weight_) / (pi * density_ * a * span_));
        const double friction = pi * density_ * std::pow(a, 4) * span_ *
                                (coefficients[4] * scale / a + coefficients[5] * std::abs(omega)) * omega;
        State rate;
        rate << (across * omega * v - lift * v - weight_ * std::sin(theta) - drag * u) / along,
            (-along * omega * u + lift * u - weight_ * std::cos(theta) - drag * v) / across,
            ((along - across) * u * v - friction) / (inertia_ + added_inertia), omega,
            u * std::cos(theta) - v * std::sin(theta), u * std::sin(theta) + v * std::cos(theta);
        return rate;
    }

    [[nodiscard]] Pose pose(const State& state) const {
        const Quaterniond turn(Eigen::AngleAxisd(state[3] - angle_, axis_));
        const State now = rate({0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, state);
        Pose pose;
        pose.orientation = (turn * start_).normalized();
        pose.position = centroid_ + state[4] * horizontal_ + state[5] * up_;
        pose.velocity = now[4] * horizontal_ + now[5] * up_;
        pose.angular_velocity = state[2] * axis_;
        return pose;
    }

    std::vector<double> times_;
    double step_;
    Vector3d axis_;  // of turning, world axes
    Vector3d horizontal_;
    Vector3d up_;
    Vector3d chord_;     // at the start
    Vector3d centroid_;  // m, at the start
    Quaterniond start_;
    double angle_ = 0.0;    // rad, of the chord at the start
    double density_ = 0.0;  // kg/m^3, the fluid's
    double half_chord_ = 0.0;
    double half_thickness_ = 0.0;
    double span_ = 0.0;
    double mass_ = 0.0;
    double weight_ = 0.0;   // N, less the buoyancy
    double inertia_ = 0.0;  // kg m^2, about the axis
    State begin_;
};

}  // namespace

PeerModel falling_plate_model() {
    return {"falling-plate",
            {{"C_T", 1.2, 0.0, 4.0},
             {"C_R", pi, 0.0, 8.0},
             {"A", 1.4, 0.0, 4.0},
             {"B", 1.0, 0.0, 4.0},
             {"mu_1", 0.2, 0.0, 2.0},
             {"mu_2", 0.2, 0.0, 2.0}},
            [](const Scene& scene, const Motion& reference) {
                return std::make_shared<FallingPlate>(scene, reference);
            }};
}

}  // namespace samara
