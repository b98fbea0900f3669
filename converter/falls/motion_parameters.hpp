#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "samara/core/body/body.hpp"

namespace samara {

/// The prior knowledge of one number of a body's dynamic coefficients: expected value, deviation and bounds.
struct MotionParameter {
    std::string name;  ///< such as "transport 1"
    double expected;
    double deviation;
    double lower;
    double upper;
};

/// The numbers that determine a body's dynamic coefficients, in units of its size: the principal values of
/// each tensor along the body's principal axes, the shortest extent first; two axes that are equal by the
/// body's symmetry share one number. The expectations are what the falls in docs/studies/falls have in
/// common; drag in motion, drag in spin and rotational transport have that value for every body, and no
/// numbers.
class MotionParameters {
  public:
    /// The body must have its Kirchhoff tensor. Terms whose names are in `without`, as names() has them, are
    /// left out: they are zero, the transports as in potential flow, and the unsteady factor one. Throws
    /// Error where there is no such term.
    explicit MotionParameters(const Body& body, const std::vector<std::string>& without = {});

    /// Returns the names of the terms: transport, drag in motion, ...
    [[nodiscard]] static std::vector<std::string> names();

    [[nodiscard]] const std::vector<MotionParameter>& all() const { return parameters_; }
    [[nodiscard]] DynamicCoefficients coefficients(const Eigen::VectorXd& numbers) const;
    /// Returns the standard error of each coefficient's entries, from those of the numbers, which are taken
    /// as independent.
    [[nodiscard]] DynamicCoefficients standard_errors(const Eigen::VectorXd& errors) const;
    /// Returns DynamicCoefficients::settling_length, which depends on the body's symmetry.
    [[nodiscard]] double settling_length() const { return shared_.settling_length; }
    /// Returns the expected numbers.
    [[nodiscard]] Eigen::VectorXd expected() const;

  private:
    struct Tensor {
        Matrix3d DynamicCoefficients::*member;
        Vector3d offset;        // added to the numbers
        Vector3d unit;          // unit of the numbers
        Eigen::Vector3i place;  // index among the numbers
    };
    void leave_out(const std::string& name);
    [[nodiscard]] Eigen::Vector3d principal_values(const Tensor& tensor,
                                                   const Eigen::VectorXd& numbers) const;

    Matrix3d axes_;
    Eigen::Vector3i tied_;  // for each axis the axis whose number it shares
    std::vector<Tensor> tensors_;
    std::vector<MotionParameter> parameters_;
    DynamicCoefficients shared_;  // the coefficients without numbers
};

}  // namespace samara
