#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "samara/core/body/body.hpp"

namespace samara {

/// What is known of one number of a body's dynamic coefficients before its falls are looked at.
struct MotionParameter {
    std::string name;  ///< such as "transport 1"
    double expected;
    double deviation;
    double lower;
    double upper;
};

/// The numbers that a body's dynamic coefficients are made of, over what belongs to its size: the principal
/// values of each tensor along the body's principal axes, the shortest extent first; along two axes that the
/// body's symmetry makes equal there is one. What is expected is what the falls in docs/studies/falls have in
/// common; drags in motion and in spin and transport of the turning are that for every body, and have no
/// numbers.
class MotionParameters {
  public:
    /// The body must have its Kirchhoff tensor. Terms whose names are in `without`, as names() has them, stay
    /// out: zero, for the transports as in potential flow, and for the unsteady factor one. Throws Error
    /// where there is no such term.
    explicit MotionParameters(const Body& body, const std::vector<std::string>& without = {});

    /// The terms: transport, drag in motion, ...
    [[nodiscard]] static std::vector<std::string> names();

    [[nodiscard]] const std::vector<MotionParameter>& all() const { return parameters_; }
    [[nodiscard]] DynamicCoefficients coefficients(const Eigen::VectorXd& numbers) const;
    /// Of the numbers' standard errors, which are taken as independent: each entry's.
    [[nodiscard]] DynamicCoefficients standard_errors(const Eigen::VectorXd& errors) const;
    /// That of DynamicCoefficients, which the body's symmetry decides.
    [[nodiscard]] double settling_length() const { return shared_.settling_length; }
    /// The numbers that are expected.
    [[nodiscard]] Eigen::VectorXd expected() const;

  private:
    struct Tensor {
        Matrix3d DynamicCoefficients::*member;
        Vector3d offset;        // what the numbers are added to
        Vector3d unit;          // of the numbers
        Eigen::Vector3i place;  // among the numbers
    };
    void leave_out(const std::string& name);
    [[nodiscard]] Eigen::Vector3d principal_values(const Tensor& tensor,
                                                   const Eigen::VectorXd& numbers) const;

    Matrix3d axes_;
    Eigen::Vector3i tied_;  // the axis whose number each axis takes
    std::vector<Tensor> tensors_;
    std::vector<MotionParameter> parameters_;
    DynamicCoefficients shared_;  // of what has no numbers
};

}  // namespace samara
