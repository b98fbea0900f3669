#pragma once

#include <optional>
#include <vector>

namespace samara {

/// A power spectrum at evenly spaced frequencies from zero.
struct Spectrum {
    double step = 0.0;          ///< Hz, between the frequencies
    double resolution = 0.0;    ///< Hz: width at half height that a pure oscillation's peak has
    std::vector<double> power;  ///< the signal's unit^2/Hz, one-sided: its integral is the signal's variance

    [[nodiscard]] double frequency(std::size_t i) const { return step * static_cast<double>(i); }
};

/// A stretch [begin, end) of a signal's values that is left out.
struct LeftOut {
    std::size_t begin = 0;
    std::size_t end = 0;
};

/// Returns the spectrum of values `time_step` (s) apart, by Welch's method: segments of `segment` values (of
/// all where there are fewer) that overlap by half, each under Hann's window, their mean taken off. The
/// values left out weigh nothing. Zeros are appended until the step is an eighth of the resolution or less.
/// Welch, The use of fast Fourier transform for the estimation of power spectra, IEEE Transactions on Audio
/// and Electroacoustics 15, 1967. At least two values.
Spectrum power_spectrum(const std::vector<double>& values, double time_step, std::size_t segment,
                        const LeftOut& left_out = {});

/// Returns the frequency (Hz) of the highest power at `lowest` (Hz) and above, between the steps by a
/// parabola through the power's logarithm; nothing where there is no power.
std::optional<double> peak_frequency(const Spectrum& spectrum, double lowest);

/// Adds up spectra of the same step and length; an empty sum takes the first.
void add_power(Spectrum& sum, const Spectrum& one);

}  // namespace samara
