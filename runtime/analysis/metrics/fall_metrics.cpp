#include "samara/analysis/metrics/fall_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "samara/core/base/numbers.hpp"
#include "samara/motion/inclination.hpp"

namespace samara {
namespace {

constexpr std::size_t fewest_pieces = 3;
constexpr std::size_t most_left_out = 16;
constexpr std::size_t most_stretches = 64;

/// Integrals over the time of a piece, which can be added.
struct Sums {
    double duration = 0.0;                              // s
    double time = 0.0;                                  // s^2, of the time
    Vector3d displacement = Vector3d::Zero();           // m, of the velocity
    Vector3d displacement_integral = Vector3d::Zero();  // m s, of the displacement since the release
    double inclination = 0.0;                           // rad s
    double squared_spin = 0.0;                          // rad^2/s
    double upright_angle = 0.0;                         // rad
};

Sums& operator+=(Sums& sum, const Sums& other) {
    sum.duration += other.duration;
    sum.time += other.time;
    sum.displacement += other.displacement;
    sum.displacement_integral += other.displacement_integral;
    sum.inclination += other.inclination;
    sum.squared_spin += other.squared_spin;
    sum.upright_angle += other.upright_angle;
    return sum;
}

/// Integrates a piece by the trapezoidal rule.
Sums sums_of(const FallSeries& record, const Piece& piece) {
    Sums sums;
    sums.displacement = record.displacements[piece.end - 1] - record.displacements[piece.begin];
    for (std::size_t i = piece.begin + 1; i < piece.end; ++i) {
        const double half = 0.5 * (record.times[i] - record.times[i - 1]);
        sums.duration += 2.0 * half;
        sums.time += half * (record.times[i - 1] + record.times[i]);
        sums.displacement_integral += half * (record.displacements[i - 1] + record.displacements[i]);
        sums.inclination += half * (record.inclinations[i - 1] + record.inclinations[i]);
        sums.squared_spin += half * (record.squared_spins[i - 1] + record.squared_spins[i]);
        sums.upright_angle += half * (record.upright_spins[i - 1] + record.upright_spins[i]);
    }
    return sums;
}

Vector3d horizontal(const FallSeries& record, const Vector3d& vector) {
    return vector - vector.dot(record.down) * record.down;
}

std::size_t bin_at(double place, std::size_t bins) {
    return std::min(static_cast<std::size_t>(std::max(0.0, place) * static_cast<double>(bins)), bins - 1);
}

/// Returns the histogram of a value between two frames, by its place from 0 to 1 among so many intervals.
Histogram histogram_of(const FallSeries& record, const Piece& piece, std::size_t bins,
                       const std::function<double(std::size_t, std::size_t)>& place) {
    Histogram histogram{};
    for (std::size_t i = piece.begin + 1; i < piece.end; ++i) {
        histogram[bin_at(place(i - 1, i), bins)] += record.times[i] - record.times[i - 1];
    }
    return histogram;
}

Histogram inclinations_in(const FallSeries& record, const Piece& piece) {
    return histogram_of(record, piece, inclination_bins, [&](std::size_t a, std::size_t b) {
        return 0.5 * (record.inclinations[a] + record.inclinations[b]) / (0.5 * std::numbers::pi);
    });
}

Histogram angular_speeds_in(const FallSeries& record, const Piece& piece) {
    constexpr double lowest = -3.0;
    constexpr double decades = 8.0;
    return histogram_of(record, piece, histogram_bins, [&](std::size_t a, std::size_t b) {
        const double square = std::max(1e-12, 0.5 * (record.squared_spins[a] + record.squared_spins[b]));
        return (0.5 * std::log10(square) - lowest) / decades;
    });
}

/// Returns the piece's duration in the interval of its mode. A piece from one minimum of the inclination to
/// the next turns over where the axis points the other way in the end.
Histogram mode_of(const FallSeries& record, const Piece& piece) {
    constexpr double still_range = 5.0 * degree;
    const auto first = record.inclinations.begin();
    const auto [lowest, highest] = std::minmax_element(first + static_cast<std::ptrdiff_t>(piece.begin),
                                                       first + static_cast<std::ptrdiff_t>(piece.end));
    const double before = record.axes[piece.begin].dot(record.down);
    const double after = record.axes[piece.end - 1].dot(record.down);
    Histogram histogram{};
    const std::size_t mode = before * after < 0.0 ? 2 : *highest - *lowest < still_range ? 0 : 1;
    histogram[mode] = record.times[piece.end - 1] - record.times[piece.begin];
    return histogram;
}

void add_histograms(const FallSeries& record, const Piece& piece, FallMetrics& metrics) {
    metrics.histograms[0].push_back(inclinations_in(record, piece));
    metrics.histograms[1].push_back(angular_speeds_in(record, piece));
    metrics.histograms[2].push_back(mode_of(record, piece));
}

/// The record with one stretch of neighbouring pieces left out at a time.
class Jackknife {
  public:
    Jackknife(const FallSeries& record, const Pieces& pieces) : record_(record), pieces_(pieces) {
        for (const Piece& piece : pieces.pieces) {
            sums_.push_back(sums_of(record, piece));
        }
        const std::size_t count = pieces.pieces.size();
        if (count < fewest_pieces) return;
        left_out_ = std::clamp<std::size_t>((count + 1) / 3, 1, most_left_out);
        stride_ = std::max<std::size_t>(1, count / most_stretches);
    }

