#include "converter/tables/reynolds_interpolation.hpp"

#include <cmath>

#include "converter/tables/reynolds_fit.hpp"
#include "converter/tables/symmetric_loads.hpp"

namespace samara {
namespace {

/// The error in the middle of an interval over that of an interval twice as long: second order.
constexpr double share_left = 0.25;

}  // namespace

LoadEntryError reynolds_interpolation_variance(const std::vector<double>& reynolds_numbers,
                                               const std::vector<std::vector<LoadEntry>>& nodes) {
    LoadEntryError sum;
    double count = 0.0;
    double turbulent = 0.0;
    for (std::size_t i = 1; i + 1 < reynolds_numbers.size(); ++i) {
        const double below = std::log(reynolds_numbers[i] / reynolds_numbers[i - 1]);
        const double above = std::log(reynolds_numbers[i + 1] / reynolds_numbers[i]);
        const double fraction = below / (below + above);
        for (std::size_t node = 0; node < nodes[i].size(); ++node) {
            const LoadEntry& lower = nodes[i - 1][node];
            const LoadEntry& upper = nodes[i + 1][node];
            const LoadEntry lookup = plus(plus({}, 1.0 - fraction, lower), fraction, upper);
            LoadEntry error = plus(in_logarithms(lookup), -1.0, in_logarithms(nodes[i][node]));
            const bool all = is_turbulent(lower) && is_turbulent(nodes[i][node]) && is_turbulent(upper);
            if (!all) error.turbulent_kinetic_energy = error.dissipation_rate = 0.0;
            sum = plus(sum, 1.0, squared(error));
            count += 1.0;
            if (all) turbulent += 1.0;
        }
    }
    if (count == 0.0) return {};
    const double square = share_left * share_left;
    const double of_turbulence = turbulent > 0.0 ? square / turbulent : 0.0;
    return {Vector3d::Constant(square * sum.force.mean() / count),
            Vector3d::Constant(square * sum.moment.mean() / count),
            of_turbulence * sum.turbulent_kinetic_energy, of_turbulence * sum.dissipation_rate};
}

}  // namespace samara
