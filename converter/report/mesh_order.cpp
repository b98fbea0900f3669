#include "converter/report/mesh_order.hpp"

#include <cmath>

namespace samara {

std::optional<MeshOrder> observed_order(const std::array<double, 3>& cells,
                                        const std::array<double, 3>& values) {
    constexpr double safety = 1.25;
    constexpr double highest_order = 10.0;  // beyond it the fine meshes differ by chance alone
    const double coarse_ratio = std::cbrt(cells[1] / cells[0]);
    const double fine_ratio = std::cbrt(cells[2] / cells[1]);
    const double coarse_change = values[1] - values[0];
    const double fine_change = values[2] - values[1];
    if (!(coarse_ratio > 1.0 && fine_ratio > 1.0) || !(coarse_change * fine_change > 0.0))
        return std::nullopt;
    // The changes that a power law of this order predicts from the coarse to the fine pair of meshes.
    const auto excess = [&](double order) {
        return (std::pow(coarse_ratio, order) - 1.0) * std::pow(fine_ratio, order) /
                   (std::pow(fine_ratio, order) - 1.0) -
               coarse_change / fine_change;
    };
    double low = 1e-3;
    double high = highest_order;
    if (excess(low) > 0.0 || excess(high) < 0.0) return std::nullopt;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (excess(middle) > 0.0 ? high : low) = middle;
    }
    const double order = 0.5 * (low + high);
    const double error = std::abs(fine_change / values[2]) / (std::pow(fine_ratio, order) - 1.0);
    return MeshOrder{order, safety * error};
}

}  // namespace samara
