#include "samara/kirchhoff/solvers/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>

namespace samara {
namespace {

constexpr int most_iterations = 300;
constexpr double least_scale = 1e-3;  // of the block's largest

Vector6d products(const SixColumns& a, const SixColumns& b) {
    return a.cwiseProduct(b).colwise().sum().transpose();
}

/// a / b; 0 where b is 0, which is so for columns of zeros alone.
Vector6d ratios(const Vector6d& a, const Vector6d& b) {
    return (b.array() != 0.0).select(a.cwiseQuotient(b), Vector6d::Zero());
}

/// The energy that may be left in each column.
Vector6d allowed(const Vector6d& energies, double tolerance) {
    Vector6d result;
    for (const Eigen::Index block : {0, 3}) {
        const double floor = least_scale * energies.segment<3>(block).maxCoeff();
        result.segment<3>(block) = tolerance * energies.segment<3>(block).cwiseMax(floor);
    }
    return result;
}

}  // namespace

std::optional<SolutionEnergies> conjugate_gradients(
    const std::function<SixColumns(const SixColumns&)>& multiply,
    const std::function<SixColumns(const SixColumns&)>& precondition, const SixColumns& right_hand_sides,
    const Vector6d& scales, double tolerance, const std::function<void(double)>& progress) {
    SixColumns solution = SixColumns::Zero(right_hand_sides.rows(), 6);
    SixColumns image = solution;  // multiply(solution)
    SixColumns residual = right_hand_sides;
    SixColumns conditioned = precondition(residual);
    SixColumns direction = conditioned;
    Vector6d left = products(residual, conditioned);
    Vector6d energies = scales;
    SolutionEnergies result;
    double first_excess = 0.0;
    for (;; ++result.iterations) {
        const double excess = ratios(left, allowed(energies, tolerance)).maxCoeff();
        if (!std::isfinite(excess)) return std::nullopt;
        if (result.iterations > 0 && excess <= 1.0) break;
        if (result.iterations == most_iterations) return std::nullopt;
        if (result.iterations == 1) first_excess = excess;
        if (progress && first_excess > 1.0) {
            progress(std::clamp(1.0 - std::log(excess) / std::log(first_excess), 0.0, 1.0));
        }
        const SixColumns step_image = multiply(direction);
        const Vector6d curvature = products(direction, step_image);
        if ((curvature.array() < 0.0).any()) return std::nullopt;
        const Vector6d step = ratios(left, curvature);
        solution += direction * step.asDiagonal();
        image += step_image * step.asDiagonal();
        residual -= step_image * step.asDiagonal();
        energies += step.cwiseProduct(left);
        conditioned = precondition(residual);
        const Vector6d next = products(residual, conditioned);
        direction = (conditioned + direction * ratios(next, left).asDiagonal()).eval();
        left = next;
    }
    const Matrix6d linear = solution.transpose() * right_hand_sides;
    result.energies = linear + linear.transpose() - solution.transpose() * image;
    return result;
}

}  // namespace samara
