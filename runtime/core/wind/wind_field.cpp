#include "samara/core/wind/wind_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/kernel/noise.hpp"

namespace samara {
namespace {

constexpr std::size_t places_around = 6;
constexpr double largest_velocity = 1e30;  // m/s
constexpr double lowest_share = 0.01;      // of the profile's height, below which the power law is straight

Triple<double> triple(const Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

void set_profile(const Wind& wind, WindConstants& constants) {
    const WindProfile& profile = *wind.profile;
    constants.profile_velocity = triple(wind.velocity);
    constants.ground = profile.ground;
    if (profile.law == WindProfile::Law::logarithmic) {
        constants.profile = WindConstants::Profile::logarithmic;
        constants.inverse_scale = 1.0 / profile.roughness;
        constants.exponent = 1.0 / std::log1p(profile.height / profile.roughness);
    } else {
        constants.profile = WindConstants::Profile::power;
        constants.inverse_scale = 1.0 / profile.height;
        constants.exponent = profile.exponent;
        constants.lowest = lowest_share * profile.height;
    }
}

VortexConstants constants_of(const WindVortex& vortex) {
    return {.rankine = vortex.type == WindVortex::Core::rankine,
            .position = triple(vortex.position),
            .axis = triple(vortex.axis),
            .velocity = triple(vortex.velocity),
            .strength = vortex.circulation / (2.0 * std::numbers::pi),
            .core_square = vortex.core * vortex.core,
            .inverse_square = 1.0 / (vortex.core * vortex.core)};
}

FanConstants constants_of(const WindFan& fan) {
    // The bell-shaped jet with the momentum of an even flow through the fan's circle.
    const double width = std::numbers::sqrt2 * 0.5 * fan.diameter;
    return {.position = triple(fan.position),
            .direction = triple(fan.direction),
            .width = width,
            .half_flow = 0.5 * fan.speed * width,
            .intake = fan.diameter};
}

Vector3d column(const double (&rows)[3][WindBlock::size], std::size_t lane) {
    return {rows[0][lane], rows[1][lane], rows[2][lane]};
}

/// The nodes along one axis that determine the value at a coordinate, and their weights.
struct AxisWeights {
    std::size_t node[4] = {};
    double value[4] = {};
    double slope[4] = {};  ///< weights of the value's slope, per node distance
    int count = 0;
};

/// The values beyond the first and last node.
enum class Beyond { edge, nothing, first };

/// Returns the weights of Keys' cubic convolution with a = -1/2. `at`: in nodes from the first.
AxisWeights axis_weights(double at, std::size_t nodes, Beyond beyond) noexcept {
    AxisWeights weights;
    const auto last = static_cast<double>(nodes - 1);
    bool is_level = false;
    if (beyond == Beyond::edge) {
        is_level = at < 0.0 || at > last || nodes == 1;
        at = std::clamp(at, 0.0, last);
    } else if (beyond == Beyond::first) {
        const auto period = static_cast<double>(nodes);
        at -= period * std::floor(at / period);
    } else if (!(at > -1.0 && at < last + 1.0)) {
        return weights;
    }
    const double floor = std::floor(at);
    const double t = at - floor;
    const auto first = static_cast<std::ptrdiff_t>(floor) - 1;
    const double t2 = t * t;
    const double t3 = t2 * t;
    const double value[4] = {-0.5 * t + t2 - 0.5 * t3, 1.0 - 2.5 * t2 + 1.5 * t3,
                             0.5 * t + 2.0 * t2 - 1.5 * t3, -0.5 * t2 + 0.5 * t3};
    const double slope[4] = {-0.5 + 2.0 * t - 1.5 * t2, -5.0 * t + 4.5 * t2, 0.5 + 4.0 * t - 4.5 * t2,
                             -t + 1.5 * t2};
    const auto add = [&](std::ptrdiff_t node, double v, double s) {
        weights.node[weights.count] = static_cast<std::size_t>(node);
        weights.value[weights.count] = v;
        weights.slope[weights.count++] = is_level ? 0.0 : s;
    };
    const auto end = static_cast<std::ptrdiff_t>(nodes);
    if (beyond == Beyond::edge && nodes == 1) {
        add(0, 1.0, 0.0);
        return weights;
    }
    if (beyond == Beyond::edge && (first < 0 || first + 3 >= end)) {
        // A node beyond the edge is extrapolated: it is twice the last less the one before.
        double values[4] = {value[0], value[1], value[2], value[3]};
        double slopes[4] = {slope[0], slope[1], slope[2], slope[3]};
        const auto fold = [&](int ghost, int near, int far) {
            values[near] += 2.0 * values[ghost];
            slopes[near] += 2.0 * slopes[ghost];
            values[far] -= values[ghost];
            slopes[far] -= slopes[ghost];
            values[ghost] = slopes[ghost] = 0.0;
        };
        for (int i = 3; i >= 2; --i) {
            if (first + i >= end) fold(i, i - 1, i - 2);
        }
        if (first < 0) fold(0, 1, 2);
        for (int i = 0; i < 4; ++i) {
            if (first + i >= 0 && first + i < end) add(first + i, values[i], slopes[i]);
        }
        return weights;
    }
    for (int i = 0; i < 4; ++i) {
        std::ptrdiff_t node = first + i;
        if (beyond == Beyond::first) node = ((node % end) + end) % end;
        if (node >= 0 && node < end) add(node, value[i], slope[i]);
    }
    return weights;
}

}  // namespace

double WindSurfaceLayer::share_at(double distance) const noexcept {
    if (distance >= height) return 1.0;
    return std::log1p(std::max(0.0, distance) / roughness) / std::log1p(height / roughness);
}

WindField::WindField(const Wind& wind, const Vector3d& current)
    : surface_layer_(wind.surface_layer.value_or(WindSurfaceLayer{})),
      file_(wind.file),
      function_(wind.function),
      context_(wind.function_context) {
    if (wind.profile) {
        set_profile(wind, constants_);
    } else {
        uniform_ = wind.velocity;
    }
    if (wind.gusts) {
        constants_.drift = triple(current + wind.velocity);
        constants_.waves = gust_waves(*wind.gusts);
    }
    for (const WindVortex& vortex : wind.vortices) constants_.vortices.push_back(constants_of(vortex));
    for (const WindFan& fan : wind.fans) constants_.fans.push_back(constants_of(fan));
}

bool WindField::blow(double time, const WindSpan& span, std::size_t count, WindBlock& block) const noexcept {
    kernel::blow(constants_, time, count, block);
    for (std::size_t axis = 0; axis < 3 && !uniform_.isZero(0.0); ++axis) {
        for (std::size_t lane = 0; lane < count; ++lane) {
            block.velocity[axis][lane] += uniform_[static_cast<Eigen::Index>(axis)];
        }
    }
    if (file_) add_file(time, count, block);
    return function_ == nullptr || add_function(time, span, count, block);
}

void WindField::add_file(double time, std::size_t count, WindBlock& block) const noexcept {
    for (std::size_t lane = 0; lane < count; ++lane) {
        const GridWind there = grid_wind(*file_, column(block.place, lane), time);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto row = static_cast<Eigen::Index>(i);
            block.velocity[i][lane] += there.velocity[row];
            block.rate[i][lane] += there.rate[row];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                block.gradient[3 * i + axis][lane] += there.gradient(row, static_cast<Eigen::Index>(axis));
            }
        }
    }
}

