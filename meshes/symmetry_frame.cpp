#include "meshes/symmetry_frame.hpp"

#include <algorithm>
#include <cmath>

#include "meshes/symmetry_group.hpp"

namespace samara {
namespace {

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
            return is_same_element(turned, turned.array().round());
        }));
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

}  // namespace

Matrix3d frame_about(const Vector3d& axis) {
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    const Vector3d along = axis[largest] < 0.0 ? Vector3d(-axis) : axis;
    // The smallest turn that takes the shape's axis there.
    return Quaterniond::FromTwoVectors(Vector3d::Unit(largest), along).toRotationMatrix();
}

Matrix3d aligned_frame(const std::vector<Matrix3d>& elements) {
    Matrix3d best = Matrix3d::Identity();
    std::size_t best_count = aligned_count(elements, best);
    const auto consider = [&](const Matrix3d& frame) {
        const Matrix3d candidate = relabelled(frame);
        const std::size_t count = aligned_count(elements, candidate);
        const bool is_nearer =
            count == best_count && !best.isIdentity() && candidate.trace() > best.trace() + 1e-9;
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

std::vector<Matrix3d> snapped_in_frame(const std::vector<Matrix3d>& elements, const Matrix3d& frame) {
    std::vector<Matrix3d> snapped;
    for (const Matrix3d& element : elements) {
        const Matrix3d turned = frame.transpose() * element * frame;
        const Matrix3d rounded = snapped_to_signed_permutation(turned);
        // The identity frame leaves exact entries exact.
        snapped.push_back(frame.isIdentity(0.0) ? rounded : Matrix3d(frame * rounded * frame.transpose()));
    }
    return snapped;
}

}  // namespace samara
