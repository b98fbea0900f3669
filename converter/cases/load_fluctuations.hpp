#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "converter/openfoam/foam_history.hpp"
#include "samara/analysis/metrics/spectrum.hpp"
#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A vector at every iteration.
struct VectorHistory {
    HistoryFiles files;
    std::vector<double> times;  ///< ascending
    std::vector<Vector3d> values;
};

/// What the function object `forces` wrote: the whole force and moment, of pressure and friction (and porous
/// zones), in the case's units.
struct LoadHistory {
    VectorHistory force;
    VectorHistory moment;
};

/// Reads postProcessing/forces over all runs (read_joined_history): force.dat and moment.dat of OpenFOAM
/// .com, or forces.dat of .org, whose parts are added up. Throws Error where neither is there, or one is
/// damaged.
LoadHistory read_load_history(const std::filesystem::path& folder);

/// A number and its standard error.
struct MeasuredNumber {
    double value = 0.0;
    double error = 0.0;
};

/// What a stationary series does about its mean.
struct SeriesFluctuation {
    MeasuredNumber mean;                   ///< its error as standard_error()
    MeasuredNumber rms;                    ///< of the fluctuation, about the mean
    MeasuredNumber correlation_time;       ///< integral of the autocorrelation to its first zero
    Spectrum spectrum;                     ///< of the fluctuation, Welch's, in segments of a quarter
    std::optional<double> peak_frequency;  ///< of the spectrum, above one period in a segment
};

/// The fluctuation of values `time_step` apart, in the units of both. The errors of rms and correlation time
/// are the scatter of six pieces over the root of their number: they tell nothing of what is slower than a
/// piece. At least sixty values.
SeriesFluctuation fluctuation_of(const std::vector<double>& values, double time_step);

/// The names of the load's components, in the order of LoadFluctuations.
inline constexpr std::array load_components = {"force_x",  "force_y",  "force_z",
                                               "moment_x", "moment_y", "moment_z"};

/// The loads of a body that is held in a flow solved in time, in body axes: coefficients on rho U^2 A/2 with
/// A = pi L^2/4, of the moment about the centroid also on L, over times in L/U.
struct LoadFluctuations {
    std::string name;  ///< of the case
    Vector3d direction = Vector3d::Zero();
    double reynolds_number = 0.0;
    double begin = 0.0;  ///< L/U
    double end = 0.0;    ///< L/U
    std::array<SeriesFluctuation, load_components.size()> components;
};

/// Whether a folder holds a case that was solved in time and has a history of its forces.
bool is_solved_in_time(const std::filesystem::path& case_folder);

/// Reduces the solved unsteady case in a folder from the time `begin` on (default: the last two thirds):
/// `parameters` and postProcessing/forces of the template body-flow, its histories laid on even times. Throws
/// Error naming file and remedy where the case is steady, where something is missing or damaged, or where
/// fewer than sixty steps are left.
LoadFluctuations reduce_fluctuations(const std::filesystem::path& case_folder,
                                     const std::optional<double>& begin = {});

/// A row for each case and component after a row of names: mean, rms, correlation time and peak, with errors.
std::string fluctuations_csv(const std::vector<LoadFluctuations>& cases);

/// The spectra: a row for each case, component and frequency (U/L), its power in coefficient^2 L/U.
std::string fluctuation_spectra_csv(const std::vector<LoadFluctuations>& cases);

}  // namespace samara
