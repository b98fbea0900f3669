#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <optional>

#include "samara/analysis/metrics/estimate.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/motion/measures.hpp"

namespace samara {

/// Returns the interval (from, to) that holds the probability of an outcome seen `count` times in `samples`
/// with 95 % confidence: Wilson, Probable inference, the law of succession, and statistical inference, JASA
/// 22, 1927.
std::array<double, 2> wilson_interval(int count, int samples);

/// Numbers of falls of each regime.
struct RegimeCounts {
    std::array<int, static_cast<std::size_t>(Regime::autorotating) + 1> counts =
        {};  ///< by regime, in the enumeration's order

    void add(Regime regime) { ++counts[static_cast<std::size_t>(regime)]; }
    [[nodiscard]] int of(Regime regime) const { return counts[static_cast<std::size_t>(regime)]; }
    [[nodiscard]] int total() const;
    /// Returns the regime of most falls; the first in the enumeration of equals.
    [[nodiscard]] Regime commonest() const;
    /// Returns the share of the falls that are of a regime; 0 without falls.
    [[nodiscard]] double share(Regime regime) const;
    /// Returns the 95 % interval of the commonest regime's share: see wilson_interval().
    [[nodiscard]] std::array<double, 2> confidence() const;

    bool operator==(const RegimeCounts&) const = default;
};

/// Metrics by which falls are described and compared.
/// To add a metric: a name here and its entry in metric_catalogue below, in the same order. Members of
/// Measures are then computed, averaged, described and compared everywhere; any other metric is computed in
/// fall_metrics.cpp. The lists at the end of this file say which command judges which metrics.
enum class Metric {
    descent_speed,          ///< m/s
    frequency,              ///< Hz, from the minima of the inclination
    spectral_frequency,     ///< Hz, highest peak of swing_spectrum() above half the frequency
    inclination_amplitude,  ///< rad, 95th percentile
    mean_inclination,       ///< rad
    rms_angular_speed,      ///< rad/s
    path_spread,            ///< m, rms horizontal distance from the release over the window
    drift_speed,            ///< m/s, horizontal mean velocity over the window, whatever its direction
    spin_rate,              ///< rad/s, this and the following of autorotation alone
    coning_angle,           ///< rad
    helix_radius,           ///< m
    spin_up_height,         ///< m
};

/// The part of a motion that a metric describes. The inclination is undefined for a body without a shortest
/// axis (has_shortest_axis()), and the rotation for a body whose look does not depend on its orientation.
enum class MetricSubject { path, inclination, rotation };

/// The error that is allowed of a metric.
struct AllowedError {
    double share = 0.0;             ///< relative, in tolerances of the descent speed
    double always = 0.0;            ///< absolute, in the SI unit: allowed of small values too
    const char* always_words = "";  ///< `always` as text; empty for 0
};

/// A metric as every command and report shows it.
struct CataloguedMetric {
    Metric metric;
    const char* key;           ///< name in JSON
    const char* title;         ///< name in text
    const char* heading = "";  ///< one word, for columns and options
    const char* unit;          ///< unit in text
    double in_unit = 1.0;      ///< factor from the SI value to `unit`
    MetricSubject subject = MetricSubject::path;
    Mean mean = Mean::arithmetic;  ///< mean over several falls
    bool refines_last = false;     ///< whether it is another estimate of the metric before it
    bool relative = true;          ///< whether a difference is read in per cent; else in the unit
    AllowedError allowed = {};     ///< none for metrics that no command judges
    double fitted_miss = 0.0;      ///< relative error of a well fitted fall (docs/studies/falls)
    /// Returns its value; null where Measures does not hold it.
    std::optional<double> (*measured)(const Measures& measures) = nullptr;
};

/// Returns a member of Measures.
template <auto member>
std::optional<double> held(const Measures& measures) {
    return measures.*member;
}

/// Returns a member of the autorotation of Measures; nothing where the body does not autorotate.
template <auto member>
std::optional<double> held_of_autorotation(const Measures& measures) {
    if (!measures.autorotation) return std::nullopt;
    return (*measures.autorotation).*member;
}

// clang-format off
/// All metrics, in the order of Metric.
inline constexpr CataloguedMetric metric_catalogue[] = {
    {.metric = Metric::descent_speed, .key = "descent_speed", .title = "descent speed", .heading = "descent",
     .unit = "m/s", .allowed = {1.0}, .fitted_miss = 0.05, .measured = held<&Measures::descent_speed>},
    {.metric = Metric::frequency, .key = "frequency", .title = "frequency", .heading = "frequency",
     .unit = "Hz", .subject = MetricSubject::inclination, .allowed = {2.0}, .fitted_miss = 0.15,
     .measured = held<&Measures::frequency>},
    {.metric = Metric::spectral_frequency, .key = "spectral_frequency", .title = "by the spectrum's peak",
     .unit = "Hz", .subject = MetricSubject::inclination, .refines_last = true},
    {.metric = Metric::inclination_amplitude, .key = "inclination_amplitude", .title = "amplitude",
     .heading = "amplitude", .unit = "degrees", .in_unit = degrees,
     .subject = MetricSubject::inclination, .allowed = {3.0, degree, "one degree"},
     .fitted_miss = 0.25, .measured = held<&Measures::inclination_amplitude>},
    {.metric = Metric::mean_inclination, .key = "mean_inclination", .title = "mean inclination",
     .unit = "degrees", .in_unit = degrees, .subject = MetricSubject::inclination,
     .relative = false, .measured = held<&Measures::mean_inclination>},
    {.metric = Metric::rms_angular_speed, .key = "rms_angular_speed", .title = "rms angular speed",
     .heading = "rotation", .unit = "rad/s", .subject = MetricSubject::rotation, .mean = Mean::root_mean_square,
     .allowed = {3.0}, .fitted_miss = 0.25, .measured = held<&Measures::rms_angular_speed>},
    {.metric = Metric::path_spread, .key = "path_spread", .title = "path spread", .heading = "path",
     .unit = "m", .mean = Mean::root_mean_square, .relative = false, .allowed = {3.0}},
    {.metric = Metric::drift_speed, .key = "drift_speed", .title = "drift speed", .unit = "m/s",
     .relative = false},
    {.metric = Metric::spin_rate, .key = "spin_rate", .title = "spin about the vertical",
     .unit = "turns/s", .in_unit = 1.0 / (2.0 * std::numbers::pi), .subject = MetricSubject::rotation,
     .measured = held_of_autorotation<&Autorotation::spin_rate>},
    {.metric = Metric::coning_angle, .key = "coning_angle", .title = "coning angle", .unit = "degrees",
     .in_unit = degrees, .subject = MetricSubject::inclination, .relative = false,
     .measured = held_of_autorotation<&Autorotation::coning_angle>},
    {.metric = Metric::helix_radius, .key = "helix_radius", .title = "helix radius", .unit = "mm",
     .in_unit = 1000.0, .measured = held_of_autorotation<&Autorotation::helix_radius>},
    {.metric = Metric::spin_up_height, .key = "spin_up_height", .title = "height lost until it spins",
     .unit = "m", .measured = held_of_autorotation<&Autorotation::spin_up_height>},
};
// clang-format on
inline constexpr std::size_t metric_count = std::size(metric_catalogue);

/// Returns the catalogue's entry of a metric.
constexpr const CataloguedMetric& catalogued(Metric metric) {
    return metric_catalogue[static_cast<std::size_t>(metric)];
}

static_assert(std::ranges::all_of(metric_catalogue,
                                  [](const CataloguedMetric& entry) {
                                      return &entry == &catalogued(entry.metric);
                                  }),
              "the catalogue has the metrics in the order of the enumeration");

/// Returns whether a metric is one of Autorotation, which other falls do not have.
constexpr bool is_of_autorotation(Metric metric) {
    return metric >= Metric::spin_rate && metric <= Metric::spin_up_height;
}

/// One value for each metric.
template <typename Value>
struct PerMetric : std::array<Value, metric_count> {
    using std::array<Value, metric_count>::operator[];
    constexpr Value& operator[](Metric metric) { return (*this)[static_cast<std::size_t>(metric)]; }
    constexpr const Value& operator[](Metric metric) const {
        return (*this)[static_cast<std::size_t>(metric)];
    }
};

/// Metrics on which `samara compare` gives a verdict, in the order of its options.
inline constexpr std::array compared_metrics = {Metric::descent_speed, Metric::frequency,
                                                Metric::inclination_amplitude};
/// Metrics by which sets of models are compared, in the order of the columns.
inline constexpr std::array advised_metrics = {Metric::descent_speed, Metric::inclination_amplitude,
                                               Metric::frequency, Metric::rms_angular_speed,
                                               Metric::path_spread};
/// Metrics that depend on the tables of a bake.
inline constexpr std::array baked_metrics = {Metric::descent_speed, Metric::frequency,
                                             Metric::inclination_amplitude, Metric::rms_angular_speed};
/// Metrics to which dynamic coefficients are fitted, beside the path. All are members of Measures.
inline constexpr std::array fitted_metrics = baked_metrics;

}  // namespace samara
