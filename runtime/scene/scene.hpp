#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/recommended_models.hpp"
#include "samara/core/physics/body_physics.hpp"
#include "samara/core/physics/fluid.hpp"
#include "samara/core/physics/obstacle.hpp"
#include "samara/core/physics/precision.hpp"
#include "samara/core/physics/release.hpp"
#include "samara/core/surface/display_mesh.hpp"
#include "samara/core/wind/wind.hpp"

namespace samara {

/// One [[body]] of a scene: its physics, and how it starts.
struct SceneBody : BodyPhysics, Release {
    std::string name;             ///< unique in the scene
    std::filesystem::path shape;  ///< a shape file or a .body.h5, as found from the scene file's folder
    double scale = 1.0;           ///< metres for one unit of the shape file; 1 of a body file
    double thickness = 0.0;       ///< m: what an open sheet is thickened to; 0: the shape is a solid
    std::shared_ptr<const DisplayMesh>
        display;  ///< mesh for exports, in metres and shape axes; null: its surface
    bool models_auto =
        false;  ///< whether the model advice chooses the models (docs/explanation/what-a-scene-needs.md)
    OpenModels open;  ///< the models that the scene leaves to the body's file: choose_open_models()
};

/// A scene file, checked: every number is finite and in its range.
struct Scene {
    double duration = 0.0;  ///< s
    double step = 0.002;    ///< s
    bool step_auto =
        false;  ///< whether the step is chosen by the bodies' time scales (docs/explanation/integrator.md)
    Precision precision = Precision::double_precision;  ///< of the steps
    double step_tolerance = 0.005;  ///< largest error of the step, relative to the displacement
    double frame_rate = 60.0;       ///< frames per second
    std::uint64_t seed = 1;         ///< seed of the noise and the spread of starts
    Vector3d gravity = Vector3d(0.0, 0.0, -9.81);  ///< m/s^2
    std::optional<double> ground;                  ///< m: the height of level ground
    bool bodies_collide = false;                   ///< whether the bodies of a run touch each other
    Fluid fluid;                                   ///< the fluid around the bodies
    Wind wind;                                     ///< beside current and gust
    std::vector<Obstacle> obstacles;               ///< in the file's order, with unique names
    std::vector<SceneBody> bodies;                 ///< in the file's order
    std::string text;                              ///< the file as it was read
    std::filesystem::path file;                    ///< where it was read from
};

}  // namespace samara
