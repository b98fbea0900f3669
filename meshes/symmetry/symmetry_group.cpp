#include "meshes/symmetry/symmetry_group.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/SVD>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {
namespace {

// An averaged group is exact but for rounding, so that a matrix farther from whole numbers is no permutation.
bool permutes(const Matrix3d& element) {
    constexpr double rounding = 1e-8;
    return (element - Matrix3d(element.array().round())).norm() < rounding;
}

// Returns the axis of the element's rotation (after the inversion, if it is improper); zero for the identity
// and the inversion.
Vector3d axis_of(const Matrix3d& element) {
    const Matrix3d rotation = element.determinant() < 0.0 ? Matrix3d(-element) : element;
    const Eigen::AngleAxisd angle_axis(rotation);
    return std::abs(angle_axis.angle()) < 0.05 ? Vector3d(Vector3d::Zero()) : angle_axis.axis();
}

std::vector<Vector3d> axes_of(const std::vector<Matrix3d>& elements) {
    std::vector<Vector3d> axes;
    for (const Matrix3d& element : elements) {
        const Vector3d axis = axis_of(element);
        const bool is_new =
            axis.norm() > 0.5 && std::none_of(axes.begin(), axes.end(), [&](const Vector3d& other) {
                return std::abs(axis.dot(other)) > 0.99;
            });
        if (is_new) axes.push_back(axis);
    }
    return axes;
}

std::size_t aligned_count(const std::vector<Matrix3d>& elements, const Matrix3d& frame) {
    return static_cast<std::size_t>(std::count_if(
        elements.begin(), elements.end(),
        [&](const Matrix3d& element) { return permutes(frame.transpose() * element * frame); }));
}

std::size_t nearest_element(const std::vector<Matrix3d>& group, const Matrix3d& element) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < group.size(); ++i) {
        if ((group[i] - element).squaredNorm() < (group[nearest] - element).squaredNorm()) nearest = i;
    }
    return nearest;
}

Matrix3d nearest_orthogonal(const Matrix3d& matrix) {
    const Eigen::JacobiSVD<Matrix3d> decomposition(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return decomposition.matrixU() * decomposition.matrixV().transpose();
}

// Permutes the columns of a frame and chooses their signs so that its rotation from the identity is smallest.
Matrix3d relabelled(const Matrix3d& frame) {
    Matrix3d best = frame;
    for (const Matrix3d& permutation : signed_permutations()) {
        const Matrix3d candidate = frame * permutation;
        if (permutation.determinant() > 0.0 && candidate.trace() > best.trace() + 1e-9) best = candidate;
    }
    return best;
}

Matrix3d aligned_frame(const std::vector<Matrix3d>& elements) {
    Matrix3d best = Matrix3d::Identity();
    std::size_t best_count = 0;
    const auto consider = [&](const Matrix3d& frame) {
        const Matrix3d candidate = relabelled(frame);
        const std::size_t count = aligned_count(elements, candidate);
        const bool is_nearer = count == best_count && candidate.trace() > best.trace() + 1e-9;
        if (count > best_count || is_nearer) {
            best = candidate;
            best_count = count;
        }
    };
    const std::vector<Vector3d> axes = axes_of(elements);
    for (const Vector3d& first : axes) {
        consider(frame_about(first));
        for (const Vector3d& second : axes) {
            if (std::abs(first.dot(second)) > 0.1) continue;
            Matrix3d frame;
            frame.col(0) = first;
            frame.col(1) = (second - second.dot(first) * first).normalized();
            frame.col(2) = frame.col(0).cross(frame.col(1));
            consider(frame);
        }
    }
    return best;
}

// Replaces each element by the mean of the quotients that equal it, repeatedly. The mean of quotients, unlike
// that of products, has no error of first order.
std::vector<Matrix3d> averaged(std::vector<Matrix3d> group) {
    constexpr int most_rounds = 20;
    for (int round = 0; round < most_rounds; ++round) {
        std::vector<Matrix3d> sums(group.size(), Matrix3d::Zero());
        for (const Matrix3d& a : group) {
            for (const Matrix3d& b : group)
                sums[nearest_element(group, a * b.transpose())] += a * b.transpose();
        }
        double change = 0.0;
        for (std::size_t i = 0; i < group.size(); ++i) {
            const Matrix3d next = nearest_orthogonal(sums[i]);
            change = std::max(change, (next - group[i]).norm());
            group[i] = next;
        }
        if (change < 1e-14) break;
    }
    return group;
}

bool is_signed_permutation(const Matrix3d& matrix) {
    return matrix == Matrix3d(matrix.array().round());
}

}  // namespace

