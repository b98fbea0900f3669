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

/// The history of a vector.
struct VectorHistory {
    HistoryFiles files;
    std::vector<double> times;  ///< ascending
    std::vector<Vector3d> values;
};

/// The output of the function object `forces`: total force and moment by pressure, friction and porous zones,
/// in the case's units.
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

/// Statistics of a stationary series about its mean.
struct SeriesFluctuation {
    MeasuredNumber mean;              ///< with standard_error()
    MeasuredNumber rms;               ///< of the fluctuation, about the mean
    MeasuredNumber correlation_time;  ///< integral of the autocorrelation to its first zero
    Spectrum spectrum;                ///< of the fluctuation, Welch's, in segments of a quarter
    std::optional<double>
        peak_frequency;  ///< of the spectrum, among those with more than one period in a segment
};

/// Computes the statistics of values `time_step` apart, in the units of both. The errors of rms and
/// correlation time are the standard deviation over six pieces divided by the square root of six; they do not
/// cover changes slower than a piece. At least sixty values are needed.
SeriesFluctuation fluctuation_of(const std::vector<double>& values, double time_step);

/// The names of the load's components, in the order of LoadFluctuations.
inline constexpr std::array load_components = {"force_x",  "force_y",  "force_z",
                                               "moment_x", "moment_y", "moment_z"};

/// The loads of a body that is held in a flow solved in time, in body axes: coefficients relative to rho U^2
/// A/2 with A = pi L^2/4, for the moment about the centroid also to L; times in L/U.
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
/// `parameters` and postProcessing/forces of the template body-flow, its histories interpolated to even
/// times. Throws Error naming file and remedy where the case is steady, where something is missing or
/// damaged, or where fewer than sixty steps are left.
LoadFluctuations reduce_fluctuations(const std::filesystem::path& case_folder,
                                     const std::optional<double>& begin = {});

/// Returns a CSV table with a row for each case and component after a row of names: mean, rms, correlation
/// time and peak, with errors.
std::string fluctuations_csv(const std::vector<LoadFluctuations>& cases);

/// Returns the spectra as a CSV table: a row for each case, component and frequency (U/L), with the power in
/// coefficient^2 L/U.
std::string fluctuation_spectra_csv(const std::vector<LoadFluctuations>& cases);

}  // namespace samara
