#include "samara/scene/launch_ranges.hpp"

#include <charconv>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/kernel/noise.hpp"

namespace samara {
namespace {

/// Returns the number with six digits, as it is printed and read again.
double rounded(double number) {
    const std::string text = fmt::format("{:.6g}", number);
    double result = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), result);
    return result;
}

Vector3d rounded(const Vector3d& vector) {
    return {rounded(vector.x()), rounded(vector.y()), rounded(vector.z())};
}

/// Returns a unit vector, uniform in a cone of the half angle `within` about `axis`, for two numbers that are
/// uniform in (0, 1).
Vector3d drawn_in_cone(const Vector3d& axis, double within, double first, double second) {
    const double along = 1.0 - first * (1.0 - std::cos(within));
    const double across = std::sqrt(std::max(0.0, 1.0 - along * along));
    const double turn = 2.0 * std::numbers::pi * second;
    const Vector3d about(across * std::cos(turn), across * std::sin(turn), along);
    return Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis) * about;
}

}  // namespace

void Launch::apply(SceneBody& body) const {
    if (position) body.position = *position;
    if (velocity) body.velocity = *velocity;
    if (orientation) {
        const auto& [w, x, y, z] = *orientation;
        body.orientation = Quaterniond(w, x, y, z).normalized();
    }
}

void require_launch(const LaunchRanges& ranges, const SceneBody& body) {
    if (!ranges.position_within.isZero(0.0) && body.emitter != nullptr) {
        throw Error(fmt::format("'{}' starts on its emitter; leave --position-within out", body.name));
    }
    if (!body.velocity.isZero(0.0)) return;
    if (ranges.direction_within > 0.0 && !ranges.speed) {
        throw Error(
            fmt::format("'{}' has no velocity whose direction could vary; give --speed as well", body.name));
    }
    if (ranges.speed && ranges.direction_within < std::numbers::pi) {
        throw Error(fmt::format(
            "'{}' has no velocity that says where it is launched; give it one in the scene, such as "
            "velocity = [1, 0, 0], or --direction-within 180",
            body.name));
    }
}

Launch drawn_launch(const LaunchRanges& ranges, const SceneBody& body, std::uint64_t seed) {
    Launch launch;
    const Noise noise(seed, body.name + " launch", 0, 0);  // no body has a name with a space
    const auto place = noise.uniforms(0, NoiseStream::start_position);
    if (!ranges.position_within.isZero(0.0)) {
        const Vector3d share(2.0 * place[0] - 1.0, 2.0 * place[1] - 1.0, 2.0 * place[2] - 1.0);
        launch.position = rounded(body.position + share.cwiseProduct(ranges.position_within));
    }
    if (ranges.orientation_within > 0.0) {
        const auto about = noise.normals(0, NoiseStream::start_angle);
        const Eigen::AngleAxisd turn(ranges.orientation_within * place[3],
                                     Vector3d(about[0], about[1], about[2]).normalized());
        const Quaterniond turned = Quaterniond(turn) * body.orientation;
        launch.orientation = {rounded(turned.w()), rounded(turned.x()), rounded(turned.y()),
                              rounded(turned.z())};
    }
    if (ranges.speed || ranges.direction_within > 0.0) {
        const auto drawn = noise.uniforms(0, NoiseStream::start_emission);
        const double given = body.velocity.norm();
        const double speed =
            ranges.speed ? (*ranges.speed)[0] + drawn[0] * ((*ranges.speed)[1] - (*ranges.speed)[0]) : given;
        const Vector3d axis = given > 0.0 ? Vector3d(body.velocity / given) : Vector3d::UnitZ();
        const Vector3d direction = ranges.direction_within > 0.0
                                       ? drawn_in_cone(axis, ranges.direction_within, drawn[1], drawn[2])
                                       : axis;
        launch.velocity = rounded(Vector3d(speed * direction));
    }
    return launch;
}

}  // namespace samara
