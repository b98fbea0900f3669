#include "converter/cases/load_fluctuations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "converter/openfoam/foam_dictionary.hpp"
#include "converter/tables/standard_error.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

constexpr std::size_t pieces = 6;
constexpr std::size_t segments = 4;
constexpr std::size_t fewest_values = 60;
constexpr double coefficients_per_force = 8.0 / std::numbers::pi;  // 1/(A/2)

constexpr const char* forces = "postProcessing/forces";

bool is_steady(const FoamDictionary& parameters) {
    return parameters.text("rateOfChange") == "steadyState";
}

double rms_about(const double* first, std::size_t count, double center) {
    double squares = 0.0;
    for (std::size_t i = 0; i < count; ++i) squares += (first[i] - center) * (first[i] - center);
    return std::sqrt(squares / static_cast<double>(count));
}

// Returns the correlation time in steps: the integral of the autocorrelation, by the trapezoidal rule, up to
// where it first is not positive.
double correlation_steps(const double* first, std::size_t count, double center) {
    double variance = 0.0;
    double sum = 0.5;
    for (std::size_t lag = 0; lag < count; ++lag) {
        double products = 0.0;
        for (std::size_t i = 0; i + lag < count; ++i) {
            products += (first[i] - center) * (first[i + lag] - center);
        }
        if (lag == 0) {
            variance = products;
            if (variance == 0.0) return 0.0;
            continue;
        }
        // Normalised, since larger lags have fewer pairs.
        const double correlation =
            products / variance * static_cast<double>(count) / static_cast<double>(count - lag);
        if (correlation <= 0.0) break;
        sum += correlation;
    }
    return sum;
}

double scatter_of(const std::array<double, pieces>& values) {
    double center = 0.0;
    for (const double value : values) center += value / pieces;
    double squares = 0.0;
    for (const double value : values) squares += (value - center) * (value - center);
    return std::sqrt(squares / (pieces * (pieces - 1.0)));
}

// Interpolates the component of a history at even times from `begin` on, `step` apart.
std::vector<double> even(const VectorHistory& history, int component, double begin, double step,
                         std::size_t count) {
    std::vector<double> values(count);
    std::size_t after = 1;
    for (std::size_t i = 0; i < count; ++i) {
        const double time = begin + step * static_cast<double>(i);
        while (after + 1 < history.times.size() && history.times[after] < time) ++after;
        const double length = history.times[after] - history.times[after - 1];
        const double share = std::clamp((time - history.times[after - 1]) / length, 0.0, 1.0);
        values[i] =
            (1.0 - share) * history.values[after - 1][component] + share * history.values[after][component];
    }
    return values;
}

}  // namespace

SeriesFluctuation fluctuation_of(const std::vector<double>& values, double time_step) {
    SeriesFluctuation result;
    const double center = mean(values);
    result.mean = {center, standard_error(values)};
    const std::size_t length = values.size() / pieces;
    std::array<double, pieces> piece_rms{};
    std::array<double, pieces> piece_times{};
    for (std::size_t piece = 0; piece < pieces; ++piece) {
        piece_rms[piece] = rms_about(&values[piece * length], length, center);
        piece_times[piece] = time_step * correlation_steps(&values[piece * length], length, center);
    }
    result.rms = {rms_about(values.data(), values.size(), center), scatter_of(piece_rms)};
    result.correlation_time = {time_step * correlation_steps(values.data(), values.size(), center),
                               scatter_of(piece_times)};
    const std::size_t segment = std::max<std::size_t>(values.size() / segments, 2);
    result.spectrum = power_spectrum(values, time_step, segment);
    result.peak_frequency = peak_frequency(result.spectrum, 1.0 / (time_step * static_cast<double>(segment)));
    return result;
}

bool is_solved_in_time(const std::filesystem::path& case_folder) {
    return std::filesystem::is_directory(case_folder / forces) &&
           !is_steady(FoamDictionary(case_folder / "parameters"));
}

