#include "samara/export/chan_file.hpp"

#include <cmath>
#include <iterator>
#include <numbers>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/core/base/text.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/export/float_range.hpp"
#include "samara/export/shape_pose.hpp"

namespace samara {
namespace {

/// Returns the angle that differs from `angle` by whole revolutions and is nearest to `before` (rad).
double nearest_turn(double angle, double before) {
    constexpr double whole = 2.0 * std::numbers::pi;
    return angle + whole * std::round((before - angle) / whole);
}

/// Returns the angles of which the rotation about z by angles.z(), then about x by angles.x(), is left of
/// `rotation` once the last rotation, about y by `ry`, is taken off: exact to rounding even where rx is near
/// a right angle and ry is not told by the rotation alone.
Vector3d angles_with(const Matrix3d& rotation, double ry, const Vector3d& before) {
    const Matrix3d rest = Eigen::AngleAxisd(-ry, Vector3d::UnitY()).toRotationMatrix() * rotation;  // Rx Rz
    return {nearest_turn(std::atan2(-rest(1, 2), rest(2, 2)), before.x()), ry,
            nearest_turn(std::atan2(-rest(0, 1), rest(0, 0)), before.z())};
}

/// Returns the angles (rad) of Ry Rx Rz = rotation that are nearest to those before.
Vector3d continued_angles(const Matrix3d& rotation, const Vector3d& before) {
    const double sine = rotation(0, 2);  // sin ry cos rx
    const double cosine = rotation(2, 2);
    if (std::hypot(sine, cosine) < 1e-9) return angles_with(rotation, before.y(), before);
    const double ry = std::atan2(sine, cosine);
    const Vector3d one = angles_with(rotation, nearest_turn(ry, before.y()), before);
    const Vector3d other = angles_with(rotation, nearest_turn(ry + std::numbers::pi, before.y()), before);
    return (one - before).squaredNorm() <= (other - before).squaredNorm() ? one : other;
}

std::string channels(const Motion& motion, const BodyMotion& body, int run, int copy, ChanLayout layout) {
    Matrix3d y_up;
    y_up << 1, 0, 0,  //
        0, 0, 1,      //
        0, -1, 0;
    // Rz Ry Rx is Ry Rx Rz in axes renamed y -> z -> x -> y.
    Matrix3d renamed = Matrix3d::Identity();
    if (layout == ChanLayout::houdini) {
        renamed << 0, 1, 0,  //
            0, 0, 1,         //
            1, 0, 0;
    }
    fmt::memory_buffer text;
    Vector3d angles = Vector3d::Zero();
    const std::vector<ShapePose> poses = shape_poses(motion, body, run, copy);
    const Matrix3d to_angles = renamed * y_up;
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
        const Vector3d place = y_up * poses[frame].position;
        angles = continued_angles(
            to_angles * poses[frame].orientation.toRotationMatrix() * to_angles.transpose(), angles);
        const Vector3d in_degrees = renamed.transpose() * angles * degrees;
        if (layout == ChanLayout::nuke) {
            fmt::format_to(std::back_inserter(text), "{} ",
                           std::lround(motion.times[frame] * motion.frame_rate));
        }
        fmt::format_to(std::back_inserter(text), "{} {} {} {} {} {}\n", place.x(), place.y(), place.z(),
                       in_degrees.x(), in_degrees.y(), in_degrees.z());
    }
    return fmt::to_string(text);
}

void require_whole_frames(const std::filesystem::path& file, const Motion& motion) {
    for (const double time : motion.times) {
        const double frame = time * motion.frame_rate;
        if (std::abs(frame - std::round(frame)) > 1e-3) {
            throw Error(
                fmt::format("{}: .chan needs whole frames, but the motion has one at {} s, which is {} "
                            "frames of 1/{} s; choose another --frame-rate",
                            file.string(), time, frame, motion.frame_rate));
        }
    }
}

}  // namespace

std::vector<std::filesystem::path> write_chan(const std::filesystem::path& file, const Motion& motion,
                                              int run, const ExportProgress& progress, ChanLayout layout,
                                              int first_copy) {
    require_whole_frames(file, motion);
    require_float_range(file, motion, run);
    int total = 0;
    for (const BodyMotion& body : motion.bodies) total += body.copies;
    const bool single = total == 1;
    std::vector<std::filesystem::path> files;
    for (const BodyMotion& body : motion.bodies) {
        for (int copy = 0; copy < body.copies; ++copy) {
            std::filesystem::path target = file;
            if (!single) {
                std::string name = printable(copy_name(body, first_copy + copy));
                for (char& letter : name) letter = letter == '/' ? '_' : letter;
                target.replace_filename(
                    fmt::format("{}_{}{}", file.stem().string(), name, file.extension().string()));
            }
            replace_file_with(target, channels(motion, body, run, copy, layout));
            files.push_back(target);
            if (progress) progress(static_cast<double>(files.size()), total);
        }
    }
    return files;
}

}  // namespace samara
