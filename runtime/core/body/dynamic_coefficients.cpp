#include "samara/core/body/dynamic_coefficients.hpp"

#include <algorithm>
#include <cmath>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {
namespace {

constexpr double tensor_rounding = 1e-9;  // of a tensor's largest entry

std::string error_of(const Matrix3d& tensor, const char* name, bool is_drag) {
    const std::string is = std::string(name) + " is not ";
    if (!tensor.allFinite()) return is + "finite";
    const double scale = tensor.cwiseAbs().maxCoeff();
    if ((tensor - tensor.transpose()).cwiseAbs().maxCoeff() > tensor_rounding * scale)
        return is + "symmetric";
    if (is_drag && eigenvalues_of(tensor).minCoeff() < -tensor_rounding * scale) {
        return is + "positive semidefinite";
    }
    return {};
}

}  // namespace

std::string error_of(const DynamicCoefficients& coefficients) {
    for (const NumberOfMotion& number : numbers_of_motion) {
        const double value = coefficients.*number.member;
        if (!std::isfinite(value)) return std::string(number.name) + " is not finite";
        if (number.is_positive && value <= 0.0) return std::string(number.name) + " is not positive";
    }
    if (!(coefficients.half_length > 0.0) || !std::isfinite(coefficients.half_length)) {
        return "half_length is not a positive number";
    }
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        const std::string error = error_of(coefficients.*tensor.member, tensor.name, tensor.is_drag);
        if (!error.empty()) return error;
    }
    return {};
}

double beyond(const IdentifiedDensities& densities, double density) {
    if (densities.lowest <= 0.0 || density <= 0.0) return 1.0;
    return std::max({1.0, densities.lowest / density, density / densities.highest});
}

}  // namespace samara