Matrix3d frame_about(const Vector3d& axis) {
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    const Vector3d along = axis[largest] < 0.0 ? Vector3d(-axis) : axis;
    // The smallest rotation from the shape's axis to there.
    return rotation_between(Vector3d::Unit(largest), along).toRotationMatrix();
}

AlignedGroup aligned_group(const std::vector<Matrix3d>& elements) {
    AlignedGroup group;
    const std::vector<Matrix3d> exact = averaged(elements);
    const Matrix3d frame = aligned_frame(exact);
    bool along_shape_axes = (frame - Matrix3d::Identity()).norm() < 0.1;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        Matrix3d element = frame.transpose() * exact[i] * frame;
        if (permutes(element)) {
            element = element.array().round() + 0.0;
            along_shape_axes = along_shape_axes && is_signed_permutation(elements[i]);
        }
        group.elements.push_back(element);
    }
    if (!along_shape_axes) {
        group.axes = frame;
        for (Matrix3d& element : group.elements) element = frame * element * frame.transpose();
    }
    group.elements.front().setIdentity();
    return group;
}

namespace {

// In the Frobenius norm: a rotation by 8 degrees. Elements of a group with axes of order 16 differ by 0.55.
constexpr double same_element = 0.2;
constexpr std::size_t largest_group = 240;
// An axis is refined by steps from 2 to 0.5 degrees with few points, then to 0.02 degrees with more.
constexpr std::size_t few_points = 60;
constexpr int coarse_halvings = 3;
constexpr std::size_t more_points = 400;
constexpr int fine_halvings = 4;
constexpr double first_step = 0.035;
// An operation is not refined where a point of its image is farther from the surface than this many
// tolerances, than one tolerance plus the displacement by an axis that is off by some degrees, or where the
// mean distance is too large. Relative to the size.
constexpr double most_tolerances = 6.0;
constexpr double most_distance_from_image = 0.15;
constexpr double most_astray_in_the_mean = 0.1;
constexpr double astray_after_coarse_steps = 0.02;

// A body that nearly all rotations map onto itself within the tolerance counts as round; the search ends
// after so many operations without a finite group.
constexpr int most_endless = 24;

bool is_in(const std::vector<Matrix3d>& elements, const Matrix3d& element) {
    return std::any_of(elements.begin(), elements.end(),
                       [&](const Matrix3d& member) { return is_same_element(member, element); });
}

// Minimises the mean distance by steps of the axis in two perpendicular directions, from `step` on, halved so
// many times. `best`: the resulting mean distance.
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
                Operation candidate = operation;
                candidate.axis = (operation.axis + step * direction).normalized();
                const double distance = images.mean_distance(candidate.matrix(), points, best);
                if (distance >= best) continue;
                best = distance;
                operation = candidate;
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
    if (!images_.is_symmetry(element, std::min(most_tolerances, 1.0 + most_distance_from_image / tolerance),
                             more_points))
        return;
    double best = 0.0;
    const Operation near = refined(operation, images_, few_points, first_step, coarse_halvings, best);
    if (best > tolerance ||
        !images_.is_symmetry(near.matrix(), 1.0 + astray_after_coarse_steps / tolerance, more_points))
        return;
    // Fine steps are expensive: they are not taken for known elements or for those without a finite group.
    if (contains(near.matrix())) return;
    if (!grown_by(near.matrix())) {
        ++endless_;
        return;
    }
    add(refined(near, images_, more_points, std::ldexp(first_step, -coarse_halvings), fine_halvings, best)
            .matrix());
}

}  // namespace samara
