#include "meshes/symmetry/symmetry_group.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace samara {
namespace {

// In the Frobenius norm: a turn by 8 degrees. Elements of a group with axes of order 16 differ by 0.55.
constexpr double same_element = 0.2;
constexpr std::size_t largest_group = 240;
// An axis is first turned by steps from 2 to 0.5 degrees, with few points, then to 0.02 with more.
constexpr std::size_t few_points = 60;
constexpr int coarse_halvings = 3;
constexpr std::size_t more_points = 400;
constexpr int fine_halvings = 4;
constexpr double first_step = 0.035;
// Images are not worth turning where a point is further from the surface than this many tolerances, or than
// the one tolerance and what an axis that is off by some degrees takes it there, or all are so in the mean.
// Parts of the size.
constexpr double most_tolerances = 6.0;
constexpr double most_astray = 0.15;
constexpr double most_astray_in_the_mean = 0.1;
constexpr double astray_after_coarse_steps = 0.02;

// A body that nearly all turns take onto itself within the tolerance is round but for what that hides.
constexpr int most_endless = 24;

bool is_in(const std::vector<Matrix3d>& elements, const Matrix3d& element) {
    return std::any_of(elements.begin(), elements.end(),
                       [&](const Matrix3d& member) { return is_same_element(member, element); });
}

// Descends by steps of the axis along two directions across it, from `step` on, halved so many times. `best`:
// the mean distance there.
Operation refined(Operation operation, const ImageComparison& images, std::size_t points, double step,
                  int halvings, double& best) {
    best = images.mean_distance(operation.matrix(), points);
    for (int halving = 0; halving < halvings; ++halving, step *= 0.5) {
        bool improved = true;
        for (int round = 0; improved && round < 4; ++round) {
            improved = false;
            const Vector3d across = operation.axis.unitOrthogonal();
            const Vector3d other = operation.axis.cross(across);
            for (const Vector3d& direction : std::array<Vector3d, 4>{across, -across, other, -other}) {
                Operation turned = operation;
                turned.axis = (operation.axis + step * direction).normalized();
                const double distance = images.mean_distance(turned.matrix(), points, best);
                if (distance >= best) continue;
                best = distance;
                operation = turned;
                improved = true;
            }
        }
    }
    return operation;
}

}  // namespace

Matrix3d Operation::matrix() const {
    const Matrix3d rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    return improper ? Matrix3d(-rotation) : rotation;
}

bool is_same_element(const Matrix3d& a, const Matrix3d& b) {
    return (a - b).norm() < same_element;
}

std::vector<Matrix3d> signed_permutations() {
    std::vector<Matrix3d> all;
    std::array<int, 3> order = {0, 1, 2};
    do {
        for (int signs = 0; signs < 8; ++signs) {
            Matrix3d matrix = Matrix3d::Zero();
            for (int row = 0; row < 3; ++row) {
                matrix(row, order[static_cast<std::size_t>(row)]) = (signs >> row & 1) != 0 ? -1.0 : 1.0;
            }
            all.push_back(matrix);
        }
    } while (std::next_permutation(order.begin(), order.end()));
    return all;
}

bool SymmetryGroup::contains(const Matrix3d& element) const {
    return is_in(elements_, element);
}

std::optional<std::vector<Matrix3d>> SymmetryGroup::grown_by(const Matrix3d& element) const {
    std::vector<Matrix3d> grown = elements_;
    grown.push_back(element);
    for (std::size_t i = 0; i < grown.size(); ++i) {
        for (std::size_t j = 0; j < grown.size(); ++j) {
            for (const Matrix3d& product : {Matrix3d(grown[i] * grown[j]), Matrix3d(grown[j] * grown[i])}) {
                if (is_in(grown, product)) continue;
                if (grown.size() == largest_group) return std::nullopt;
                grown.push_back(product);
            }
        }
    }
    return grown;
}

void SymmetryGroup::add(const Matrix3d& element) {
    if (contains(element) || !images_.is_symmetry(element)) return;
    std::optional<std::vector<Matrix3d>> grown = grown_by(element);
    if (!grown) return;
    constexpr double slack_of_products = 2.0;
    const auto first_product = grown->begin() + static_cast<std::ptrdiff_t>(elements_.size()) + 1;
    if (std::all_of(first_product, grown->end(), [&](const Matrix3d& product) {
            return images_.is_symmetry(product, slack_of_products);
        })) {
        elements_ = *std::move(grown);
    }
}

void SymmetryGroup::add_refined(const Operation& operation) {
    const Matrix3d element = operation.matrix();
    if (endless_ == most_endless || contains(element)) return;
    const double tolerance = images_.tolerance();
    const double in_the_mean = tolerance + most_astray_in_the_mean;
    if (images_.mean_distance(element, few_points, in_the_mean) > in_the_mean) return;
    if (!images_.is_symmetry(element, std::min(most_tolerances, 1.0 + most_astray / tolerance), more_points))
        return;
    double best = 0.0;
    const Operation near = refined(operation, images_, few_points, first_step, coarse_halvings, best);
    if (best > tolerance ||
        !images_.is_symmetry(near.matrix(), 1.0 + astray_after_coarse_steps / tolerance, more_points))
        return;
    // Fine steps are the dear ones: not for what is known, or has no end of products.
    if (contains(near.matrix())) return;
    if (!grown_by(near.matrix())) {
        ++endless_;
        return;
    }
    add(refined(near, images_, more_points, std::ldexp(first_step, -coarse_halvings), fine_halvings, best)
            .matrix());
}

}  // namespace samara
