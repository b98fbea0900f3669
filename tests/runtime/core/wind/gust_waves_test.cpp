
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "samara/core/wind/wind_field.hpp"

namespace samara {
namespace {

constexpr double pi = std::numbers::pi;
constexpr auto spectra = {WindGusts::Spectrum::von_karman, WindGusts::Spectrum::kaimal};

WindGusts gusts(WindGusts::Spectrum spectrum, std::uint64_t seed = 1) {
    return {.spectrum = spectrum, .rms = 0.7, .length = 3.0, .seed = seed};
}

Vector3d vector(const Triple<double>& t) {
    return {t.x, t.y, t.z};
}

/// Of the velocity along a line (m^3/s^2), one-sided, as WindGusts::Spectrum has it.
double longitudinal_spectrum(const WindGusts& gusts, double k) {
    const double whole = 2.0 * gusts.length / pi * gusts.rms * gusts.rms;
    if (gusts.spectrum == WindGusts::Spectrum::kaimal) {
        return whole * std::pow(1.0 + 3.0 * gusts.length / pi * k, -5.0 / 3.0);
    }
    const double b = 1.339 * gusts.length;
    return whole * std::pow(1.0 + b * b * k * k, -5.0 / 6.0);
}

/// The integral over the wave numbers from a to b, by the middle of many parts that grow with k.
template <typename Function>
double integral(double a, double b, const Function& function, int parts = 20'000) {
    const double ratio = std::pow(b / a, 1.0 / parts);
    double sum = 0.0;
    for (int i = 0; i < parts; ++i) {
        const double begin = a * std::pow(ratio, i);
        sum += (ratio - 1.0) * begin * function(begin * std::sqrt(ratio));
    }
    return sum;
}

TEST(GustSpectrum, HoldsTheVarianceAndTheLength) {
    for (const auto spectrum : spectra) {
        const WindGusts all = gusts(spectrum);
        const auto along = [&](double k) { return longitudinal_spectrum(all, k); };
        const auto energy = [&](double k) { return energy_spectrum(all, k); };
        EXPECT_NEAR(integral(1e-7, 1e9, along), 0.49, 1e-4);
        EXPECT_NEAR(integral(1e-7, 1e9, energy), 1.5 * 0.49, 2e-4);
        // F(0) = 2 L sigma^2/pi is what makes L the integral length.
        EXPECT_NEAR(along(0.0), 2.0 * 3.0 * 0.49 / pi, 1e-12);
    }
}

TEST(GustSpectrum, OfTheEnergyIsThatOfTheLongitudinalOne) {
    // F(k1) = integral over k > k1 of E(k)/k (1 - k1^2/k^2): Pope, eq. 6.216.
    for (const auto spectrum : spectra) {
        const WindGusts all = gusts(spectrum);
        for (const double k1 : {0.05, 0.3, 2.0, 30.0}) {
            const double sum = integral(k1, 1e6 * k1, [&](double k) {
                return energy_spectrum(all, k) / k * (1.0 - k1 * k1 / (k * k));
            });
            EXPECT_NEAR(sum, longitudinal_spectrum(all, k1), 1e-4 * sum) << k1;
        }
    }
}

TEST(GustWaves, EveryComponentHasTheVarianceWhateverTheSeed) {
    for (const auto spectrum : spectra) {
        for (const std::uint64_t seed : {0U, 1U, 99U}) {
            Matrix3d covariance = Matrix3d::Zero();
            for (const GustWave& wave : gust_waves(gusts(spectrum, seed))) {
                const Vector3d a = vector(wave.a);
                const Vector3d b = vector(wave.b);
                covariance += 0.5 * (a * a.transpose() + b * b.transpose());
            }
            EXPECT_LT((covariance - 0.49 * Matrix3d::Identity()).norm(), 1e-12);
        }
    }
}

TEST(GustWaves, AreFreeOfDivergence) {
    for (const GustWave& wave : gust_waves(gusts(WindGusts::Spectrum::kaimal))) {
        const Vector3d k = vector(wave.wave_number);
        EXPECT_LT(std::abs(k.dot(vector(wave.a))), 1e-14 * k.norm());
        EXPECT_LT(std::abs(k.dot(vector(wave.b))), 1e-14 * k.norm());
    }
}

TEST(GustWaves, HaveTheSpectrumAlongALine) {
    // A wave with the wave number k adds (a.e)^2/2 + (b.e)^2/2 at k.e of the line's direction e.
    for (const auto spectrum : spectra) {
        // The waves end at 100/length, and hold the variance of what is beyond.
        constexpr double last = 100.0 / 3.0;
        const auto energy = [&](double k) { return energy_spectrum(gusts(spectrum), k); };
        const double held = integral(1e-7, last, energy) / (1.5 * 0.49);
        EXPECT_GT(held, 0.9);
        const double edges[] = {0.2, 0.4, 0.8, 1.6, 3.2, 6.4, 12.8};
        double sums[6] = {};
        constexpr int seeds = 400;
        for (int seed = 0; seed < seeds; ++seed) {
            for (const GustWave& wave : gust_waves(gusts(spectrum, static_cast<std::uint64_t>(seed)))) {
                for (Eigen::Index axis = 0; axis < 3; ++axis) {
                    const double k = 2.0 * pi * std::abs(vector(wave.wave_number)[axis]);
                    const double a = vector(wave.a)[axis];
                    const double b = vector(wave.b)[axis];
                    for (int bin = 0; bin < 6; ++bin) {
                        if (k >= edges[bin] && k < edges[bin + 1]) sums[bin] += 0.5 * (a * a + b * b);
                    }
                }
            }
        }
        for (int bin = 0; bin < 6; ++bin) {
            const double expected = integral(
                edges[bin], edges[bin + 1],
                [&](double k1) {
                    return integral(
                        k1, last, [&](double k) { return energy(k) / k * (1.0 - k1 * k1 / (k * k)); }, 400);
                },
                50);
            EXPECT_NEAR(sums[bin] / (3.0 * seeds) * held, expected, 0.05 * expected) << edges[bin];
        }
    }
}

TEST(GustWaves, VaryAlongALineAsTheRmsSays) {
    Wind wind;
    wind.gusts = gusts(WindGusts::Spectrum::von_karman);
    const WindField field(wind, Vector3d::Zero());
    double square = 0.0;
    constexpr int places = 4096;
    for (int i = 0; i < places; ++i) {
        WindBlock block;
        block.place[0][0] = 11.3 * i;  // several lengths apart
        block.place[1][0] = 7.1 * i;
        block.place[2][0] = -3.7 * i;
        field.blow(0.0, {}, 1, block);
        for (const auto& component : block.velocity) square += component[0] * component[0];
    }
    EXPECT_NEAR(square / (3.0 * places), 0.49, 0.05 * 0.49);
}

}  // namespace
}  // namespace samara