LoadFluctuations reduce_fluctuations(const std::filesystem::path& case_folder,
                                     const std::optional<double>& begin) {
    const FoamDictionary parameters(case_folder / "parameters");
    if (is_steady(parameters)) {
        throw Error(fmt::format("{}: the case is steady; fluctuations need an unsteady case",
                                (case_folder / "parameters").string()));
    }
    const LoadHistory history = read_load_history(case_folder / forces);
    const std::vector<double>& times = history.force.times;
    if (times != history.moment.times) {
        throw Error(fmt::format("{}: force and moment have different times; solve the case again",
                                (case_folder / forces).string()));
    }
    LoadFluctuations result;
    result.name = case_folder.filename().string();
    result.direction = parameters.vector("direction");
    result.reynolds_number = parameters.number("reynoldsNumber");
    result.end = times.back();
    result.begin = begin.value_or(result.end / 3.0);
    const auto first = std::ranges::lower_bound(times, result.begin);
    const auto steps = static_cast<std::size_t>(times.end() - first);
    if (steps < fewest_values) {
        throw Error(fmt::format(
            "{}: has {} steps from the time {:.4g} on, but fluctuations need {}; solve the case for longer",
            case_folder.string(), steps, result.begin, fewest_values));
    }
    result.begin = *first;
    const double step = (result.end - result.begin) / static_cast<double>(steps - 1);
    for (int i = 0; i < 3; ++i) {
        std::vector<double> force = even(history.force, i, result.begin, step, steps);
        std::vector<double> moment = even(history.moment, i, result.begin, step, steps);
        for (double& value : force) value *= coefficients_per_force;
        for (double& value : moment) value *= coefficients_per_force;
        result.components[static_cast<std::size_t>(i)] = fluctuation_of(force, step);
        result.components[static_cast<std::size_t>(i) + 3] = fluctuation_of(moment, step);
    }
    return result;
}

std::string fluctuations_csv(const std::vector<LoadFluctuations>& cases) {
    std::string text =
        "case,direction_x,direction_y,direction_z,reynolds_number,begin,end,component,mean,mean_error,rms,"
        "rms_error,correlation_time,correlation_time_error,peak_frequency\n";
    for (const LoadFluctuations& one : cases) {
        for (std::size_t i = 0; i < one.components.size(); ++i) {
            const SeriesFluctuation& of = one.components[i];
            text += fmt::format("{},{:.9g},{:.9g},{:.9g},{:.9g},{:.6g},{:.6g},{},", one.name,
                                one.direction.x(), one.direction.y(), one.direction.z(), one.reynolds_number,
                                one.begin, one.end, load_components[i]);
            text +=
                fmt::format("{:.6g},{:.3g},{:.6g},{:.3g},{:.6g},{:.3g},{}\n", of.mean.value, of.mean.error,
                            of.rms.value, of.rms.error, of.correlation_time.value, of.correlation_time.error,
                            of.peak_frequency ? fmt::format("{:.5g}", *of.peak_frequency) : "");
        }
    }
    return text;
}

std::string fluctuation_spectra_csv(const std::vector<LoadFluctuations>& cases) {
    std::string text = "case,component,frequency,power\n";
    for (const LoadFluctuations& one : cases) {
        for (std::size_t i = 0; i < one.components.size(); ++i) {
            const Spectrum& spectrum = one.components[i].spectrum;
            for (std::size_t k = 0; k < spectrum.power.size(); ++k) {
                text += fmt::format("{},{},{:.5g},{:.5g}\n", one.name, load_components[i],
                                    spectrum.frequency(k), spectrum.power[k]);
            }
        }
    }
    return text;
}

namespace {

/// Returns the sum of the vectors whose x components are in the columns `first`.
VectorHistory sum_of(const FoamHistory& history, const std::vector<std::size_t>& first) {
    VectorHistory sum{history.files, {}, {}};
    for (const std::vector<double>& row : history.rows) {
        Vector3d value = Vector3d::Zero();
        for (const std::size_t x : first) value += Vector3d(row[x], row[x + 1], row[x + 2]);
        sum.times.push_back(row.front());
        sum.values.push_back(value);
    }
    return sum;
}

VectorHistory read_total(const std::filesystem::path& folder, const std::string& name) {
    const FoamHistory history = read_joined_history(folder, name);
    static_cast<void>(history.index("total_z"));
    return sum_of(history, {history.index("total_x")});
}

/// Returns the sum of the vectors of OpenFOAM .org's forces.dat whose names begin with `group`, such as
/// forces_pressure.
VectorHistory sum_of_group(const FoamHistory& history, const std::string& group) {
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < history.columns.size(); ++i) {
        if (history.columns[i].starts_with(group) && history.columns[i].ends_with("_x")) first.push_back(i);
    }
    if (first.empty()) {
        throw Error(fmt::format("{}: has no column '{}pressure'", history.file.string(), group));
    }
    return sum_of(history, first);
}

}  // namespace

LoadHistory read_load_history(const std::filesystem::path& folder) {
    if (!history_files(folder, "force").empty() || history_files(folder, "forces").empty()) {
        return {read_total(folder, "force"), read_total(folder, "moment")};
    }
    const FoamHistory history = read_joined_history(folder, "forces");
    const bool singular = history.has("moment_pressure_x");
    return {sum_of_group(history, "forces_"), sum_of_group(history, singular ? "moment_" : "moments_")};
}

}  // namespace samara
