#include "converter/falls/motion_parameters.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "samara/core/base/error.hpp"
#include "samara/core/dynamics/dynamic_coefficients.hpp"

namespace samara {
namespace {

constexpr const char* unsteady_factor = "unsteady factor";
// These terms have the same value for every body.
constexpr const char* drag_in_motion = "drag in motion";
constexpr const char* drag_in_spin = "drag in spin";
constexpr const char* transport_of_rotation = "rotational transport";

struct Expectation {
    Matrix3d DynamicCoefficients::*member;
    const char* name;
    double expected, deviation, lower, upper;
};

// Means and deviations over the falls in docs/studies/falls.
constexpr Expectation expectations[] = {
    {&DynamicCoefficients::transport, "transport", 0.0, 1.0, -6.0, 6.0},
    {&DynamicCoefficients::rotational_drag, "rotational drag", usual_rotational_drag, 0.7, 0.0, 6.0},
    {&DynamicCoefficients::rotational_drag_in_spin, "rotational drag in spin", usual_rotational_drag_in_spin,
     0.7, 0.0, 6.0},
};

// The relative difference up to which two axes count as equal.
constexpr double alike = 0.01;

Eigen::Vector3i tied_axes(const Matrix3d& axes, const Body& body, double half_length) {
    const auto along = [&](const Matrix3d& tensor) -> Vector3d {
        return (axes.transpose() * tensor * axes).diagonal();
    };
    const Matrix6d& fluid = body.kirchhoff->matrix;
    const Vector3d masses = along(fluid.bottomRightCorner<3, 3>());
    const Vector3d inertias = along(fluid.topLeftCorner<3, 3>());
    const Vector3d extents = along(body.moments.second_moments);
    // The inertia of a body of revolution about its axis, and all of a sphere's, is nothing but rounding.
    const double usual_inertia = masses.maxCoeff() * std::pow(half_length, 2);
    const auto equal = [](const Vector3d& values, int i, int j, double least = 0.0) {
        return std::abs(values[i] - values[j]) <= alike * std::max(values.maxCoeff(), least);
    };
    Eigen::Vector3i tied(0, 1, 2);
    for (int i = 1; i < 3; ++i) {
        for (int j = i - 1; j >= 0; --j) {
            if (equal(masses, i, j) && equal(inertias, i, j, 0.1 * usual_inertia) && equal(extents, i, j))
                tied[i] = tied[j];
        }
    }
    return tied;
}

}  // namespace

std::vector<std::string> MotionParameters::names() {
    std::vector<std::string> names;
    for (const Expectation& expectation : expectations) names.emplace_back(expectation.name);
    for (const char* name : {unsteady_factor, drag_in_motion, drag_in_spin, transport_of_rotation})
        names.emplace_back(name);
    return names;
}

MotionParameters::MotionParameters(const Body& body, const std::vector<std::string>& without) {
    axes_ = principal_axes(body.moments);
    shared_ = default_dynamic_coefficients(body);
    shared_.origin.clear();
    // The full values, whereas the defaults decrease towards a sphere: these follow the falls better
    // (docs/studies/falls).
    const Matrix3d areas = projected_area_tensor(body);
    shared_.drag_in_motion = 0.5 * usual_drag_in_motion * (areas + areas.transpose());
    shared_.drag_in_spin = 0.5 * usual_drag_in_spin * (areas + areas.transpose());
    tied_ = tied_axes(axes_, body, shared_.half_length);
    shared_.settling_length = tied_.isZero() ? settling_length_of_alike_axes : settling_length_of_falls;
    const Matrix3d added_mass = axes_.transpose() * body.kirchhoff->matrix.bottomRightCorner<3, 3>() * axes_;
    const double largest = added_mass.diagonal().maxCoeff();
    const Vector3d rotation =
        (axes_.transpose() * rotational_drag_tensor(body.surface, body.moments.centroid) * axes_).diagonal();
    const Vector3d none = Vector3d::Zero();
    const Vector3d offsets[] = {added_mass.diagonal(), none, none};
    // A body of revolution has no rotational drag about its axis by its pressure: friction is a small share.
    const Vector3d of_rotation = rotation.cwiseMax(0.02 * rotation.maxCoeff());
    const Vector3d units[] = {Vector3d::Constant(0.25 * largest), of_rotation, of_rotation};
    for (std::size_t t = 0; t < std::size(expectations); ++t) {
        const Expectation& expectation = expectations[t];
        Tensor tensor{expectation.member, offsets[t], units[t], {}};
        for (int i = 0; i < 3; ++i) {
            if (tied_[i] == i) {
                tensor.place[i] = static_cast<int>(parameters_.size());
                parameters_.push_back({fmt::format("{} {}", expectation.name, i + 1), expectation.expected,
                                       expectation.deviation, expectation.lower, expectation.upper});
            } else {
                tensor.place[i] = tensor.place[tied_[i]];
            }
        }
        tensors_.push_back(tensor);
    }
    parameters_.push_back({unsteady_factor, 1.0, 0.3, 0.3, 3.0});
    for (const std::string& name : without) leave_out(name);
}

void MotionParameters::leave_out(const std::string& name) {
    const std::vector<std::string> known = names();
    if (std::ranges::find(known, name) == known.end()) {
        throw Error(fmt::format("there is no term '{}'; the terms are {}", name, fmt::join(known, ", ")));
    }
    if (name == drag_in_motion) shared_.drag_in_motion.setZero();
    if (name == drag_in_spin) shared_.drag_in_spin.setZero();
    if (name == transport_of_rotation) shared_.rotational_transport = 0.0;
    // Transport's numbers are added to the added mass; in potential flow there is no transport.
    for (Tensor& tensor : tensors_) {
        if (name == "transport" && tensor.member == &DynamicCoefficients::transport) tensor.offset.setZero();
    }
    for (MotionParameter& parameter : parameters_) {
        if (!parameter.name.starts_with(name) ||
            parameter.name.find_first_not_of(" 123", name.size()) != std::string::npos) {
            continue;
        }
        const double left_out = name == unsteady_factor ? 1.0 : 0.0;
        parameter.expected = parameter.lower = parameter.upper = left_out;
    }
}

Eigen::VectorXd MotionParameters::expected() const {
    Eigen::VectorXd numbers(static_cast<Eigen::Index>(parameters_.size()));
    for (Eigen::Index i = 0; i < numbers.size(); ++i)
        numbers[i] = parameters_[static_cast<std::size_t>(i)].expected;
    return numbers;
}

Eigen::Vector3d MotionParameters::principal_values(const Tensor& tensor,
                                                   const Eigen::VectorXd& numbers) const {
    Vector3d values;
    for (int i = 0; i < 3; ++i) {
        values[i] = tensor.unit[i] * numbers[tensor.place[i]];
    }
    return values;
}

DynamicCoefficients MotionParameters::coefficients(const Eigen::VectorXd& numbers) const {
    DynamicCoefficients coefficients = shared_;
    for (const Tensor& tensor : tensors_) {
        const Vector3d values = tensor.offset + principal_values(tensor, numbers);
        const Matrix3d matrix = axes_ * values.asDiagonal() * axes_.transpose();
        coefficients.*tensor.member = 0.5 * (matrix + matrix.transpose());
    }
    coefficients.unsteady_factor = numbers[numbers.size() - 1];
    return coefficients;
}

DynamicCoefficients MotionParameters::standard_errors(const Eigen::VectorXd& errors) const {
    DynamicCoefficients coefficients;
    coefficients.settling_length = 0.0;
    for (const Tensor& tensor : tensors_) {
        const Vector3d values = principal_values(tensor, errors);
        // Each entry is a sum of the values times squares or products of the axes' components.
        Matrix3d squares = Matrix3d::Zero();
        for (int i = 0; i < 3; ++i) {
            const Matrix3d share = axes_.col(i) * axes_.col(i).transpose();
            squares += (values[i] * share).cwiseAbs2();
        }
        coefficients.*tensor.member = squares.cwiseSqrt();
    }
    coefficients.unsteady_factor = errors[errors.size() - 1];
    return coefficients;
}

}  // namespace samara
