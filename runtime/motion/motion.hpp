#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/contact_points.hpp"
#include "samara/core/physics/fluid_load.hpp"
#include "samara/core/physics/obstacle.hpp"
#include "samara/core/physics/pose.hpp"
#include "samara/core/surface/display_mesh.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Uncertainty of a metric of a motion for a reason that its own swings do not show, such as the mesh of a
/// fall by full CFD: the difference from another solution, and the standard error of that difference.
struct MetricUncertainty {
    std::string cause;      ///< such as "mesh" or "closure"
    std::string metric;     ///< name as in JSON: descent_speed, frequency, ...
    double relative = 0.0;  ///< the difference relative to the metric, 0 or more
    double chance = 0.0;    ///< standard error of the difference relative to the metric, 0 or more

    /// Returns whether all members are equal.
    friend bool operator==(const MetricUncertainty&, const MetricUncertainty&) = default;
};

/// One body of the scene with all its copies, runs and frames.
struct BodyMotion {
    std::string name;  ///< unique in the scene
    Vector3d center_of_mass =
        Vector3d::Zero();  ///< m, shape axes: subtract R times this to place the shape's origin
    Vector3d shortest_axis =
        Vector3d::UnitZ();  ///< principal axis of the shortest extent, shape axes: of the inclination
    std::string body_hash;  ///< content hash of the body file that was simulated
    std::string models;     ///< text: the loads, turbulence and defaults that were used
    Surface surface;        ///< shape axes, so that a motion file can be shown by itself
    std::shared_ptr<const DisplayMesh>
        display;                   ///< mesh that exports show instead of the surface; may be null
    ContactPoints contact_points;  ///< points of the surface that can touch; empty without a ground
    int copies = 1;                ///< copies of the body, each with poses of its own
    /// Lengths of each copy relative to the surface's, index run * copies + copy; empty where all are 1.
    std::vector<double> sizes;
    std::vector<MetricUncertainty> uncertainties;  ///< sorted by cause and metric; empty where none are known
    std::vector<Pose> poses;                       ///< index ((run * frames) + frame) * copies + copy
    std::vector<FluidForces> forces;               ///< likewise; empty where they were not asked for

    /// Returns the lengths of a copy in a run, each counted from 0, relative to the surface's.
    [[nodiscard]] double size(int run, int copy) const {
        if (sizes.empty()) return 1.0;
        return sizes[static_cast<std::size_t>(run) * static_cast<std::size_t>(copies) +
                     static_cast<std::size_t>(copy)];
    }
};

/// The result of a simulation: poses of all bodies at frames of even distance.
struct Motion {
    std::vector<double> times;                     ///< s
    int runs = 1;                                  ///< repetitions with other noise and starts
    double frame_rate = 60.0;                      ///< frames per second
    Vector3d gravity = Vector3d(0.0, 0.0, -9.81);  ///< m/s^2, world axes
    std::optional<double> ground;                  ///< m: the height of the ground, where there is one
    std::vector<Obstacle> obstacles;               ///< solids besides the ground that the bodies could touch
    std::uint64_t seed = 1;                        ///< seed of the noise and the starts
    bool has_forces = false;                       ///< whether the fluid's forces were kept
    std::string scene_text;                        ///< the scene file as it was read
    std::vector<BodyMotion> bodies;                ///< bodies in the scene's order

    /// Returns the number of frames.
    [[nodiscard]] int frames() const { return static_cast<int>(times.size()); }
    /// Returns the place in BodyMotion::poses and forces of a copy in a run at a frame, each counted from 0.
    [[nodiscard]] std::size_t index(const BodyMotion& body, int run, int frame, int copy) const {
        const auto row = static_cast<std::size_t>(run) * times.size() + static_cast<std::size_t>(frame);
        return row * static_cast<std::size_t>(body.copies) + static_cast<std::size_t>(copy);
    }
    /// Returns the pose of a copy in a run at a frame, each counted from 0.
    [[nodiscard]] const Pose& pose(const BodyMotion& body, int run, int frame, int copy) const {
        return body.poses[index(body, run, frame, copy)];
    }
};

/// Some of the copies of a body, one after another.
struct CopySpan {
    std::size_t first = 0;  ///< number of the first of them
    std::size_t count = 0;  ///< how many there are; may be 0
};

/// Poses of some copies of a body at some frames, (run, frame, copy) in row-major order.
struct MotionBlock {
    std::size_t body = 0;             ///< number of the body in the motion
    std::size_t first_frame = 0;      ///< number of the first frame
    CopySpan copies;                  ///< the copies whose poses these are
    std::vector<Pose> poses;          ///< in all runs
    std::vector<FluidForces> forces;  ///< of each pose, in a motion that has them
};

}  // namespace samara
