#pragma once

#include <cstdint>

#include "samara.h"
#include "samara/dynamics/surroundings.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// What a caller's samara_settings say.
struct SimulationSettings {
    Fluid fluid;  ///< its current is that of the surroundings
    Surroundings surroundings;
    double step = 0.002;  ///< s
    std::uint64_t seed = 1;
    std::uint32_t run = 0;
    int threads = 1;  ///< 0: all cores
};

/// The settings with which an empty samara_settings is filled.
samara_settings default_settings();

/// Checks a caller's settings. Throws Fault of SAMARA_INVALID_ARGUMENT, naming the member, where a number is
/// not finite or out of its range, or where the struct is not of a known size.
SimulationSettings read_settings(const samara_settings& settings);

/// The kind with which an empty samara_kind is filled.
samara_kind default_kind();

/// Checks a caller's kind, as read_settings does. Its shape is left empty, and its name where the caller gave
/// none.
SceneBody read_kind(const samara_kind& kind);

}  // namespace samara
