#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "converter/falls/fall_record.hpp"
#include "foam-cases/bake/bake_plan.hpp"
#include "foam-cases/bake/bake_quality.hpp"
#include "foam-cases/falls/fall_plan.hpp"
#include "foam-cases/farm/case_farm.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/kernel/body_state.hpp"
#include "samara/motion/motion.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// Motion files of other solutions of a scene, by the cause of their difference ("mesh", "closure"): one, to
/// be compared with the motion itself, or two, to be compared with each other.
using OtherSolutions = std::map<std::string, std::vector<std::filesystem::path>>;

/// A scene that is to be solved by full CFD.
struct ValidationRequest {
    Scene scene;
    std::filesystem::path output;  ///< the motion file
    double cells =
        BakeQuality()
            .fall_cells;  ///< approximate number of cells of the mesh, by default as for the falls of a bake
    double step = 1.0;    ///< relative to the model's time step
    double fields = 0.0;  ///< flow fields per second that are kept for pictures; 0: none
    Closure closure = Closure::k_omega_sst_lm;  ///< above the laminar Reynolds number
    OtherSolutions beside;                      ///< give the motion's uncertainties
};

/// The limit above which a fall gets a warning: a step moves the fluid past several cells, and the solution
/// is smeared.
inline constexpr double largest_good_courant_number = 5.0;

/// How a fall was solved.
struct FallSolution {
    std::vector<std::string> attempts;  ///< in words; the last one succeeded
    double time_step = 0.0;             ///< in L/U
    double largest_courant_number = 0.0;
    int cells = 0;  ///< of the mesh
};

/// The result of validate_scene().
struct ValidationResult {
    BakePlan plan;                        ///< with a fall for each copy of the body
    std::vector<FallSolution> solutions;  ///< of each fall
    std::vector<FallBalance> balances;    ///< of each fall
    Motion motion;
    double cpu_seconds = 0.0;  ///< of the mesh and the falls
    std::size_t reused = 0;    ///< falls that an earlier run had solved

    /// Returns the largest residuals of all falls, of force and moment separately.
    [[nodiscard]] FallBalance worst_balance() const;
    /// Returns the largest Courant number of all falls.
    [[nodiscard]] double largest_courant_number() const;
};

/// Reads a motion and replaces its uncertainties by those from other solutions (uncertainty_beside) of the
/// same causes. Throws Error where one of the files cannot be read or compared with the other.
Motion with_uncertainties(const std::filesystem::path& file, const OtherSolutions& beside);

/// Throws Error unless full CFD can solve the scene: it must have one body, whose copies are of one size, no
/// ground, no obstacles, no wind and no gust.
void require_falls_of_one_body(const Scene& scene);

/// Meshes the body and plans its falls; writes nothing. Throws Error.
BakePlan prepare_validation(const ValidationRequest& request);

/// Solves the scene's falls, one for each copy of its body, in full CFD, in the folder of cases beside the
/// output, and writes the motion file. Falls that an earlier call solved with the same inputs are reused;
/// interrupted ones are continued. `planned` is called with the plan before the long work begins. Throws
/// Error, also where one of the falls could not be solved: the others are kept.
ValidationResult validate_scene(const ValidationRequest& request, const FarmOptions& farm,
                                const std::function<void(const BakePlan&)>& planned);

/// A solved fall with its start in the flow's frame at `start_time` (s), until which the body is held.
struct SolvedFall {
    FallRecord record;
    BodyState start;
    double start_time = 0.0;
};

/// Gives the motion's one body, a copy for each fall, their poses at the motion's times, interpolated from
/// the falls' steps. Frames after the last step of any are dropped, but for one within half a step of it.
/// Throws Error where no second frame is left.
void take_falls(const std::vector<SolvedFall>& falls, const Surroundings& surroundings, Motion& motion);

}  // namespace samara