bool WindField::add_function(double time, const WindSpan& span, std::size_t count,
                             WindBlock& block) const noexcept {
    // Places on both sides along each axis: the mean is that over a sphere up to the second derivatives
    // (Faxen), the differences are the gradient.
    double places[WindBlock::size * places_around * 3];
    double velocities[2][WindBlock::size * places_around * 3] = {};
    const std::size_t all = count * places_around;
    for (std::size_t i = 0; i < all; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double side = i % 2 == 0 ? span.reach : -span.reach;
            const bool along = (i % places_around) / 2 == axis;
            places[3 * i + axis] = block.place[axis][i / places_around] + (along ? side : 0.0);
        }
    }
    bool sound = true;
    for (std::size_t end = 0; end < 2; ++end) {
        const double at = time + (end == 0 ? -0.5 : 0.5) * span.duration;
        function_(context_, at, all, places, velocities[end]);
        for (std::size_t i = 0; i < 3 * all; ++i) {
            if (std::abs(velocities[end][i]) <= largest_velocity) continue;
            velocities[end][i] = 0.0;
            sound = false;
        }
    }
    for (std::size_t lane = 0; lane < count; ++lane) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto at = [&](std::size_t end, std::size_t place) {
                return velocities[end][(lane * places_around + place) * 3 + i];
            };
            double sums[2] = {0.0, 0.0};
            for (std::size_t end = 0; end < 2; ++end) {
                for (std::size_t place = 0; place < places_around; ++place) sums[end] += at(end, place);
            }
            block.velocity[i][lane] += (sums[0] + sums[1]) / (2.0 * places_around);
            block.rate[i][lane] += (sums[1] - sums[0]) / (places_around * span.duration);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double difference =
                    (at(0, 2 * axis) - at(0, 2 * axis + 1)) + (at(1, 2 * axis) - at(1, 2 * axis + 1));
                block.gradient[3 * i + axis][lane] += difference / (4.0 * span.reach);
            }
        }
    }
    return sound;
}

