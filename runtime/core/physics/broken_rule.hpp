#pragma once

#include <optional>
#include <string>
#include <vector>

#include "samara/core/physics/body_physics.hpp"
#include "samara/core/physics/fluid.hpp"
#include "samara/core/physics/obstacle.hpp"
#include "samara/core/physics/precision.hpp"
#include "samara/core/physics/release.hpp"

namespace samara {

/// A rule that settings break, whoever gave them: scene files and the C interface hold theirs against the
/// same rules, and name the member in their own words.
struct BrokenRule {
    std::string member;  ///< the path of the scene file's keys, as "spread.angle"
    std::string what;    ///< is wrong with it, in words to stand behind its name
};

/// How many copies a body may have.
inline constexpr int most_copies = 10'000'000;

/// The first rule that a fluid breaks: its numbers lie in their ranges. Nothing where it is sound.
std::optional<BrokenRule> broken_rule(const Fluid& fluid);

/// The first rule that a mass breaks: density and mass exclude each other, and centre and inertia need the
/// mass. Nothing where it is sound or not given. Needs vectors and matrices of finite numbers, as all below.
std::optional<BrokenRule> broken_rule(const MassSpecification& mass);

/// The first rule that a body's physics breaks: ranges, those of its mass, and which models go together. What
/// the body's file must hold for it is not judged. Nothing where it is sound.
std::optional<BrokenRule> broken_rule(const BodyPhysics& physics);

/// Single precision of bodies that touch each other. Nothing where they go together.
std::optional<BrokenRule> broken_rule(Precision precision, bool bodies_collide);

/// The first rule that a release breaks: ranges, and that a spread is of several copies. Nothing where it is
/// sound.
std::optional<BrokenRule> broken_rule(const Release& release);

/// Keys that are not in ascending order of time. Nothing where they are.
std::optional<BrokenRule> broken_rule(const std::vector<ObstacleKey>& keys);

/// The first rule that an obstacle, or the mesh of an emitter, breaks: its friction is none, or its keys are
/// out of order or jump (most_key_speed), so that it would strike every body on its path. The speed is that
/// of the origin and, added to it, that of the farthest vertex about the origin. Nothing where it is sound.
std::optional<BrokenRule> broken_rule(const Obstacle& obstacle);

}  // namespace samara