    /// Returns the error of a metric that `without` gives for the pieces [begin, end) left out; nothing where
    /// there are too few pieces.
    [[nodiscard]] std::optional<double> error(
        const std::function<double(std::size_t begin, std::size_t end)>& without) const {
        if (left_out_ == 0) return std::nullopt;
        std::vector<double> values;
        for (std::size_t i = 0; i + left_out_ <= sums_.size(); i += stride_) {
            values.push_back(without(i, i + left_out_));
        }
        return jackknife_error(values, sums_.size(), left_out_);
    }
    /// Returns the error of a metric of the sums.
    [[nodiscard]] std::optional<double> error_of_sums(
        const std::function<double(const Sums&)>& metric) const {
        return error([&](std::size_t begin, std::size_t end) { return metric(sums_without(begin, end)); });
    }
    /// Returns the frames of the pieces [begin, end).
    [[nodiscard]] Piece frames(std::size_t begin, std::size_t end) const {
        return {pieces_.pieces[begin].begin, pieces_.pieces[end - 1].end};
    }

    /// Returns the growth (m^2/s) with time of the variance of the horizontal displacement in a direction,
    /// from the displacements between the mean places of successive periods of two pieces, so that the swing
    /// from side to side does not count.
    [[nodiscard]] std::optional<double> spreading() const {
        if (sums_.size() < fewest_pieces + 1) return std::nullopt;
        std::vector<Sums> periods;
        for (std::size_t i = 1; i < sums_.size(); ++i) {
            periods.push_back(sums_[i - 1]);
            periods.back() += sums_[i];
        }
        const auto place = [&](std::size_t i) -> Vector3d {
            return periods[i].displacement_integral / periods[i].duration;
        };
        const auto time = [&](std::size_t i) { return periods[i].time / periods[i].duration; };
        const std::size_t steps = periods.size() - 1;
        const std::size_t lag = std::min(left_out_, steps - 1);
        const Vector3d drift = (place(steps) - place(0)) / (time(steps) - time(0));
        double squares = 0.0;
        double durations = 0.0;
        for (std::size_t i = 0; i + lag <= steps; ++i) {
            const double duration = time(i + lag) - time(i);
            squares += horizontal(record_, place(i + lag) - place(i) - duration * drift).squaredNorm();
            durations += duration;
        }
        return 0.5 * squares / durations * static_cast<double>(steps) / static_cast<double>(steps - lag);
    }