std::string description_of(const Wind& wind) {
    if (wind.is_calm()) return {};
    const auto numbers = [](const Vector3d& v) { return fmt::format("{}", fmt::join(v.reshaped(), " ")); };
    std::string text = fmt::format("wind {}", numbers(wind.velocity));
    if (wind.profile) {
        const WindProfile& p = *wind.profile;
        text += fmt::format(" profile {} {} {} {} {}", static_cast<int>(p.law), p.roughness, p.exponent,
                            p.height, p.ground);
    }
    if (wind.gusts) {
        const WindGusts& g = *wind.gusts;
        text += fmt::format(" gusts {} {} {} {} {}", static_cast<int>(g.spectrum), g.rms, g.length,
                            g.seed.value_or(0), g.bands);
    }
    for (const WindVortex& v : wind.vortices) {
        text += fmt::format(" vortex {} {} {} {} {} {}", static_cast<int>(v.type), numbers(v.position),
                            numbers(v.axis), v.circulation, v.core, numbers(v.velocity));
    }
    for (const WindFan& f : wind.fans) {
        text +=
            fmt::format(" fan {} {} {} {}", numbers(f.position), numbers(f.direction), f.diameter, f.speed);
    }
    if (wind.file) {
        const WindFile& f = *wind.file;
        text += fmt::format(" file {} {} {} {} {}", f.grid->hash, numbers(f.position), f.start, f.repeats,
                            static_cast<int>(f.outside));
    }
    if (wind.function != nullptr) text += " function";
    if (wind.is_field()) {
        const WindSurfaceLayer layer = wind.surface_layer.value_or(WindSurfaceLayer{});
        text += fmt::format(" surface layer {} {}", layer.height, layer.roughness);
    }
    return text + '\n';
}

namespace {

constexpr double pi = std::numbers::pi;
// Gamma(1/3)/(sqrt(pi) Gamma(5/6)): L is then the integral length
constexpr double von_karman_factor = 1.339;
// The wave numbers of the bands times the length.
constexpr double lowest = 0.1;
constexpr double highest = 100.0;
constexpr double nothing_below = 1e-6;

/// Returns the integral of E from k1 to k2, by Simpson's rule over ln k.
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
    // A name that no body can have, so that the numbers are no body's noise.
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

GridWind grid_wind(const WindFile& file, const Vector3d& place, double time) noexcept {
    const WindGrid& grid = *file.grid;
    const Vector3d at = (place - file.position - grid.origin).cwiseQuotient(grid.spacing);
    const Beyond beyond = file.outside == WindFile::Outside::still ? Beyond::nothing : Beyond::edge;
    const AxisWeights x = axis_weights(at.x(), grid.nodes[0], beyond);
    const AxisWeights y = axis_weights(at.y(), grid.nodes[1], beyond);
    const AxisWeights z = axis_weights(at.z(), grid.nodes[2], beyond);
    const AxisWeights t = axis_weights((time - file.start) / grid.interval, grid.frames,
                                       file.repeats ? Beyond::first : Beyond::edge);
    Vector3d velocity = Vector3d::Zero();
    Vector3d rate = Vector3d::Zero();
    Matrix3d gradient = Matrix3d::Zero();  // per node distance
    for (int l = 0; l < t.count; ++l) {
        Vector3d volume[4] = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
        for (int k = 0; k < z.count; ++k) {
            Vector3d layer[3] = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
            for (int j = 0; j < y.count; ++j) {
                const std::size_t row =
                    ((t.node[l] * grid.nodes[2] + z.node[k]) * grid.nodes[1] + y.node[j]) * grid.nodes[0];
                Vector3d value = Vector3d::Zero();
                Vector3d slope = Vector3d::Zero();
                for (int i = 0; i < x.count; ++i) {
                    const float* node = &grid.velocities[(row + x.node[i]) * 3];
                    const Vector3d there(node[0], node[1], node[2]);
                    value += x.value[i] * there;
                    slope += x.slope[i] * there;
                }
                layer[0] += y.value[j] * value;
                layer[1] += y.value[j] * slope;
                layer[2] += y.slope[j] * value;
            }
            volume[0] += z.value[k] * layer[0];
            volume[1] += z.value[k] * layer[1];
            volume[2] += z.value[k] * layer[2];
            volume[3] += z.slope[k] * layer[0];
        }
        velocity += t.value[l] * volume[0];
        rate += t.slope[l] * volume[0];
        for (int axis = 0; axis < 3; ++axis) gradient.col(axis) += t.value[l] * volume[axis + 1];
    }
    return {velocity, gradient * grid.spacing.cwiseInverse().asDiagonal(), rate / grid.interval};
}

}  // namespace samara
