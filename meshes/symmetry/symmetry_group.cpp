#include "meshes/symmetry/symmetry_group.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace samara {
namespace {

// In the Frobenius norm: a turn by 8 degrees. Elements of a group with axes of order 16 differ by 0.55.
constexpr double same_element = 0.2;
constexpr std::size_t largest_group = 240;
constexpr std::size_t points_to_refine = 400;
// Images with a point that is further than this many tolerances from the surface are not worth turning.
constexpr double worth_refining = 6.0;

bool is_in(const std::vector<Matrix3d>& elements, const Matrix3d& element) {
    return std::any_of(elements.begin(), elements.end(),
                       [&](const Matrix3d& member) { return is_same_element(member, element); });
}

// Descends by steps of the axis along two directions across it, halved from 2 degrees to 0.02.
Operation refined(Operation operation, const ImageComparison& images) {
    double best = images.mean_distance(operation.matrix(), points_to_refine);
    constexpr int halvings = 7;
    for (int halving = 0; halving < halvings; ++halving) {
        const double step = std::ldexp(0.035, -halving);
        bool improved = true;
        for (int round = 0; improved && round < 4; ++round) {
            improved = false;
            const Vector3d across = operation.axis.unitOrthogonal();
            const Vector3d other = operation.axis.cross(across);
            for (const Vector3d& direction : std::array<Vector3d, 4>{across, -across, other, -other}) {
                Operation turned = operation;
                turned.axis = (operation.axis + step * direction).normalized();
                const double distance = images.mean_distance(turned.matrix(), points_to_refine);
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

void SymmetryGroup::add(const Matrix3d& element) {
    if (contains(element) || !images_.is_symmetry(element)) return;
    std::vector<Matrix3d> grown = elements_;
    grown.push_back(element);
    constexpr double slack_of_products = 2.0;
    for (std::size_t i = 0; i < grown.size(); ++i) {
        for (std::size_t j = 0; j < grown.size(); ++j) {
            for (const Matrix3d& product : {Matrix3d(grown[i] * grown[j]), Matrix3d(grown[j] * grown[i])}) {
                if (is_in(grown, product)) continue;
                if (grown.size() == largest_group || !images_.is_symmetry(product, slack_of_products)) return;
                grown.push_back(product);
            }
        }
    }
    elements_ = std::move(grown);
}

void SymmetryGroup::add_refined(const Operation& operation) {
    const Matrix3d element = operation.matrix();
    if (contains(element) || !images_.is_symmetry(element, worth_refining)) return;
    add(refined(operation, images_).matrix());
}

}  // namespace samara
