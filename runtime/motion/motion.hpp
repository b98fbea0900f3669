#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/contact_points.hpp"
#include "samara/core/physics/obstacle.hpp"
#include "samara/core/physics/pose.hpp"
#include "samara/core/surface/display_mesh.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// By how much a figure of a motion may be wrong for a reason that its own swings do not show, such as the
/// mesh of a fall by full CFD: what it differs by from another solution, and the standard error of that.
struct MetricUncertainty {
    std::string cause;      ///< such as "mesh" or "closure"
    std::string metric;     ///< as in JSON: descent_speed, frequency, ...
    double relative = 0.0;  ///< the difference over the figure, 0 or more
    double chance = 0.0;    ///< its standard error over the figure, 0 or more

    friend bool operator==(const MetricUncertainty&, const MetricUncertainty&) = default;
};

/// One body of the scene with all its copies, runs and frames.
struct BodyMotion {
    std::string name;  ///< in the scene
    Vector3d center_of_mass =
        Vector3d::Zero();  ///< m, shape axes: subtract R times this to place the shape's origin
    Vector3d shortest_axis =
        Vector3d::UnitZ();  ///< principal axis of the shortest extent, shape axes: of the inclination
    std::string body_hash;  ///< content hash of the body file that was flown
    std::string models;     ///< in words: the loads, turbulence and defaults that were used
    Surface surface;        ///< shape axes, so that a motion file can be shown by itself
    std::shared_ptr<const DisplayMesh> display;  ///< what exports show in its place; null: nothing
    ContactPoints contact_points;                ///< of the surface, where the motion has a ground
    int copies = 1;                              ///< of the body, each with poses of its own
    /// Of each copy over the surface's, index run * copies + copy; none where all have the surface's own.
    std::vector<double> sizes;
    std::vector<MetricUncertainty> uncertainties;  ///< sorted by cause and figure; none where none are known
    std::vector<Pose> poses;                       ///< index ((run * frames) + frame) * copies + copy

    /// The lengths of a copy in a run, each counted from 0, over the surface's.
    [[nodiscard]] double size(int run, int copy) const {
        if (sizes.empty()) return 1.0;
        return sizes[static_cast<std::size_t>(run) * static_cast<std::size_t>(copies) +
                     static_cast<std::size_t>(copy)];
    }
};

/// What `samara simulate` writes: frames at even times.
struct Motion {
    std::vector<double> times;                     ///< s
    int runs = 1;                                  ///< with other noise and starts
    double frame_rate = 60.0;                      ///< frames per second
    Vector3d gravity = Vector3d(0.0, 0.0, -9.81);  ///< m/s^2, world axes
    std::optional<double> ground;                  ///< m: the height of the ground, where there is one
    std::vector<Obstacle> obstacles;               ///< what the bodies touched besides the ground
    std::uint64_t seed = 1;                        ///< of the noise and the starts
    std::string scene_text;                        ///< the scene file as it was read
    std::vector<BodyMotion> bodies;                ///< in the scene's order

    /// How many frames there are.
    [[nodiscard]] int frames() const { return static_cast<int>(times.size()); }
    /// The pose of a copy in a run at a frame, each counted from 0.
    [[nodiscard]] const Pose& pose(const BodyMotion& body, int run, int frame, int copy) const {
        const auto row = static_cast<std::size_t>(run) * times.size() + static_cast<std::size_t>(frame);
        return body.poses[row * static_cast<std::size_t>(body.copies) + static_cast<std::size_t>(copy)];
    }
};

}  // namespace samara