  private:
    [[nodiscard]] Sums sums_without(std::size_t begin, std::size_t end) const {
        Sums rest;
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            if (i < begin || i >= end) rest += sums_[i];
        }
        return rest;
    }

    const FallSeries& record_;
    const Pieces& pieces_;
    std::vector<Sums> sums_;
    std::size_t left_out_ = 0;
    std::size_t stride_ = 1;
};

/// Returns the frames of the window, [begin, end).
Piece window_frames(const FallSeries& record) {
    const double slack = 1e-9 * std::max(1.0, record.duration());
    const auto begin =
        std::lower_bound(record.times.begin(), record.times.end(), record.measures.window.begin - slack);
    const auto end = std::upper_bound(begin, record.times.end(), record.measures.window.end + slack);
    return {static_cast<std::size_t>(begin - record.times.begin()),
            static_cast<std::size_t>(end - record.times.begin())};
}

struct Frame {
    double inclination;
    std::size_t index;
};

std::array<Estimate, quantile_percents.size()> quantiles_of(const FallSeries& record,
                                                            const Jackknife& jackknife) {
    std::vector<Frame> frames;
    const Piece window = window_frames(record);
    for (std::size_t i = window.begin; i < window.end; ++i) frames.push_back({record.inclinations[i], i});
    std::sort(frames.begin(), frames.end(),
              [](const Frame& a, const Frame& b) { return a.inclination < b.inclination; });
    const auto without = [&](const Piece& piece) {
        std::vector<double> values;
        for (const Frame& frame : frames) {
            if (frame.index < piece.begin || frame.index >= piece.end) values.push_back(frame.inclination);
        }
        return values;
    };
    const std::vector<double> all = without({});
    std::array<Estimate, quantile_percents.size()> quantiles;
    for (std::size_t q = 0; q < quantiles.size(); ++q) {
        quantiles[q].value = percentile_of_sorted(all, quantile_percents[q]);
        quantiles[q].error = jackknife.error([&](std::size_t begin, std::size_t end) {
            return percentile_of_sorted(without(jackknife.frames(begin, end)), quantile_percents[q]);
        });
    }
    return quantiles;
}

std::optional<Estimate> frequency_of(const FallSeries& record, const Pieces& pieces,
                                     const Jackknife& jackknife) {
    if (!record.measures.frequency) return std::nullopt;
    Estimate frequency{*record.measures.frequency, {}, {}};
    if (!pieces.by_swings) return frequency;
    const std::vector<double>& minima = pieces.minima;
    frequency.error = jackknife.error([&](std::size_t begin, std::size_t end) {
        const double left = minima.back() - minima.front() - (minima[end] - minima[begin]);
        return 0.5 * static_cast<double>(minima.size() - 1 - (end - begin)) / left;
    });
    return frequency;
}

std::optional<Estimate> spectral_frequency_of(const FallSeries& record, double segment,
                                              const FallMetrics& metrics, const Jackknife& jackknife) {
    if (!record.measures.frequency) return std::nullopt;
    const double lowest = 0.5 * *record.measures.frequency;
    const auto peak = peak_frequency(metrics.spectrum, lowest);
    if (!peak) return std::nullopt;
    const std::size_t first = window_frames(record).begin;
    return Estimate{*peak,
                    jackknife.error([&](std::size_t begin, std::size_t end) {
                        const Piece piece = jackknife.frames(begin, end);
                        return peak_frequency(
                                   swing_spectrum(record, segment, {piece.begin - first, piece.end - first}),
                                   lowest)
                            .value_or(*peak);
                    }),
                    {}};
}

/// Returns the rms horizontal distance (m) from the release over the window.
double path_spread(const FallSeries& record) {
    const Piece window = window_frames(record);
    double sum = 0.0;
    for (std::size_t i = window.begin; i < window.end; ++i) {
        sum += horizontal(record, record.displacements[i]).squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(window.end - window.begin));
}

std::optional<double> path_spread_error(const FallSeries& record, const Jackknife& jackknife) {
    const Piece window = window_frames(record);
    double times = 0.0;
    for (std::size_t i = window.begin; i < window.end; ++i) times += record.times[i];
    const auto count = static_cast<double>(window.end - window.begin);
    const auto rate = jackknife.spreading();
    return rate ? std::optional(std::sqrt(*rate * times / count)) : std::nullopt;
}

std::optional<double> drift_speed_error(const FallSeries& record, const Jackknife& jackknife) {
    const TimeWindow& window = record.measures.window;
    const auto rate = jackknife.spreading();
    return rate ? std::optional(std::sqrt(*rate / (window.end - window.begin))) : std::nullopt;
}

}  // namespace

