#include "samara/analysis/metrics/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <unsupported/Eigen/FFT>

namespace samara {
namespace {

constexpr double hann_width = 1.44;  // of a Hann window's peak at half height, over 1 / duration
constexpr std::size_t steps_in_peak = 8;

std::size_t power_of_two(std::size_t least) {
    std::size_t size = 1;
    while (size < least) size *= 2;
    return size;
}

double hann(std::size_t i, std::size_t count) {
    const double sine =
        std::sin(std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(count));
    return sine * sine;
}

}  // namespace

Spectrum power_spectrum(const std::vector<double>& values, double time_step, std::size_t segment,
                        const LeftOut& left_out) {
    const std::size_t length = std::clamp<std::size_t>(segment, 2, values.size());
    const std::size_t size = power_of_two(steps_in_peak * std::max(segment, length));
    Spectrum spectrum;
    spectrum.step = 1.0 / (static_cast<double>(size) * time_step);
    spectrum.resolution = hann_width / (static_cast<double>(length) * time_step);
    spectrum.power.assign(size / 2 + 1, 0.0);
    const std::size_t hop = std::max<std::size_t>(length / 2, 1);
    const std::size_t segments = 1 + (values.size() - length) / hop;
    Eigen::FFT<double> transform;
    double squared_weights = 0.0;
    for (std::size_t s = 0; s < segments; ++s) {
        // The segments are spread so that the last one ends with the values.
        const std::size_t first = segments > 1 ? s * (values.size() - length) / (segments - 1) : 0;
        std::vector<double> weights(length);
        double sum = 0.0;
        double weighted = 0.0;
        for (std::size_t i = 0; i < length; ++i) {
            const bool counts = first + i < left_out.begin || first + i >= left_out.end;
            weights[i] = counts ? hann(i, length) : 0.0;
            sum += weights[i];
            weighted += weights[i] * values[first + i];
            squared_weights += weights[i] * weights[i];
        }
        if (sum == 0.0) continue;
        std::vector<double> signal(size, 0.0);
        for (std::size_t i = 0; i < length; ++i) {
            signal[i] = weights[i] * (values[first + i] - weighted / sum);
        }
        std::vector<std::complex<double>> wave;
        transform.fwd(wave, signal);
        for (std::size_t i = 0; i < spectrum.power.size(); ++i) spectrum.power[i] += std::norm(wave[i]);
    }
    if (squared_weights == 0.0) return spectrum;
    for (std::size_t i = 0; i < spectrum.power.size(); ++i) {
        const double sides = i == 0 || i + 1 == spectrum.power.size() ? 1.0 : 2.0;
        spectrum.power[i] *= sides * time_step / squared_weights;
    }
    return spectrum;
}

std::optional<double> peak_frequency(const Spectrum& spectrum, double lowest) {
    const auto first = std::max<std::ptrdiff_t>(1, std::lround(lowest / spectrum.step));
    if (first + 1 >= static_cast<std::ptrdiff_t>(spectrum.power.size())) return std::nullopt;
    const auto highest = std::max_element(spectrum.power.begin() + first, spectrum.power.end());
    if (!(*highest > 0.0)) return std::nullopt;
    const auto i = static_cast<std::size_t>(highest - spectrum.power.begin());
    double shift = 0.0;
    if (i + 1 < spectrum.power.size() && spectrum.power[i - 1] > 0.0 && spectrum.power[i + 1] > 0.0) {
        const double before = std::log(spectrum.power[i - 1] / *highest);
        const double after = std::log(spectrum.power[i + 1] / *highest);
        if (before + after < 0.0) shift = std::clamp(0.5 * (after - before) / -(before + after), -0.5, 0.5);
    }
    return spectrum.step * (static_cast<double>(i) + shift);
}

void add_power(Spectrum& sum, const Spectrum& one) {
    if (sum.power.empty()) {
        sum = one;
        return;
    }
    for (std::size_t i = 0; i < std::min(sum.power.size(), one.power.size()); ++i)
        sum.power[i] += one.power[i];
}

}  // namespace samara
