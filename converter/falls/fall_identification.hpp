#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "converter/falls/fall_record.hpp"
#include "samara/analysis/advice/model_judgement.hpp"
#include "samara/core/body/body.hpp"
#include "samara/motion/measures.hpp"

namespace samara {

/// The metrics of one fall by full CFD, and by the runtime from the same start.
struct SimulatedFall {
    std::string name;
    Measures solved;      ///< of the full CFD
    Measures simulated;   ///< of the runtime
    FallBalance balance;  ///< of the full CFD
};

/// One fall of a body as motions by full CFD and by the runtime.
struct FallMotions {
    Motion solved;     ///< of the full CFD
    Motion simulated;  ///< of the runtime, at the same times
};

/// Identified dynamic coefficients, and their quality.
struct Identification {
    IdentifiedCoefficients coefficients;
    /// Root mean square, over the samples of all segments, of the differences between simulation and fall:
    /// velocity and tip speed relative to the fall's speed, and rotation (rad).
    double prediction_error = 0.0;
    int segments = 0;
    std::vector<SimulatedFall> falls;  ///< those that the coefficients were identified from
};

/// The number of stretches into which each fall is divided for the jackknife, which leaves out one at a time.
inline constexpr int identification_stretches = 6;

/// The terms and stretches that an identification leaves out.
struct LeftOutOfFalls {
    std::vector<std::string> terms = {};        ///< as MotionParameters::names(), to see their effect
    std::optional<int> stretch = std::nullopt;  ///< of each fall, from 0: to see the effect of chance
};

/// Identifies a body's dynamic coefficients from full-CFD falls of it.
///
/// The runtime's step simulates the body from many moments of each fall over a short horizon, and each whole
/// fall. The coefficients minimise the differences over these segments and of the whole falls' descent speed,
/// frequency, amplitude and rms angular speed (least_squares.hpp; docs/studies/falls, "How the coefficients
/// are found"); where the falls do not determine them, they stay near what is expected of any body
/// (motion_parameters.hpp), and they are positive where the loads would otherwise generate energy. Their
/// standard errors are by the jackknife over six stretches of the falls, and by the uncertainty of the
/// expectation. `body` must have its Kirchhoff tensor and its tables. `progress` is called with the share
/// done, from 0 to 1. Throws Error where there is no fall, or, with its name, where one is of another body,
/// too short (9 L/U), or of steps that are not of one length.
Identification identify_motion(const Body& body, const std::vector<FallRecord>& falls,
                               const LeftOutOfFalls& left_out = {},
                               const std::function<void(double)>& progress = {});

/// Simulates a solved fall by the runtime with the body's own coefficients and the models, and returns the
/// metrics of both. Throws Error as identify_motion does, but takes falls of any length.
SimulatedFall simulate_fall(const Body& body, const FallRecord& record, const RecommendedModels& models = {});

/// Judges the models that the body may be simulated with by its falls, of which there is at least one. Those
/// of the tables were fitted to falls from which coefficients were identified; those of the surface were not.
ModelJudgement judge_models_by(const Body& body, const std::vector<FallRecord>& falls);

/// Returns the motions of simulate_fall() with the body's surface, rotated so that gravity points along -z.
/// Throws Error as simulate_fall() does.
FallMotions fall_motions(const Body& body, const FallRecord& record);

/// Returns the identification as JSON in SI units: prediction_error, segments, coefficients and falls, each
/// fall with its metrics by full CFD (solved) and by the runtime (flown).
nlohmann::json identification_as_json(const Identification& identification);
nlohmann::json simulated_fall_as_json(const SimulatedFall& fall);

/// Return the identification, or one fall, as lines of text.
std::string identification_as_text(const Identification& identification);
std::string simulated_fall_as_text(const SimulatedFall& fall);

}  // namespace samara