bool tells(MetricSubject subject, const Body& body) {
    if (subject == MetricSubject::inclination) return has_shortest_axis(body.surface);
    return subject == MetricSubject::path || body.symmetry.type != Symmetry::Type::spherical;
}

std::optional<double> metric_value(Metric metric, const FallSeries& record) {
    if (metric == Metric::path_spread) return path_spread(record);
    if (metric == Metric::drift_speed) return horizontal(record, record.measures.mean_velocity).norm();
    const auto measured = catalogued(metric).measured;
    return measured ? measured(record.measures) : std::nullopt;
}

Spectrum swing_spectrum(const FallSeries& record, double segment, const LeftOut& left_out) {
    const Piece window = window_frames(record);
    std::vector<double> squares;
    for (std::size_t i = window.begin; i < window.end; ++i) {
        squares.push_back(std::pow(std::cos(record.inclinations[i]), 2));
    }
    if (squares.size() < 2) return {};
    const double step =
        (record.times[window.end - 1] - record.times[window.begin]) / static_cast<double>(squares.size() - 1);
    Spectrum spectrum =
        power_spectrum(squares, step, static_cast<std::size_t>(std::lround(segment / step)) + 1, left_out);
    spectrum.step *= 0.5;
    spectrum.resolution *= 0.5;
    for (double& power : spectrum.power) power *= 2.0;
    return spectrum;
}

FallMetrics fall_metrics(const FallSeries& record, double segment) {
    const Pieces pieces = pieces_of(record);
    const Jackknife jackknife(record, pieces);
    FallMetrics result;
    result.pieces = pieces.pieces.size();
    for (const Piece& piece : pieces.pieces) add_histograms(record, piece, result);
    if (pieces.pieces.empty()) add_histograms(record, window_frames(record), result);
    result.inclination_quantiles = quantiles_of(record, jackknife);
    result.spectrum = swing_spectrum(record, segment);

    PerMetric<std::optional<Estimate>>& metrics = result.metrics;
    for (const CataloguedMetric& entry : metric_catalogue) {
        if (const auto value = metric_value(entry.metric, record))
            metrics[entry.metric] = Estimate{*value, {}, {}};
    }
    metrics[Metric::descent_speed]->error =
        jackknife.error_of_sums([&](const Sums& s) { return s.displacement.dot(record.down) / s.duration; });
    metrics[Metric::frequency] = frequency_of(record, pieces, jackknife);
    metrics[Metric::spectral_frequency] = spectral_frequency_of(record, segment, result, jackknife);
    metrics[Metric::inclination_amplitude] = result.inclination_quantiles.back();
    metrics[Metric::mean_inclination]->error =
        jackknife.error_of_sums([](const Sums& s) { return s.inclination / s.duration; });
    metrics[Metric::rms_angular_speed]->error =
        jackknife.error_of_sums([](const Sums& s) { return std::sqrt(s.squared_spin / s.duration); });
    if (auto& spin = metrics[Metric::spin_rate]) {
        spin->error =
            jackknife.error_of_sums([](const Sums& s) { return std::abs(s.upright_angle) / s.duration; });
    }
    metrics[Metric::path_spread]->error = path_spread_error(record, jackknife);
    metrics[Metric::drift_speed]->error = drift_speed_error(record, jackknife);
    return result;
}

}  // namespace samara
