#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "converter/falls/fall_record.hpp"
#include "samara/core/body/body.hpp"
#include "samara/motion/measures.hpp"

namespace samara {

/// How one fall's figures compare when the identified model flies it from the same start.
struct FlownFall {
    std::string name;
    Measures solved;      ///< of the full CFD
    Measures flown;       ///< of the runtime
    FallBalance balance;  ///< of the full CFD
};

/// One fall of a body as a motion, solved and flown.
struct FallMotions {
    Motion solved;  ///< of the full CFD
    Motion flown;   ///< of the runtime, at the same times
};

/// Dynamic coefficients that were identified, and how good they are.
struct Identification {
    IdentifiedCoefficients coefficients;
    /// Root mean square, over a horizon's quarters, of what the flights miss: velocity over the fall's speed,
    /// tip speed over it, and rotation (rad).
    double prediction_error = 0.0;
    int segments = 0;
    std::vector<FlownFall> falls;  ///< those that the coefficients are from
};

/// Into how many stretches each fall is cut, one of which is left out at a time.
inline constexpr int identification_stretches = 6;

/// What an identification does without.
struct LeftOutOfFalls {
    std::vector<std::string> terms = {};        ///< motion_parameters.hpp: to see what they do
    std::optional<int> stretch = std::nullopt;  ///< of each fall, from 0: to see what chance does
};

/// Identifies a body's dynamic coefficients from full-CFD falls of it.
///
/// The runtime's own step flies the body from many moments of each fall over a short horizon, and each fall
/// as a whole; the coefficients are those with which it misses those stretches, and the whole falls' descent
/// speed, frequency, amplitude and rms angular speed, least (least_squares.hpp; docs/studies/falls, "How the
/// coefficients are found"), near what is expected of any body where the falls do not say
/// (motion_parameters.hpp), and positive where the loads would else make energy. Their standard errors come
/// from leaving out one of six stretches of the falls at a time (jackknife), and from how far what is
/// expected may be off. `body` must have its Kirchhoff tensor and its tables. `progress` is told the share
/// done, from 0 to 1. Throws Error where there is no fall, or, with its name, where one is of another body,
/// too short (9 L/U), or of steps that are not of one length.
Identification identify_motion(const Body& body, const std::vector<FallRecord>& falls,
                               const LeftOutOfFalls& left_out = {},
                               const std::function<void(double)>& progress = {});

/// The figures of a body with its coefficients on a solved fall, whether or not they are from it. Throws
/// Error as identify_motion does, but takes falls of any length.
FlownFall fly_fall(const Body& body, const FallRecord& record);

/// The motions that fly_fall() has its figures from, with the body's surface, turned so that gravity points
/// along -z. Throws Error as it does.
FallMotions fall_motions(const Body& body, const FallRecord& record);

/// The identification in SI units: prediction_error, segments, coefficients and falls, each fall with its
/// figures by full CFD (solved) and by the runtime (flown).
nlohmann::json identification_as_json(const Identification& identification);
nlohmann::json flown_fall_as_json(const FlownFall& fall);

/// The same for people: lines, each ended.
std::string identification_as_text(const Identification& identification);
std::string flown_fall_as_text(const FlownFall& fall);

}  // namespace samara
