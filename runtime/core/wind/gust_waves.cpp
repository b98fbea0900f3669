#include "samara/core/wind/gust_waves.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/kernel/noise.hpp"

namespace samara {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double von_karman_factor =
    1.339;  // Gamma(1/3)/(sqrt(pi) Gamma(5/6)): L is then the integral length
// Wave numbers times the length, of the bands.
constexpr double lowest = 0.1;
constexpr double highest = 100.0;
constexpr double nothing_below = 1e-6;

/// (k1 to k2) of E dk, by Simpson's rule over ln k.
double energy_between(const WindGusts& gusts, double first, double last) {
    const double span = std::log(last / first);
    const int halves = 2 * static_cast<int>(std::ceil(span / 0.1));
    double sum = 0.0;
    for (int i = 0; i <= halves; ++i) {
        const double k = first * std::exp(span * i / halves);
        const double weight = i == 0 || i == halves ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
        sum += weight * k * energy_spectrum(gusts, k);
    }
    return sum * span / (3.0 * halves);
}

Triple<double> triple(const Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

}  // namespace

double energy_spectrum(const WindGusts& gusts, double k) noexcept {
    const double whole = 2.0 * gusts.length / pi * gusts.rms * gusts.rms;
    if (gusts.spectrum == WindGusts::Spectrum::kaimal) {
        const double a = 3.0 * gusts.length / pi;
        const double x = 1.0 + a * k;
        return 0.5 * whole * a * k * std::pow(x, -11.0 / 3.0) * (5.0 / 3.0 * x + 40.0 / 9.0 * a * k);
    }
    const double square = std::pow(von_karman_factor * gusts.length * k, 2);
    return 55.0 / 18.0 * whole * square * square * std::pow(1.0 + square, -17.0 / 6.0);
}

std::vector<GustWave> gust_waves(const WindGusts& gusts) {
    // Named by no body, so that it is nobody's noise.
    const Noise noise(gusts.seed.value_or(0), "[wind]", 0, 0);
    std::vector<GustWave> waves;
    const double ratio = std::pow(highest / lowest, 1.0 / gusts.bands);
    std::vector<double> energies;
    for (int band = 0; band < gusts.bands; ++band) {
        const double first = (band == 0 ? nothing_below : lowest * std::pow(ratio, band)) / gusts.length;
        energies.push_back(energy_between(gusts, first, lowest / gusts.length * std::pow(ratio, band + 1)));
    }
    const double held = std::accumulate(energies.begin(), energies.end(), 0.0);
    const double made_larger = held > 0.0 ? 1.5 * gusts.rms * gusts.rms / held : 0.0;
    for (int band = 0; band < gusts.bands; ++band) {
        const double first = lowest / gusts.length * std::pow(ratio, band);
        const double energy = made_larger * energies[static_cast<std::size_t>(band)];
        const double amplitude = std::sqrt(2.0 / 3.0 * energy);
        const auto turn = noise.normals(static_cast<std::uint64_t>(band), NoiseStream::gust_direction);
        const Matrix3d axes = Quaterniond(turn[0], turn[1], turn[2], turn[3]).normalized().toRotationMatrix();
        for (Eigen::Index i = 0; i < 3; ++i) {
            const auto draw =
                noise.uniforms(static_cast<std::uint64_t>(3 * band + i), NoiseStream::gust_wave);
            const double k = first * std::pow(ratio, draw[0]);
            const double sense = draw[1] < 0.5 ? -1.0 : 1.0;
            waves.push_back({triple(k / (2.0 * pi) * axes.col(i)), triple(amplitude * axes.col((i + 1) % 3)),
                             triple(sense * amplitude * axes.col((i + 2) % 3)), draw[2]});
        }
    }
    return waves;
}

}  // namespace samara
