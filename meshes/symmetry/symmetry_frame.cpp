#include "meshes/symmetry/symmetry_frame.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/SVD>

#include "meshes/symmetry/symmetry_group.hpp"
#include "samara/core/base/linear_algebra.hpp"

namespace samara {
namespace {

// An averaged group is exact but for rounding, so what is further off is no permutation.
bool permutes(const Matrix3d& element) {
    constexpr double rounding = 1e-8;
    return (element - Matrix3d(element.array().round())).norm() < rounding;
}

// The axis of the rotation that the element is, or is after the inversion: zero for the identity and the
// inversion.
Vector3d axis_of(const Matrix3d& element) {
    const Matrix3d rotation = element.determinant() < 0.0 ? Matrix3d(-element) : element;
    const Eigen::AngleAxisd turn(rotation);
    return std::abs(turn.angle()) < 0.05 ? Vector3d(Vector3d::Zero()) : turn.axis();
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
    return static_cast<std::size_t>(
        std::count_if(elements.begin(), elements.end(), [&](const Matrix3d& element) {
            const Matrix3d turned = frame.transpose() * element * frame;
            return permutes(turned);
        }));
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

// The same three lines with their columns and signs chosen so that it is turned least from the identity.
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

// Quotients, not products: their mean has no error of first order.
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
    // The smallest turn that takes the shape's axis there.
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

}  // namespace samara
