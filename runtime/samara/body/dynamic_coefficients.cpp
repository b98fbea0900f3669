#include "samara/body/dynamic_coefficients.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>

namespace samara {
namespace {

constexpr double rounding = 1e-9;  // of a tensor's largest entry

std::string fault_of(const Matrix3d& tensor, const char* name) {
    const std::string is = std::string(name) + " is not ";
    if (!tensor.allFinite()) return is + "finite";
    const double scale = tensor.cwiseAbs().maxCoeff();
    if ((tensor - tensor.transpose()).cwiseAbs().maxCoeff() > rounding * scale) return is + "symmetric";
    if (Eigen::SelfAdjointEigenSolver<Matrix3d>(tensor).eigenvalues().minCoeff() < -rounding * scale) {
        return is + "positive semidefinite";
    }
    return {};
}

}  // namespace

std::string fault_of(const DynamicCoefficients& coefficients) {
    if (!std::isfinite(coefficients.force_transport)) return "force_transport is not finite";
    if (!std::isfinite(coefficients.moment_transport)) return "moment_transport is not finite";
    if (!(coefficients.half_length > 0.0) || !std::isfinite(coefficients.half_length)) {
        return "half_length is not a positive number";
    }
    const std::string fault = fault_of(coefficients.drag_in_motion, "drag_in_motion");
    return fault.empty() ? fault_of(coefficients.rotational_drag, "rotational_drag") : fault;
}

}  // namespace samara
