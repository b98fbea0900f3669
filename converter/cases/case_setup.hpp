#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// What a case says that it solves, in its own units and axes; absent where it does not say so in plain
/// numbers (or by a $name of the same file or of one that it includes).
struct CaseSetup {
    std::optional<double> viscosity;  ///< kinematic: nu of constant/transportProperties or physicalProperties
    std::optional<Vector3d> flow;     ///< velocity far from the body: what the patches of 0/U agree on
    std::optional<double> density;    ///< rhoInf of the function object `forces` in system/controlDict
    std::vector<std::string> patches;  ///< of the body, names or patterns: those of `forces`
};

/// Reads the set-up of the case in the folder. What cannot be read is absent.
CaseSetup read_case_setup(const std::filesystem::path& folder);

/// The area of the patches of FOLDER/constant/polyMesh that the names or patterns ("body.*") take in; nothing
/// where there is no whole mesh, no such patch, or a pattern of another kind.
std::optional<double> area_of_patches(const std::filesystem::path& poly_mesh,
                                      const std::vector<std::string>& patches);

}  // namespace samara
